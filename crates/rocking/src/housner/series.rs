//! One Taylor step of Housner's equation.
//!
//! With the lean w = |theta| and psi = alpha - w, equations (1) and (3) are the same on both sides
//! of the body:
//!
//! ```text
//! w'' = -p^2 [ gamma sin psi + b cos psi ],   gamma = 1 + a_v/g,   b = s a_g/g,   s = sgn(theta)
//! ```
//!
//! Time runs as x = (t - t0)/h from 0 to 1 over the step, in which gamma = gamma0 + dgamma x and b
//! = b0 + db x (the record is linear between samples). With w = sum c_k x^k, F = gamma0 sin psi +
//! b0 cos psi and G = gamma0 cos psi - b0 sin psi (so that F and G belong to each other as sine and
//! cosine do), and because psi' = -w':
//!
//! ```text
//! k F_k = -sum_{j=1..k} j c_j G_{k-j},   k G_k = sum_{j=1..k} j c_j F_{k-j}
//! (k+2)(k+1) c_{k+2} = -p^2 h^2 [ F_k + dg G_{k-1} + df F_{k-1} ],   n = gamma0^2 + b0^2
//! dg = (db gamma0 - dgamma b0)/n,   df = (db b0 + dgamma gamma0)/n
//! ```
//!
//! Without vertical motion gamma0 = 1 and dgamma = 0, which `V`, whether there is any, tells the
//! compiler.

// indices with constant bounds let the compiler unroll early, and run lanes side by side
#![allow(clippy::needless_range_loop)]

use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::scalar::{Scalar, real};

/// Coefficients of a step in a very slow motion, as of a tower at a fine time step.
pub(crate) const LEAST: usize = 8;
/// Coefficients of a step in a slow motion, as of a tall body at a fine time step.
pub(crate) const SHORT: usize = 9;
/// Coefficients of a step in a fast motion, and of every step with an event.
pub(crate) const LONG: usize = 17;

/// What a truncated term may be, relative to the motion within the step: below the rounding of f64.
const TAIL: f64 = 3e-17;

/// What the recurrences need of a number: a `Scalar`, or several numbers in lock-step.
pub(crate) trait Field:
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
pub(crate) struct StepStart<S> {
    /// Lean w = |theta| (rad).
    pub w: S,
    /// w' (rad/s).
    pub rate: S,
    /// sin(alpha - w).
    pub sin: S,
    /// cos(alpha - w).
    pub cos: S,
}

/// The ground under a leaning body over a step: b and gamma at its start, and their changes over
/// it. Without vertical motion gamma is not looked at.
#[derive(Clone, Copy)]
pub(crate) struct StepGround<T> {
    pub b: T,
    pub db: T,
    pub gamma: T,
    pub dgamma: T,
}

impl<S: Scalar> StepGround<S> {
    /// Real parts.
    #[inline(always)]
    pub(crate) fn re(&self) -> StepGround<f64> {
        StepGround {
            b: self.b.re(),
            db: self.db.re(),
            gamma: self.gamma.re(),
            dgamma: self.dgamma.re(),
        }
    }
}

/// What the force at order k - 2 is multiplied by to give c_k: -q/(k (k - 1)), q = p^2 h^2.
#[inline(always)]
pub(crate) fn pulls<T: Field, const N: usize>(q: T) -> [T; N] {
    let minus_q = -q;
    let mut pulls = [minus_q; N];
    for k in 2..N {
        pulls[k] = minus_q * (1.0 / (k * (k - 1)) as f64);
    }
    pulls
}

