//! Equations of motion of a plane structure that stands on corners.
//!
//! ```text
//!   M(q) q'' = Q(q, q', t) + sum_i G_i(q)' F_i          i: a corner; F_i = (H, N): force of the ground on it
//!   G_i = d(place of corner i)/dq;   its acceleration is G_i q'' + gamma_i,  gamma_i = (dG_i/dt) q'
//! ```
//!
//! Displacements are relative to the ground, whose acceleration is (a_g, a_v), a_v upwards. x to
//! the right, z upwards, rotations clockwise (to the right) as theta of the rigid body. Every other
//! force is in Q: gravity, ground motion, elastic and damping forces, and what a changing M does.

use std::borrow::Cow;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// A corner's kinematics in one configuration.
#[derive(Clone, Debug)]
pub struct Corner {
    /// Where it is (x, z), relative to the ground at its foot in the standing structure (m).
    pub place: [f64; 2],
    /// G: rows x and z.
    pub jacobian: [DVector<f64>; 2],
    /// gamma = (dG/dt) q' (m/s2).
    pub bias: [f64; 2],
}

/// A plane structure, without what holds it on the ground.
pub trait Mechanics {
    /// Number n of coordinates.
    fn size(&self) -> usize;

    /// M(q), symmetric and positive definite [kg, kg m, kg m2].
    fn mass(&self, q: &DVector<f64>) -> DMatrix<f64>;

    /// M(q), factored; `None` if it is not positive definite. A constant M need not be factored
    /// again.
    fn factored_mass(&self, q: &DVector<f64>) -> Option<Cow<'_, Cholesky<f64, Dyn>>> {
        self.mass(q).cholesky().map(Cow::Owned)
    }

    /// All mass (kg): r' M r of a rigid translation r upwards, whose load M r is that of a ground
    /// that falls at 1 m/s2. Zero if M is not positive definite.
    fn whole_mass(&self, q: &DVector<f64>) -> f64 {
        let still = DVector::zeros(self.size());
        let load = self.force(q, &still, [0.0, -1.0]) - self.force(q, &still, [0.0; 2]);
        self.factored_mass(q).map_or(0.0, |mass| load.dot(&mass.solve(&load)))
    }

    /// Q(q, q', t) at ground acceleration (a_g, a_v) (m/s2); N and N m.
    fn force(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> DVector<f64>;

    /// -dQ/dq and -dQ/dq', for implicit steps.
    fn tangent(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> [DMatrix<f64>; 2];

    /// Rigid footing that each corner belongs to. Two corners of one footing cannot move apart:
    /// both held, the ground's horizontal force on the second is redundant.
    fn footings(&self) -> &[usize];

    /// Rotation of a footing, clockwise, zero in the standing structure (rad).
    fn rotation(&self, footing: usize, q: &DVector<f64>) -> f64;

    /// Corner i, counted from the left.
    fn corner(&self, i: usize, q: &DVector<f64>, v: &DVector<f64>) -> Corner;

    /// Elastic and gravitational energy, zero in the unstressed standing structure (J).
    fn potential(&self, q: &DVector<f64>) -> f64;

    /// Power that dampers take (W).
    fn dissipation(&self, q: &DVector<f64>, v: &DVector<f64>) -> f64;

    /// Power of the ground motion in the moving frame, -(a_g, a_v) . momentum (W).
    fn input_power(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> f64;

    /// Kinetic energy (J).
    fn kinetic(&self, q: &DVector<f64>, v: &DVector<f64>) -> f64 {
        0.5 * v.dot(&(self.mass(q) * v))
    }
}
