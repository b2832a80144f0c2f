//! The best few samples of a plan, refined by Nelder-Mead.

use argmin::{
    core::{CostFunction, Error, Executor},
    solver::neldermead::NelderMead,
};
use nalgebra::Vector2;

use super::{Benchmark, Candidate, OmegaSearch, Pair};
use dynamics::{effort::Effort, fem::Control};

/// How far samples are refined.
#[derive(Clone, Copy, Debug)]
pub struct Refinement {
    /// How many of them.
    samples: usize,
    /// Iterations of each.
    iterations: u64,
    /// Spread of the errors of a simplex, over the sample's, at which it ends; `LEAST_SPREAD` at
    /// least.
    spread: f64,
}

/// Spread of the errors of a simplex at which it ends at the latest.
const LEAST_SPREAD: f64 = 1e-7;

impl Refinement {
    /// Of the springs that a user asks for.
    pub(crate) const SOUGHT: Self = Self { samples: 2, iterations: 24, spread: 0.0 };
    /// Of the springs beside those from the geometry: to three digits of the error, which is all
    /// that is compared.
    pub(crate) const COMPARED: Self = Self { samples: 1, iterations: 24, spread: 1e-3 };
    /// Of springs that follow those of another stiffness.
    pub(crate) const FOLLOWING: Self = Self { samples: 1, iterations: 10, spread: 0.0 };
    /// The same to two digits of the error, for a figure.
    pub const DRAWN: Self = Self { spread: 1e-2, ..Self::FOLLOWING };

    /// Evaluations that are planned.
    pub(super) fn evaluations(&self) -> usize {
        self.samples * self.iterations as usize
    }

    /// Refine the best few candidates of a plan; the best of all.
    pub(super) fn best_of(
        &self,
        benchmark: &Benchmark,
        plan: &[(Pair, [f64; 2])],
        mut candidates: Vec<Candidate>,
    ) -> Option<OmegaSearch> {
        let mut order: Vec<usize> =
            (0..candidates.len()).filter(|&i| !candidates[i].abandoned).collect();
        order.sort_by(|&a, &b| candidates[a].error.total_cmp(&candidates[b].error).then(a.cmp(&b)));
        let effort = benchmark.effort;
        let shares: Vec<(usize, Effort)> = match effort.stopped() {
            true => Vec::new(),
            false => order
                .iter()
                .take(self.samples)
                .map(|&i| (i, effort.share(self.samples as u64)))
                .collect(),
        };
        let refined: Vec<Vec<Candidate>> = parallel::map(&shares, |(i, share)| {
            let (pair, x) = &plan[*i];
            let benchmark = Benchmark { effort: share, ..*benchmark };
            self.refine(&benchmark, pair, *x, candidates[*i])
        });
        shares.iter().for_each(|(_, share)| effort.join(share));
        candidates.extend(refined.into_iter().flatten());
        let chosen = (0..candidates.len())
            .filter(|&i| !candidates[i].abandoned)
            .min_by(|&a, &b| candidates[a].error.total_cmp(&candidates[b].error).then(a.cmp(&b)))?;
        // what is told of the best is measured with fine steps
        let springs = candidates[chosen].springs;
        candidates[chosen] = benchmark.judge_with(&springs, f64::INFINITY, Control::search());
        Some(OmegaSearch { best: candidates[chosen], chosen, candidates })
    }

    /// Nelder-Mead from one sample, which was judged at its place x; every evaluation is kept.
    fn refine(
        &self,
        benchmark: &Benchmark,
        pair: &Pair,
        x: [f64; 2],
        sample: Candidate,
    ) -> Vec<Candidate> {
        struct OuterProblem<'a> {
            benchmark: &'a Benchmark<'a>,
            pair: &'a Pair,
            /// Corners of the first simplex.
            judged: [Candidate; 3],
            limit: f64,
            seen: std::sync::Mutex<Vec<Candidate>>,
        }
        impl CostFunction for OuterProblem<'_> {
            type Param = Vector2<f64>;
            type Output = f64;
            fn cost(&self, x: &Vector2<f64>) -> Result<f64, Error> {
                let outside: f64 = x.iter().map(|x| (x - x.clamp(0.0, 1.0)).abs()).sum();
                let springs = self.pair.springs([x[0], x[1]]);
                if self.benchmark.effort.stops() {
                    // what was not followed leads nowhere
                    return Ok(f64::MAX);
                }
                let known = self.judged.iter().find(|judged| judged.springs == springs);
                let judged =
                    known.copied().unwrap_or_else(|| self.benchmark.judge(&springs, self.limit));
                if let Ok(mut seen) = self.seen.lock() {
                    seen.push(judged);
                }
                Ok(judged.error + outside)
            }
        }
        let step = |x: f64, d: f64| if x + d > 1.0 { x - d } else { x + d };
        let corners = [x, [step(x[0], 0.06), x[1]], [x[0], step(x[1], 0.06)]];
        // an error well above the start's cannot help, but its size still steers the simplex
        let limit = 2.0 * sample.error;
        let judge = |x: [f64; 2]| benchmark.judge(&pair.springs(x), limit);
        let (second, third) = parallel::join(|| judge(corners[1]), || judge(corners[2]));
        let judged = [sample, second, third];
        let simplex = corners.map(Vector2::from).to_vec();
        let problem = OuterProblem { benchmark, pair, judged, limit, seen: Default::default() };
        let spread = LEAST_SPREAD.max(self.spread * sample.error);
        let run = NelderMead::new(simplex).with_sd_tolerance(spread).map(|solver| {
            Executor::new(problem, solver).configure(|state| state.max_iters(self.iterations)).run()
        });
        match run {
            Ok(Ok(mut result)) => result
                .problem
                .take_problem()
                .and_then(|p| p.seen.into_inner().ok())
                .unwrap_or_default(),
            _ => Vec::new(),
        }
    }
}
