//! The exported deck, run in OpenSees, beside our own history and Housner's.

use std::{
    fs, io,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::{Duration, Instant},
};

use thiserror::Error;

use crate::{
    export::{Expected, ExportError, Format, export, steps_per_sample, with_inertia},
    fem::{Case, Control, Start},
    housner,
    motion::{Motion, nrmse},
    parameters::Parameters,
    record::Record,
};

/// Wall time a run may take before it counts as hung: this, and a time per step [s].
const PATIENCE: f64 = 120.0;
/// Some 50 times what a step takes.
const PATIENCE_PER_STEP: f64 = 5e-3;
/// The deck's exit code when openseespy cannot be loaded.
const NO_OPENSEES: i32 = 3;

/// Normalised errors of a motion against another, as [`nrmse`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    pub u: f64,
    pub v: f64,
    pub theta: f64,
}

impl Agreement {
    /// Of `motion` against `reference`, over their common length.
    pub fn new(motion: &Motion, reference: &Motion) -> Self {
        Self {
            u: nrmse(&motion.u, &reference.u),
            v: nrmse(&motion.v, &reference.v),
            theta: nrmse(&motion.theta, &reference.theta),
        }
    }
}

/// Three histories of one case at the record's samples, and how they agree.
#[derive(Clone, Debug)]
pub struct Verification {
    /// Sampling interval [s].
    pub dt: f64,
    pub opensees: Motion,
    pub ours: Motion,
    pub housner: Motion,
    pub opensees_against_ours: Agreement,
    pub opensees_against_housner: Agreement,
    pub ours_against_housner: Agreement,
    /// Whether the deck found its peaks within 1 % of ours.
    pub within_one_percent: bool,
    /// What the deck printed.
    pub report: String,
    /// Time OpenSees took [s].
    pub seconds: f64,
    /// Time steps of OpenSees per sample.
    pub steps_per_sample: usize,
}

/// Why a deck could not be verified, and what to do.
#[derive(Debug, Error)]
pub enum VerifyError {
    #[error(
        "verify: {python} cannot load openseespy; install it with `pip install openseespy` (on Debian also `apt install libblas3 liblapack3`), or name another interpreter with --python"
    )]
    NoOpenSees { python: String },
    #[error("verify: {python} cannot be started ({source}); install Python 3 or name one with --python")]
    NoPython { python: String, source: io::Error },
    #[error("verify: OpenSees did not end within {seconds:.0} s and was stopped; shorten --duration")]
    Hung { seconds: f64 },
    #[error("verify: OpenSees stopped ({reason}); try another --duration or stiffer springs")]
    Stopped { reason: String },
    #[error("verify: {path} is not the history the deck writes ({reason}); run the deck by hand to see why")]
    History { path: String, reason: String },
    #[error("verify: {path}: {source}; check the folder and its permissions")]
    Folder { path: String, source: io::Error },
    #[error(transparent)]
    Export(#[from] ExportError),
}

