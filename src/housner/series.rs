//! One Taylor step of Housner's equation.
//!
//! With the lean w = |theta| and psi = alpha - w, equations (1) and (3) are the same on both sides of the body:
//!
//! ```text
//! w'' = -p^2 [ sin psi + b cos psi ],   b = s u_g/g,   s = sgn(theta)
//! ```
//!
//! Time runs as x = (t - t0)/h from 0 to 1 over the step, in which b = b0 + db x (the record is linear between samples).
//! With S = sin psi, C = cos psi and w = sum c_k x^k, and because psi' = -w':
//!
//! ```text
//! k S_k = -sum_{j=1..k} j c_j C_{k-j},   k C_k = sum_{j=1..k} j c_j S_{k-j}
//! (k+2)(k+1) c_{k+2} = -p^2 h^2 [ S_k + b0 C_k + db C_{k-1} ]
//! ```

use crate::scalar::{Scalar, real};

/// Coefficients of a step in a slow motion, as of a tall body at a fine time step.
pub const SHORT: usize = 9;
/// Coefficients of a step in a fast motion, and of every step with an event.
pub const LONG: usize = 17;

/// What a truncated term may be, relative to the motion within the step: below the rounding of f64.
const TAIL: f64 = 1e-17;

/// Start of a step.
#[derive(Clone, Copy)]
pub struct Start<S> {
    /// Lean w = |theta| (rad).
    pub w: S,
    /// w' (rad/s).
    pub rate: S,
    /// sin(alpha - w).
    pub sin: S,
    /// cos(alpha - w).
    pub cos: S,
}

/// The lean over one step as a power series of N coefficients in x = (t - t0)/h.
#[derive(Clone, Copy)]
pub struct Series<S, const N: usize> {
    /// c_0 to c_{N-1} (rad).
    pub c: [S; N],
    /// A bound of |c_{k+2}/c_k| for k near N. The equation's part linear in w gives q (1 + |b|)/k^2, its
    /// trigonometric part c_1^2/k^2; one 1/k is kept in reserve.
    growth: f64,
}

impl<S: Scalar, const N: usize> Series<S, N> {
    /// The series of a step of length h (s); b0 and db are b and its change over the step, q = p^2 h^2.
    #[inline(always)]
    pub fn new(start: &Start<S>, h: S, b0: S, db: S, q: S) -> Self {
        let mut c = [S::zero(); N];
        // jc[j] = j c_j
        let mut jc = [S::zero(); N];
        let (mut sin, mut cos) = ([start.sin; N], [start.cos; N]);
        c[0] = start.w;
        c[1] = start.rate * h;
        jc[1] = c[1];
        let q = -q;
        c[2] = q * 0.5 * (sin[0] + b0 * cos[0]);
        jc[2] = c[2] * 2.0;
        for k in 1..N - 2 {
            let (mut s, mut co) = (jc[1] * cos[k - 1], jc[1] * sin[k - 1]);
            for j in 2..=k {
                s += jc[j] * cos[k - j];
                co += jc[j] * sin[k - j];
            }
            sin[k] = s * (-1.0 / k as f64);
            cos[k] = co * (1.0 / k as f64);
            // (1), (3)
            let force = q * (sin[k] + b0 * cos[k] + db * cos[k - 1]);
            jc[k + 2] = force * (1.0 / (k + 1) as f64);
            c[k + 2] = force * (1.0 / ((k + 1) * (k + 2)) as f64);
        }
        let growth = (c[1].re() * c[1].re() - q.re() * (1.0 + b0.re().abs() + db.re().abs())) / N as f64;
        Self { c, growth }
    }

    /// c_1 + c_2 + ...: the change of w over the whole step.
    #[inline(always)]
    pub fn change(&self) -> S {
        let mut sum = self.c[N - 1];
        for k in (1..N - 1).rev() {
            sum += self.c[k];
        }
        sum
    }

    /// dw/dx at x = 1.
    #[inline(always)]
    pub fn end_slope(&self) -> S {
        let mut sum = self.c[N - 1] * (N - 1) as f64;
        for k in (1..N - 1).rev() {
            sum += self.c[k] * k as f64;
        }
        sum
    }

