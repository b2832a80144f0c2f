//! `tune export`: the springs and their model for another program.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{CommandError, common::RecordOptions, terminal};
use decks::{
    ACCURACY, CornerProgram, DeckFormat, ExportError, SteppedDeck, Stepping, deck_of, stepped_deck,
};
use frames::fem::ElasticAnalysis;
use parameters::{Parameters, elastic::ElasticParameters, program::ProgramRow};
use run_folder::{
    elastic::{deck, stepped_deck as stepped_deck_of},
    folder::of_one_run,
    models::{deck_name, motion_files},
    place::{file_in, not_an_input, write_file},
};
use strong_motion::{Record, Source, excitation::Excitation};

/// Options of `tune export`.
#[derive(Debug, Args)]
pub struct ExportOptions {
    /// Springs and structure, as `tune run` writes them
    #[arg(long, value_name = "parameters.json")]
    parameters: PathBuf,
    /// openseespy, opensees-tcl, sap2000, sap2000-sheet, csv or markdown
    #[arg(long)]
    format: DeckFormat,
    /// The deck's file; into a folder under the name that tune run gives it
    #[arg(long, value_name = "PATH")]
    out: PathBuf,
    /// Accuracy of the history (normalised error) that the steps of an OpenSees deck are to have
    #[arg(long, default_value_t = ACCURACY)]
    accuracy: f64,
    /// events: steps shorten towards touches; even: steps of one size, on the springs for the
    /// program of `tune run`; touches: even but for substeps at touches, on springs for these
    /// [default: even for sap2000 and its sheet where there are such springs, else events]
    #[arg(long, value_name = "HOW")]
    stepping: Option<Stepping>,
    #[command(flatten)]
    record: RecordOptions,
}

pub fn run(o: &ExportOptions) -> Result<(), CommandError> {
    check_accuracy(o.accuracy)?;
    of_one_run(&o.parameters)?;
    match ElasticParameters::read(&o.parameters)? {
        Some(parameters) => {
            let (stepping, out) = destination(o, parameters.program.as_ref())?;
            elastic(o, &parameters, stepping)?.write(o, (stepping, &out))
        }
        None => {
            let parameters = Parameters::read(&o.parameters)?;
            let (stepping, out) = destination(o, parameters.program.as_ref())?;
            rigid(o, parameters, stepping)?.write(o, (stepping, &out))
        }
    }
}

/// How the deck steps, and its file: in a folder under the name that a run gives it.
fn destination<U>(
    o: &ExportOptions,
    program: Option<&ProgramRow<U>>,
) -> Result<(Stepping, PathBuf), CommandError> {
    let stepping = stepping(o, program)?;
    let etabs = program.is_some_and(ProgramRow::is_etabs);
    Ok((stepping, file_in(&o.out, deck_name(o.format, stepping, etabs))?))
}

/// A deck, and what goes with it.
struct ExportedDeck {
    text: String,
    /// The ground motion in it.
    record: Record,
    /// What to say of it on stderr.
    line: String,
}

impl ExportedDeck {
    /// Write it, and beside what names it the ground motion.
    fn write(
        &self,
        o: &ExportOptions,
        (stepping, out): (Stepping, &Path),
    ) -> Result<(), CommandError> {
        let record = match &self.record.source {
            Source::File { path, .. } => Some(path.as_path()),
            _ => None,
        };
        not_an_input(out, [Some(o.parameters.as_path()), record].into_iter().flatten())?;
        let beside = match o.format {
            DeckFormat::Sap2000Sheet => motion_files(&self.record),
            DeckFormat::Markdown if stepping != Stepping::Events => motion_files(&self.record),
            _ => Vec::new(),
        };
        let beside: Vec<(PathBuf, String)> =
            beside.into_iter().map(|(name, text)| (out.with_file_name(name), text)).collect();
        let differs = |(path, text): &(PathBuf, String)| {
            path == out || std::fs::read(path).is_ok_and(|there| there != text.as_bytes())
        };
        if let Some((path, _)) = beside.iter().find(|file| differs(file)) {
            let path = terminal::shown(path);
            return Err(CommandError::Result(format!(
                "{path} is there and is not the ground motion of this sheet, which names a file \
                 so; export into another folder"
            )));
        }
        write_file(out, self.text.as_bytes())?;
        let mut written = terminal::shown(out).to_string();
        for (path, text) in &beside {
            write_file(path, text.as_bytes())?;
            written += &format!(", {}", terminal::shown(path));
        }
        terminal::stderr(format_args!("{}\nwritten to {written}", self.line));
        Ok(())
    }
}

