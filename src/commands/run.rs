//! `tune run`: the whole job.

mod elastic;

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use clap::Args;

use super::{
    CommandError,
    common::{self, Both, RecordOptions, history_csv},
    draw::{self, Pictures},
    export, members,
    output::{Folder, check_folder},
    page::Page,
    progress::Progress,
    report::{GroundOptions, HousnerReport},
    table, write_file,
};
use crate::{
    case::{ACCURACY, Case, CaseError, ElasticCase, Limits, MAX_HZ, Objective},
    excitation::Excitation,
    export::{Expected, equal_steps, with_inertia},
    front::{self, FrontPoint},
    members::Members,
    parameters::{PaperProcedure, Parameters, RecordRow},
    predictability::{simulate, width_sensitivity},
    record::Record,
    spring::{Design, Springs},
    tuning::{
        arr::table_1,
        job::Job,
        whole_model::{ATTAINABLE, LEANS, is_another},
    },
};

/// All that `tune run` can write into its folder, beside figures.
const FILES: &[&str] = &[
    "parameters.json",
    "parameters.md",
    "history.csv",
    "members.csv",
    "members_envelopes.csv",
    "report.html",
    "decks/model_openseespy.py",
    "decks/model_opensees.tcl",
    "decks/model_sap2000.s2k",
    "decks/springs.csv",
    "decks/springs.md",
];

fn files() -> Vec<&'static str> {
    [FILES, draw::FILES].concat()
}

/// Options of `tune run`.
#[derive(Debug, Args)]
pub struct RunOptions {
    /// Case file (TOML); the paper's A-frame on El Centro unless given
    case: Option<PathBuf>,
    #[command(flatten)]
    record: RecordOptions,
    /// Springs from the geometry and the synthetic motions alone: no history, no decks
    #[arg(long, conflicts_with_all = ["record", "dt", "units", "component", "baseline", "vertical", "scale", "duration"])]
    no_record: bool,
    #[command(flatten)]
    ground: GroundOptions,
    /// Stiffest springs allowed, as the frequency Omega_n / 2 pi of the mass on a gap spring; for programs with fixed time steps
    /// [default: none, or the case's]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    max_hz: Option<f64>,
    /// Error of the history against Housner's that the stiffness is chosen for: normalised root mean square error, NRMSE [default:
    /// 0.002, or the case's]
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
    /// No report.html
    #[arg(long)]
    no_report: bool,
    /// Do not compute the error over the stiffness (front.png)
    #[arg(long)]
    no_front: bool,
    /// No progress
    #[arg(long)]
    quiet: bool,
}

