//! Numbers that describe a record: peaks, duration, offset.
//!
//! ```text
//! v(t) = int a dt, from rest, a linear between samples
//! Arias (1970):  I(t) = pi/(2 g) int a^2 dt;  D = t(0.95 I) - t(0.05 I)
//! ```

use std::f64::consts::PI;

use super::{Peak, Record, parsed};
use crate::GRAVITY;

/// What describes a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// Peak ground acceleration (m/s2), with its sign, and its time.
    pub pga: Peak,
    /// Peak ground velocity (m/s) by integrating the acceleration from rest, less its mean.
    pub pgv: Peak,
    /// Arias intensity pi/(2 g) int a^2 dt (m/s).
    pub arias_m_per_s: f64,
    /// Time between 5 and 95 % of the Arias intensity (s).
    pub duration_5_95_s: f64,
    /// Mean acceleration (m/s2).
    pub offset: f64,
    /// Period of the strongest pulse, 2 pi PGV/PGA (s): of a sine of these peaks.
    pub pulse_period_s: f64,
}

impl Record {
    /// Ground velocity at the samples (m/s): the integral from rest of the acceleration, linear
    /// between samples, less its mean, so that the ground is at rest again at the end: what is left
    /// over in a recording is an error of the instrument.
    pub fn velocity(&self) -> Vec<f64> {
        let steps = self.accel.len().saturating_sub(1).max(1) as f64;
        let mut velocity = self.velocity_from_rest();
        let last = velocity.last().copied().unwrap_or(0.0);
        for (i, value) in velocity.iter_mut().enumerate() {
            *value -= last * i as f64 / steps;
        }
        velocity
    }

    /// The same with its mean (m/s): of a pulse in closed form, which may leave the ground moving.
    pub fn velocity_from_rest(&self) -> Vec<f64> {
        let mut v = 0.0;
        let steps = self.accel.windows(2).map(|pair| {
            v += 0.5 * (pair[0] + pair[1]) * self.dt;
            v
        });
        std::iter::once(0.0).chain(steps).take(self.accel.len()).collect()
    }

    /// What describes the record.
    pub fn measures(&self) -> Measures {
        let pga = Peak::of(&self.accel, self.dt);
        let pgv = Peak::of(&self.velocity(), self.dt);
        let (arias, duration) = self.arias();
        Measures {
            pga,
            pgv,
            arias_m_per_s: arias,
            duration_5_95_s: duration,
            offset: parsed::mean(&self.accel),
            pulse_period_s: if pga.value == 0.0 {
                0.0
            } else {
                2.0 * PI * (pgv.value / pga.value).abs()
            },
        }
    }

    /// Arias intensity and the time between 5 and 95 % of it.
    fn arias(&self) -> (f64, f64) {
        // int a^2 over a step of a linear a: (a0^2 + a0 a1 + a1^2) dt/3
        let mut sums = vec![0.0];
        for pair in self.accel.windows(2) {
            let step = (pair[0] * pair[0] + pair[0] * pair[1] + pair[1] * pair[1]) * self.dt / 3.0;
            sums.push(sums[sums.len() - 1] + step);
        }
        let all = sums[sums.len() - 1];
        if all <= 0.0 {
            return (0.0, 0.0);
        }
        let time = |share: f64| {
            let i = sums.partition_point(|sum| *sum < share * all).clamp(1, sums.len() - 1);
            let (before, after) = (sums[i - 1], sums[i]);
            (i as f64 - (after - share * all) / (after - before)) * self.dt
        };
        (PI / (2.0 * GRAVITY) * all, time(0.95) - time(0.05))
    }
}

/// The same, for the Python package and tests.
pub fn measures(record: &Record) -> Measures {
    record.measures()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a = A sin(w t) over one period, A = 2, w = 2 pi: v = A/w (1 - cos w t) has the peak 2 A/w at
    /// half the period; I = pi/(2 g) A^2 T/2.
    #[test]
    fn one_sine_has_its_closed_forms() {
        let n = 4000;
        let accel = (0..=n).map(|i| 2.0 * (2.0 * PI * f64::from(i) / f64::from(n)).sin()).collect();
        let record = Record::new("sine", 1.0 / f64::from(n), accel).unwrap();
        let m = record.measures();
        assert!((m.pga.value - 2.0).abs() < 1e-12 && (m.pga.time.unwrap() - 0.25).abs() < 1e-9);
        assert!((m.pgv.value - 2.0 / PI).abs() < 1e-6, "{m:?}");
        assert!((m.pgv.time.unwrap() - 0.5).abs() < 1e-9);
        assert!((m.arias_m_per_s - PI / (2.0 * GRAVITY) * 2.0).abs() < 1e-6, "{m:?}");
        assert!(m.offset.abs() < 1e-12);
        assert!((m.pulse_period_s - 2.0).abs() < 1e-5, "{m:?}");
    }

    /// A half sine leaves the ground moving at 2 A/w, however long a silence follows.
    #[test]
    fn a_half_sine_ends_at_its_peak_velocity() {
        let accel = (0..=1000).map(|i| (2.0 * PI * f64::from(i.min(500)) / 1000.0).sin()).collect();
        let velocity = Record::new("half-sine", 1e-3, accel).unwrap().velocity_from_rest();
        assert_eq!((velocity.len(), velocity[0]), (1001, 0.0));
        assert!((velocity[1000] - 1.0 / PI).abs() < 1e-5, "{}", velocity[1000]);
    }

    /// A constant acceleration: the Arias intensity grows evenly, 5 to 95 % take 0.9 of the record;
    /// the velocity less its mean slope is zero.
    #[test]
    fn a_constant_has_its_closed_forms() {
        let m = Record::new("constant", 0.1, vec![3.0; 101]).unwrap().measures();
        assert!((m.duration_5_95_s - 9.0).abs() < 1e-9, "{m:?}");
        assert!((m.arias_m_per_s - PI / (2.0 * GRAVITY) * 90.0).abs() < 1e-9);
        assert!(m.pgv.value.abs() < 1e-12 && m.offset == 3.0);
        let still = Record::new("still", 0.1, vec![0.0; 3]).unwrap().measures();
        assert_eq!((still.duration_5_95_s, still.pulse_period_s), (0.0, 0.0));
    }
}
