//! The number type of every formula: `f64`, or a dual number that carries exact derivatives.

use num_dual::DualNum;

/// Gravity [m/s2]. The references of the field use 9.81, not 9.80665; one value, used everywhere.
pub const GRAVITY: f64 = 9.81;

/// A number that a formula of this crate accepts: `f64` or any `Copy` dual number of `num-dual`.
pub trait Scalar: DualNum<f64> + Copy + Send + Sync + 'static {}

impl<T: DualNum<f64> + Copy + Send + Sync + 'static> Scalar for T {}

/// A constant, with no derivative, as a `Scalar`.
#[inline(always)]
pub fn real<S: Scalar>(x: f64) -> S {
    S::from(x)
}
