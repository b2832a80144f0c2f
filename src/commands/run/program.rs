//! Options of `tune run` for a program with fixed time steps.

use clap::Args;

use crate::commands::CommandError;
use cases::program::ProgramSection;
use fixed_steps::FixedStepProgram;

/// The program that springs are wanted for besides.
#[derive(Clone, Debug, Default, Args)]
pub struct ProgramOptions {
    /// Program with steps of one size that springs are wanted for besides: sap2000, etabs or
    /// opensees-even [default: the case's; sap2000]
    #[arg(long = "for", value_name = "PROGRAM")]
    name: Option<String>,
    /// Its time step in seconds [default: the case's; 0.001, or the first of 0.002, 0.004 and 0.008
    /// that gets an elastic structure through]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = seconds)]
    step: Option<f64>,
    /// Its integrator: newmark:GAMMA:BETA, hht:ALPHA (0 to -1/2; -1/3 damps most),
    /// generalized-alpha:RHO, trbdf2 or backward-euler [default: the case's; hht:-0.333 in sap2000
    /// and etabs, backward-euler in opensees-even]
    #[arg(long, value_name = "NAME")]
    integrator: Option<String>,
    /// A step that fails is halved, down to one in so many; 1: never [default: the case's; 16]
    #[arg(long, value_name = "N")]
    substeps: Option<usize>,
}

/// A time (s).
fn seconds(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "give seconds as a number: 0.001".into())
}

impl ProgramOptions {
    /// The program asked for: what is given here, and of the case's what is not.
    pub fn over(
        &self,
        of_case: Option<FixedStepProgram>,
    ) -> Result<Option<FixedStepProgram>, CommandError> {
        let Self { name, step, integrator, substeps } = self.clone();
        let given = ProgramSection { name, step_s: step, integrator, substeps };
        if given.is_empty() {
            return Ok(of_case);
        }
        // another program comes with its own integrator
        let case = of_case.map(|case| ProgramSection {
            name: case.name.map(|name| name.key().into()).filter(|_| given.integrator.is_none()),
            step_s: Some(case.step),
            integrator: Some(case.integrator.to_string()).filter(|_| given.name.is_none()),
            substeps: Some(case.substeps),
        });
        let mistake = |(key, value, remedy)| {
            let option = match key {
                "for" => "for",
                "step_s" => "step",
                "integrator" => "integrator",
                _ => "substeps",
            };
            CommandError::Result(format!("--{option} is {value}; {remedy}"))
        };
        given.over(case.unwrap_or_default()).checked().map(Some).map_err(mistake)
    }
}
