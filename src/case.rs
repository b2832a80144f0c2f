//! Case files: what to tune, on what, within which bounds. TOML; every key has its unit in its name.
//!
//! ```toml
//! [structure]
//! kind = "aframe"            # or "block"
//! height_m = 61.0            # of the centre of mass above the feet; a block also total_height_m; also _ft, _in
//! width_m = 12.2             # between the feet; also _ft, _in
//! mass_kg = 680.1e3          # also mass_t, mass_lb, weight_kn, weight_kip, weight_lb
//!
//! [damper]                   # also [tendon] stiffness_n_per_m, pretension_n; [friction] coefficient
//! c_ns_per_m = 1e6
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
//! ```

#[cfg(feature = "cli")]
mod elastic;
mod limits;
mod structure;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::{
    excitation::Excitation,
    members::{Damper, Friction, Members, MembersError, NO_LEGS, Tendon, names_legs},
    message::one_line,
    record::{Notice, ReadOptions, Record, RecordError, Recording, Units, VerticalFrom},
    response::{bounds::Bounds, target::Target},
    structure::{Structure, StructureError},
};
#[cfg(feature = "cli")]
pub use elastic::ElasticCase;
#[cfg(feature = "cli")]
pub use limits::Limits;
pub use limits::{ACCURACY, MAX_HZ};
pub use structure::StructureSection;

/// What is wrong with a case file, and what to do.
#[derive(Debug, Error)]
#[non_exhaustive]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum CaseError {
    #[error("{path}: cannot be read ({source}); check the name of the case file")]
    Read { path: String, source: std::io::Error },
    #[error("{path}, line {line}: {message}")]
    Parse { path: String, line: usize, message: String },
    #[error("{path}: {source}")]
    Structure { path: String, source: StructureError },
    #[cfg(feature = "cli")]
    #[error("{path}: {source}")]
    Elastic { path: String, source: crate::elastic::structure::ElasticError },
    #[cfg(feature = "cli")]
    #[error(
        "{path}: this is an elastic structure, which `tune run` alone takes; give a rigid body here: kind = \"aframe\" or \"block\""
    )]
    OfElastic { path: String },
    #[error("{path}: {source}")]
    Members { path: String, source: MembersError },
    #[error("{path}: {key} is {value}; {remedy}")]
    Value { path: String, key: &'static str, value: String, remedy: &'static str },
    #[error(
        "{path}: record.file is not given; record.dt_s, units, component, baseline and vertical tell of a file: name it, or leave them out"
    )]
    NoFile { path: String },
    #[error(transparent)]
    Record(#[from] RecordError),
}

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

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct RecordSection {
    /// Relative to the case file; the embedded El Centro record unless given.
    file: Option<PathBuf>,
    /// Time step (s), where the file does not say.
    dt_s: Option<f64>,
    /// "g", "m/s2", "cm/s2" or "mm/s2", where the file does not say.
    units: Option<Units>,
    /// Component by name or azimuth, where the file has several; the stronger horizontal one unless given.
    component: Option<String>,
    /// Subtract the mean of the samples.
    baseline: bool,
    /// "auto", the vertical component of the same file, or the file of one, relative to the case file; none unless given.
    vertical: Option<VerticalFrom>,
    /// Factor on the acceleration; 1 unless given.
    scale: Option<f64>,
    /// Length to compare over (s); the whole record unless given.
    duration_s: Option<f64>,
}

/// The outer loop's settings.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tuning {
    /// What the inner design follows from.
    pub objective: Objective,
    /// Error of the history against Housner's that Omega_n is chosen for, NRMSE.
    pub accuracy: f64,
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
    damper: Option<Damper<f64>>,
    tendon: Option<Tendon<f64>>,
    friction: Option<Friction<f64>>,
    #[serde(default)]
    record: RecordSection,
    #[serde(default)]
    tuning: Tuning,
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
    /// Dampers, a tendon, friction: not tuned for, but simulated with the tuned springs.
    pub members: Members<f64>,
    /// The record as read, its scale, the length asked for: what `record` and `duration_s` come from.
    pub excitation: Excitation,
    /// The whole record, scaled.
    pub record: Record,
    /// What the reader of the record says of it.
    pub notices: Vec<Notice>,
    /// Length to compare over (s).
    pub duration_s: f64,
    /// The outer loop's settings.
    pub tuning: Tuning,
    /// The frequency response wanted by the paper's procedure.
    pub target: Target,
    /// The range of its parameters.
    pub bounds: Bounds,
}

