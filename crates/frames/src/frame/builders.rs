//! Cantilevers (piers), A-frames and portals laid out.

use super::layout::{FrameLayout, FrameMember, Node, NodePoint};
use crate::beam::BeamSection;

/// A straight column, leg or girder of equal elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightMember {
    /// What it is made of.
    pub section: BeamSection,
    /// Beams along it, at least one.
    pub elements: usize,
}

/// A rigid footing on two corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footing {
    /// Distance between its corners (m).
    pub width: f64,
    /// (kg)
    pub mass: f64,
    /// About its centre of mass (kg m2).
    pub inertia: f64,
    /// Height of its centre of mass above its soles (m).
    pub centre: f64,
    /// Height at which the column begins (m).
    pub top: f64,
}

impl Footing {
    /// A block as wide as its corners are apart, its centre of mass half way up: mass ((2b)^2 + (2
    /// h_b)^2)/12.
    pub fn block(width: f64, mass: f64, centre: f64, top: f64) -> Self {
        let inertia = mass * (width * width + 4.0 * centre * centre) / 12.0;
        Self { width, mass, inertia, centre, top }
    }
}

/// A mass on a column on a footing. Nodes: 0 the footing, 1 the mass, then those along the column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cantilever {
    /// (kg)
    pub mass: f64,
    /// About its centre (kg m2); `None` of a mass on a hinge.
    pub inertia: Option<f64>,
    /// Height of the mass above the soles (m).
    pub height: f64,
    /// What it stands on.
    pub footing: Footing,
    /// From the footing's top to the mass.
    pub column: StraightMember,
    /// Beams' mass consistent with linear displacements rather than in halves.
    pub consistent: bool,
}

/// An apex mass on two legs, clamped to it and hinged at the feet; each foot is a point mass on one
/// corner. Nodes: 0 and 1 the feet, 2 the apex, then those along the left and the right leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeggedFrame {
    /// At the apex (kg).
    pub mass: f64,
    /// Of the apex about its centre; half of each leg adds to it (kg m2).
    pub inertia: f64,
    /// Height of the apex (m).
    pub height: f64,
    /// Distance between the feet (m).
    pub width: f64,
    /// Of each foot (kg).
    pub foot_mass: f64,
    /// From the apex to a foot.
    pub leg: StraightMember,
}

/// Two columns on two footings under a girder. Nodes: 0 and 1 the footings, 2 and 3 the corners of
/// the frame, then those along the left column, the right column, the girder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Portal {
    /// Distance between the columns' axes (m).
    pub span: f64,
    /// Height of the girder's axis above the soles (m).
    pub height: f64,
    /// At each end of the girder (kg).
    pub mass: f64,
    /// The same's rotational inertia (kg m2).
    pub inertia: f64,
    /// Under each column.
    pub footing: Footing,
    /// Each column.
    pub column: StraightMember,
    /// The girder.
    pub girder: StraightMember,
}

impl FrameLayout {
    /// Add a row of beams from one place to another, with nodes between them that have no mass but
    /// theirs.
    fn line(&mut self, from: NodePoint, to: NodePoint, hinged: [bool; 2], column: &StraightMember) {
        let count = column.elements.max(1);
        let mut start = from;
        for i in 1..=count {
            let share = i as f64 / count as f64;
            let place = [0, 1].map(|k| from.place[k] + share * (to.place[k] - from.place[k]));
            let end = if i == count {
                to
            } else {
                self.nodes.push(Node::body(place, 0.0, 0.0));
                NodePoint { node: self.nodes.len() - 1, place }
            };
            let hinged = [hinged[0] && i == 1, hinged[1] && i == count];
            self.members.push(FrameMember { ends: [start, end], hinged, section: column.section });
            start = end;
        }
    }

    /// Add a footing with its middle at x; where its column begins.
    fn stand(&mut self, footing: &Footing, x: f64) -> NodePoint {
        let node = self.nodes.len();
        self.nodes.push(Node::body([x, footing.centre], footing.mass, footing.inertia));
        for side in [-0.5, 0.5] {
            self.corners.push(NodePoint { node, place: [x + side * footing.width, 0.0] });
        }
        NodePoint { node, place: [x, footing.top] }
    }
}

impl Cantilever {
    /// Its layout, the middle of the soles at the origin.
    pub fn layout(&self) -> FrameLayout {
        let mut layout = FrameLayout { consistent: self.consistent, ..FrameLayout::default() };
        let base = layout.stand(&self.footing, 0.0);
        let place = [0.0, self.height];
        layout.nodes.push(Node { place, mass: self.mass, inertia: self.inertia, held: false });
        layout.line(
            base,
            NodePoint { node: 1, place },
            [false, self.inertia.is_none()],
            &self.column,
        );
        layout
    }
}

impl LeggedFrame {
    /// Its layout, the middle between the feet at the origin.
    pub fn layout(&self) -> FrameLayout {
        let feet = [-0.5, 0.5].map(|side| [side * self.width, 0.0]);
        let apex = [0.0, self.height];
        let mut layout = FrameLayout {
            nodes: feet.map(|place| Node::point(place, self.foot_mass)).to_vec(),
            corners: [0, 1].map(|node| NodePoint { node, place: feet[node] }).to_vec(),
            ..FrameLayout::default()
        };
        layout.nodes.push(Node::body(apex, self.mass, self.inertia));
        for (node, place) in feet.into_iter().enumerate() {
            layout.line(
                NodePoint { node: 2, place: apex },
                NodePoint { node, place },
                [false, true],
                &self.leg,
            );
        }
        layout
    }
}

impl Portal {
    /// Its layout, the middle between the columns at the origin.
    pub fn layout(&self) -> FrameLayout {
        let xs = [-0.5, 0.5].map(|side| side * self.span);
        let mut layout = FrameLayout::default();
        let bases = xs.map(|x| layout.stand(&self.footing, x));
        let tops = [0, 1].map(|i| NodePoint { node: 2 + i, place: [xs[i], self.height] });
        for top in tops {
            layout.nodes.push(Node::body(top.place, self.mass, self.inertia));
        }
        for (base, top) in bases.into_iter().zip(tops) {
            layout.line(base, top, [false; 2], &self.column);
        }
        layout.line(tops[0], tops[1], [false; 2], &self.girder);
        layout
    }
}
