//! Forces without the spikes of landings: a low-pass filter without delay.
//!
//! Butterworth's of order 4, forwards and backwards, so that it delays nothing, its gain at the
//! stated frequency is 1/2, and at twice that 1/257 (before the bilinear change of frequency, which
//! is undone at the stated one). Oppenheim and Schafer, *Discrete-Time Signal Processing*, section
//! 7.1. Series are held at their first and last value beyond their ends.

use std::f64::consts::{FRAC_PI_8, PI};

/// One section of order two: y_i = b0 x_i + b1 x_(i-1) + b2 x_(i-2) - a1 y_(i-1) - a2 y_(i-2).
struct FilterSection {
    b: [f64; 3],
    a: [f64; 2],
}

impl FilterSection {
    /// A pair of poles of this damping ratio, of the low-pass at w = tan(pi f dt).
    fn new(w: f64, damping: f64) -> Self {
        let scale = 1.0 / (1.0 + 2.0 * damping * w + w * w);
        let b = w * w * scale;
        Self {
            b: [b, 2.0 * b, b],
            a: [2.0 * (w * w - 1.0) * scale, (1.0 - 2.0 * damping * w + w * w) * scale],
        }
    }

    /// In place, from a past in which everything was the first value.
    fn run<'a>(&self, series: impl Iterator<Item = &'a mut f64>) {
        let mut past: Option<[f64; 4]> = None;
        for value in series {
            let [x1, x2, y1, y2] = past.unwrap_or([*value; 4]);
            let [b0, b1, b2] = self.b;
            let y = b0 * *value + b1 * x1 + b2 * x2 - self.a[0] * y1 - self.a[1] * y2;
            past = Some([*value, x1, y, y1]);
            *value = y;
        }
    }
}

/// Whether samples dt (s) apart have this frequency (Hz): it lies below half of theirs.
pub fn resolves(dt: f64, frequency: f64) -> bool {
    frequency > 0.0 && frequency * dt < 0.5
}

/// The series without what is faster than `frequency` (Hz), samples dt (s) apart. The series itself
/// if its samples do not have that frequency.
pub fn low_pass(series: &[f64], dt: f64, frequency: f64) -> Vec<f64> {
    let mut out = series.to_vec();
    if !resolves(dt, frequency) {
        return out;
    }
    let w = (PI * frequency * dt).tan();
    let sections = [FRAC_PI_8, 3.0 * FRAC_PI_8].map(|angle| FilterSection::new(w, angle.cos()));
    for section in &sections {
        section.run(out.iter_mut());
    }
    for section in &sections {
        section.run(out.iter_mut().rev());
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_slow_passes_and_what_is_fast_does_not() {
        let (dt, n) = (0.005, 4000);
        let gain = |frequency: f64| {
            let wave: Vec<f64> =
                (0..n).map(|i| (2.0 * PI * frequency * i as f64 * dt).sin()).collect();
            let out = low_pass(&wave, dt, 10.0);
            let middle = n / 4..3 * n / 4;
            let (mut power, mut whole) = (0.0, 0.0);
            for i in middle {
                power += wave[i] * out[i];
                whole += wave[i] * wave[i];
            }
            power / whole
        };
        // 1/(1 + (f/f_c)^8) with both frequencies as the bilinear change has them
        for frequency in [1.0, 5.0, 10.0, 20.0] {
            let ratio = (PI * frequency * dt).tan() / (PI * 10.0 * dt).tan();
            let exact = 1.0 / (1.0 + ratio.powi(8));
            assert!(
                (gain(frequency) - exact).abs() < 1e-3,
                "{frequency}: {} {exact}",
                gain(frequency)
            );
        }
        assert!(low_pass(&[2.5; 50], dt, 10.0).iter().all(|x| (x - 2.5).abs() < 1e-12));
        assert_eq!(low_pass(&[1.0, 2.0], dt, 200.0), [1.0, 2.0]);
    }
}
