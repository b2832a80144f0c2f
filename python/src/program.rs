//! A program with fixed time steps, as Python's arguments ask for it.

use cases::{Case, program::ProgramSection};
use pyo3::prelude::*;

use crate::said::value_error;

/// The arguments of `tune` that ask for a program, in their order.
#[derive(Clone, Debug, Default)]
pub struct ProgramArguments {
    pub program: Option<String>,
    /// (s)
    pub step: Option<f64>,
    pub integrator: Option<String>,
    pub substeps: Option<usize>,
}

impl ProgramArguments {
    /// The case with this program; as it is where nothing asks for one.
    ///
    /// ValueError: a name, a step, an integrator, a number of substeps that are not allowed.
    pub fn of(self, case: Case) -> PyResult<Case> {
        let Self { program, step, integrator, substeps } = self;
        let section = ProgramSection { name: program, step_s: step, integrator, substeps };
        if section.is_empty() {
            return Ok(case);
        }
        let mistake = |(key, value, remedy): (&str, _, _)| {
            let argument = match key {
                "for" => "program",
                "step_s" => "step",
                other => other,
            };
            value_error(format!("{argument} is {value}; {remedy}"))
        };
        let program = Some(section.checked().map_err(mistake)?);
        Ok(Case { program, ..case })
    }
}
