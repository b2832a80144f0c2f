//! Springs for a program with fixed time steps, as parameters.json holds them.

use serde::{Deserialize, Serialize};

mod on_record;
mod verdict;

use super::{ParametersError, corner::CornerRow};
use cases::program::ProgramSection;
use dynamics::spring::{Chain, ChainRow, Springs};
use fixed_steps::{
    ConvergenceTest, FixedStepProgram, Integrator, Iteration, ProgramName, StepSettings,
    measured::ErrorsOverMotions,
};
pub use on_record::ProgramOnRecord;
use results::NotToBeUsed;
use rocking::{scalar::GRAVITY, structure::Structure};
pub use springs::fixed_steps::instead::{USELESS, round_step};
use springs::{
    elastic::program::ElasticProgramSprings,
    fixed_steps::{ProgramSprings, instead::ProgramInstead},
};

/// Errors of histories of a program beside Housner's, over motions; `null` if so many were lost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProgramErrors {
    /// Motions.
    pub histories: usize,
    /// Of these, how many the program does not get through, or topples the body in.
    pub lost: usize,
    /// NRMSE of u, or of rotations of an elastic structure: median, and what 90 % are below.
    pub history: [Option<f64>; 2],
    /// Error of the largest u, relative to it; of an elastic structure that of the displacement,
    /// drift or uplift with the largest: the same.
    pub peak: [Option<f64>; 2],
}

impl From<&ErrorsOverMotions> for ProgramErrors {
    fn from(errors: &ErrorsOverMotions) -> Self {
        let finite = |x: f64| x.is_finite().then_some(x);
        Self {
            histories: errors.count(),
            lost: errors.lost(),
            history: [0.5, 0.9].map(|q| finite(errors.quantile(q))),
            peak: [0.5, 0.9].map(|q| finite(errors.peak_quantile(q))),
        }
    }
}

/// What springs err in a program.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProgramExpected {
    /// Median NRMSE by the step, whatever the springs: 13 p dt.
    pub floor: f64,
    /// By the sway before uplift; of a rigid body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stance: Option<f64>,
    /// By what a landing foot gives back; of a rigid body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rebound: Option<f64>,
    /// Measured in this run on synthetic motions; of an elastic structure on all that its springs
    /// are judged on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub synthetic: Option<ProgramErrors>,
    /// Measured in this run on earthquake-like motions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub earthquakes: Option<ProgramErrors>,
    /// Other settings of the program, measured where those asked for are of no use.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instead: Option<ProgramInstead>,
}

impl ProgramExpected {
    /// Histories that the program does not get through, and all that it was tried on.
    pub fn lost(&self) -> [usize; 2] {
        let all = [self.synthetic, self.earthquakes].into_iter().flatten();
        all.fold([0; 2], |[lost, all], errors| [lost + errors.lost, all + errors.histories])
    }
}

/// When an iteration at a step's end has arrived.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProgramTest {
    /// Unbalance over the structure's weight below this.
    UnbalanceOverWeight(f64),
    /// Change of place below this (m).
    IncrementM(f64),
}

/// Under each foot of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FootUnits {
    /// The vertical unit.
    pub vertical: ChainRow,
    /// The horizontal unit.
    pub horizontal: ChainRow,
    /// I_cg that the model must have (kg m2).
    pub rotational_inertia_kgm2: f64,
}

/// Under every corner of an elastic structure, from the left.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CornerUnits {
    /// Each.
    pub springs: Vec<CornerRow>,
}

/// Springs for a program with fixed time steps; units as in the springs above it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProgramRow<U> {
    /// Which: sap2000, etabs, opensees-even; none: any with this integrator.
    #[serde(rename = "for", skip_serializing_if = "Option::is_none")]
    pub name: Option<ProgramName>,
    /// Whether a user asked for it: then its springs are judged on motions that did not choose
    /// them.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub asked: bool,
    /// Its step (s).
    pub step_s: f64,
    /// Its integrator; in files as "hht:-0.333", "newmark:0.5:0.25", "trbdf2", "backward-euler".
    pub integrator: Integrator,
    /// A step that fails is halved, down to one in so many.
    pub substeps: usize,
    /// Newton's iterations of a step, at most.
    pub newton_iterations: usize,
    /// The test that ends them.
    pub converged: ProgramTest,
    /// The units.
    #[serde(flatten)]
    pub units: U,
    /// Whether they are stiffer than usual (stance 20 or 48 instead of at most 12), for their peaks
    /// on earthquake-like motions.
    #[serde(default)]
    pub stiffer_for_earthquakes: bool,
    /// What they err.
    pub expected: ProgramExpected,
    /// Whether no deck has its steps: of a structure with dampers or tendons.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub without_deck: bool,
    /// On the run's record, by an emulation of the program's steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on_record: Option<ProgramOnRecord>,
    /// Why the springs are of no use and what to do, if they are: as [`ProgramRow::not_to_be_used`]
    /// finds it, which is what counts in a file that is read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_to_be_used: Option<NotToBeUsed>,
}

