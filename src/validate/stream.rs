//! What is kept of a finite element history while it runs: sums and peaks, no samples.

use std::ops::ControlFlow;

use crate::{
    fem::{Observer, View},
    structure::Body,
};

/// sqrt( sum (x - x_ref)^2 / sum x_ref^2 ) of samples that come one by one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nrmse {
    above: f64,
    below: f64,
}

impl Nrmse {
    fn push(&mut self, x: f64, reference: f64) {
        self.above += (x - reference) * (x - reference);
        self.below += reference * reference;
    }

    /// As [`crate::motion::nrmse`]: zero when all differences are, infinite when the reference alone is zero.
    pub fn value(&self) -> f64 {
        if self.above == 0.0 { 0.0 } else { (self.above / self.below).sqrt() }
    }
}

/// Watches a finite element history beside Housner's rotations at the same samples.
pub struct Stream<'a> {
    body: &'a Body<f64>,
    housner: &'a [f64],
    initial_z: f64,
    pub horizontal: Nrmse,
    pub vertical: Nrmse,
    /// Largest |theta| while a foot is off the ground [rad].
    pub peak: f64,
    /// theta [rad] and theta' [rad/s] at the last sample.
    pub last: (f64, f64),
    /// Largest |residual| of the energy account [J].
    pub residual: f64,
}

impl<'a> Stream<'a> {
    pub fn new(body: &'a Body<f64>, housner: &'a [f64]) -> Self {
        Self {
            body,
            housner,
            initial_z: 0.0,
            horizontal: Nrmse::default(),
            vertical: Nrmse::default(),
            peak: 0.0,
            last: (0.0, 0.0),
            residual: 0.0,
        }
    }
}

impl Observer<f64> for Stream<'_> {
    fn sample(&mut self, index: usize, view: &View<f64>) -> ControlFlow<()> {
        if index == 0 {
            self.initial_z = view.z();
        }
        if let Some(&theta) = self.housner.get(index) {
            self.horizontal.push(view.x(), self.body.u(theta));
            self.vertical.push(view.z() - self.initial_z, self.body.v(theta));
        }
        let theta = view.theta();
        if !(view.presses(0) && view.presses(1)) {
            self.peak = self.peak.max(theta.abs());
        }
        self.last = (theta, view.theta_rate());
        self.residual = self.residual.max(view.energy.residual().abs());
        ControlFlow::Continue(())
    }
}
