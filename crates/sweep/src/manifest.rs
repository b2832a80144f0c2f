//! `manifest.json`: which sweep a folder holds, and files that are there whole or not at all.

use std::{fs, io::ErrorKind, path::Path};

use serde::{Deserialize, Serialize};

use super::{
    SweepError,
    plan::{Measure, Plan},
    spec::{SweepKind, SweepModel},
};
use files::{input, message::one_line, whole_file};

/// What a sweep is, for whoever finds its folder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Manifest {
    /// Name of the program.
    pub program: &'static str,
    /// Its version.
    pub version: &'static str,
    /// FNV-1a of all that decides the results, the samples of files included.
    pub sweep: String,
    /// What is asked.
    pub kind: SweepKind,
    /// By which model.
    pub model: SweepModel,
    /// Seed of the motions made.
    pub seed: u64,
    /// Names of the structures.
    pub structures: Vec<String>,
    /// Number of motions.
    pub motions: usize,
    /// Number of restitutions.
    pub restitutions: usize,
    /// What levels are levels of.
    pub measure: Measure,
    /// The levels.
    pub levels: Vec<f64>,
    /// Cells in all.
    pub cells: u64,
    /// Cells to a part.
    pub cells_to_a_part: u64,
    /// Parts in all.
    pub parts: u64,
}

/// The one key that tells sweeps apart.
#[derive(Deserialize)]
struct ManifestKey {
    sweep: String,
}

impl Manifest {
    /// Of a plan, and the hash of its file.
    pub fn new(plan: &Plan, hash: &str) -> Self {
        Self {
            program: "tune",
            version: env!("CARGO_PKG_VERSION"),
            sweep: hash.into(),
            kind: plan.kind,
            model: plan.model,
            seed: plan.making.seed,
            structures: plan.subjects.iter().map(|subject| subject.name.clone()).collect(),
            motions: plan.motions.len(),
            restitutions: plan.restitution_count(),
            measure: plan.measure,
            levels: plan.levels.clone(),
            cells: plan.cells(),
            cells_to_a_part: plan.part,
            parts: plan.parts(),
        }
    }

    /// Make the folder, or go on in one of the same sweep.
    ///
    /// # Errors
    /// It holds another sweep, or cannot be written.
    pub fn begin(&self, folder: &Path) -> Result<(), SweepError> {
        let name = || folder.display().to_string();
        let file = |source| SweepError::File { path: name(), source };
        fs::create_dir_all(folder.join("parts")).map_err(file)?;
        // of two sweeps that begin at once in an empty folder, one is first
        let lock = fs::File::open(folder).map_err(file)?;
        let _ = lock.lock();
        whole_file::tidy(folder);
        whole_file::tidy(&folder.join("parts"));
        match self.is_in(folder) {
            Err(SweepError::NoSweep { .. }) => {
                whole(&folder.join("manifest.json"), self.text()?.as_bytes())
            }
            known => known,
        }
    }

    /// Whether a folder holds this sweep.
    ///
    /// # Errors
    /// It holds none, or another; its manifest is not as it was written.
    pub fn is_in(&self, folder: &Path) -> Result<(), SweepError> {
        let (path, folder) = (folder.join("manifest.json"), folder.display().to_string());
        let text = match input::text(&path) {
            Err(e) if e.kind() == ErrorKind::NotFound => {
                return Err(SweepError::NoSweep { folder });
            }
            text => text
                .map_err(|source| SweepError::File { path: path.display().to_string(), source })?,
        };
        if text == self.text()? {
            return Ok(());
        }
        match serde_json::from_str(&text) {
            Ok(ManifestKey { sweep }) if sweep != self.sweep => Err(SweepError::OtherSweep {
                folder,
                there: one_line(&sweep),
                here: self.sweep.clone(),
            }),
            _ => Err(SweepError::Damaged {
                path: path.display().to_string(),
                reason: "is not as tune sweep wrote it".into(),
            }),
        }
    }

    fn text(&self) -> Result<String, SweepError> {
        json("manifest.json", self)
    }
}

/// A value as the text of a JSON file.
///
/// # Errors
/// It has no such text.
pub(crate) fn json(name: &str, value: &impl Serialize) -> Result<String, SweepError> {
    let text = serde_json::to_string_pretty(value);
    let text = text.map_err(|e| SweepError::File { path: name.into(), source: e.into() })?;
    Ok(text + "\n")
}

/// Put bytes under a name at once and for good.
///
/// # Errors
/// It cannot be written; nothing new has the name then.
pub(crate) fn whole(path: &Path, bytes: &[u8]) -> Result<(), SweepError> {
    whole_file::write_durably(path, bytes)
        .map_err(|source| SweepError::File { path: path.display().to_string(), source })
}
