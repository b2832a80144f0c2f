//! A body at rest on still ground needs no steps: before the record begins to shake, and once its
//! silent tail has let the body come to rest.

use super::TimeLoop;
use crate::fem::model::{N, TH};
use rocking::scalar::GRAVITY;

/// Forces and velocities below this, relative to the weight and to g/Omega_n, are none: the body is
/// where it would come to rest, to this share of the compression that its weight causes.
const NOTHING: f64 = 1e-9;

impl TimeLoop<'_> {
    /// Whether nothing moves until the next sample.
    pub(super) fn rests(&mut self) -> bool {
        let ground = &self.ground;
        let silent = ground.start.iter().chain(&ground.slope).all(|&x| x == 0.0);
        let skips = self.control.skip_rest && silent;
        self.resting = skips && (self.resting || self.is_still());
        self.resting
    }

    fn is_still(&self) -> bool {
        if !self.feet.iter().all(|foot| foot.holds()) {
            return false;
        }
        let radius = self.model.body.radius();
        let (weight, speed) = (self.model.body.mass * GRAVITY, GRAVITY * self.settling);
        let length = |k: usize| if k == TH { radius } else { 1.0 };
        let forces = self.model.forces(&self.state.q, &self.state.v, &self.feet, [0.0; 2]);
        (0..N).all(|k| {
            let (force, rate) = (forces[k] / length(k), self.state.v[k] * length(k));
            force.abs() <= NOTHING * weight && rate.abs() <= NOTHING * speed
        })
    }
}
