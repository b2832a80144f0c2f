//! Step acceptance: by the energy account, and by the embedded estimate of the local error (`fem/run/account.rs`).

use super::{model::Model, run::Run, step::Stages};
use crate::{elastic::frame::Frame, scalar::GRAVITY};

/// The energy that all steps together may lose or gain, in units of `Control::tolerance`.
const BUDGET: f64 = 50.0;

/// The local error that a step may have at a tolerance of one, in the units of [`Scales`]; it follows the tolerance as in
/// `fem/run/account.rs`.
const ERROR: f64 = 0.1;

/// A step that may break its bounds, in units of 1/Omega_n.
const SMALLEST: f64 = 1e-9;

/// x^(1/6); infinite where a step would grow beyond any use anyway.
fn sixth_root(x: f64) -> f64 {
    if x > 1e5 { f64::INFINITY } else { x.sqrt().cbrt() }
}

/// What errors are measured with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    /// Half the distance between the outer corners; of a frame without corners a sixteenth of its span [m].
    pub length: f64,
    pub span: f64,
    /// The time in which an error of the rate becomes one of the place: a pendulum's of that span [s].
    pub moment: f64,
    /// [kg]
    mass: f64,
}

impl Scales {
    pub fn of(frame: &Frame) -> Self {
        let (span, stance) = (frame.span(), frame.stance());
        let length = if stance > 0.0 { 0.5 * stance } else { span / 16.0 };
        Self { length, span, moment: (span / GRAVITY).sqrt(), mass: frame.total_mass() }
    }

    /// What each coordinate is multiplied with to be a displacement.
    pub fn lengths(&self, model: &Model) -> Vec<f64> {
        let mut lengths = vec![1.0; model.size];
        for th in (0..model.frame.nodes()).filter_map(|node| model.frame.coordinates(node)[2]) {
            lengths[th] = self.span;
        }
        lengths
    }
}

impl Run<'_> {
    /// Book the step if the account closes well enough and little is missed; choose the next step's size.
    pub fn account(&mut self, s: &Stages) -> bool {
        let stored = self.model.energy(&s.q[2], &s.v[2], &self.feet);
        let [input, dissipated] = self.stepper.work(&self.feet, &self.here, s, &mut self.impulses);
        let missed = self.missed(s);
        let defect = (stored - self.energy.stored - input + dissipated).abs();
        let h = s.h;
        let (energy, error) = (self.allowed(stored, s) / defect, self.allowed_error(h) / missed);
        let finite = (defect + missed).is_finite();
        // a radau step loses energy as h^6, the estimate falls as h^4
        let factor = if finite { 0.9 * sixth_root(energy).min(error.sqrt().sqrt()) } else { 0.0 };
        if !finite || energy < 1.0 || error < 1.0 {
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
        self.q.copy_from_slice(&s.q[2]);
        self.v.copy_from_slice(&s.v[2]);
        self.energy.stored = stored;
        self.energy.input += input;
        self.energy.dissipated += dissipated;
        self.scale = self.scale.max(self.energy.input.abs()).max((stored - self.energy.initial).abs());
        let root = s.rate.max(f64::EPSILON).sqrt();
        // with some caution: to the power 3/4
        self.rate = root * root.sqrt();
        true
    }

    /// What the step misses.
    fn missed(&mut self, s: &Stages) -> f64 {
        let [place, momentum] = self.stepper.local_error([&self.q, &self.v], &self.feet, &self.here, s);
        place.max(momentum / self.scales.mass * self.scales.moment) / self.scales.length
    }

    /// What that error may be; never less than rounding makes of it.
    fn allowed_error(&self, h: f64) -> f64 {
        let rounding = 8.0 * f64::EPSILON * self.scales.span * (1.0 + self.scales.moment / h) / self.scales.length;
        (ERROR * self.control.tolerance.powf(2.0 / 3.0)).max(rounding)
    }

    /// Energy that this step may lose or gain [J]: less and less as the account's budget is used up; never less than rounding makes of it.
    fn allowed(&self, stored: f64, s: &Stages) -> f64 {
        let most = self.control.tolerance * self.scale;
        let left = (1.0 - self.energy.residual().abs() / (BUDGET * most)).max(0.0);
        let entries = [stored, self.energy.input, self.energy.dissipated, self.energy.released];
        let rounding = entries.iter().map(|e| e.abs()).fold(0.0, f64::max) * (32.0 * f64::EPSILON);
        (most * left.powi(4)).max(rounding).max(self.places(s))
    }

    /// Energy that comes and goes as places are rounded [J]: a few units in their last digit times the force.
    fn places(&self, s: &Stages) -> f64 {
        let (mut place, mut acceleration) = (0.0_f64, 0.0_f64);
        for (k, length) in self.stepper.lengths.iter().enumerate().take(self.model.n) {
            place = place.max((s.q[2][k] * length).abs());
            acceleration = acceleration.max((s.a[2][k] * length).abs());
        }
        16.0 * f64::EPSILON * place * self.scales.mass * (acceleration + GRAVITY)
    }
}
