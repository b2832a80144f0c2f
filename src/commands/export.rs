//! `tune export`: the springs and their model for another program.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{CommandError, common::RecordOptions, output::check_file, write_file};
use crate::{
    export::{ACCURACY, Expected, ExportError, Format, deck_of, export, with_inertia},
    parameters::Parameters,
    record::Record,
};

/// Options of `tune export`.
#[derive(Debug, Args)]
pub struct Options {
    /// Springs and structure, as `tune run` writes them
    #[arg(long, value_name = "parameters.json")]
    parameters: PathBuf,
    /// openseespy, opensees-tcl, sap2000, csv or markdown
    #[arg(long)]
    format: Format,
    /// The deck's file
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Accuracy of the history (normalised error) that the steps of an OpenSees deck are to have
    #[arg(long, default_value_t = ACCURACY)]
    accuracy: f64,
    #[command(flatten)]
    record: RecordOptions,
}

pub fn run(o: &Options) -> Result<(), CommandError> {
    check_file(&o.out)?;
    check_accuracy(o.accuracy)?;
    let (parameters, record, line) = read(&o.parameters, &o.record)?;
    let deck = deck_of(&parameters, &record, o.format, o.accuracy)?;
    write_file(&o.out, deck.as_bytes())?;
    eprintln!("{line}\nwritten to {}", o.out.display());
    Ok(())
}

/// Between what double precision and what a landing allow.
pub(super) fn check_accuracy(accuracy: f64) -> Result<(), CommandError> {
    if (1e-6..=0.1).contains(&accuracy) {
        return Ok(());
    }
    let remedy = "give a normalised error from 1e-6 to 0.1";
    Err(CommandError::Option { option: "accuracy", value: accuracy.to_string(), remedy })
}

/// The model that decks hold, the part of its record that is used, and a line that says which: that of the file unless
/// given.
pub(super) fn read(file: &Path, options: &RecordOptions) -> Result<(Parameters, Record, String), CommandError> {
    let mut parameters = Parameters::read(file)?;
    parameters.structure = with_inertia(&parameters.structure);
    let excitation = options.excitation(|| parameters.excitation(file))?;
    Ok((parameters, excitation.used()?, excitation.line()))
}

/// The decks of `tune run`: name in the folder, format.
const DECKS: [(&str, Format); 5] = [
    ("model_openseespy.py", Format::OpenSeesPy),
    ("model_opensees.tcl", Format::OpenSeesTcl),
    ("model_sap2000.s2k", Format::Sap2000),
    ("springs.csv", Format::Csv),
    ("springs.md", Format::Markdown),
];

/// Write every deck into a folder, which is made.
pub(super) fn write_all(
    dir: &Path,
    parameters: &Parameters,
    record: &Record,
    expected: &Expected,
) -> Result<(), CommandError> {
    std::fs::create_dir_all(dir).map_err(|source| CommandError::Write { path: dir.display().to_string(), source })?;
    for (name, format) in DECKS {
        match export(parameters, record, expected, format) {
            // said, not fatal: the other decks are of use
            Err(e @ ExportError::Member { .. }) => eprintln!("{name} is left out: {e}"),
            deck => write_file(&dir.join(name), deck?.as_bytes())?,
        }
    }
    Ok(())
}
