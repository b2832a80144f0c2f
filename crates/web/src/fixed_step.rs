//! Springs for a program with steps of one size, before a run measures them.

use serde::Serialize;

use crate::{WebError, any_case::AnyCase};
use files::message::quantity;
use fixed_steps::FixedStepProgram;
use parameters::program::{FootUnits, ProgramRow};
use report::Unit;
use springs::fixed_steps::ProgramSprings;

/// The springs in closed form, which the run tries first and may leave for others.
#[derive(Serialize)]
pub(crate) struct PreliminarySprings {
    /// The program, its steps, its integrator, in words.
    program: String,
    steps: String,
    integrator: String,
    springs: Vec<Unit>,
    /// Expected NRMSE of u: median and the 90 % quantile; the part that the step alone makes.
    median: f64,
    ninety: f64,
    floor: f64,
}

pub(crate) fn preliminary(case: &AnyCase) -> Result<PreliminarySprings, WebError> {
    let AnyCase::Rigid(case) = case else { return Err(WebError::FixedStepElastic) };
    let program = case.program.unwrap_or_else(FixedStepProgram::usual);
    let found = ProgramSprings::preliminary(&case.structure.body(), program)?;
    let row = ProgramRow::<FootUnits>::from(&found);
    let FootUnits { vertical, horizontal, .. } = &row.units;
    Ok(PreliminarySprings {
        program: row.program(),
        steps: quantity(row.step_s, "s"),
        integrator: row.integrator.words(),
        springs: vec![
            Unit::new("vertical", &vertical.chain()),
            Unit::new("horizontal", &horizontal.chain()),
        ],
        median: found.expected.median,
        ninety: found.expected.ninety,
        floor: found.expected.floor,
    })
}
