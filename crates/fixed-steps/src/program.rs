//! Programs with one size of step, as users name them, and what they are set to.
//!
//! | program | integrator | Newton's iterations | test | substeps |
//! |---|---|---|---|---|
//! | SAP2000, ETABS | HHT, alpha = -1/3 | 40 | unbalance over weight | down to 1/16 |
//! | OpenSees | BackwardEuler | 30 | change of place | down to 1/16 |
//!
//! CSI's help ("Time Integration Parameters Form") proposes its Hilber-Hughes-Taylor method with
//! alpha from 0 to -1/3; -1/3 damps stiff modes most, and without damping them an A-frame on ground
//! springs never gets through (`.ci/fixed_steps.py`). Iterations with constant stiffness settle on
//! contacts that are wrong and leave Newton's none to begin from, so that none are to be taken. Of
//! OpenSees' integrators BackwardEuler loses fewest histories (docs/fixed-steps.md). SAP2000 and
//! ETABS were not run: this is what the emulation finds of their settings.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::{
    analysis::StepSettings,
    integrator::Integrator,
    iteration::{ConvergenceTest, Iteration, NEWTON},
    kinematics::MemberDamping,
    recipe::TOLERANCE,
};
use rocking::scalar::GRAVITY;

/// A program that takes steps of one size; in files as users name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum ProgramName {
    /// CSI's SAP2000.
    Sap2000,
    /// CSI's ETABS.
    Etabs,
    /// OpenSees, in a script with steps of one size.
    OpenSees,
}

/// A name that is no program's.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("program {name:?}: give sap2000, etabs or opensees-even")]
pub struct ProgramNameError {
    /// As given.
    pub name: String,
}

impl ProgramName {
    /// Every program.
    pub const ALL: [Self; 3] = [Self::Sap2000, Self::Etabs, Self::OpenSees];

    /// As users name it.
    #[doc(hidden)]
    pub fn key(self) -> &'static str {
        match self {
            Self::Sap2000 => "sap2000",
            Self::Etabs => "etabs",
            Self::OpenSees => "opensees-even",
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Sap2000 => "SAP2000",
            Self::Etabs => "ETABS",
            Self::OpenSees => "OpenSees with even steps",
        }
    }

    /// Whether its decks can be set to this integrator. SAP2000's have Newmark's and
    /// Hilber-Hughes-Taylor's, of alpha from 0 to -1/3; OpenSees' generalized alpha is not Chung
    /// and Hulbert's.
    pub fn has(self, integrator: Integrator) -> bool {
        match self {
            Self::Sap2000 | Self::Etabs => match integrator {
                Integrator::Newmark { .. } => true,
                // but for rounding
                Integrator::Hht { alpha } => alpha > -1.0 / 3.0 - 1e-9,
                _ => false,
            },
            Self::OpenSees => !matches!(integrator, Integrator::GeneralizedAlpha { .. }),
        }
    }

    /// Those integrators, as users give them.
    #[doc(hidden)]
    pub fn integrators(self) -> &'static str {
        match self {
            Self::Sap2000 | Self::Etabs => "hht:ALPHA from -1/3 to 0, or newmark:GAMMA:BETA",
            Self::OpenSees => "backward-euler, trbdf2, hht:ALPHA or newmark:GAMMA:BETA",
        }
    }

    /// The integrator that it is to be set to, unless told otherwise.
    pub fn integrator(self) -> Integrator {
        match self {
            Self::Sap2000 | Self::Etabs => Integrator::HHT_MOST,
            Self::OpenSees => Integrator::BackwardEuler,
        }
    }
}

impl MemberDamping {
    /// Of a program; OpenSees' where only an integrator is known.
    pub fn of_program(name: Option<ProgramName>) -> Self {
        match name {
            Some(ProgramName::Sap2000 | ProgramName::Etabs) => Self::OfVelocities,
            Some(ProgramName::OpenSees) | None => Self::OfChanges,
        }
    }
}

impl fmt::Display for ProgramName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

impl FromStr for ProgramName {
    type Err = ProgramNameError;

    /// However it is written: "SAP 2000" is sap2000.
    fn from_str(name: &str) -> Result<Self, ProgramNameError> {
        let plain = |name: &str| -> String {
            let letters = name.chars().filter(|c| !c.is_whitespace() && !"-_".contains(*c));
            letters.flat_map(char::to_lowercase).collect()
        };
        let known = Self::ALL.into_iter().find(|known| plain(known.key()) == plain(name));
        known.ok_or_else(|| ProgramNameError { name: name.into() })
    }
}

impl TryFrom<String> for ProgramName {
    type Error = ProgramNameError;

    fn try_from(name: String) -> Result<Self, ProgramNameError> {
        name.parse()
    }
}

impl From<ProgramName> for String {
    fn from(name: ProgramName) -> Self {
        name.key().into()
    }
}

