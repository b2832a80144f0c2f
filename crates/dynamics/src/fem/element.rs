//! Elements between the body and the ground. Each gives its energy, its force on the body's
//! coordinates X, Z, theta, the tangent of that force and the power it takes; the model adds them
//! up.
//!
//! ```text
//!   F = -dU/dq + F_d(q, q')      K = -dF/dq      C = -dF/dq'      power taken  P = -F_d . q'
//! ```

mod dampers;
mod tendon;

pub(crate) use dampers::Dampers;
pub(crate) use tendon::TendonElement;

use super::model::{TH, Vector, X, Z};

/// K [N/m, N, N m] and C [N s/m, N s, N m s] of an element, rows and columns X, Z, theta.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementTangent {
    pub stiffness: [[f64; 3]; 3],
    pub damping: [[f64; 3]; 3],
}

/// What stands between the body and the ground.
pub(crate) trait Element {
    /// U (J).
    fn energy(&self, q: &Vector) -> f64;
    /// Force on X, Z (N) and theta (N m).
    fn force(&self, q: &Vector, v: &Vector) -> [f64; 3];
    /// How that force changes.
    fn tangent(&self, q: &Vector, v: &Vector) -> ElementTangent;
    /// P (W).
    fn dissipation(&self, q: &Vector, v: &Vector) -> f64;
}

/// All that a body has besides its springs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Elements {
    pub dampers: Option<Dampers>,
    pub tendon: Option<TendonElement>,
}

impl Elements {
    /// A rigid body's.
    pub(crate) const NONE: Self = Self { dampers: None, tendon: None };

    /// Whether there are none.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.dampers.is_none() && self.tendon.is_none()
    }

    /// Those between body and ground.
    pub(crate) fn each(&self) -> impl Iterator<Item = &dyn Element> {
        let dampers = self.dampers.as_ref().map(|dampers| dampers as &dyn Element);
        let tendon = self.tendon.as_ref().map(|tendon| tendon as &dyn Element);
        dampers.into_iter().chain(tendon)
    }

    /// Add their forces to those on the body.
    #[inline(always)]
    pub(crate) fn add_forces(&self, q: &Vector, v: &Vector, f: &mut Vector) {
        if !self.is_empty() {
            self.add_all_forces(q, v, f);
        }
    }

    /// An energy and what the elements store (J).
    #[inline(always)]
    pub(crate) fn add_energy(&self, energy: f64, q: &Vector) -> f64 {
        if self.is_empty() { energy } else { energy + self.stored(q) }
    }

    #[inline(never)]
    fn stored(&self, q: &Vector) -> f64 {
        self.each().fold(0.0, |stored, element| stored + element.energy(q))
    }

    /// A power and what the elements take (W).
    #[inline(always)]
    pub(crate) fn add_dissipation(&self, power: f64, q: &Vector, v: &Vector) -> f64 {
        if self.is_empty() { power } else { power + self.dissipation(q, v) }
    }

    #[inline(never)]
    fn dissipation(&self, q: &Vector, v: &Vector) -> f64 {
        self.each().fold(0.0, |power, element| power + element.dissipation(q, v))
    }

    #[inline(never)]
    fn add_all_forces(&self, q: &Vector, v: &Vector, f: &mut Vector) {
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
