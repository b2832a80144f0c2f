//! Housner's answer beside that of a program's steps, for the joint that a user compares.

use parameters::Parameters;
use rocking::{
    housner::{self, RockingOptions},
    structure::Structure,
};
use strong_motion::Record;

/// Largest and least displacement of the centre of mass by Housner's equation (m), over so many
/// samples, of the structure as it was given. None where Housner's body overturns or leaves the
/// ground within these.
pub(crate) fn housner_range(
    given: &Structure,
    parameters: &Parameters,
    record: &Record,
    samples: usize,
) -> Option<(f64, f64)> {
    let body = given.body();
    let options = RockingOptions::on(record, parameters.restitution());
    let rocking = housner::solve(&body, record.dt, &record.accel, &options);
    let ends = rocking.overturned().or(rocking.left_ground());
    if ends.is_some_and(|time| time < samples.saturating_sub(1) as f64 * record.dt) {
        return None;
    }
    let u = rocking.motion(&body).u;
    Some(u.iter().take(samples).fold((0.0, 0.0), |(max, min), &u| (max.max(u), min.min(u))))
}
