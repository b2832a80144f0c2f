//! The outer loop: Omega_n, vertical and horizontal, by the error of the finite element history
//! against Housner's.
//!
//! ```text
//!  minimise over (Omega_v, Omega_h, families)   J = sum (u - u_H)^2 / sum u_H^2 + sum (v - v_H)^2 / sum v_H^2
//! ```
//!
//! The landscape is rugged: it is sampled first (a low-discrepancy sequence over both frequencies
//! and all pairs of families, in parallel), then the best few samples are refined by Nelder-Mead. A
//! candidate whose running error exceeds the best is abandoned. Batches of fixed size make the
//! answer independent of the number of threads.

mod refinement;
mod running_error;
#[cfg(test)]
mod tests;

pub use refinement::Refinement;
use running_error::RunningError;

use crate::SearchProgress;
use dynamics::{
    effort::Effort,
    fem::{Analysis, Control, Finish, HistoryOutcome, histories},
    spring::{Design, Springs},
};
use frequency_response::inner::Fit;
use rocking::{motion::Motion, scalar::GRAVITY, structure::Body};

/// Candidates judged against one threshold: more would abandon later, fewer would idle threads. The
/// first batches, which know no good threshold yet, are smaller.
const BATCH: usize = 16;
const FIRST_BATCH: usize = 2;
/// Candidates of another stiffness that `follow` starts from.
const FOLLOWED: usize = 4;

/// Errors below this are measured again with finer steps.
const CERTAIN: f64 = 2e-3;

/// How candidates are followed first: such steps err by up to 1e-4, a twentieth of [`CERTAIN`].
fn coarse() -> Control {
    Control { long_steps: true, tolerance: 1e-5, ..Control::search() }
}

/// What the histories are compared with.
#[derive(Clone, Copy, Debug)]
pub struct Benchmark<'a> {
    pub body: Body<f64>,
    pub dt: f64,
    /// Ground acceleration over the length compared (m/s2).
    pub accel: &'a [f64],
    /// Its vertical part; empty if there is none.
    pub vertical: &'a [f64],
    /// Housner's motion, sampled at dt.
    pub housner: &'a Motion,
    /// What its histories count to.
    pub effort: &'a Effort,
}

/// Where Omega_n may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket {
    /// Stiffest springs (Hz).
    pub max_hz: f64,
    /// Largest settlement of the standing body (m).
    pub max_settlement: f64,
}

/// One evaluated pair of springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    pub springs: Springs<Design<f64>>,
    /// sqrt(J/2), the mean NRMSE of u and v; of an abandoned candidate, the error up to then.
    pub error: f64,
    /// NRMSE of u alone, as far.
    pub of_u: f64,
    pub abandoned: bool,
}

/// What the outer loop found.
#[derive(Clone, Debug)]
pub struct OmegaSearch {
    pub best: Candidate,
    /// Index of the best in `candidates`.
    pub chosen: usize,
    /// Every evaluation, in a fixed order.
    pub candidates: Vec<Candidate>,
}

impl Benchmark<'_> {
    /// The finite element case of these springs.
    pub(crate) fn case(&self, springs: &Springs<Design<f64>>, control: Control) -> Analysis<'_> {
        Analysis {
            vertical: self.vertical,
            control,
            ..Analysis::new(self.body, springs.chains(self.body.mass), self.dt, self.accel)
        }
    }

    /// Springs with their error, abandoned as soon as it exceeds `limit`; infinite errors of a
    /// history that is not followed to the end. Small errors are measured with finer steps.
    pub fn judge(&self, springs: &Springs<Design<f64>>, limit: f64) -> Candidate {
        let found = self.judge_with(springs, limit, coarse());
        if found.error < CERTAIN {
            self.judge_with(springs, limit, Control::search())
        } else {
            found
        }
    }

    /// The same with steps of one control.
    pub fn judge_with(
        &self,
        springs: &Springs<Design<f64>>,
        limit: f64,
        control: Control,
    ) -> Candidate {
        let mut error = RunningError::new(self.housner, limit);
        let finish = self.case(springs, control).observe(&mut error);
        self.candidate(springs, &error, &finish)
    }

    /// Many springs, each with a limit of its own, side by side: what [`Self::judge`] says of each.
    pub(crate) fn judge_all(&self, all: &[(Springs<Design<f64>>, f64)]) -> Vec<Candidate> {
        let mut found = self.judge_all_with(all, coarse());
        let small: Vec<usize> = (0..all.len()).filter(|&i| found[i].error < CERTAIN).collect();
        let again: Vec<_> = small.iter().map(|&i| all[i]).collect();
        for (i, finer) in small.into_iter().zip(self.judge_all_with(&again, Control::search())) {
            found[i] = finer;
        }
        found
    }

    fn judge_all_with(
        &self,
        all: &[(Springs<Design<f64>>, f64)],
        control: Control,
    ) -> Vec<Candidate> {
        let cases: Vec<Analysis> =
            all.iter().map(|(springs, _)| self.case(springs, control)).collect();
        let followed = histories(&cases, |i| RunningError::new(self.housner, all[i].1));
        let judged = followed.iter().zip(all);
        judged
            .map(|((error, finish), (springs, _))| self.candidate(springs, error, finish))
            .collect()
    }

    /// What a history on these springs is worth.
    fn candidate(
        &self,
        springs: &Springs<Design<f64>>,
        error: &RunningError,
        finish: &Finish,
    ) -> Candidate {
        finish.spend(self.effort);
        let so_far = Candidate {
            springs: *springs,
            error: error.mean(),
            of_u: error.of_u(),
            abandoned: false,
        };
        match finish.outcome {
            HistoryOutcome::Completed => so_far,
            // toppled, out of work or out of balance: it has not followed to the end
            HistoryOutcome::Overturned { .. }
            | HistoryOutcome::WorkBound { .. }
            | HistoryOutcome::Unstable { .. } => {
                Candidate { error: f64::INFINITY, of_u: f64::INFINITY, ..so_far }
            }
            HistoryOutcome::Stopped { .. } => {
                Candidate { abandoned: so_far.error > error.limit, ..so_far }
            }
        }
    }
}

