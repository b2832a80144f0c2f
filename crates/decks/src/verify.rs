//! The exported deck, run in OpenSees, beside our own history and Housner's.

mod peaks;
mod program;
mod reach;
mod verdict;

use std::{
    fs, io,
    path::Path,
    time::{Duration, Instant},
};

use thiserror::Error;

use crate::{Expected, ExportError, export, foretold_rigid, with_inertia};
use parameters::{
    Parameters,
    predictability::{simulate, slightly_wider, standing_error},
};
pub use peaks::{ComparedPeak, swings};
pub use program::Program;
pub use reach::{AddedInertia, ComparedReach, OwnEnd};
use rocking::{
    housner,
    motion::{Motion, nrmse},
};
use strong_motion::Record;
pub use verdict::{LIMIT, OpenSeesVerdict, Slip};

/// Wall time a run may take before it counts as hung: this, and a time per sample of the record
/// (s).
const PATIENCE: f64 = 120.0;
/// Some hundred times what a sample takes.
const PATIENCE_PER_SAMPLE: f64 = 0.5;
/// Where OpenSees is off, it is asked once more at this share of the accuracy: does it agree with
/// itself?
const FINER: f64 = 1.0 / 16.0;

/// Normalised errors of a motion against another, as [`nrmse`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Of the horizontal displacement of the mass.
    pub u: f64,
    /// Of the vertical one.
    pub v: f64,
    /// Of the rotation.
    pub theta: f64,
}

impl Agreement {
    /// Of `motion` against `reference`, over their common length.
    pub(crate) fn new(motion: &Motion, reference: &Motion) -> Self {
        Self {
            u: nrmse(&motion.u, &reference.u),
            v: nrmse(&motion.v, &reference.v),
            theta: nrmse(&motion.theta, &reference.theta),
        }
    }
}

/// OpenSees in finer steps, asked where it is not within its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FinerSteps {
    /// Accuracy that those steps are to have.
    pub accuracy: f64,
    /// NRMSE of u between OpenSees in the steps judged and in these.
    pub against_itself: f64,
    /// NRMSE of u of these, as the verdict has it.
    pub error: f64,
}

/// Three histories of one case at the record's samples, up to where they can be foretold, and how
/// they agree.
#[derive(Clone, Debug)]
pub struct Verification {
    /// Sampling interval (s).
    pub dt: f64,
    /// The deck's.
    pub opensees: Motion,
    /// Our finite elements'.
    pub ours: Motion,
    /// Housner's, with a tendon and dampers if the body has these.
    pub housner: Motion,
    /// Largest motions of ours and OpenSees'.
    pub peaks: Vec<ComparedPeak>,
    /// How often each went from one foot to the other.
    pub swings: [usize; 2],
    /// The deck's error beside our finite elements.
    pub opensees_against_ours: Agreement,
    /// The deck's error beside Housner, up to where his history counts.
    pub opensees_against_housner: Agreement,
    /// Our finite elements' error beside Housner, up to there.
    pub ours_against_housner: Agreement,
    /// Whether the deck found its peaks within 1 % of ours.
    pub within_one_percent: bool,
    /// Whether OpenSees is within its limit, and how it was judged.
    pub verdict: OpenSeesVerdict,
    /// Up to where histories were compared, and whose body.
    pub reach: ComparedReach,
    /// The same in finer steps, where it is not within its limit and rocks.
    pub finer: Option<FinerSteps>,
    /// What the deck printed.
    pub report: String,
    /// NRMSE of u that a relative change of the width by 1e-5 makes in our own history.
    pub width_sensitivity: f64,
    /// Time OpenSees took (s).
    pub seconds: f64,
    /// Steps that OpenSees took.
    pub steps: usize,
    /// Touches and lifts of a foot that a step met that was too long for them: above zero,
    /// OpenSees' history is in doubt.
    pub late: usize,
}

