//! The decks of a run.

use decks::{DeckFormat, ExportError, SteppedDeck, Stepping, sap_function};
use parameters::program::ProgramRow;
use report::screen::{ETABS_SHEET, EVEN_DECK, SHEET, TABLES};
use strong_motion::Record;

use crate::{FolderError, texts::RunTexts};

/// The decks of `tune run` on springs for steps that follow touches.
const DECKS: [DeckFormat; 4] =
    [DeckFormat::OpenSeesPy, DeckFormat::OpenSeesTcl, DeckFormat::Csv, DeckFormat::Markdown];

/// The name of a deck in the folder of a run.
pub fn deck_name(format: DeckFormat, stepping: Stepping, etabs: bool) -> &'static str {
    match (format, stepping) {
        (DeckFormat::Sap2000, _) => TABLES,
        (DeckFormat::Sap2000Sheet, _) if etabs => ETABS_SHEET,
        (DeckFormat::Sap2000Sheet, _) => SHEET,
        (DeckFormat::OpenSeesPy, Stepping::Events) => "model_openseespy.py",
        (DeckFormat::OpenSeesPy, Stepping::Even) => EVEN_DECK,
        (DeckFormat::OpenSeesPy, Stepping::Touches) => "model_touches.py",
        (DeckFormat::OpenSeesTcl, Stepping::Events) => "model_opensees.tcl",
        (DeckFormat::OpenSeesTcl, Stepping::Even) => "model_even.tcl",
        (DeckFormat::OpenSeesTcl, Stepping::Touches) => "model_touches.tcl",
        (DeckFormat::Csv, Stepping::Events) => "springs.csv",
        (DeckFormat::Csv, Stepping::Even) => "springs_even.csv",
        (DeckFormat::Csv, Stepping::Touches) => "springs_touches.csv",
        (DeckFormat::Markdown, Stepping::Events) => "springs.md",
        (DeckFormat::Markdown, Stepping::Even) => "springs_even.md",
        (DeckFormat::Markdown, Stepping::Touches) => "springs_touches.md",
    }
}

/// The decks on springs for steps that follow touches; what is to be said of them: left out, with
/// the reason, or ended early.
pub(crate) fn decks(
    text: impl Fn(DeckFormat) -> Result<String, ExportError>,
) -> Result<RunTexts, FolderError> {
    let name = |format| deck_name(format, Stepping::Events, false);
    gathered(&DECKS, name, |_, format| Ok((text(format)?, None)))
}

/// What goes with a program's steps of one size: the tables of its springs; for OpenSees its decks;
/// for SAP2000 its tables; for it and ETABS the sheet; the ground motion that these name.
pub(crate) fn even_decks<U>(
    program: Option<&ProgramRow<U>>,
    record: &Record,
    deck: impl Fn(&ProgramRow<U>, DeckFormat) -> Result<SteppedDeck, ExportError>,
) -> Result<RunTexts, FolderError> {
    let Some(program) = program else { return Ok(RunTexts::default()) };
    let name = |format| deck_name(format, Stepping::Even, program.is_etabs());
    let told = |name: &str, format| Ok(deck(program, format)?.told(name));
    // of what these have not, the others tell
    let silent = |_: &str, format| Ok((deck(program, format)?.text, None));
    let models: &[_] = if program.in_opensees() {
        &[DeckFormat::OpenSeesPy, DeckFormat::OpenSeesTcl]
    } else if program.in_sap2000() {
        &[DeckFormat::Sap2000]
    } else {
        &[]
    };
    let mut texts = gathered(models, name, told)?;
    let sheet: &[_] = if program.is_csi() { &[DeckFormat::Sap2000Sheet] } else { &[] };
    let sheet = gathered(sheet, name, silent)?.files;
    let tables = gathered(&[DeckFormat::Csv, DeckFormat::Markdown], name, silent)?.files;
    // the sheet and springs_even.md name them
    if !sheet.is_empty() || !tables.is_empty() {
        let motions = motion_files(record).into_iter();
        texts.files.extend(motions.map(|(name, text)| (format!("decks/{name}"), text)));
    }
    texts.files.extend(sheet);
    texts.files.extend(tables);
    Ok(texts)
}

/// The ground motion that a sheet and springs_even.md name: files beside it, name and text.
pub fn motion_files(record: &Record) -> Vec<(&'static str, String)> {
    let across = ("ground_motion.txt", sap_function(record.dt, &record.accel));
    let up = || ("ground_motion_up.txt", sap_function(record.dt, record.up()));
    std::iter::once(across).chain(record.vertical.as_ref().map(|_| up())).collect()
}

fn gathered(
    decks: &[DeckFormat],
    name: impl Fn(DeckFormat) -> &'static str,
    text: impl Fn(&str, DeckFormat) -> Result<(String, Option<String>), ExportError>,
) -> Result<RunTexts, FolderError> {
    let mut texts = RunTexts::default();
    for &format in decks {
        let name = name(format);
        match text(name, format) {
            // said, not fatal: the other decks are of use
            Err(
                ExportError::Member { name: member, .. }
                | ExportError::MemberOfSteps { name: member },
            ) => texts.left_out.push(format!(
                "{name} is left out, for such tables hold no {member}: take a deck for OpenSees"
            )),
            Err(e @ ExportError::Integrator { .. }) => {
                texts.left_out.push(format!("{name} is left out: {}", e.with_options()));
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
