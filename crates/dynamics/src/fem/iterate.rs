//! What every simplified Newton iteration of a Radau step shares, whatever the model: the ground
//! along the step, stages, the change to the eigenvectors of A and back, and when it has converged.

use num_complex::Complex;

use super::radau::{A, A2, ALPHA, BETA, C, E, T, T_INV};

/// Iterations before a step counts as diverged.
const MOST_ITERATIONS: usize = 12;

/// Ground acceleration along a step, horizontal and vertical, by powers of the time since its
/// start.
#[derive(Clone, Copy, Debug)]
pub struct Ground {
    /// (m/s2)
    pub start: [f64; 2],
    /// [m/s3]
    pub slope: [f64; 2],
    /// [m/s4]; zero between two samples.
    pub curve: [f64; 2],
}

impl Ground {
    /// Ground at rest.
    pub fn still() -> Self {
        let none = [0.0; 2];
        Self { start: none, slope: none, curve: none }
    }

    /// At a share of a time h (s) after the start.
    #[inline(always)]
    pub fn after(&self, h: f64, share: f64) -> [f64; 2] {
        let at = |k: usize| self.start[k] + (self.slope[k] + self.curve[k] * h * share) * h * share;
        [at(0), at(1)]
    }

    /// The same between two samples, from a later time on (s).
    pub fn from(&self, time: f64) -> Self {
        Self { start: self.after(time, 1.0), ..*self }
    }
}

/// The simplified Newton iteration of one step: how far it is, and whether it has arrived.
#[derive(Clone, Copy, Debug)]
pub struct Convergence {
    /// Iterations taken.
    pub iterations: usize,
    /// Factor by which an iteration reduced the error, measured if there were two.
    pub rate: f64,
    /// The last correction (m).
    last: f64,
    converged: bool,
    tolerance: f64,
    rounding: f64,
}

/// What becomes of an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IterationVerdict {
    /// Another iteration is needed.
    GoesOn,
    /// The correction no longer matters.
    Converged,
    /// It does not converge.
    Failed,
}

impl Convergence {
    /// For corrections below `tolerance` (m), or what rounding makes of them (m). An iteration is
    /// expected to reduce the error by `rate`, 1 if unknown.
    pub fn new(tolerance: f64, rounding: f64, rate: f64) -> Self {
        Self { iterations: 0, rate, last: f64::INFINITY, converged: false, tolerance, rounding }
    }

    /// Whether another iteration is to be made.
    #[inline(always)]
    pub fn verdict(&self) -> IterationVerdict {
        if self.converged {
            IterationVerdict::Converged
        } else if self.iterations == MOST_ITERATIONS {
            IterationVerdict::Failed
        } else {
            IterationVerdict::GoesOn
        }
    }

    /// No more of it.
    pub(crate) fn give_up(&mut self) {
        self.iterations = MOST_ITERATIONS;
    }

    /// Take note of an iteration that moved the body by `change` (m); false if it diverges.
    #[inline(always)]
    #[must_use]
    pub fn moved(&mut self, change: f64) -> bool {
        self.iterations += 1;
        // as far as rounding lets it, what is left may well grow
        let rounded = self.iterations > 5 && change <= self.rounding;
        let grows = !rounded && self.iterations > 3 && change > 2.0 * self.last;
        if !change.is_finite() || grows {
            return false;
        }
        // geometric convergence: what is still missing is change * rate / (1 - rate)
        if self.last.is_finite() {
            self.rate = (change / self.last).min(1.0);
        }
        let missing =
            if self.rate < 1.0 { change * self.rate / (1.0 - self.rate) } else { f64::INFINITY };
        self.last = change;
        self.converged = rounded || change <= self.tolerance || missing <= self.tolerance;
        true
    }
}

/// Place and velocity of coordinate k at stage i, from the accelerations at all stages.
#[inline(always)]
pub fn stage(i: usize, (q, v): (f64, f64), [a0, a1, a2]: [f64; 3], h: f64) -> (f64, f64) {
    let ([b0, b1, b2], [d0, d1, d2]) = (A2[i], A[i]);
    (
        q + (v * (h * C[i]) + (a0 * b0 + a1 * b1 + a2 * b2) * (h * h)),
        v + (a0 * d0 + a1 * d1 + a2 * d2) * h,
    )
}

/// The residuals of a coordinate at the stages in the eigenvectors of A: the real one, and one of
/// the pair.
#[inline(always)]
pub fn modes([a, b, c]: [f64; 3]) -> (f64, Complex<f64>) {
    let mode = |row: usize| a * T_INV[row][0] + b * T_INV[row][1] + c * T_INV[row][2];
    (mode(0), Complex::new(mode(1), -mode(2)))
}

/// The corrections at the stages from those of the eigenvectors.
#[inline(always)]
pub fn from_modes(w0: f64, w1: Complex<f64>) -> [f64; 3] {
    let at = |[t0, t1, t2]: [f64; 3]| w0 * t0 + w1.re * t1 - w1.im * t2;
    [at(T[0]), at(T[1]), at(T[2])]
}

/// What an iteration's correction of a coordinate counts (m), with h^2: the largest coefficient of
/// A^2 is 0.32.
pub const LARGEST: f64 = 0.32;

/// sum E_i (x_i - x_0) of a coordinate's values at the stages and the start.
#[inline(always)]
pub fn embedded(stages: [f64; 3], start: f64) -> f64 {
    E[0] * (stages[0] - start) + E[1] * (stages[1] - start) + E[2] * (stages[2] - start)
}

/// ALPHA + i BETA.
pub const EIGENVALUE: Complex<f64> = Complex::new(ALPHA, BETA);