/// Why a deck could not be verified, and what to do.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum VerifyError {
    #[error(
        "verify: {python} cannot load openseespy; install it with `pip install openseespy` (on \
            Debian also `apt install libblas3 liblapack3`), or name another interpreter with \
            --python"
    )]
    NoOpenSees { python: String },
    #[error(
        "verify: {command} finds no OpenSees; install it with `pip install opensees`, or name \
            another command with --tcl"
    )]
    NoTcl { command: String },
    #[error(
        "verify: {program} cannot be started ({source}); install Python 3 or name it with --python \
            (a Tcl interpreter with --tcl)"
    )]
    NoProgram { program: String, source: io::Error },
    #[error(
        "verify: OpenSees did not end within {seconds:.0} s and was stopped; shorten --duration"
    )]
    Hung { seconds: f64 },
    #[error(
        "verify: {program} ended {how} without a word: it is no interpreter that has OpenSees; \
            name one with --python, or with --tcl"
    )]
    Silent { program: String, how: String },
    #[error("verify: OpenSees stopped ({reason}); {}", after_stop(reason))]
    Stopped { reason: String },
    #[error(
        "verify: {path} is not the history the deck writes ({reason}); run the deck by hand to see \
            why"
    )]
    History { path: String, reason: String },
    #[error("verify: {path}: {source}; check the folder and its permissions")]
    Folder { path: String, source: io::Error },
    #[error(transparent)]
    Export(#[from] ExportError),
}

/// What to do where OpenSees stopped for a reason: of what it lacks the deck tells itself.
fn after_stop(reason: &str) -> &'static str {
    if reason.contains(LACKS) {
        "leave out --tcl, or name an OpenSees of version 3.5 or later"
    } else {
        "try another --duration or stiffer springs"
    }
}

/// What the deck for Tcl says of an OpenSees that is too old for it.
const LACKS: &str = "has no damping objects";

/// Run the deck of `parameters` on `record` in `program` and compare; its steps follow from
/// `accuracy`, a normalised error. `until`: up to when the run found that the motion can be
/// foretold, if that is not all of it (s). All that the deck writes goes to a temporary folder that
/// is removed. `progress` is told how many seconds of how many OpenSees has done.
///
/// # Errors
/// No such program, no OpenSees in it, an analysis that stops or hangs, no temporary folder.
pub fn verify(
    parameters: &Parameters,
    record: &Record,
    (accuracy, until): (f64, Option<f64>),
    program: &Program,
    progress: &dyn Fn(usize, usize),
) -> Result<Verification, VerifyError> {
    // the same body in all three models
    let given = parameters.structure;
    let parameters = &Parameters {
        structure: with_inertia(&parameters.structure, &parameters.members()),
        ..parameters.clone()
    };
    let body = parameters.structure.body::<f64>();
    let history = simulate(parameters, record);
    let options = housner::RockingOptions::on(record, parameters.restitution())
        .with_members(parameters.members());
    let rocking = housner::solve(&body, record.dt, &record.accel, &options);
    let housner = rocking.motion(&body);

    let changed = slightly_wider(parameters, record);
    let width_sensitivity = nrmse(&changed.u, &history.motion.u);
    let foretold = foretold_rigid(parameters, record, [&history.motion, &changed], until);
    let deck = Deck { parameters, record, program, progress };
    // what cannot be foretold is not followed: nothing could be judged by it
    let judged = foretold.map_or(history.motion.len(), |foretold| foretold.samples).max(2);
    let expected = Expected::within(&history, width_sensitivity, judged);
    let run = deck.run(&expected.with_accuracy(accuracy))?;
    let ours = history.motion.first(expected.samples);
    let housner = housner.first(expected.samples);
    let reach = ComparedReach::new(parameters, record, &history, &rocking, expected.samples)
        .beside(&given, parameters, record, &history);
    let counts = housner.first(reach.housner);
    let verdict = OpenSeesVerdict::new(&run.motion, &ours, &body, record.dt, foretold);
    let lifts = !history.landings.is_empty() || history.airborne > 0.0;
    let verdict = match parameters.members().friction.filter(|_| !lifts) {
        Some(_) => verdict.of_slip(&run.motion, &ours),
        None => verdict,
    };
    let finer = match verdict.within || verdict.slip.is_some() {
        true => None,
        false => {
            let accuracy = accuracy * FINER;
            let u = deck.run(&expected.with_accuracy(accuracy))?.motion.u;
            let judged = ..verdict.samples;
            Some(FinerSteps {
                accuracy,
                against_itself: nrmse(&run.motion.u[judged], &u),
                error: standing_error(&u[judged], &ours.u[judged], body.half_width),
            })
        }
    };
    Ok(Verification {
        dt: record.dt,
        peaks: ComparedPeak::rigid(&ours, &run.motion, &body),
        swings: [&ours, &run.motion]
            .map(|motion| swings(&motion.theta, body.half_width.atan2(body.height))),
        opensees_against_ours: Agreement::new(&run.motion, &ours),
        opensees_against_housner: Agreement::new(&run.motion, &counts),
        ours_against_housner: Agreement::new(&ours, &counts),
        reach,
        finer,
        opensees: run.motion,
        ours,
        housner,
        within_one_percent: run.good,
        verdict,
        steps: number_before(&run.report, " steps"),
        late: number_before(&run.report, " touches or lifts"),
        report: run.report,
        width_sensitivity,
        seconds: run.seconds,
    })
}

