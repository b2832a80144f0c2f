//! A chain's share of a Newton matrix M + s c + s^2 K with s = h lambda, its absorber eliminated:
//! its dynamic stiffness is s^2 k1 (m2 + s c + s^2 k2) / (m2 + s c + s^2 (k1 + k2)).

use std::ops::Neg;

use num_complex::Complex;
use num_traits::Num;

use crate::spring::Chain;

/// A number of a Newton matrix: real, or complex for the pair of eigenvalues.
pub trait MatrixNumber: Num + Neg<Output = Self> + From<f64> + Copy {}

impl MatrixNumber for f64 {}
impl MatrixNumber for Complex<f64> {}

/// One chain's share of the condensed matrix.
#[derive(Clone, Copy)]
pub struct Condensed<T> {
    /// 1 / (m2 + s c + s^2 (k1 + k2)); k1 only when closed.
    pub pivot: T,
    /// s^2 k1; zero when open.
    pub coupling: T,
    /// coupling pivot: the share of a force on the absorber that reaches the body.
    pub share: T,
    /// The chain's dynamic stiffness times s^2; zero when open.
    pub stiffness: T,
}

impl<T: MatrixNumber> Condensed<T> {
    /// Of a chain whose gap is closed or open, for a step of size s.
    #[inline(always)]
    pub fn new(chain: &Chain, closed: bool, s: T) -> Self {
        let base = T::from(chain.m2) + s * (T::from(chain.c) + s * T::from(chain.k2));
        if closed {
            let coupling = s * s * T::from(chain.k1);
            let pivot = T::one() / (base + coupling);
            Self { pivot, coupling, share: coupling * pivot, stiffness: coupling * base * pivot }
        } else {
            Self {
                pivot: T::one() / base,
                coupling: T::zero(),
                share: T::zero(),
                stiffness: T::zero(),
            }
        }
    }
}
