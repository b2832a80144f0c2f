//! What a frame is made of, checked.

use thiserror::Error;

use super::{BeamElement, Frame, FrameBody, NONE, PlaceOnNode, masses::Masses};
use crate::beam::{Beam, BeamSection};

/// A node: a point, or a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Centre of mass in the unstressed structure, x to the right, z above the ground (m).
    pub place: [f64; 2],
    /// (kg); that of beams is added to it.
    pub mass: f64,
    /// About its centre of mass (kg m2); `None` of a node that does not turn: beams meet it by
    /// hinges.
    pub inertia: Option<f64>,
    /// Held where it is.
    pub held: bool,
}

impl Node {
    /// A point mass that does not turn.
    pub(crate) fn point(place: [f64; 2], mass: f64) -> Self {
        Self { place, mass, inertia: None, held: false }
    }

    /// A body that turns.
    pub(crate) fn body(place: [f64; 2], mass: f64, inertia: f64) -> Self {
        Self { place, mass, inertia: Some(inertia), held: false }
    }
}

/// A place on a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodePoint {
    /// Which.
    pub node: usize,
    /// In the unstressed structure (m).
    pub place: [f64; 2],
}

/// A beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameMember {
    /// Where it begins and ends.
    pub ends: [NodePoint; 2],
    /// Ends without moment.
    pub hinged: [bool; 2],
    /// What it is made of.
    pub section: BeamSection,
}

/// Dashpots between a place on a node and the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameDamper {
    /// The place.
    pub at: NodePoint,
    /// Force over velocity, horizontally and vertically (N s/m).
    pub c: [f64; 2],
}

/// A tendon from a node to the ground: it only pulls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameTendon {
    /// Its upper end.
    pub at: NodePoint,
    /// Its lower end, in the ground (m).
    pub anchor: [f64; 2],
    /// Force over elongation (N/m).
    pub stiffness: f64,
    /// Tension in the unstressed structure (N).
    pub pretension: f64,
}

/// What a frame is made of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameLayout {
    /// Nodes.
    pub nodes: Vec<Node>,
    /// Beams.
    pub members: Vec<FrameMember>,
    /// Corners, from left to right: nodes that have some are footings.
    pub corners: Vec<NodePoint>,
    /// Dashpots to the ground.
    pub dampers: Vec<FrameDamper>,
    /// Tendons.
    pub tendons: Vec<FrameTendon>,
    /// Beams' mass consistent with linear displacements between nodes, where both of its ends are
    /// at the centre of a node: half of it goes to each end otherwise.
    pub consistent: bool,
}

/// What is wrong with a frame, and what to do.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum FrameError {
    #[error("frame: {what} {number} names node {node}, but there are {nodes}")]
    NoNode { what: &'static str, number: usize, node: usize, nodes: usize },
    #[error("frame: {quantity} of {what} {number} is {value:?}; give a finite number{least}")]
    Value {
        what: &'static str,
        number: usize,
        quantity: &'static str,
        value: f64,
        least: &'static str,
    },
    #[error(
        "frame: {what} {number} meets node {node} off its place, and that does not turn: give it \
         rotational inertia"
    )]
    Arm { what: &'static str, number: usize, node: usize },
    #[error(
        "frame: beam {number} is clamped to node {node}, which does not turn: hinge it there, or \
         give the node rotational inertia"
    )]
    Clamped { number: usize, node: usize },
    #[error("frame: beam {number} has no length: move its ends apart")]
    Short { number: usize },
    #[error("frame: node {node} has no {what}: give it some, or hold it")]
    Massless { node: usize, what: &'static str },
}

const POSITIVE: &str = " greater than zero";
const NOT_NEGATIVE: &str = ", zero or greater";

fn check(
    what: &'static str,
    number: usize,
    values: &[(&'static str, f64, &'static str)],
) -> Result<(), FrameError> {
    for &(quantity, value, least) in values {
        let fits = match least {
            POSITIVE => value > 0.0,
            NOT_NEGATIVE => value >= 0.0,
            _ => true,
        };
        if !value.is_finite() || !fits {
            return Err(FrameError::Value { what, number, quantity, value, least });
        }
    }
    Ok(())
}

impl FrameLayout {
    /// The same with its footings held: the fixed-base structure. Dampers at what is held have
    /// nothing to do; others act, as tendons do.
    pub fn fixed(&self) -> Self {
        let mut fixed = Self { corners: Vec::new(), ..self.clone() };
        for corner in &self.corners {
            if let Some(node) = fixed.nodes.get_mut(corner.node) {
                node.held = true;
            }
        }
        fixed
    }