impl<U> ProgramRow<U> {
    /// Of a program, how it steps, and the weight that its test of an unbalance is relative to (N).
    fn of(
        program: &FixedStepProgram,
        settings: &StepSettings,
        weight: f64,
        units: U,
        expected: ProgramExpected,
    ) -> Self {
        let Iteration { newton, test, .. } = settings.iteration;
        Self {
            name: program.name,
            asked: false,
            step_s: program.step,
            integrator: program.integrator,
            substeps: program.substeps,
            newton_iterations: newton,
            converged: match test {
                ConvergenceTest::Unbalance(below) => {
                    ProgramTest::UnbalanceOverWeight(below / weight)
                }
                ConvergenceTest::Increment(below) => ProgramTest::IncrementM(below),
            },
            units,
            stiffer_for_earthquakes: false,
            expected,
            without_deck: false,
            on_record: None,
            not_to_be_used: None,
        }
        .judged()
    }
}

impl From<&ProgramSprings> for ProgramRow<FootUnits> {
    fn from(of: &ProgramSprings) -> Self {
        let ProgramSprings { program, springs, expected, .. } = of;
        let m1 = springs.body.mass;
        let units = FootUnits {
            vertical: ChainRow::new(&springs.units.vertical, m1),
            horizontal: ChainRow::new(&springs.units.horizontal, m1),
            rotational_inertia_kgm2: springs.rotational_inertia(),
        };
        let expected = ProgramExpected {
            floor: expected.floor,
            stance: Some(expected.stance),
            rebound: Some(expected.rebound),
            synthetic: of.synthetic.as_ref().map(ProgramErrors::from),
            earthquakes: of.earthquakes.as_ref().map(ProgramErrors::from),
            instead: of.instead,
        };
        let row = Self::of(program, &of.settings(), m1 * GRAVITY, units, expected);
        Self { stiffer_for_earthquakes: of.stiffer, ..row }
    }
}

impl ProgramRow<CornerUnits> {
    /// Of an elastic structure whose corners stand at these places (m).
    #[doc(hidden)]
    pub fn of_corners(
        of: &ElasticProgramSprings,
        mass: f64,
        places: impl Iterator<Item = f64>,
    ) -> Self {
        let corners = &of.springs.corners;
        let row = |(x_m, springs): (f64, &Springs<Chain>)| CornerRow {
            x_m,
            vertical: (&springs.vertical).into(),
            horizontal: (&springs.horizontal).into(),
        };
        let units = CornerUnits { springs: places.zip(corners).map(row).collect() };
        let expected = ProgramExpected {
            floor: of.floor,
            stance: None,
            rebound: None,
            synthetic: of.measured.as_ref().map(ProgramErrors::from),
            earthquakes: None,
            instead: of.instead,
        };
        Self::of(&of.program, &of.settings, mass * GRAVITY, units, expected)
    }
}

impl<U> ProgramRow<U> {
    /// Whether a program can step so; `path` names the file in messages.
    ///
    /// # Errors
    /// A step, an integrator of that program, a number of substeps that cannot be.
    pub(crate) fn check(&self, path: &str) -> Result<(), ParametersError> {
        let section = ProgramSection {
            name: self.name.map(Into::into),
            step_s: Some(self.step_s),
            integrator: Some(self.integrator.into()),
            substeps: Some(self.substeps),
        };
        let mistake = |(key, value, remedy)| ParametersError::Program {
            path: path.to_string(),
            key,
            value,
            remedy,
        };
        section.checked().map(|_| ()).map_err(mistake)
    }

    /// The program in words.
    pub fn program(&self) -> String {
        self.name.map_or("a program", ProgramName::words).into()
    }

    /// Whether it is SAP2000 or ETABS.
    #[doc(hidden)]
    pub fn is_csi(&self) -> bool {
        matches!(self.name, Some(ProgramName::Sap2000 | ProgramName::Etabs))
    }

    /// Whether it is ETABS, which reads no tables of SAP2000's.
    #[doc(hidden)]
    pub fn is_etabs(&self) -> bool {
        self.name == Some(ProgramName::Etabs)
    }

    /// Whether its springs come in decks for OpenSees: of OpenSees itself, and of a program that
    /// is known by its integrator alone, if OpenSees has that.
    #[doc(hidden)]
    pub fn in_opensees(&self) -> bool {
        !self.is_csi() && ProgramName::OpenSees.has(self.integrator)
    }

    /// Whether its springs come in SAP2000's tables.
    #[doc(hidden)]
    pub fn in_sap2000(&self) -> bool {
        self.name == Some(ProgramName::Sap2000)
    }
}

impl CornerUnits {
    /// The springs.
    pub fn chains(&self) -> Vec<Springs<Chain>> {
        self.springs.iter().map(CornerRow::chains).collect()
    }
}

impl FootUnits {
    /// The structure as a model for the program must have it: with that rotational inertia.
    pub fn structure(&self, structure: &Structure) -> Structure {
        Structure { rotational_inertia_kgm2: self.rotational_inertia_kgm2, ..*structure }
    }
}

#[cfg(test)]
mod tests;
