//! Case files of elastic structures.
//!
//! ```toml
//! [structure]
//! kind = "pier"              # or "frame", or "aframe" with ea_n, ei_nm2, foot_mass_kg, damping_ratio
//! height_m = 12.0            # of the mass above the soles
//! width_m = 4.0              # of the footing
//! mass_kg = 600e3
//! footing_mass_kg = 120e3
//! footing_height_m = 1.5
//! frequency_hz = 2.0         # fixed to the ground, across; or ei_nm2
//! damping_ratio = 0.02
//!
//! [damper]                   # as for a rigid body; also [tendon]
//! c_ns_per_m = 1e6
//!
//! [record]                   # as for a rigid body
//!
//! [tuning]
//! accuracy = 0.002           # of rotations against the reference's, NRMSE
//! # peaks = 0.02             # instead: of the largest displacement, drift, uplift and forces of columns
//!
//! [program]                  # as for a rigid body
//! ```

use std::path::Path;

use serde::Deserialize;

use super::{
    Asked, CaseError, RecordSection, check_stiffness, error::case_error, missing,
    program::ProgramSection, yardstick,
};
use fixed_steps::FixedStepProgram;
use frames::structure::ElasticStructure;
use rocking::members::{Damper, Members, Tendon};
use strong_motion::{Notice, ReadOptions, Recording, excitation::Excitation};

/// Keys that an A-frame has only if its legs are elastic.
const OF_LEGS: [&str; 4] = ["ea_n", "ei_nm2", "foot_mass_kg", "damping_ratio"];

