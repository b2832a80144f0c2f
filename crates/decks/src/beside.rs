//! Housner's answer beside that of a program's steps, for the joint that a user compares.

use rocking::{
    housner::{self, RockingOptions},
    motion::Motion,
    structure::Structure,
};
use springs::{parameters::Parameters, results::predictable_to};
use strong_motion::Record;

/// Largest and least displacements of the centre of mass (m), up to where the motion can be
/// predicted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HousnerBeside {
    /// That time (s), if it is not all of the history.
    pub until_s: Option<f64>,
    /// By Housner's equation.
    pub housner: (f64, f64),
    /// By an emulation of the program's steps.
    pub steps: (f64, f64),
}

impl HousnerBeside {
    /// Of the structure as it was given, whose motion on its springs this is. None where the
    /// parameters are of another record, or Housner's body overturns or leaves the ground.
    pub(crate) fn of(
        given: &Structure,
        parameters: &Parameters,
        record: &Record,
        steps: &Motion,
    ) -> Option<Self> {
        parameters.record.as_ref().filter(|row| row.is_of(record))?;
        let body = given.body();
        let restitution = Some(parameters.restitution());
        let vertical = record.vertical_accel();
        let options = RockingOptions { restitution, vertical, ..Default::default() };
        let rocking = housner::solve(&body, record.dt, &record.accel, &options);
        if rocking.overturned().is_some() || rocking.left_ground().is_some() {
            return None;
        }
        let housner = rocking.motion(&body);
        let whole = steps.len().min(housner.len());
        let until = predictable_to(&parameters.findings);
        let samples = until.map_or(whole, |time| (time / record.dt) as usize + 1);
        let range = |u: &[f64]| {
            let among = u.iter().take(samples.min(whole));
            among.fold((0.0, 0.0), |(max, min): (f64, f64), &u| (max.max(u), min.min(u)))
        };
        Some(Self {
            until_s: until.filter(|_| samples < whole),
            housner: range(&housner.u),
            steps: range(&steps.u),
        })
    }
}
