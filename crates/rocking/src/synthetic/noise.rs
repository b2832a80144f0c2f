//! Filtered white noise under an envelope: an earthquake far from its fault.
//!
//! ```text
//! a(t) = E(t) F[w](t) - E(t) (c0 + c1 t/T)
//! F: Kanai-Tajimi    (1 + 2 zeta_g s) / (1 + 2 zeta_g s + s^2),   s = i omega/omega_g
//!    Clough-Penzien  s^2 / (1 + 2 zeta_f s + s^2),                s = i omega/omega_f, omega_f = omega_g/10
//!    Butterworth of order 4, low pass at omega_c = 4 omega_g
//! E(t) = (e x/eps)^b exp(-b x/eps) scaled, x = t/T,   b = -eps ln eta/[1 + eps (ln eps - 1)]
//! ```
//!
//! The soil layer of K. Kanai (1957) and H. Tajimi (1960) with the high pass of R. Clough and J.
//! Penzien (1975); the envelope of G. R. Saragoni and G. C. Hart (1974) as D. M. Boore (2003), Pure
//! and Applied Geophysics 160, writes it: peak 1 at x = eps, value eta at x = 1. c0 and c1 make the
//! ground's velocity and displacement zero at the end.

use super::random::Random;

/// One filtered noise.
pub(super) struct Noise {
    /// Circular frequency of the soil layer (rad/s).
    pub omega_g: f64,
    /// Its damping ratio.
    pub zeta_g: f64,
    /// T, duration (s).
    pub duration: f64,
}

/// Where the envelope peaks, and what is left of it at the end: Boore's values.
const EPS: f64 = 0.2;
const ETA: f64 = 0.05;

impl Noise {
    /// Accelerations, of no particular amplitude, at time steps dt (s).
    pub(super) fn sampled(&self, dt: f64, random: &mut Random) -> Vec<f64> {
        let n = (self.duration / dt).ceil() as usize;
        let mut filters = self.filters(dt);
        let mut filter = |w: f64| filters.iter_mut().fold(w, |x, filter| filter.next(x));
        // the filters' memory is full after a few periods of the slowest, the high pass
        for _ in 0..(30.0 / (HIGH_PASS * self.omega_g * dt)).ceil() as usize {
            filter(random.normal());
        }
        let weight: Vec<f64> = (0..=n).map(|i| envelope(i as f64 / n as f64)).collect();
        let mut accel: Vec<f64> = weight.iter().map(|e| e * filter(random.normal())).collect();
        // the last sample is the start of the silence that follows
        accel[n] = 0.0;
        rest_at_end(&mut accel, &weight[..n], dt);
        accel
    }

    fn filters(&self, dt: f64) -> [Biquad; 4] {
        let kanai_tajimi =
            Biquad::new(self.omega_g, dt, [1.0, 2.0 * self.zeta_g, 0.0], self.zeta_g);
        let clough_penzien = Biquad::new(HIGH_PASS * self.omega_g, dt, [0.0, 0.0, 1.0], 0.6);
        // poles of the Butterworth filter of order 4: damping ratios cos(pi/8), cos(3 pi/8)
        let [first, second] = [1.0_f64, 3.0].map(|k| {
            let zeta = (k * std::f64::consts::FRAC_PI_8).cos();
            Biquad::new(LOW_PASS * self.omega_g, dt, [1.0, 0.0, 0.0], zeta)
        });
        [kanai_tajimi, clough_penzien, first, second]
    }
}

/// omega_f/omega_g and omega_c/omega_g.
const HIGH_PASS: f64 = 0.1;
const LOW_PASS: f64 = 4.0;

fn envelope(x: f64) -> f64 {
    let b = -EPS * ETA.ln() / (1.0 + EPS * (EPS.ln() - 1.0));
    (x / EPS * (1.0 - x / EPS).exp()).powf(b)
}

/// Velocity and displacement at the end of an acceleration that is linear between samples, from
/// rest.
fn end_of(accel: impl Iterator<Item = f64> + Clone, dt: f64) -> [f64; 2] {
    let (mut velocity, mut displacement) = (0.0, 0.0);
    for (left, right) in accel.clone().zip(accel.skip(1)) {
        displacement += dt * velocity + dt * dt * (2.0 * left + right) / 6.0;
        velocity += dt * (left + right) / 2.0;
    }
    [velocity, displacement]
}

/// Subtract E (c0 + c1 x) so that the ground ends at rest where it began; the weight E is one
/// sample shorter.
pub(super) fn rest_at_end(accel: &mut [f64], weight: &[f64], dt: f64) {
    let constant = weight.iter().copied().chain([0.0]);
    let linear =
        weight.iter().enumerate().map(|(i, e)| e * i as f64 / weight.len() as f64).chain([0.0]);
    let [v, d] = end_of(accel.iter().copied(), dt);
    let [v0, d0] = end_of(constant.clone(), dt);
    let [v1, d1] = end_of(linear.clone(), dt);
    let determinant = v0 * d1 - v1 * d0;
    let (c0, c1) = ((v * d1 - v1 * d) / determinant, (v0 * d - v * d0) / determinant);
    for ((a, e0), e1) in accel.iter_mut().zip(constant).zip(linear) {
        *a -= c0 * e0 + c1 * e1;
    }
}

