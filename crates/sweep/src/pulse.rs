//! Pulses of the ground, by circular frequency omega_p and peak acceleration a_p, sampled so that
//! every kink is a sample.
//!
//! ```text
//! half sine:  a = a_p sin(omega_p t),  0 <= t <= pi/omega_p
//! sine:       a = a_p sin(omega_p t),  0 <= t <= 2 pi/omega_p
//! ```
//!
//! Ricker wavelets and Mavroeidis-Papageorgiou pulses as in [`rocking::synthetic::Pulse`], scaled
//! to a peak acceleration of a_p: Ricker (1943), Vassiliou & Makris (2011), Mavroeidis &
//! Papageorgiou (2003).

use std::f64::consts::{PI, TAU};

use serde::Deserialize;

use rocking::{motion::largest_magnitude, synthetic::Pulse};

/// The shape of a pulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PulseShape {
    /// Half a sine.
    HalfSine,
    /// A whole sine.
    Sine,
    /// Symmetric Ricker wavelet, the second derivative of a Gaussian.
    Ricker,
    /// Antisymmetric Ricker wavelet, the third derivative.
    RickerAntisymmetric,
    /// gamma oscillations of phase nu (rad).
    MavroeidisPapageorgiou {
        /// Frequency of the carrier over that of the envelope.
        gamma: f64,
        /// Phase (rad).
        nu: f64,
    },
}

/// A shape's name in a sweep file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Name {
    HalfSine,
    Sine,
    Ricker,
    RickerAntisymmetric,
    MavroeidisPapageorgiou,
}

/// Samples to a period of omega_p at least: a chord of the sine is off by (2 pi/800)^2/8 of the
/// peak.
const A_PERIOD: f64 = 800.0;
/// Samples to a time of 1/p at least.
const A_RADIAN: f64 = 50.0;