    /// The frame.
    ///
    /// # Errors
    /// What does not fit together, or is not a number.
    pub fn frame(&self) -> Result<Frame, FrameError> {
        self.checked()?;
        let masses = Masses::of(self);
        let mut size = 0;
        let mut bodies = Vec::with_capacity(self.nodes.len());
        for (node, lump) in self.nodes.iter().zip(&masses.lumps) {
            let mut index = [NONE; 3];
            if !node.held {
                let count = if node.inertia.is_some() { 3 } else { 2 };
                for k in &mut index[..count] {
                    *k = size;
                    size += 1;
                }
            }
            bodies.push(FrameBody { centre: lump.centre, index });
        }
        let place = |point: &NodePoint| {
            let FrameBody { centre, index } = bodies[point.node];
            let arm = [point.place[0] - centre[0], point.place[1] - centre[1]];
            PlaceOnNode { unstressed: point.place, arm, index }
        };
        let element = |member: &FrameMember| {
            let [a, b] = [&member.ends[0], &member.ends[1]].map(place);
            let beam = Beam::new(
                [a.unstressed, b.unstressed],
                [a.arm, b.arm],
                member.hinged,
                member.section,
            );
            let mut index = [NONE; 6];
            index[..3].copy_from_slice(&a.index);
            index[3..].copy_from_slice(&b.index);
            let bases = member.ends.map(|end| {
                self.nodes[end.node].held
                    || self.corners.iter().any(|corner| corner.node == end.node)
            });
            BeamElement { beam, index, bases }
        };
        let elements = self.members.iter().map(element).collect();
        let corners = self.corners.iter().map(place).collect();
        let footings = self.corners.iter().map(|corner| corner.node).collect();
        let dampers = self.dampers.iter().map(|damper| (place(&damper.at), damper.c)).collect();
        let tendons = self.tendons.iter().map(|tendon| (place(&tendon.at), *tendon)).collect();
        let (mass, cholesky, pull, total) = masses.matrix(&bodies, size)?;
        let diagonal = masses.lumped().then(|| mass.diagonal().as_slice().to_vec());
        Ok(Frame {
            size,
            bodies,
            elements,
            corners,
            footings,
            dampers,
            tendons,
            mass,
            diagonal,
            cholesky,
            pull,
            total,
        })
    }

    fn checked(&self) -> Result<(), FrameError> {
        for (i, node) in self.nodes.iter().enumerate() {
            let [x, z] = node.place;
            let inertia = node.inertia.unwrap_or(0.0);
            let values = [
                ("mass", node.mass, NOT_NEGATIVE),
                ("inertia", inertia, NOT_NEGATIVE),
                ("x", x, ""),
                ("z", z, ""),
            ];
            check("node", i, &values)?;
        }
        for (i, corner) in self.corners.iter().enumerate() {
            self.meets("corner", i, corner)?;
        }
        for (i, member) in self.members.iter().enumerate() {
            let BeamSection { axial, bending, shear, axial_damping, bending_damping, line_mass } =
                member.section;
            let values = [
                ("EA", axial, NOT_NEGATIVE),
                ("EI", bending, NOT_NEGATIVE),
                // infinite: rigid in shear
                ("GA", if shear == f64::INFINITY { 1.0 } else { shear }, POSITIVE),
                ("axial damping", axial_damping, NOT_NEGATIVE),
                ("bending damping", bending_damping, NOT_NEGATIVE),
                ("line mass", line_mass, NOT_NEGATIVE),
            ];
            check("beam", i, &values)?;
            for (end, hinged) in member.ends.iter().zip(member.hinged) {
                self.meets("beam", i, end)?;
                let node = &self.nodes[end.node];
                if !hinged && node.inertia.is_none() && !node.held {
                    return Err(FrameError::Clamped { number: i, node: end.node });
                }
            }
            let [a, b] = member.ends.map(|end| end.place);
            if (a[0] - b[0]).hypot(a[1] - b[1]) == 0.0 {
                return Err(FrameError::Short { number: i });
            }
        }
        for (i, damper) in self.dampers.iter().enumerate() {
            self.meets("damper", i, &damper.at)?;
            check(
                "damper",
                i,
                &[("c", damper.c[0], NOT_NEGATIVE), ("c", damper.c[1], NOT_NEGATIVE)],
            )?;
        }
        for (i, tendon) in self.tendons.iter().enumerate() {
            self.meets("tendon", i, &tendon.at)?;
            check(
                "tendon",
                i,
                &[("stiffness", tendon.stiffness, POSITIVE), ("pretension", tendon.pretension, "")],
            )?;
        }
        Ok(())
    }

    /// Whether a place is on a node that can carry it.
    fn meets(
        &self,
        what: &'static str,
        number: usize,
        point: &NodePoint,
    ) -> Result<(), FrameError> {
        let nodes = self.nodes.len();
        let Some(node) = self.nodes.get(point.node) else {
            return Err(FrameError::NoNode { what, number, node: point.node, nodes });
        };
        check(what, number, &[("x", point.place[0], ""), ("z", point.place[1], "")])?;
        if point.place != node.place && node.inertia.is_none() && !node.held {
            return Err(FrameError::Arm { what, number, node: point.node });
        }
        Ok(())
    }
}
