//! The front: the least error for each stiffness. Accuracy costs stiffness, and with it the engineer's time step.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::{
    impulse::{self, Effort},
    arr::inner::{FitError, families},
    job::Job,
    outer::{self, Benchmark, Bracket},
};
use crate::{
    case::Case,
    fem::Control,
    motion::nrmse,
    spring::{Design, Springs},
};

/// Stiffest springs of the front's points [Hz]; the case's own limit is added.
const LADDER_HZ: [f64; 6] = [40.0, 80.0, 160.0, 320.0, 640.0, 1280.0];
/// Of the impact objective, at each point.
const EFFORT: Effort = Effort { tried: 4, followed: 1, iterations: 4, content: true };

/// Springs of one point and their errors on the case's record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    pub springs: Springs<Design<f64>>,
    pub nrmse_u: f64,
    pub nrmse_v: f64,
}

/// One point of the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Stiffest springs allowed [Hz].
    pub max_hz: f64,
    /// The impact objective's springs.
    pub impact: Option<Errors>,
    /// The paper's procedure.
    pub arr: Option<Errors>,
}

/// The front of a job's case.
pub fn front(case: &Case, job: &Job, progress: &(dyn Fn(usize, usize) + Sync)) -> Result<Vec<Point>, FitError> {
    let families = families(&super::job::FAMILIES)?;
    let mut ladder = LADDER_HZ.to_vec();
    if !ladder.contains(&case.tuning.max_omega_hz) {
        ladder.push(case.tuning.max_omega_hz);
        ladder.sort_by(f64::total_cmp);
    }
    let benchmark = Benchmark { body: job.body, dt: job.record.dt, accel: &job.record.accel, housner: &job.housner };
    let done = AtomicUsize::new(0);
    progress(0, ladder.len());
    let points = ladder
        .par_iter()
        .with_max_len(1)
        .map(|&max_hz| {
            let bracket = Bracket { max_hz, max_settlement: case.tuning.max_settlement_m };
            let known = |found: Option<Springs<Design<f64>>>| found.filter(|_| max_hz == case.tuning.max_omega_hz);
            let paper = || {
                known(Some(job.arr.best.springs)).or_else(|| {
                    let from = case.tuning.max_omega_hz;
                    outer::follow(&benchmark, &job.vertical, &job.horizontal, bracket, &job.arr, from)
                        .map(|best| best.springs)
                })
            };
            let ours = || {
                known(job.impact.map(|f| f.springs)).or_else(|| {
                    let objective = impulse::Objective::new(&job.body, case.restitution, bracket);
                    let proposals = impulse::proposals(&objective, &families, EFFORT);
                    // where the record does not decide, its front says little, and many histories a point are dear
                    let found = match job.choice.by_record() {
                        true => job.choice.of_history(&proposals),
                        false => impulse::in_order_first(&proposals).next().copied(),
                    };
                    found.map(|found| found.springs)
                })
            };
            let (arr, impact) = rayon::join(paper, ours);
            let judge = |found: Option<Springs<Design<f64>>>| found.map(|s| errors(&benchmark, &s));
            let point = Point { max_hz, impact: judge(impact), arr: judge(arr) };
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, ladder.len());
            point
        })
        .collect();
    Ok(points)
}

fn errors(benchmark: &Benchmark, springs: &Springs<Design<f64>>) -> Errors {
    let fem = benchmark.case(springs, Control::search()).simulate();
    let whole = fem.motion.len() >= benchmark.housner.len();
    let error = |x: &[f64], reference: &[f64]| if whole { nrmse(x, reference) } else { f64::INFINITY };
    Errors {
        springs: *springs,
        nrmse_u: error(&fem.motion.u, &benchmark.housner.u),
        nrmse_v: error(&fem.motion.v, &benchmark.housner.v),
    }
}
