//! The ground under a history, from sample to sample.

use crate::fem::step::Ground;

/// The motion of the ground, at steps of dt and linear between.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroundMotion<'a> {
    /// (s)
    pub dt: f64,
    /// (m/s2)
    pub accel: &'a [f64],
    /// The vertical component; zero beyond its last sample.
    pub vertical: &'a [f64],
    pub scale: f64,
}

impl GroundMotion<'_> {
    /// From sample i on.
    pub(super) fn ground(&self, i: usize) -> Ground {
        let Self { dt, accel, vertical, scale } = *self;
        let up = |i: usize| vertical.get(i).copied().unwrap_or(0.0);
        let slope = |now: f64, next: f64| scale * ((next - now) / dt);
        Ground {
            start: [scale * accel[i], scale * up(i)],
            slope: [slope(accel[i], accel[i + 1]), slope(up(i), up(i + 1))],
            curve: [0.0; 2],
        }
    }
}