impl PulseShape {
    /// Name, as in a sweep file.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::HalfSine => "half-sine",
            Self::Sine => "sine",
            Self::Ricker => "ricker",
            Self::RickerAntisymmetric => "ricker-antisymmetric",
            Self::MavroeidisPapageorgiou { .. } => "mavroeidis-papageorgiou",
        }
    }

    /// What tells it from others of its name.
    pub fn label(&self) -> String {
        match self {
            Self::MavroeidisPapageorgiou { gamma, nu } => {
                format!("{} gamma {gamma} nu {nu}", self.name())
            }
            _ => self.name().into(),
        }
    }

    /// Where x = omega_p t begins and ends.
    fn range(&self) -> (f64, f64) {
        let around = |half: f64| (-half, half);
        match self {
            Self::HalfSine => (0.0, PI),
            Self::Sine => (0.0, TAU),
            _ => around(self.wavelet().map_or(0.0, |pulse| pulse.half_length())),
        }
    }

    fn wavelet(&self) -> Option<Pulse> {
        match *self {
            Self::HalfSine | Self::Sine => None,
            Self::Ricker => Some(Pulse::RickerSymmetric),
            Self::RickerAntisymmetric => Some(Pulse::RickerAntisymmetric),
            Self::MavroeidisPapageorgiou { gamma, nu } => {
                Some(Pulse::MavroeidisPapageorgiou { gamma, nu })
            }
        }
    }

    /// Acceleration at x, of any amplitude.
    fn acceleration(&self, x: f64) -> f64 {
        match self.wavelet() {
            Some(pulse) => pulse.acceleration(x),
            None => x.sin(),
        }
    }

    /// Time step (s) and accelerations (m/s2) of the pulse with the circular frequency `omega`
    /// (rad/s) and the peak `peak` (m/s2), for bodies up to `p` (1/s). It begins at t = 0 and ends
    /// with its last sample.
    pub(crate) fn sampled(&self, omega: f64, peak: f64, p: f64) -> (f64, Vec<f64>) {
        let (from, to) = self.range();
        let length = to - from;
        let wanted = (length / TAU * A_PERIOD).max(A_RADIAN * p * length / omega);
        // a multiple of four: the peaks of the sines are samples
        let n = 4 * (wanted / 4.0).ceil() as usize;
        let at = |i: usize| self.acceleration(from + length * i as f64 / n as f64);
        let mut accel: Vec<f64> = (0..=n).map(at).collect();
        if self.wavelet().is_none() {
            // sin(pi) is zero but for rounding
            accel[n] = 0.0;
            if matches!(self, Self::Sine) {
                accel[n / 2] = 0.0;
            }
        }
        let largest = largest_magnitude(&accel);
        accel.iter_mut().for_each(|a| *a *= peak / largest);
        (length / omega / n as f64, accel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [PulseShape; 6] = [
        PulseShape::HalfSine,
        PulseShape::Sine,
        PulseShape::Ricker,
        PulseShape::RickerAntisymmetric,
        PulseShape::MavroeidisPapageorgiou { gamma: 1.5, nu: 0.7 },
        PulseShape::MavroeidisPapageorgiou { gamma: 2.0, nu: PI / 2.0 },
    ];

    #[test]
    fn every_shape_has_a_label_of_its_own() {
        let mut labels: Vec<String> = ALL.iter().map(PulseShape::label).collect();
        labels.sort();
        labels.dedup();
        assert_eq!(labels.len(), ALL.len());
    }

    #[test]
    fn a_pulse_has_its_peak_its_length_and_small_steps() {
        for shape in ALL {
            for (omega, p) in [(3.0, 1.0), (0.1, 2.0), (40.0, 0.4)] {
                let (dt, accel) = shape.sampled(omega, 2.5, p);
                let peak = largest_magnitude(&accel);
                assert!((peak - 2.5).abs() < 1e-12, "{shape:?} {peak}");
                assert!(
                    dt <= TAU / omega / A_PERIOD * 1.0001 && dt * p <= 1.0001 / A_RADIAN,
                    "{shape:?} {dt}"
                );
                let (from, to) = shape.range();
                assert!((dt * (accel.len() - 1) as f64 * omega - (to - from)).abs() < 1e-9);
            }
        }
    }

    /// The velocity gained: 2 a_p/omega by a half sine, none by the others but the rounding of
    /// chords; the pulse of Mavroeidis and Papageorgiou has zero velocity at both its ends (2003,
    /// equation 3).
    #[test]
    fn the_velocity_gained_is_the_closed_forms() {
        for shape in ALL {
            let (dt, accel) = shape.sampled(3.0, 2.5, 1.0);
            let gained: f64 = accel.windows(2).map(|w| 0.5 * dt * (w[0] + w[1])).sum();
            // the area below chords of a sine is short by h^2/12 of it
            let chords = 1.0 - (TAU / A_PERIOD).powi(2) / 12.0;
            let exact = if shape == PulseShape::HalfSine { chords * 2.0 * 2.5 / 3.0 } else { 0.0 };
            // a wavelet that ends with a kink is off by h^2/12 of its slope there
            let tolerance = if shape == PulseShape::HalfSine { 1e-9 } else { 1e-5 };
            assert!((gained - exact).abs() < tolerance * 2.5 / 3.0, "{shape:?}: {gained}");
        }
    }

    /// Printed forms: Ricker (1 - x^2/2) exp(-x^2/4) at x = 1 after the peak, sine of 30 degrees.
    #[test]
    fn values_at_single_points_are_the_printed_formulas() {
        let (dt, accel) = PulseShape::Sine.sampled(2.0, 1.0, 1.0);
        let at = |accel: &[f64], dt: f64, t: f64| {
            let (i, part) = ((t / dt) as usize, t / dt % 1.0);
            accel[i] * (1.0 - part) + accel[i + 1] * part
        };
        assert!((at(&accel, dt, PI / 12.0) - 0.5).abs() < 1e-5);
        assert!((at(&accel, dt, 7.0 * PI / 12.0) + 0.5).abs() < 1e-5);
        let (dt, accel) = PulseShape::Ricker.sampled(2.0, 1.0, 1.0);
        let middle = dt * (accel.len() / 2) as f64;
        assert!((at(&accel, dt, middle + 0.5) - 0.5 * (-0.25_f64).exp()).abs() < 1e-5);
    }
}
