//! Linear motion y' = A y, exactly: y(t) = exp(A t) y(0), by a Taylor series of A t/2^s and s
//! squarings.
//!
//! Between two changes of contact a landing is linear, and of few coordinates: its matrix
//! exponential is exact to rounding whatever the stiffness, and generic in the scalar.

use rocking::scalar::{Scalar, real};

/// A square matrix, row by row.
pub(crate) type SquareMatrix<S, const N: usize> = [[S; N]; N];

/// Terms of the Taylor series; with |A t|/2^s at most 1/4 the first left out is below 1e-18.
const TERMS: usize = 12;
/// Largest norm of the matrix that the series is summed for.
const NORM: f64 = 0.25;

/// exp(A t).
pub(crate) fn exponential<S: Scalar, const N: usize>(
    a: &SquareMatrix<S, N>,
    t: S,
) -> SquareMatrix<S, N> {
    let norm =
        a.iter().map(|row| row.iter().map(|x| x.re().abs()).sum::<f64>()).fold(0.0, f64::max)
            * t.re().abs();
    let squarings = if norm > NORM { (norm / NORM).log2().ceil() as i32 } else { 0 };
    let small = t * real::<S>(0.5_f64.powi(squarings));
    let scaled: SquareMatrix<S, N> = a.map(|row| row.map(|x| x * small));
    // Horner: 1 + X (1 + X/2 (1 + X/3 (...)))
    let mut sum = identity();
    for k in (1..=TERMS).rev() {
        let mut next = product(&scaled, &sum);
        next.iter_mut().flatten().for_each(|x| *x /= k as f64);
        (0..N).for_each(|i| next[i][i] += 1.0);
        sum = next;
    }
    for _ in 0..squarings {
        sum = product(&sum, &sum);
    }
    sum
}

/// A y.
pub(crate) fn times<S: Scalar, const N: usize>(a: &SquareMatrix<S, N>, y: &[S; N]) -> [S; N] {
    std::array::from_fn(|i| dot(&a[i], y))
}

/// A y of the columns of A: the same sums, in an order that processors take side by side.
pub(crate) fn combined<const N: usize>(columns: &SquareMatrix<f64, N>, y: &[f64; N]) -> [f64; N] {
    let mut out = [0.0; N];
    for (column, &y) in columns.iter().zip(y) {
        out.iter_mut().zip(column).for_each(|(out, &a)| *out += a * y);
    }
    out
}

/// Rows for columns.
pub(crate) fn transposed<const N: usize>(a: &SquareMatrix<f64, N>) -> SquareMatrix<f64, N> {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

/// The scalar product.
pub(crate) fn dot<S: Scalar, const N: usize>(a: &[S; N], b: &[S; N]) -> S {
    a.iter().zip(b).fold(S::zero(), |sum, (&a, &b)| sum + a * b)
}

fn identity<S: Scalar, const N: usize>() -> SquareMatrix<S, N> {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { S::one() } else { S::zero() }))
}

fn product<S: Scalar, const N: usize>(
    a: &SquareMatrix<S, N>,
    b: &SquareMatrix<S, N>,
) -> SquareMatrix<S, N> {
    let mut out = [[S::zero(); N]; N];
    for (row, out) in a.iter().zip(&mut out) {
        for (&x, b) in row.iter().zip(b) {
            // most entries of a motion's matrix are zero
            if x != S::zero() {
                out.iter_mut().zip(b).for_each(|(out, &b)| *out += x * b);
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotation by t, a decay and a shear: exp(A t) in closed form.
    #[test]
    fn exponentials_of_known_matrices() {
        for t in [1e-3_f64, 0.7, 30.0, 400.0] {
            let rotation = exponential(&[[0.0, 1.0], [-1.0, 0.0]], t);
            // squaring s times doubles the rounding each time: |A t| units of it
            let rounding = 8.0 * f64::EPSILON * t.max(1.0);
            assert!(
                (rotation[0][0] - t.cos()).abs() < rounding
                    && (rotation[0][1] - t.sin()).abs() < rounding,
                "{t}"
            );
            let jordan = exponential(&[[-1.0, 1.0], [0.0, -1.0]], t);
            assert!((jordan[0][1] - t * (-t).exp()).abs() < rounding, "{t}");
        }
    }

    #[test]
    fn columns_combined_are_the_product_bit_for_bit() {
        let at = |i: usize, j: usize| (1.7 * i as f64 + 2.9 * j as f64).sin();
        let a: SquareMatrix<f64, 8> = std::array::from_fn(|i| std::array::from_fn(|j| at(i, j)));
        let y: [f64; 8] = std::array::from_fn(|i| at(i, 9));
        assert_eq!(combined(&transposed(&a), &y), times(&a, &y));
    }

    #[test]
    fn the_derivative_by_time_is_a_times_the_exponential() {
        use num_dual::Dual64;
        let a = [[-0.3, 2.0], [-5.0, -0.1]];
        let dual = a.map(|row| row.map(Dual64::from_re));
        let e = exponential(&dual, Dual64::from_re(1.7).derivative());
        let expected = product(&a, &exponential(&a, 1.7));
        for (x, y) in e.iter().flatten().zip(expected.iter().flatten()) {
            assert!((x.eps - y).abs() < 1e-13 && x.re.is_finite());
        }
    }
}
