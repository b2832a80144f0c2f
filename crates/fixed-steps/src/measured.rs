//! The error of springs in a program with fixed time steps, measured against Housner's history on
//! motions made for the body.

use dynamics::spring::{Chain, Springs};
use rocking::{
    conditioning::Conditioning,
    housner::{RockingOptions, solve},
    motion::nrmse,
    statistics::quantile,
    structure::Body,
    synthetic,
};

use crate::{
    analysis::{FixedStepAnalysis, FixedStepOutcome, StepSettings},
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

/// Motions on which histories of a body can be compared one to one.
#[derive(Clone, Debug)]
pub struct WellConditioned {
    /// The body, with the rotational inertia that both models have.
    pub body: Body<f64>,
    /// Motions that rock it.
    pub motions: Vec<ReferenceHistory>,
}

/// NRMSE of u over the motions.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorsOverMotions {
    /// Of those that went through, in ascending order.
    pub errors: Vec<f64>,
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
        let (p, alpha) = (body.p_squared().sqrt(), body.alpha());
        let options = RockingOptions::default();
        let reference = |index: usize| {
            let record = synthetic::record(seed, index, p, alpha);
            let rocking = solve(body, record.dt, &record.accel, &options);
            let stands = rocking.overturned().is_none() && !rocking.impacts.is_empty();
            let good = stands && Conditioning::new(body, record.dt, &record.accel, &options).well_conditioned();
            good.then(|| ReferenceHistory { dt: record.dt, u: rocking.motion(body).u, accel: record.accel })
        };
        Self { body: *body, motions: (0..looked_at).filter_map(reference).take(count).collect() }
    }

    /// The errors of springs in a program that steps so.
    pub fn errors(&self, springs: &Springs<Chain<f64>>, settings: StepSettings) -> ErrorsOverMotions {
        let model = FixedStepBody::new(&self.body, springs);
        let mut all = ErrorsOverMotions { errors: Vec::new(), stopped: 0, toppled: 0, steps: 0, iterations: 0 };
        for ReferenceHistory { dt, accel, u } in &self.motions {
            let history = FixedStepAnalysis::new(&model, settings, *dt, accel).history();
            all.steps += history.work.steps;
            all.iterations += history.work.iterations;
            match history.outcome {
                FixedStepOutcome::Finished => all.errors.push(nrmse(&history.motion.u, u)),
                FixedStepOutcome::Fallen { .. } => all.toppled += 1,
                FixedStepOutcome::GaveUp(_) => all.stopped += 1,
            }
        }
        all.errors.sort_by(f64::total_cmp);
        all
    }
}

impl ErrorsOverMotions {
    /// A quantile over all motions; those that stopped or toppled are worse than any other.
    pub fn quantile(&self, q: f64) -> f64 {
        let mut all = self.errors.clone();
        all.extend(std::iter::repeat_n(f64::INFINITY, self.stopped + self.toppled));
        quantile(&all, q).unwrap_or(f64::INFINITY)
    }
}
