//! `tune run`: the whole job.

mod elastic;
mod program;

use std::path::PathBuf;

use clap::Args;

use super::{
    CommandError,
    bounds::{EffortOptions, ended},
    common::{GroundOptions, RecordOptions},
    progress::{self, Progress},
    terminal,
};
use cases::{
    ACCURACY, Asked, Case, ElasticCase, Limits, MAX_HZ, Objective, PEAKS, Yardstick, text_of,
};
use parameters::Parameters;
use program::ProgramOptions;
use report::{
    FiledParameters, Run,
    markdown::markdown,
    rigid::RigidRun,
    screen::{Written, screen},
    stiffness_tradeoff,
};
use results::{FiledFinding, Finding, NotDone};
use run_folder::{
    folder::{Folder, identity},
    place::{check_folder, write_file},
    rigid::{Output, filed, files, save, write_report},
};
use springs::{
    job::{Job, MOST_WORK},
    landing_simulation::MEASURED_SHARES,
};
use strong_motion::{Record, excitation::Excitation};

/// Options of `tune run`.
#[derive(Debug, Args)]
pub struct RunOptions {
    /// Case file (TOML); the paper's A-frame on El Centro unless given
    case: Option<PathBuf>,
    #[command(flatten)]
    record: RecordOptions,
    /// Springs from the geometry and the synthetic motions alone: no history, no decks
    #[arg(long, conflicts_with_all = ["record", "dt", "units", "component", "column", "baseline",
        "vertical", "scale", "duration"])]
    no_record: bool,
    #[command(flatten)]
    ground: GroundOptions,
    /// Stiffest springs allowed where steps follow touches, as the frequency Omega_n / 2 pi of the
    /// mass on a gap spring [default: none, or the case's]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    max_hz: Option<f64>,
    /// Error of the history against Housner's that the stiffness is chosen for: normalised root
    /// mean square error, NRMSE [default: 0.002, or the case's]
    #[arg(long, value_name = "ERROR", allow_negative_numbers = true)]
    accuracy: Option<f64>,
    /// Error of the largest displacement, uplift and forces that the stiffness is chosen for
    /// instead; a case's accuracy then does not count
    #[arg(long, value_name = "ERROR", allow_negative_numbers = true)]
    peaks: Option<f64>,
    #[command(flatten)]
    program: ProgramOptions,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub(super) jobs: Option<usize>,
    #[command(flatten)]
    effort: EffortOptions,
    /// No figures
    #[arg(long)]
    no_figures: bool,
    /// No report.html
    #[arg(long)]
    no_report: bool,
    /// Do not compute the error over the stiffness (front.png)
    #[arg(long)]
    no_front: bool,
    /// No progress
    #[arg(long)]
    quiet: bool,
    /// Print all that report.html has, below the screen
    #[arg(long, conflicts_with = "json")]
    verbose: bool,
    /// Print the run as JSON in place of the screen
    #[arg(long)]
    json: bool,
}

pub fn run(o: &RunOptions) -> Result<(), CommandError> {
    let mut case = match &o.case {
        Some(path) => {
            let (name, text, asked) =
                (path.display().to_string(), text_of(path)?, o.record.of_case());
            if ElasticCase::is(&text) {
                return elastic::run(o, ElasticCase::parse_asking(&name, &text, &asked)?);
            }
            Case::parse_asking(&name, &text, &asked)?
        }
        None => Case::paper()?,
    };
    if o.no_record {
        if case.tuning.objective == Objective::Arr {
            let remedy = "the paper's procedure tunes on a record; leave one of the two out";
            let value = format_args!("objective = \"arr\"");
            return Err(CommandError::option("no-record", value, remedy));
        }
        case.set_excitation(Excitation::whole(Record::new("none", 0.01, vec![0.0; 2])?))?;
    } else {
        case.set_excitation(o.record.excitation_of_case(&case.excitation, &case.notices)?)?;
    }
    case.tuning.max_omega_hz = o.max_hz()?.or(case.tuning.max_omega_hz);
    case.program = o.program.over(case.program)?;
    match o.asked()? {
        Some(Asked { by: Yardstick::Histories, error }) => {
            (case.tuning.accuracy, case.tuning.peaks) = (error, None)
        }
        Some(Asked { by: Yardstick::Peaks, error }) => case.tuning.peaks = Some(error),
        None => {}
    }
    let friction = o.ground.friction()?;
    check_folder(&o.out)?;

    if !o.no_record {
        progress::taken(&case.excitation.line(), &case.doubts(), o.quiet);
    }
    out_of_reach(&case, o.quiet);
    let progress = Progress::on_terminal("springs tried", o.quiet);
    let effort = o.effort.of(MOST_WORK)?;
    let job = Job::within(&case, &effort, &|done, all, error| {
        progress.tell(done, all, &progress::error(error))
    });
    progress.done();
    let mut job = job?;
    let wanted = !o.no_front && !o.no_record;
    let left_out = wanted && effort.stopped_from_outside();
    if left_out {
        job.not_done.push(NotDone::Front);
    }
    let front = if !wanted || left_out {
        Vec::new()
    } else {
        let progress = Progress::on_terminal("stiffnesses compared", o.quiet);
        let points = stiffness_tradeoff::front(&job, &|done, all| progress.tell(done, all, ""));
        progress.done();
        points
    };

    if o.no_record {
        springs_alone(o, &report::rigid::of_case(&case, Parameters::of(&case, &job)))?;
        return ended(&effort, &o.out);
    }
    let run = RigidRun::new(case, job, front, friction);
    let left_out = save(&run, &o.out, Output { figures: !o.no_figures, report: !o.no_report })?;
    o.print(&run.said(filed(&run, &o.out)), &left_out)?;
    ended(&effort, &o.out)
}

