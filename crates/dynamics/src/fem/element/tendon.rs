//! A tendon from the mass to the ground midway between the feet: it pulls along its line once it is
//! longer than when slack.
//!
//! ```text
//!   l = hypot(X, h + Z)     l_s = h + Z_s settled     T = max(0, k (e + l - l_s)),  e = N_0/k
//!   U = k (l - l_s) (e + (l - l_s)/2)      l - l_s = (X^2 + (Z - Z_s)(2 h + Z + Z_s))/(l + l_s)
//! ```
//!
//! The energy counts from the settled structure, and l - l_s without a difference of lengths: on
//! stiff springs a body at rest moves by less than what rounding makes of its height.

use super::{Element, ElementTangent};
use crate::fem::model::{Vector, X, Z};

/// A tendon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TendonElement {
    /// k (N/m).
    pub stiffness: f64,
    /// e, by which it is longer than when slack while the structure stands settled; below zero it
    /// is slack then (m).
    pub elongation: f64,
    /// Z_s, of the mass while the structure stands settled (m).
    pub settled: f64,
    /// h, of the mass above the anchor while the structure stands unstressed (m).
    pub height: f64,
    /// T while the structure stands settled (N).
    pub pretension: f64,
}

/// Its state in one configuration.
struct TendonState {
    /// T (N).
    tension: f64,
    /// l - l_s (m).
    longer: f64,
    /// l (m).
    length: f64,
    /// From the anchor to the mass.
    direction: [f64; 2],
}

impl TendonElement {
    /// Its pull; none while it is slack.
    fn pull(&self, q: &Vector) -> Option<TendonState> {
        let (x, z) = (q[X], self.height + q[Z]);
        let length = (x * x + z * z).sqrt();
        let settled = self.height + self.settled;
        let longer = (x * x + (q[Z] - self.settled) * (z + settled)) / (length + settled);
        let stretch = self.elongation + longer;
        let tension = self.stiffness * stretch;
        (stretch > 0.0).then(|| TendonState {
            tension,
            longer,
            length,
            direction: [x / length, z / length],
        })
    }

    /// T (N).
    pub(crate) fn tension(&self, q: &Vector) -> f64 {
        self.pull(q).map_or(0.0, |pull| pull.tension)
    }

    /// Force on the mass, horizontal and vertical (N).
    pub(crate) fn force_on_mass(&self, q: &Vector) -> [f64; 2] {
        self.pull(q).map_or([0.0; 2], |TendonState { tension, direction: [ux, uz], .. }| {
            [-tension * ux, -tension * uz]
        })
    }
}

impl Element for TendonElement {
    fn energy(&self, q: &Vector) -> f64 {
        let (k, e) = (self.stiffness, self.elongation.max(0.0));
        match self.pull(q) {
            None => -0.5 * k * e * e,
            Some(pull) if e > 0.0 => k * pull.longer * (e + 0.5 * pull.longer),
            Some(pull) => 0.5 * pull.tension * pull.tension / k,
        }
    }

    fn force(&self, q: &Vector, _: &Vector) -> [f64; 3] {
        let [x, z] = self.force_on_mass(q);
        [x, z, 0.0]
    }

    fn tangent(&self, q: &Vector, _: &Vector) -> ElementTangent {
        let none = [[0.0; 3]; 3];
        let Some(TendonState { tension, length, direction: [ux, uz], .. }) = self.pull(q) else {
            return ElementTangent { stiffness: none, damping: none };
        };
        let across = tension / length;
        let along = self.stiffness - across;
        let mixed = along * ux * uz;
        let stiffness = [
            [across + along * ux * ux, mixed, 0.0],
            [mixed, across + along * uz * uz, 0.0],
            [0.0; 3],
        ];
        ElementTangent { stiffness, damping: none }
    }

    fn dissipation(&self, _: &Vector, _: &Vector) -> f64 {
        0.0
    }
}
