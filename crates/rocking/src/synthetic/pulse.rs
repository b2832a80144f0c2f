//! Pulses of unit amplitude as functions of x = omega_p t, omega_p = 2 pi/T_p the pulse's circular
//! frequency: velocity v(x) and acceleration v'(x).
//!
//! ```text
//! Ricker, symmetric:      v'(x) = (1 - x^2/2) exp(-x^2/4)
//! Ricker, antisymmetric:  v'(x) = (y^2 - 3) y exp(-y^2/2) / beta,   y = x/sqrt 3, beta = 1.3801
//! ```
//!
//! N. Ricker (1943), Geophysics 8, in the form of M. F. Vassiliou and N. Makris (2011), Bulletin of
//! the Seismological Society of America 101(2); beta makes the peak acceleration 1.
//!
//! ```text
//! Mavroeidis-Papageorgiou:  v(x) = 1/2 [1 + cos(x/gamma)] cos(x + nu),   |x| <= gamma pi, zero outside
//! v'(x) = -1/2 { sin(x/gamma)/gamma cos(x + nu) + [1 + cos(x/gamma)] sin(x + nu) }
//! ```
//!
//! G. P. Mavroeidis and A. S. Papageorgiou (2003), "A mathematical representation of near-fault
//! ground motions", Bulletin of the Seismological Society of America 93(3), 1099-1131: gamma is the
//! number of oscillations, nu their phase. Velocity and acceleration both vanish at the ends; the
//! ground may end displaced, as it does beside a fault.

use std::f64::consts::PI;

use crate::scalar::{Scalar, real};

/// The shape of a pulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pulse {
    /// Second derivative of a Gaussian: one strong peak between two weaker ones.
    RickerSymmetric,
    /// Third derivative of a Gaussian: two equal peaks of opposite sign.
    RickerAntisymmetric,
    /// Cosine of phase nu (rad) under a raised cosine gamma periods long.
    MavroeidisPapageorgiou {
        /// Oscillations within the envelope.
        gamma: f64,
        /// Phase (rad).
        nu: f64,
    },
}

impl Pulse {
    /// Ground velocity over its amplitude (of acceleration/omega_p for the Ricker wavelets) at x =
    /// omega_p t.
    #[cfg(test)]
    pub(crate) fn velocity<S: Scalar>(&self, x: S) -> S {
        let half = real::<S>(0.5);
        match *self {
            Self::RickerSymmetric => x * (-(x * half).powi(2)).exp(),
            Self::RickerAntisymmetric => {
                let y2 = (x / 3_f64.sqrt()).powi(2);
                (S::one() - y2) * (-y2 * half).exp() * (3_f64.sqrt() / antisymmetric_peak())
            }
            Self::MavroeidisPapageorgiou { gamma, nu } if x.re().abs() <= gamma * PI => {
                ((x / gamma).cos() + 1.0) * half * (x + nu).cos()
            }
            Self::MavroeidisPapageorgiou { .. } => S::zero(),
        }
    }

    /// dv/dx: ground acceleration over its amplitude at x = omega_p t.
    pub fn acceleration<S: Scalar>(&self, x: S) -> S {
        let half = real::<S>(0.5);
        match *self {
            Self::RickerSymmetric => (S::one() - x * x * half) * (-(x * half).powi(2)).exp(),
            Self::RickerAntisymmetric => {
                let y = x / 3_f64.sqrt();
                (y * y - 3.0) * y * (-y * y * half).exp() / antisymmetric_peak()
            }
            Self::MavroeidisPapageorgiou { gamma, nu } if x.re().abs() <= gamma * PI => {
                let (window, carrier) = (x / gamma, x + nu);
                -(window.sin() / gamma * carrier.cos() + (window.cos() + 1.0) * carrier.sin())
                    * half
            }
            Self::MavroeidisPapageorgiou { .. } => S::zero(),
        }
    }

    /// Beyond this |x| the pulse is over: exactly, or for Ricker wavelets to 1e-8 of the peak.
    pub fn half_length(&self) -> f64 {
        match *self {
            Self::RickerSymmetric => 10.0,
            Self::RickerAntisymmetric => 12.5,
            Self::MavroeidisPapageorgiou { gamma, .. } => gamma * PI,
        }
    }

