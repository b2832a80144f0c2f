//! Case files: what to tune, on what, within which bounds. TOML; every key has its unit in its
//! name.
//!
//! ```toml
//! [structure]
//! kind = "aframe"            # or "block"
//! # of the centre of mass above the feet; a block also total_height_m; also _ft, _in
//! height_m = 61.0
//! width_m = 12.2             # between the feet; also _ft, _in
//! mass_kg = 680.1e3          # also mass_t, mass_lb, weight_kn, weight_kip, weight_lb
//!
//! [damper]                   # also [tendon] stiffness_n_per_m, pretension_n
//! c_ns_per_m = 1e6           # and [friction] coefficient
//!
//! [record]                   # left out: El Centro 1940 NS
//! file = "motion.at2"        # relative to the case file
//! vertical = "auto"          # the file's vertical component, or another file's; left out: none
//! scale = 1.0
//! duration_s = 20.0          # left out: all of it
//!
//! [tuning]
//! objective = "landing"      # or "arr", the paper's
//! accuracy = 0.002           # of the history against Housner's, NRMSE
//! # peaks = 0.02             # instead: of the largest displacement, uplift and forces
//!
//! [program]                  # springs for a program with fixed time steps: see `program`
//! for = "sap2000"
//! step_s = 0.001
//! ```

pub mod assumptions;
pub mod doubts;
mod elastic;
mod error;
mod limits;
mod located;
mod missing;
mod plain_words;
pub mod program;
mod record;
mod structure;
mod unknown_key;
mod yardstick;

use std::path::Path;

use serde::{Deserialize, Serialize};

pub use elastic::ElasticCase;
pub use error::CaseError;
pub use error::parse_error;
pub use error::text_of;
use fixed_steps::FixedStepProgram;
use frequency_response::{bounds::Bounds, target::Target};
pub use limits::Limits;
pub use limits::{ACCURACY, MAX_HZ, PEAKS};
pub use located::in_keys;
use program::ProgramSection;
pub use record::NO_MOTION;
use record::RecordSection;
use rocking::{
    members::{Damper, Friction, Members, Tendon},
    structure::Structure,
};
use strong_motion::{Notice, ReadOptions, Record, RecordError, Recording, excitation::Excitation};
pub use structure::{GivenKeys, StructureSection};
pub use yardstick::{Asked, Yardstick};

/// What the springs' inner design follows from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Objective {
    /// The paper's procedure: the frequency response's shape.
    Arr,
    /// The landing of the structure, by its geometry.
    #[default]
    Landing,
}

/// The outer loop's settings.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tuning {
    /// What the inner design follows from.
    pub objective: Objective,
    /// Error of the history against Housner's that Omega_n is chosen for, NRMSE; not used where
    /// `peaks` is given.
    pub accuracy: f64,
    /// Relative error of the largest displacement, uplift and forces that Omega_n is chosen for in
    /// place of `accuracy`. A case file gives one of the two.
    pub peaks: Option<f64>,
    /// Stiffest springs allowed, Omega_n/2 pi (Hz); none unless given.
    pub max_omega_hz: Option<f64>,
    /// Largest settlement of the standing body (m); it bounds Omega_n from below.
    pub max_settlement_m: f64,
    /// Mass ratios mu = m2/m1 tried for the vertical chain of the paper's procedure.
    pub mass_ratios_vertical: Vec<f64>,
    /// Mass ratios mu = m2/m1 tried for the horizontal chain of the paper's procedure.
    pub mass_ratios_horizontal: Vec<f64>,
    /// Candidates that the paper's procedure samples before refining.
    pub candidates: usize,
}