impl Bracket {
    /// Least settlement of a body whose vertical chain has the stiffness ratio K = k2/k1: on the
    /// stiffest springs (m).
    pub(crate) fn least_settlement(&self, k: f64) -> f64 {
        0.5 * GRAVITY * (1.0 + 1.0 / k) / (std::f64::consts::TAU * self.max_hz).powi(2)
    }

    /// Whether a vertical chain of this K can be stiff enough.
    fn allows(&self, k: f64) -> bool {
        self.least_settlement(k) <= self.max_settlement
    }

    /// Lowest and highest Omega_n (Hz) of a vertical chain of stiffness ratio K = k2/k1.
    fn vertical(&self, k: f64) -> (f64, f64) {
        // settlement = g/2 (1 + 1/K) / Omega_n^2
        let low =
            (0.5 * GRAVITY * (1.0 + 1.0 / k) / self.max_settlement).sqrt() / std::f64::consts::TAU;
        (low.max(0.05 * self.max_hz).min(self.max_hz), self.max_hz)
    }

    fn horizontal(&self) -> (f64, f64) {
        (0.05 * self.max_hz, self.max_hz)
    }
}

/// A pair of families, with frequencies given as fractions 0..1 of their brackets (logarithmic).
#[derive(Clone, Copy)]
pub(crate) struct Pair {
    vertical: Design<f64>,
    horizontal: Design<f64>,
    bracket: Bracket,
}

impl Pair {
    fn springs(&self, x: [f64; 2]) -> Springs<Design<f64>> {
        let at = |(low, high): (f64, f64), x: f64| low * (high / low).powf(x.clamp(0.0, 1.0));
        let (vertical, horizontal) = (
            at(self.bracket.vertical(self.vertical.k()), x[0]),
            at(self.bracket.horizontal(), x[1]),
        );
        Springs {
            vertical: Design { omega_n_hz: vertical, ..self.vertical },
            horizontal: Design { omega_n_hz: horizontal, ..self.horizontal },
        }
    }

    /// The pair of these springs, and their fractions.
    fn of(springs: &Springs<Design<f64>>, bracket: Bracket) -> (Self, [f64; 2]) {
        let pair = Self { vertical: springs.vertical, horizontal: springs.horizontal, bracket };
        let at = |(low, high): (f64, f64), hz: f64| {
            if high > low { ((hz / low).ln() / (high / low).ln()).clamp(0.0, 1.0) } else { 1.0 }
        };
        let vertical = at(bracket.vertical(pair.vertical.k()), pair.vertical.omega_n_hz);
        (pair, [vertical, at(bracket.horizontal(), pair.horizontal.omega_n_hz)])
    }
}

