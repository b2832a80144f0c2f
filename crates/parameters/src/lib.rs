//! `parameters.json`: the tuned springs as the engineer keeps them, and how well they follow
//! Housner.

pub mod answers;
mod checks;
pub mod corner;
pub mod elastic;
mod error;
mod file;
mod members_accuracy;
pub mod predictability;
pub mod program;
mod record;
pub mod rigid_forces;

use dynamics::compare::Match;
use std::path::Path;

use serde::{Deserialize, Serialize};

use cases::Case;
use dynamics::spring::{Chain, ChainRow, Design, Springs};
pub use error::ParametersError;
pub use members_accuracy::MembersAccuracy;
use program::{FootUnits, ProgramRow};
pub use record::{RecordRow, RememberedError};
use results::{DesignForces, FiledFinding, PeakPair};
use rocking::{
    conditioning::Conditioning,
    members::{Damper, Friction, Members, Tendon, names_legs},
    structure::Structure,
};
use springs::{
    assessment::Assessment,
    job::Job,
    landing_simulation::report::{LandingRow, landings},
};
use validation::verdict::Verdict;

/// Version of the keys of parameters.json that this program writes. Version 1 had no number, and
/// remembered of the record only what it was called; version 2 had no peaks, design forces and
/// findings; version 3 no springs for programs with fixed time steps.
pub(crate) const SCHEMA: u32 = 4;

/// How sensitive Housner's history of that record is: relative change of u per relative change
/// (`conditioning`).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConditioningRow {
    pub sensitivity_width: f64,
    pub sensitivity_scale: f64,
    /// How far finite changes move u, relative to it: each by +-0.1 % and by +-1 %, the larger of
    /// both signs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moved_by_width: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moved_by_scale: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moved_by_restitution: Option<[f64; 2]>,
    /// Whether one of these changes overturns a body that stands otherwise, or the other way round.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overturning_changes: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub well_conditioned: Option<bool>,
}

impl From<Conditioning> for ConditioningRow {
    fn from(c: Conditioning) -> Self {
        Self {
            sensitivity_width: c.sensitivity.width,
            sensitivity_scale: c.sensitivity.scale,
            moved_by_width: Some(c.changes.width),
            moved_by_scale: Some(c.changes.scale),
            moved_by_restitution: Some(c.changes.restitution),
            overturning_changes: Some(c.changes.overturning),
            well_conditioned: Some(c.well_conditioned()),
        }
    }
}

/// Other springs for the same case and their match: what the paper's procedure (ARR shape, then
/// Omega_n on the record) gives, or its Table 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PaperProcedure {
    pub vertical: ChainRow,
    pub horizontal: ChainRow,
    #[serde(rename = "match")]
    pub matched: Match,
}

/// Everything in `parameters.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    /// Version of the keys; 4 in what this program writes.
    #[serde(default = "file::first")]
    pub schema: u32,
    /// The body.
    pub structure: Structure,
    /// Velocity restitution e that the springs are to have; by equation 2 unless given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// The record they were tuned on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub record: Option<RecordRow>,
    /// What the springs were tuned for, and how accurate they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assessment: Option<Assessment>,
    /// The vertical unit at each foot.
    pub vertical: ChainRow,
    /// The horizontal unit at each foot.
    pub horizontal: ChainRow,
    /// Springs for a program with fixed time steps, which are to stand in that program in place of
    /// those above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub program: Option<ProgramRow<FootUnits>>,
    /// Dampers between feet and ground; the springs are tuned without them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damper: Option<Damper>,
    /// A tendon.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tendon: Option<Tendon>,
    /// Between feet and ground; without it a pressing foot holds at any force.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// The match of the rigid body on the record.
    #[serde(rename = "match", default, skip_serializing_if = "Option::is_none")]
    pub matched: Option<Match>,
    /// How sensitive Housner's history of that record is, of the body without members.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub conditioning: Option<ConditioningRow>,
    /// How sensitive the history with members is, on these springs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conditioning_with_members: Option<predictability::MembersConditioning>,
    /// The match of the structure with its members, on the same springs, with Housner's equation of
    /// the body that a tendon and dampers act on; with friction, of the bare body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub match_with_members: Option<Match>,
    /// What springs err on that record with a tendon or dampers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy_with_members: Option<MembersAccuracy>,
    /// Landings from large leans to small, without any record.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub landings: Vec<LandingRow>,
    /// Beside the springs above, where another objective chose them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paper_procedure: Option<PaperProcedure>,
    /// Table 1 as recovered, beside the paper's own structure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table_1: Option<PaperProcedure>,
    /// What the run found, for the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// Largest displacements of both models on the record.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peaks: Option<PeakPair>,
    /// Forces to design with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub design_forces: Option<DesignForces>,
    /// What a reader must know besides.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<FiledFinding>,
}

