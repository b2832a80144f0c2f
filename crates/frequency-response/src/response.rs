//! The frequency response of one chain under the mass: the amplitude response ratio (ARR),
//! equations (5) to (7).
//!
//! ```text
//!  (5)  (k1 - m1 w^2) u1 - k1 u2 = P0 ;   (k1 + k2 + i w c - m2 w^2) u2 - k1 u1 = 0
//!
//!                  (2 mu xi g)^2 + [1 + mu (f^2 - g^2)]^2
//!  (7)  ARR^2 = ---------------------------------------------------------------------------------
//!               (2 mu xi g)^2 (g^2 - 1)^2 + [mu g^2 (g^2 - f^2) + mu f^2 - g^2 (1 + mu)]^2
//! ```
//!
//! ARR = |u1| / x_st, x_st = P0/k1; the gap counts as closed. mu = m2/m1, f = omega_a/Omega_n, xi =
//! c/(2 m2 Omega_n), g = omega/Omega_n: no units. Stiffness ratio K = k2/k1 = mu f^2, damping
//! number C = c/(m1 Omega_n) = 2 mu xi.

use rocking::scalar::{Scalar, real};

/// The response of one chain, as a function of the frequency ratio g.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response<S> {
    /// Mass ratio mu = m2/m1, greater than zero.
    pub mu: S,
    /// Stiffness ratio K = k2/k1 = mu f^2, greater than zero.
    pub k: S,
    /// Damping number C = c/(m1 Omega_n) = 2 mu xi, zero or greater.
    pub c: S,
}

/// ARR of equation (7) at frequency ratio g, for mass ratio mu, frequency ratio f and damping ratio
/// xi.
///
/// Infinite at a resonance without damping (xi = 0), where it has no derivative; finite everywhere
/// else.
///
/// ```
/// // far above resonance only the mass resists: ARR = 1/g^2
/// assert!((frequency_response::Response::new(0.1, 2.3, 9.0).arr(1e3) - 1e-6_f64).abs() < 1e-11);
/// ```
pub fn arr<S: Scalar>(g: S, mu: S, f: S, xi: S) -> S {
    Response::new(mu, f, xi).arr(g)
}

impl<S: Scalar> Response<S> {
    /// From the paper's parameters.
    pub fn new(mu: S, f: S, xi: S) -> Self {
        Self { mu, k: mu * f * f, c: mu * xi * real::<S>(2.0) }
    }

    /// ARR of equation (7) at frequency ratio g >= 0.
    pub fn arr(&self, g: S) -> S {
        let Self { mu, k, c } = *self;
        let one = S::one();
        // In x = g^2, with (x - 1)(mu x - K) - x for the last bracket, which cancels less; above g
        // = 1 numerator and denominator are divided by x^2 and x^4, so that no power of a large g
        // overflows.
        if g.re() <= 1.0 {
            let x = g * g;
            let above = c * c * x + (one + k - mu * x).powi(2);
            let below = c * c * x * (x - one).powi(2) + ((x - one) * (mu * x - k) - x).powi(2);
            (above / below).sqrt() // (7)
        } else {
            let y = g.recip() * g.recip();
            let above = c * c * y + ((one + k) * y - mu).powi(2);
            let below = c * c * y * (one - y).powi(2) + ((one - y) * (mu - k * y) - y).powi(2);
            y * (above / below).sqrt() // (7)
        }
    }

    /// ARR at g = 0, whatever the damping: 1 + 1/K, the compliance of k1 and k2 in series over that
    /// of k1.
    pub fn at_zero(&self) -> S {
        S::one() + self.k.recip()
    }

    /// The two fixed points, lower first: the g at which ARR does not depend on the damping, and is
    /// 1/|1 - g^2|.
    ///
    /// Roots x = g^2 of 2 mu x^2 - 2 (1 + K + mu) x + 1 + 2 K = 0.
    pub fn fixed_points(&self) -> [S; 2] {
        let Self { mu, k, .. } = *self;
        let (one, two) = (S::one(), real::<S>(2.0));
        // the discriminant (1 + K + mu)^2 - 2 mu (1 + 2 K), as a sum of positive terms
        let root = ((k - mu).powi(2) + one + k * two).sqrt();
        let sum = one + k + mu + root;
        [((one + k * two) / sum).sqrt(), (sum / (mu * two)).sqrt()]
    }