pub fn run(o: &RunOptions) -> Result<(), CommandError> {
    let mut case = match &o.case {
        Some(path) => {
            let name = path.display().to_string();
            let text =
                std::fs::read_to_string(path).map_err(|source| CaseError::Read { path: name.clone(), source })?;
            if ElasticCase::is(&text) {
                return elastic::run(o, ElasticCase::parse(&name, &text)?);
            }
            Case::parse(&name, &text)?
        }
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
    case.tuning.max_omega_hz = o.max_hz()?.or(case.tuning.max_omega_hz);
    case.tuning.accuracy = o.accuracy()?.unwrap_or(case.tuning.accuracy);
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

    if o.no_record {
        return springs_alone(o, &Parameters::of(&case, &job));
    }
    let run = FinishedRun::new(case, job, front, friction);
    run.save(&o.out, Output { figures: !o.no_figures, report: !o.no_report })?;
    let (springs, forces) = (table::terminal(&run.filed(&o.out)), run.forces());
    let said = run.found().join("\n");
    write!(std::io::stdout(), "{springs}{forces}{}\n{said}\n", table::front_terminal(&run.front))?;
    eprintln!("{}\nwritten to {}", run.case.excitation.line(), o.out.display());
    Ok(())
}

impl RunOptions {
    /// The stiffest springs allowed, if it is given (Hz).
    fn max_hz(&self) -> Result<Option<f64>, CommandError> {
        within("max-hz", self.max_hz, &MAX_HZ)
    }

    /// The accuracy asked for, if it is given.
    fn accuracy(&self) -> Result<Option<f64>, CommandError> {
        within("accuracy", self.accuracy, &ACCURACY)
    }
}

fn within(option: &'static str, given: Option<f64>, limits: &Limits) -> Result<Option<f64>, CommandError> {
    let refuse = |(value, remedy)| CommandError::Option { option, value, remedy };
    given.map(|value| limits.check(value).map_err(refuse)).transpose()
}

/// What to write besides tables and decks.
#[derive(Clone, Copy, Debug)]
pub struct Output {
    pub figures: bool,
    pub report: bool,
}

/// A job done, and all that is said and saved of it.
pub struct FinishedRun {
    pub case: Case,
    pub job: Job,
    pub front: Vec<FrontPoint>,
    /// Both models' answers to the record.
    pub both: Both,
    pub report: HousnerReport,
    /// What `parameters.json` holds, but for the record: where that is to be found depends on the folder.
    pub parameters: Parameters,
}

impl FinishedRun {
    /// Simulate a job's springs, and those of the paper beside them; `friction` of the ground, for the warning of sliding.
    pub fn new(case: Case, job: Job, front: Vec<FrontPoint>, friction: f64) -> Self {
        let beside = |springs: &Springs<Design<f64>>| {
            let other = Parameters::new(case.structure, springs);
            let none = Members::default();
            let matched = common::both(&job.body, case.restitution, &other.chains(), &none, &job.record).matched;
            PaperProcedure { vertical: other.vertical, horizontal: other.horizontal, matched }
        };
        let paper = job.paper.as_ref().filter(|_| case.tuning.objective == Objective::Landing);
        let recovered = table_1::of(&case.structure).filter(|_| job.paper.is_some());
        let chains = Parameters::new(case.structure, &job.springs).chains();
        let ((both, mut parameters), ((paper, recovered), report)) = rayon::join(
            || {
                let both = common::both(&job.body, case.restitution, &chains, &case.members, &job.record);
                (both, Parameters::of(&case, &job))
            },
            || {
                let others = || (paper.map(|paper| beside(&paper.tuned.best.springs)), recovered.map(|r| beside(&r)));
                let report = || HousnerReport::new(&job.body, case.restitution, &job.record, &job.rocking, friction);
                rayon::join(others, report)
            },
        );
        parameters.matched = Some(both.matched);
        parameters.match_with_members = both.with.as_ref().map(|with| with.matched);
        (parameters.paper_procedure, parameters.table_1) = (paper, recovered);
        parameters.conditioning = Some(report.conditioning.into());
        parameters.verdict = Some(both.verdict(&job.body, job.record.dt, &report.conditioning));
        Self { case, job, front, both, report, parameters }
    }

    /// Write everything into a folder, which is made.
    ///
    /// # Errors
    /// A file that cannot be written; a deck or a figure that cannot be made.
    pub fn save(&self, out: &Path, output: Output) -> Result<(), CommandError> {
        let files = files();
        let folder = Folder::begin(out, "run", &files)?;
        let Self { job, front, both, .. } = self;
        let dt = job.record.dt;
        let parameters = self.filed(out);
        write_file(&out.join("parameters.json"), parameters.to_json().as_bytes())?;
        let tables = table::markdown(&parameters) + &self.forces() + &table::front(front);
        write_file(&out.join("parameters.md"), tables.as_bytes())?;
        write_file(&out.join("history.csv"), history_csv(dt, both).as_bytes())?;
        let demands = both.with.as_ref().map_or(&both.demands, |with| &with.demands);
        write_file(&out.join("members.csv"), members::csv(dt, demands).as_bytes())?;
        let (decks, pictures) =
            rayon::join(|| decks(out, &parameters, &job.record, both), || self.pictures(out, &parameters, output));
        decks.and(pictures)?;
        folder.finish()
    }

    /// Figures and the page.
    fn pictures(&self, out: &Path, parameters: &Parameters, output: Output) -> Result<(), CommandError> {
        let Self { case, job, front, both, .. } = self;
        let figures = if output.figures { Pictures { case, job, both, front }.draw()? } else { Vec::new() };
        let page = || report(out, output.report.then_some(Page { parameters, run: Some(self), figures: &figures }));
        let (saved, page) = rayon::join(|| draw::save(out, &figures), page);
        saved.and(page)
    }

    /// `parameters.json` as it stands in a folder.
    fn filed(&self, out: &Path) -> Parameters {
        let record = Some(RecordRow::new(&self.case.excitation, &self.job.record, out));
        Parameters { record, ..self.parameters.clone() }
    }

    /// What to file beside the tables, a line each: an accuracy missed, the verdict, the accuracy, warnings.
    pub fn said(&self) -> Vec<String> {
        let warning = self.parameters.assessment.and_then(|assessment| assessment.warning());
        warning.into_iter().chain(self.found()).collect()
    }

    /// The same without the accuracy missed, with which the tables begin.
    fn found(&self) -> Vec<String> {
        let mut said = table::found(&self.parameters);
        said.extend(self.report.lines().into_iter().chain(self.both.early()));
        said.extend(springs_said(&self.parameters));
        let steps = equal_steps(&self.parameters, &self.job.record);
        if steps > MANY_STEPS {
            said.push(format!(
                "SAP2000: takes all its steps alike, {:.0} million of them for these springs; --max-hz 160 gives springs for it",
                steps as f64 / 1e6
            ));
        }
        said
    }

    fn forces(&self) -> String {
        members::markdown(&self.both.demands, self.both.with.as_ref())
    }
}

/// `report.html`, if it is asked for.
fn report(out: &Path, page: Option<Page<'_>>) -> Result<(), CommandError> {
    page.map_or(Ok(()), |page| write_file(&out.join("report.html"), page.html().as_bytes()))
}

/// What there is without a record.
fn springs_alone(o: &RunOptions, parameters: &Parameters) -> Result<(), CommandError> {
    let files = files();
    let folder = Folder::begin(&o.out, "run", &files)?;
    write_file(&o.out.join("parameters.json"), parameters.to_json().as_bytes())?;
    write_file(&o.out.join("parameters.md"), table::markdown(parameters).as_bytes())?;
    report(&o.out, (!o.no_report).then_some(Page { parameters, run: None, figures: &[] }))?;
    folder.finish()?;
    let mut said = table::found(parameters);
    said.extend(springs_said(parameters));
    write!(std::io::stdout(), "{}\n{}\n", table::terminal(parameters), said.join("\n"))?;
    eprintln!(
        "no record: tune simulate, verify and export take El Centro unless you give them one\nwritten to {}",
        o.out.display()
    );
    Ok(())
}

/// Steps of a program that takes all of them alike that are worth a word.
const MANY_STEPS: usize = 1_000_000;

/// Error of restitution that is worth a warning.
pub(super) const RESTITUTION_MISSED: f64 = 0.005;

/// What these springs cannot do.
fn springs_said(parameters: &Parameters) -> Vec<String> {
    let mut lines = Vec::new();
    let e = parameters.restitution();
    let of_equation_2 = e / parameters.structure.body::<f64>().restitution();
    if !(ATTAINABLE.0..=ATTAINABLE.1).contains(&of_equation_2) {
        lines.push(format!(
            "springs: WARNING: restitution {e:.4} is {of_equation_2:.2} of equation 2's, springs can give {} to {} of it; these will not follow Housner",
            ATTAINABLE.0, ATTAINABLE.1
        ));
    }
    let followed = parameters.landings.len();
    if followed < LEANS.len() {
        lines.push(format!(
            "springs: WARNING: {} of {} landings from {} alpha down to {} alpha came to no end on these springs",
            LEANS.len() - followed,
            LEANS.len(),
            LEANS[0],
            LEANS[LEANS.len() - 1]
        ));
    }
    let errors = || parameters.landings.iter().map(|l| l.restitution_error);
    if errors().any(|e| e.abs() > RESTITUTION_MISSED) {
        let (low, high) = errors().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let another = is_another(&parameters.structure.body(), e);
        lines.push(format!(
            "springs: WARNING: {}, landings have {:.4} to {:.4}; {}allow stiffer springs",
            if another {
                format!("restitution {e:.4} was asked for")
            } else {
                format!("equation 2's restitution is {e:.4}")
            },
            e * (1.0 + low),
            e * (1.0 + high),
            if another { "ask for one nearer to equation 2's, or " } else { "" },
        ));
    }
    lines
}

/// The model for other programs. A body without rotational inertia gets some there, and its own history to check against.
fn decks(out: &Path, parameters: &Parameters, record: &Record, both: &Both) -> Result<(), CommandError> {
    let folder = out.join("decks");
    let structure = with_inertia(&parameters.structure);
    let given = structure == parameters.structure;
    let parameters = Parameters { structure, ..parameters.clone() };
    let own = (!given).then(|| simulate(&parameters, record));
    let history = own.as_ref().unwrap_or_else(|| both.with.as_ref().map_or(&both.fem, |with| &with.history));
    let width_sensitivity = width_sensitivity(&history.motion, &parameters, record);
    let expected = Expected::new(history, width_sensitivity);
    export::write_all(&folder, |format| crate::export::export(&parameters, record, &expected, format))
}

/// Threads beyond which a machine only starves.
const MOST_THREADS: usize = 1024;

/// Use this many threads; none: all cores.
pub(super) fn threads(jobs: Option<usize>) -> Result<(), CommandError> {
    if let Some(n) = jobs {
        if n == 0 {
            let remedy = "give at least one thread, or leave it out for one a core";
            return Err(CommandError::Option { option: "jobs", value: n.to_string(), remedy });
        }
        if n > MOST_THREADS {
            let remedy = "give at most 1024 threads";
            return Err(CommandError::Option { option: "jobs", value: n.to_string(), remedy });
        }
        rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .build_global()
            .map_err(|e| CommandError::Result(format!("--jobs {n}: {e}; give a smaller number of threads")))?;
    }
    Ok(())
}