/// No record is longer (s).
pub const LONGEST_S: f64 = 1e6;

/// The paper's case, embedded.
pub const PAPER: &str = include_str!("../tuning/paper.toml");

impl Case {
    /// The paper's case: its A-frame on El Centro.
    pub fn paper() -> Result<Self, CaseError> {
        Self::parse("tuning/paper.toml", PAPER)
    }

    /// Read a case file and the record it names.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let name = path.display().to_string();
        let text = crate::input::text(path).map_err(|source| CaseError::Read { path: name.clone(), source })?;
        Self::parse(&name, &text)
    }

    /// Parse a case file's text; `path` names it in messages and is where its record's path starts.
    pub fn parse(path: &str, text: &str) -> Result<Self, CaseError> {
        let mut notices = Vec::new();
        let case = parse_with(path, text, |file, options| {
            let recording = Recording::read(file, options)?;
            notices = recording.notices();
            Ok(recording.into_record())
        })?;
        Ok(Self { notices, ..case })
    }

    /// A structure without members and its restitution, velocity after an impact over that before, under a ground motion;
    /// `name` stands for the case file in messages.
    ///
    /// # Errors
    /// A setting of `tuning` out of its range; a scale that is not finite, or takes the peak above 50 g.
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
            members: Members::default(),
            record: excitation.scaled()?,
            notices: Vec::new(),
            duration_s: excitation.duration(),
            excitation,
            tuning,
            target: Target::default(),
            bounds: Bounds::default(),
        })
    }
}

impl Case {
    /// A structure on the whole of a record, everything else by default: restitution by equation 2, an accuracy of 0.002, no
    /// members.
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
    #[cfg(feature = "cli")]
    pub(crate) fn set_excitation(&mut self, excitation: Excitation) -> Result<(), RecordError> {
        self.record = excitation.scaled()?;
        self.duration_s = excitation.duration();
        self.excitation = excitation;
        Ok(())
    }
}

/// [`Case::parse`], the record it names read by `read`.
pub fn parse_with(
    path: &str,
    text: &str,
    read: impl FnOnce(&Path, &ReadOptions) -> Result<Record, RecordError>,
) -> Result<Case, CaseError> {
    #[cfg(feature = "cli")]
    ElasticCase::refuse(path, text)?;
    let file: CaseFile = toml::from_str(text).map_err(|e| parse_error(path, text, &e))?;
    let (structure, restitution) = file.structure.checked(path)?;
    let members = Members { damper: file.damper, tendon: file.tendon, friction: file.friction }
        .checked(&structure.body())
        .map_err(|source| CaseError::Members { path: path.into(), source })?;
    let excitation = file.record.excitation(path, read)?;
    let case = Case::new(path, (structure, restitution), excitation, file.tuning)?;
    Ok(Case { members, target: file.target.unwrap_or_default(), bounds: file.bounds, ..case })
}

impl RecordSection {
    /// The ground motion, its record read by `read`; `path` is where the record's path starts.
    fn excitation(
        &self,
        path: &str,
        read: impl FnOnce(&Path, &ReadOptions) -> Result<Record, RecordError>,
    ) -> Result<Excitation, CaseError> {
        let record = match &self.file {
            Some(name) => {
                let folder = Path::new(path).parent().unwrap_or(Path::new(""));
                let (component, baseline) = (self.component.clone(), self.baseline);
                let vertical = self.vertical.clone().map(|from| from.within(folder));
                let options = ReadOptions { dt: self.dt_s, units: self.units, component, baseline, vertical };
                read(&folder.join(name), &options)?
            }
            None if self.tells_of_a_file() => return Err(CaseError::NoFile { path: path.into() }),
            None => Record::el_centro(),
        };
        if let Some(asked) = self.duration_s.filter(|asked| !(*asked > 0.0 && *asked <= LONGEST_S)) {
            let (key, value) = ("record.duration_s", format!("{asked:?}"));
            let remedy = "give seconds greater than zero, at most 1e6";
            return Err(CaseError::Value { path: path.into(), key, value, remedy });
        }
        Ok(Excitation { record, scale: self.scale.unwrap_or(1.0), duration_s: self.duration_s })
    }

