//! Springs for a program with fixed time steps, as parameters.json holds them.

use serde::{Deserialize, Serialize};

use super::elastic::CornerRow;
use crate::tuning::{elastic::program::ElasticProgramSprings, fixed_steps::ProgramSprings};
use dynamics::spring::{Chain, ChainRow, Springs};
use files::message::percent;
use fixed_steps::{FixedStepProgram, Integrator, ProgramName, measured::ErrorsOverMotions};
use rocking::structure::Structure;

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
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stance: Option<f64>,
    /// By what a landing foot gives back; of a rigid body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rebound: Option<f64>,
    /// Measured in this run on synthetic motions; of an elastic structure on all that its springs
    /// are judged on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub synthetic: Option<ProgramErrors>,
    /// Measured in this run on earthquake-like motions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub earthquakes: Option<ProgramErrors>,
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
    #[serde(rename = "for", default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its step (s).
    pub step_s: f64,
    /// Its integrator, as `--integrator` takes it.
    pub integrator: String,
    /// A step that fails is halved, down to one in so many.
    pub substeps: usize,
    /// Newton's iterations of a step, at most.
    pub newton_iterations: usize,
    /// When they have arrived.
    pub converged: ProgramTest,
    /// The units.
    #[serde(flatten)]
    pub units: U,
    /// Whether they have twice the usual Omega_n, for their peaks on earthquake-like motions.
    #[serde(default)]
    pub stiffer_for_earthquakes: bool,
    /// What they err.
    pub expected: ProgramExpected,
    /// On the run's record, by an emulation of the program's steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on_record: Option<ProgramOnRecord>,
}

/// What an emulation of a program finds on a record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProgramOnRecord {
    /// Its largest top displacement over that of the reference, less one; none where one of them
    /// falls or ends before the record.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub top: Option<f64>,
    /// When it gives up, if it does (s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gives_up_s: Option<f64>,
}

/// Below this a displacement is rounding (m).
const ROUNDING_M: f64 = 1e-12;

impl ProgramOnRecord {
    /// From the largest top displacements of a history and of the reference, where both stand.
    pub fn of(tops: Option<[f64; 2]>, gives_up_s: Option<f64>) -> Self {
        let top = tops.filter(|[_, reference]| *reference > ROUNDING_M && gives_up_s.is_none());
        Self { top: top.map(|[found, reference]| found / reference - 1.0), gives_up_s }
    }
}

impl<U> ProgramRow<U> {
    /// Of a program, the stiffest vertical k1 (N/m) and the mass (kg).
    fn of(
        program: &FixedStepProgram,
        (k1, mass): (f64, f64),
        units: U,
        expected: ProgramExpected,
    ) -> Self {
        let tolerance = program.tolerance(k1, mass);
        Self {
            name: program.name.map(|name| name.key().into()),
            step_s: program.step,
            integrator: program.integrator.to_string(),
            substeps: program.substeps,
            newton_iterations: program.settings(k1, mass).iteration.newton,
            converged: match program.tests_unbalance() {
                true => ProgramTest::UnbalanceOverWeight(tolerance),
                false => ProgramTest::IncrementM(tolerance),
            },
            units,
            stiffer_for_earthquakes: false,
            expected,
            on_record: None,
        }
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
        };
        let row = Self::of(program, (springs.chains().vertical.k1, m1), units, expected);
        Self { stiffer_for_earthquakes: of.stiffer, ..row }
    }
}

impl ProgramRow<CornerUnits> {
    /// Of an elastic structure whose corners stand at these places (m).
    pub fn of_corners(
        of: &ElasticProgramSprings,
        mass: f64,
        places: impl Iterator<Item = f64>,
    ) -> Self {
        let corners = &of.springs.corners;
        let k1 = corners.iter().map(|corner| corner.vertical.k1).fold(0.0, f64::max);
        let row = |(x_m, springs): (f64, &Springs<Chain<f64>>)| CornerRow {
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
        };
        Self::of(&of.program, (k1, mass), units, expected)
    }
}

/// Median error of the largest displacement above which springs are of no use.
const USELESS: f64 = 0.2;

/// Why springs are not to be used in a program, in words with what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotToBeUsed {
    /// It gets through less than half of its motions.
    Lost { lost: usize, motions: usize },
    /// The largest displacement errs by so much in the median.
    Errs { median: f64 },
}

impl std::fmt::Display for NotToBeUsed {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Lost { lost, motions } => {
                write!(f, "NOT to be used: fails on {lost} of {motions} motions")?;
            }
            Self::Errs { median } => {
                write!(f, "NOT to be used: peaks err by {} in the median", percent(*median))?;
            }
        }
        write!(f, "; try another --step, longer ones too")
    }
}

impl<U> ProgramRow<U> {
    /// The program in words.
    pub fn program(&self) -> String {
        self.known().map_or_else(|| "a program".into(), |name| name.words().into())
    }

    /// Whether it is SAP2000 or ETABS.
    pub fn is_csi(&self) -> bool {
        matches!(self.known(), Some(ProgramName::Sap2000 | ProgramName::Etabs))
    }

    /// Whether it is OpenSees with steps of one size.
    pub fn is_opensees_even(&self) -> bool {
        matches!(self.known(), Some(ProgramName::OpenSees))
    }

    /// Synthetic motions, else those like earthquakes: what decides on whether springs are of use.
    fn measured(&self) -> Option<ProgramErrors> {
        self.expected.synthetic.or(self.expected.earthquakes)
    }

    /// Whether the springs are of no use, and why.
    pub fn not_to_be_used(&self) -> Option<NotToBeUsed> {
        let errors = self.measured()?;
        let (lost, motions) = (errors.lost, errors.histories);
        match errors.peak[0] {
            None => Some(NotToBeUsed::Lost { lost, motions }),
            Some(median) => (median > USELESS).then_some(NotToBeUsed::Errs { median }),
        }
    }

    fn known(&self) -> Option<ProgramName> {
        self.name.as_deref()?.parse().ok()
    }

    /// Its integrator in words: "HHT alpha -1/3".
    pub fn integrator_words(&self) -> String {
        match self.integrator.parse::<Integrator>() {
            Ok(Integrator::Hht { alpha }) if (alpha + 1.0 / 3.0).abs() < 1e-9 => {
                "HHT alpha -1/3".into()
            }
            Ok(Integrator::Hht { alpha }) => format!("HHT alpha {alpha}"),
            Ok(Integrator::Newmark { gamma, beta }) => {
                format!("Newmark gamma {gamma}, beta {beta}")
            }
            Ok(Integrator::GeneralizedAlpha { rho_inf }) => {
                format!("generalized alpha, rho_inf {rho_inf}")
            }
            Ok(Integrator::Trbdf2) => "TRBDF2".into(),
            Ok(Integrator::BackwardEuler) => "BackwardEuler".into(),
            Err(_) => self.integrator.clone(),
        }
    }
}

impl CornerUnits {
    /// The springs.
    pub fn chains(&self) -> Vec<Springs<Chain<f64>>> {
        self.springs.iter().map(CornerRow::chains).collect()
    }
}

impl FootUnits {
    /// The structure as a model for the program must have it.
    pub fn structure(&self, structure: &Structure) -> Structure {
        Structure { rotational_inertia_kgm2: self.rotational_inertia_kgm2, ..*structure }
    }
}
