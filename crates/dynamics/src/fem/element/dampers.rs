//! A dashpot between each corner of the rigid body and the ground, upright.
//!
//! ```text
//!   rate of a corner   w = Z' + a theta',   a = dp_z/dtheta = h sin theta - s b cos theta
//!   F_Z = -c w         F_theta = -c w a     P = c w^2       da/dtheta = h cos theta + s b sin theta
//! ```
//!
//! Of dampers that do not turn the body a = 0: they follow its mass.

use super::{Element, ElementTangent};
use crate::fem::model::{Pose, SIDE, TH, Vector, Z};
use rocking::structure::Body;

/// Both dashpots.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dampers {
    /// c of each (N s/m).
    c: f64,
    half_width: f64,
    height: f64,
    /// Whether they turn the body.
    turn: bool,
}

impl Dampers {
    pub(crate) fn new(c: f64, body: &Body<f64>) -> Self {
        Self { c, half_width: body.half_width, height: body.height, turn: true }
    }

    /// The same, but that they do not turn the body.
    pub(crate) fn aloft(self) -> Self {
        Self { turn: false, ..self }
    }

    /// c of each (N s/m).
    pub(crate) fn c(&self) -> f64 {
        self.c
    }

    /// dp_z/dtheta of corner i and its derivative (m).
    fn arm(&self, i: usize, q: &Vector) -> (f64, f64) {
        if !self.turn {
            return (0.0, 0.0);
        }
        let Pose { sin, cos } = Pose::of(q);
        let sb = self.half_width * SIDE[i];
        (self.height * sin - sb * cos, sb * sin + self.height * cos)
    }

    /// Each one's force on the body, upwards (N), and its arm a (m).
    pub(crate) fn forces(&self, q: &Vector, v: &Vector) -> [(f64, f64); 2] {
        std::array::from_fn(|i| {
            let (arm, _) = self.arm(i, q);
            (-self.c * (v[Z] + arm * v[TH]), arm)
        })
    }
}

impl Element for Dampers {
    fn energy(&self, _: &Vector) -> f64 {
        0.0
    }

    fn force(&self, q: &Vector, v: &Vector) -> [f64; 3] {
        let [left, right] = self.forces(q, v).map(|(force, arm)| (force, force * arm));
        [0.0, left.0 + right.0, left.1 + right.1]
    }

    fn tangent(&self, q: &Vector, v: &Vector) -> ElementTangent {
        let (c, rate, forces) = (self.c, v[TH], self.forces(q, v));
        let one = |i: usize| {
            let (force, arm) = forces[i];
            let (_, turning) = self.arm(i, q);
            [arm * c, arm * arm * c, turning * rate * c, turning * (arm * rate * c - force)]
        };
        let (l, r) = (one(0), one(1));
        let [arm, arm2, z_th, th_th] = std::array::from_fn(|k| l[k] + r[k]);
        ElementTangent {
            stiffness: [[0.0; 3], [0.0, 0.0, z_th], [0.0, 0.0, th_th]],
            damping: [[0.0; 3], [0.0, c + c, arm], [0.0, arm, arm2]],
        }
    }

    fn dissipation(&self, q: &Vector, v: &Vector) -> f64 {
        let [left, right] = self.forces(q, v).map(|(force, arm)| -force * (v[Z] + arm * v[TH]));
        left + right
    }
}
