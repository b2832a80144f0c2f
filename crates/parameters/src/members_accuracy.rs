//! What springs err on a record with a structure's tendon and dampers.

use serde::{Deserialize, Serialize};

use crate::answers::MemberHistory;
use rocking::{
    motion::{largest_magnitude, nrmse, samples_until},
    structure::Body,
};

/// Errors of the finite elements with a tendon or dampers on the run's record, beside Housner's
/// equation with them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MembersAccuracy {
    /// Up to when the two are compared (s), if not to their end: while the motion can be predicted,
    /// and both stand.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
    /// NRMSE of the horizontal displacement.
    pub history: f64,
    /// Error of the largest horizontal displacement, relative to it.
    pub displacement: f64,
    /// Error of the largest uplift of a foot, relative to it.
    pub uplift: f64,
}

impl MembersAccuracy {
    /// Of a history whose motion can be predicted until then (s), if not to its end; samples dt
    /// apart (s). None with friction, and of a body that does not rock.
    pub fn new(
        body: &Body<f64>,
        dt: f64,
        with: &MemberHistory,
        until: Option<f64>,
    ) -> Option<Self> {
        let (reference, found) = (with.housner.as_ref()?, &with.history.motion);
        let falls = [with.matched.overturned_housner_s, with.matched.overturned_fem_s];
        // where the pivot lets go his history ends before the record does
        let shorter = reference.len().min(found.len());
        let cut = (reference.len() != found.len()).then_some(shorter.saturating_sub(1) as f64 * dt);
        let until_s = falls.into_iter().flatten().chain(until).chain(cut).reduce(f64::min);
        let samples = samples_until(until_s, dt).min(shorter);
        let first = |of: &[f64]| of[..samples].to_vec();
        let u = [&reference.u, &found.u].map(|u| first(u));
        let uplift = [&reference.theta, &found.theta]
            .map(|theta| first(theta).iter().map(|x| x.abs().sin()).collect::<Vec<_>>());
        if largest_magnitude(&first(&reference.theta)) < LEAST * body.alpha() {
            return None;
        }
        let error = |[reference, found]: &[Vec<f64>; 2]| {
            (largest_magnitude(found) / largest_magnitude(reference) - 1.0).abs()
        };
        let (history, displacement, uplift) = (nrmse(&u[1], &u[0]), error(&u), error(&uplift));
        Some(Self { until_s, history, displacement, uplift })
    }

    /// The larger error of peaks, and which it is.
    pub fn peaks(&self) -> (f64, &'static str) {
        match self.uplift > self.displacement {
            true => (self.uplift, "uplift"),
            false => (self.displacement, "displacement"),
        }
    }
}

/// Rotation over alpha from which on a body rocks.
const LEAST: f64 = 1e-3;