/// (b0 + b1 s + b2 s^2)/(1 + 2 zeta s + s^2), s = i omega/omega_0, by the bilinear transform that
/// is exact at omega_0.
struct Biquad {
    numerator: [f64; 3],
    denominator: [f64; 2],
    memory: [f64; 2],
}

impl Biquad {
    fn new(omega_0: f64, dt: f64, [b0, b1, b2]: [f64; 3], zeta: f64) -> Self {
        let k = 1.0 / (omega_0 * dt / 2.0).tan(); // s -> k (1 - 1/z)/(1 + 1/z)
        let expand = |c0: f64, c1: f64, c2: f64| {
            [c0 + k * (c1 + k * c2), 2.0 * (c0 - k * k * c2), c0 - k * (c1 - k * c2)]
        };
        let [a0, a1, a2] = expand(1.0, 2.0 * zeta, 1.0);
        Self {
            numerator: expand(b0, b1, b2).map(|b| b / a0),
            denominator: [a1 / a0, a2 / a0],
            memory: [0.0; 2],
        }
    }

    fn next(&mut self, x: f64) -> f64 {
        let ([b0, b1, b2], [a1, a2]) = (self.numerator, self.denominator);
        let y = b0 * x + self.memory[0];
        self.memory = [b1 * x - a1 * y + self.memory[1], b2 * x - a2 * y];
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// |response| at omega of filters in a row, by the Fourier sum of their impulse response.
    fn gain(mut filters: Vec<Biquad>, omega: f64, dt: f64) -> f64 {
        let (mut re, mut im) = (0.0, 0.0);
        for i in 0..200_000 {
            let y =
                filters.iter_mut().fold(if i == 0 { 1.0 } else { 0.0 }, |x, filter| filter.next(x));
            let phase = omega * dt * f64::from(i);
            re += y * phase.cos();
            im += y * phase.sin();
        }
        f64::hypot(re, im)
    }

    /// Closed forms: |H|^2 = (1 + 4 zeta^2)/(4 zeta^2) of Kanai-Tajimi at omega_g, 1/(2 zeta_f) of
    /// Clough-Penzien at omega_f, 1/sqrt 2 of Butterworth at its corner.
    #[test]
    fn filters_have_their_closed_form_gain_at_their_frequency() {
        let (noise, dt) = (Noise { omega_g: 12.0, zeta_g: 0.35, duration: 20.0 }, 0.005);
        let [soil, high_pass, low_1, low_2] = noise.filters(dt);
        let exact = (1.0 + 4.0 * 0.35_f64.powi(2)).sqrt() / (2.0 * 0.35);
        assert!((gain(vec![soil], 12.0, dt) - exact).abs() < 1e-9);
        assert!((gain(vec![high_pass], 1.2, dt) - 1.0 / 1.2).abs() < 1e-9);
        assert!((gain(vec![low_1, low_2], 48.0, dt) - 0.5_f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn the_envelope_peaks_at_eps_and_ends_at_eta() {
        assert_eq!(envelope(0.0), 0.0);
        assert!((envelope(EPS) - 1.0).abs() < 1e-15);
        assert!((envelope(1.0) - ETA).abs() < 1e-15);
        assert!((0..=100).all(|i| envelope(f64::from(i) / 100.0) <= 1.0));
    }

    #[test]
    fn the_ground_ends_at_rest_where_it_began() {
        for duration in [10.0, 17.3, 30.0] {
            let noise = Noise { omega_g: 5.0, zeta_g: 0.3, duration };
            let accel = noise.sampled(0.01, &mut Random::new(7, 0));
            let largest = strong_motion::largest_magnitude(&accel);
            let [velocity, displacement] = end_of(accel.iter().copied(), 0.01);
            assert!(velocity.abs() < 1e-12 * largest * duration, "{velocity}");
            assert!(displacement.abs() < 1e-12 * largest * duration * duration, "{displacement}");
            assert_eq!((accel[0], accel.last()), (0.0, Some(&0.0)));
        }
    }

    /// Share of the power below omega_f/5 and above 2 omega_c, by Parseval's theorem.
    #[test]
    fn nearly_all_power_lies_between_the_corners() {
        let (noise, dt) = (Noise { omega_g: 12.0, zeta_g: 0.35, duration: 20.0 }, 0.005);
        for seed in 0..3 {
            let accel = noise.sampled(dt, &mut Random::new(seed, 0));
            let total = accel.iter().map(|a| a * a).sum::<f64>() / 2.0;
            let power = |omega: f64| {
                let (mut re, mut im) = (0.0, 0.0);
                for (i, a) in accel.iter().enumerate() {
                    re += a * (omega * dt * i as f64).cos();
                    im += a * (omega * dt * i as f64).sin();
                }
                re * re + im * im
            };
            let n = accel.len();
            let share = |low: f64, high: f64| {
                let step = std::f64::consts::TAU / (n as f64 * dt);
                let bins =
                    (0..n / 2).map(|k| k as f64 * step).filter(|omega| (low..high).contains(omega));
                bins.map(power).sum::<f64>() / n as f64 / total
            };
            assert!(share(0.0, 0.24) < 2e-3, "low: {}", share(0.0, 0.24));
            assert!(share(96.0, 1e9) < 2e-3, "high: {}", share(96.0, 1e9));
            assert!(share(6.0, 24.0) > 0.6, "middle: {}", share(6.0, 24.0));
        }
    }
}
