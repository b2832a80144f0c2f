//! What a step does to the energy account, and what it misses: as in `dynamics::fem`.

use super::{model::ElasticModel, run::SpringsRun, step::ElasticStages};
use crate::frame::Frame;
pub use dynamics::fem::acceptance::{TriedStep, allowed_energy, allowed_error, cautious};
use rocking::scalar::GRAVITY;

/// What errors are measured with.
#[derive(Clone, Copy, Debug)]
pub(super) struct ElasticScales {
    /// Half the distance between the outer corners; of a frame without corners a sixteenth of its
    /// span (m).
    pub length: f64,
    pub span: f64,
    /// The time in which an error of the rate becomes one of the place: a pendulum's of that span
    /// (s).
    pub moment: f64,
    /// (kg)
    mass: f64,
}

impl ElasticScales {
    pub(crate) fn of(frame: &Frame) -> Self {
        let (span, stance) = (frame.span(), frame.stance());
        let length = if stance > 0.0 { 0.5 * stance } else { span / 16.0 };
        Self { length, span, moment: (span / GRAVITY).sqrt(), mass: frame.total_mass() }
    }

    /// What each coordinate is multiplied with to be a displacement.
    pub(crate) fn lengths(&self, model: &ElasticModel) -> Vec<f64> {
        let mut lengths = vec![1.0; model.size];
        for th in (0..model.frame.nodes()).filter_map(|node| model.frame.coordinates(node)[2]) {
            lengths[th] = self.span;
        }
        lengths
    }
}

impl SpringsRun<'_> {
    /// Book the step if the account closes well enough and little is missed; choose the next step's
    /// size.
    pub(crate) fn account(&mut self, s: &ElasticStages) -> bool {
        let stored = self.model.energy(&s.q[2], &s.v[2], &self.feet);
        let [input, dissipated] = self.stepper.work(&self.feet, &self.here, s, &mut self.impulses);
        let missed = self.missed(s);
        let defect = (stored - self.energy.stored - input + dissipated).abs();
        let tried = TriedStep { h: s.h, planned: self.h, settling: self.settling };
        let allowed = [self.allowed(stored, s), self.allowed_error(s.h)];
        if !tried.holds([defect, missed], allowed, (&mut self.h, &mut self.work)) {
            return false;
        }
        self.q.copy_from_slice(&s.q[2]);
        self.v.copy_from_slice(&s.v[2]);
        self.energy.book(stored, input, dissipated);
        self.scale = self.energy.largest(self.scale);
        self.rate = cautious(s.rate);
        true
    }

    /// What the step misses.
    fn missed(&mut self, s: &ElasticStages) -> f64 {
        let [place, momentum] =
            self.stepper.local_error([&self.q, &self.v], &self.feet, &self.here, s);
        place.max(momentum / self.scales.mass * self.scales.moment) / self.scales.length
    }

    /// What that error may be; never less than rounding makes of it.
    fn allowed_error(&self, h: f64) -> f64 {
        let rounding = 8.0 * f64::EPSILON * self.scales.span * (1.0 + self.scales.moment / h)
            / self.scales.length;
        allowed_error(self.control.tolerance).max(rounding)
    }

    /// Energy that this step may lose or gain (J).
    fn allowed(&self, stored: f64, s: &ElasticStages) -> f64 {
        allowed_energy(self.control.tolerance * self.scale, &self.energy, stored)
            .max(self.places(s))
    }

    /// Energy that comes and goes as places are rounded (J): a few units in their last digit times
    /// the force.
    fn places(&self, s: &ElasticStages) -> f64 {
        let (mut place, mut acceleration) = (0.0_f64, 0.0_f64);
        for (k, length) in self.stepper.lengths.iter().enumerate().take(self.model.n) {
            place = place.max((s.q[2][k] * length).abs());
            acceleration = acceleration.max((s.a[2][k] * length).abs());
        }
        16.0 * f64::EPSILON * place * self.scales.mass * (acceleration + GRAVITY)
    }
}
