//! `tune run`: the whole job.

use std::{io::Write, path::PathBuf};

use clap::Args;

use super::{
    CommandError,
    common::{self, Both, RecordOptions, history_csv},
    draw::draw,
    export, members,
    output::check_folder,
    progress::Progress,
    report::{Ground, Report},
    table, write_file,
};
use crate::{
    case::{Case, MOST_EVALUATIONS, Objective},
    export::{Expected, with_inertia},
    members::Members,
    parameters::{PaperProcedure, Parameters, RecordRow},
    predictability::{moved_by_a_hair, simulate},
    record::Record,
    tuning::{choice::GOOD, front, impact::report::landings, impulse::Found, job::Job},
};

/// Options of `tune run`.
#[derive(Debug, Args)]
pub struct Options {
    /// Case file (TOML); the paper's A-frame on El Centro unless given
    case: Option<PathBuf>,
    #[command(flatten)]
    record: RecordOptions,
    #[command(flatten)]
    ground: Ground,
    /// Stiffest springs allowed, Omega_n / 2 pi [default: 160, or the case's]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    max_hz: Option<f64>,
    /// Evaluations to spend on a search for springs, some 300 a second [default: 1000 where no springs known have their
    /// landings in order, or the case's]
    #[arg(long, value_name = "N")]
    search: Option<usize>,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    jobs: Option<usize>,
    /// No figures
    #[arg(long)]
    no_figures: bool,
    /// No front of error against stiffness
    #[arg(long)]
    no_front: bool,
    /// No progress
    #[arg(long)]
    quiet: bool,
}

pub fn run(o: &Options) -> Result<(), CommandError> {
    let mut case = match &o.case {
        Some(path) => Case::read(path)?,
        None => Case::paper()?,
    };
    case.record = o.record.record(|| common::of_case(&case))?;
    case.duration_s = o.record.duration(case.duration_s)?;
    if let Some(hz) = o.max_hz {
        if !(0.1..=1e5).contains(&hz) {
            return Err(CommandError::Option {
                option: "max-hz",
                value: format!("{hz:?}"),
                remedy: "give a frequency between 0.1 and 1e5 Hz",
            });
        }
        case.tuning.max_omega_hz = hz;
    }
    if let Some(evaluations) = o.search {
        let refused = |remedy| CommandError::Option { option: "search", value: evaluations.to_string(), remedy };
        if evaluations > MOST_EVALUATIONS {
            return Err(refused("give a number from 0 to 10000000"));
        }
        if evaluations > 0 && case.tuning.objective == Objective::Arr {
            return Err(refused(
                "the paper's procedure has no search: leave it out, or set the case's objective to \"impact\"",
            ));
        }
        case.tuning.search_evaluations = Some(evaluations);
    }
    let friction = o.ground.friction()?;
    check_folder(&o.out)?;
    threads(o.jobs)?;

    let progress = Progress::new("tuning", o.quiet);
    let job = Job::new(&case, &|done, all, error| progress.tell(done, all, &format!("error {error:.4}")));
    progress.done();
    let job = job?;
    let front = if o.no_front {
        Vec::new()
    } else {
        let progress = Progress::new("front", o.quiet);
        let points = front::front(&case, &job, &|done, all| progress.tell(done, all, ""))?;
        progress.done();
        points
    };

    let mut parameters = Parameters::new(case.structure, &job.springs).with_members(case.members);
    let both = common::both(&job.body, case.restitution, &parameters.chains(), &case.members, &job.record);
    if case.restitution != job.body.restitution() {
        parameters.restitution = Some(case.restitution);
    }
    parameters.landings = landings(&job.body, &parameters.chains(), case.restitution);
    parameters.record = Some(RecordRow::new(&case.record));
    parameters.matched = Some(both.matched);
    parameters.match_with_members = both.with.as_ref().map(|with| with.matched);
    if job.impact.is_some() {
        let paper = Parameters::new(case.structure, &job.arr.best.springs);
        let none = Members::default();
        let matched = common::both(&job.body, case.restitution, &paper.chains(), &none, &job.record).matched;
        parameters.paper_procedure =
            Some(PaperProcedure { vertical: paper.vertical, horizontal: paper.horizontal, matched });
    }
    let report = Report::new(&job.body, case.restitution, &job.record, &both.rocking, friction);
    parameters.conditioning = Some(report.sensitivity.into());
    let dt = job.record.dt;

    let write = |e| CommandError::Write { path: o.out.display().to_string(), source: e };
    std::fs::create_dir_all(&o.out).map_err(write)?;
    write_file(&o.out.join("parameters.json"), parameters.to_json().as_bytes())?;
    let forces = members::markdown(&both.demands, both.with.as_ref());
    let tables = table::markdown(&parameters) + &forces + &table::front(&front);
    write_file(&o.out.join("parameters.md"), tables.as_bytes())?;
    write_file(&o.out.join("history.csv"), history_csv(dt, &both).as_bytes())?;
    let demands = both.with.as_ref().map_or(&both.demands, |with| &with.demands);
    write_file(&o.out.join("members.csv"), members::csv(dt, demands).as_bytes())?;
    let (decks, figures) = rayon::join(
        || decks(o, &parameters, &job.record, &both),
        || if o.no_figures { Ok(()) } else { draw(&o.out, &case, &job, &both, &front) },
    );
    decks?;
    figures?;
    let mut said: Vec<String> = report.lines().into_iter().chain(both.early()).collect();
    said.extend(springs_said(&parameters, job.impact.as_ref(), case.tuning.max_omega_hz));
    let (springs, said) = (table::terminal(&parameters), said.join("\n"));
    write!(std::io::stdout(), "{springs}\n{said}\n{forces}{}", table::front_terminal(&front))?;
    eprintln!("written to {}", o.out.display());
    Ok(())
}

