//! Dampers and tendons of elastic structures.
//!
//! ```text
//!   damper   a dashpot c, vertical, between the ground and every corner
//!   tendon   from the mass to the ground midway between the corners under it; of a frame one along each column
//! ```

use super::{ElasticError, ElasticStructure};
use crate::frame::{FrameDamper, FrameLayout, FrameTendon, NodePoint};
use rocking::{members::Members, structure::Body};

impl ElasticStructure {
    /// The members themselves if this structure can have them.
    ///
    /// # Errors
    /// A number that makes no sense; a tendon under which a column would buckle or shorten too
    /// much.
    pub fn check_members(&self, members: Members) -> Result<Members, ElasticError> {
        let body = Body { height: self.height(), ..self.body() };
        let members = members.checked(&body)?;
        let tension = members.tendon.map_or(0.0, |tendon| tendon.pretension);
        match self {
            Self::Pier(pier) => pier.carries(tension),
            Self::AFrame(frame) => frame.carries(tension),
            Self::Frame(frame) => frame.carries(tension),
        }?;
        Ok(members)
    }

    /// Of the mass, or of the beam's axis, above the soles (m).
    pub fn height(&self) -> f64 {
        match self {
            Self::Pier(pier) => pier.height_m,
            Self::AFrame(frame) => frame.height_m,
            Self::Frame(frame) => frame.height_m,
        }
    }

    /// Where tendons hold the structure, and where they are anchored (m).
    fn tied(&self) -> Vec<(NodePoint, [f64; 2])> {
        let at = |node: usize, x: f64| (NodePoint { node, place: [x, self.height()] }, [x, 0.0]);
        match self {
            Self::Pier(_) => vec![at(1, 0.0)],
            Self::AFrame(_) => vec![at(2, 0.0)],
            Self::Frame(frame) => vec![at(2, -0.5 * frame.span_m), at(3, 0.5 * frame.span_m)],
        }
    }

    /// The structure as nodes, footings and beams, with these members; the tendons' tension is that
    /// of the unstressed structure.
    pub(crate) fn layout_with(&self, members: &Members) -> FrameLayout {
        let mut layout = self.layout();
        if let Some(damper) = members.damper {
            layout.dampers =
                layout.corners.iter().map(|&at| FrameDamper { at, c: [0.0, damper.c] }).collect();
        }
        if let Some(tendon) = members.tendon {
            let of = |(at, anchor)| FrameTendon {
                at,
                anchor,
                stiffness: tendon.stiffness,
                pretension: tendon.pretension,
            };
            layout.tendons = self.tied().into_iter().map(of).collect();
        }
        layout
    }
}
