//! What is to be said of springs for a program with fixed time steps.

use crate::{displacements::LEAST_DRIFT, program::lost};
use cases::{Case, Yardstick};
use decks::{samples_to, samples_to_fall};
use fixed_steps::{
    FixedStepHistory, FixedStepOutcome, FixedStepProgram, GaveUp, expected::step_for,
};
use parameters::{
    Parameters,
    answers::ModelComparison,
    program::{ProgramOnRecord, USELESS, round_step},
};
use results::{Finding, Peaks};
use rocking::motion::{Motion, nrmse};
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
    if step_s > LONGEST / body.p() {
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

/// What a program with fixed time steps would find on the record, beside Housner's answer: up to
/// when its motion can be predicted, `until` (s), if not to its end.
pub(super) fn on_record(
    parameters: &Parameters,
    history: &FixedStepHistory,
    (both, dt): (&ModelComparison, f64),
    until: Option<f64>,
) -> Option<ProgramOnRecord> {
    let body = parameters.structure.body();
    let all = &both.rocking.theta;
    let samples = samples_to(until, dt, all.len());
    let of = |theta: &[f64], u: Option<&[f64]>| {
        let (theta, u) = (&theta[..samples], u.map(|u| &u[..samples]));
        Peaks::of_rigid((parameters.structure.kind, &body), dt, theta, u, 0)
    };
    let [gives_up, falls_s] = match &history.outcome {
        FixedStepOutcome::GaveUp(GaveUp { time, .. }) => [Some(*time), None],
        // where its model's history ends
        FixedStepOutcome::Fallen { time } => {
            let fallen = samples_to_fall(&history.motion.theta) - 1;
            [None, Some((fallen as f64 * dt).min(*time))]
        }
        FixedStepOutcome::Finished => [None; 2],
    };
    let later = |time: Option<f64>| time.is_none_or(|time| until.is_some_and(|until| until < time));
    let stands = later(both.matched.overturned_housner_s)
        && both.rocking.left_ground().is_none_or(|time| until.is_some_and(|until| until <= time))
        && later(falls_s);
    let Motion { theta, u, .. } = &history.motion;
    let covered = stands && samples <= theta.len().min(all.len());
    let reference = covered.then(|| of(all, None)).filter(|of| of.drift_ratio > LEAST_DRIFT);
    let found = |reference: Peaks| [of(theta, Some(u)), reference].map(|of| of.top_displacement_m);
    let on = ProgramOnRecord::of(reference.map(found), gives_up);
    let due = both.rocking.motion(&body).u;
    let nrmse = if covered { nrmse(&u[..samples], &due[..samples]) } else { f64::NAN };
    Some(ProgramOnRecord { falls_s, ..on.with_history(nrmse) })
}