/// All pairs of families that can be stiff enough.
pub(crate) fn pairs(vertical: &[Fit], horizontal: &[Fit], bracket: Bracket) -> Vec<Pair> {
    let design =
        |fit: &Fit| Design { mu: fit.mu, f: fit.f, xi: fit.xi, omega_n_hz: bracket.max_hz };
    let pair = |v: &Fit, h: &Fit| Pair { vertical: design(v), horizontal: design(h), bracket };
    let stiff = vertical.iter().filter(|v| bracket.allows(v.k));
    stiff.flat_map(|v| horizontal.iter().map(move |h| pair(v, h))).collect()
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

/// What is judged, in this order.
type SamplePlan = Vec<(Pair, [f64; 2])>;

/// Springs of all pairs of families, sampled over their brackets.
pub(crate) struct Sampled {
    plan: SamplePlan,
    candidates: Vec<Candidate>,
}

impl Sampled {
    /// `samples` of them, or one of each pair: its stiffest. None if no pair can be stiff enough.
    ///
    /// `progress` is called with the number of evaluations done, the number planned with those of
    /// the refinement, and the least error so far.
    pub(crate) fn of(
        benchmark: &Benchmark,
        pairs: &[Pair],
        samples: usize,
        refinement: &Refinement,
        progress: SearchProgress,
    ) -> Option<Self> {
        if pairs.is_empty() {
            return None;
        }
        // stiffer springs follow better as a rule: the square root puts more samples there; the
        // first of each pair is stiffest
        let sample_of = |i: usize| {
            let (pair, round) = (i % pairs.len(), i / pairs.len());
            let at = |base| if round == 0 { 1.0 } else { radical_inverse(round, base).sqrt() };
            (pairs[pair], [at(2), at(3)])
        };
        let plan: SamplePlan = (0..samples.max(pairs.len())).map(sample_of).collect();
        let total = plan.len() + refinement.evaluations();
        let told = |done, best| progress(done, total, best);
        let candidates = sample(benchmark, std::slice::from_ref(&plan), &told);
        Some(Self { plan, candidates: candidates.into_iter().flatten().collect() })
    }

    /// The best few refined, one evaluation after the other; the best of all.
    pub(crate) fn refined(
        self,
        benchmark: &Benchmark,
        refinement: &Refinement,
        progress: SearchProgress,
    ) -> Option<OmegaSearch> {
        let tuned = refinement.best_of(benchmark, &self.plan, self.candidates)?;
        progress(tuned.candidates.len(), tuned.candidates.len(), tuned.best.error);
        Some(tuned)
    }
}

/// Follow springs found for another stiffness (`from_hz`) to these brackets': from the best of
/// them, scaled, and of all pairs of families at their stiffest. In the order of the brackets; none
/// where no pair can be stiff enough.
pub fn follow(
    benchmark: &Benchmark,
    families: [&[Fit]; 2],
    brackets: &[Bracket],
    (found, from_hz): (&OmegaSearch, f64),
    refinement: &Refinement,
) -> Vec<Option<Candidate>> {
    let mut near: Vec<&Candidate> =
        found.candidates.iter().filter(|c| !c.abandoned && c.error.is_finite()).collect();
    near.sort_by(|a, b| a.error.total_cmp(&b.error));
    let plan_of = |bracket: &Bracket| {
        let scale = |c: &&Candidate| {
            let mut springs = c.springs;
            springs.vertical.omega_n_hz *= bracket.max_hz / from_hz;
            springs.horizontal.omega_n_hz *= bracket.max_hz / from_hz;
            Pair::of(&springs, *bracket)
        };
        let stiff = |c: &&&Candidate| bracket.allows(c.springs.vertical.k());
        let mut plan: SamplePlan = near.iter().filter(stiff).take(FOLLOWED).map(scale).collect();
        let [vertical, horizontal] = families;
        plan.extend(pairs(vertical, horizontal, *bracket).into_iter().map(|pair| (pair, [1.0; 2])));
        plan
    };
    let plans: Vec<SamplePlan> = brackets.iter().map(plan_of).collect();
    let sampled = sample(benchmark, &plans, &|_, _| {});
    let both: Vec<(SamplePlan, Vec<Candidate>)> = plans.into_iter().zip(sampled).collect();
    parallel::map(&both, |(plan, candidates)| {
        let tuned = refinement.best_of(benchmark, plan, candidates.clone());
        tuned.map(|tuned| tuned.best)
    })
}

/// Evaluate plans, batch by batch, each with a threshold of its own; `progress` is called with how
/// many are done and the least error so far.
fn sample(
    benchmark: &Benchmark,
    plans: &[SamplePlan],
    progress: &(dyn Fn(usize, f64) + Sync),
) -> Vec<Vec<Candidate>> {
    let mut candidates: Vec<Vec<Candidate>> = plans.iter().map(|_| Vec::new()).collect();
    let mut best = vec![f64::INFINITY; plans.len()];
    let mut size = FIRST_BATCH;
    loop {
        let done = |i: usize| candidates[i].len();
        let stops = benchmark.effort.stops();
        // the first batches are judged whatever they cost
        let next: Vec<(usize, std::ops::Range<usize>)> = (0..plans.len())
            .filter(|&i| done(i) < plans[i].len() && (done(i) < BATCH || !stops))
            .map(|i| (i, done(i)..plans[i].len().min(done(i) + size)))
            .collect();
        if next.is_empty() {
            return candidates;
        }
        let springs = |i: usize, at: usize| {
            let (pair, x) = &plans[i][at];
            (pair.springs(*x), best[i])
        };
        let batch: Vec<_> =
            next.iter().flat_map(|(i, at)| at.clone().map(|at| springs(*i, at))).collect();
        let mut judged = benchmark.judge_all(&batch).into_iter();
        for (i, at) in next {
            candidates[i].extend(judged.by_ref().take(at.len()));
            best[i] = candidates[i]
                .iter()
                .filter(|c| !c.abandoned)
                .map(|c| c.error)
                .fold(f64::INFINITY, f64::min);
        }
        size = (2 * size).min(BATCH);
        let total = candidates.iter().map(Vec::len).sum();
        progress(total, best.iter().copied().fold(f64::INFINITY, f64::min));
    }
}
