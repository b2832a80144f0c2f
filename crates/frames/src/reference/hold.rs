//! What the ground does to the corners that it holds.
//!
//! ```text
//!   a = a_0 + M^-1 G' F,   G a + gamma = 0:    F = -W^-1 (G a_0 + gamma),   W = G M^-1 G',   a_0 = M^-1 Q
//!   impact: the same for velocities, without gamma; F is then an impulse
//! ```
//!
//! A corner that slides keeps its height, by a horizontal force alone: G then has its vertical row
//! on the left of M^-1 and its horizontal one on the right. That is the limit of Coulomb's friction
//! as its coefficient grows: N falls to zero, the friction mu N does not.
//!
//! A held corner keeps both its coordinates. Two held corners of one footing cannot move apart, so
//! that the horizontal force on the second is redundant: the first has all of it.

use std::borrow::Cow;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::CornerSet;
use crate::{Corner, Mechanics};

/// A structure in one configuration and at one velocity.
pub struct Configuration<'a, M> {
    /// Equations of motion.
    pub mechanics: &'a M,
    mass: Cow<'a, Cholesky<f64, Dyn>>,
    /// Coordinates.
    pub q: &'a DVector<f64>,
    /// Velocities.
    pub v: &'a DVector<f64>,
}

/// What a set of held corners makes of a motion.
pub struct HeldMotion {
    /// Acceleration, velocity or displacement with the corners held.
    pub motion: DVector<f64>,
    /// (corner, horizontal, vertical) force of the ground, impulse, or what stands for it (N, N s).
    pub forces: Vec<(usize, [f64; 2])>,
}

impl HeldMotion {
    /// Force on a corner; zero if it is not on the ground.
    pub fn force(&self, corner: usize) -> [f64; 2] {
        force(&self.forces, corner)
    }
}

/// Corners on the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CornerContact {
    /// Those that keep their place.
    pub held: CornerSet,
    /// Those that slide, and do not press.
    pub sliding: CornerSet,
}

impl CornerContact {
    /// Corners that keep their place, and none that slides.
    pub fn held(held: CornerSet) -> Self {
        Self { held, sliding: CornerSet::NONE }
    }

    /// All corners on the ground.
    pub(crate) fn all(self) -> CornerSet {
        self.held.and(self.sliding)
    }
}

/// Force on a corner, of a list of them; zero if it is not there.
pub(crate) fn force(forces: &[(usize, [f64; 2])], corner: usize) -> [f64; 2] {
    forces.iter().find(|(i, _)| *i == corner).map_or([0.0; 2], |(_, force)| *force)
}

/// What is asked of the corners.
#[derive(Clone, Copy, PartialEq)]
enum Aim {
    Acceleration,
    Velocity,
    /// Of a landing in which corners slide.
    Braked,
    Place,
}

impl Aim {
    /// Whether a sliding corner is kept at its height by its horizontal force.
    fn has_friction(self) -> bool {
        matches!(self, Self::Acceleration | Self::Braked)
    }
}

impl<'a, M: Mechanics> Configuration<'a, M> {
    /// None if M is not positive definite: the structure has a coordinate without inertia, or a
    /// number is not finite.
    pub fn new(mechanics: &'a M, q: &'a DVector<f64>, v: &'a DVector<f64>) -> Option<Self> {
        Some(Self { mechanics, mass: mechanics.factored_mass(q)?, q, v })
    }

    /// Accelerations under the ground's acceleration, and the ground's forces.
    pub fn accelerations(&self, ground: [f64; 2], contact: CornerContact) -> Option<HeldMotion> {
        let free = self.mass.solve(&self.mechanics.force(self.q, self.v, ground));
        self.hold(contact, Aim::Acceleration, free, |_, corner, direction| corner.bias[direction])
    }

    /// Velocities after an impact that stops held corners, and sliding ones vertically; impulses.
    pub fn impact(&self, contact: CornerContact) -> Option<HeldMotion> {
        self.hold(contact, Aim::Velocity, self.v.clone(), |_, _, _| 0.0)
    }

    /// Velocities after an impact that stops held corners, and sliding ones vertically by
    /// horizontal impulses alone; impulses.
    pub fn braked(&self, contact: CornerContact) -> Option<HeldMotion> {
        self.hold(contact, Aim::Braked, self.v.clone(), |_, _, _| 0.0)
    }