    /// Accelerations of the whole pulse at time steps dt (s), omega_p in rad/s.
    pub(super) fn sampled(&self, omega_p: f64, dt: f64) -> Vec<f64> {
        let half_length = (self.half_length() / (omega_p * dt)).ceil();
        (0..=2 * half_length as usize)
            .map(|i| self.acceleration(omega_p * dt * (i as f64 - half_length)))
            .collect()
    }
}

/// beta, the largest (3 - y^2) y exp(-y^2/2): at y^2 = 3 - sqrt 6.
fn antisymmetric_peak() -> f64 {
    let y2 = 3.0 - 6_f64.sqrt();
    (3.0 - y2) * y2.sqrt() * (-0.5 * y2).exp()
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::Dual64;

    fn pulses() -> Vec<Pulse> {
        let mut pulses = vec![Pulse::RickerSymmetric, Pulse::RickerAntisymmetric];
        for gamma in [1.0, 1.7, 3.0] {
            pulses.extend([0.0, 1.0, 4.0].map(|nu| Pulse::MavroeidisPapageorgiou { gamma, nu }));
        }
        pulses
    }

    #[test]
    fn acceleration_is_the_derivative_of_velocity() {
        for pulse in pulses() {
            for i in -200..=200 {
                let x = f64::from(i) * 0.0499;
                let exact = pulse.velocity(Dual64::from(x).derivative()).eps;
                assert!((pulse.acceleration(x) - exact).abs() < 1e-14, "{pulse:?} at {x}");
                if x.abs() > pulse.half_length() - 0.01 {
                    continue; // a kink of the acceleration
                }
                // fourth-order central difference: error h^4 v^(5)/30, rounding 1e-16/h
                let (h, v) = (1e-3, |x| pulse.velocity::<f64>(x));
                let difference =
                    (8.0 * (v(x + h) - v(x - h)) - (v(x + 2.0 * h) - v(x - 2.0 * h))) / (12.0 * h);
                assert!((pulse.acceleration(x) - difference).abs() < 1e-11, "{pulse:?} at {x}");
            }
        }
    }

    #[test]
    fn velocity_and_acceleration_vanish_at_the_ends() {
        for pulse in pulses() {
            for x in [-pulse.half_length(), pulse.half_length()] {
                assert!(
                    pulse.velocity(x).abs() < 1e-8 && pulse.acceleration(x).abs() < 1e-8,
                    "{pulse:?} at {x}"
                );
            }
        }
    }

    /// Vassiliou & Makris (2011) print beta = 1.3801.
    #[test]
    fn ricker_wavelets_peak_at_one() {
        assert_eq!(format!("{:.4}", antisymmetric_peak()), "1.3801");
        for (pulse, at) in [
            (Pulse::RickerSymmetric, 0.0),
            (Pulse::RickerAntisymmetric, -(9.0 - 54_f64.sqrt()).sqrt()),
        ] {
            assert!((pulse.acceleration(at) - 1.0).abs() < 1e-15);
            assert!(
                (-3000..3000)
                    .all(|i| pulse.acceleration(f64::from(i) * 0.004).abs() <= 1.0 + 1e-15)
            );
        }
    }

    /// |Fourier transform| of the Ricker wavelets is k^n exp(-s k^2): greatest at k = omega/omega_p = 1.
    #[test]
    fn ricker_wavelets_have_their_spectral_peak_at_their_frequency() {
        for (pulse, transform) in [
            (Pulse::RickerSymmetric, (|k: f64| k * k * (1.0 - k * k).exp()) as fn(f64) -> f64),
            (Pulse::RickerAntisymmetric, |k| k.powi(3) * (1.5 - 1.5 * k * k).exp()),
        ] {
            let dx = 0.05;
            let spectrum = |k: f64| {
                let (mut re, mut im) = (0.0, 0.0);
                for i in -300..=300 {
                    let x = f64::from(i) * dx;
                    re += pulse.acceleration(x) * (k * x).cos() * dx;
                    im += pulse.acceleration(x) * (k * x).sin() * dx;
                }
                f64::hypot(re, im)
            };
            let peak = spectrum(1.0);
            for k in [0.2, 0.5, 0.9, 1.1, 2.0, 3.0] {
                assert!((spectrum(k) / peak - transform(k)).abs() < 1e-8, "{pulse:?} at {k}");
            }
        }
    }
}