/// The whole number before these words, zero if they are not there.
pub fn number_before(report: &str, words: &str) -> usize {
    let before = report.split(words).next().filter(|before| before.len() < report.len());
    before.and_then(|before| before.rsplit(' ').next()?.parse().ok()).unwrap_or(0)
}

/// What a deck is made of, and what runs it.
struct Deck<'a> {
    parameters: &'a Parameters,
    record: &'a Record,
    program: &'a Program,
    progress: &'a dyn Fn(usize, usize),
}

/// A deck's run: its history and what it printed.
pub struct DeckRun<T> {
    /// The history.
    pub motion: T,
    /// Whether the deck found its peaks within 1 % of ours.
    pub good: bool,
    /// What the deck printed.
    pub report: String,
    /// Time it took (s).
    pub seconds: f64,
}

/// Run a deck's text that follows so many samples dt (s) apart; `read` takes its history from the
/// file that it writes. All that the deck writes goes to a temporary folder that is removed.
pub fn run_deck<T>(
    text: &str,
    program: &Program,
    (samples, dt): (usize, f64),
    progress: &dyn Fn(usize, usize),
    read: impl FnOnce(&Path) -> Result<T, VerifyError>,
) -> Result<DeckRun<T>, VerifyError> {
    let wrap = |path: &Path| {
        let path = path.display().to_string();
        move |source| VerifyError::Folder { path, source }
    };
    let folder = tempfile::tempdir().map_err(wrap(&std::env::temp_dir()))?;
    let path = folder.path().join("deck").with_extension(program.format().ending());
    fs::write(&path, text).map_err(wrap(&path))?;
    let began = Instant::now();
    let all = (samples.saturating_sub(1) as f64 * dt) as usize;
    let patience = Duration::from_secs_f64(PATIENCE + PATIENCE_PER_SAMPLE * samples as f64);
    let ran = program.run(&path, patience, &|done| progress(done, all))?;
    let seconds = began.elapsed().as_secs_f64();
    let motion = read(&folder.path().join("deck_history.csv"))?;
    Ok(DeckRun { motion, good: ran.good, report: ran.report, seconds })
}

impl Deck<'_> {
    fn run(&self, expected: &Expected) -> Result<DeckRun<Motion>, VerifyError> {
        let text = export(self.parameters, self.record, expected, self.program.format())?;
        let read = |path: &Path| read_history(path, expected.samples);
        run_deck(&text, self.program, (expected.samples, self.record.dt), self.progress, read)
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
