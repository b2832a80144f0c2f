//! The finite element model in the time domain: a rigid body on two feet and their ground springs.
//!
//! | file | what |
//! |---|---|
//! | `model`, `balance`, `strut` | coordinates, kinematics, contact forces, energies; the rotation that has no inertia, on both feet and on one |
//! | `stance` | where it stands at first |
//! | `radau`, `iterate`, `condensed`, `newton`, `step` | one implicit step: tables, iteration, condensed chains and matrix |
//! | `run`, `acceptance` | the time loop: samples; in `run/`, contact events and step acceptance; which steps hold |
//! | `control`, `energy`, `observer` | what a run is told, accounts for and shows |
//! | `element`, `coupled` | dampers, tendon; the Newton matrix of a body with them |
//! | `demands` | forces in legs, tendon, dampers; base shear |
//! | `history`, `landings` | what a run leaves behind: motion, forces, energies; impacts and bounces |
//!
//! **Why Radau IIA.** Springs of 300 Hz under a body that rocks at 0.3 Hz are stiff, and a body
//! without rotational inertia makes the rotation algebraic (a differential-algebraic system of
//! index 1): the method must be L-stable and stiffly accurate. Order 5 closes the energy account to
//! 1e-6 at a step or two per sample once the transients of a landing have died. Explicit methods
//! chatter, creep and topple the frame; Newmark, HHT and Gauss leave the unresolved modes ringing.
//! Its cost stays low because each absorber condenses out of the Newton matrix (`newton`).
//!
//! **What chooses the step.** The leading error of a Radau step in an oscillation is loss of
//! amplitude, so the energy that a step fails to account for is one measure of its error; it has a
//! unit, and is what the user is promised. It does not see an error of phase. So an embedded
//! formula of order three estimates the local error beside it (`step`), and a step must satisfy
//! both.

pub mod acceptance;
mod balance;
pub mod condensed;
mod contact;
mod control;
mod coupled;
pub mod cubic;
mod demands;
mod element;
mod energy;
mod history;
pub mod iterate;
mod landings;
mod lanes;
mod model;
mod newton;
mod observer;
#[allow(clippy::excessive_precision)] // tables to 18 digits, as computed
pub mod radau;
mod run;
mod slipping;
mod stance;
mod step;
mod strut;
mod turning;

pub use control::{Control, HistoryOutcome, Work};
pub use demands::between_landings;
pub use demands::{DAMPERS, Demands, QUANTITIES, corner_forces};
pub use energy::Energy;
pub use history::{Account, Forces, History, Recorder};
pub use landings::{Landing, MOMENT};
pub use lanes::histories;
pub use model::MASSLESS_ROTATION;
pub use observer::{Change, Observer, View};
pub use run::{AT_ONCE, MOST_LOCATED, RESTART};

use std::ops::ControlFlow;

use crate::{
    effort::Effort,
    spring::{Chain, Springs},
};
use rocking::{members::Members, structure::Body};

/// How the body stands at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// At rest on both feet, settled under its weight.
    Settled,
    /// At rest on one settled foot, leaning by theta (rad): free rocking.
    Leaning(f64),
}

/// What a run is made of.
#[derive(Clone, Copy, Debug)]
pub struct Analysis<'a> {
    /// What rocks.
    pub body: Body<f64>,
    /// Under each foot.
    pub springs: Springs<Chain>,
    /// How it begins.
    pub start: Start,
    /// Sampling interval (s).
    pub dt: f64,
    /// Ground acceleration at t = i dt (m/s2), linear in between.
    pub accel: &'a [f64],
    /// Vertical ground acceleration at the same times (m/s2), positive upwards, zero beyond its
    /// last sample: empty if there is none.
    pub vertical: &'a [f64],
    /// Factor on the ground acceleration, both components.
    pub scale: f64,
    /// How exactly it is followed.
    pub control: Control,
}

