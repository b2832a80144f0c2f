//! Largest displacements of a history, as an engineer quotes them.
//!
//! ```text
//!   top displacement   of the structure's highest point: rocking carries it, bending adds to it
//!   rocking            what the rotation of the base alone gives that point
//!   bending            displacement of that point across the axis that turns with the base
//!   feet moved         mean horizontal displacement of the feet: legs that scissor land elsewhere than they stood
//!   uplift             of a foot or corner above the ground
//!   drift ratio        top displacement, less what the feet have moved then, over the height of that point
//! ```
//!
//! Each is the largest magnitude by itself: the parts need not be largest at the same instant.

use serde::{Deserialize, Serialize};

use rocking::{
    motion::TimedPeak,
    structure::{Body, Kind},
};

/// Largest magnitudes of one history.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Peaks {
    /// Of the highest point (m).
    pub top_displacement_m: f64,
    /// Its part by rotation of the base (m).
    pub rocking_m: f64,
    /// Its part by bending (m); none of a rigid body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending_m: Option<f64>,
    /// Its part by feet that land elsewhere than they stood (m); none of a rigid body, whose feet
    /// do not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feet_moved_m: Option<f64>,
    /// Of a foot (m).
    pub uplift_m: f64,
    /// Largest displacement of the top from above its feet, wherever these have moved, over the
    /// height of the top.
    pub drift_ratio: f64,
    /// Parts of the top's displacement when it is largest, which are all of it; none of a rigid
    /// body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub then: Option<PartsOfTop>,
    /// Impacts above the energy threshold: harder than a fall from 0.02 alpha; of an elastic
    /// structure, all landings.
    pub impacts: usize,
    /// When they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub times: Option<PeakTimes>,
}

/// Parts of the top's displacement at one time, with the sign that it has (m).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PartsOfTop {
    /// Of which column they are, counted from the left, of a structure with several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
    /// By rotation of the base.
    pub rocking_m: f64,
    /// By bending.
    pub bending_m: f64,
    /// By feet that landed elsewhere than they stood.
    pub feet_moved_m: f64,
}

/// When displacements are largest (s).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PeakTimes {
    /// The top's.
    pub top_displacement_s: f64,
    /// Its part by rotation of the base.
    pub rocking_s: f64,
    /// Its part by bending; none of a rigid body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending_s: Option<f64>,
    /// Of what feet have moved; none of a rigid body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feet_moved_s: Option<f64>,
    /// Of the drift ratio; of a rigid body that of its rotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift_ratio_s: Option<f64>,
    /// Of a foot's uplift.
    pub uplift_s: f64,
}

/// The reference (Housner's body; an elastic structure on rigid ground) and the structure on its
/// springs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PeakPair {
    /// Without springs.
    pub reference: Peaks,
    /// When its solution ends, if that is before the record does: its peaks count up to then (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_ends_s: Option<f64>,
    /// On springs.
    pub springs: Peaks,
    /// When the history on them ends, if that is before the record and the reference do: its peaks
    /// count up to then (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub springs_end_s: Option<f64>,
    /// On springs, with dampers, tendon or friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub with_members: Option<Peaks>,
    /// When that history ends, if it could not be followed to the record's end (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub with_members_end_s: Option<f64>,
    /// Of a motion that can be foretold for a part of the record alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub foretold: Option<ForetoldPeaks>,
}

/// Largest displacements up to when a motion can be foretold: the reference's, and those on
/// springs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForetoldPeaks {
    /// Up to when (s).
    pub until_s: f64,
    /// Of the top (m).
    pub top_displacement_m: [f64; 2],
    /// Of a corner (m).
    pub uplift_m: [f64; 2],
    /// Of the top on springs, with dampers, tendon or friction (m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub with_members_top_m: Option<f64>,
}

impl PeakPair {
    /// With those of the same motions up to `until_s` (s).
    #[must_use]
    pub fn foretold(self, until_s: f64, part: &Self) -> Self {
        let both = |of: fn(&Peaks) -> f64| [of(&part.reference), of(&part.springs)];
        let (top_displacement_m, uplift_m) = (both(|p| p.top_displacement_m), both(|p| p.uplift_m));
        let with_members_top_m = part.with_members.map(|peaks| peaks.top_displacement_m);
        let part = ForetoldPeaks { until_s, top_displacement_m, uplift_m, with_members_top_m };
        Self { foretold: Some(part), ..self }
    }
}

