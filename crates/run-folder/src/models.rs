//! The decks of a run.

use decks::{DeckFormat, ExportError, SteppedDeck, sap_function};
use parameters::program::ProgramRow;
use report::screen::{ETABS_SHEET, EVEN_DECK, SHEET};
use strong_motion::Record;

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

/// Those for OpenSees with steps of one size, where the run was asked for its springs.
const EVEN_DECKS: [(&str, DeckFormat); 2] =
    [(EVEN_DECK, DeckFormat::OpenSeesPy), ("model_even.tcl", DeckFormat::OpenSeesTcl)];

/// Every deck; what is to be said of them: left out, with the reason, or ended early. Where springs
/// are asked for another program, there are no tables for SAP2000: ETABS does not read them, and
/// SAP2000 takes no steps that follow touches.
pub(crate) fn decks<U>(
    program: Option<&ProgramRow<U>>,
    text: impl Fn(DeckFormat) -> Result<(String, Option<String>), ExportError>,
) -> Result<RunTexts, FolderError> {
    let another = program.is_some_and(|program| !program.in_sap2000());
    let written = |(_, format): &(&str, DeckFormat)| !(another && *format == DeckFormat::Sap2000);
    let decks: Vec<_> = DECKS.into_iter().filter(written).collect();
    gathered(&decks, |_, format| text(format))
}

/// The decks for OpenSees with steps of one size; none for SAP2000 and ETABS.
pub(crate) fn even_decks<U>(
    program: Option<&ProgramRow<U>>,
    deck: impl Fn(DeckFormat) -> Result<SteppedDeck, ExportError>,
) -> Result<RunTexts, FolderError> {
    match program.is_some_and(ProgramRow::in_opensees) {
        true => gathered(&EVEN_DECKS, |name, format| Ok(deck(format)?.told(name))),
        false => Ok(RunTexts::default()),
    }
}

/// The sheet for SAP2000 or ETABS, on springs for the program's steps, and the ground motion that
/// it names; none for another program.
pub(crate) fn sheet<U>(
    program: Option<&ProgramRow<U>>,
    record: &Record,
    deck: impl Fn(DeckFormat) -> Result<SteppedDeck, ExportError>,
) -> Result<RunTexts, FolderError> {
    if !program.is_some_and(ProgramRow::is_csi) {
        return Ok(RunTexts::default());
    }
    let name = if program.is_some_and(ProgramRow::is_etabs) { ETABS_SHEET } else { SHEET };
    let texts =
        gathered(&[(name, DeckFormat::Sap2000Sheet)], |_, format| Ok((deck(format)?.text, None)))?;
    let mut files = texts.files;
    if !files.is_empty() {
        let beside = motion_files(record).into_iter();
        files.extend(beside.map(|(name, text)| (format!("decks/{name}"), text)));
    }
    // of what the tables have not they tell themselves
    Ok(RunTexts { files, left_out: Vec::new() })
}

/// The ground motion that a sheet names: files beside it, name and text.
pub fn motion_files(record: &Record) -> Vec<(&'static str, String)> {
    let across = ("ground_motion.txt", sap_function(record.dt, &record.accel));
    let up = || ("ground_motion_up.txt", sap_function(record.dt, record.up()));
    std::iter::once(across).chain(record.vertical.as_ref().map(|_| up())).collect()
}

fn gathered(
    decks: &[(&str, DeckFormat)],
    text: impl Fn(&str, DeckFormat) -> Result<(String, Option<String>), ExportError>,
) -> Result<RunTexts, FolderError> {
    let mut texts = RunTexts::default();
    for &(name, format) in decks {
        match text(name, format) {
            // said, not fatal: the other decks are of use
            Err(
                ExportError::Member { name: member, .. }
                | ExportError::MemberOfSteps { name: member },
            ) => texts
                .left_out
                .push(format!("{name} is left out, it has no {member}: take a deck for OpenSees")),
            Err(e @ ExportError::Integrator { .. }) => {
                texts.left_out.push(format!("{name} is left out: {e}"));
            }
            deck => {
                let (text, line) = deck?;
                texts.files.push((format!("decks/{name}"), text));
                texts.left_out.extend(line);
            }
        }
    }
    Ok(texts)
}
