//! The exported deck, run in OpenSees, beside our own history and Housner's.

mod program;

use std::{
    fs, io,
    path::Path,
    time::{Duration, Instant},
};

use thiserror::Error;

use crate::{
    export::{Expected, ExportError, export, steps_per_sample, with_inertia},
    housner,
    motion::{Motion, nrmse},
    parameters::Parameters,
    predictability::{moved_by_a_hair, simulate},
    record::Record,
};
pub use program::Program;

/// Wall time a run may take before it counts as hung: this, and a time per step [s].
const PATIENCE: f64 = 120.0;
/// Some 50 times what a step takes.
const PATIENCE_PER_STEP: f64 = 5e-3;

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
    /// NRMSE of u that a relative change of the width by 1e-5 makes in our own history.
    pub hair: f64,
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
    #[error(
        "verify: {command} finds no OpenSees; install it with `pip install opensees`, or name another command with --tcl"
    )]
    NoTcl { command: String },
    #[error(
        "verify: {program} cannot be started ({source}); install Python 3 or name it with --python (a Tcl interpreter with --tcl)"
    )]
    NoProgram { program: String, source: io::Error },
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

/// Run the deck of `parameters` on `record` in `program` and compare. All that the
/// deck writes goes to a temporary folder that is removed. `progress` is told how many seconds of how many OpenSees has done.
///
/// # Errors
/// No such program, no OpenSees in it, an analysis that stops or hangs, no temporary folder.
pub fn verify(
    parameters: &Parameters,
    record: &Record,
    program: &Program,
    progress: &dyn Fn(usize, usize),
) -> Result<Verification, VerifyError> {
    // the same body in all three models
    let parameters = &Parameters { structure: with_inertia(&parameters.structure), ..parameters.clone() };
    let body = parameters.structure.body::<f64>();
    let history = simulate(parameters, record);
    let rocking = housner::solve(&body, record.dt, &record.accel, &housner::Options::default());
    let housner = rocking.motion(&body);

    let hair = moved_by_a_hair(&history.motion, parameters, record);
    let expected = Expected::new(&history, hair);
    let deck = export(parameters, record, &expected, program.format())?;
    let wrap = |path: &Path| {
        let path = path.display().to_string();
        move |source| VerifyError::Folder { path, source }
    };
    let folder = tempfile::tempdir().map_err(wrap(&std::env::temp_dir()))?;
    let path = folder.path().join("deck").with_extension(program.format().ending());
    fs::write(&path, deck).map_err(wrap(&path))?;
    let steps_per_sample = steps_per_sample(parameters, record.dt, hair);
    let steps = (history.motion.len() * steps_per_sample) as f64;
    let began = Instant::now();
    let all = (history.motion.len().saturating_sub(1) as f64 * record.dt) as usize;
    let patience = Duration::from_secs_f64(PATIENCE + PATIENCE_PER_STEP * steps);
    let run = program.run(&path, patience, &|done| progress(done, all))?;
    let seconds = began.elapsed().as_secs_f64();
    let opensees = read_history(&folder.path().join("deck_history.csv"), history.motion.len())?;
    let ours = history.motion;
    Ok(Verification {
        dt: record.dt,
        opensees_against_ours: Agreement::new(&opensees, &ours),
        opensees_against_housner: Agreement::new(&opensees, &housner),
        ours_against_housner: Agreement::new(&ours, &housner),
        opensees,
        ours,
        housner,
        within_one_percent: run.good,
        report: run.report,
        hair,
        seconds,
        steps_per_sample,
    })
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
