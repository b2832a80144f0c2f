//! The error of springs in a program with fixed time steps, measured against Housner's history on
//! motions made for the body.

use dynamics::spring::{Chain, Springs};
use rocking::{
    conditioning::Conditioning,
    housner::{RockingOptions, RockingOutcome, solve},
    motion::{largest_magnitude, nrmse},
    statistics::quantile,
    structure::Body,
    synthetic,
};

use crate::{
    analysis::{FixedStepAnalysis, FixedStepOutcome, FixedStepWork, StepSettings},
    rigid::FixedStepBody,
};

/// A motion, and Housner's answer to it.
#[derive(Clone, Debug)]
pub struct ReferenceHistory {
    /// Sampling interval (s).
    pub dt: f64,
    /// Ground acceleration (m/s2).
    pub accel: Vec<f64>,
    /// Displacement of the centre of mass (m).
    pub u: Vec<f64>,
}

/// One history of a program beside Housner's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepErrors {
    /// How it ended; errors are infinite unless it finished.
    pub outcome: FixedStepOutcome,
    /// NRMSE of u.
    pub history: f64,
    /// Error of the largest u, relative to it.
    pub peak: f64,
    /// What it cost.
    pub work: FixedStepWork,
}

impl ReferenceHistory {
    /// Of a motion, if it rocks the body without toppling it; horizontal motion; velocity
    /// restitution, equation 2's if none is given.
    pub fn new(
        body: &Body<f64>,
        restitution: Option<f64>,
        dt: f64,
        accel: Vec<f64>,
    ) -> Option<Self> {
        let options = RockingOptions { restitution, ..RockingOptions::default() };
        let rocking = solve(body, dt, &accel, &options);
        let stands = rocking.outcome == RockingOutcome::Rocked && !rocking.impacts.is_empty();
        stands.then(|| Self { dt, u: rocking.motion(body).u, accel })
    }

    /// The errors of a model in a program that steps so.
    pub fn errors(&self, model: &FixedStepBody, settings: StepSettings) -> StepErrors {
        let history = FixedStepAnalysis::new(model, settings, self.dt, &self.accel).history();
        let (outcome, work) = (history.outcome, history.work);
        if outcome != FixedStepOutcome::Finished {
            return StepErrors { outcome, history: f64::INFINITY, peak: f64::INFINITY, work };
        }
        let (own, due) = (largest_magnitude(&history.motion.u), largest_magnitude(&self.u));
        StepErrors {
            outcome,
            history: nrmse(&history.motion.u, &self.u),
            peak: (own / due - 1.0).abs(),
            work,
        }
    }
}

/// Motions on which histories of a body can be compared one to one.
#[derive(Clone, Debug)]
pub struct WellConditioned {
    /// The body, with the rotational inertia that both models have.
    pub body: Body<f64>,
    /// Motions that rock it.
    pub motions: Vec<ReferenceHistory>,
}

/// Errors over motions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ErrorsOverMotions {
    /// NRMSE of u of those that went through, in ascending order.
    pub errors: Vec<f64>,
    /// Errors of the largest u of the same, in ascending order.
    pub peaks: Vec<f64>,
    /// How many the program gave up.
    pub stopped: usize,
    /// How many toppled the body, which Housner's equation leaves standing.
    pub toppled: usize,
    /// Steps and iterations of all histories.
    pub steps: usize,
    /// Iterations of all histories.
    pub iterations: usize,
}

impl WellConditioned {
    /// The first `count` motions of the suite of a seed that rock a body without toppling it, and
    /// whose history hardly depends on its width, the record's scale and the restitution; of
    /// `looked_at` at most.
    pub fn of_seed(body: &Body<f64>, seed: u64, count: usize, looked_at: usize) -> Self {
        let (p, alpha) = (body.p(), body.alpha());
        let reference = |index: usize| {
            let record = synthetic::record(seed, index, p, alpha);
            let reference = ReferenceHistory::new(body, None, record.dt, record.accel)?;
            let conditioning =
                Conditioning::new(body, reference.dt, &reference.accel, &RockingOptions::default());
            conditioning.well_conditioned().then_some(reference)
        };
        Self { body: *body, motions: (0..looked_at).filter_map(reference).take(count).collect() }
    }

    /// The errors of springs in a program that steps so.
    pub fn errors(&self, springs: &Springs<Chain>, settings: StepSettings) -> ErrorsOverMotions {
        let model = FixedStepBody::new(&self.body, springs);
        ErrorsOverMotions::of(self.motions.iter().map(|motion| motion.errors(&model, settings)))
    }
}

impl ErrorsOverMotions {
    /// Of these histories.
    pub fn of(all: impl IntoIterator<Item = StepErrors>) -> Self {
        let mut found = Self::default();
        for StepErrors { outcome, history, peak, work } in all {
            found.steps += work.steps;
            found.iterations += work.iterations;
            match outcome {
                FixedStepOutcome::Finished => {
                    found.errors.push(history);
                    found.peaks.push(peak);
                }
                FixedStepOutcome::Fallen { .. } => found.toppled += 1,
                FixedStepOutcome::GaveUp(_) => found.stopped += 1,
            }
        }
        found.errors.sort_by(f64::total_cmp);
        found.peaks.sort_by(f64::total_cmp);
        found
    }

    /// How many motions.
    pub fn count(&self) -> usize {
        self.errors.len() + self.lost()
    }

    /// How many stopped or toppled.
    pub fn lost(&self) -> usize {
        self.stopped + self.toppled
    }

    /// A quantile of the NRMSE over all motions; those that stopped or toppled are worse than any
    /// other.
    pub fn quantile(&self, q: f64) -> f64 {
        self.with_lost(&self.errors, q)
    }

    /// The same of the error of the largest u.
    pub fn peak_quantile(&self, q: f64) -> f64 {
        self.with_lost(&self.peaks, q)
    }

    fn with_lost(&self, sorted: &[f64], q: f64) -> f64 {
        let mut all = sorted.to_vec();
        all.extend(std::iter::repeat_n(f64::INFINITY, self.lost()));
        quantile(&all, q).unwrap_or(f64::INFINITY)
    }
}
