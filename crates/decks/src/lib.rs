//! Decks: the tuned springs in the engineer's own program.
//!
//! | format | what it is |
//! |---|---|
//! | [`DeckFormat::OpenSeesPy`] | one Python file for `openseespy` that builds, runs and checks itself |
//! | [`DeckFormat::OpenSeesTcl`] | the same for OpenSees' Tcl interpreter |
//! | [`DeckFormat::Sap2000`] | .s2k text tables for File > Import > SAP2000 .s2k Text File |
//! | [`DeckFormat::Sap2000Sheet`] | the same model as a sheet to type into SAP2000 or ETABS |
//! | [`DeckFormat::Csv`], [`DeckFormat::Markdown`] | k1, k2, m2, c per foot and direction, for everyone else |
//!
//! Numbers are written with 17 significant digits, so that a deck holds exactly what was tuned. SI
//! units, except in SAP2000 where the tables say KN, m.

#![warn(missing_docs)]

mod beside;
mod corner_program;
mod elastic;
mod error;
mod even_ends;
mod expectation;
mod language;
mod model;
mod opensees;
mod output;
mod plain;
mod sap2000;
mod step_count;
mod stepped_model;
mod stepping;
mod typed;
pub mod verify;

pub use corner_program::{CornerHistory, CornerProgram};
use dynamics::fem::History;
pub use elastic::ElasticDeck;
pub use error::ExportError;
pub use even_ends::EvenEnds;
pub use expectation::{DeckExpectation, foretold_rigid};
use files::message::significant;
use fixed_steps::MemberDamping;
use frames::frame::FALLEN;
use model::DeckModel;
pub use model::{ACCURACY, with_inertia};
pub use output::OutputSteps;
use parameters::{
    Parameters,
    predictability::{simulate, width_sensitivity},
};
use rocking::{members::Members, motion::Motion};
pub use sap2000::sap_function;
pub use step_count::deck_steps;
pub use stepped_model::{SteppedModel, stepped_model};
pub use stepping::{SteppedDeck, Stepping, even_deck, samples_to, stepped_deck, stepped_history};
use strong_motion::Record;

/// The stepping routine of decks for openseespy: `class Steps`, in need of `math`, `sys` and `ops`.
pub const STEPS: &str = include_str!("steps.py");

/// What to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeckFormat {
    /// Python for openseespy.
    OpenSeesPy,
    /// Tcl for OpenSees.
    OpenSeesTcl,
    /// SAP2000 text tables.
    Sap2000,
    /// The model of the SAP2000 text tables as a sheet, to type into SAP2000 or ETABS.
    Sap2000Sheet,
    /// k1, k2, m2, c as CSV.
    Csv,
    /// k1, k2, m2, c as a Markdown table.
    Markdown,
}

impl DeckFormat {
    /// Every format.
    pub(crate) const ALL: [Self; 6] = [
        Self::OpenSeesPy,
        Self::OpenSeesTcl,
        Self::Sap2000,
        Self::Sap2000Sheet,
        Self::Csv,
        Self::Markdown,
    ];

    /// Whether it is for SAP2000.
    #[doc(hidden)]
    pub fn is_sap2000(self) -> bool {
        matches!(self, Self::Sap2000 | Self::Sap2000Sheet)
    }

    /// Whether someone types a model from it.
    pub(crate) fn is_typed(self) -> bool {
        matches!(self, Self::Sap2000Sheet | Self::Markdown)
    }

    /// What dashpots of members resist in the program that it is for.
    pub(crate) fn member_damping(self) -> MemberDamping {
        if self.is_sap2000() { MemberDamping::OfVelocities } else { MemberDamping::OfChanges }
    }

    /// Its name on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::OpenSeesPy => "openseespy",
            Self::OpenSeesTcl => "opensees-tcl",
            Self::Sap2000 => "sap2000",
            Self::Sap2000Sheet => "sap2000-sheet",
            Self::Csv => "csv",
            Self::Markdown => "markdown",
        }
    }

    /// The ending of its file, without the dot.
    pub(crate) fn ending(self) -> &'static str {
        match self {
            Self::OpenSeesPy => "py",
            Self::OpenSeesTcl => "tcl",
            Self::Sap2000 => "s2k",
            Self::Sap2000Sheet => "txt",
            Self::Csv => "csv",
            Self::Markdown => "md",
        }
    }
}

impl std::str::FromStr for DeckFormat {
    type Err = ExportError;

    fn from_str(name: &str) -> Result<Self, ExportError> {
        Self::ALL.into_iter().find(|f| f.name() == name).ok_or_else(|| ExportError::DeckFormat {
            name: printable(name),
            known: Self::ALL.map(Self::name).join(", "),
        })
    }
}

/// Relative tolerance of an iteration above which one suspects a misprint.
pub const LARGE_TOLERANCE: f64 = 0.01;

/// Samples of a rotation (rad) up to the one at which a body has fallen over, where a deck's
/// history ends; all if it has not.
pub fn samples_to_fall(theta: &[f64]) -> usize {
    theta.iter().position(|theta| theta.abs() >= FALLEN).map_or(theta.len(), |i| i + 1)
}

/// What the deck must find when it runs: taken from our own history, checked by the deck itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// Number of samples followed, the one at t = 0 included.
    pub samples: usize,
    /// How many of these samples are compared: those up to the time to which the motion can be
    /// predicted.
    pub compared: usize,
    /// Z of the centre of mass, standing settled (negative: the settlement) (m).
    pub settled: f64,
    /// Largest and least u (m).
    pub u: (f64, f64),
    /// Largest and least v, from the settled position (m).
    pub v: (f64, f64),
    /// NRMSE of u caused by a relative change of the width by 1e-5: the larger, the finer the
    /// deck's steps.
    pub width_sensitivity: f64,
    /// Accuracy asked of the deck, as a normalised error of its history: its steps follow from it.
    pub accuracy: f64,
}

