//! The front: the least error for each stiffness. Accuracy costs stiffness, and with it the engineer's time step.

use super::{
    impulse::{self, Found},
    inner::{FitError, families},
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
/// Samples of the paper's procedure at each point.
const SAMPLES: usize = 48;
/// Steps of the impact objective's descent at each point.
const STEPS: u64 = 8;

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
    let mut near: Option<Found> = None;
    let mut points = Vec::with_capacity(ladder.len());
    for &max_hz in &ladder {
        progress(points.len(), ladder.len());
        let bracket = Bracket { max_hz, max_settlement: case.tuning.max_settlement_m };
        let known = |found: Option<Springs<Design<f64>>>| {
            found.filter(|_| max_hz == case.tuning.max_omega_hz).map(|s| errors(&benchmark, &s))
        };
        let arr = known(Some(job.arr.best.springs)).or_else(|| {
            outer::tune(&benchmark, &job.vertical, &job.horizontal, bracket, SAMPLES, &|_, _, _| {})
                .map(|tuned| errors(&benchmark, &tuned.best.springs))
        });
        let impact = known(job.impact.map(|f| f.springs)).or_else(|| {
            let objective = impulse::Objective::new(&job.body, case.restitution, bracket);
            near = impulse::tune(&objective, &families, near, STEPS);
            near.map(|found| errors(&benchmark, &found.springs))
        });
        points.push(Point { max_hz, impact, arr });
    }
    progress(ladder.len(), ladder.len());
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
