//! The report of a rigid body on springs from the geometry, within milliseconds, for interactive
//! use.

use super::{alone, peaks, taken};
use crate::{Run, doubts, filed, reference, reference::HousnerReport};
use cases::Case;
use dynamics::spring::{Design, Springs};
use parameters::{
    Parameters,
    answers::{ModelComparison, compare_models},
};
use results::Finding;
use strong_motion::{Record, RecordError};

/// Both models' answers on given springs, and what is said of them.
pub struct RunAtOnce {
    /// The part of the record that is used, scaled.
    pub record: Record,
    /// Both histories.
    pub both: ModelComparison,
    /// Its verdict, peaks and springs; neither design forces nor an accuracy.
    pub run: Run,
}

impl RunAtOnce {
    /// Follow the record with the case's members; `friction` of the ground, for the warning of
    /// sliding.
    ///
    /// # Errors
    /// A scale that takes the record's peak above 50 g.
    pub fn new(
        case: &Case,
        springs: &Springs<Design<f64>>,
        friction: f64,
    ) -> Result<Self, RecordError> {
        let (structure, e) = (case.structure, case.restitution);
        let (body, record) = (structure.body::<f64>(), case.excitation.used()?);
        let parameters = Parameters::new(structure, springs);
        let both = compare_models(&body, e, &parameters.chains(), &case.members, &record);
        let report = HousnerReport::new(&body, e, &record, &both.rocking, friction)
            .with_members(&body, &record, &both)
            .with_conditioning(&body, &parameters.chains(), &record, &both);
        let verdict = both.verdict(&body, record.dt, &report.conditioning);
        let mut findings: Vec<Finding> =
            reference::all(&structure, &record, &both, &report, &verdict);
        findings.extend(doubts(case.doubts()));
        let parameters = Parameters {
            peaks: Some(peaks(structure.kind, &body, record.dt, &both)),
            conditioning: Some(report.conditioning.into()),
            verdict: Some(verdict),
            findings: filed(findings),
            ..parameters
        };
        let mut run = Run {
            friction_needed: Some(report.friction_needed()),
            friction_in_landings: report.needs_friction_to_land(),
            ..alone(parameters)
        };
        run.taken = crate::Taken {
            record: Some(case.excitation.line()),
            ..taken(&structure, e, &case.members)
        };
        Ok(Self { record, both, run })
    }
}
