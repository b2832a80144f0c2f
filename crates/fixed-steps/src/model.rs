//! What a program with fixed time steps steps.

use frames::frame::EquilibriumError;

use crate::{
    contact::FixedFoot,
    kinematics::{TangentWeights, Trial},
};

/// A structure on ground springs.
///
/// ```text
///   M a = Q(q, v, t) + forces of the ground on its feet
/// ```
pub trait FixedStepModel {
    /// Its coordinates: an array or a vector.
    type Vector: Clone + AsRef<[f64]> + AsMut<[f64]>;
    /// Its feet: an array or a vector.
    type Feet: Clone + AsRef<[FixedFoot]> + AsMut<[FixedFoot]>;
    /// Where its feet are at some q, and how they move with it.
    type Places: Clone;
    /// A matrix, ready to solve with.
    type Factor;

    /// At rest on all feet, settled under its weight.
    ///
    /// # Errors
    /// It has no equilibrium.
    fn standing(&self) -> Result<(Self::Vector, Self::Feet), EquilibriumError>;

    /// The places of its feet at q.
    fn places(&self, q: &Self::Vector) -> Self::Places;

    /// Decide which feet are closed at q, where they are at `places`.
    fn meet(&self, places: &Self::Places, q: &Self::Vector, feet: &mut Self::Feet);

    /// The same in a trial that follows another one: a foot is a node of its own at the end of a
    /// leg, and stands where the iteration's linear equations put it, not where the leg turns to.
    /// A model without legs that turn meets there as anywhere.
    fn meet_after(
        &self,
        _before: (&Self::Places, &Self::Vector),
        q: &Self::Vector,
        feet: &mut Self::Feet,
    ) {
        self.meet(&self.places(q), q, feet);
    }

    /// The same at the end q of a step whose forces count at `places`, a part w of the step: the
    /// foot's own node goes on along a straight line, from where it was at the step's begin (and
    /// stays there if w is infinite). This no longer changes the forces of the step, only the
    /// anchors for the next one.
    fn meet_end(&self, places: &Self::Places, _w: f64, q: &Self::Vector, feet: &mut Self::Feet) {
        self.meet(places, q, feet);
    }

    /// Q + forces of the ground - M a of a trial and its places, at ground acceleration (a_g, a_v)
    /// (m/s2), a_v upwards; feet as they were met there. N, N m.
    fn unbalance(
        &self,
        trial: (&Trial<Self::Vector>, &Self::Places),
        feet: &Self::Feet,
        ground: [f64; 2],
        out: &mut Self::Vector,
    );

    /// Norm of what an iteration leaves (N, N m), as a model has it whose feet are nodes of their
    /// own: a contact that changes leaves a force on the foot's node and its opposite on the
    /// absorber, not a moment about the mass.
    fn unbalance_norm(&self, _places: &Self::Places, unbalance: &Self::Vector) -> f64 {
        unbalance.as_ref().iter().map(|f| f * f).sum::<f64>().sqrt()
    }

    /// M, C and K at a trial with these weights, factored; `None` if it is singular.
    fn factor(
        &self,
        trial: (&Trial<Self::Vector>, &Self::Places),
        feet: &Self::Feet,
        weights: &TangentWeights,
    ) -> Option<Self::Factor>;

    /// The change of place that the matrix makes of an unbalance, in place.
    fn solve(&self, factor: &Self::Factor, right: &mut Self::Vector);

    /// Compression of every gap, above zero while it presses, and its rate [m, m/s].
    fn gaps(&self, _q: &Self::Vector, _v: &Self::Vector, _each: impl FnMut(f64, f64)) {}

    /// Whether it lies on the ground, or cannot be followed any more: the history ends.
    fn has_fallen(&self, _q: &Self::Vector) -> bool {
        false
    }

    /// Whether it leans so far that a program that gives up here has lost a falling structure: its
    /// foot slides, which no foot of this law can.
    fn is_falling(&self, _q: &Self::Vector) -> bool {
        false
    }
}