    /// The smallest displacement, by M, that takes corners to their places on the ground (x; z =
    /// 0), to first order.
    pub(crate) fn shift(&self, contact: CornerContact, anchors: &[f64]) -> Option<HeldMotion> {
        self.hold(contact, Aim::Place, DVector::zeros(self.v.len()), |i, corner, direction| {
            corner.place[direction] - if direction == 0 { anchors[i] } else { 0.0 }
        })
    }

    /// Velocity of a corner, across and up, at a velocity of the structure.
    pub fn velocity(&self, corner: usize, of: &DVector<f64>) -> [f64; 2] {
        let corner = self.mechanics.corner(corner, self.q, self.v);
        // no zero is a negative one
        [0, 1].map(|k| corner.jacobian[k].dot(of) + 0.0)
    }

    /// Speed of a corner, the larger of its components, at a velocity of the structure.
    pub(crate) fn speed(&self, corner: usize, of: &DVector<f64>) -> f64 {
        self.velocity(corner, of).into_iter().map(f64::abs).fold(0.0, f64::max)
    }

    /// Acceleration of a corner, across and up, at an acceleration of the structure.
    pub(crate) fn acceleration(&self, corner: usize, of: &DVector<f64>) -> [f64; 2] {
        let corner = self.mechanics.corner(corner, self.q, self.v);
        [0, 1].map(|k| corner.jacobian[k].dot(of) + corner.bias[k])
    }

    /// Derivatives of the accelerations by q and q', but for what moves with M, G and gamma: none
    /// of that is stiff.
    pub(crate) fn tangent(
        &self,
        ground: [f64; 2],
        contact: CornerContact,
    ) -> Option<[DMatrix<f64>; 2]> {
        let [by_q, by_v] = self.mechanics.tangent(self.q, self.v, ground);
        let held = |minus: DMatrix<f64>| {
            let mut columns = self.mass.solve(&-minus);
            for mut column in columns.column_iter_mut() {
                let free = column.clone_owned();
                column
                    .copy_from(&self.hold(contact, Aim::Acceleration, free, |_, _, _| 0.0)?.motion);
            }
            Some(columns)
        };
        Some([held(by_q)?, held(by_v)?])
    }

    /// x + M^-1 G' F such that G x = -offset at the corners on the ground.
    fn hold(
        &self,
        contact: CornerContact,
        aim: Aim,
        mut x: DVector<f64>,
        offset: impl Fn(usize, &Corner, usize) -> f64,
    ) -> Option<HeldMotion> {
        let (n, footings) = (x.len(), self.mechanics.footings());
        let most = 2 * contact.all().len();
        let (mut rows, mut gap) = (Vec::with_capacity(most), Vec::with_capacity(most));
        // columns: G' by the coordinates that are kept, and by those of the forces
        let (mut kept, mut pushed) = (Vec::with_capacity(most * n), Vec::with_capacity(most * n));
        let friction = aim.has_friction() && !contact.sliding.is_empty();
        for i in contact.all().iter() {
            let corner = self.mechanics.corner(i, self.q, self.v);
            let slides = contact.sliding.contains(i);
            let alone =
                !contact.held.iter().take_while(|&k| k < i).any(|k| footings[k] == footings[i]);
            for direction in [1, 0].into_iter().take(if alone && !slides { 2 } else { 1 }) {
                gap.push(corner.jacobian[direction].dot(&x) + offset(i, &corner, direction));
                let force = if slides && friction { 0 } else { direction };
                rows.push((i, force));
                pushed.extend_from_slice(corner.jacobian[force].as_slice());
                if friction {
                    kept.extend_from_slice(corner.jacobian[direction].as_slice());
                }
            }
        }
        let r = rows.len();
        if r == 0 {
            return Some(HeldMotion { motion: x, forces: Vec::new() });
        }
        let pushed = DMatrix::from_vec(n, r, pushed);
        let response = self.mass.solve(&pushed);
        let mut force = DVector::from_vec(gap);
        if friction {
            force = DMatrix::from_vec(n, r, kept).tr_mul(&response).lu().solve(&force)?;
        } else {
            pushed.tr_mul(&response).cholesky()?.solve_mut(&mut force);
        }
        x.gemv(-1.0, &response, &force, 1.0);
        let mut forces: Vec<_> = contact.all().iter().map(|i| (i, [0.0; 2])).collect();
        for ((corner, direction), force) in rows.into_iter().zip(force.iter()) {
            let entry = forces.iter_mut().find(|(i, _)| *i == corner)?;
            entry.1[direction] = -force;
        }
        Some(HeldMotion { motion: x, forces })
    }
}
