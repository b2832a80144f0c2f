//! `tune export`: the springs and their model for another program.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{CommandError, common::RecordOptions, terminal};
use decks::{
    ACCURACY, CornerProgram, DeckFormat, ExportError, SteppedDeck, Stepping, deck_of, stepped_deck,
    with_inertia,
};
use frames::fem::{ElasticAnalysis, ElasticStart};
use parameters::{Parameters, elastic::ElasticParameters, program::ProgramRow};
use results::FiledFinding;
use run_folder::{
    elastic::{deck, stepped_deck as stepped_deck_of},
    folder::of_one_run,
    models::DECKS,
    place::file_in,
    place::write_file,
};
use strong_motion::Record;

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
    let usual =
        DECKS.iter().find(|(_, format)| *format == o.format).map_or("deck", |(name, _)| name);
    let out = file_in(&o.out, usual)?;
    check_accuracy(o.accuracy)?;
    of_one_run(&o.parameters)?;
    let (deck, line) = match ElasticParameters::read(&o.parameters)? {
        Some(parameters) => elastic(o, &parameters)?,
        None => {
            let (parameters, record, line) = read(&o.parameters, &o.record)?;
            match stepping(o, parameters.program.as_ref()) {
                Stepping::Events => (deck_of(&parameters, &record, o.format, o.accuracy)?, line),
                stepping => {
                    let until = predictable_to(o, &parameters.findings);
                    told(stepped_deck(&parameters, &record, o.format, stepping, until)?, line)
                }
            }
        }
    };
    write_file(&out, deck.as_bytes())?;
    terminal::stderr(format_args!("{line}\nwritten to {}", terminal::shown(&out)));
    Ok(())
}

/// How the deck steps, there being springs for this program.
fn stepping<U>(o: &ExportOptions, program: Option<&ProgramRow<U>>) -> Stepping {
    let csi = o.format.is_sap2000() && program.is_some_and(ProgramRow::is_csi);
    o.stepping.unwrap_or(if csi { Stepping::Even } else { Stepping::Events })
}

/// Up to when the run found that the motion can be predicted, if not to its end (s): of its own
/// record, at its own scale.
fn predictable_to(o: &ExportOptions, findings: &[FiledFinding]) -> Option<f64> {
    let own = o.record.record.is_none() && o.record.scale.is_none();
    report::predictable_to(findings).filter(|_| own)
}

/// The text of a deck, and what to say of it besides the record.
fn told(deck: SteppedDeck, record: String) -> (String, String) {
    let (text, line) = deck.told("the deck");
    (text, line.map_or(record.clone(), |line| format!("{record}\n{line}")))
}

/// The deck of an elastic structure, with our own history to check itself against, and a line that
/// says on which record.
fn elastic(
    o: &ExportOptions,
    parameters: &ElasticParameters,
) -> Result<(String, String), CommandError> {
    let excitation = o.record.excitation(|| parameters.excitation(&o.parameters))?;
    let record = excitation.used()?;
    let assembled = parameters.assembled().map_err(|e| CommandError::Result(e.to_string()))?;
    match (stepping(o, parameters.program.as_ref()), &parameters.program) {
        (Stepping::Events, _) => {}
        (stepping, Some(program)) => {
            let program = CornerProgram::new(&assembled, program, stepping)?;
            let until = predictable_to(o, &parameters.findings);
            let deck = stepped_deck_of(&assembled, &program, &record, o.format, until)?;
            return Ok(told(deck, excitation.line()));
        }
        (_, None) => return Err(ExportError::NoProgram.into()),
    }
    let springs = parameters.chains();
    let case = ElasticAnalysis {
        vertical: record.up(),
        ..ElasticAnalysis::new(
            &assembled.frame,
            &springs,
            ElasticStart::Standing,
            record.dt,
            &record.accel,
        )
    };
    let history = case.simulate().map_err(|e| CommandError::Result(e.to_string()))?;
    let text = deck(&assembled, &springs, &record, &history, (o.format, o.accuracy))?;
    Ok((text, excitation.line()))
}

/// Between what double precision and what a landing allow.
pub(super) fn check_accuracy(accuracy: f64) -> Result<(), CommandError> {
    if (1e-6..=0.1).contains(&accuracy) {
        return Ok(());
    }
    let remedy = "give a normalised error from 1e-6 to 0.1";
    Err(CommandError::Option { option: "accuracy", value: accuracy.to_string(), remedy })
}

/// The model that decks hold, the part of its record that is used, and a line that says which: that
/// of the file unless given.
pub(super) fn read(
    file: &Path,
    options: &RecordOptions,
) -> Result<(Parameters, Record, String), CommandError> {
    let mut parameters = Parameters::read(file)?;
    parameters.structure = with_inertia(&parameters.structure);
    let excitation = options.excitation(|| parameters.excitation(file))?;
    Ok((parameters, excitation.used()?, excitation.line()))
}
