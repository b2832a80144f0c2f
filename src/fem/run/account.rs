//! Step acceptance: by the energy account, and by the embedded estimate of the local error.

use super::Run;
use crate::{
    fem::{
        model::{Model, State, TH, X, Z},
        step::Stages,
    },
    scalar::{GRAVITY, Scalar},
};

/// The energy that all steps together may lose or gain, in units of `Control::tolerance`.
const BUDGET: f64 = 50.0;

/// The local error that a step may have at a tolerance of one. Found on histories of El Centro (61 m frame at 160 Hz to 20 kHz,
/// two blocks): ten times more and their error no longer follows the tolerance, ten times less and it costs twice the steps.
const ERROR: f64 = 0.1;

/// What a step's local error may be at a tolerance, but for rounding. The estimate falls as h^4, the energy that a step loses as h^6:
/// with the power 2/3 both criteria ask for the same steps whatever the tolerance.
pub(super) fn allowed_error(tolerance: f64) -> f64 {
    ERROR * tolerance.powf(2.0 / 3.0)
}

/// x^(1/6), up to 0.81 % too large: a tenth is left for it and for more. Infinite where a step would grow beyond any use anyway.
fn sixth_root(x: f64) -> f64 {
    if x > 1e5 {
        return f64::INFINITY;
    }
    // a sixth of the exponent, and of the mantissa, which serves as its logarithm; then one step of Newton's method
    let near = f64::from_bits(x.to_bits() / 6 + 1.0_f64.to_bits() / 6 * 5);
    let cube = near * near * near;
    near * (5.0 / 6.0) + x / (6.0 * cube * near * near)
}

/// What a step does, measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepMeasures<S> {
    /// Energy stored at its end [J].
    pub stored: S,
    /// Work of the base excitation and dissipation over it [J].
    pub input: S,
    pub dissipated: S,
    /// Its local error by the embedded formula: of the body's place over R alpha, and of its momentum over m p R alpha.
    pub missed: f64,
    pub contacts: Contacts,
}

/// What is known of the feet's contacts over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Contacts {
    Unknown,
    /// They stay what they are.
    Unchanged,
    /// The compressions of both feet's gaps at the step's start and stages [m].
    Gaps([[f64; 4]; 2]),
}

/// The scales of a local error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scales {
    pub radius: f64,
    /// The rotation's share of a momentum; none without inertia.
    pub share: f64,
    /// 1/p [s], the time in which an error of the rate becomes one of the lean.
    pub moment: f64,
    /// Lean of balance [rad].
    pub alpha: f64,
}

impl Scales {
    pub fn of<S: Scalar>(model: &Model<S>) -> Self {
        let body = &model.body;
        let radius = body.radius().re();
        let share = model.rotation.re() / (body.mass.re() * radius * radius);
        let moment = body.p_squared().re().sqrt().recip();
        Self { radius, share: share.min(1.0), moment, alpha: body.alpha().re() }
    }

    /// Of what a step misses.
    #[inline(always)]
    pub fn missed(&self, State { q, v }: &State<f64>) -> f64 {
        let place = q[X].abs().max(q[Z].abs()).max(q[TH].abs() * self.radius);
        let speed = v[X].abs().max(v[Z].abs()).max(v[TH].abs() * self.radius * self.share);
        place.max(speed * self.moment) / (self.radius * self.alpha)
    }
}

/// A step that may break its bounds, in units of 1/Omega_n.
const SMALLEST: f64 = 1e-9;

impl<S: Scalar> Run<'_, S> {
    /// What a step does to the account, and what it misses.
    pub(super) fn measure(&self, stages: &Stages<S>) -> StepMeasures<S> {
        let stored = self.model.energy(&stages.end(), &self.feet);
        let (input, dissipated) = stages.work(self.model, &self.feet, &self.here);
        let local = self.stepper.local_error(&self.state, &self.feet, &self.here, stages);
        StepMeasures { stored, input, dissipated, missed: self.scales.missed(&local), contacts: Contacts::Unknown }
    }

    /// Book the step if the account closes well enough and little is missed; choose the next step's size.
    pub(super) fn account(&mut self, stages: &Stages<S>, measures: &StepMeasures<S>) -> bool {
        let end = stages.end();
        let &StepMeasures { stored, input, dissipated, missed, .. } = measures;
        let defect = (stored - self.energy.stored - input + dissipated).re().abs();
        let h = stages.h.re();
        let (energy, error) = (self.allowed(stored, stages) / defect, self.allowed_error(h) / missed);
        let finite = (defect + missed).is_finite();
        // a radau step loses energy as h^6, the estimate falls as h^4
        let factor = if finite { 0.9 * sixth_root(energy).min(error.sqrt().sqrt()) } else { 0.0 };
        if !finite || energy < 1.0 || error < 1.0 {
            // at a force discontinuity no step size satisfies the account: the smallest may break it, but not with a NaN
            if h > SMALLEST * self.settling || !finite {
                self.h = h * factor.clamp(0.1, 0.9);
                return false;
            }
            self.work.smallest += 1;
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
        self.guess = stages.a[2];
        let root = stages.rate.max(f64::EPSILON).sqrt();
        // with some caution: to the power 3/4
        self.rate = root * root.sqrt();
        true
    }

    /// What that error may be; never less than rounding makes of it.
    fn allowed_error(&self, h: f64) -> f64 {
        let rounding =
            self.rounding * (1.0 + self.scales.moment / h) / (self.scales.alpha * self.model.body.half_width.re());
        self.error.max(rounding)
    }

    /// Energy that this step may lose or gain [J]: less and less as the account's budget is used up, so that the residual
    /// stays within it however long the history; never less than rounding makes of it.
    fn allowed(&self, stored: S, stages: &Stages<S>) -> f64 {
        let most = self.control.tolerance * self.scale;
        let left = (1.0 - self.energy.residual().re().abs() / (BUDGET * most)).max(0.0);
        let entries = [stored, self.energy.input, self.energy.dissipated, self.energy.released];
        let rounding = entries.iter().map(|e| e.re().abs()).fold(0.0, f64::max) * (32.0 * f64::EPSILON);
        (most * left.powi(4)).max(rounding).max(self.places(stages))
    }

    /// Energy that comes and goes as places are rounded [J]: a few units in their last digit times the force. On stiff springs under
    /// a body far from where it stood, a smaller step does not lose less.
    fn places(&self, stages: &Stages<S>) -> f64 {
        let (q, a) = (&stages.q[2], &stages.a[2]);
        let place = q[X].re().abs() + q[Z].re().abs() + q[TH].re().abs() * self.model.body.radius().re();
        let force = self.model.translation.re() * (a[X].re().abs() + a[Z].re().abs() + GRAVITY);
        4.0 * f64::EPSILON * place * force
    }
}

#[cfg(test)]
mod tests {
    use super::sixth_root;

    #[test]
    fn the_sixth_root_is_one() {
        for i in -600..=49 {
            let x = 10.0_f64.powf(f64::from(i) * 0.1);
            let exact = x.powf(1.0 / 6.0);
            assert!((0.0..8.1e-3).contains(&(sixth_root(x) / exact - 1.0 + 1e-15)), "{x}");
        }
        assert!(sixth_root(0.0) < 1e-40 && sixth_root(f64::INFINITY) == f64::INFINITY);
    }
}
