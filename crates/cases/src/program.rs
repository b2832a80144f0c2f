//! `[program]` of case files, and the same asked by options: a program with fixed time steps that
//! springs are wanted for besides.
//!
//! ```toml
//! [program]
//! for = "sap2000"            # or "etabs", "opensees-even"; left out: any program with this integrator
//! step_s = 0.001
//! integrator = "hht:-0.333"  # left out: the one that the program is to be set to
//! substeps = 16              # a step that fails is halved, down to one in so many, a power of two; 1: never
//! ```

use serde::Deserialize;

use super::{CaseError, Limits};
use fixed_steps::{
    FixedStepProgram, IntegratorNameError, ProgramName,
    program::{SUBSTEPS, USUAL_STEP},
};

/// Of a program's time step (s).
pub const STEP: Limits =
    Limits { least: 1e-6, most: 0.1, remedy: "give a time step between 1e-6 and 0.1 s, as 0.001" };
/// Most substeps of a step that fails.
const MOST_SUBSTEPS: usize = 4096;
/// What to give for a program that is none.
const NAMES: &str =
    "give sap2000, etabs or opensees-even; for another program: --step and --integrator";

/// A program with fixed time steps, as it is asked for.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProgramSection {
    /// Which program.
    #[serde(rename = "for")]
    pub name: Option<String>,
    /// Its step (s).
    pub step_s: Option<f64>,
    /// Its integrator.
    pub integrator: Option<String>,
    /// Halvings of a step that fails.
    pub substeps: Option<usize>,
}

/// A key of the section whose value cannot be, the value, and what to do.
pub type ProgramMistake = (&'static str, String, String);

impl ProgramSection {
    /// Whether nothing is asked.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// This, and what it does not say from another one.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        Self {
            name: self.name.or(other.name),
            step_s: self.step_s.or(other.step_s),
            integrator: self.integrator.or(other.integrator),
            substeps: self.substeps.or(other.substeps),
        }
    }

    /// The program that is asked for; SAP2000 at a millisecond where neither it nor its integrator
    /// is given.
    ///
    /// # Errors
    /// A name, a step, an integrator, a number of substeps that cannot be.
    pub fn checked(&self) -> Result<FixedStepProgram, ProgramMistake> {
        let name = match &self.name {
            Some(name) => Some(name.parse().map_err(|_| ("for", quoted(name), NAMES.to_string()))?),
            None => self.integrator.is_none().then_some(ProgramName::Sap2000),
        };
        let step = STEP
            .check(self.step_s.unwrap_or(USUAL_STEP))
            .map_err(|(v, remedy)| ("step_s", v, remedy.into()))?;
        let integrator = match &self.integrator {
            Some(given) => given.parse().map_err(|wrong: IntegratorNameError| {
                ("integrator", quoted(given), wrong.remedy())
            })?,
            None => name.unwrap_or(ProgramName::Sap2000).integrator(),
        };
        if let (Some(given), Some(name)) = (&self.integrator, name)
            && !name.has(integrator)
        {
            let remedy = format!(
                "{} takes {}: give one of these, or --step and --integrator without a program",
                name.words(),
                name.integrators()
            );
            return Err(("integrator", quoted(given), remedy));
        }
        let substeps = self.substeps.unwrap_or(SUBSTEPS);
        // a step is halved, and its halves are: the least of three substeps would be a half
        if !(substeps.is_power_of_two() && substeps <= MOST_SUBSTEPS) {
            return Err((
                "substeps",
                substeps.to_string(),
                format!("give a power of two from 1 to {MOST_SUBSTEPS}: 1, 2, 4, 8, ..."),
            ));
        }
        let step_is_given = self.step_s.is_some();
        Ok(FixedStepProgram { name, integrator, step, step_is_given, substeps })
    }

    /// The program of a case file, none if it asks for none; `path` names it in messages.
    ///
    /// # Errors
    /// As above.
    pub(super) fn of_case(
        section: Option<&Self>,
        path: &str,
    ) -> Result<Option<FixedStepProgram>, CaseError> {
        let mistake =
            |(key, value, remedy)| CaseError::Program { path: path.into(), key, value, remedy };
        section.map(|section| section.checked().map_err(mistake)).transpose()
    }
}

fn quoted(name: &str) -> String {
    format!("{name:?}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Case;
    use fixed_steps::Integrator;

    #[test]
    fn a_program_is_named_or_its_integrator_is() {
        let body = "[structure]\nkind = 'block'\nheight_m = 1.0\nwidth_m = 0.4\nmass_kg = 1e3\n";
        let read = |program: &str| Case::parse("c.toml", &format!("{body}{program}"));
        assert_eq!(read("").unwrap().program, None);
        assert_eq!(read("[program]\n").unwrap().program, Some(FixedStepProgram::usual()));
        let program =
            read("[program]\nfor = 'opensees-even'\nstep_s = 0.002\n").unwrap().program.unwrap();
        assert_eq!(program, FixedStepProgram::of(ProgramName::OpenSees, 0.002));
        let program =
            read("[program]\nintegrator = 'hht:-0.1'\nsubsteps = 1\n").unwrap().program.unwrap();
        assert_eq!((program.name, program.integrator), (None, Integrator::Hht { alpha: -0.1 }));
        assert_eq!((program.step, program.substeps), (1e-3, 1));
        let hht = read("[program]\nfor = 'SAP 2000'\nintegrator = 'HHT'\n").unwrap().program;
        assert_eq!(hht, Some(FixedStepProgram::usual()));
        for (wrong, told) in [
            ("for = 'abaqus'", "program.for is \"abaqus\"; give sap2000"),
            ("integrator = 'hht:0.333'", "give hht:-0.333"),
            ("step_s = 0.0", "program.step_s is 0.0; give a time step between"),
            ("integrator = 'wilson'", "program.integrator is \"wilson\"; give newmark:GAMMA:BETA"),
            (
                "integrator = 'hht:-0.51'",
                "program.integrator is \"hht:-0.51\"; give one from 0 to -0.5, beyond which",
            ),
            ("integrator = 'hht:0.5'", "program.integrator is \"hht:0.5\"; "),
            (
                "for = 'sap2000'\nintegrator = 'trbdf2'",
                "program.integrator is \"trbdf2\"; SAP2000 takes hht:ALPHA from -1/3 to 0",
            ),
            (
                "for = 'opensees-even'\nintegrator = 'generalized-alpha:0'",
                "OpenSees with even steps takes backward-euler, trbdf2",
            ),
            ("substeps = 0", "program.substeps is 0; give a power of two from 1"),
            ("substeps = 3", "program.substeps is 3; give a power of two from 1 to 4096: 1, 2, 4,"),
            ("substeps = 8192", "program.substeps is 8192; give a power of two from 1 to 4096"),
        ] {
            let error = read(&format!("[program]\n{wrong}\n")).unwrap_err().to_string();
            assert!(error.starts_with("c.toml, line ") && error.contains(told), "{error}");
        }
    }
}