impl Parameters {
    /// Springs for a structure, with nothing said of a record yet.
    pub fn new(structure: Structure, springs: &Springs<Design<f64>>) -> Self {
        let m1 = structure.mass_kg;
        Self {
            schema: SCHEMA,
            structure,
            restitution: None,
            record: None,
            assessment: None,
            vertical: ChainRow::new(&springs.vertical, m1),
            horizontal: ChainRow::new(&springs.horizontal, m1),
            program: None,
            damper: None,
            tendon: None,
            friction: None,
            matched: None,
            conditioning: None,
            conditioning_with_members: None,
            match_with_members: None,
            accuracy_with_members: None,
            landings: Vec::new(),
            paper_procedure: None,
            table_1: None,
            verdict: None,
            peaks: None,
            design_forces: None,
            findings: Vec::new(),
        }
    }

    /// What there is to keep of a tuned case whatever the record: the springs, their landings,
    /// their accuracy. Public for the crates that tune.
    #[doc(hidden)]
    pub fn of(case: &Case, job: &Job) -> Self {
        let mut parameters = Self::new(case.structure, &job.springs).with_members(case.members);
        parameters.restitution = Some(case.restitution).filter(|e| *e != job.body.restitution());
        parameters.program = job.program.as_ref().map(ProgramRow::from);
        parameters.landings = landings(&job.body, &parameters.chains(), case.restitution);
        parameters.assessment = Some(Assessment::new(job, &case.tuning, case.restitution));
        parameters.findings =
            job.findings(case.tuning.asked()).into_iter().map(FiledFinding::from).collect();
        parameters
    }

    /// The springs with units, from the file's k1, k2, m2 and c; its mu, f, xi and Omega_n are
    /// there to read and change nothing. Those of `program` are not among them.
    pub fn chains(&self) -> Springs<Chain> {
        Springs { vertical: self.vertical.chain(), horizontal: self.horizontal.chain() }
    }

    /// What the structure has besides the rigid body.
    pub fn members(&self) -> Members {
        Members { damper: self.damper, tendon: self.tendon, friction: self.friction }
    }

    /// These parameters with these members in place of their own.
    pub fn with_members(self, members: Members) -> Self {
        let Members { damper, tendon, friction } = members;
        Self { damper, tendon, friction, ..self }
    }

    /// Velocity restitution e of Housner's body beside these springs.
    pub fn restitution(&self) -> f64 {
        self.restitution.unwrap_or_else(|| self.structure.body::<f64>().restitution())
    }

    /// Read and check a parameters.json.
    ///
    /// # Errors
    /// A file that cannot be read; as [`Self::parse`].
    pub fn read(path: &Path) -> Result<Self, ParametersError> {
        let (name, text) = file::read(path)?;
        Self::parse(&name, &text)
    }

    /// Parse and check a file's text; `path` names it in messages.
    ///
    /// # Errors
    /// No JSON, a key missing or not known, a number that cannot be, a newer schema, springs of an
    /// elastic structure.
    pub fn parse(path: &str, text: &str) -> Result<Self, ParametersError> {
        file::known(path, text)?;
        // of a damaged file it is not known what it is of
        file::parse::<serde::de::IgnoredAny>(path, text)?;
        if elastic::ElasticParameters::is(text) {
            return Err(ParametersError::Elastic { path: path.to_string() });
        }
        let parameters: Self = file::parse(path, text).map_err(|e| match e {
            ParametersError::Parse { path, message, .. } if names_legs(&message) => {
                ParametersError::Legs { path }
            }
            other => other,
        })?;
        parameters.checked(path)
    }

    /// The file's text.
    pub fn to_json(&self) -> String {
        file::to_json(self)
    }
}
