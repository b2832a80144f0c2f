//! The decks of a run.

use std::path::Path;

use decks::{DeckFormat, ExportError};

use crate::{FolderError, place::write_file};

/// The decks of `tune run`: name in the folder, format.
pub const DECKS: [(&str, DeckFormat); 5] = [
    ("model_openseespy.py", DeckFormat::OpenSeesPy),
    ("model_opensees.tcl", DeckFormat::OpenSeesTcl),
    ("model_sap2000.s2k", DeckFormat::Sap2000),
    ("springs.csv", DeckFormat::Csv),
    ("springs.md", DeckFormat::Markdown),
];

/// Write every deck into a folder, which is made; the decks that are left out, with the reason.
pub(crate) fn write_decks(
    dir: &Path,
    text: impl Fn(DeckFormat) -> Result<String, ExportError>,
) -> Result<Vec<String>, FolderError> {
    std::fs::create_dir_all(dir).map_err(|source| FolderError::Write { path: dir.display().to_string(), source })?;
    let mut left_out = Vec::new();
    for (name, format) in DECKS {
        match text(format) {
            // said, not fatal: the other decks are of use
            Err(
                e @ (ExportError::Member { .. } | ExportError::MemberOfSteps { .. } | ExportError::Integrator { .. }),
            ) => left_out.push(format!("{name} is left out: {e}")),
            deck => write_file(&dir.join(name), deck?.as_bytes())?,
        }
    }
    Ok(left_out)
}
