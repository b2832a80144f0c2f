//! The first time in a step at which the lean vanishes.
//!
//! Newton's method may step over a short hop: it finds a root, not the first one. Here every step
//! is the root of a parabola that lies below the lean: with |w''| <= M, w(x + y) >= w + w' y - M
//! y^2/2. So no root is ever passed, and near a simple root the convergence is that of Newton's
//! method. Mostly the coefficients tell that there is no root, or only one, which any method finds.

use super::series::{PowerSeries, value_and_slope};
use crate::scalar::{Scalar, real};

/// More steps than a double root needs at a linear rate of 0.6 to reach rounding.
const MAX_STEPS: usize = 120;

/// What [`impact_time`] may be given as an error of a root, relative to it: two steps on it is
/// below rounding.
const CLOSE: f64 = 1e-9;

/// The smallest x in [0, 1] at which sum c_k x^k leaves the positive numbers, if there is one; to
/// [`CLOSE`].
///
/// Roots at x = 0 are set aside: a lean that starts from zero and grows has left the ground. One
/// that starts from zero and shrinks returns 0.
pub(crate) fn first_root<const N: usize>(c: &[f64; N]) -> Option<f64> {
    // w = x^zeros g: the roots of g are the wanted ones
    let zeros = c.iter().position(|&c| c != 0.0)?;
    let mut g = *c;
    for _ in 0..zeros {
        g.copy_within(1.., 0);
        g[N - 1] = 0.0;
    }
    if g[0] < 0.0 {
        return Some(0.0);
    }
    // bounds over [0, 1]: of g from below, of its first two derivatives from above, and of |g''|
    let (mut least, mut slope, mut bend, mut bound) = (g[0], g[1], 0.0, 0.0);
    for (k, &c) in g.iter().enumerate().skip(1) {
        least += c.min(0.0);
        if k >= 2 {
            let second = (k * (k - 1)) as f64 * c;
            slope += k as f64 * c.max(0.0);
            bend += if k == 2 { second } else { second.max(0.0) };
            bound += second.abs();
        }
    }
    if least > 0.0 {
        return None;
    }
    // g > 0 at first, and falls, or bends down, throughout: there is one root or none
    if slope < 0.0 || bend < 0.0 {
        if g.iter().sum::<f64>() > 0.0 {
            return None;
        }
        if let Some(root) = only_root(&g, bound) {
            return Some(root);
        }
    }
    root_by_parabolas(&g, bound)
}

/// The only root of g in [0, 1], where |g''| <= bound, by Newton's method from the root of its
/// first three terms.
fn only_root<const N: usize>(g: &[f64; N], bound: f64) -> Option<f64> {
    let root = (g[1] * g[1] - 4.0 * g[0] * g[2]).max(0.0).sqrt();
    let mut x = (2.0 * g[0] / (root - g[1])).clamp(0.0, 1.0);
    for _ in 0..8 {
        let (value, slope) = value_and_slope(g, x);
        let step = value / slope;
        x = (x - step).clamp(0.0, 1.0);
        // the error is now at most bound/(2 |slope|) step^2, to first order
        if bound * step * step <= CLOSE * slope.abs() * x {
            return Some(x);
        }
    }
    None
}

/// The first root of g in [0, 1], where |g''| <= bound.
fn root_by_parabolas<const N: usize>(g: &[f64; N], bound: f64) -> Option<f64> {
    let mut x = 0.0_f64;
    for _ in 0..MAX_STEPS {
        let (value, slope) = value_and_slope(g, x);
        if value <= 0.0 {
            return Some(x);
        }
        // root of value + slope y - bound y^2/2, without cancellation
        let root = (slope * slope + 2.0 * bound * value).sqrt();
        let step = if slope < 0.0 { 2.0 * value / (root - slope) } else { (root + slope) / bound };
        let next = x + step;
        if next.is_nan() || next > 1.0 {
            return None;
        }
        if next <= x * (1.0 + f64::EPSILON) {
            return Some(next);
        }
        x = next;
    }
    Some(x)
}

/// The root z of the lean as a function of the parameters. The first Newton step takes the root to
/// rounding, and each one after it doubles the order of exact derivatives.
pub(crate) fn impact_time<S: Scalar, const N: usize>(series: &PowerSeries<S, N>, z: f64) -> S {
    let mut z: S = real(z);
    for _ in 0..=(S::NDERIV + 1).next_power_of_two().ilog2() {
        let (w, slope) = series.at(z);
        // a graze has no derivative
        if slope.re() < 0.0 {
            z -= w / slope;
        }
    }
    z
}

/// Where the polynomial, below `level` at 0 and above it at 1, passes it; by bisection, once in a
/// history.
pub(crate) fn crossing(c: &[f64], level: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for _ in 0..53 {
        let middle = 0.5 * (low + high);
        let w = c.iter().rev().fold(0.0, |sum, c| sum * middle + c);
        if w < level { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_simple_root_is_found_to_rounding() {
        // (x - 0.3)(x - 2)
        let root = first_root(&[0.6, -2.3, 1.0]).unwrap();
        assert!((root - 0.3).abs() < 1e-15);
    }

    #[test]
    fn of_two_roots_the_first_is_found() {
        // (x - 0.2)(x - 0.21)(x + 1): both ends of the interval are positive
        let root = first_root(&[0.042, 0.042 - 0.41, 1.0 - 0.41, 1.0]).unwrap();
        assert!((root - 0.2).abs() < 1e-13);
    }

    #[test]
    fn a_near_miss_is_no_root() {
        // (x - 0.5)^2 + 1e-12
        assert_eq!(first_root(&[0.25 + 1e-12, -1.0, 1.0]), None);
    }

    #[test]
    fn a_touching_root_is_found_to_the_square_root_of_rounding() {
        let root = first_root(&[0.25, -1.0, 1.0]).unwrap();
        assert!((root - 0.5).abs() < 1e-7);
    }

    #[test]
    fn a_hop_from_the_ground_ends_at_its_second_zero() {
        // x (0.25 - x)
        assert!((first_root(&[0.0, 0.25, -1.0]).unwrap() - 0.25).abs() < 1e-15);
        // x^3 (1 - 2 x), as after uplift
        assert!((first_root(&[0.0, 0.0, 0.0, 1.0, -2.0]).unwrap() - 0.5).abs() < 1e-15);
        assert_eq!(first_root(&[0.0, 0.0, 1e-3, 1.0]), None);
    }

    #[test]
    fn pressing_into_the_ground_is_an_impact_at_once() {
        assert_eq!(first_root(&[0.0, -1e-9, 1.0]), Some(0.0));
    }
}
