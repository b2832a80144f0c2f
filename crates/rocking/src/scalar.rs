//! The number type of every formula: `f64`, or a dual number that carries exact derivatives.

use std::{any::Any, f64::consts::FRAC_PI_4};

use num_dual::DualNum;

pub use strong_motion::GRAVITY;

/// A number that a formula of this crate accepts: `f64` or any `Copy` dual number of `num-dual`.
pub trait Scalar: DualNum<f64> + Copy + Send + Sync + 'static {}

impl<T: DualNum<f64> + Copy + Send + Sync + 'static> Scalar for T {}

/// A constant, with no derivative, as a `Scalar`.
#[inline(always)]
pub fn real<S: Scalar>(x: f64) -> S {
    S::from(x)
}

/// Sine and cosine. Of a real number within pi/4 by polynomials in line, good to the last bit or
/// the one before: without a call, and the same on every machine.
#[inline(always)]
pub fn sin_cos<S: Scalar>(x: S) -> (S, S) {
    match (&x as &dyn Any).downcast_ref::<f64>() {
        Some(&small) if in_reach(small) => {
            let (sin, cos) = small_sin_cos(small);
            (real(sin), real(cos))
        }
        _ => x.sin_cos(),
    }
}

/// Whether an angle is within pi/4.
#[inline(always)]
pub fn in_reach(x: f64) -> bool {
    x.abs() <= FRAC_PI_4
}

/// Sine and cosine within pi/4: the polynomials of fdlibm (Sun Microsystems, 1993: k_sin.c,
/// k_cos.c).
#[inline(always)]
#[allow(clippy::excessive_precision)] // the tables as published
pub fn small_sin_cos(x: f64) -> (f64, f64) {
    const S: [f64; 6] = [
        -1.666_666_666_666_663_243_48e-1,
        8.333_333_333_322_489_461_24e-3,
        -1.984_126_982_985_794_931_34e-4,
        2.755_731_370_707_006_767_89e-6,
        -2.505_076_025_340_686_341_95e-8,
        1.589_690_995_211_550_102_21e-10,
    ];
    const C: [f64; 6] = [
        4.166_666_666_666_660_190_37e-2,
        -1.388_888_888_887_410_957_49e-3,
        2.480_158_728_947_672_941_78e-5,
        -2.755_731_435_139_066_330_35e-7,
        2.087_572_321_298_174_827_90e-9,
        -1.135_964_755_778_819_482_65e-11,
    ];
    let z = x * x;
    let w = z * z;
    let polynomial =
        |p: &[f64; 6]| (p[0] + z * p[1]) + w * ((p[2] + z * p[3]) + w * (p[4] + z * p[5]));
    let half = 0.5 * z;
    let one = 1.0 - half;
    // what rounding took from 1 - z/2 is put back
    (x + x * z * polynomial(&S), one + (((1.0 - one) - half) + w * polynomial(&C)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_are_good_to_the_last_bit_but_one() {
        for i in -8_000..=8_000 {
            let x = f64::from(i) * 1.1e-4;
            let (sin, cos) = sin_cos(x);
            let (s, c) = x.sin_cos();
            assert!(
                (sin - s).abs() <= f64::EPSILON * s.abs() && (cos - c).abs() <= f64::EPSILON * c,
                "{x}"
            );
            assert_eq!((-sin, cos), sin_cos(-x));
        }
    }
}