/// A program with fixed time steps, which springs are asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedStepProgram {
    /// Which, if it is one of those that are known.
    pub name: Option<ProgramName>,
    /// Its integrator.
    pub integrator: Integrator,
    /// Its step (s).
    pub step: f64,
    /// Whether a user gave that step; another may be taken where it loses most motions, if not.
    pub step_is_given: bool,
    /// A step that fails is halved, down to one in so many: 1, 2, 4, ...
    pub substeps: usize,
}

/// Substeps of a step unless told otherwise.
pub const SUBSTEPS: usize = 16;
/// The step of a program that nobody has told (s).
pub const USUAL_STEP: f64 = 1e-3;
/// Tolerance of an unbalance over the horizontal force that lifts a structure, W tan(alpha) of a
/// rigid body: the foot that bore all drops about so much as it lifts in a landing, which is then
/// missing on its node and on the absorber's. With less, iterations that go to and fro between the
/// foot on the ground and in the air never arrive (`cargo bench --bench fixed_steps -- tolerance`).
const DROPPED: f64 = std::f64::consts::SQRT_2;
/// Newton's iterations of a step at most, as a public generator of SAP2000's tables has them.
const CSI_NEWTON: usize = 40;

impl FixedStepProgram {
    /// A program that is known, at this step (s): a case file takes one from 1e-6 to 0.1 s. Every
    /// other field is as the program is to be set.
    pub fn of(name: ProgramName, step: f64) -> Self {
        let (integrator, substeps) = (name.integrator(), SUBSTEPS);
        Self { name: Some(name), integrator, step, step_is_given: true, substeps }
    }

    /// What a run has springs for if nobody says otherwise: SAP2000 at a millisecond.
    pub fn usual() -> Self {
        Self { step_is_given: false, ..Self::of(ProgramName::Sap2000, USUAL_STEP) }
    }

    /// Whether its test of convergence is an unbalance over the structure's weight.
    fn tests_unbalance(&self) -> bool {
        matches!(self.name, Some(ProgramName::Sap2000 | ProgramName::Etabs))
    }

    /// How it steps a structure that this horizontal force lifts (N): to a change of place of g
    /// dt^2/10, or to an unbalance (`DROPPED`).
    #[doc(hidden)]
    pub fn settings(&self, lifting: f64) -> StepSettings {
        let iteration = if self.tests_unbalance() {
            let test = ConvergenceTest::Unbalance(DROPPED * lifting);
            Iteration { constant: 0, newton: CSI_NEWTON, test }
        } else {
            let test = ConvergenceTest::Increment(TOLERANCE * GRAVITY * self.step.powi(2));
            Iteration { constant: 0, newton: NEWTON, test }
        };
        let damping = MemberDamping::of_program(self.name);
        let settings = StepSettings::new(self.integrator, self.step);
        let settings = StepSettings { iteration, damping, ..settings };
        settings.with_substeps(1.0 / self.substeps.max(1) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::FixedStepSprings;
    use approx::assert_relative_eq;
    use rocking::structure::Structure;

    #[test]
    fn programs_are_named_as_users_do() {
        for name in ProgramName::ALL {
            assert_eq!(name.to_string().parse(), Ok(name));
        }
        for name in ["SAP2000", "SAP 2000", "sap-2000", "Sap_2000"] {
            assert_eq!(name.parse(), Ok(ProgramName::Sap2000));
        }
        assert_eq!("OpenSees even".parse(), Ok(ProgramName::OpenSees));
        let hht = |alpha: f64| ProgramName::Etabs.has(Integrator::Hht { alpha });
        assert_eq!([-0.4, -0.3334, -1.0 / 3.0, 0.0].map(hht), [false, false, true, true]);
        assert!(ProgramName::OpenSees.has(Integrator::Hht { alpha: -0.4 }));
        assert!("abaqus".parse::<ProgramName>().unwrap_err().to_string().contains("opensees-even"));
    }

    /// CSI's programs stop at what a foot drops that lifts; others at a change of place.
    #[test]
    fn programs_stop_by_their_own_tests() {
        let body = Structure::paper().body::<f64>();
        for step in [1e-2, 1e-4] {
            let program = FixedStepProgram::of(ProgramName::Sap2000, step);
            let lifting = body.lifting_force();
            let settings = program.settings(lifting);
            let Iteration { constant: 0, newton: 40, test: ConvergenceTest::Unbalance(below) } =
                settings.iteration
            else {
                panic!("{:?}", settings.iteration)
            };
            // b/h = 0.1
            let expected = 0.1 * 2f64.sqrt() * body.mass * GRAVITY;
            assert_relative_eq!(below, expected, max_relative = 1e-9);
            assert_relative_eq!(settings.least, step / 16.0, max_relative = 1e-12);
            let springs = FixedStepSprings::of(&body, step, program.integrator).unwrap();
            let even = FixedStepProgram { name: None, ..program };
            assert_eq!(even.settings(lifting).iteration, springs.iteration());
        }
    }
}