    /// The two resonances without damping, lower first [-]: zeros of the denominator of (7) at C =
    /// 0.
    ///
    /// Roots x = g^2 of mu x^2 - (1 + K + mu) x + K = 0.
    pub(crate) fn resonances(&self) -> [S; 2] {
        let Self { mu, k, .. } = *self;
        let (one, two) = (S::one(), real::<S>(2.0));
        let root = ((k - mu).powi(2) + one + (k + mu) * two).sqrt();
        let sum = one + k + mu + root;
        [(k * two / sum).sqrt(), (sum / (mu * two)).sqrt()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::{Matrix2, Vector2};
    use num_complex::Complex64;
    use num_dual::{gradient, hessian};

    const MU: [f64; 4] = [1e-3, 0.1, 2.0, 100.0];
    const K: [f64; 3] = [0.1, 0.9, 20.0];
    const C: [f64; 4] = [0.0, 0.05, 2.0, 40.0];
    const G: [f64; 7] = [0.0, 1e-3, 0.3, 0.95, 1.0, 1.7, 30.0];

    fn cases() -> impl Iterator<Item = Response<f64>> {
        MU.into_iter().flat_map(|mu| {
            K.into_iter().flat_map(move |k| C.into_iter().map(move |c| Response { mu, k, c }))
        })
    }

    /// |u1| k1/P0 of the complex system (5) with m1 = k1 = P0 = 1.
    fn of_equation_5(response: &Response<f64>, w: f64) -> f64 {
        let Response { mu, k, c } = *response;
        let i = Complex64::i();
        let off = Complex64::from(-1.0);
        let system = Matrix2::new(
            Complex64::from(1.0 - w * w),
            off,
            off,
            Complex64::from(1.0 + k - mu * w * w) + i * w * c,
        );
        let load = Vector2::new(Complex64::from(1.0), Complex64::from(0.0));
        system.lu().solve(&load).unwrap()[0].norm()
    }

    #[test]
    fn equation_7_is_the_solution_of_equation_5() {
        for response in cases() {
            for g in G {
                let oracle = of_equation_5(&response, g);
                // the 2 x 2 solve loses what cancels in its determinant: at most 1e4 roundings in
                // these cases
                assert_relative_eq!(response.arr(g), oracle, max_relative = 1e-12);
            }
        }
    }

    #[test]
    fn the_papers_parameters_give_the_same_response() {
        let (mu, f, xi) = (0.3_f64, 1.7, 2.5);
        let by_kc = Response { mu, k: mu * f * f, c: 2.0 * mu * xi };
        assert_relative_eq!(arr(0.8, mu, f, xi), by_kc.arr(0.8), max_relative = 1e-15);
        assert_relative_eq!(
            Response::new(mu, f, 0.0).at_zero(),
            1.0 + 1.0 / (mu * f * f),
            max_relative = 1e-15
        );
    }

    #[test]
    fn at_rest_it_is_one_plus_one_over_k_for_any_damping() {
        for response in cases() {
            assert_relative_eq!(response.arr(0.0), 1.0 + 1.0 / response.k, max_relative = 1e-15);
            assert_relative_eq!(response.at_zero(), 1.0 + 1.0 / response.k, max_relative = 1e-15);
        }
    }

    #[test]
    fn far_above_resonance_it_is_one_over_g_squared() {
        for response in cases() {
            for g in [1e8, 1e100, 1e150] {
                assert_relative_eq!(response.arr(g) * g * g, 1.0, max_relative = 1e-10);
            }
            assert_eq!(response.arr(f64::MAX), 0.0);
            assert_eq!(response.arr(f64::INFINITY), 0.0);
        }
    }

    #[test]
    fn at_the_fixed_points_no_damping_changes_it() {
        for response in cases() {
            for g in response.fixed_points() {
                let expected = 1.0 / (1.0 - g * g).abs();
                // |1 - g^2| cancels where the upper point lies close to g = 1 (large mu)
                let tolerance =
                    1e-14 * expected.max(1.0 / expected) * (1.0 + response.k.max(response.mu));
                for c in [1e-3, 0.1, 1.0, 30.0, 1e4] {
                    assert_relative_eq!(
                        Response { c, ..response }.arr(g),
                        expected,
                        max_relative = tolerance
                    );
                }
            }
        }
    }

    #[test]
    fn without_damping_the_denominator_vanishes_at_the_resonances() {
        for response in cases() {
            let Response { mu, k, .. } = response;
            for g in response.resonances() {
                let x = g * g;
                let terms = [mu * x * x, -(1.0 + k + mu) * x, k];
                let size: f64 = terms.iter().map(|term| term.abs()).sum();
                assert!(terms.iter().sum::<f64>().abs() <= 1e-14 * size, "{response:?} {g}");
            }
        }
    }

    #[test]
    fn the_derivatives_at_rest_are_finite_and_right() {
        let at_rest =
            |z: nalgebra::SVector<num_dual::DualSVec64<4>, 4>| arr(z[0], z[1], z[2], z[3]);
        let (mu, f) = (0.1, 2.3);
        let (_, slope) = gradient(at_rest, &nalgebra::vector![0.0, mu, f, 9.0]);
        // 1 + 1/(mu f^2): nothing by g and xi
        assert_eq!((slope[0], slope[3]), (0.0, 0.0));
        assert_relative_eq!(slope[1], -1.0 / (mu * mu * f * f), max_relative = 1e-14);
        assert_relative_eq!(slope[2], -2.0 / (mu * f * f * f), max_relative = 1e-14);
    }

    /// Complex step: the derivative of an analytic function without cancellation. ARR = sqrt(N/D)
    /// of (7) continued to complex arguments, written out as printed.
    fn printed([g, mu, f, xi]: [Complex64; 4]) -> Complex64 {
        let damping = (2.0 * mu * xi * g).powi(2);
        let above = damping + (1.0 + mu * (f * f - g * g)).powi(2);
        let last = mu * g * g * (g * g - f * f) + mu * f * f - g * g * (1.0 + mu);
        (above / (damping * (g * g - 1.0).powi(2) + last.powi(2))).sqrt()
    }

    #[test]
    fn gradients_agree_with_a_complex_step_to_1e_8() {
        for response in cases().filter(|response| response.c > 0.0) {
            for g in [0.2, 0.8, 1.3, 5.0] {
                let Response { mu, k, c } = response;
                let z = nalgebra::vector![g, mu, (k / mu).sqrt(), c / (2.0 * mu)];
                let (value, slope) = gradient(
                    |z: nalgebra::SVector<num_dual::DualSVec64<4>, 4>| arr(z[0], z[1], z[2], z[3]),
                    &z,
                );
                for j in 0..4 {
                    let step = 1e-30 * z[j];
                    let mut arguments: [Complex64; 4] =
                        std::array::from_fn(|i| Complex64::from(z[i]));
                    arguments[j].im = step;
                    let oracle = printed(arguments).im / step;
                    // a slope that is all but zero is judged on the scale of the value
                    let scale = oracle.abs().max(1e-6 * value / z[j]);
                    assert!(
                        (slope[j] - oracle).abs() <= 1e-8 * scale,
                        "{response:?} {g} {j}: {} {oracle}",
                        slope[j]
                    );
                }
            }
        }
    }

    #[test]
    fn hessians_agree_with_differences_of_gradients() {
        let z = nalgebra::vector![0.8, 0.3, 1.7, 2.5];
        let (_, _, second) = hessian(
            |z: nalgebra::SVector<num_dual::Dual2SVec64<4>, 4>| arr(z[0], z[1], z[2], z[3]),
            &z,
        );
        let slope = |z: &nalgebra::SVector<f64, 4>| {
            gradient(
                |z: nalgebra::SVector<num_dual::DualSVec64<4>, 4>| arr(z[0], z[1], z[2], z[3]),
                z,
            )
            .1
        };
        for j in 0..4 {
            let (mut after, mut before) = (z, z);
            after[j] += 1e-5;
            before[j] -= 1e-5;
            let difference = (slope(&after) - slope(&before)) / 2e-5;
            // central differences of step h: relative error h^2 = 1e-10 times third over first
            // derivatives (~100)
            assert_relative_eq!(
                second.column(j).into_owned(),
                difference,
                epsilon = 1e-8 * second.norm()
            );
        }
    }
}