impl Peaks {
    /// Of a rigid body's rotations (rad), `dt` apart (s). `u` is what its centre of mass moves (m):
    /// none of Housner's, whose rotations tell it.
    pub fn of_rigid(
        (kind, body): (Kind, &Body<f64>),
        dt: f64,
        theta: &[f64],
        u: Option<&[f64]>,
        impacts: usize,
    ) -> Self {
        let height = top_height(kind, body);
        let top = Body { height, ..*body };
        let largest = |values: &mut dyn Iterator<Item = f64>| {
            let timed = |(i, value)| TimedPeak { value, time: i as f64 * dt };
            values.enumerate().map(timed).reduce(TimedPeak::larger).unwrap_or_default()
        };
        let rocking = largest(&mut theta.iter().map(|&theta| top.u(theta)));
        let moved = match u {
            Some(u) => {
                let above = |(u, theta): (&f64, &f64)| u + (height - body.height) * theta.sin();
                largest(&mut u.iter().zip(theta).map(above))
            }
            None => rocking,
        };
        let lifted = largest(&mut theta.iter().map(|theta| theta.sin()));
        let top_displacement_m = moved.value.abs();
        let times = PeakTimes {
            top_displacement_s: moved.time,
            rocking_s: rocking.time,
            uplift_s: lifted.time,
            ..PeakTimes::default()
        };
        Self {
            top_displacement_m,
            rocking_m: rocking.value.abs(),
            uplift_m: 2.0 * body.half_width * lifted.value.abs(),
            drift_ratio: rocking.value.abs() / height,
            impacts,
            times: Some(times),
            ..Self::default()
        }
    }
}

/// Height of a rigid body's highest point (m): a solid block is twice as high as its centre of
/// mass.
pub(crate) fn top_height(kind: Kind, body: &Body<f64>) -> f64 {
    match kind {
        Kind::AFrame => body.height,
        Kind::Block => 2.0 * body.height,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::structure::Structure;

    /// A block of 2 x 0.5 m that leans by 0.1 about its corner: its top corner line is at (-b, 2h)
    /// from the pivot.
    #[test]
    fn a_leaning_block_moves_its_top_and_lifts_its_foot_as_geometry_says() {
        let block = Structure::block(2.0, 0.5, 100.0).unwrap();
        let body = block.body::<f64>();
        let peaks = Peaks::of_rigid((block.kind, &body), 0.5, &[0.0, 0.1, -0.05], None, 3);
        // the middle of the top, (-0.25, 2) from the pivot, turned clockwise by 0.1
        let moved = -0.25 * 0.1_f64.cos() + 2.0 * 0.1_f64.sin() + 0.25;
        assert!((peaks.top_displacement_m - moved).abs() < 1e-12, "{peaks:?}");
        assert!((peaks.uplift_m - 0.5 * 0.1_f64.sin()).abs() < 1e-12, "{peaks:?}");
        assert!((peaks.drift_ratio - moved / 2.0).abs() < 1e-12 && peaks.bending_m.is_none());
        let times = peaks.times.unwrap();
        assert_eq!((times.top_displacement_s, times.uplift_s), (0.5, 0.5));
        // an A-frame's top is its centre of mass
        let frame = Structure::paper();
        let body = frame.body::<f64>();
        let peaks = Peaks::of_rigid((frame.kind, &body), 0.5, &[0.01], None, 1);
        assert!((peaks.top_displacement_m - body.u(0.01)).abs() < 1e-12);
    }

    #[test]
    fn on_springs_the_centre_of_mass_may_move_besides() {
        let block = Structure::block(2.0, 0.5, 100.0).unwrap();
        let body = block.body::<f64>();
        let peaks =
            Peaks::of_rigid((block.kind, &body), 0.5, &[0.1], Some(&[body.u(0.1) + 0.003]), 0);
        assert!((peaks.top_displacement_m - peaks.rocking_m - 0.003).abs() < 1e-12, "{peaks:?}");
    }
}
