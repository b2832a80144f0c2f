//! One Taylor step of Housner's equation.
//!
//! With the lean w = |theta| and psi = alpha - w, equations (1) and (3) are the same on both sides of the body:
//!
//! ```text
//! w'' = -p^2 [ sin psi + b cos psi ],   b = s u_g/g,   s = sgn(theta)
//! ```
//!
//! Time runs as x = (t - t0)/h from 0 to 1 over the step, in which b = b0 + db x (the record is linear between samples).
//! With w = sum c_k x^k, F = sin psi + b0 cos psi and G = cos psi - b0 sin psi (so that F and G belong to each other as sine and
//! cosine do), and because psi' = -w':
//!
//! ```text
//! k F_k = -sum_{j=1..k} j c_j G_{k-j},   k G_k = sum_{j=1..k} j c_j F_{k-j}
//! (k+2)(k+1) c_{k+2} = -p^2 h^2 [ F_k + db C_{k-1} ],   C = cos psi = (G + b0 F)/(1 + b0^2)
//! ```

#![allow(clippy::needless_range_loop)] // indices with constant bounds let the compiler unroll early, and run lanes side by side

use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::scalar::{Scalar, real};

/// Coefficients of a step in a very slow motion, as of a tower at a fine time step.
pub const LEAST: usize = 8;
/// Coefficients of a step in a slow motion, as of a tall body at a fine time step.
pub const SHORT: usize = 9;
/// Coefficients of a step in a fast motion, and of every step with an event.
pub const LONG: usize = 17;

/// What a truncated term may be, relative to the motion within the step: below the rounding of f64.
const TAIL: f64 = 3e-17;

/// What the recurrences need of a number: a `Scalar`, or several numbers in lock-step.
pub trait Field:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
}

impl<T> Field for T where
    T: Copy
        + Add<Output = T>
        + Sub<Output = T>
        + Mul<Output = T>
        + Div<Output = T>
        + Neg<Output = T>
        + Add<f64, Output = T>
        + Sub<f64, Output = T>
        + Mul<f64, Output = T>
{
}

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

/// What the force at order k - 2 is multiplied by to give c_k: -q/(k (k - 1)), q = p^2 h^2.
#[inline(always)]
pub fn pulls<T: Field, const N: usize>(q: T) -> [T; N] {
    let minus_q = -q;
    let mut pulls = [minus_q; N];
    for k in 2..N {
        pulls[k] = minus_q * (1.0 / (k * (k - 1)) as f64);
    }
    pulls
}

/// c_0 to c_{N-1} of a step of length h (s); b0 and db are b and its change over the step, `pulls` those of its q.
///
/// What the term before has only just given (c_k, F_{k-1}, G_{k-1}) enters each sum last: the terms then follow each other at the
/// latency of a few operations, not of whole sums.
#[inline(always)]
pub fn coefficients<T: Field, const N: usize>(start: &Start<T>, h: T, b0: T, db: T, pulls: &[T; N]) -> [T; N] {
    let dg = db / (b0 * b0 + 1.0);
    let df = dg * b0;
    let mut f = [start.sin + b0 * start.cos; N];
    let mut g = [start.cos - b0 * start.sin; N];
    let mut c = [start.w; N];
    c[1] = start.rate * h;
    c[2] = f[0] * pulls[2]; // (1), (3)
    f[1] = -(c[1] * g[0]);
    g[1] = c[1] * f[0];
    c[3] = (f[1] + db * start.cos) * pulls[3];
    // jc[j] = j c_j
    let mut jc = [c[1]; N];
    jc[2] = c[2] * 2.0;
    jc[3] = c[3] * 3.0;
    for k in 2..N - 2 {
        let reciprocal = 1.0 / k as f64;
        let first = c[1] * reciprocal;
        let (mut sum_f, mut sum_g) = (first * g[k - 1], first * f[k - 1]);
        if k > 2 {
            let (mut mid_f, mut mid_g) = (jc[2] * g[k - 2], jc[2] * f[k - 2]);
            // constant bounds, and `if` inside, so that loops are unrolled early enough to run lanes side by side
            for j in 3..N {
                if j < k {
                    mid_f = mid_f + jc[j] * g[k - j];
                    mid_g = mid_g + jc[j] * f[k - j];
                }
            }
            sum_f = mid_f * reciprocal + sum_f;
            sum_g = mid_g * reciprocal + sum_g;
        }
        f[k] = -(c[k] * g[0] + sum_f);
        g[k] = c[k] * f[0] + sum_g;
        let force = f[k] + (dg * g[k - 1] + df * f[k - 1]);
        c[k + 2] = force * pulls[k + 2]; // (1), (3)
        jc[k + 2] = c[k + 2] * (k + 2) as f64;
    }
    c
}

/// Sine and cosine of an angle smaller by `change`; to 2e-17 while |change| < [`SMALL`].
#[inline(always)]
pub fn turned<T: Field>(sin: T, cos: T, change: T) -> (T, T) {
    let x2 = change * change;
    let x4 = x2 * x2;
    let s = change * ((x2 * (-1.0 / 6.0) + 1.0) + x4 * (x2 * (-1.0 / 5040.0) + 1.0 / 120.0));
    let versine = x2 * ((x2 * (-1.0 / 24.0) + 0.5) + x4 * (1.0 / 720.0));
    (sin - (sin * versine + cos * s), cos - (cos * versine - sin * s))
}

/// The largest change of angle that [`turned`] takes (rad).
pub const SMALL: f64 = 0.03;

/// c_1 + c_2 + ... at x = 1: the change of w over the whole step.
#[inline(always)]
pub fn change<T: Field, const N: usize>(c: &[T; N]) -> T {
    let mut sum = c[2];
    for k in 3..N {
        sum = sum + c[k];
    }
    c[1] + sum
}

