//! Step acceptance by the energy account.

use super::Run;
use crate::{
    fem::step::{Ground, Stages},
    scalar::Scalar,
};

/// Least step that is tried unless the account has just refused a larger one, in units of 1/Omega_n: a step cut short by
/// an event says nothing of the next.
const RESTART: f64 = 0.1;

impl<S: Scalar> Run<'_, S> {
    /// Book the step if the account closes well enough; choose the next step's size.
    pub(super) fn account(&mut self, stages: &Stages<S>, ground: &Ground<S>) -> bool {
        let end = stages.end();
        let stored = self.model.energy(&end, &self.feet);
        let (input, dissipated) = stages.work(self.model, ground);
        let defect = (stored - self.energy.stored - input + dissipated).re().abs();
        let allowed = self.control.tolerance * self.scale;
        // a radau step loses energy as h^6
        let factor = 0.9 * (allowed / defect.max(1e-300)).powf(1.0 / 6.0);
        let h = stages.h.re();
        // at a force discontinuity no step size satisfies the account: the smallest may break it, but not with a NaN
        let acceptable = defect <= allowed || (h <= 1e-9 * self.settling && defect.is_finite());
        if !acceptable {
            self.h = h * factor.clamp(0.1, 0.9);
            return false;
        }
        self.work.steps += 1;
        self.h = (h * factor.clamp(0.2, 5.0)).max(RESTART * self.settling);
        self.state = end;
        self.energy.stored = stored;
        self.energy.input += input;
        self.energy.dissipated += dissipated;
        self.scale = self.scale.max(self.energy.input.re().abs()).max((stored - self.energy.initial).re().abs());
        self.guess = [stages.a[2]; 3];
        true
    }
}
