//! A search for springs in the whole range of all eight parameters, without any record.
//!
//! A foot bounces once more or it does not, so the impact objective is rugged, and a descent ends in the valley that it starts
//! in: the springs to start from decide. CMA-ES (Hansen and Ostermeier, Evolutionary Computation 9, 2001; the crate `cmaes`)
//! crosses such ground. It sets out from the best springs known, and then again and again from the best of random ones, until its
//! evaluations are spent. Most entries of the catalogue were found so.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use cmaes::{CMAESOptions, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::{
    descent::LeastSquares,
    impulse::{Found, Objective, logarithms},
};

/// Points of a generation.
const GENERATION: usize = 14;
/// Random points of which the best is set out from.
const SCATTERED: usize = 100;
/// Step sizes from springs known and from random ones, in logarithms.
const STEP: (f64, f64) = (0.4, 0.5);
/// Generations without news after which a walk ends.
const PATIENCE: usize = 50;
/// Step size at which it ends, in logarithms: one part in five hundred.
const SMALLEST: f64 = 2e-3;
const SEED: u64 = 1963;

/// The ends of all walks of a search of so many `evaluations` of the impact objective. `progress` gets the evaluations done,
/// planned, and the least cost so far.
pub(super) fn search(
    objective: &Objective,
    known: Option<&Found>,
    evaluations: usize,
    progress: &(dyn Fn(usize, usize, f64) + Sync),
) -> Vec<Found> {
    let (low, high) = objective.bounds();
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut start = known.map(|found| (logarithms(&found.springs).to_vec(), STEP.0));
    let mut ends = Vec::new();
    let done = AtomicUsize::new(0);
    // costs are not negative, and the bits of such numbers are in their order
    let least = AtomicU64::new(f64::INFINITY.to_bits());
    let cost = |z: &[f64]| {
        let cost = objective.cost(z);
        let least = f64::from_bits(least.fetch_min(cost.to_bits(), Ordering::Relaxed)).min(cost);
        progress((done.fetch_add(1, Ordering::Relaxed) + 1).min(evaluations), evaluations, least);
        cost
    };
    while done.load(Ordering::Relaxed) < evaluations {
        let (from, step) = start.take().unwrap_or_else(|| {
            let scattered: Vec<Vec<f64>> = (0..SCATTERED)
                .map(|_| low.iter().zip(&high).map(|(&low, &high)| random.random_range(low..=high)).collect())
                .collect();
            let costs: Vec<f64> = scattered.par_iter().with_max_len(1).map(|z| cost(z)).collect();
            let first = (0..SCATTERED).min_by(|&a, &b| costs[a].total_cmp(&costs[b])).unwrap_or(0);
            (scattered[first].clone(), STEP.1)
        });
        let left = evaluations.saturating_sub(done.load(Ordering::Relaxed)).max(1);
        let walk = CMAESOptions::new(from, step)
            .population_size(GENERATION)
            .max_function_evals(left)
            .tol_x(SMALLEST)
            .tol_stagnation(PATIENCE)
            .seed(random.random())
            .build(|z: &DVector<f64>| cost(z.as_slice()));
        // the options are constants that are in order
        let Some(end) = walk.ok().and_then(|mut walk| walk.run_parallel().overall_best) else { break };
        ends.push(objective.at(end.point.as_slice()));
    }
    ends
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{structure::Structure, tuning::outer::Bracket};

    fn wide_frame() -> Objective {
        let body = Structure::a_frame(4.0, 3.2, 1e4).unwrap().body::<f64>();
        Objective::new(&body, body.restitution(), Bracket { max_hz: 160.0, max_settlement: 0.01 })
    }

    /// The springs that a search of so many evaluations finds on so many threads.
    fn found(evaluations: usize, threads: usize, known: Option<&Found>) -> Vec<Found> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| search(&wide_frame(), known, evaluations, &|done, all, _| assert!(done <= all)))
    }

    fn best(found: &[Found]) -> Found {
        *found.iter().min_by(|a, b| a.error.total_cmp(&b.error)).unwrap()
    }

    #[test]
    fn the_same_springs_on_any_number_of_threads() {
        let springs = |threads| found(250, threads, None).iter().map(|f| f.springs).collect::<Vec<_>>();
        let one = springs(1);
        assert!(!one.is_empty());
        assert_eq!(one, springs(3));
    }

    #[test]
    fn it_goes_on_from_springs_known_and_never_spends_more_than_a_generation_too_much() {
        let start = best(&found(150, 2, None));
        let better = best(&found(300, 2, Some(&start)));
        assert!(better.error < 0.8 * start.error, "{} {}", better.error, start.error);
        let spent = AtomicUsize::new(0);
        search(&wide_frame(), Some(&start), 20, &|_, _, _| {
            spent.fetch_add(1, Ordering::Relaxed);
        });
        assert!((20..20 + GENERATION).contains(&spent.into_inner()));
    }
}
