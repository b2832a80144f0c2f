//! What is to be said of springs for a program with fixed time steps.

use crate::program::lost;
use fixed_steps::{FixedStepProgram, expected::step_for};
use springs::{
    case::{Case, Yardstick},
    parameters::Parameters,
    results::Finding,
    tuning::{fixed_steps::LONGEST, landing_simulation::differs_from_housner},
};

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
    let longest_s = LONGEST / body.p_squared().sqrt();
    if step_s > longest_s {
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
