//! The finite element model in the time domain: a rigid body on two feet and their ground springs.
mod model;
mod newton;
mod radau;
pub mod run;
mod step;

pub use run::{Change, Control, Energy, Observer, Outcome, View, Work};
use std::ops::ControlFlow;
use crate::{motion::Motion, scalar::Scalar, spring::{Chain, Springs}, structure::Body};

/// records
#[derive(Default)]
pub struct Recorder { pub motion: Motion, pub z0: f64, pub events: Vec<(f64, usize, Change)>, pub worst: f64 }

impl Observer<f64> for Recorder {
    fn sample(&mut self, index: usize, view: &View<f64>) -> ControlFlow<()> {
        let q = &view.state.q;
        if index == 0 { self.z0 = q[1]; }
        self.motion.push(q[0], q[1] - self.z0, q[2]);
        self.worst = self.worst.max(view.energy.residual().abs());
        ControlFlow::Continue(())
    }
    fn event(&mut self, foot: usize, change: Change, view: &View<f64>) {
        self.events.push((view.time, foot, change));
    }
}

/// x
pub fn simulate<S: Scalar>(body: &Body<S>, springs: &Springs<Chain<S>>, dt: f64, accel: &[f64], scale: S, samples: usize, control: Control, observer: &mut impl Observer<S>) -> (Outcome, Work, f64, Energy<S>) {
    let model = model::Model::new(body, springs);
    let mut run = run::Run::new(&model, model.settled(), control);
    let o = run.follow(dt, accel, scale, samples, observer);
    (o, run.work, run.energy_scale(), *run.energy())
}
