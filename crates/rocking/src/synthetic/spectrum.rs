//! The response spectrum of a ground motion.
//!
//! ```text
//! d'' + 2 zeta w d' + w^2 d = -a(t),   at rest at first,   w = 2 pi/T
//! S(T) = w^2 max |d|                   pseudo-acceleration; S -> PGA as T -> 0
//! ```
//!
//! a is linear between the samples, so a step is exact: N. C. Nigam and P. C. Jennings (1969),
//! "Calculation of response spectra from strong-motion earthquake records", Bulletin of the
//! Seismological Society of America 59(2). With tau the time in a step, d = D + L tau + exp(-zeta w
//! tau) (A cos w_d tau + B sin w_d tau).

use std::f64::consts::TAU;

/// Damping ratio of the spectra.
const ZETA: f64 = 0.05;
/// Oscillators that go side by side.
const LANES: usize = 8;

/// The step of one oscillator: (d, v) after it from d, v, and the accelerations at both ends.
#[derive(Clone, Copy, Debug, Default)]
struct OscillatorStep {
    d: [f64; 4],
    v: [f64; 4],
}

impl OscillatorStep {
    fn new(period: f64, dt: f64) -> Self {
        let omega = TAU / period;
        let omega_d = omega * (1.0 - ZETA * ZETA).sqrt();
        let (sin, cos) = (omega_d * dt).sin_cos();
        let decay = (-ZETA * omega * dt).exp();
        // response to a start (d0, v0) and to the accelerations (a0, a1): linear in each, one at a
        // time
        let after = |d0: f64, v0: f64, a0: f64, a1: f64| {
            let slope = -(a1 - a0) / (dt * omega * omega);
            let level = -a0 / (omega * omega) - 2.0 * ZETA * slope / omega;
            let a = d0 - level;
            let b = (v0 - slope + ZETA * omega * a) / omega_d;
            let d = level + slope * dt + decay * (a * cos + b * sin);
            let v = slope
                + decay
                    * ((omega_d * b - ZETA * omega * a) * cos
                        - (omega_d * a + ZETA * omega * b) * sin);
            (d, v)
        };
        let units = [after(1.0, 0.0, 0.0, 0.0), after(0.0, 1.0, 0.0, 0.0)];
        let pushes = [after(0.0, 0.0, 1.0, 0.0), after(0.0, 0.0, 0.0, 1.0)];
        let all = [units[0], units[1], pushes[0], pushes[1]];
        Self { d: all.map(|(d, _)| d), v: all.map(|(_, v)| v) }
    }
}

/// Spectra at some periods of motions with one time step.
#[derive(Clone, Debug)]
pub struct ResponseSpectrum {
    /// (s)
    pub periods: Vec<f64>,
    steps: Vec<OscillatorStep>,
}

impl ResponseSpectrum {
    /// At periods (s) of motions with the time step dt (s).
    pub(crate) fn new(periods: Vec<f64>, dt: f64) -> Self {
        let steps = periods.iter().map(|period| OscillatorStep::new(*period, dt)).collect();
        Self { periods, steps }
    }

    /// Pseudo-acceleration of 5 % damping at the periods (m/s2).
    pub(crate) fn of(&self, accel: &[f64]) -> Vec<f64> {
        let peaks = self.steps.chunks(LANES).flat_map(|steps| {
            let mut lanes = [OscillatorStep::default(); LANES];
            lanes[..steps.len()].copy_from_slice(steps);
            peaks(&lanes, accel).into_iter().take(steps.len())
        });
        peaks.zip(&self.periods).map(|(peak, period)| peak * (TAU / period).powi(2)).collect()
    }
}

/// Largest |d| of several oscillators, and beyond the motion's end for nothing: what follows it is
/// free and decays.
fn peaks(steps: &[OscillatorStep; LANES], accel: &[f64]) -> [f64; LANES] {
    // a column a coefficient, so that the lanes of one lie side by side
    let column = |of: fn(&OscillatorStep) -> f64| steps.each_ref().map(of);
    let (dd, dv, da, db) =
        (column(|s| s.d[0]), column(|s| s.d[1]), column(|s| s.d[2]), column(|s| s.d[3]));
    let (vd, vv, va, vb) =
        (column(|s| s.v[0]), column(|s| s.v[1]), column(|s| s.v[2]), column(|s| s.v[3]));
    let (mut d, mut v, mut peak) = ([0.0_f64; LANES], [0.0_f64; LANES], [0.0_f64; LANES]);
    for pair in accel.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        for i in 0..LANES {
            let next = dd[i] * d[i] + dv[i] * v[i] + (da[i] * a + db[i] * b);
            v[i] = vd[i] * d[i] + vv[i] * v[i] + (va[i] * a + vb[i] * b);
            d[i] = next;
            peak[i] = peak[i].max(next.abs());
        }
    }
    peak
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step of acceleration: the first peak of the deflection is 1 + exp(-pi zeta/sqrt(1 -
    /// zeta^2)) times the static one, at half a damped period.
    #[test]
    fn a_step_overshoots_by_its_closed_form() {
        let (dt, periods) = (1e-3, vec![0.05, 0.2, 1.0, 3.0]);
        let found = ResponseSpectrum::new(periods, dt).of(&vec![2.0; 4001]);
        let exact = 2.0 * (1.0 + (-std::f64::consts::PI * ZETA / (1.0 - ZETA * ZETA).sqrt()).exp());
        // the peak lies between two samples: 1 - cos(pi dt/T) below at most
        for (s, bound) in found.into_iter().zip([2e-3, 2e-4, 1e-5, 1e-6]) {
            assert!(s <= exact * (1.0 + 1e-9) && s > exact * (1.0 - bound), "{s} {exact}");
        }
    }

    /// At resonance, far from the start, the amplitude is 1/(2 zeta); a sine of samples joined by
    /// lines is weaker by (sin x/x)^2 with x = w dt/2.
    #[test]
    fn a_long_sine_resonates_by_its_closed_form_and_a_stiff_oscillator_follows_the_ground() {
        let dt = 0.005;
        let accel: Vec<f64> = (0..40_000).map(|i| (TAU * f64::from(i) * dt).sin()).collect();
        let found = ResponseSpectrum::new(vec![1.0, 0.01], dt).of(&accel);
        let x = std::f64::consts::PI * dt;
        assert!(
            (found[0] / ((x.sin() / x).powi(2) / (2.0 * ZETA)) - 1.0).abs() < 2e-4,
            "{found:?}"
        );
        assert!((found[1] - 1.0).abs() < 1e-3, "{found:?}");
    }

    /// Nine periods, more than go side by side, each as if alone; a motion of no length moves
    /// nothing.
    #[test]
    fn oscillators_do_not_see_each_other() {
        let accel: Vec<f64> = (0..500).map(|i| (0.1 * f64::from(i * i)).sin()).collect();
        let periods: Vec<f64> = (1..=9).map(|i| 0.1 * f64::from(i)).collect();
        let all = ResponseSpectrum::new(periods.clone(), 0.01).of(&accel);
        for (period, s) in periods.into_iter().zip(all) {
            assert_eq!(ResponseSpectrum::new(vec![period], 0.01).of(&accel), [s]);
        }
        assert_eq!(ResponseSpectrum::new(vec![1.0], 0.01).of(&[3.0]), [0.0]);
    }
}