/// Run the openseespy deck of `parameters` on the first `duration` seconds of `record` [s] and compare.
///
/// The deck and its history stay in `dir` if one is given (it must exist); else they go to a temporary folder that is
/// removed. `python` is the interpreter, `python3` of the path unless given.
///
/// # Errors
/// No Python, no openseespy, an analysis that stops or hangs, a folder that cannot be written.
pub fn verify(
    parameters: &Parameters,
    record: &Record,
    python: Option<&Path>,
    duration: f64,
    dir: Option<&Path>,
) -> Result<Verification, VerifyError> {
    let record = record.truncated(duration);
    // the same body in all three models
    let parameters = &Parameters { structure: with_inertia(&parameters.structure), ..parameters.clone() };
    let body = parameters.structure.body::<f64>();
    let case = Case {
        body,
        springs: parameters.chains(),
        start: Start::Settled,
        dt: record.dt,
        accel: &record.accel,
        scale: 1.0,
        control: Control::default(),
    };
    let history = case.simulate();
    let rocking = housner::solve(&body, record.dt, &record.accel, &housner::Options::default());
    let housner = rocking.motion(&body);

    let deck = export(parameters, &record, &Expected::new(&history), Format::OpenSeesPy, "verify_deck")?;
    let temporary = tempfile::tempdir()
        .map_err(|source| VerifyError::Folder { path: std::env::temp_dir().display().to_string(), source })?;
    let dir = dir.unwrap_or(temporary.path());
    let steps_per_sample = steps_per_sample(parameters, record.dt);
    let steps = (history.motion.len() * steps_per_sample) as f64;
    let mut report = String::new();
    let began = Instant::now();
    let mut within_one_percent = false;
    for path in deck.write(dir)? {
        let patience = Duration::from_secs_f64(PATIENCE + PATIENCE_PER_STEP * steps);
        let run = run(python.unwrap_or(Path::new("python3")), &path, patience)?;
        within_one_percent = run.good;
        report = run.report;
    }
    let seconds = began.elapsed().as_secs_f64();
    let opensees = read_history(&dir.join("verify_deck_history.csv"), history.motion.len())?;
    let ours = history.motion;
    Ok(Verification {
        dt: record.dt,
        opensees_against_ours: Agreement::new(&opensees, &ours),
        opensees_against_housner: Agreement::new(&opensees, &housner),
        ours_against_housner: Agreement::new(&ours, &housner),
        opensees,
        ours,
        housner,
        within_one_percent,
        report,
        seconds,
        steps_per_sample,
    })
}

/// What a deck's run left behind.
struct Ran {
    good: bool,
    report: String,
}

/// Run a deck; its output goes through files, so that no pipe can fill up.
fn run(python: &Path, deck: &Path, patience: Duration) -> Result<Ran, VerifyError> {
    let name = || python.display().to_string();
    let logs = [deck.with_extension("out"), deck.with_extension("err")];
    let folder = |path: &Path| {
        let path = path.display().to_string();
        move |source| VerifyError::Folder { path, source }
    };
    let [out, err] = [&logs[0], &logs[1]].map(|path| fs::File::create(path).map_err(folder(path)));
    let mut child = Command::new(python)
        .arg(deck)
        .stdin(Stdio::null())
        .stdout(out?)
        .stderr(err?)
        .spawn()
        .map_err(|source| VerifyError::NoPython { python: name(), source })?;
    let began = Instant::now();
    let status = loop {
        match child.try_wait() {
            Ok(Some(status)) => break status,
            Ok(None) if began.elapsed() < patience => std::thread::sleep(Duration::from_millis(20)),
            Ok(None) | Err(_) => {
                // it may have ended in between: nothing is lost
                let _ = child.kill();
                let _ = child.wait();
                return Err(VerifyError::Hung { seconds: patience.as_secs_f64() });
            }
        }
    };
    let text = |path: &PathBuf| fs::read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    let report = text(&logs[0]).map_err(folder(&logs[0]))?;
    let complaint = text(&logs[1]).map_err(folder(&logs[1]))?;
    for log in &logs {
        // kept only while running
        let _ = fs::remove_file(log);
    }
    match status.code() {
        Some(code @ (0 | 1)) if report.contains("within 1 %:") => Ok(Ran { good: code == 0, report }),
        Some(NO_OPENSEES) => Err(VerifyError::NoOpenSees { python: name() }),
        _ => {
            let reason = complaint
                .lines()
                .rev()
                .map(str::trim)
                .find(|line| !line.is_empty() && !line.starts_with("Process 0"))
                .unwrap_or("no message");
            Err(VerifyError::Stopped { reason: reason.chars().take(200).collect() })
        }
    }
}

/// Read the deck's history: t, u, v, th.
fn read_history(path: &Path, samples: usize) -> Result<Motion, VerifyError> {
    let bad = |reason: String| VerifyError::History { path: path.display().to_string(), reason };
    let mut reader = csv::Reader::from_path(path).map_err(|e| bad(e.to_string()))?;
    let mut motion = Motion::with_capacity(samples);
    for row in reader.deserialize() {
        let (_, u, v, theta): (f64, f64, f64, f64) = row.map_err(|e| bad(e.to_string()))?;
        motion.push(u, v, theta);
    }
    if motion.len() != samples {
        return Err(bad(format!("{} samples instead of {samples}", motion.len())));
    }
    Ok(motion)
}

#[cfg(test)]
mod tests;