/// dw/dx at x = 1.
#[inline(always)]
pub fn end_slope<T: Field, const N: usize>(c: &[T; N]) -> T {
    let mut sum = c[2] * 2.0;
    for k in 3..N {
        sum = sum + c[k] * k as f64;
    }
    c[1] + sum
}

/// sum c_k x^k and its derivative. Even and odd powers go apart, so that half as many operations wait for each other.
#[inline(always)]
pub fn value_and_slope<S: Scalar, const N: usize>(c: &[S; N], x: S) -> (S, S) {
    let x2 = x * x;
    let mut value = [S::zero(); 2];
    let mut slope = [S::zero(); 2];
    for k in (0..N).rev() {
        value[k % 2] = value[k % 2] * x2 + c[k];
        if k > 0 {
            slope[(k - 1) % 2] = slope[(k - 1) % 2] * x2 + c[k] * k as f64;
        }
    }
    (value[0] + value[1] * x, slope[0] + slope[1] * x)
}

/// Real parts of the coefficients.
#[inline(always)]
pub fn real_parts<S: Scalar, const N: usize>(c: &[S; N]) -> [f64; N] {
    // not `map`, which is a call of its own for many coefficients
    let mut re = [0.0; N];
    for k in 0..N {
        re[k] = c[k].re();
    }
    re
}

/// The lean over one step as a power series of N coefficients in x = (t - t0)/h.
#[derive(Clone, Copy)]
pub struct Series<S, const N: usize> {
    /// c_0 to c_{N-1} (rad).
    pub c: [S; N],
    growth: f64,
    size: f64,
}

/// A bound of k |c_{k+2}/c_k| for k near N. The equation's part linear in w gives q (1 + |b|)/k^2, its trigonometric part
/// c_1^2/k^2; one 1/k is kept in reserve.
#[inline(always)]
fn growth<const N: usize>(c: &[f64; N], b0: f64, db: f64, q: f64) -> f64 {
    c[1] * c[1] + q * (1.0 + b0.abs() + db.abs())
}

/// What truncated terms are measured against: the change of the lean within the step, or where it turns, that within a time
/// h at its natural rate p w; root = p h.
#[inline(always)]
fn size<const N: usize>(c: &[f64; N], root: f64) -> f64 {
    c[1].abs() + c[2].abs() + c[3].abs() + root * c[0].abs()
}

/// Whether one step takes the whole interval: the truncated terms are below rounding, the lean does not vanish, and passes neither
/// alpha nor the flat ground at its end w. With the least number of coefficients a motion smaller than a hundredth of alpha counts as
/// one of that size. root = p h, q = root^2.
#[inline(always)]
pub fn is_plain<const N: usize>(c: &[f64; N], b0: f64, db: f64, q: f64, root: f64, w: f64, alpha: f64) -> bool {
    // plain comparisons: a NaN among the coefficients is one in w, too
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    // from the last two terms: every second one may vanish by symmetry
    let last = larger(c[N - 2].abs(), c[N - 1].abs());
    let least = if N == LEAST { 0.01 * alpha } else { 0.0 };
    let converged = last * growth(c, b0, db, q) <= TAIL * (size(c, root) + least);
    // |w''| <= M lets the lean sag by M/8 below the line between its two ends; the small terms count as the last one does
    let mut small = 0.0;
    for k in 4..N {
        small += c[k].abs();
    }
    let sag = c[2].abs() * 0.25 + c[3].abs() * 0.75 + small * (((N - 1) * (N - 2)) as f64 / 8.0);
    // `&`, not `&&`: lanes are checked side by side
    converged & (c[0] > sag) & (w > sag) & (w < FRAC_PI_2) & ((w < alpha) | (c[0] >= alpha))
}

impl<S: Scalar, const N: usize> Series<S, N> {
    /// The series of a step of length h (s); b0 and db are b and its change over the step, q = p^2 h^2.
    #[inline(always)]
    pub fn new(start: &Start<S>, h: S, b0: S, db: S, q: S) -> Self {
        let c = coefficients(start, h, b0, db, &pulls(q));
        let re = real_parts(&c);
        let (growth, size) = (growth(&re, b0.re(), db.re(), q.re()), size(&re, q.re().sqrt()));
        Self { c, growth, size }
    }

    /// The change of w over the whole step.
    #[inline(always)]
    pub fn change(&self) -> S {
        change(&self.c)
    }

    /// dw/dx at x = 1.
    #[inline(always)]
    pub fn end_slope(&self) -> S {
        end_slope(&self.c)
    }

    /// w and dw/dx at x.
    pub fn at(&self, x: S) -> (S, S) {
        value_and_slope(&self.c, x)
    }

    /// The fraction of the step over which the truncated terms are below rounding; at most 1.
    pub fn reach(&self) -> f64 {
        let size = TAIL * self.size;
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
        real_parts(&self.c)
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
        assert_eq!(whole.reach(), 1.0);
        let k = h / 2.0;
        let first = Series::<_, SHORT>::new(&start(alpha, 0.07, 0.3), k, b0, db / 2.0, p2 * k * k);
        let (w, rate) = (first.at(1.0).0, first.end_slope() / k);
        let second = Series::<_, SHORT>::new(&start(alpha, w, rate), k, b0 + db / 2.0, db / 2.0, p2 * k * k);
        assert_relative_eq!(second.at(1.0).0, whole.at(1.0).0, max_relative = 1e-15);
        assert_relative_eq!(second.end_slope() / k, whole.end_slope() / h, max_relative = 1e-14);
    }
}