/// A checked case, its record read.
#[derive(Clone, Debug)]
pub struct ElasticCase {
    /// The structure.
    pub structure: ElasticStructure,
    /// Dampers and a tendon: springs are tuned for the structure with them.
    pub members: Members,
    /// The record, its scale, the length asked for.
    pub excitation: Excitation,
    /// What the reader of the record says of it.
    pub notices: Vec<Notice>,
    /// The error against the reference that Omega_n is chosen for: of the rotations (NRMSE), or of
    /// peaks.
    pub asked: Asked,
    /// Stiffest springs allowed, Omega_n/2 pi of all mass (Hz); none unless given.
    pub max_omega_hz: Option<f64>,
    /// A program with fixed time steps that springs are asked for besides.
    pub program: Option<FixedStepProgram>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ElasticFile {
    structure: ElasticStructure,
    damper: Option<Damper>,
    tendon: Option<Tendon>,
    /// Refused: of rigid bodies.
    friction: Option<toml::Value>,
    #[serde(default)]
    record: RecordSection,
    #[serde(default)]
    tuning: ElasticTuning,
    program: Option<ProgramSection>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
struct ElasticTuning {
    accuracy: f64,
    peaks: Option<f64>,
    max_omega_hz: Option<f64>,
}

impl Default for ElasticTuning {
    fn default() -> Self {
        Self { accuracy: 0.002, peaks: None, max_omega_hz: None }
    }
}

impl ElasticCase {
    /// Whether a case file's text tells of an elastic structure.
    pub fn is(text: &str) -> bool {
        let Ok(file) = text.parse::<toml::Table>() else { return false };
        file.get("structure").and_then(toml::Value::as_table).is_some_and(is_elastic)
    }

    /// Of a text that is to be of a rigid body: says so if it tells of an elastic structure.
    pub(super) fn refuse(path: &str, text: &str) -> Result<(), CaseError> {
        if Self::is(text) { Err(CaseError::OfElastic { path: path.into() }) } else { Ok(()) }
    }

    /// [`ElasticCase::parse_asking`] with nothing asked.
    pub fn parse(path: &str, text: &str) -> Result<Self, CaseError> {
        Self::parse_asking(path, text, &ReadOptions::default())
    }

    /// Parse a case file's text and read the record it names; `path` names it in messages and is
    /// where its record's path starts. What is asked of the record goes before what the case says
    /// of it.
    ///
    /// # Errors
    /// What is wrong with the file, the structure, the record.
    pub fn parse_asking(path: &str, text: &str, asked: &ReadOptions) -> Result<Self, CaseError> {
        Self::of_text(path, text, asked).map_err(|error| error.located(path, text, asked))
    }

    fn of_text(path: &str, text: &str, asked: &ReadOptions) -> Result<Self, CaseError> {
        let file: ElasticFile = toml::from_str(text).map_err(|e| case_error(path, text, &e))?;
        missing::none(path, text)?;
        let of_elastic = |source| CaseError::Elastic { path: path.into(), source };
        let structure = file.structure.checked().map_err(of_elastic)?;
        if let Some(friction) = file.friction {
            let remedy = "slipping is followed for rigid bodies only, leave it out";
            return Err(CaseError::Value {
                path: path.into(),
                key: "friction",
                value: friction.to_string(),
                remedy,
            });
        }
        let members = Members { damper: file.damper, tendon: file.tendon, friction: None };
        let members = structure.check_members(members).map_err(of_elastic)?;
        yardstick::one_of_two(path, text)?;
        let ElasticTuning { accuracy, peaks, max_omega_hz } = file.tuning;
        check_stiffness(path, accuracy, peaks, max_omega_hz)?;
        let mut notices = Vec::new();
        let excitation = file.record.excitation(path, asked, |file: &Path, options| {
            let recording = Recording::read(file, options)?;
            notices = recording.notices();
            Ok(recording.into_record())
        })?;
        let program = ProgramSection::of_case(file.program.as_ref(), path)?;
        let asked = Asked::new(accuracy, peaks);
        Ok(Self { structure, members, excitation, notices, asked, max_omega_hz, program })
    }
}

/// Whether a section `[structure]` tells of an elastic structure.
pub(super) fn is_elastic(structure: &toml::Table) -> bool {
    match structure.get("kind").and_then(toml::Value::as_str) {
        Some("pier" | "frame") => true,
        Some("block") | None => false,
        // an A-frame, or a kind that there is not: the keys tell which kinds are to be named
        Some(_) => OF_LEGS.iter().any(|key| structure.contains_key(*key)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIER: &str = "[structure]\nkind = 'pier'\nheight_m = 12.0\nwidth_m = 4.0\n\
        mass_kg = 600e3\nfooting_mass_kg = 120e3\nfooting_height_m = 1.5\nfrequency_hz = 2.0\n\
        damping_ratio = 0.02\n";

    #[test]
    fn a_pier_and_an_a_frame_with_legs_are_elastic() {
        assert!(ElasticCase::is(PIER));
        let frame = "[structure]\nkind = 'aframe'\nheight_m = 12.0\n";
        assert!(!ElasticCase::is(frame) && ElasticCase::is(&format!("{frame}ea_n = 1e9\n")));
        assert!(!ElasticCase::is("[structure]\nkind = 'block'\n") && !ElasticCase::is("kind"));
    }

    #[test]
    fn as_a_rigid_body_it_is_refused_for_what_it_is() {
        let refused = crate::Case::parse("pier.toml", PIER).unwrap_err().to_string();
        assert!(refused.starts_with("pier.toml: this is an elastic structure"), "{refused}");
    }

    #[test]
    fn a_case_is_read_and_what_is_wrong_is_named() {
        let case = ElasticCase::parse("pier.toml", PIER).unwrap();
        assert_eq!((case.asked, case.excitation.scale), (Asked::new(0.002, None), 1.0));
        let said = |more: &str| {
            ElasticCase::parse("pier.toml", &format!("{PIER}{more}")).unwrap_err().to_string()
        };
        assert!(said("[tuning]\naccuracy = 7.0\n").contains("tuning.accuracy is 7.0"));
        let objective = said("[tuning]\nobjective = 'arr'\n");
        assert!(objective.contains("objective"), "{objective}");
        assert!(said("[legs]\nea_n = 1.0\n").contains("kind = \"aframe\" elastic legs"));
    }
}
