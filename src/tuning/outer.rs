//! The outer loop: Omega_n, vertical and horizontal, by the error of the finite element history against Housner's.
//!
//! ```text
//!  minimise over (Omega_v, Omega_h, families)   J = sum (u - u_H)^2 / sum u_H^2 + sum (v - v_H)^2 / sum v_H^2
//! ```
//!
//! The landscape is rugged: it is sampled first (a low-discrepancy sequence over both frequencies and all pairs of
//! families, in parallel), then the best few samples are refined by Nelder-Mead. A candidate whose running error
//! exceeds the best is abandoned. Batches of fixed size make the answer independent of the number of threads.

use std::ops::ControlFlow;

use argmin::{
    core::{CostFunction, Error, Executor},
    solver::neldermead::NelderMead,
};
use rayon::prelude::*;

use super::inner::Fit;
use crate::{
    fem::{Case, Control, Finish, Outcome, Start, View},
    motion::Motion,
    scalar::GRAVITY,
    spring::{Design, Springs},
    structure::Body,
};

/// Candidates judged against one threshold: more would abandon later, fewer would idle threads.
const BATCH: usize = 16;
/// Samples that are refined.
const REFINED: usize = 2;
/// Evaluations of one refinement.
const REFINEMENTS: u64 = 24;

/// What the histories are compared with.
#[derive(Clone, Copy, Debug)]
pub struct Benchmark<'a> {
    pub body: Body<f64>,
    pub dt: f64,
    /// Ground acceleration over the length compared [m/s2].
    pub accel: &'a [f64],
    /// Housner's motion, sampled at dt.
    pub housner: &'a Motion,
}

/// Where Omega_n may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket {
    /// Stiffest springs [Hz].
    pub max_hz: f64,
    /// Largest settlement of the standing body [m].
    pub max_settlement: f64,
}

/// One evaluated pair of springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    pub springs: Springs<Design<f64>>,
    /// sqrt(J/2), the mean NRMSE of u and v; what it had reached when abandoned.
    pub error: f64,
    pub abandoned: bool,
}

/// What the outer loop found.
#[derive(Clone, Debug)]
pub struct Tuned {
    pub best: Candidate,
    /// Index of the best in `candidates`.
    pub chosen: usize,
    /// Every evaluation, in a fixed order.
    pub candidates: Vec<Candidate>,
}

impl Benchmark<'_> {
    /// The finite element case of these springs.
    pub fn case(&self, springs: &Springs<Design<f64>>, control: Control) -> Case<'_, f64> {
        Case {
            body: self.body,
            springs: springs.chains(self.body.mass),
            start: Start::Settled,
            dt: self.dt,
            accel: self.accel,
            scale: 1.0,
            control,
        }
    }

    /// Mean NRMSE of u and v, sqrt(J/2), abandoned as soon as it exceeds `limit`.
    pub fn error(&self, springs: &Springs<Design<f64>>, limit: f64, control: Control) -> (f64, bool) {
        let square = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().max(f64::MIN_POSITIVE);
        let (su, sv) = (square(&self.housner.u), square(&self.housner.v));
        let case = self.case(springs, control);
        let (mut sum, mut settled) = (0.0, 0.0);
        let finish: Finish<f64> = case.observe(&mut |i: usize, view: &View<f64>| {
            if i == 0 {
                settled = view.z();
            }
            let (Some(&u), Some(&v)) = (self.housner.u.get(i), self.housner.v.get(i)) else {
                return ControlFlow::Break(());
            };
            let (du, dv) = (view.x() - u, view.z() - settled - v);
            sum += du * du / su + dv * dv / sv;
            if sum > 2.0 * limit * limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let error = (0.5 * sum).sqrt();
        match finish.outcome {
            Outcome::Completed => (error, false),
            // toppled or out of work: it has not followed to the end
            Outcome::Overturned { .. } | Outcome::WorkBound { .. } => (f64::INFINITY, false),
            Outcome::Stopped { .. } => (error, error > limit),
        }
    }
}

impl Bracket {
    /// Lowest and highest Omega_n [Hz] of a vertical chain of stiffness ratio K = k2/k1.
    fn vertical(&self, k: f64) -> (f64, f64) {
        // settlement = g/2 (1 + 1/K) / Omega_n^2
        let low = (0.5 * GRAVITY * (1.0 + 1.0 / k) / self.max_settlement).sqrt() / std::f64::consts::TAU;
        (low.max(0.05 * self.max_hz).min(self.max_hz), self.max_hz)
    }

    fn horizontal(&self) -> (f64, f64) {
        (0.05 * self.max_hz, self.max_hz)
    }
}

/// The design of a fit at a frequency.
fn design(fit: &Fit, omega_n_hz: f64) -> Design<f64> {
    Design { mu: fit.mu, f: fit.f, xi: fit.xi, omega_n_hz }
}

/// A pair of families, with frequencies given as fractions 0..1 of their brackets (logarithmic).
#[derive(Clone, Copy)]
struct Pair<'a> {
    vertical: &'a Fit,
    horizontal: &'a Fit,
    bracket: Bracket,
}

