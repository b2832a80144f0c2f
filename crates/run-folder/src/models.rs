//! The decks of a run.

use decks::{DeckFormat, ExportError};

use crate::{FolderError, texts::RunTexts};

/// The decks of `tune run`: name in the folder, format.
pub const DECKS: [(&str, DeckFormat); 5] = [
    ("model_openseespy.py", DeckFormat::OpenSeesPy),
    ("model_opensees.tcl", DeckFormat::OpenSeesTcl),
    ("model_sap2000.s2k", DeckFormat::Sap2000),
    ("springs.csv", DeckFormat::Csv),
    ("springs.md", DeckFormat::Markdown),
];

/// Every deck; those that cannot be made of the structure are left out, with the reason.
pub(crate) fn decks(text: impl Fn(DeckFormat) -> Result<String, ExportError>) -> Result<RunTexts, FolderError> {
    let mut texts = RunTexts::default();
    for (name, format) in DECKS {
        match text(format) {
            // said, not fatal: the other decks are of use
            Err(e @ ExportError::Member { .. }) => {
                let name = name.trim_start_matches("");
                texts.left_out.push(format!("{name} is left out: {e}"));
            }
            deck => texts.files.push((format!("decks/{name}"), deck?)),
        }
    }
    Ok(texts)
}
