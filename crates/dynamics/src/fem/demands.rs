//! Design quantities of a history: forces in legs, tendon and dampers, and the base shear.
//!
//! ```text
//!   leg      F = (H, N + d) of the ground and the dashpot d on the foot, D from the mass to the foot:
//!            axial F D/|D| (tension positive)   moment at the mass H D_z - (N + d) D_x    shear moment/|D|
//!   base shear    sum H plus the tendon's horizontal force at its anchor: what the ground gives the body, m (X'' + a_g)
//! ```
//!
//! The legs are those of a rigid A-frame, the lines from the mass to its feet; those of a solid
//! block mean little.

use std::ops::ControlFlow;

use super::{
    contact::FootForce,
    landings::{Landing, MOMENT},
    observer::{Observer, View},
};
use rocking::{motion::TimedPeak, structure::Body};

/// The forces of a history: their names, with units, in the order of their columns.
///
/// | place | name | what it is | positive |
/// |---|---|---|---|
/// | 0 | `base_shear_n` | of the ground and the tendon's anchor on the body (N) | to the right |
/// | 1, 4 | `axial_left_n`, `axial_right_n` | along the leg (N) | tension |
/// | 2, 5 | `shear_left_n`, `shear_right_n` | moment over the leg's length (N) | as the moment |
/// | 3, 6 | `moment_left_nm`, `moment_right_nm` | at the mass (N m) | turns it to the right |
/// | 7 | `tendon_n` | in the tendon (N) | tension |
/// | 8, 9 | `damper_left_n`, `damper_right_n` | of the damper on its corner (N) | upwards |
pub const QUANTITIES: [&str; 10] = [
    "base_shear_n",
    "axial_left_n",
    "shear_left_n",
    "moment_left_nm",
    "axial_right_n",
    "shear_right_n",
    "moment_right_nm",
    "tendon_n",
    "damper_left_n",
    "damper_right_n",
];

/// Where the dampers stand in them.
pub const DAMPERS: [usize; 2] = [8, 9];

/// One value of each of `QUANTITIES`.
pub(crate) type DemandRow = [f64; QUANTITIES.len()];

/// The forces of a history, each a row in the order of [`QUANTITIES`]. To design with, take
/// `between`: in a landing, forces are those of the ground springs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Demands {
    /// For every sample the values of largest magnitude since the sample before, with their signs.
    pub rows: Vec<DemandRow>,
    /// The values at every sample.
    pub at: Vec<DemandRow>,
    /// The ground's forces (H, N) on the left and the right foot at every sample (N): H positive to
    /// the right, N positive where the foot presses.
    pub feet: Vec<[[f64; 2]; 2]>,
    /// The value of largest magnitude of each over all steps, with its sign and time. Not to design
    /// with: in a landing it is a force of the springs, the larger the stiffer they are.
    pub peaks: [TimedPeak; QUANTITIES.len()],
    /// The value of largest magnitude of each between landings, with its sign, which is what to
    /// design with: later than 0.1/p (s) after the last touch-down. Its time is that of the sample.
    pub between: [TimedPeak; QUANTITIES.len()],
    largest: DemandRow,
}

impl Demands {
    /// Find what is largest between these landings, over the first `samples` of the history. Public
    /// for the crates that make histories.
    #[doc(hidden)]
    pub fn separate(&mut self, body: &Body<f64>, dt: f64, landings: &[Landing], samples: usize) {
        self.between = Default::default();
        for i in between_landings(body, dt, landings, samples.min(self.rows.len())) {
            let (row, time) = (&self.rows[i], i as f64 * dt);
            for (peak, &value) in self.between.iter_mut().zip(row) {
                if value.abs() > peak.value.abs() {
                    *peak = TimedPeak { value, time };
                }
            }
        }
    }
}

/// Samples, dt (s) apart, that lie later than 0.1/p after every landing: since the sample before
/// none was near.
pub fn between_landings(
    body: &Body<f64>,
    dt: f64,
    landings: &[Landing],
    samples: usize,
) -> impl Iterator<Item = usize> {
    let rest = MOMENT / body.p();
    (0..samples).filter(move |&i| {
        let time = i as f64 * dt;
        let first = landings.partition_point(|l| l.time < time - dt - rest);
        landings.get(first).is_none_or(|l| l.time > time)
    })
}

/// The forces at one instant.
pub(super) fn demand(view: &View) -> DemandRow {
    demand_of(view, &view.model.contact(&view.state.q, view.feet))
}

/// Forces on both corners of the body at a sample: of the ground and of the dashpot there (N).
pub fn corner_forces(demands: &Demands, sample: usize) -> [[f64; 2]; 2] {
    let (feet, at) = (demands.feet[sample], &demands.at[sample]);
    [0, 1].map(|i| [feet[i][0], feet[i][1] + at[DAMPERS[i]]])
}

/// Each dashpot's force on its corner of the body, upwards (N).
pub(super) fn damper_forces(view: &View) -> [f64; 2] {
    let (q, v) = (&view.state.q, &view.state.v);
    let dampers = view.model.elements_under(view.feet).dampers;
    dampers.map_or([0.0; 2], |all| all.forces(q, v).map(|(force, _)| force))
}

/// The same, of feet whose forces are known.
fn demand_of(view: &View, feet: &[FootForce; 2]) -> DemandRow {
    let (model, q) = (view.model, &view.state.q);
    let dampers = damper_forces(view);
    let [left, right] = [0, 1].map(|i| {
        let f = &feet[i];
        let (h, n) = (f.horizontal, f.vertical + dampers[i]);
        // D = (-dp_z/dtheta, dp_x/dtheta)
        let length = f.px_th.hypot(f.pz_th);
        let moment = h * f.px_th + n * f.pz_th;
        [(n * f.px_th - h * f.pz_th) / length, moment / length, moment]
    });
    let (mut shear, mut tension) = (feet[0].horizontal + feet[1].horizontal, 0.0);
    if let Some(tendon) = &model.elements.tendon {
        shear += tendon.force_on_mass(q)[0];
        tension = tendon.tension(q);
    }
    [
        shear, left[0], left[1], left[2], right[0], right[1], right[2], tension, dampers[0],
        dampers[1],
    ]
}

impl Observer for Demands {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        if index == 0 {
            self.step(view);
        }
        self.rows.push(std::mem::take(&mut self.largest));
        let feet = view.model.contact(&view.state.q, view.feet);
        self.feet.push(feet.each_ref().map(|foot| [foot.horizontal, foot.vertical]));
        self.at.push(demand_of(view, &feet));
        ControlFlow::Continue(())
    }

    fn step(&mut self, view: &View) {
        for (k, value) in demand(view).into_iter().enumerate() {
            if value.abs() > self.largest[k].abs() {
                self.largest[k] = value;
            }
            if value.abs() > self.peaks[k].value.abs() {
                self.peaks[k] = TimedPeak { value, time: view.time };
            }
        }
    }
}