/// How a run ended, what it cost, and its energy account.
#[derive(Clone, Copy, Debug)]
pub struct Finish {
    /// How it ended.
    pub outcome: HistoryOutcome,
    /// What it cost.
    pub work: Work,
    /// Energy account at the end.
    pub energy: Energy,
    /// Largest energy of the history, the scale of its residual (J).
    pub energy_scale: f64,
}

impl Finish {
    /// Count what it cost: a step tried is a unit.
    pub fn spend(&self, effort: &Effort) {
        effort.spend((self.work.steps + self.work.rejected + self.work.located) as u64);
    }
}

impl<'a> Analysis<'a> {
    /// From rest on horizontal motion, as exactly as usual.
    pub fn new(body: Body<f64>, springs: Springs<Chain>, dt: f64, accel: &'a [f64]) -> Self {
        Self {
            body,
            springs,
            start: Start::Settled,
            dt,
            accel,
            vertical: &[],
            scale: 1.0,
            control: Control::default(),
        }
    }

    /// Run the case, showing every sample and event to `observer`.
    pub fn observe(&self, observer: &mut dyn Observer) -> Finish {
        self.follow(&self.model(), observer)
    }

    /// The same with dampers, a tendon or friction.
    pub(crate) fn observe_with(&self, members: &Members, observer: &mut dyn Observer) -> Finish {
        self.follow(&model::Model::with_members(&self.body, &self.springs, members), observer)
    }

    fn follow(&self, model: &model::Model, observer: &mut dyn Observer) -> Finish {
        let model = &model::Model { skip_open: self.control.skip_open, ..*model };
        let mut run = self.run(model);
        let outcome = run.follow(self.ground(), observer);
        run.finish(outcome)
    }

    fn run<'m>(&self, model: &'m model::Model) -> run::TimeLoop<'m> {
        let start = match self.start {
            Start::Settled => model.settled(),
            Start::Leaning(theta) => model.leaning(theta),
        };
        run::TimeLoop::new(model, start, self.control)
    }

    fn model(&self) -> model::Model {
        model::Model {
            skip_open: self.control.skip_open,
            ..model::Model::new(&self.body, &self.springs)
        }
    }

    fn ground(&self) -> run::GroundMotion<'_> {
        let &Self { dt, accel, vertical, scale, .. } = self;
        run::GroundMotion { dt, accel, vertical, scale }
    }

    /// Run the case and keep its history.
    pub fn simulate(&self) -> History {
        let mut recorder = Recorder::new(self.accel.len());
        let finish = self.observe(&mut recorder);
        recorder.finish(finish)
    }

    /// The same with dampers, a tendon or friction, or none of them; and the forces in them.
    pub fn simulate_with(&self, members: &Members) -> (History, Demands) {
        let mut both = HistoryAndForces {
            recorder: Recorder::new(self.accel.len()),
            demands: Demands::default(),
        };
        let finish = self.observe_with(members, &mut both);
        (both.recorder.finish(finish), both.demands)
    }
}

/// Keeps the history and the forces.
struct HistoryAndForces {
    recorder: Recorder,
    demands: Demands,
}

impl Observer for HistoryAndForces {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        let _ = self.demands.sample(index, view);
        self.recorder.sample(index, view)
    }

    fn step(&mut self, view: &View) {
        self.demands.step(view);
        self.recorder.step(view);
    }

    fn event(&mut self, foot: usize, change: Change, view: &View) {
        self.recorder.event(foot, change, view);
    }
}

/// Energy of the body at rest on one settled foot, not leaning: what a rocking body's energy counts
/// from (J).
pub fn energy_on_one_foot(body: &Body<f64>, springs: &Springs<Chain>) -> f64 {
    let model = model::Model::new(body, springs);
    let (state, feet) = model.on_one_foot(0.0);
    model.energy(&state, &feet)
}

#[cfg(test)]
mod tests;
