//! The discrete Fourier transform of 2^k points, by J. W. Cooley and J. W. Tukey (1965),
//! Mathematics of Computation 19, 297.
//!
//! ```text
//! X_k = sum_n x_n exp(-2 pi i k n/N)        x_n = (1/N) sum_k X_k exp(2 pi i k n/N)
//! ```
//!
//! Written here because libraries choose their instructions by the processor that they find: the
//! parts of a sweep that several machines share must have the same bytes on each of them.

use std::f64::consts::TAU;

use num_complex::Complex;

/// Transforms of one length.
#[derive(Clone, Debug)]
pub(super) struct Fourier {
    /// exp(-2 pi i k/N), k = 0 to N/2 - 1.
    roots: Vec<Complex<f64>>,
}

impl Fourier {
    /// Of the least power of two that holds so many points, at least two.
    pub(super) fn holding(points: usize) -> Self {
        let n = points.next_power_of_two().max(2);
        Self {
            roots: (0..n / 2)
                .map(|k| Complex::from_polar(1.0, -TAU * k as f64 / n as f64))
                .collect(),
        }
    }

    /// N.
    pub(super) fn len(&self) -> usize {
        2 * self.roots.len()
    }

    /// x to X, in place.
    pub(super) fn forward(&self, x: &mut [Complex<f64>]) {
        let n = self.len();
        let bits = n.trailing_zeros();
        for i in 0..n {
            let j = i.reverse_bits() >> (usize::BITS - bits);
            if i < j {
                x.swap(i, j);
            }
        }
        let mut half = 1;
        while half < n {
            let stride = n / (2 * half);
            for block in x.chunks_exact_mut(2 * half) {
                let (low, high) = block.split_at_mut(half);
                for ((a, b), root) in
                    low.iter_mut().zip(high).zip(self.roots.iter().step_by(stride))
                {
                    let turned = *b * root;
                    (*a, *b) = (*a + turned, *a - turned);
                }
            }
            half *= 2;
        }
    }

    /// X to x, in place.
    pub(super) fn inverse(&self, x: &mut [Complex<f64>]) {
        x.iter_mut().for_each(|value| *value = value.conj());
        self.forward(x);
        let share = 1.0 / self.len() as f64;
        x.iter_mut().for_each(|value| *value = value.conj() * share);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transform_is_the_sum_that_defines_it_and_the_inverse_takes_it_back() {
        for points in [1, 2, 3, 8, 60, 128] {
            let fourier = Fourier::holding(points);
            let n = fourier.len();
            assert!(n >= points && n.is_power_of_two());
            let x: Vec<Complex<f64>> = (0..n)
                .map(|i| Complex::new((1.7 * i as f64).sin(), (0.3 * (i * i) as f64).cos()))
                .collect();
            let mut transformed = x.clone();
            fourier.forward(&mut transformed);
            for (k, value) in transformed.iter().enumerate() {
                let term = |(i, x): (usize, &Complex<f64>)| {
                    x * Complex::from_polar(1.0, -TAU * ((k * i) % n) as f64 / n as f64)
                };
                let sum: Complex<f64> = x.iter().enumerate().map(term).sum();
                assert!((sum - value).norm() < 1e-12 * n as f64, "{n} {k}");
            }
            fourier.inverse(&mut transformed);
            assert!(x.iter().zip(&transformed).all(|(a, b)| (a - b).norm() < 1e-14 * n as f64));
        }
    }
}
