//! What a run leaves behind: the motion, every landing, the feet's forces, the energy account.

use std::ops::ControlFlow;

use super::{
    Finish,
    control::{HistoryOutcome, Work},
    demands::damper_forces,
    energy::Energy,
    landings::{ContactEvent, Events, Landing, MOMENT, SLIGHT},
    model::{TH, X, Z},
    observer::{Change, Observer, View},
};
use rocking::motion::Motion;

/// Contact forces of both feet (left, right) (N): for every sample the force of largest magnitude
/// since the sample before, since an impact is over long before the next sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    /// Vertical force of each foot, positive while it presses (N).
    pub vertical: [Vec<f64>; 2],
    /// Horizontal force of the ground on each foot, positive to the right (N).
    pub horizontal: [Vec<f64>; 2],
    /// Vertical forces on both corners of the body at one instant, those of dashpots there
    /// included: left plus right, left minus right.
    pub both: [Vec<f64>; 2],
}

/// The energy account at every sample (J).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Account {
    /// Work that the ground did since the start (J).
    pub input: Vec<f64>,
    /// Energy stored above the initial one (J).
    pub stored: Vec<f64>,
    /// Energy that dashpots took and springs let go (J).
    pub dissipated: Vec<f64>,
    /// Energy that the account leaves unexplained (J).
    pub residual: Vec<f64>,
}

impl Account {
    /// Append the account at a sample. Public for the crates that make histories.
    #[doc(hidden)]
    pub fn push(&mut self, energy: &Energy) {
        self.input.push(energy.input);
        self.stored.push(energy.stored - energy.initial);
        self.dissipated.push(energy.dissipated + energy.released);
        self.residual.push(energy.residual());
    }
}

/// A whole history of the finite element model.
#[derive(Clone, Debug)]
pub struct History {
    /// Motion of the centre of mass.
    pub motion: Motion,
    /// Every touch-down, in order of time.
    pub landings: Vec<Landing>,
    /// Contact forces of the feet.
    pub forces: Forces,
    /// The energy account.
    pub account: Account,
    /// How it ended: of any but `Completed` the vectors above end before the record.
    pub outcome: HistoryOutcome,
    /// Steps and iterations that it took.
    pub work: Work,
    /// Largest |residual| over the largest energy of the history.
    pub energy_residual: f64,
    /// Z of the centre of mass at the start (m); minus the settlement when it stood settled.
    pub initial_z: f64,
    /// Total time with both feet in the air (s).
    pub airborne: f64,
}

impl History {
    /// Number of impacts ([`Landing::impact`]): re-landings of bounces are not counted.
    pub fn impacts(&self) -> usize {
        self.landings.iter().filter(|l| l.impact).count()
    }

    /// Number of bounces ([`Landing::bounced`]).
    pub fn bounces(&self) -> usize {
        self.landings.iter().filter(|l| l.bounced).count()
    }
}

/// An observer that keeps everything.
#[derive(Clone, Debug)]
pub struct Recorder {
    motion: Motion,
    events: Events,
    forces: Forces,
    /// Largest since the last sample: vertical and horizontal of each foot (N).
    largest: [[f64; 2]; 2],
    /// The same of both feet together.
    largest_both: [f64; 2],
    account: Account,
    initial_z: f64,
    residual: f64,
    /// Time of the last sample (s).
    end: f64,
}

impl Recorder {
    /// With room for n samples.
    pub fn new(n: usize) -> Self {
        let room = || Vec::with_capacity(n);
        Self {
            motion: Motion::with_capacity(n),
            events: Events::default(),
            forces: Forces {
                vertical: [room(), room()],
                horizontal: [room(), room()],
                both: [room(), room()],
            },
            largest: [[0.0; 2]; 2],
            largest_both: [0.0; 2],
            account: Account {
                input: room(),
                stored: room(),
                dissipated: room(),
                residual: room(),
            },
            initial_z: 0.0,
            residual: 0.0,
            end: 0.0,
        }
    }

    /// The history, once the run is over.
    pub fn finish(self, finish: Finish) -> History {
        let lost = finish.energy.by_springs();
        let (landings, airborne) = self.events.landings(self.end, lost);
        History {
            motion: self.motion,
            landings,
            forces: self.forces,
            account: self.account,
            outcome: finish.outcome,
            work: finish.work,
            energy_residual: self.residual / finish.energy_scale,
            initial_z: self.initial_z,
            airborne,
        }
    }
}

impl Observer for Recorder {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        let q = &view.state.q;
        if index == 0 {
            self.initial_z = q[Z];
            self.events.pressing = [0, 1].map(|i| view.presses(i));
            let body = &view.model.body;
            self.events.moment = MOMENT / body.p();
            self.events.slight = body.fall(SLIGHT * body.alpha());
        }
        self.end = view.time;
        self.motion.push(q[X], q[Z] - self.initial_z, q[TH]);
        if index == 0 {
            self.step(view);
        }
        for (i, [vertical, horizontal]) in std::mem::take(&mut self.largest).into_iter().enumerate()
        {
            self.forces.vertical[i].push(vertical);
            self.forces.horizontal[i].push(horizontal);
        }
        for (series, largest) in
            self.forces.both.iter_mut().zip(std::mem::take(&mut self.largest_both))
        {
            series.push(largest);
        }
        self.account.push(view.energy);
        self.residual = self.residual.max(view.energy.residual().abs());
        ControlFlow::Continue(())
    }

    fn step(&mut self, view: &View) {
        let feet = view.model.contact(&view.state.q, view.feet);
        let dampers = damper_forces(view);
        let [left, right] = [0, 1].map(|i| feet[i].vertical + dampers[i]);
        let forces = feet
            .iter()
            .flat_map(|f| [f.vertical, f.horizontal])
            .chain([left + right, left - right]);
        let largest = self.largest.iter_mut().flatten().chain(&mut self.largest_both);
        for (largest, force) in largest.zip(forces) {
            if force.abs() > largest.abs() {
                *largest = force;
            }
        }
    }

    fn event(&mut self, foot: usize, change: Change, view: &View) {
        self.events.events.push(ContactEvent {
            time: view.time,
            foot,
            change,
            kinetic: view.body_kinetic(),
            speed: view.speed(),
            lost: view.energy.by_springs(),
        });
    }
}