    /// w and dw/dx at x.
    pub fn at(&self, x: S) -> (S, S) {
        let (mut w, mut slope) = (self.c[N - 1], S::zero());
        for k in (0..N - 1).rev() {
            slope = slope * x + w;
            w = w * x + self.c[k];
        }
        (w, slope)
    }

    /// Whether the truncated terms are below rounding over the whole step.
    #[inline(always)]
    pub fn is_converged(&self) -> bool {
        let c = |k: usize| self.c[k].re().abs();
        // from the last two terms: every second one may vanish by symmetry
        c(N - 2).max(c(N - 1)) * self.growth * N as f64 <= TAIL * self.size()
    }

    /// The fraction of the step over which the truncated terms are below rounding; at most 1.
    pub fn reach(&self) -> f64 {
        let size = TAIL * self.size() / N as f64;
        let mut reach = 1.0_f64;
        for k in [N - 2, N - 1] {
            let truncated = self.c[k].re().abs() * self.growth;
            if truncated > size {
                reach = reach.min((size / truncated).powf(1.0 / (k + 2) as f64));
            }
        }
        reach.max(1e-3)
    }

    /// Shorten the step to a fraction of it.
    pub fn shorten(&mut self, fraction: f64) {
        let mut power = 1.0;
        for c in &mut self.c[1..] {
            power *= fraction;
            *c *= real::<S>(power);
        }
    }

    /// Real parts of the coefficients.
    pub fn re(&self) -> [f64; N] {
        self.c.map(|c| c.re())
    }

    fn size(&self) -> f64 {
        let c = |k: usize| self.c[k].re().abs();
        c(1) + c(2) + c(3)
    }

    /// A bound of |c_1| + |c_2| + ...: while w exceeds it the lean cannot vanish within the step.
    #[inline(always)]
    pub fn swing(&self) -> f64 {
        let mut sum = 0.0;
        for c in &self.c[1..] {
            sum += c.re().abs();
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn start(alpha: f64, w: f64, rate: f64) -> Start<f64> {
        let (sin, cos) = (alpha - w).sin_cos();
        Start { w, rate, sin, cos }
    }

    /// w'' of the series against the right hand side, at points of the step.
    #[test]
    fn the_series_satisfies_housners_equation_inside_the_step() {
        let (alpha, h, p2, b0, db) = (0.2, 0.05, 2.9, 0.15, -0.4);
        let series = Series::<_, SHORT>::new(&start(alpha, 0.07, 0.3), h, b0, db, p2 * h * h);
        for x in [0.0, 0.05, 0.1] {
            let (w, _) = series.at(x);
            let second: f64 = (2..SHORT).map(|k| (k * (k - 1)) as f64 * series.c[k] * f64::powi(x, k as i32 - 2)).sum();
            let force = -p2 * ((alpha - w).sin() + (b0 + db * x) * (alpha - w).cos());
            assert_relative_eq!(second / (h * h), force, max_relative = 1e-12);
        }
    }

    /// Two half steps against one whole step: the truncated terms are where `reach` says they are.
    #[test]
    fn two_half_steps_agree_with_a_whole_step_to_rounding() {
        let (alpha, h, p2, b0, db) = (0.2, 0.005, 2.9, 0.15, -0.05);
        let whole = Series::<_, SHORT>::new(&start(alpha, 0.07, 0.3), h, b0, db, p2 * h * h);
        assert!(whole.is_converged());
        let k = h / 2.0;
        let first = Series::<_, SHORT>::new(&start(alpha, 0.07, 0.3), k, b0, db / 2.0, p2 * k * k);
        let (w, rate) = (first.at(1.0).0, first.end_slope() / k);
        let second = Series::<_, SHORT>::new(&start(alpha, w, rate), k, b0 + db / 2.0, db / 2.0, p2 * k * k);
        assert_relative_eq!(second.at(1.0).0, whole.at(1.0).0, max_relative = 1e-15);
        assert_relative_eq!(second.end_slope() / k, whole.end_slope() / h, max_relative = 1e-14);
    }
}
