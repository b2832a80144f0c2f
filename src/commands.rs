//! What the program `tune` does: one file a subcommand, the words of its options included.

use std::{
    fmt::{Debug, Display},
    process::ExitCode,
};

use clap::{Parser, Subcommand};
use thiserror::Error;

use ::sweep::SweepError;
use cases::CaseError;
use decks::{ExportError, verify::VerifyError};
use figures::FigureError;
use files::message::printable;
use frequency_response::inner::FitError;
use landing::design::GeometryError;
use parameters::{ParametersError, RememberedError};
use run_folder::FolderError;
use springs::job::JobError;
use strong_motion::RecordError;

mod bounds;
mod chart;
mod common;
mod completions;
mod export;
mod housner;
mod init;
mod members;
mod progress;
mod record;
mod response;
mod run;
mod simulate;
mod sweep;
pub(crate) mod terminal;
mod validate;
mod verify;

/// Ground springs that let a finite element program follow Housner's theory of rocking.
#[derive(Debug, Parser)]
#[command(name = "tune", version, about)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Tune the springs of a case; without arguments the paper's A-frame on El Centro.
    Run(run::RunOptions),
    /// Write a case file to begin with, every line explained.
    Init(init::InitOptions),
    /// Rock the rigid body by Housner's equation; its history as CSV on stdout.
    Housner(housner::HousnerOptions),
    /// Fit a spring-absorber unit (frequency ratio f, damping ratio xi) of a mass ratio to the
    /// wanted frequency response.
    Response(response::ResponseOptions),
    /// The design over slenderness and stiffness, for any size and mass, as CSV and figure.
    Chart(chart::ChartOptions),
    /// Rock the finite elements on given springs, and Housner's body; their match as JSON on
    /// stdout.
    Simulate(simulate::SimulateOptions),
    /// Judge given springs over many records: peaks, overturning, histories where they can be
    /// compared.
    Validate(validate::ValidateOptions),
    /// Many histories over structures, records, scales: fragility, overturning and rocking spectra.
    Sweep(sweep::SweepOptions),
    /// Write the springs and their model for OpenSees, SAP2000 or as plain tables.
    Export(export::ExportOptions),
    /// What is in record files of any format, and what a run would take of them.
    Record(record::RecordFileOptions),
    /// Run the exported model in OpenSees beside our own history and Housner's.
    Verify(verify::VerifyOptions),
    /// Print what a shell needs to complete commands and options.
    Completions(completions::CompletionsOptions),
}

impl Command {
    /// The threads asked for, of the commands that take `--jobs`.
    fn jobs(&self) -> Option<usize> {
        match self {
            Self::Run(o) => o.jobs,
            Self::Chart(o) => o.jobs,
            Self::Validate(o) => o.jobs,
            Self::Sweep(o) => o.jobs(),
            _ => None,
        }
    }
}

/// Why a command ended without its result.
#[derive(Debug, Error)]
pub enum CommandError {
    #[error(transparent)]
    Case(#[from] CaseError),
    #[error(transparent)]
    Record(#[from] RecordError),
    #[error(transparent)]
    Parameters(#[from] ParametersError),
    #[error(transparent)]
    Remembered(#[from] RememberedError),
    #[error(transparent)]
    Fit(#[from] FitError),
    #[error(transparent)]
    Job(#[from] JobError),
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    #[error(transparent)]
    Figure(#[from] FigureError),
    #[error("{}", .0.with_options())]
    Export(#[from] ExportError),
    #[error(transparent)]
    Sweep(#[from] SweepError),
    #[error(transparent)]
    Verify(#[from] VerifyError),
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error("cannot write to stdout: {0}")]
    Stdout(#[from] std::io::Error),
    #[error("--{option} is {value}; {remedy}")]
    Option { option: &'static str, value: String, remedy: &'static str },
    #[error("{0}")]
    Result(String),
    /// ^C ended the search: the results are there, exit code 130.
    #[error("^C ended the search; {folder} has the best springs so far, and what was not done")]
    Interrupted { folder: String },
    /// What was checked is not so: exit code 1.
    #[error("{0}")]
    Failed(String),
}

impl CommandError {
    /// An option whose value cannot be, and what to give.
    fn option(option: &'static str, value: impl Debug, remedy: &'static str) -> Self {
        Self::Option { option, value: format!("{value:?}"), remedy }
    }

    /// Another error in its own words.
    fn result(e: impl Display) -> Self {
        Self::Result(e.to_string())
    }
}

/// Parse the arguments and run: exit code 0, or with one line on stderr 2, or 1 where a check
/// failed, or 130 where ^C ended a search.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(e) if !e.use_stderr() => {
            // help or the version
            return code(terminal::stdout(e));
        }
        Err(e) => {
            let text = e.to_string();
            let what: Vec<&str> =
                text.split("\n\n").next().unwrap_or_default().split_whitespace().collect();
            let what = what.join(" ");
            // the nearest right one, where there is one
            let tip = text.lines().map(str::trim).find_map(|line| line.strip_prefix("tip: "));
            let tip = tip.map(str::to_owned).or_else(|| with_a_point(&what));
            let tip = tip.map_or(String::new(), |tip| format!(" ({tip})"));
            terminal::stderr(format_args!("{}{tip}; see tune --help", what.trim_end_matches('.')));
            return ExitCode::from(2);
        }
    };
    // before any command computes: reading files may be parallel work already
    if let Err(e) = common::threads(cli.command.jobs()) {
        return code(Err(e));
    }
    let result = match cli.command {
        Command::Run(o) => run::run(&o),
        Command::Housner(o) => housner::run(&o),
        Command::Response(o) => response::run(&o),
        Command::Chart(o) => chart::run(&o),
        Command::Simulate(o) => simulate::run(&o),
        Command::Validate(o) => validate::run(&o),
        Command::Sweep(o) => sweep::run(&o),
        Command::Export(o) => export::run(&o),
        Command::Record(o) => record::run(&o),
        Command::Verify(o) => verify::run(&o),
        Command::Init(o) => init::run(&o),
        Command::Completions(o) => completions::run(&o),
    };
    code(result)
}

/// The exit code of a result, whose error is one line on stderr.
fn code(result: Result<(), CommandError>) -> ExitCode {
    match result {
        // all results are there, but what was said of them is not
        Ok(()) if terminal::stderr_failed() => ExitCode::from(2),
        Ok(()) => ExitCode::SUCCESS,
        Err(e) => {
            terminal::stderr(format_args!(
                "error: {}",
                printable(&without_number(&e.to_string().replace(['\n', '\r'], " ")))
            ));
            ExitCode::from(match e {
                CommandError::Failed(_) => 1,
                CommandError::Interrupted { .. } => bounds::INTERRUPTED_CODE,
                _ => 2,
            })
        }
    }
}

/// A message without the operating system's number of an error: " (os error 2)".
fn without_number(message: &str) -> String {
    match message.split_once(" (os error ") {
        Some((before, rest)) => match rest.split_once(')') {
            Some((_, after)) => format!("{before}{after}"),
            None => message.to_owned(),
        },
        None => message.to_owned(),
    }
}

/// What to do about a number with a comma: "invalid value '1,9' for ...".
fn with_a_point(what: &str) -> Option<String> {
    let value = what.split('\'').nth(1).filter(|value| value.matches(',').count() == 1)?;
    let point = value.replace(',', ".");
    point.parse::<f64>().ok().map(|_| format!("write it with a point: {point}"))
}
