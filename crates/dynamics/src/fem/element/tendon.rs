//! A tendon from the mass to the ground midway between the feet: it pulls along its line once it is
//! longer than l_0.
//!
//! ```text
//!   l = hypot(X, h + Z)     T = max(0, k (l - l_0))     U = T^2/(2 k)
//! ```

use super::{Element, ElementTangent};
use crate::fem::model::{Vector, X, Z};

/// A tendon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TendonElement {
    /// k (N/m).
    pub stiffness: f64,
    /// l_0, at which it begins to pull (m).
    pub slack: f64,
    /// h, of the mass above the anchor while the structure stands unstressed (m).
    pub height: f64,
    /// T while the structure stands settled (N).
    pub pretension: f64,
}

/// Its state in one configuration.
struct TendonState {
    /// T (N).
    tension: f64,
    /// l - l_0 (m).
    stretch: f64,
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
        let stretch = length - self.slack;
        let tension = self.stiffness * stretch;
        (stretch > 0.0).then(|| TendonState {
            tension,
            stretch,
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
        self.pull(q).map_or(0.0, |pull| pull.tension * pull.stretch * 0.5)
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
