//! Stage 1 of the inner fit: a smooth stand-in for the largest excess, minimised by L-BFGS with
//! exact gradients.
//!
//! ```text
//!  F(z) = 1/beta ln sum_j exp( beta psi(g_j; z) ),   max psi <= F <= max psi + ln(n)/beta
//! ```
//!
//! The g_j are a fixed grid, and the response's resonances and fixed points, which follow z and so
//! never miss a sharp peak; all are held inside their band. Bounds are mapped away: z = low + (high
//! - low)/(1 + exp(-q)), q free.

use argmin::core::{CostFunction, Error, Executor, Gradient, State};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;
use nalgebra::{SVector, Vector2};
use num_dual::gradient;

use super::excess::{BoundSide, SearchParameters, response};
use crate::bounds::Region;
use rocking::scalar::{Scalar, real};

/// Sharpness: F exceeds the largest psi by at most ln(60)/30 = 0.14, near enough to start the
/// minimax from.
const BETA: f64 = 30.0;
/// The fixed grid: 36 points over these decades of g; the optimum's peaks lie between g = 0.1 and
/// 2.
const GRID: (f64, f64, usize) = (1e-2, 1e2, 36);
/// L-BFGS needs 10 to 20 iterations; more would polish what the minimax replaces.
const ITERATIONS: u64 = 30;

/// The smooth objective at one mu.
pub(crate) struct Smooth<'a> {
    pub curves: &'a [BoundSide],
    pub mu: f64,
    pub region: &'a Region,
}

impl Smooth<'_> {
    /// F(z).
    pub(crate) fn value<S: Scalar>(&self, z: &SVector<S, 2>) -> S {
        let response = response(self.mu, z);
        let ([p, q], [r, s]) = (response.fixed_points(), response.resonances());
        let (low, high, count) = GRID;
        let ratio = (high / low).ln() / (count - 1) as f64;
        let grid = (0..count).map(|i| real::<S>(low * (ratio * i as f64).exp()));
        let frequencies: Vec<S> = [S::zero(), p, q, r, s].into_iter().chain(grid).collect();
        let excess: Vec<S> = self
            .curves
            .iter()
            .flat_map(|curve| frequencies.iter().map(|&g| curve.excess(curve.clamp(g), &response)))
            .collect();
        let top = excess.iter().fold(f64::NEG_INFINITY, |top, psi| top.max(psi.re()));
        let sum = excess
            .iter()
            .fold(S::zero(), |sum, &psi| sum + ((psi - real::<S>(top)) * real::<S>(BETA)).exp());
        sum.ln() * real::<S>(1.0 / BETA) + real::<S>(top)
    }

    fn z<S: Scalar>(&self, q: &SVector<S, 2>) -> SVector<S, 2> {
        SVector::from_fn(|i, _| {
            let (low, high) = (self.region.low[i], self.region.high[i]);
            real::<S>(low) + real::<S>(high - low) / ((-q[i]).exp() + S::one())
        })
    }

    fn q(&self, z: &SearchParameters) -> Vector2<f64> {
        let share = |i: usize| {
            let (low, high) = (self.region.low[i], self.region.high[i]);
            // on a bound q would be infinite; where the bounds meet any q will do
            let share = if high > low { (z[i] - low) / (high - low) } else { 0.5 };
            share.clamp(1e-3, 1.0 - 1e-3)
        };
        Vector2::from_fn(|i, _| (share(i) / (1.0 - share(i))).ln())
    }

    /// The z that L-BFGS reaches from `start`, and its iterations. Where the line search gives up,
    /// what it had.
    pub(crate) fn minimise(&self, start: &SearchParameters) -> (SearchParameters, u64) {
        let solver = LBFGS::new(MoreThuenteLineSearch::new(), 5).with_tolerance_grad(1e-5);
        let start = self.region.clamp(start);
        let Ok(solver) = solver else { return (start, 0) };
        let run = Executor::new(SmoothProblem(self), solver)
            .configure(|state| state.param(self.q(&start)).max_iters(ITERATIONS))
            .run();
        let Ok(run) = run else { return (start, 0) };
        let state = run.state();
        match state.get_best_param() {
            Some(q) if state.get_best_cost().is_finite() => {
                (self.region.clamp(&self.z(q)), state.get_iter())
            }
            _ => (start, state.get_iter()),
        }
    }
}

/// The objective as argmin takes it, in q.
struct SmoothProblem<'a>(&'a Smooth<'a>);

impl CostFunction for SmoothProblem<'_> {
    type Param = Vector2<f64>;
    type Output = f64;

    fn cost(&self, q: &Vector2<f64>) -> Result<f64, Error> {
        Ok(self.0.value(&self.0.z(q)))
    }
}

impl Gradient for SmoothProblem<'_> {
    type Param = Vector2<f64>;
    type Gradient = Vector2<f64>;

    fn gradient(&self, q: &Vector2<f64>) -> Result<Vector2<f64>, Error> {
        Ok(gradient(|q| self.0.value(&self.0.z(&q)), q).1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bounds::Bounds;
    use crate::excess::{curves, largest, points};
    use crate::target::Target;

    #[test]
    fn the_smooth_objective_lies_just_above_the_largest_excess() {
        let curves = curves(&Target::default());
        for mu in [0.01, 1.0, 30.0] {
            let region = Bounds::default().region(mu).unwrap();
            let smooth = Smooth { curves: &curves, mu, region: &region };
            for z in [Vector2::new(-1.0, 0.5), Vector2::new(0.7, 1.2), Vector2::new(3.0, 0.0)] {
                let (value, top) = (smooth.value(&z), largest(&points(&curves, mu, &z)));
                // below only by what a peak rises between grid points, above by ln(41)/30
                assert!(
                    value > top - 0.1 && value < top + 41.0_f64.ln() / BETA,
                    "{mu} {z}: {value} {top}"
                );
            }
        }
    }

    #[test]
    fn its_gradient_agrees_with_differences() {
        let curves = curves(&Target::default());
        let region = Bounds::default().region(2.0).unwrap();
        let smooth = Smooth { curves: &curves, mu: 2.0, region: &region };
        let q = Vector2::new(0.1, 0.02);
        let value = |q: Vector2<f64>| smooth.value(&smooth.z(&q));
        let (_, slope) = gradient(|q| smooth.value(&smooth.z(&q)), &q);
        for j in 0..2 {
            // five points, h = 1e-3: error of order h^4 = 1e-12 times F's fifth derivative,
            // rounding 1e-13
            let at = |steps: f64| value(q + Vector2::ith(j, 1e-3 * steps));
            let difference = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / 12e-3;
            assert!(
                (slope[j] - difference).abs() < 1e-8 * slope.norm(),
                "{} {difference}",
                slope[j]
            );
        }
    }
}
