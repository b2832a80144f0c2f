//! A tendon from the mass to the ground midway between the feet: it pulls along its line once it is
//! longer than l_0.
//!
//! ```text
//!   l = hypot(X, h + Z)     T = max(0, k (l - l_0))     U = T^2/(2 k)
//! ```

use super::{Element, ElementTangent};
use crate::fem::model::{Vector, X, Z};
use rocking::scalar::Scalar;

/// A tendon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TendonElement<S> {
    /// k (N/m).
    pub stiffness: S,
    /// l_0, at which it begins to pull (m).
    pub slack: S,
    /// h, of the mass above the anchor while the structure stands unstressed (m).
    pub height: S,
    /// T while the structure stands settled (N).
    pub pretension: S,
}

/// Its state in one configuration.
struct TendonState<S> {
    /// T (N).
    tension: S,
    /// l - l_0 (m).
    stretch: S,
    /// l (m).
    length: S,
    /// From the anchor to the mass.
    direction: [S; 2],
}

impl<S: Scalar> TendonElement<S> {
    pub(crate) fn real(&self) -> TendonElement<f64> {
        let Self { stiffness, slack, height, pretension } = self;
        TendonElement {
            stiffness: stiffness.re(),
            slack: slack.re(),
            height: height.re(),
            pretension: pretension.re(),
        }
    }

    /// Its pull; none while it is slack.
    fn pull(&self, q: &Vector<S>) -> Option<TendonState<S>> {
        let (x, z) = (q[X], self.height + q[Z]);
        let length = (x * x + z * z).sqrt();
        let stretch = length - self.slack;
        let tension = self.stiffness * stretch;
        (stretch.re() > 0.0).then(|| TendonState {
            tension,
            stretch,
            length,
            direction: [x / length, z / length],
        })
    }

    /// T (N).
    pub(crate) fn tension(&self, q: &Vector<S>) -> S {
        self.pull(q).map_or(S::zero(), |pull| pull.tension)
    }

    /// Force on the mass, horizontal and vertical (N).
    pub(crate) fn force_on_mass(&self, q: &Vector<S>) -> [S; 2] {
        self.pull(q)
            .map_or([S::zero(); 2], |TendonState { tension, direction: [ux, uz], .. }| {
                [-tension * ux, -tension * uz]
            })
    }
}

impl<S: Scalar> Element<S> for TendonElement<S> {
    fn energy(&self, q: &Vector<S>) -> S {
        self.pull(q).map_or(S::zero(), |pull| pull.tension * pull.stretch * 0.5)
    }

    fn force(&self, q: &Vector<S>, _: &Vector<S>) -> [S; 3] {
        let [x, z] = self.force_on_mass(q);
        [x, z, S::zero()]
    }

    fn tangent(&self, q: &Vector<S>, _: &Vector<S>) -> ElementTangent<S> {
        let zero = S::zero();
        let none = [[zero; 3]; 3];
        let Some(TendonState { tension, length, direction: [ux, uz], .. }) = self.pull(q) else {
            return ElementTangent { stiffness: none, damping: none };
        };
        let across = tension / length;
        let along = self.stiffness - across;
        let mixed = along * ux * uz;
        let stiffness = [
            [across + along * ux * ux, mixed, zero],
            [mixed, across + along * uz * uz, zero],
            [zero; 3],
        ];
        ElementTangent { stiffness, damping: none }
    }

    fn dissipation(&self, _: &Vector<S>, _: &Vector<S>) -> S {
        S::zero()
    }
}
