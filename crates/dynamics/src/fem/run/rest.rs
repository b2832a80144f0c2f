//! A body at rest on still ground needs no steps: before the record begins to shake, and once its
//! silent tail has let the body come to rest.

use super::TimeLoop;
use crate::fem::model::{N, TH};
use rocking::scalar::{GRAVITY, Scalar};

/// Forces and velocities below this, relative to the weight and to g/Omega_n, are none: the body is
/// where it would come to rest, to this share of the compression that its weight causes.
const NOTHING: f64 = 1e-9;

impl<S: Scalar> TimeLoop<'_, S> {
    /// Whether nothing moves until the next sample. Only for real numbers: a derivative may still
    /// move where its value rests.
    pub(super) fn rests(&mut self) -> bool {
        let ground = &self.ground;
        let silent = ground.start.iter().chain(&ground.slope).all(|x| x.re() == 0.0);
        let skips = self.control.skip_rest && self.control.extra_iterations == 0;
        self.resting = skips && silent && (self.resting || self.is_still());
        self.resting
    }

    fn is_still(&self) -> bool {
        if !self.feet.iter().all(|foot| foot.holds()) {
            return false;
        }
        let radius = self.model.body.radius().re();
        let (weight, speed) = (self.model.body.mass.re() * GRAVITY, GRAVITY * self.settling);
        let length = |k: usize| if k == TH { radius } else { 1.0 };
        let forces = self.model.forces(&self.state.q, &self.state.v, &self.feet, [S::zero(); 2]);
        (0..N).all(|k| {
            let (force, rate) = (forces[k].re() / length(k), self.state.v[k].re() * length(k));
            force.abs() <= NOTHING * weight && rate.abs() <= NOTHING * speed
        })
    }
}
