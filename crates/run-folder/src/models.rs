//! The decks of a run.

use decks::{DeckFormat, ExportError};

use crate::{FolderError, texts::RunTexts};

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

/// Every deck; what is to be said of them: left out, with the reason, or ended early.
pub(crate) fn decks(
    text: impl Fn(DeckFormat) -> Result<(String, Option<String>), ExportError>,
) -> Result<RunTexts, FolderError> {
    let mut texts = RunTexts::default();
    for (name, format) in DECKS {
        match text(format) {
            // said, not fatal: the other decks are of use
            Err(
                e @ (ExportError::Member { .. }
                | ExportError::MemberOfSteps { .. }
                | ExportError::Integrator { .. }),
            ) => texts.left_out.push(format!("{name} is left out: {e}")),
            deck => {
                let (text, line) = deck?;
                texts.files.push((format!("decks/{name}"), text));
                texts.left_out.extend(line);
            }
        }
    }
    Ok(texts)
}
