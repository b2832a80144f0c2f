//! Frames on ground springs in the time domain: Radau IIA of order 5 with touches and lifts
//! located, and its energy account.
//!
//! ```text
//!   let frame = pier.layout().frame()?;                      what is held at its base: pier.layout().fixed().frame()?, without springs
//!   let springs = vec![chains; frame.places().len()];
//!   let history = ElasticAnalysis::new(&frame, &springs, ElasticStart::Standing, dt, &accel).simulate()?;
//!   let rotation = history.rotation(&frame, Base::Footing(0));
//! ```
//!
//! | file | what |
//! |---|---|
//! | `model` | a frame whose corners stand on spring-absorber units |
//! | `lu`, `newton`, `step` | one implicit step: matrices with absorbers condensed, iteration, local error |
//! | `run`, `events`, `account` | the time loop, touches and lifts, step acceptance |
//! | `demands`, `history`, `filter` | what a run leaves: motion, forces with and without the spikes of landings |
//! | `series` | forces finely sampled |

mod account;
mod demands;
mod events;
mod filter;
mod history;
mod lu;
mod model;
mod newton;
mod run;
mod running_peaks;
mod series;
mod step;

pub use demands::FrameDemand;
pub use filter::{low_pass, resolves};
pub use history::{ContactChange, ElasticHistory, GroundForces};
pub use model::CornerState;
pub use running_peaks::{RunningPeaks, StepForces};
pub(crate) use series::LANDING_OVER;
pub use series::{FineColumn, FineForces, FineSeries};

use super::{
    frame::{EquilibriumError, Frame},
    mechanics::Mechanics,
};
use dynamics::{
    fem::{Control, HistoryOutcome, Work},
    spring::{Chain, Springs},
};
use strong_motion::Record;

/// The default of [`Control::tolerance`], at which the account, whose residual it holds below 50
/// times this, closes to 1e-6. 20 s of El Centro, piers of 1.5 and 2 Hz, NRMSE against 1e-10: 1e-5
/// of the rotation, 1e-4 of the drift.
const TOLERANCE: f64 = 2e-8;

/// Steps of a history of a small structure before it is given up.
const MOST_STEPS: usize = 1_000_000;

/// How histories are followed unless told otherwise.
pub fn default_control() -> Control {
    Control { tolerance: TOLERANCE, most_steps: MOST_STEPS, ..Control::default() }
}

/// Units of work of a step tried of a structure of so many coordinates, absorbers among them.
pub(crate) fn step_units(coordinates: usize) -> u64 {
    let n = coordinates as u64;
    5 + n * n / 23
}

/// Coordinates of a small structure.
const SMALL: usize = 12;

/// Steps that a history of a structure of so many coordinates may try: those of the control if it
/// is small, of others as many as cost the same.
pub fn most_steps(control: Control, coordinates: usize) -> usize {
    let share = (step_units(SMALL) as f64 / step_units(coordinates) as f64).min(1.0);
    (control.most_steps as f64 * share) as usize
}

/// How the structure stands at t = 0.
#[derive(Clone, Debug, PartialEq)]
pub enum ElasticStart {
    /// At rest on all corners, settled under its weight.
    Standing,
    /// At rest, held at this lean (rad) on its last corner, or on its first if negative, then let
    /// go: `Frame::leaning`.
    Leaning(f64),
    /// With these coordinates and velocities, on the corners that are closed.
    State {
        /// The frame's.
        q: Vec<f64>,
        /// The frame's.
        v: Vec<f64>,
        /// For every corner.
        feet: Vec<CornerState>,
    },
}

