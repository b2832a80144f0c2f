//! Step acceptance by the energy account and by the embedded estimate of the local error: what runs
//! of rigid bodies and of elastic frames share.

use super::{control::Work, energy::Energy};

/// The energy that all steps together may lose or gain, in units of `Control::tolerance`.
const BUDGET: f64 = 50.0;

/// The local error that a step may have at a tolerance of one. Found on histories of El Centro (61
/// m frame at 160 Hz to 20 kHz, two blocks): ten times more and their error no longer follows the
/// tolerance, ten times less and it costs twice the steps.
const ERROR: f64 = 0.1;

/// A step that may break its bounds, in units of 1/Omega_n.
const SMALLEST: f64 = 1e-9;

/// What a step's local error may be at a tolerance, but for rounding. The estimate falls as h^4,
/// the energy that a step loses as h^6: with the power 2/3 both criteria ask for the same steps
/// whatever the tolerance.
pub fn allowed_error(tolerance: f64) -> f64 {
    ERROR * tolerance.powf(2.0 / 3.0)
}

/// Energy that a step to this much stored may lose or gain (J), at an energy allowed to one step:
/// less and less as the account's budget is used up, so that the residual stays within it however
/// long the history; never less than rounding makes of it.
#[inline(always)]
pub fn allowed_energy(most: f64, account: &Energy, stored: f64) -> f64 {
    let left = (1.0 - account.residual().abs() / (BUDGET * most)).max(0.0);
    let entries = [stored, account.input, account.dissipated, account.released];
    let rounding = entries.iter().map(|e| e.abs()).fold(0.0, f64::max) * (32.0 * f64::EPSILON);
    (most * left.powi(4)).max(rounding)
}

/// A step of size h (s) where one of `planned` was asked for.
#[derive(Clone, Copy, Debug)]
pub struct TriedStep {
    /// Size of the step (s).
    pub h: f64,
    /// Size that was planned, before an event cut it (s).
    pub planned: f64,
    /// 1/Omega_n (s).
    pub settling: f64,
}

/// What becomes of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum StepVerdict {
    /// To be tried again with this size (s).
    Refused(f64),
    /// It holds.
    Holds {
        /// The size to go on with (s).
        next: f64,
        /// Whether it breaks its bounds, as the smallest of steps.
        breaks: bool,
    },
}

impl TriedStep {
    /// By what it misses of energy and by its local error, and what these may be.
    #[inline(always)]
    fn verdict(&self, missed: [f64; 2], allowed: [f64; 2]) -> StepVerdict {
        let &Self { h, planned, settling } = self;
        let (energy, error) = (allowed[0] / missed[0], allowed[1] / missed[1]);
        let finite = (missed[0] + missed[1]).is_finite();
        // a radau step loses energy as h^6, the estimate falls as h^4
        let factor = if finite { 0.9 * sixth_root(energy).min(error.sqrt().sqrt()) } else { 0.0 };
        let missed = !finite || energy < 1.0 || error < 1.0;
        // at a force discontinuity no step size satisfies the account: the smallest may break it,
        // but not with a NaN
        if missed && (h > SMALLEST * settling || !finite) {
            return StepVerdict::Refused(h * factor.clamp(0.1, 0.9));
        }
        let next = h * factor.clamp(0.2, 5.0);
        // a step cut short by a sample or an event does not refute the size that was planned
        let next = if h < 0.9 * planned && planned.is_finite() { next.max(planned) } else { next };
        StepVerdict::Holds { next, breaks: missed }
    }

    /// Whether it holds: counted, and the size to go on with.
    #[inline(always)]
    pub fn holds(
        &self,
        missed: [f64; 2],
        allowed: [f64; 2],
        (h, work): (&mut f64, &mut Work),
    ) -> bool {
        match self.verdict(missed, allowed) {
            StepVerdict::Refused(next) => {
                *h = next;
                false
            }
            StepVerdict::Holds { next, breaks } => {
                *h = next;
                work.smallest += usize::from(breaks);
                work.steps += 1;
                true
            }
        }
    }
}

/// The factor by which an iteration of the next step is expected to reduce the error, from this
/// step's: with some caution, to the power 3/4.
#[inline]
pub fn cautious(rate: f64) -> f64 {
    let root = rate.max(f64::EPSILON).sqrt();
    root * root.sqrt()
}

/// x^(1/6), up to 0.81 % too large: a tenth is left for it and for more. Infinite where a step
/// would grow beyond any use anyway.
#[inline]
fn sixth_root(x: f64) -> f64 {
    if x > 1e5 {
        return f64::INFINITY;
    }
    // a sixth of the exponent, and of the mantissa, which serves as its logarithm; then one step of
    // Newton's method
    let near = f64::from_bits(x.to_bits() / 6 + 1.0_f64.to_bits() / 6 * 5);
    let cube = near * near * near;
    near * (5.0 / 6.0) + x / (6.0 * cube * near * near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sixth_root_is_one() {
        for i in -600..=49 {
            let x = 10.0_f64.powf(f64::from(i) * 0.1);
            let exact = x.powf(1.0 / 6.0);
            assert!((0.0..8.1e-3).contains(&(sixth_root(x) / exact - 1.0 + 1e-15)), "{x}");
        }
        assert!(sixth_root(0.0) < 1e-40 && sixth_root(f64::INFINITY) == f64::INFINITY);
    }

    #[test]
    fn a_step_that_misses_too_much_is_refused_unless_it_is_the_smallest() {
        let tried = TriedStep { h: 1e-3, planned: 1e-3, settling: 1.0 };
        let StepVerdict::Refused(next) = tried.verdict([2.0, 1e-9], [1.0, 1e-6]) else { panic!() };
        assert!((next / (1e-3 * 0.9 * 0.5_f64.powf(1.0 / 6.0)) - 1.0).abs() < 8.1e-3, "{next}");
        assert_eq!(tried.verdict([f64::NAN, 0.0], [1.0, 1.0]), StepVerdict::Refused(1e-4));
        let smallest = TriedStep { h: 1e-10, ..tried };
        assert!(matches!(
            smallest.verdict([2.0, 0.0], [1.0, 1.0]),
            StepVerdict::Holds { breaks: true, .. }
        ));
        // cut short by a sample: what was planned still holds
        let cut = TriedStep { h: 1e-4, ..tried };
        assert_eq!(
            cut.verdict([1.0, 1.0], [1.0, 1.0]),
            StepVerdict::Holds { next: 1e-3, breaks: false }
        );
    }
}
