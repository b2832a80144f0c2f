//! Histories thinned for drawing.

use serde::Serialize;

/// More points than a screen is wide add nothing.
const MOST: usize = 2000;

/// How samples are thinned: every so many.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Thinning {
    every: usize,
}

/// A ground motion for drawing.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct GroundSeries {
    /// Between the values (s).
    pub step_s: f64,
    /// Of each stretch of samples the one of largest magnitude (g).
    pub accel_g: Vec<f32>,
}

impl Thinning {
    pub(crate) fn of(samples: usize) -> Self {
        Self { every: samples.div_ceil(MOST).max(1) }
    }

    /// Time between the values that are left (s).
    pub(crate) fn step(self, dt: f64) -> f64 {
        self.every as f64 * dt
    }

    /// Every so many values.
    pub(crate) fn series(self, values: impl Iterator<Item = f64>) -> Vec<f32> {
        values.step_by(self.every).map(|x| x as f32).collect()
    }

    /// Of so many values the one of largest magnitude.
    pub(crate) fn extremes(self, values: &[f64], unit: f64) -> Vec<f32> {
        let largest = |part: &[f64]| {
            part.iter().fold(0.0, |most: f64, x| if x.abs() > most.abs() { *x } else { most })
        };
        values.chunks(self.every).map(|part| (largest(part) / unit) as f32).collect()
    }

    pub(crate) fn ground(accel: &[f64], dt: f64) -> GroundSeries {
        let thin = Self::of(accel.len());
        GroundSeries {
            step_s: thin.step(dt),
            accel_g: thin.extremes(accel, rocking::scalar::GRAVITY),
        }
    }
}
