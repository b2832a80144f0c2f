//! A plane frame that may rock: nodes, rigid footings with corners, beams, dashpots and tendons;
//! large rotations, constant mass.
//!
//! ```text
//!   M q'' = Q(q, q') - M 1_x a_g - M 1_z (g + a_v)      q: x, z of every node that is not held, and its rotation if it turns
//! ```
//!
//! A node is a rigid body; its coordinates are those of its centre of mass, so that M is constant.
//! A footing is a node with corners: two at its soles, or one where a leg ends in a point. Beams,
//! dashpots, tendons and corners meet a node at places on it.
//!
//! | file | what |
//! |---|---|
//! | `layout`, `masses` | what a frame is made of, checked and assembled |
//! | `builders` | pier, A-frame, portal |
//! | `base` | its rigid rotation, and drifts against it |
//! | `place` | a place on a node: kinematics, force |
//! | `forces` | Q, its tangent, energies: `Mechanics` |
//! | `equilibrium`, `modes` | where it stands; natural frequencies |

mod base;
mod builders;
mod equilibrium;
mod forces;
mod layout;
mod masses;
mod modes;
mod place;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

pub use base::{Base, FALLEN};
pub use builders::{Cantilever, Footing, LeggedFrame, Portal, StraightMember};
pub use equilibrium::{EquilibriumError, Support};
pub use forces::StrainRates;
pub use layout::{FrameDamper, FrameError, FrameLayout, FrameMember, FrameTendon, Node, NodePoint};
pub use place::{PlaceOnNode, Reach};

use super::beam::{Beam, BeamForces};

/// The index of a coordinate that is not there: held, or of a node that does not turn.
const NONE: usize = usize::MAX;

/// A beam and the coordinates of its two nodes.
#[derive(Clone, Debug)]
struct BeamElement {
    beam: Beam,
    index: [usize; 6],
    /// Whether its first, its second end is on a footing, or on what is held.
    bases: [bool; 2],
}

/// A column: beams in a straight line from its base.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameColumn {
    /// From the base up.
    pub beams: Vec<usize>,
    /// The end of its first beam that is its base.
    pub base_end: usize,
    /// The end of its last beam that is its top.
    pub top_end: usize,
}

/// Sine of the angle below which two beams are one straight line.
const STRAIGHT: f64 = 1e-6;

/// A node, assembled.
#[derive(Clone, Copy, Debug)]
struct FrameBody {
    /// Unstressed place of its centre of mass (m).
    centre: [f64; 2],
    index: [usize; 3],
}

/// A frame, ready to compute with.
#[derive(Clone, Debug)]
pub struct Frame {
    size: usize,
    bodies: Vec<FrameBody>,
    elements: Vec<BeamElement>,
    corners: Vec<PlaceOnNode>,
    /// Node that each corner belongs to.
    footings: Vec<usize>,
    dampers: Vec<(PlaceOnNode, [f64; 2])>,
    tendons: Vec<(PlaceOnNode, FrameTendon)>,
    mass: DMatrix<f64>,
    /// M where it is diagonal: beams' mass in halves.
    diagonal: Option<Vec<f64>>,
    cholesky: Cholesky<f64, Dyn>,
    /// M 1_x and M 1_z: what an acceleration of the ground of one pulls with (kg).
    pull: [DVector<f64>; 2],
    /// Of all that moves (kg).
    total: f64,
}

impl Frame {
    /// Mass of all that is not held (kg).
    pub fn total_mass(&self) -> f64 {
        self.total
    }

    /// M, constant [kg, kg m2].
    pub fn mass_matrix(&self) -> &DMatrix<f64> {
        &self.mass
    }

    /// Diagonal of the rectangle about its unstressed nodes and corners (m): what rotations are
    /// measured with.
    pub fn span(&self) -> f64 {
        let places = self.bodies.iter().map(|body| body.centre);
        let corners = self.corners.iter().map(|corner| corner.unstressed);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for at in places.chain(corners) {
            for k in 0..2 {
                (low[k], high[k]) = (low[k].min(at[k]), high[k].max(at[k]));
            }
        }
        (high[0] - low[0]).hypot(high[1] - low[1])
    }

    /// Distance between the outer corners (m).
    pub fn stance(&self) -> f64 {
        let xs = self.corners.iter().map(|corner| corner.unstressed[0]);
        xs.clone().fold(f64::NEG_INFINITY, f64::max) - xs.fold(f64::INFINITY, f64::min)
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.bodies.len()
    }

    /// Indices of a node's coordinates x, z, rotation; `None` where it is held or does not turn.
    pub fn coordinates(&self, node: usize) -> [Option<usize>; 3] {
        self.bodies[node].index.map(|k| (k != NONE).then_some(k))
    }

    /// A node's displacement and clockwise rotation (m, rad).
    pub fn displacement(&self, node: usize, q: &[f64]) -> [f64; 3] {
        gather(&self.bodies[node].index, q)
    }

    /// Unstressed place of a node's centre of mass (m).
    pub fn centre(&self, node: usize) -> [f64; 2] {
        self.bodies[node].centre
    }