    fn tells_of_a_file(&self) -> bool {
        self.dt_s.is_some()
            || self.units.is_some()
            || self.component.is_some()
            || self.baseline
            || self.vertical.is_some()
    }
}

impl Tuning {
    fn check(&self, path: &str) -> Result<(), CaseError> {
        let value =
            |key, value: f64, remedy| CaseError::Value { path: path.into(), key, value: format!("{value:?}"), remedy };
        check_stiffness(path, self.accuracy, self.max_omega_hz)?;
        if self.max_settlement_m.is_nan() || self.max_settlement_m <= 0.0 {
            return Err(value("tuning.max_settlement_m", self.max_settlement_m, "give metres greater than zero"));
        }
        if !(1..=1_000_000).contains(&self.candidates) {
            return Err(value("tuning.candidates", self.candidates as f64, "give a number from 1 to 1000000"));
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
fn check_stiffness(path: &str, accuracy: f64, max_omega_hz: Option<f64>) -> Result<(), CaseError> {
    let asked = [("tuning.max_omega_hz", max_omega_hz, MAX_HZ), ("tuning.accuracy", Some(accuracy), ACCURACY)];
    for (key, value, limits) in asked {
        let checked = value.map_or(Ok(0.0), |value| limits.check(value));
        checked.map_err(|(value, remedy)| CaseError::Value { path: path.into(), key, value, remedy })?;
    }
    Ok(())
}

/// The line of the error, and for an unknown key the nearest known one.
pub(crate) fn parse_error(path: &str, text: &str, error: &toml::de::Error) -> CaseError {
    let line = error.span().map_or(1, |span| text[..span.start.min(text.len())].matches('\n').count() + 1);
    let whole = error.message().lines().next().unwrap_or_default();
    let message = one_line(whole);
    if message.starts_with("unknown variant `impact`") {
        let message = "objective \"impact\" is now landing; write objective = \"landing\"".to_string();
        return CaseError::Parse { path: path.into(), line, message };
    }
    if message.starts_with("unknown variant `pier`") || message.starts_with("unknown variant `frame`") {
        let message =
            "this kind is an elastic structure, whose case files tune run takes; give \"aframe\" or \"block\" here";
        return CaseError::Parse { path: path.into(), line, message: message.into() };
    }
    if names_legs(&message) {
        return CaseError::Parse { path: path.into(), line, message: NO_LEGS.into() };
    }
    let message = message.replace("expected `aframe` or `block`", "expected `aframe`, `block`, `pier` or `frame`");
    // of the whole message: all known keys, the nearest one among them
    let message = match unknown_key(whole) {
        Some((key, Some(near))) => format!("unknown key \"{}\"; did you mean \"{near}\"?", one_line(&key)),
        Some((key, None)) => format!("unknown key \"{}\"; remove it", one_line(&key)),
        None if message.contains(';') => message,
        None => format!("{message}; mend this line"),
    };
    CaseError::Parse { path: path.into(), line, message }
}

/// From serde's "unknown field `x`, expected one of `a`, `b`": x and the known key nearest to it.
fn unknown_key(message: &str) -> Option<(String, Option<String>)> {
    let rest = message.strip_prefix("unknown field ")?;
    let mut quoted = rest.split('`').skip(1).step_by(2).map(str::to_string);
    let key = quoted.next()?;
    let near = quoted.min_by(|a, b| {
        let distance = |known: &str| strsim::damerau_levenshtein(&key, known);
        distance(a).cmp(&distance(b))
    });
    Some((key, near))
}

#[cfg(test)]
mod tests;