impl Expected {
    /// From a history that began settled, and its width sensitivity; at the accuracy [`ACCURACY`].
    pub fn new(history: &History, width_sensitivity: f64) -> Self {
        Self::within(history, width_sensitivity, history.motion.len())
    }

    /// The same, compared up to when the motion can be predicted, `until` (s), if not to its end;
    /// dt in s.
    pub fn foretold(
        history: &History,
        width_sensitivity: f64,
        dt: f64,
        until: Option<f64>,
    ) -> Self {
        let samples = history.motion.len();
        let compared = samples_to(until, dt, samples);
        let History { motion, initial_z, .. } = history;
        Self::of_motion(motion, [samples, compared], *initial_z, width_sensitivity)
    }

    /// The same of so many of its samples.
    pub(crate) fn within(history: &History, width_sensitivity: f64, samples: usize) -> Self {
        Self::of_motion(&history.motion, [samples; 2], history.initial_z, width_sensitivity)
    }

    /// The same of a motion from where it stands settled (m): samples followed, and compared. It
    /// ends where the body has fallen over: another program's would fall through the ground next, a
    /// little sooner or later than ours.
    pub(crate) fn of_motion(
        motion: &Motion,
        [samples, compared]: [usize; 2],
        settled: f64,
        width_sensitivity: f64,
    ) -> Self {
        let samples = samples.min(samples_to_fall(&motion.theta));
        let compared = compared.min(samples);
        let range = |x: &[f64]| {
            x[..compared]
                .iter()
                .fold((0.0, 0.0), |(max, min): (f64, f64), &x| (max.max(x), min.min(x)))
        };
        Self {
            samples,
            compared,
            settled,
            u: range(&motion.u),
            v: range(&motion.v),
            width_sensitivity,
            accuracy: ACCURACY,
        }
    }

    /// The same at another accuracy.
    pub(crate) fn with_accuracy(self, accuracy: f64) -> Self {
        Self { accuracy, ..self }
    }
}

/// The text of a deck of these springs on a record, with our own history to check itself against. A
/// body without rotational inertia gets the least that other programs need (1e-5 m R^2).
///
/// Its steps follow touches, on the springs `vertical` and `horizontal`. A deck for steps of one
/// size, as SAP2000 and ETABS take them, is [`stepped_deck`].
///
/// # Errors
/// A member that the format does not have; numbers that are not finite; the two formats of SAP2000,
/// always: [`ExportError::EventsInTables`].
pub fn deck(
    parameters: &Parameters,
    record: &Record,
    format: DeckFormat,
) -> Result<String, ExportError> {
    deck_of(parameters, record, format, ACCURACY, None)
}

/// The same; an OpenSees deck's steps for this accuracy of its history, a normalised error. It
/// compares its history up to when the motion can be predicted, `until` (s), if not to its end.
pub fn deck_of(
    parameters: &Parameters,
    record: &Record,
    format: DeckFormat,
    accuracy: f64,
    until: Option<f64>,
) -> Result<String, ExportError> {
    let parameters = &Parameters {
        structure: with_inertia(&parameters.structure, &parameters.members()),
        ..parameters.clone()
    };
    let history = simulate(parameters, record);
    let width_sensitivity = width_sensitivity(&history.motion, parameters, record);
    let expected = Expected::foretold(&history, width_sensitivity, record.dt, until);
    export(parameters, record, &expected.with_accuracy(accuracy), format)
}

/// The text of a deck: the model of `parameters` on `record` for another program.
///
/// # Errors
/// Numbers that are not finite; a history longer than the record.
pub fn export(
    parameters: &Parameters,
    record: &Record,
    expected: &Expected,
    format: DeckFormat,
) -> Result<String, ExportError> {
    export_model(&DeckModel::new(parameters, record, expected)?, format)
}

/// The text of a deck.
fn export_model(model: &DeckModel, format: DeckFormat) -> Result<String, ExportError> {
    if let Some(name) = member(&model.members).filter(|_| format.is_sap2000()) {
        return Err(ExportError::Member { name, format: format.name() });
    }
    Ok(match format {
        DeckFormat::OpenSeesPy => opensees::python(model)?,
        DeckFormat::OpenSeesTcl => opensees::tcl(model)?,
        DeckFormat::Sap2000 => sap2000::tables(&sap2000::SapModel::rigid(model)?),
        DeckFormat::Sap2000Sheet => sap2000::sheet(&sap2000::SapModel::rigid(model)?),
        DeckFormat::Csv => plain::csv(model.even.as_ref(), &model.places()),
        DeckFormat::Markdown => {
            let inertia = significant(model.inertia, 4);
            let title = format!("{}; the model's I_cg = {inertia} kg m2", model.title());
            let text = plain::markdown(&title, model.even.as_ref(), &model.places());
            match model.even {
                Some(_) => text + &typed::words(&sap2000::SapModel::rigid(model)?, &model.places()),
                None => text,
            }
        }
    })
}

/// The first of a structure's members, by name.
fn member(members: &Members) -> Option<&'static str> {
    let Members { damper, tendon, friction } = members;
    let all = [friction.map(|_| "friction"), damper.map(|_| "damper"), tendon.map(|_| "tendon")];
    all.into_iter().flatten().next()
}

/// A name that is harmless inside a comment or a string of any of the programs.
fn printable(name: &str) -> String {
    name.chars()
        .map(|c| if c.is_ascii_alphanumeric() || " ._-+".contains(c) { c } else { '_' })
        .collect()
}

/// A title: names with commas between.
fn printable_title(title: &str) -> String {
    title.split(',').map(printable).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests;
