//! Housner's answer beside that of a program's steps, for the joint that a user compares.

use parameters::Parameters;
use rocking::{
    housner::{self, RockingOptions, RockingOutcome},
    structure::Structure,
};
use strong_motion::Record;

/// How Housner's body ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum HousnerEnd {
    /// It does not overturn.
    Stands,
    /// When it has overturned (s).
    Overturns(f64),
    /// When its pivot leaves the ground (s).
    LeavesGround(f64),
}

/// What Housner's equation finds of the structure as it was given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HousnerBeside {
    /// Largest and least displacement of the centre of mass (m), over so many samples as are
    /// compared. None where the body overturns or leaves the ground within these.
    pub range: Option<(f64, f64)>,
    /// How it ends on the whole record; none where the equation was not followed to there.
    pub end: Option<HousnerEnd>,
}

/// The same of a body on a record, compared over so many samples.
pub(crate) fn housner_beside(
    given: &Structure,
    parameters: &Parameters,
    record: &Record,
    samples: usize,
) -> HousnerBeside {
    let body = given.body();
    let options = RockingOptions::on(record, parameters.restitution());
    let rocking = housner::solve(&body, record.dt, &record.accel, &options);
    let end = match rocking.outcome {
        RockingOutcome::Overturned { time } => Some(HousnerEnd::Overturns(time)),
        RockingOutcome::LeavesGround { time } => Some(HousnerEnd::LeavesGround(time)),
        RockingOutcome::WorkBound { .. } | RockingOutcome::NotFinite { .. } => None,
        _ => Some(HousnerEnd::Stands),
    };
    let ends = rocking.overturned().or(rocking.left_ground());
    if ends.is_some_and(|time| time < samples.saturating_sub(1) as f64 * record.dt) {
        return HousnerBeside { range: None, end };
    }
    let u = rocking.motion(&body).u;
    let range = u
        .iter()
        .take(samples)
        .fold((0.0, 0.0), |(max, min): (f64, f64), &u| (max.max(u), min.min(u)));
    HousnerBeside { range: Some(range), end }
}
