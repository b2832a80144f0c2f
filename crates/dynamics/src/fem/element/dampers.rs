//! A dashpot between each corner of the rigid body and the ground, upright.
//!
//! ```text
//!   rate of a corner   w = Z' + a theta',   a = dp_z/dtheta = h sin theta - s b cos theta
//!   F_Z = -c w         F_theta = -c w a     P = c w^2       da/dtheta = h cos theta + s b sin theta
//! ```

use super::{Element, ElementTangent};
use crate::fem::model::{Pose, SIDE, TH, Vector, Z};
use rocking::{scalar::Scalar, structure::Body};

/// Both dashpots.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dampers<S> {
    /// c of each (N s/m).
    c: S,
    half_width: S,
    height: S,
}

impl<S: Scalar> Dampers<S> {
    pub(crate) fn new(c: S, body: &Body<S>) -> Self {
        Self { c, half_width: body.half_width, height: body.height }
    }

    pub(crate) fn real(&self) -> Dampers<f64> {
        Dampers { c: self.c.re(), half_width: self.half_width.re(), height: self.height.re() }
    }

    /// Each one's force on the body, upwards (N), and its arm a (m).
    pub(crate) fn forces(&self, q: &Vector<S>, v: &Vector<S>) -> [(S, S); 2] {
        let Pose { sin, cos } = Pose::of(q);
        std::array::from_fn(|i| {
            let arm = self.height * sin - self.half_width * SIDE[i] * cos;
            (-self.c * (v[Z] + arm * v[TH]), arm)
        })
    }
}

impl<S: Scalar> Element<S> for Dampers<S> {
    fn energy(&self, _: &Vector<S>) -> S {
        S::zero()
    }

    fn force(&self, q: &Vector<S>, v: &Vector<S>) -> [S; 3] {
        let [left, right] = self.forces(q, v).map(|(force, arm)| (force, force * arm));
        [S::zero(), left.0 + right.0, left.1 + right.1]
    }

    fn tangent(&self, q: &Vector<S>, v: &Vector<S>) -> ElementTangent<S> {
        let Pose { sin, cos } = Pose::of(q);
        let (c, rate, forces) = (self.c, v[TH], self.forces(q, v));
        let one = |i: usize| {
            let (force, arm) = forces[i];
            let turning = self.half_width * SIDE[i] * sin + self.height * cos;
            [arm * c, arm * arm * c, turning * rate * c, turning * (arm * rate * c - force)]
        };
        let (l, r) = (one(0), one(1));
        let [arm, arm2, z_th, th_th] = std::array::from_fn(|k| l[k] + r[k]);
        let zero = S::zero();
        ElementTangent {
            stiffness: [[zero; 3], [zero, zero, z_th], [zero, zero, th_th]],
            damping: [[zero; 3], [zero, c + c, arm], [zero, arm, arm2]],
        }
    }

    fn dissipation(&self, q: &Vector<S>, v: &Vector<S>) -> S {
        let [left, right] = self.forces(q, v).map(|(force, arm)| -force * (v[Z] + arm * v[TH]));
        left + right
    }
}
