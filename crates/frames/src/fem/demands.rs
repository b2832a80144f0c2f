//! What the designer needs: what columns and beams bear, and what footings feel.
//!
//! ```text
//!   base shear     sum of the horizontal forces that footings give the beams that end on them
//!   beam i         axial force N (tension positive), shear V, moments at its first and its second end
//!   tendon         pull
//!   damper         force on the structure, upwards
//! ```

use crate::{beam::BeamForces, frame::Frame};

/// What a structure bears at one instant, or at its worst since the sample before: each value by
/// itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameDemand {
    /// Horizontal force of the footings on the beams that end on them (N).
    pub base_shear: f64,
    /// Of every beam.
    pub bearings: Vec<BeamForces>,
    /// Pull of every tendon (N).
    pub tendons: Vec<f64>,
    /// Of every damper (N).
    pub dampers: Vec<f64>,
}

impl FrameDemand {
    pub(super) fn new(frame: &Frame) -> Self {
        let (tendons, dampers) = frame.members();
        Self {
            base_shear: 0.0,
            bearings: vec![BeamForces::default(); frame.beams()],
            tendons: vec![0.0; tendons],
            dampers: vec![0.0; dampers],
        }
    }

    /// At one instant.
    pub(super) fn take(&mut self, frame: &Frame, q: &[f64], v: &[f64]) {
        self.base_shear = 0.0;
        self.tendons = frame.tensions(q);
        self.dampers = frame.damper_forces(q, v);
        for (i, bearing) in self.bearings.iter_mut().enumerate() {
            *bearing = frame.bearing(i, q, v);
            for (end, _) in frame.bases_of(i).into_iter().enumerate().filter(|(_, base)| *base) {
                let [x, z] = frame.direction(i, q);
                // the force that the node gives this end of the beam
                let along = bearing.shear * z - bearing.axial * x;
                self.base_shear += if end == 0 { along } else { -along };
            }
        }
    }

    /// The values, in the order in which `FrameDemand::values_mut` gives them.
    pub fn values(&self) -> impl Iterator<Item = f64> + '_ {
        let bearings =
            self.bearings.iter().flat_map(|b| [b.axial, b.shear, b.moments[0], b.moments[1]]);
        let members = self.tendons.iter().chain(&self.dampers).copied();
        std::iter::once(self.base_shear).chain(bearings).chain(members)
    }

    fn values_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        let bearings = self.bearings.iter_mut().flat_map(|b| {
            let [first, second] = &mut b.moments;
            [&mut b.axial, &mut b.shear, first, second]
        });
        let members = self.tendons.iter_mut().chain(&mut self.dampers);
        std::iter::once(&mut self.base_shear).chain(bearings).chain(members)
    }

    /// Keep the larger magnitudes of both.
    pub(super) fn enlarge(&mut self, other: &Self) {
        for (mine, theirs) in self.values_mut().zip(other.values()) {
            if theirs.abs() > mine.abs() {
                *mine = theirs;
            }
        }
    }
}
