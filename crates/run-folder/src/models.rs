//! The decks of a run.

use std::path::Path;

use decks::{DeckFormat, ExportError};

use crate::{FolderError, place::write_file};

/// SAP2000's tables.
pub(crate) const SAP2000: &str = "model_sap2000.s2k";

/// The decks of `tune run`: name in the folder, format.
pub const DECKS: [(&str, DeckFormat); 5] = [
    ("model_openseespy.py", DeckFormat::OpenSeesPy),
    ("model_opensees.tcl", DeckFormat::OpenSeesTcl),
    (SAP2000, DeckFormat::Sap2000),
    ("springs.csv", DeckFormat::Csv),
    ("springs.md", DeckFormat::Markdown),
];

/// Write every deck into a folder, which is made; what is to be said of them: left out, with the
/// reason, or ended early.
pub(crate) fn write_decks(
    dir: &Path,
    text: impl Fn(DeckFormat) -> Result<(String, Option<String>), ExportError>,
) -> Result<Vec<String>, FolderError> {
    std::fs::create_dir_all(dir).map_err(|source| FolderError::Write { path: dir.display().to_string(), source })?;
    let mut said = Vec::new();
    for (name, format) in DECKS {
        match text(format) {
            // said, not fatal: the other decks are of use
            Err(
                e @ (ExportError::Member { .. } | ExportError::MemberOfSteps { .. } | ExportError::Integrator { .. }),
            ) => said.push(format!("{name} is left out: {e}")),
            deck => {
                let (text, line) = deck?;
                write_file(&dir.join(name), text.as_bytes())?;
                said.extend(line);
            }
        }
    }
    Ok(said)
}
