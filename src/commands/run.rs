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
    case::{ACCURACY, Case, Objective},
    excitation::Excitation,
    export::{Expected, with_inertia},
    members::Members,
    parameters::{PaperProcedure, Parameters, RecordRow},
    predictability::{moved_by_a_hair, simulate},
    record::Record,
    tuning::{arr::table_1, assessment::Assessment, front, job::Job, whole_model::report::landings},
};

/// Options of `tune run`.
#[derive(Debug, Args)]
pub struct Options {
    /// Case file (TOML); the paper's A-frame on El Centro unless given
    case: Option<PathBuf>,
    #[command(flatten)]
    record: RecordOptions,
    /// Springs from the geometry and the synthetic motions alone: no history, no decks
    #[arg(long, conflicts_with_all = ["record", "dt", "units", "component", "baseline", "vertical", "scale", "duration"])]
    no_record: bool,
    #[command(flatten)]
    ground: Ground,
    /// Stiffest springs allowed, Omega_n / 2 pi, for programs with fixed time steps [default: none, or the case's]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    max_hz: Option<f64>,
    /// Error of the history against Housner's that Omega_n is chosen for, NRMSE [default: 0.002, or the case's]
    #[arg(long, value_name = "ERROR", allow_negative_numbers = true)]
    accuracy: Option<f64>,
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
    if o.no_record {
        if case.tuning.objective == Objective::Arr {
            let remedy = "the paper's procedure tunes on a record; leave one of the two out";
            return Err(CommandError::Option { option: "no-record", value: "objective = \"arr\"".into(), remedy });
        }
        case.set_excitation(Excitation::whole(Record::new("none", 0.01, vec![0.0; 2])?))?;
    } else {
        case.set_excitation(o.record.excitation(|| common::of_case(&case))?)?;
    }
    if let Some(hz) = o.max_hz {
        if !(0.1..=1e6).contains(&hz) {
            return Err(CommandError::Option {
                option: "max-hz",
                value: format!("{hz:?}"),
                remedy: "give a frequency between 0.1 and 1e6 Hz",
            });
        }
        case.tuning.max_omega_hz = Some(hz);
    }
    if let Some(accuracy) = o.accuracy {
        if !(ACCURACY.0..=ACCURACY.1).contains(&accuracy) {
            let remedy = "give an error between 1e-5 and 1, as 0.002";
            return Err(CommandError::Option { option: "accuracy", value: format!("{accuracy:?}"), remedy });
        }
        case.tuning.accuracy = accuracy;
    }
    let friction = o.ground.friction()?;
    check_folder(&o.out)?;
    threads(o.jobs)?;

    let progress = Progress::new("tuning", o.quiet);
    let job = Job::new(&case, &|done, all, error| progress.tell(done, all, &format!("error {error:.2e}")));
    progress.done();
    let job = job?;
    let front = if o.no_front || o.no_record {
        Vec::new()
    } else {
        let progress = Progress::new("front", o.quiet);
        let points = front::front(&job, &|done, all| progress.tell(done, all, ""));
        progress.done();
        points
    };

    let mut parameters = Parameters::new(case.structure, &job.springs).with_members(case.members);
    if case.restitution != job.body.restitution() {
        parameters.restitution = Some(case.restitution);
    }
    parameters.landings = landings(&job.body, &parameters.chains(), case.restitution);
    parameters.assessment = Some(Assessment::new(&job, case.tuning.objective, case.tuning.accuracy));
    if o.no_record {
        return springs_alone(o, &parameters, &front);
    }
    let both = common::both(&job.body, case.restitution, &parameters.chains(), &case.members, &job.record);
    parameters.record = Some(RecordRow::new(&case.excitation, &job.record, &o.out));
    parameters.matched = Some(both.matched);
    parameters.match_with_members = both.with.as_ref().map(|with| with.matched);
    if let Some(paper) = job.paper.as_ref().filter(|_| case.tuning.objective == Objective::Landing) {
        let paper = Parameters::new(case.structure, &paper.tuned.best.springs);
        let none = Members::default();
        let matched = common::both(&job.body, case.restitution, &paper.chains(), &none, &job.record).matched;
        parameters.paper_procedure =
            Some(PaperProcedure { vertical: paper.vertical, horizontal: paper.horizontal, matched });
    }
    if let Some(springs) = table_1::of(&case.structure).filter(|_| job.paper.is_some()) {
        let recovered = Parameters::new(case.structure, &springs);
        let none = Members::default();
        let matched = common::both(&job.body, case.restitution, &recovered.chains(), &none, &job.record).matched;
        parameters.table_1 =
            Some(PaperProcedure { vertical: recovered.vertical, horizontal: recovered.horizontal, matched });
    }
    let report = Report::new(&job.body, case.restitution, &job.record, &both.rocking, friction);
    parameters.conditioning = Some(report.conditioning.into());
    parameters.verdict = Some(both.verdict(&job.body, job.record.dt, &report.conditioning));
    let dt = job.record.dt;

    make_folder(o)?;
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
    let mut said = table::said(&parameters);
    said.extend(report.lines().into_iter().chain(both.early()));
    said.extend(springs_said(&parameters));
    let springs = table::terminal(&parameters);
    write!(std::io::stdout(), "{springs}\n{forces}{}\n{}\n", table::front_terminal(&front), said.join("\n"))?;
    eprintln!("{}\nwritten to {}", case.excitation.line(), o.out.display());
    Ok(())
}

fn make_folder(o: &Options) -> Result<(), CommandError> {
    let write = |e| CommandError::Write { path: o.out.display().to_string(), source: e };
    std::fs::create_dir_all(&o.out).map_err(write)
}

/// What there is without a record: the springs, what they were judged on, the front.
fn springs_alone(o: &Options, parameters: &Parameters, points: &[front::Point]) -> Result<(), CommandError> {
    make_folder(o)?;
    write_file(&o.out.join("parameters.json"), parameters.to_json().as_bytes())?;
    write_file(&o.out.join("parameters.md"), (table::markdown(parameters) + &table::front(points)).as_bytes())?;
    let mut said = table::said(parameters);
    said.extend(springs_said(parameters));
    let springs = table::terminal(parameters);
    write!(std::io::stdout(), "{springs}\n{}\n{}\n", table::front_terminal(points), said.join("\n"))?;
    eprintln!("no record: give one to tune simulate, verify and export\nwritten to {}", o.out.display());
    Ok(())
}

/// Error of restitution that is worth a warning.
const RESTITUTION_MISSED: f64 = 0.005;

/// What these springs cannot do.
fn springs_said(parameters: &Parameters) -> Vec<String> {
    let mut lines = Vec::new();
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