/// Say at once of a restitution at which no springs were measured, before a search of minutes.
fn out_of_reach(case: &Case, quiet: bool) {
    let (asked, body) = (case.restitution, case.structure.body::<f64>());
    let share = asked / body.restitution();
    let (least, most) = MEASURED_SHARES;
    if quiet || (least..=most).contains(&share) {
        return;
    }
    let finding = FiledFinding::from(Finding::RestitutionOutOfReach { asked, share, least, most });
    terminal::stderr(format_args!("warning: {}", finding.line()));
    terminal::stderr(
        "Housner's answer takes any restitution: --time-limit 1 ends the search for springs early",
    );
}

impl RunOptions {
    /// The stiffest springs allowed, if it is given (Hz).
    fn max_hz(&self) -> Result<Option<f64>, CommandError> {
        within("max-hz", self.max_hz, &MAX_HZ)
    }

    /// The error asked for, of histories or of peaks, if one is given.
    fn asked(&self) -> Result<Option<Asked>, CommandError> {
        let accuracy = within("accuracy", self.accuracy, &ACCURACY)?;
        let peaks = within("peaks", self.peaks, &PEAKS)?;
        if let (Some(_), Some(peaks)) = (accuracy, peaks) {
            let remedy = "springs are chosen by --peaks or by --accuracy, and the other is \
                          measured: leave one out";
            return Err(CommandError::option("peaks", peaks, remedy));
        }
        Ok(accuracy.or(peaks).map(|accuracy| Asked::new(accuracy, peaks)))
    }
}

fn within(
    option: &'static str,
    given: Option<f64>,
    limits: &Limits,
) -> Result<Option<f64>, CommandError> {
    let refuse = |(value, remedy)| CommandError::Option { option, value, remedy };
    given.map(|value| limits.check(value).map_err(refuse)).transpose()
}

/// What there is without a record.
fn springs_alone(o: &RunOptions, run: &Run) -> Result<(), CommandError> {
    let files = files();
    let folder = Folder::begin(&o.out, "run", &files, identity(&[&run.parameters, &o.no_report]))?;
    let out = folder.path();
    let json = match &run.parameters {
        FiledParameters::Rigid(parameters) => parameters.to_json(),
        FiledParameters::Elastic(parameters) => parameters.to_json(),
    };
    write_file(&out.join("parameters.json"), json.as_bytes())?;
    write_file(&out.join("parameters.md"), markdown(run).as_bytes())?;
    write_report(out, Output { figures: false, report: !o.no_report }, run, &[])?;
    folder.finish()?;
    terminal::stderr(
        "no record: tune simulate, verify and export take El Centro unless you give them one",
    );
    o.print(run, &[])
}

impl RunOptions {
    /// The screen, or the run as JSON; `--verbose` adds all that the report has. Decks that were
    /// left out are told on it, or on stderr.
    fn print(&self, run: &Run, left_out: &[String]) -> Result<(), CommandError> {
        if self.json {
            left_out.iter().for_each(terminal::stderr);
            return terminal::json(run);
        }
        let folder = terminal::shown(&self.out);
        let decks = run.taken.record.is_some();
        let report = !self.no_report;
        let screen = screen(run, &Written { folder: &folder, report, decks, left_out });
        let more = match self.verbose {
            true => format!("\n{}", markdown(&run.clone().with_decks(left_out))),
            false => String::new(),
        };
        terminal::stdout(format_args!("{screen}{more}"))
    }
}