/// Error of restitution that is worth a warning.
const RESTITUTION_MISSED: f64 = 0.005;

/// One line each on what these springs promise for other records, and what they cannot do.
fn springs_said(parameters: &Parameters, impact: Option<&Found>, max_hz: f64) -> Vec<String> {
    let mut lines = Vec::new();
    // another restitution than equation 2's weighs otherwise
    if let Some(found) = impact.filter(|_| parameters.restitution.is_none()) {
        let mut line = format!("springs: impact objective {:.3}, about the error to expect on any record", found.error);
        if found.error > GOOD {
            // the error falls as 1/Omega_n
            let hz = 10.0 * (max_hz * found.error / GOOD / 10.0).ceil();
            line += &format!("; springs up to {hz:.0} Hz would bring it to {GOOD} (--max-hz {hz:.0})");
        }
        lines.push(line);
    }
    let errors = || parameters.landings.iter().map(|l| l.restitution_error);
    if errors().any(|e| e.abs() > RESTITUTION_MISSED) {
        let e = parameters.restitution();
        let (low, high) = errors().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        lines.push(format!(
            "springs: WARNING: restitution {e:.4} was asked for, landings have {:.4} to {:.4}; ask for \
             one nearer to equation 2's, or allow stiffer springs",
            e * (1.0 + low),
            e * (1.0 + high)
        ));
    }
    lines
}

/// The model for other programs. A body without rotational inertia gets some there, and its own history to check against.
fn decks(o: &Options, parameters: &Parameters, record: &Record, both: &Both) -> Result<(), CommandError> {
    let folder = o.out.join("decks");
    let structure = with_inertia(&parameters.structure);
    let given = structure == parameters.structure;
    let parameters = Parameters { structure, ..parameters.clone() };
    let own = (!given).then(|| simulate(&parameters, record));
    let history = own.as_ref().unwrap_or_else(|| both.with.as_ref().map_or(&both.fem, |with| &with.history));
    let hair = moved_by_a_hair(&history.motion, &parameters, record);
    export::write_all(&folder, &parameters, record, &Expected::new(history, hair))
}

/// Threads beyond which a machine only starves.
const MOST_THREADS: usize = 1024;

/// Use this many threads, 0 or none: all cores.
pub(super) fn threads(jobs: Option<usize>) -> Result<(), CommandError> {
    if let Some(n) = jobs {
        if n > MOST_THREADS {
            let remedy = "give at most 1024 threads, or 0 for one a core";
            return Err(CommandError::Option { option: "jobs", value: n.to_string(), remedy });
        }
        rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .build_global()
            .map_err(|e| CommandError::Result(format!("--jobs {n}: {e}; give a smaller number of threads")))?;
    }
    Ok(())
}