/// The deck of a rigid body.
fn rigid(
    o: &ExportOptions,
    parameters: Parameters,
    stepping: Stepping,
) -> Result<ExportedDeck, CommandError> {
    let (parameters, record, excitation) = with_record(parameters, &o.parameters, &o.record)?;
    let line = excitation.line();
    let until = predictable_to(&o.record, &parameters, &record);
    let (text, line) = match stepping {
        Stepping::Events => (deck_of(&parameters, &record, o.format, o.accuracy, until)?, line),
        stepping => {
            let deck = stepped_deck(&parameters, &record, o.format, stepping, until)?;
            told(deck, (o.format, stepping), parameters.program.as_ref(), line)
        }
    };
    Ok(ExportedDeck { text, record, line })
}

/// How the deck steps, there being springs for this program.
///
/// # Errors
/// SAP2000's format of springs for another program, which no option asks for.
fn stepping<U>(
    o: &ExportOptions,
    program: Option<&ProgramRow<U>>,
) -> Result<Stepping, ExportError> {
    match (o.stepping, program) {
        (Some(stepping), _) => Ok(stepping),
        (None, Some(program)) if o.format.is_sap2000() => match program.is_csi() {
            true => Ok(Stepping::Even),
            false => {
                let integrator = program.integrator.to_string();
                Err(ExportError::AnotherProgram { integrator })
            }
        },
        // which has its reason
        (None, None) if o.format.is_sap2000() => Ok(Stepping::Even),
        _ => Ok(Stepping::Events),
    }
}

/// Up to when a rigid body's motion can be predicted, if not to its end (s): what the run found, of
/// its own ground motion; what is found now, of another, or of a longer or shorter part.
pub(super) fn predictable_to(
    options: &RecordOptions,
    parameters: &Parameters,
    record: &Record,
) -> Option<f64> {
    match options.is_own() && options.duration.is_none() {
        true => report::predictable_to(&parameters.findings),
        false => parameters::predictability::predictable_to(parameters, record),
    }
}

/// The text of a deck on a program's springs, and what to say of it besides the record.
fn told<U>(
    deck: SteppedDeck,
    (format, stepping): (DeckFormat, Stepping),
    program: Option<&ProgramRow<U>>,
    record: String,
) -> (String, String) {
    // a table of springs has no history of its own
    let name = if format == DeckFormat::Csv { "a history in these steps" } else { "the deck" };
    let (text, ends) = deck.told(name);
    // springs for substeps are others, which were not measured
    let program = program.filter(|_| stepping == Stepping::Even);
    let refused = program.and_then(ProgramRow::not_to_be_used);
    let refused = refused.map(|why| format!("the springs of this deck are {why}"));
    let lines = [Some(record), ends, refused];
    (text, lines.into_iter().flatten().collect::<Vec<_>>().join("\n"))
}

/// The deck of an elastic structure, with our own history to check itself against.
fn elastic(
    o: &ExportOptions,
    parameters: &ElasticParameters,
    stepping: Stepping,
) -> Result<ExportedDeck, CommandError> {
    let excitation = o.record.checked_excitation(|| parameters.excitation(&o.parameters))?;
    let record = excitation.used()?;
    let assembled = parameters.assembled().map_err(CommandError::result)?;
    let until = report::predictable_to(&parameters.findings).filter(|_| o.record.is_own());
    match (stepping, &parameters.program) {
        (Stepping::Events, _) => {}
        (stepping, Some(program)) => {
            let stepped = CornerProgram::new(&assembled, program, stepping)?;
            let deck = stepped_deck_of(&assembled, &stepped, &record, o.format, until)?;
            let how = (o.format, stepping);
            let (text, line) = told(deck, how, Some(program), excitation.line());
            return Ok(ExportedDeck { text, record, line });
        }
        (_, None) => return Err(ExportError::NoProgram.into()),
    }
    let springs = parameters.chains();
    let case = ElasticAnalysis::on_record(&assembled.frame, &springs, &record);
    let history = case.simulate().map_err(CommandError::result)?;
    let text = deck(&assembled, &springs, &record, (&history, until), (o.format, o.accuracy))?;
    Ok(ExportedDeck { text, record, line: excitation.line() })
}

/// Between what double precision and what a landing allow.
pub(super) fn check_accuracy(accuracy: f64) -> Result<(), CommandError> {
    if (1e-6..=0.1).contains(&accuracy) {
        return Ok(());
    }
    let remedy = "give a normalised error from 1e-6 to 0.1";
    Err(CommandError::option("accuracy", format_args!("{accuracy}"), remedy))
}

/// Springs and structure, the part of the record that is used, and what that is of: the record of
/// the file unless given.
pub(super) fn read(
    file: &Path,
    options: &RecordOptions,
) -> Result<(Parameters, Record, Excitation), CommandError> {
    with_record(Parameters::read(file)?, file, options)
}

/// The same of parameters that were read from a file.
fn with_record(
    parameters: Parameters,
    file: &Path,
    options: &RecordOptions,
) -> Result<(Parameters, Record, Excitation), CommandError> {
    let excitation = options.checked_excitation(|| parameters.excitation(file))?;
    Ok((parameters, excitation.used()?, excitation))
}