/// What a run is made of.
#[derive(Clone, Debug)]
pub struct ElasticAnalysis<'a> {
    /// The structure.
    pub frame: &'a Frame,
    /// Under every corner; none under a frame that is held.
    pub springs: &'a [Springs<Chain>],
    /// How it begins.
    pub start: ElasticStart,
    /// Sampling interval (s).
    pub dt: f64,
    /// Ground acceleration at t = i dt (m/s2), linear in between.
    pub accel: &'a [f64],
    /// Vertical ground acceleration at the same times (m/s2), upwards, zero beyond its last sample:
    /// empty if there is none.
    pub vertical: &'a [f64],
    /// Factor on the ground acceleration, both components.
    pub scale: f64,
    /// How accurately and how long to work.
    pub control: Control,
    /// Whether to keep what members bear and what the ground presses with: a history without is
    /// quicker.
    pub forces: bool,
    /// Parts of the time step over whose length means of forces are kept ([`FineForces`]); none are
    /// if zero.
    pub parts: usize,
}

/// How a run ended, and what it cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct ElasticFinish {
    pub outcome: HistoryOutcome,
    pub work: Work,
    /// Largest energy of the history, the scale of its residual (J).
    pub energy_scale: f64,
}

impl<'a> ElasticAnalysis<'a> {
    /// On horizontal ground motion, unscaled, at the default accuracy, its forces kept.
    pub fn new(
        frame: &'a Frame,
        springs: &'a [Springs<Chain>],
        start: ElasticStart,
        dt: f64,
        accel: &'a [f64],
    ) -> Self {
        let control = default_control();
        Self {
            frame,
            springs,
            start,
            dt,
            accel,
            vertical: &[],
            scale: 1.0,
            control,
            forces: true,
            parts: 0,
        }
    }

    /// From rest on a record, both its components.
    pub fn on_record(frame: &'a Frame, springs: &'a [Springs<Chain>], record: &'a Record) -> Self {
        let start = ElasticStart::Standing;
        Self { vertical: record.up(), ..Self::new(frame, springs, start, record.dt, &record.accel) }
    }

    /// Run the case and keep its history.
    ///
    /// # Errors
    /// The structure has no equilibrium to begin from, or springs or start do not fit it.
    pub fn simulate(&self) -> Result<ElasticHistory, EquilibriumError> {
        self.fits()?;
        let model = model::ElasticModel::new(self.frame, self.springs);
        let still = |(q, feet): (Vec<f64>, Vec<CornerState>)| (vec![0.0; q.len()], q, feet);
        let standing = model.standing();
        // the scale of energies, also of a structure that does not stand
        let at_rest =
            standing.as_ref().map_or(0.0, |(q, feet)| model.energy(q, &vec![0.0; q.len()], feet));
        let (v, q, feet) = match &self.start {
            ElasticStart::Standing => still(standing?),
            ElasticStart::Leaning(lean) => still(model.leaning(*lean)?),
            ElasticStart::State { q, v, feet } => {
                let q = model.settle(&nalgebra::DVector::from_column_slice(q), feet);
                let mut v = v.clone();
                v.resize(q.len(), 0.0);
                (v, q, feet.clone())
            }
        };
        let mut recorder = history::ElasticRecorder::new(
            self.frame,
            (self.dt, self.accel.len()),
            self.forces,
            self.parts,
        );
        let mut run = run::SpringsRun::new(self, &model, (q, v, feet), at_rest);
        let outcome = run.follow(&mut recorder);
        Ok(recorder.finish(run.finish(outcome)))
    }

    fn fits(&self) -> Result<(), EquilibriumError> {
        let (n, corners) = (self.frame.size(), self.frame.places().len());
        let mut counts = vec![("springs", self.springs.len(), corners)];
        if let ElasticStart::State { q, v, feet } = &self.start {
            counts.extend([
                ("coordinates", q.len(), n),
                ("velocities", v.len(), n),
                ("feet", feet.len(), corners),
            ]);
        }
        match counts.into_iter().find(|(_, given, needed)| given != needed) {
            Some((what, given, needed)) => Err(EquilibriumError::Mismatch { what, given, needed }),
            None => Ok(()),
        }
    }
}