impl Pair<'_> {
    fn springs(&self, x: [f64; 2]) -> Springs<Design<f64>> {
        let at = |(low, high): (f64, f64), x: f64| low * (high / low).powf(x.clamp(0.0, 1.0));
        Springs {
            vertical: design(self.vertical, at(self.bracket.vertical(self.vertical.k), x[0])),
            horizontal: design(self.horizontal, at(self.bracket.horizontal(), x[1])),
        }
    }
}

/// Radical inverse of i in a base: a van der Corput sequence.
fn radical_inverse(mut i: usize, base: usize) -> f64 {
    let (mut x, mut digit) = (0.0, 1.0);
    while i > 0 {
        digit /= base as f64;
        x += digit * (i % base) as f64;
        i /= base;
    }
    x
}

/// Tune Omega_n over all pairs of families.
///
/// `progress` is called with the number of evaluations done, the number planned and the least error so far.
pub fn tune(
    benchmark: &Benchmark,
    vertical: &[Fit],
    horizontal: &[Fit],
    bracket: Bracket,
    samples: usize,
    progress: &(dyn Fn(usize, usize, f64) + Sync),
) -> Option<Tuned> {
    let control = Control::search();
    let pairs: Vec<Pair> = vertical
        .iter()
        .flat_map(|vertical| horizontal.iter().map(move |horizontal| Pair { vertical, horizontal, bracket }))
        .collect();
    if pairs.is_empty() {
        return None;
    }
    // stiffer springs follow better as a rule: the square root puts more samples there; the first of each pair is stiffest
    let plan: Vec<(usize, [f64; 2])> = (0..samples.max(pairs.len()))
        .map(|i| {
            let (pair, round) = (i % pairs.len(), i / pairs.len());
            let at = |base| if round == 0 { 1.0 } else { radical_inverse(round, base).sqrt() };
            (pair, [at(2), at(3)])
        })
        .collect();
    let total = plan.len() + REFINED * REFINEMENTS as usize;
    let mut candidates: Vec<Candidate> = Vec::with_capacity(total);
    let mut best = f64::INFINITY;
    for batch in plan.chunks(BATCH) {
        let found: Vec<Candidate> = batch
            .par_iter()
            .map(|&(pair, x)| {
                let springs = pairs[pair].springs(x);
                let (error, abandoned) = benchmark.error(&springs, best, control);
                Candidate { springs, error, abandoned }
            })
            .collect();
        candidates.extend(found);
        best = candidates.iter().filter(|c| !c.abandoned).map(|c| c.error).fold(f64::INFINITY, f64::min);
        progress(candidates.len(), total, best);
    }

    let mut order: Vec<usize> = (0..candidates.len()).filter(|&i| !candidates[i].abandoned).collect();
    order.sort_by(|&a, &b| candidates[a].error.total_cmp(&candidates[b].error).then(a.cmp(&b)));
    let refined: Vec<Vec<Candidate>> = order
        .par_iter()
        .take(REFINED)
        .map(|&i| {
            let (pair, x) = plan[i];
            refine(benchmark, &pairs[pair], x, candidates[i].error, control)
        })
        .collect();
    candidates.extend(refined.into_iter().flatten());
    let chosen = (0..candidates.len())
        .filter(|&i| !candidates[i].abandoned)
        .min_by(|&a, &b| candidates[a].error.total_cmp(&candidates[b].error).then(a.cmp(&b)))?;
    progress(candidates.len(), candidates.len(), candidates[chosen].error);
    Some(Tuned { best: candidates[chosen], chosen, candidates })
}

/// Nelder-Mead from one sample; every evaluation is kept.
fn refine(benchmark: &Benchmark, pair: &Pair, x: [f64; 2], start: f64, control: Control) -> Vec<Candidate> {
    struct Problem<'a> {
        benchmark: &'a Benchmark<'a>,
        pair: &'a Pair<'a>,
        limit: f64,
        control: Control,
        seen: std::sync::Mutex<Vec<Candidate>>,
    }
    impl CostFunction for Problem<'_> {
        type Param = Vec<f64>;
        type Output = f64;
        fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
            let outside: f64 = x.iter().map(|x| (x - x.clamp(0.0, 1.0)).abs()).sum();
            let springs = self.pair.springs([x[0], x[1]]);
            let (error, abandoned) = self.benchmark.error(&springs, self.limit, self.control);
            if let Ok(mut seen) = self.seen.lock() {
                seen.push(Candidate { springs, error, abandoned });
            }
            Ok(error + outside)
        }
    }
    let step = |x: f64, d: f64| if x + d > 1.0 { x - d } else { x + d };
    let simplex = vec![vec![x[0], x[1]], vec![step(x[0], 0.06), x[1]], vec![x[0], step(x[1], 0.06)]];
    // an error well above the start's cannot help, but its size still steers the simplex
    let problem = Problem { benchmark, pair, limit: 2.0 * start, control, seen: Default::default() };
    let run = NelderMead::new(simplex)
        .with_sd_tolerance(1e-7)
        .map(|solver| Executor::new(problem, solver).configure(|state| state.max_iters(REFINEMENTS)).run());
    match run {
        Ok(Ok(mut result)) => result.problem.take_problem().and_then(|p| p.seen.into_inner().ok()).unwrap_or_default(),
        _ => Vec::new(),
    }
}