impl Default for Tuning {
    fn default() -> Self {
        Self {
            objective: Objective::Landing,
            accuracy: 0.002,
            peaks: None,
            max_omega_hz: None,
            max_settlement_m: 0.01,
            mass_ratios_vertical: vec![0.1, 0.3, 1.0, 2.0, 10.0],
            mass_ratios_horizontal: vec![0.1, 1.0, 10.0],
            candidates: 256,
        }
    }
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CaseFile {
    structure: StructureSection,
    /// Members that are simulated after tuning, with the springs of the rigid body.
    damper: Option<Damper>,
    tendon: Option<Tendon>,
    friction: Option<Friction>,
    #[serde(default)]
    record: RecordSection,
    #[serde(default)]
    tuning: Tuning,
    program: Option<ProgramSection>,
    target: Option<Target>,
    #[serde(default)]
    bounds: Bounds,
}

/// A checked case, its record read.
#[derive(Clone, Debug)]
pub struct Case {
    /// The body.
    pub structure: Structure,
    /// Velocity restitution e.
    pub restitution: f64,
    /// Which of its numbers the case file gave, and which were taken for it.
    pub given: GivenKeys,
    /// Dampers, a tendon, friction: not tuned for, but simulated with the tuned springs.
    pub members: Members,
    /// The record as read, its scale, the length asked for: what `record` and `duration_s` come
    /// from.
    pub excitation: Excitation,
    /// The whole record, scaled.
    pub record: Record,
    /// What the reader of the record says of it.
    pub notices: Vec<Notice>,
    /// Length to compare over (s).
    pub duration_s: f64,
    /// The outer loop's settings.
    pub tuning: Tuning,
    /// A program with fixed time steps that springs are asked for besides: they are the `program`
    /// of what is tuned. There are none of a body with members, none beside springs that bounce for
    /// another restitution, and none of a step or an integrator that cannot be. None: for SAP2000
    /// at 1 ms.
    pub program: Option<FixedStepProgram>,
    /// The frequency response wanted by the paper's procedure.
    pub target: Target,
    /// The range of its parameters.
    pub bounds: Bounds,
}

/// No record is longer (s).
pub const LONGEST_S: f64 = 1e6;

/// The paper's case, embedded.
pub(crate) const PAPER: &str = include_str!("../../../tuning/paper.toml");

impl Case {
    /// The paper's case: its A-frame on El Centro.
    ///
    /// # Errors
    /// None: the case is part of the program, and a test reads it.
    pub fn paper() -> Result<Self, CaseError> {
        Self::parse("tuning/paper.toml", PAPER)
    }

    /// Read a case file and the record it names.
    ///
    /// # Errors
    /// A file that cannot be read or is no case: a ground motion, JSON; as [`Self::parse`].
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        Self::read_asking(path, &ReadOptions::default())
    }

    /// Read a case file and the record it names; what is asked of the record here goes before what
    /// the case says of it.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_asking(path: &Path, asked: &ReadOptions) -> Result<Self, CaseError> {
        Self::parse_asking(&path.display().to_string(), &text_of(path)?, asked)
    }

    /// Parse a case file's text and read the record it names; `path` names the case in messages and
    /// is where its record's path starts.
    ///
    /// # Errors
    /// No TOML, a key missing or not known, a number that cannot be; an elastic structure; a record
    /// that cannot be read, as [`Record::read`]; a peak above 50 g.
    pub fn parse(path: &str, text: &str) -> Result<Self, CaseError> {
        Self::parse_asking(path, text, &ReadOptions::default())
    }

    /// Parse a case file's text and read the record it names; what is asked of the record here goes
    /// before what the case says of it.
    ///
    /// # Errors
    /// As [`Self::parse`].
    pub fn parse_asking(path: &str, text: &str, asked: &ReadOptions) -> Result<Self, CaseError> {
        let mut notices = Vec::new();
        let case = parse_with(path, text, asked, |file, options| {
            let recording = Recording::read(file, options)?;
            notices = recording.notices();
            Ok(recording.into_record())
        })?;
        Ok(Self { notices, ..case })
    }

    /// A structure without members and its restitution, velocity after an impact over that before,
    /// under a ground motion; `name` stands for the case file in messages.
    ///
    /// # Errors
    /// A setting of `tuning` out of its range; a scale that is not finite, or takes the peak above
    /// 50 g.
    pub fn new(
        name: &str,
        (structure, restitution): (Structure, f64),
        excitation: Excitation,
        tuning: Tuning,
    ) -> Result<Self, CaseError> {
        tuning.check(name)?;
        Ok(Self {
            structure,
            restitution,
            given: GivenKeys::default(),
            members: Members::default(),
            record: excitation.scaled()?,
            notices: Vec::new(),
            duration_s: excitation.duration(),
            excitation,
            tuning,
            program: None,
            target: Target::default(),
            bounds: Bounds::default(),
        })
    }
}

