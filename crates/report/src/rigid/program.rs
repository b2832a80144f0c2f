//! What is to be said of springs for a program with fixed time steps.

use crate::{displacements::LEAST_DRIFT, program::lost};
use cases::{Case, Yardstick};
use fixed_steps::{
    FixedStepHistory, FixedStepOutcome, FixedStepProgram, GaveUp, expected::step_for,
};
use parameters::{
    Parameters,
    answers::ModelComparison,
    program::{ProgramOnRecord, USELESS, round_step},
};
use results::{Finding, Peaks};
use rocking::motion::Motion;
use springs::{fixed_steps::LONGEST, landing_simulation::differs_from_housner};

/// Findings; those of a program that nobody asked for are notes.
pub(super) fn findings(case: &Case, parameters: &Parameters) -> Vec<Finding> {
    let asked = case.program.is_some();
    let body = parameters.structure.body::<f64>();
    let Some(row) = &parameters.program else {
        let other = differs_from_housner(&body, case.restitution);
        return other.then_some(Finding::ProgramRestitution { asked }).into_iter().collect();
    };
    let FixedStepProgram { step: step_s, .. } =
        case.program.unwrap_or_else(FixedStepProgram::usual);
    if step_s > LONGEST / body.p_squared().sqrt() {
        let longest_s = round_step(step_for(&body, USELESS));
        return vec![Finding::ProgramStepTooLong { step_s, longest_s, asked }];
    }
    let mut all: Vec<Finding> = lost(row, asked).into_iter().collect();
    // of peaks no law is known
    let accuracy = case.tuning.asked();
    let needed_s = step_for(&body, accuracy.error);
    if asked && accuracy.by == Yardstick::Histories && step_s > needed_s {
        all.push(Finding::ProgramStepForAccuracy { step_s, needed_s, accuracy: accuracy.error });
    }
    all
}

/// What a program with fixed time steps would find on the record, beside Housner's answer.
pub(super) fn on_record(
    parameters: &Parameters,
    history: &FixedStepHistory,
    (both, dt): (&ModelComparison, f64),
) -> Option<ProgramOnRecord> {
    let body = parameters.structure.body();
    let of = |motion: &Motion| {
        let (theta, u) = (&motion.theta, Some(&motion.u[..]));
        Peaks::of_rigid((parameters.structure.kind, &body), dt, theta, u, 0).top_displacement_m
    };
    let gives_up = match &history.outcome {
        FixedStepOutcome::GaveUp(GaveUp { time, .. }) => Some(*time),
        _ => None,
    };
    let stands = both.matched.overturned_housner_s.is_none()
        && both.rocking.left_ground().is_none()
        && matches!(history.outcome, FixedStepOutcome::Finished);
    let reference = parameters.peaks.as_ref()?.reference;
    let compared = stands && reference.drift_ratio > LEAST_DRIFT;
    let both = compared.then(|| [of(&history.motion), reference.top_displacement_m]);
    Some(ProgramOnRecord::of(both, gives_up))
}