/// c_0 to c_{N-1} of a step of length h (s), `pulls` those of its q.
///
/// What the term before has only just given (c_k, F_{k-1}, G_{k-1}) enters each sum last: the terms
/// then follow each other at the latency of a few operations, not of whole sums.
#[inline(always)]
pub(crate) fn coefficients<T: Field, const V: bool, const N: usize>(
    start: &StepStart<T>,
    h: T,
    ground: &StepGround<T>,
    pulls: &[T; N],
) -> [T; N] {
    let &StepGround { b: b0, db, gamma: gamma0, dgamma } = ground;
    let (dg, df) = if V {
        let n = gamma0 * gamma0 + b0 * b0;
        ((db * gamma0 - dgamma * b0) / n, (db * b0 + dgamma * gamma0) / n)
    } else {
        let dg = db / (b0 * b0 + 1.0);
        (dg, dg * b0)
    };
    let (sin, cos) =
        if V { (gamma0 * start.sin, gamma0 * start.cos) } else { (start.sin, start.cos) };
    let mut f = [sin + b0 * start.cos; N];
    let mut g = [cos - b0 * start.sin; N];
    let mut c = [start.w; N];
    c[1] = start.rate * h;
    c[2] = f[0] * pulls[2]; // (1), (3)
    f[1] = -(c[1] * g[0]);
    g[1] = c[1] * f[0];
    let push = if V { dgamma * start.sin + db * start.cos } else { db * start.cos };
    c[3] = (f[1] + push) * pulls[3];
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
            // constant bounds, and `if` inside, so that loops are unrolled early enough to run
            // lanes side by side
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
pub(crate) fn turned<T: Field>(sin: T, cos: T, change: T) -> (T, T) {
    let x2 = change * change;
    let x4 = x2 * x2;
    let s = change * ((x2 * (-1.0 / 6.0) + 1.0) + x4 * (x2 * (-1.0 / 5040.0) + 1.0 / 120.0));
    let versine = x2 * ((x2 * (-1.0 / 24.0) + 0.5) + x4 * (1.0 / 720.0));
    (sin - (sin * versine + cos * s), cos - (cos * versine - sin * s))
}

/// The largest change of angle that [`turned`] takes (rad).
pub(crate) const SMALL: f64 = 0.03;

/// c_1 + c_2 + ... at x = 1: the change of w over the whole step.
#[inline(always)]
pub(crate) fn change<T: Field, const N: usize>(c: &[T; N]) -> T {
    let mut sum = c[2];
    for k in 3..N {
        sum = sum + c[k];
    }
    c[1] + sum
}

/// dw/dx at x = 1.
#[inline(always)]
pub(crate) fn end_slope<T: Field, const N: usize>(c: &[T; N]) -> T {
    let mut sum = c[2] * 2.0;
    for k in 3..N {
        sum = sum + c[k] * k as f64;
    }
    c[1] + sum
}

/// sum c_k x^k and its derivative. Even and odd powers go apart, so that half as many operations
/// wait for each other.
#[inline(always)]
pub(crate) fn value_and_slope<S: Scalar, const N: usize>(c: &[S; N], x: S) -> (S, S) {
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
pub(crate) fn real_parts<S: Scalar, const N: usize>(c: &[S; N]) -> [f64; N] {
    // not `map`, which is a call of its own for many coefficients
    let mut re = [0.0; N];
    for k in 0..N {
        re[k] = c[k].re();
    }
    re
}

/// The lean over one step as a power series of N coefficients in x = (t - t0)/h.
#[derive(Clone, Copy)]
pub(crate) struct PowerSeries<S, const N: usize> {
    /// c_0 to c_{N-1} (rad).
    pub c: [S; N],
    growth: f64,
    size: f64,
}

/// A bound of k |c_{k+2}/c_k| for k near N. The equation's part linear in w gives q (gamma +
/// |b|)/k^2, its trigonometric part c_1^2/k^2; one 1/k is kept in reserve.
#[inline(always)]
fn growth<const V: bool, const N: usize>(c: &[f64; N], ground: &StepGround<f64>, q: f64) -> f64 {
    let gamma = if V { ground.gamma.abs() + ground.dgamma.abs() } else { 1.0 };
    c[1] * c[1] + q * (gamma + ground.b.abs() + ground.db.abs())
}

/// What truncated terms are measured against: the change of the lean within the step, or where it
/// turns, that within a time h at its natural rate p w; root = p h.
#[inline(always)]
fn size<const N: usize>(c: &[f64; N], root: f64) -> f64 {
    c[1].abs() + c[2].abs() + c[3].abs() + root * c[0].abs()
}

/// Whether one step takes the whole interval: the truncated terms are below rounding, the lean does
/// not vanish, and passes neither alpha nor the flat ground at its end w. With the least number of
/// coefficients a motion smaller than a hundredth of alpha counts as one of that size. root = p h,
/// q = root^2.
#[inline(always)]
pub(crate) fn is_plain<const V: bool, const N: usize>(
    c: &[f64; N],
    ground: &StepGround<f64>,
    (q, root): (f64, f64),
    w: f64,
    alpha: f64,
) -> bool {
    // plain comparisons: a NaN among the coefficients is one in w, too
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    // from the last two terms: every second one may vanish by symmetry
    let last = larger(c[N - 2].abs(), c[N - 1].abs());
    let least = if N == LEAST { 0.01 * alpha } else { 0.0 };
    let converged = last * growth::<V, N>(c, ground, q) <= TAIL * (size(c, root) + least);
    // |w''| <= M lets the lean sag by M/8 below the line between its two ends; the small terms count as the last one does
    let mut small = 0.0;
    for k in 4..N {
        small += c[k].abs();
    }
    let sag = c[2].abs() * 0.25 + c[3].abs() * 0.75 + small * (((N - 1) * (N - 2)) as f64 / 8.0);
    // `&`, not `&&`: lanes are checked side by side
    converged & (c[0] > sag) & (w > sag) & (w < FRAC_PI_2) & ((w < alpha) | (c[0] >= alpha))
}

impl<S: Scalar, const N: usize> PowerSeries<S, N> {
    /// The series of a step of length h (s), q = p^2 h^2.
    #[inline(always)]
    pub(crate) fn new<const V: bool>(
        start: &StepStart<S>,
        h: S,
        ground: &StepGround<S>,
        q: S,
    ) -> Self {
        let c = coefficients::<S, V, N>(start, h, ground, &pulls(q));
        let re = real_parts(&c);
        let (growth, size) = (growth::<V, N>(&re, &ground.re(), q.re()), size(&re, q.re().sqrt()));
        Self { c, growth, size }
    }

    /// Of coefficients that other forces have a part in, by which they grow faster.
    pub(crate) fn of(c: [S; N], ground: &StepGround<S>, q: S, faster: f64) -> Self {
        let re = real_parts(&c);
        let growth = growth::<true, N>(&re, &ground.re(), q.re()) + faster;
        Self { c, growth, size: size(&re, q.re().sqrt()) }
    }

    /// The change of w over the whole step.
    #[inline(always)]
    pub(crate) fn change(&self) -> S {
        change(&self.c)
    }

    /// dw/dx at x = 1.
    #[inline(always)]
    pub(crate) fn end_slope(&self) -> S {
        end_slope(&self.c)
    }

    /// w and dw/dx at x.
    pub(crate) fn at(&self, x: S) -> (S, S) {
        value_and_slope(&self.c, x)
    }

    /// The fraction of the step over which the truncated terms are below rounding; at most 1.
    pub(crate) fn reach(&self) -> f64 {
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
    pub(crate) fn shorten(&mut self, fraction: f64) {
        let mut power = 1.0;
        for c in &mut self.c[1..] {
            power *= fraction;
            *c *= real::<S>(power);
        }
    }

    /// Real parts of the coefficients.
    pub(crate) fn re(&self) -> [f64; N] {
        real_parts(&self.c)
    }
}

#[cfg(test)]
mod tests;