impl Case {
    /// A structure on the whole of a record, everything else by default: restitution by equation 2,
    /// an accuracy of 0.002, no members.
    ///
    /// # Errors
    /// A peak above 50 g.
    pub fn of(structure: Structure, record: Record) -> Result<Self, CaseError> {
        let restitution = structure.body::<f64>().restitution();
        Self::new("case", (structure, restitution), Excitation::whole(record), Tuning::default())
    }

    /// The case under another ground motion.
    ///
    /// # Errors
    /// A scale that is not finite, or takes the peak above 50 g.
    pub fn set_excitation(&mut self, excitation: Excitation) -> Result<(), RecordError> {
        self.record = excitation.scaled()?;
        self.duration_s = excitation.duration();
        self.excitation = excitation;
        Ok(())
    }
}

/// [`Case::parse_asking`], the record it names read by `read`.
pub fn parse_with(
    path: &str,
    text: &str,
    asked: &ReadOptions,
    read: impl FnOnce(&Path, &ReadOptions) -> Result<Record, RecordError>,
) -> Result<Case, CaseError> {
    of_text(path, text, asked, read).map_err(|error| error.located(path, text, asked))
}

fn of_text(
    path: &str,
    text: &str,
    asked: &ReadOptions,
    read: impl FnOnce(&Path, &ReadOptions) -> Result<Record, RecordError>,
) -> Result<Case, CaseError> {
    ElasticCase::refuse(path, text)?;
    let file: CaseFile = toml::from_str(text).map_err(|e| error::case_error(path, text, &e))?;
    missing::none(path, text)?;
    yardstick::one_of_two(path, text)?;
    let (structure, restitution) = file.structure.checked(path)?;
    let given = file.structure.given();
    let members = Members { damper: file.damper, tendon: file.tendon, friction: file.friction }
        .checked(&structure.body())
        .map_err(|source| CaseError::Members { path: path.into(), source })?;
    let excitation = file.record.excitation(path, asked, read)?;
    let case = Case::new(path, (structure, restitution), excitation, file.tuning)?;
    let (program, target) =
        (ProgramSection::of_case(file.program.as_ref(), path)?, file.target.unwrap_or_default());
    Ok(Case { given, members, program, target, bounds: file.bounds, ..case })
}

impl Tuning {
    /// What Omega_n is chosen for.
    #[doc(hidden)]
    pub fn asked(&self) -> Asked {
        Asked::new(self.accuracy, self.peaks)
    }

    fn check(&self, path: &str) -> Result<(), CaseError> {
        let value = |key, value: f64, remedy| CaseError::Value {
            path: path.into(),
            key,
            value: format!("{value:?}"),
            remedy,
        };
        check_stiffness(path, self.accuracy, self.peaks, self.max_omega_hz)?;
        if self.max_settlement_m.is_nan() || self.max_settlement_m <= 0.0 {
            return Err(value(
                "tuning.max_settlement_m",
                self.max_settlement_m,
                "give metres greater than zero",
            ));
        }
        if !(1..=1_000_000).contains(&self.candidates) {
            return Err(value(
                "tuning.candidates",
                self.candidates as f64,
                "give a number from 1 to 1000000",
            ));
        }
        for (key, list) in [
            ("tuning.mass_ratios_vertical", &self.mass_ratios_vertical),
            ("tuning.mass_ratios_horizontal", &self.mass_ratios_horizontal),
        ] {
            if list.is_empty() {
                return Err(value(key, 0.0, "give at least one mass ratio"));
            }
            if let Some(&mu) = list.iter().find(|mu| !(1e-3..=1e3).contains(*mu)) {
                return Err(value(key, mu, "give mass ratios between 0.001 and 1000"));
            }
        }
        Ok(())
    }
}

/// What every tuning is asked for.
fn check_stiffness(
    path: &str,
    accuracy: f64,
    peaks: Option<f64>,
    max_omega_hz: Option<f64>,
) -> Result<(), CaseError> {
    let asked = [
        ("tuning.max_omega_hz", max_omega_hz, MAX_HZ),
        ("tuning.accuracy", Some(accuracy), ACCURACY),
        ("tuning.peaks", peaks, PEAKS),
    ];
    for (key, value, limits) in asked {
        let checked = value.map_or(Ok(0.0), |value| limits.check(value));
        checked.map_err(|(value, remedy)| CaseError::Value {
            path: path.into(),
            key,
            value,
            remedy,
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
