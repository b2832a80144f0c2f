//! `manifest.json`: which sweep a folder holds, and files that are there whole or not at all.

use std::{
    fs::{self, File},
    io::Write,
    path::Path,
};

use serde::{Deserialize, Serialize};

use super::{
    SweepError,
    plan::{Measure, Plan},
    spec::{SweepKind, SweepModel},
};

/// What a sweep is, for whoever finds its folder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Manifest {
    pub program: &'static str,
    pub version: &'static str,
    /// FNV-1a of all that decides the results, the samples of files included.
    pub sweep: String,
    pub kind: SweepKind,
    pub model: SweepModel,
    pub seed: u64,
    pub structures: Vec<String>,
    pub motions: usize,
    pub restitutions: usize,
    pub measure: Measure,
    pub levels: Vec<f64>,
    pub cells: u64,
    pub cells_to_a_part: u64,
    pub parts: u64,
}

/// The one key that tells sweeps apart.
#[derive(Deserialize)]
struct ManifestKey {
    sweep: String,
}

impl Manifest {
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
        fs::create_dir_all(folder.join("parts")).map_err(|source| SweepError::File { path: name(), source })?;
        match Self::there(folder)? {
            Some(there) if there == self.sweep => Ok(()),
            Some(there) => Err(SweepError::OtherSweep { folder: name(), there, here: self.sweep.clone() }),
            None => write(&folder.join("manifest.json"), self),
        }
    }

    /// Which sweep a folder holds.
    ///
    /// # Errors
    /// A manifest that is none.
    pub fn there(folder: &Path) -> Result<Option<String>, SweepError> {
        let path = folder.join("manifest.json");
        let Ok(text) = fs::read_to_string(&path) else { return Ok(None) };
        let known: ManifestKey = serde_json::from_str(&text)
            .map_err(|e| SweepError::Damaged { path: path.display().to_string(), reason: e.to_string() })?;
        Ok(Some(known.sweep))
    }
}

/// Write JSON whole.
///
/// # Errors
/// It cannot be written.
pub fn write(path: &Path, value: &impl Serialize) -> Result<(), SweepError> {
    let file = |e: std::io::Error| SweepError::File { path: path.display().to_string(), source: e };
    let mut text = serde_json::to_string_pretty(value).map_err(|e| file(e.into()))?;
    text.push('\n');
    whole(path, text.as_bytes())
}

/// Prefix of names that files have until they are whole.
pub const UNFINISHED: &str = ".unfinished-";

/// Put bytes under a name at once: a temporary name in the same folder, synced, renamed, and the folder synced, so that a name that is
/// there has all its bytes even after a crash of the machine.
///
/// # Errors
/// It cannot be written; nothing has the name then.
pub fn whole(path: &Path, bytes: &[u8]) -> Result<(), SweepError> {
    let wrap = |source| SweepError::File { path: path.display().to_string(), source };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(UNFINISHED);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
    let mut file = builder.tempfile_in(folder).map_err(wrap)?;
    file.write_all(bytes).map_err(wrap)?;
    file.as_file().sync_all().map_err(wrap)?;
    file.persist(path).map_err(|e| wrap(e.error))?;
    #[cfg(unix)]
    File::open(folder).and_then(|folder| folder.sync_all()).map_err(wrap)?;
    Ok(())
}

/// Remove what killed runs left behind. Only when no other can be writing: a sweep that has all its parts.
pub fn tidy(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if entry.file_name().to_string_lossy().starts_with(UNFINISHED) {
            // another may have tidied it up
            let _ = fs::remove_file(entry.path());
        }
    }
}
