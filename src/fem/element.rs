//! Elements between the body and the ground. Each gives its energy, its force on the body's coordinates X, Z, theta, the tangent of that
//! force and the power it takes; the model adds them up. Legs are no such element: they stand between the body and the contact (`frame`).
//!
//! ```text
//!   F = -dU/dq + F_d(q, q')      K = -dF/dq      C = -dF/dq'      power taken  P = -F_d . q'
//! ```

mod dampers;
mod tendon;

pub(crate) use dampers::Dampers;
pub(crate) use tendon::Tendon;

use super::{
    leg::Leg,
    model::{TH, Vector, X, Z},
};
use crate::{members::Members, scalar::Scalar, structure::Body};

/// K [N/m, N, N m] and C [N s/m, N s, N m s] of an element, rows and columns X, Z, theta.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementTangent<S> {
    pub stiffness: [[S; 3]; 3],
    pub damping: [[S; 3]; 3],
}

/// What stands between the body and the ground.
pub(crate) trait Element<S: Scalar> {
    /// U [J].
    fn energy(&self, q: &Vector<S>) -> S;
    /// Force on X, Z [N] and theta [N m].
    fn force(&self, q: &Vector<S>, v: &Vector<S>) -> [S; 3];
    /// How that force changes.
    fn tangent(&self, q: &Vector<S>, v: &Vector<S>) -> ElementTangent<S>;
    /// P [W].
    fn dissipation(&self, q: &Vector<S>, v: &Vector<S>) -> S;
}

/// All that a body has besides its springs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Elements<S> {
    pub leg: Option<Leg<S>>,
    pub dampers: Option<Dampers<S>>,
    pub tendon: Option<Tendon<S>>,
}

impl<S> Elements<S> {
    /// A rigid body's.
    pub const NONE: Self = Self { leg: None, dampers: None, tendon: None };

    /// Whether there are none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.leg.is_none() && self.dampers.is_none() && self.tendon.is_none()
    }
}

impl<S: Scalar> Elements<S> {
    /// Members under a body, the tendon left out: its slack length follows from the stance.
    pub fn new(members: &Members<S>, body: &Body<S>) -> Self {
        let length = body.radius();
        Self {
            leg: members.legs.map(|l| Leg { length, axial: l.ea / length, bending: l.ei * 3.0 / length }),
            dampers: members.damper.filter(|d| d.c.re() > 0.0).map(|d| Dampers::new(d.c, body)),
            tendon: None,
        }
    }

    /// The elements without derivatives.
    pub fn real(&self) -> Elements<f64> {
        Elements {
            leg: self.leg.map(|l| Leg { length: l.length.re(), axial: l.axial.re(), bending: l.bending.re() }),
            dampers: self.dampers.map(|dampers| dampers.real()),
            tendon: self.tendon.map(|tendon| tendon.real()),
        }
    }

    /// Those between body and ground.
    pub fn each(&self) -> impl Iterator<Item = &dyn Element<S>> {
        let dampers = self.dampers.as_ref().map(|dampers| dampers as &dyn Element<S>);
        let tendon = self.tendon.as_ref().map(|tendon| tendon as &dyn Element<S>);
        dampers.into_iter().chain(tendon)
    }

    /// Add their forces to those on the body.
    #[inline(always)]
    pub fn add_forces(&self, q: &Vector<S>, v: &Vector<S>, f: &mut Vector<S>) {
        if !self.is_empty() {
            self.add_all_forces(q, v, f);
        }
    }

    /// An energy and what is stored in legs, of which `legs` knows, and elements [J].
    #[inline(always)]
    pub fn add_energy(&self, energy: S, q: &Vector<S>, legs: impl Fn(&Leg<S>) -> S) -> S {
        if self.is_empty() {
            return energy;
        }
        energy + self.stored(self.leg.as_ref().map_or(S::zero(), legs), q)
    }

    #[inline(never)]
    fn stored(&self, legs: S, q: &Vector<S>) -> S {
        self.each().fold(legs, |stored, element| stored + element.energy(q))
    }

    /// A power and what the elements take [W].
    #[inline(always)]
    pub fn add_dissipation(&self, power: S, q: &Vector<S>, v: &Vector<S>) -> S {
        if self.is_empty() { power } else { power + self.dissipation(q, v) }
    }

    #[inline(never)]
    fn dissipation(&self, q: &Vector<S>, v: &Vector<S>) -> S {
        self.each().fold(S::zero(), |power, element| power + element.dissipation(q, v))
    }

    #[inline(never)]
    fn add_all_forces(&self, q: &Vector<S>, v: &Vector<S>, f: &mut Vector<S>) {
        for element in self.each() {
            let force = element.force(q, v);
            for k in [X, Z, TH] {
                f[k] += force[k];
            }
        }
    }
}

#[cfg(test)]
mod tests;
