//! The first time in a step at which the lean vanishes.
//!
//! Newton's method may step over a short hop: it finds a root, not the first one. Here every step is the root of a
//! parabola that lies below the lean: with |w''| <= M, w(x + y) >= w + w' y - M y^2/2. So no root is ever passed, and near a
//! simple root the convergence is that of Newton's method.

use super::series::Series;
use crate::scalar::{Scalar, real};

/// More steps than a double root needs at a linear rate of 0.6 to reach rounding.
const MAX_STEPS: usize = 120;

/// The smallest x in [0, 1] at which sum c_k x^k leaves the positive numbers, if there is one.
///
/// Roots at x = 0 are set aside: a lean that starts from zero and grows has left the ground. One that starts
/// from zero and shrinks returns 0.
pub fn first_root(c: &[f64]) -> Option<f64> {
    // w = x^zeros g: the roots of g are the wanted ones
    let zeros = c.iter().position(|&c| c != 0.0)?;
    let g = &c[zeros..];
    if g[0] < 0.0 {
        return Some(0.0);
    }
    // not `sum`: the empty sum of f64 is -0.0
    let bound = g.iter().enumerate().skip(2).fold(0.0, |sum, (k, c)| sum + (k * (k - 1)) as f64 * c.abs());
    let mut x = 0.0_f64;
    for _ in 0..MAX_STEPS {
        let (value, slope) = horner(g, x);
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

/// The root z of the lean as a function of the parameters. Each Newton step doubles the order of exact derivatives.
pub fn impact_time<S: Scalar, const N: usize>(series: &Series<S, N>, z: f64) -> S {
    let mut z: S = real(z);
    for _ in 0..2 {
        let (w, slope) = series.at(z);
        // a graze has no derivative
        if slope.re() < 0.0 {
            z -= w / slope;
        }
    }
    z
}

/// Where the polynomial, below `level` at 0 and above it at 1, passes it; by bisection, once in a history.
pub fn crossing(c: &[f64], level: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for _ in 0..53 {
        let middle = 0.5 * (low + high);
        let w = c.iter().rev().fold(0.0, |sum, c| sum * middle + c);
        if w < level { low = middle } else { high = middle }
    }
    high
}

fn horner(g: &[f64], x: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for &c in g.iter().rev() {
        slope = slope * x + value;
        value = value * x + c;
    }
    (value, slope)
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
