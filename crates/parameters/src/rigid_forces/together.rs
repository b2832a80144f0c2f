//! What acts together with a largest force of a history on springs.

use super::{
    all_between,
    ground_row::{GroundRow, standing_feet},
    sliding::upright,
};
use crate::answers::{MemberHistory, ModelComparison};
use dynamics::fem::{Demands, History, corner_forces};
use results::{DesignForce, MOST_CHANGE};
use rocking::{
    members::Members,
    motion::TimedPeak,
    scalar::GRAVITY,
    structure::{Body, Kind},
};
use strong_motion::Record;

/// Largest forces of a history, and those near its landings that its motion tells.
pub(super) struct FoundForces<const N: usize> {
    pub peaks: [TimedPeak; N],
    /// The index of a sample and the forces at that sample; times increase.
    pub near: Vec<(usize, GroundRow)>,
}

/// A history's forces at any sample, as far as all of them are known.
pub(super) struct ForceInstants<'a> {
    kind: Kind,
    body: &'a Body<f64>,
    record: &'a Record,
    history: &'a History,
    demands: &'a Demands,
    members: Members,
    near: &'a [(usize, GroundRow)],
    kept: Vec<usize>,
}

impl<'a> ForceInstants<'a> {
    /// Of the history that answers.
    pub fn new(
        (kind, body): (Kind, &'a Body<f64>),
        record: &'a Record,
        both: &'a ModelComparison,
        near: &'a [(usize, GroundRow)],
    ) -> Self {
        let (history, demands, members) = match &both.with {
            Some(MemberHistory { history, demands, members, .. }) => (history, demands, *members),
            None => (&both.fem, &both.demands, Members::default()),
        };
        let kept = all_between(body, record.dt, history, demands.feet.len());
        Self { kind, body, record, history, demands, members, near, kept }
    }

    /// Force k, as [`DesignForce::measured`]; if it holds, with what acts together with it.
    pub fn force(&self, k: usize, peak: TimedPeak, change: Option<f64>) -> DesignForce {
        let found = DesignForce::measured(peak.value, peak.time, change);
        let near = |row: &GroundRow| {
            let other = row.largest(k).abs();
            (other - peak.value.abs()).abs() <= MOST_CHANGE * peak.value.abs()
        };
        let row = self.at(peak.time).filter(|row| found.holds && near(row));
        let together = row.as_ref().map(|row| row.together(self.kind, k));
        DesignForce { together, corner: row.and_then(|row| row.corner(k)), ..found }
    }

    /// At a time (s): near a landing by the body's motion; between them by the foot that presses
    /// alone, to which springs add nothing, or by statics where both do: of the ground's motion, or
    /// on friction of what the springs hold.
    fn at(&self, time: f64) -> Option<GroundRow> {
        let i = (time / self.record.dt).round() as usize;
        let (kind, body) = (self.kind, self.body);
        if self.kept.binary_search(&i).is_err() {
            let found = self.near.binary_search_by_key(&i, |(sample, _)| *sample).ok()?;
            return self.near.get(found).map(|(_, row)| *row).filter(|row| row.whole);
        }
        let (corners, theta) = (*self.demands.feet.get(i)?, *self.history.motion.theta.get(i)?);
        if corners.iter().any(|[_, press]| *press <= 0.0) {
            let all = corner_forces(self.demands, i);
            return Some(GroundRow { corners, ..GroundRow::new(kind, body, theta, all) });
        }
        if let Some(friction) = self.members.friction {
            return upright(kind, body, friction, corners);
        }
        let at = |record: &[f64]| record.get(i).copied().unwrap_or(0.0) / GRAVITY;
        let weight = body.mass * GRAVITY;
        let held = self.members.tendon.map_or(0.0, |tendon| tendon.pretension) / weight;
        let ground = (at(&self.record.accel), 1.0 + at(self.record.up()) + held);
        Some(GroundRow::new(kind, body, theta, standing_feet(body, weight, ground)))
    }
}
