//! Step acceptance by the energy account.

use super::Run;
use crate::{
    fem::step::{Ground, Stages},
    scalar::Scalar,
};

/// The energy that all steps together may lose or gain, in units of `Control::tolerance`.
const BUDGET: f64 = 500.0;

impl<S: Scalar> Run<'_, S> {
    /// Book the step if the account closes well enough; choose the next step's size.
    pub(super) fn account(&mut self, stages: &Stages<S>, ground: &Ground<S>) -> bool {
        let end = stages.end();
        let stored = self.model.energy(&end, &self.feet);
        let (input, dissipated) = stages.work(self.model, &self.feet, ground);
        let defect = (stored - self.energy.stored - input + dissipated).re().abs();
        let allowed = self.allowed(stored);
        // a radau step loses energy as h^6
        let factor = 0.9 * (allowed / defect.max(1e-300)).sqrt().cbrt();
        let h = stages.h.re();
        // at a force discontinuity no step size satisfies the account: the smallest may break it, but not with a NaN
        let acceptable = defect <= allowed || (h <= 1e-9 * self.settling && defect.is_finite());
        if !acceptable {
            self.h = h * factor.clamp(0.1, 0.9);
            return false;
        }
        self.work.steps += 1;
        let next = h * factor.clamp(0.2, 5.0);
        // a step cut short by a sample or an event does not refute the size that was planned
        self.h = if h < 0.9 * self.h && self.h.is_finite() { next.max(self.h) } else { next };
        self.state = end;
        self.energy.stored = stored;
        self.energy.input += input;
        self.energy.dissipated += dissipated;
        self.scale = self.scale.max(self.energy.input.re().abs()).max((stored - self.energy.initial).re().abs());
        self.guess = [stages.a[2]; 3];
        let root = stages.rate.max(f64::EPSILON).sqrt();
        // with some caution: to the power 3/4
        self.rate = root * root.sqrt();
        true
    }

    /// Energy that this step may lose or gain [J]: less and less as the account's budget is used up, so that the residual
    /// stays within it however long the history; never less than rounding makes of it.
    fn allowed(&self, stored: S) -> f64 {
        let most = self.control.tolerance * self.scale;
        let left = (1.0 - self.energy.residual().re().abs() / (BUDGET * most)).max(0.0);
        let entries = [stored, self.energy.input, self.energy.dissipated, self.energy.released];
        let rounding = entries.iter().map(|e| e.re().abs()).fold(0.0, f64::max) * (32.0 * f64::EPSILON);
        (most * left.powi(4)).max(rounding)
    }
}