    /// Its corners, from left to right.
    pub fn places(&self) -> &[PlaceOnNode] {
        &self.corners
    }

    /// Node that each corner belongs to.
    pub fn footing_nodes(&self) -> &[usize] {
        &self.footings
    }

    /// Number of beams.
    pub fn beams(&self) -> usize {
        self.elements.len()
    }

    /// What beam i bears.
    pub(crate) fn bearing(&self, i: usize, q: &[f64], v: &[f64]) -> BeamForces {
        let BeamElement { beam, index, .. } = &self.elements[i];
        beam.bearing(&gather(index, q), &gather(index, v))
    }

    /// Force with which its node holds an end of beam i, horizontally and vertically upwards (N).
    pub(crate) fn held_at(&self, i: usize, end: usize, q: &[f64], v: &[f64]) -> [f64; 2] {
        let BeamElement { beam, index, .. } = &self.elements[i];
        let needed = beam.resistance(&gather(index, q), &gather(index, v));
        [needed[3 * end], needed[3 * end + 1]]
    }

    /// What beam i's shear lacks of that of one of its ends (N): `Beam::half_inertia`.
    pub(crate) fn half_inertia(
        &self,
        i: usize,
        end: usize,
        motion: [&[f64]; 3],
        ground: [f64; 2],
    ) -> f64 {
        let BeamElement { beam, index, .. } = &self.elements[i];
        let [y, rate, accel] = motion.map(|x| gather(index, x));
        beam.half_inertia(end, [&y, &rate, &accel], ground)
    }

    /// Length of beam i, unstressed (m).
    pub(crate) fn length(&self, i: usize) -> f64 {
        self.elements[i].beam.length()
    }

    /// Mass of a length of beam i (kg/m).
    pub(crate) fn line_mass(&self, i: usize) -> f64 {
        self.elements[i].beam.line_mass()
    }

    /// Whether beam i's first, and its second, end is on a footing or on a node that is held.
    pub(crate) fn bases_of(&self, i: usize) -> [bool; 2] {
        self.elements[i].bases
    }

    /// Columns: every beam that ends on a footing or on what is held, and the beams that go on from
    /// it.
    pub fn columns(&self) -> Vec<FrameColumn> {
        let of = |(i, element): (usize, &BeamElement)| {
            let base_end = element.bases.iter().position(|base| *base)?;
            let mut beams = vec![i];
            let mut end = 1 - base_end;
            while let Some((next, begins)) = self.goes_on(beams[beams.len() - 1], end) {
                beams.push(next);
                end = 1 - begins;
            }
            Some(FrameColumn { beams, base_end, top_end: end })
        };
        self.elements.iter().enumerate().filter_map(of).collect()
    }

    /// The beam that goes straight on from an end of beam i, and its end there.
    fn goes_on(&self, i: usize, end: usize) -> Option<(usize, usize)> {
        let index = |beam: usize, end: usize| &self.elements[beam].index[3 * end..3 * end + 3];
        let node = index(i, end);
        if self.elements[i].bases[end] || node.iter().all(|k| *k == NONE) {
            return None;
        }
        let [x, z] = self.elements[i].beam.axis();
        let straight = |other: usize| {
            let [ox, oz] = self.elements[other].beam.axis();
            (x * oz - z * ox).abs() < STRAIGHT
        };
        let others = (0..self.elements.len()).filter(|other| *other != i && straight(*other));
        others
            .flat_map(|other| [(other, 0), (other, 1)])
            .find(|(other, begins)| index(*other, *begins) == node)
    }

    /// Unit vector along beam i's chord, from its first end to its second.
    pub fn direction(&self, i: usize, q: &[f64]) -> [f64; 2] {
        let BeamElement { beam, index, .. } = &self.elements[i];
        beam.direction(&gather(index, q))
    }

    /// What lands at a corner, [(W)^-1] with W = G M^-1 G' its 2 x 2 block: horizontally and
    /// vertically (kg), the structure unstressed.
    pub fn effective_mass(&self, corner: usize) -> [f64; 2] {
        let [xx, xz, zz] = self.mobility(corner, &vec![0.0; self.size]);
        let determinant = xx * zz - xz * xz;
        [zz / determinant, xx / determinant]
    }

    /// W = G M^-1 G' of a corner at q: xx, xz, zz (1/kg).
    pub(crate) fn mobility(&self, corner: usize, q: &[f64]) -> [f64; 3] {
        let [gx, gz] = self.corners[corner].jacobian(q, self.size);
        let (mx, mz) = (self.cholesky.solve(&gx), self.cholesky.solve(&gz));
        [gx.dot(&mx), gx.dot(&mz), gz.dot(&mz)]
    }
}

/// The entries of these coordinates; zero where there is none.
#[inline(always)]
fn gather<const K: usize>(index: &[usize; K], q: &[f64]) -> [f64; K] {
    index.map(|k| if k == NONE { 0.0 } else { q[k] })
}

#[cfg(test)]
mod tests;
