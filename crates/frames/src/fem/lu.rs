//! Dense factors of small matrices, real or complex, without allocation once made.

use dynamics::fem::condensed::MatrixNumber;
use num_complex::Complex;

/// A number that a pivot is chosen by.
pub(super) trait MatrixEntry: MatrixNumber {
    /// Its absolute value, squared.
    fn size(self) -> f64;
}

impl MatrixEntry for f64 {
    #[inline(always)]
    fn size(self) -> f64 {
        self * self
    }
}

impl MatrixEntry for Complex<f64> {
    #[inline(always)]
    fn size(self) -> f64 {
        self.norm_sqr()
    }
}

/// L U of an n x n matrix with its rows exchanged.
#[derive(Clone, Debug)]
pub(super) struct Lu<T> {
    n: usize,
    /// By rows; the diagonal of U inverted.
    entries: Vec<T>,
    order: Vec<usize>,
    work: Vec<T>,
}

impl<T: MatrixEntry> Lu<T> {
    pub(crate) fn new(n: usize) -> Self {
        Self { n, entries: vec![T::zero(); n * n], order: vec![0; n], work: vec![T::zero(); n] }
    }

    /// Factor the matrix with these entries; false if it is singular, or no matrix of numbers.
    #[must_use]
    pub(crate) fn factor(&mut self, entry: impl Fn(usize, usize) -> T) -> bool {
        let n = self.n;
        for i in 0..n {
            for j in 0..n {
                self.entries[i * n + j] = entry(i, j);
            }
            self.order[i] = i;
        }
        for k in 0..n {
            let mut pivot = k;
            for i in k + 1..n {
                if self.entries[i * n + k].size() > self.entries[pivot * n + k].size() {
                    pivot = i;
                }
            }
            let size = self.entries[pivot * n + k].size();
            if !(size > 0.0 && size.is_finite()) {
                return false;
            }
            if pivot != k {
                self.order.swap(k, pivot);
                let (upper, lower) = self.entries.split_at_mut(pivot * n);
                upper[k * n..(k + 1) * n].swap_with_slice(&mut lower[..n]);
            }
            let inverse = T::one() / self.entries[k * n + k];
            self.entries[k * n + k] = inverse;
            let (upper, lower) = self.entries.split_at_mut((k + 1) * n);
            let top = &upper[k * n..];
            for row in lower.chunks_exact_mut(n) {
                let factor = row[k] * inverse;
                row[k] = factor;
                if factor != T::zero() {
                    for (x, t) in row[k + 1..].iter_mut().zip(&top[k + 1..]) {
                        *x = *x - factor * *t;
                    }
                }
            }
        }
        true
    }

    /// Solve with it, in place.
    pub(crate) fn solve(&mut self, x: &mut [T]) {
        let n = self.n;
        for (work, &from) in self.work.iter_mut().zip(&self.order) {
            *work = x[from];
        }
        for i in 0..n {
            let row = &self.entries[i * n..(i + 1) * n];
            let mut sum = self.work[i];
            for (l, y) in row[..i].iter().zip(&self.work) {
                sum = sum - *l * *y;
            }
            self.work[i] = sum;
        }
        for i in (0..n).rev() {
            let row = &self.entries[i * n..(i + 1) * n];
            let mut sum = self.work[i];
            for (u, y) in row[i + 1..].iter().zip(&self.work[i + 1..]) {
                sum = sum - *u * *y;
            }
            self.work[i] = sum * row[i];
        }
        x[..n].copy_from_slice(&self.work);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_is_solved_back() {
        let entry = |i: usize, j: usize| {
            let x = ((3 * i + 7 * j + 1) as f64).sin();
            Complex::new(if i == 0 && j == 0 { 0.0 } else { x }, if i == j { 1e-3 } else { x * x })
        };
        let exact = [1.0, -2.0, 0.5, 3.0].map(|x| Complex::new(x, -x * x));
        let mut x: Vec<_> = (0..4).map(|i| (0..4).map(|j| entry(i, j) * exact[j]).sum()).collect();
        let mut lu = Lu::new(4);
        assert!(lu.factor(entry));
        lu.solve(&mut x);
        assert!(x.iter().zip(&exact).all(|(x, e)| (x - e).norm() < 1e-12), "{x:?}");
        assert!(!Lu::new(2).factor(|i, _| i as f64));
    }
}
