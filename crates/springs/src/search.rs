//! Springs for another restitution than equation 2's: a search over all eight parameters on single
//! landings, without any record.
//!
//! Such springs must bounce, and whether a foot bounces once more or not makes the landings rugged
//! in the parameters: a descent ends in the valley that it starts in. CMA-ES ([`cma_es`]) crosses
//! such ground, from the best of random points, again and again until its evaluations are spent.
//!
//! [`cma_es`]: super::cma_es

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::{SearchProgress, cma_es::CmaEs};
use dynamics::effort::Effort;

/// Points of a generation.
const GENERATION: usize = 14;
/// Random points; the walk starts at the best of them.
const SCATTERED: usize = 100;
/// Step size at the start, in logarithms.
const STEP: f64 = 0.5;
/// Generations without a gain after which a walk ends.
const PATIENCE: usize = 50;
/// Step size at which it ends, in logarithms: one part in five hundred.
const SMALLEST: f64 = 2e-3;
const SEED: u64 = 1963;

/// The best end of all walks within the bounds, after so many evaluations of the cost; it ends
/// sooner where a walk's cost is at most `enough`, or the effort stops it. The same on any number
/// of threads. `progress` gets the evaluations done, planned, and the least cost.
pub(super) fn search(
    cost: &(dyn Fn(&[f64]) -> f64 + Sync),
    (low, high): &(Vec<f64>, Vec<f64>),
    evaluations: usize,
    enough: f64,
    effort: &Effort,
    progress: SearchProgress,
) -> Option<Vec<f64>> {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let counted = AtomicUsize::new(0);
    // costs are not negative, and the bits of such numbers are in their order
    let least = AtomicU64::new(f64::INFINITY.to_bits());
    // outside the bounds: the cost at the nearest point inside, and more
    let bounded = |z: &[f64]| {
        let inside: Vec<f64> =
            z.iter().zip(low.iter().zip(high)).map(|(z, (l, h))| z.clamp(*l, *h)).collect();
        let cost = cost(&inside) + inside.iter().zip(z).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        let least = f64::from_bits(least.fetch_min(cost.to_bits(), Ordering::Relaxed)).min(cost);
        progress(
            (counted.fetch_add(1, Ordering::Relaxed) + 1).min(evaluations),
            evaluations,
            least,
        );
        cost
    };
    let mut best: Option<(f64, Vec<f64>)> = None;
    let mut done = 0;
    while done < evaluations && best.as_ref().is_none_or(|(cost, _)| *cost > enough) {
        if best.is_some() && effort.stops() {
            break;
        }
        let scattered: Vec<Vec<f64>> = (0..SCATTERED)
            .map(|_| {
                low.iter().zip(high).map(|(&low, &high)| random.random_range(low..=high)).collect()
            })
            .collect();
        let costs = parallel::map(&scattered, |z| bounded(z));
        let first = (0..SCATTERED).min_by(|&a, &b| costs[a].total_cmp(&costs[b])).unwrap_or(0);
        done += SCATTERED;
        let mut walk = CmaEs::new(&scattered[first], STEP, GENERATION);
        let mut end = (costs[first], scattered[first].clone());
        let mut without_gain = 0;
        // generation by generation: the bound on work is asked for between them
        while done < evaluations
            && end.0 > enough
            && without_gain < PATIENCE
            && walk.width() > SMALLEST
        {
            let points: Vec<_> = (0..GENERATION).map(|_| walk.draw(&mut random)).collect();
            let costs = parallel::map(&points, |z| bounded(z.as_slice()));
            done += GENERATION;
            let mut order: Vec<usize> = (0..GENERATION).collect();
            order.sort_by(|&a, &b| costs[a].total_cmp(&costs[b]));
            without_gain += 1;
            if costs[order[0]] < end.0 {
                end = (costs[order[0]], points[order[0]].as_slice().to_vec());
                without_gain = 0;
            }
            walk.learn(&order.iter().map(|&i| points[i].clone()).collect::<Vec<_>>());
            if effort.stops() {
                break;
            }
        }
        let inside = end.1.iter().zip(low.iter().zip(high)).map(|(z, (l, h))| z.clamp(*l, *h));
        if best.as_ref().is_none_or(|(least, _)| end.0 < *least) {
            best = Some((end.0, inside.collect()));
        }
    }
    best.map(|(_, z)| z)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Many valleys (Rastrigin), the least at 1, 1, 1; a bound at 0.9 in the first direction.
    #[test]
    fn it_finds_the_deepest_of_many_valleys_on_any_number_of_threads() {
        let cost = |z: &[f64]| {
            z.iter()
                .map(|z| {
                    (z - 1.0).powi(2) + 0.3 * (1.0 - (std::f64::consts::TAU * (z - 1.0)).cos())
                })
                .sum::<f64>()
        };
        let bounds = (vec![-4.0; 3], vec![0.9, 4.0, 4.0]);
        let found = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                search(&cost, &bounds, 4000, 0.0, &Effort::unbounded(), &|done, all, _| {
                    assert!(done <= all)
                })
            })
            .unwrap()
        };
        let one = found(1);
        assert_eq!(one, found(3));
        assert!(one.iter().zip([0.9, 1.0, 1.0]).all(|(z, x)| (z - x).abs() < 0.01), "{one:?}");
    }
}
