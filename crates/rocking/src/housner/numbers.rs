//! LaneNumbers of lanes that go in lock-step.

use std::array;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Structures in lock-step.
pub(crate) const WIDTH: usize = 16;

/// A number for each lane, which the compiler holds in vector registers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LaneNumbers(pub [f64; WIDTH]);

impl LaneNumbers {
    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(array::from_fn(|l| f(self.0[l], other.0[l])))
    }
}

macro_rules! operation {
    ($($name:ident $method:ident $op:tt)*) => {$(
        impl $name for LaneNumbers {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.with(other, |a, b| a $op b)
            }
        }

        impl $name<f64> for LaneNumbers {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.with(Self([other; WIDTH]), |a, b| a $op b)
            }
        }
    )*};
}

operation!(Add add + Sub sub - Mul mul * Div div /);

impl Neg for LaneNumbers {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}
