//! Least squares within bounds: Gauss-Newton steps in a trust region, each a quadratic programme.
//!
//! ```text
//!  minimise |r + J d|^2   subject to   low <= z + d <= high,  |d_i| <= Delta,  settlement(z) + its gradient d <= limit
//! ```
//!
//! argmin keeps the iteration and its best point; clarabel solves the programme; J comes from
//! central differences and costs two values a parameter. So after a step J is kept and updated
//! (Broyden, Mathematics of Computation 19, 1965): J += (dr - J d) d' / d'd. It is taken anew when
//! that no longer gains.

use argmin::core::{
    CostFunction, Error, Executor, IterState, Jacobian, KV, Problem, Solver, State,
    TerminationReason, TerminationStatus,
};
use clarabel::{
    algebra::CscMatrix,
    solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus},
};

/// A bounded least-squares problem.
pub(crate) trait LeastSquares {
    /// Residuals at z.
    fn residuals(&self, z: &[f64]) -> Vec<f64>;
    /// Residuals and their gradients, one row a residual.
    fn gradients(&self, z: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>);
    /// Lower and upper bound of every parameter.
    fn bounds(&self) -> (Vec<f64>, Vec<f64>);
    /// A linearised inequality g(z) + row d <= 0, if there is one.
    fn inequality(&self, z: &[f64]) -> Option<(f64, Vec<f64>)>;
    /// Whether to take no further step, however good it may be.
    fn stops(&self) -> bool {
        false
    }
}

/// Where the descent ended.
#[derive(Clone, Debug)]
pub(crate) struct Descent {
    pub z: Vec<f64>,
    /// sqrt(sum r^2).
    pub error: f64,
}

struct Adapter<'a, P>(&'a P);

impl<P: LeastSquares> CostFunction for Adapter<'_, P> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, z: &Vec<f64>) -> Result<f64, Error> {
        Ok(sum_of_squares(&self.0.residuals(z)))
    }
}

impl<P: LeastSquares> Jacobian for Adapter<'_, P> {
    type Param = Vec<f64>;
    type Jacobian = (Vec<f64>, Vec<Vec<f64>>);
    fn jacobian(&self, z: &Vec<f64>) -> Result<Self::Jacobian, Error> {
        Ok(self.0.gradients(z))
    }
}

fn sum_of_squares(r: &[f64]) -> f64 {
    r.iter().map(|r| r * r).sum()
}

/// Residuals, and a matrix that may be a few steps old.
struct ResidualModel {
    r: Vec<f64>,
    j: Vec<Vec<f64>>,
    fresh: bool,
}

impl ResidualModel {
    /// Learn from residuals `r` found a step d away.
    fn moved(&mut self, d: &[f64], r: Vec<f64>) {
        let square = sum_of_squares(d);
        for (row, (new, old)) in self.j.iter_mut().zip(r.iter().zip(&self.r)) {
            let expected: f64 = row.iter().zip(d).map(|(j, d)| j * d).sum();
            let missed = (new - old - expected) / square;
            if missed.is_finite() {
                row.iter_mut().zip(d).for_each(|(j, d)| *j += missed * d);
            }
        }
        (self.r, self.fresh) = (r, false);
    }
}

/// The trust-region iteration, as an argmin solver.
struct TrustRegion<'a, P> {
    problem: &'a P,
    radius: f64,
    model: Option<ResidualModel>,
}

/// Smallest trust region worth another step (logarithms of the parameters).
const SMALLEST: f64 = 4e-3;
/// Relative gain of a step (sum of squares) below which it counts as none.
const GAIN: f64 = 2e-3;

type Iterate = IterState<Vec<f64>, (), (), (), (), f64>;

impl<P: LeastSquares> Solver<Adapter<'_, P>, Iterate> for TrustRegion<'_, P> {
    fn name(&self) -> &str {
        "Gauss-Newton in a trust region"
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<Adapter<'_, P>>,
        state: Iterate,
    ) -> Result<(Iterate, Option<KV>), Error> {
        let z = state.get_param().cloned().unwrap_or_default();
        let mut model = match self.model.take() {
            Some(model) => model,
            None => {
                let (r, j) = problem.jacobian(&z)?;
                ResidualModel { r, j, fresh: true }
            }
        };
        let now = sum_of_squares(&model.r);
        let mut best = (now, z.clone());
        // a new Jacobian is expensive, another trial step is cheap: shrink the region until a step
        // gains
        for _ in 0..if model.fresh { 4 } else { 1 } {
            let Some(d) = programme(self.problem, &z, &model.r, &model.j, self.radius) else {
                self.radius *= 0.25;
                continue;
            };
            let trial: Vec<f64> = z.iter().zip(&d).map(|(z, d)| z + d).collect();
            let r = problem.problem("cost_count", |p| Ok(p.0.residuals(&trial)))?;
            let cost = sum_of_squares(&r);
            let length = d.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
            if cost < best.0 {
                if cost < (1.0 - GAIN) * now && length > 0.9 * self.radius {
                    self.radius = (2.0 * self.radius).min(1.0);
                }
                best = (cost, trial);
                model.moved(&d, r);
                break;
            }
            if model.fresh {
                self.radius = 0.3 * length.min(self.radius);
            }
        }
        if best.0 > (1.0 - GAIN) * now {
            // no gain to speak of: an old matrix is at fault, or else the region
            if model.fresh || best.0 < now {
                self.radius *= 0.5;
            }
        } else {
            self.model = Some(model);
        }
        Ok((state.param(best.1).cost(best.0), None))
    }

    fn terminate(&mut self, _: &Iterate) -> TerminationStatus {
        if self.radius < SMALLEST || self.problem.stops() {
            TerminationStatus::Terminated(TerminationReason::SolverConverged)
        } else {
            TerminationStatus::NotTerminated
        }
    }
}

/// Descend from z for at most `iterations`.
pub(crate) fn descend<P: LeastSquares>(
    problem: &P,
    z: &[f64],
    radius: f64,
    iterations: u64,
) -> Descent {
    let (low, high) = problem.bounds();
    let start: Vec<f64> =
        z.iter().zip(low.iter().zip(&high)).map(|(z, (l, h))| z.clamp(*l, *h)).collect();
    let stuck = |z: Vec<f64>| {
        let error = sum_of_squares(&problem.residuals(&z)).sqrt();
        Descent { z, error }
    };
    let solver = TrustRegion { problem, radius, model: None };
    let run = Executor::new(Adapter(problem), solver)
        .configure(|state: Iterate| state.param(start.clone()).max_iters(iterations))
        .run();
    match run {
        Ok(result) => match result.state().get_best_param() {
            Some(z) => Descent { z: z.clone(), error: result.state().get_best_cost().sqrt() },
            None => stuck(start),
        },
        Err(_) => stuck(start),
    }
}

/// The step's quadratic programme; `None` unless solved.
fn programme<P: LeastSquares>(
    problem: &P,
    z: &[f64],
    r: &[f64],
    j: &[Vec<f64>],
    radius: f64,
) -> Option<Vec<f64>> {
    let n = z.len();
    let (low, high) = problem.bounds();
    let mut hessian = vec![vec![0.0; n]; n];
    let mut gradient = vec![0.0; n];
    for (r, row) in r.iter().zip(j) {
        for a in 0..n {
            gradient[a] += r * row[a];
            for b in a..n {
                hessian[a][b] += row[a] * row[b];
            }
        }
    }
    let scale = (0..n).map(|a| hessian[a][a]).fold(0.0, f64::max);
    if !(scale.is_finite() && scale > 0.0) {
        return None;
    }
    for (a, row) in hessian.iter_mut().enumerate() {
        row[a] += 1e-8 * scale;
        row.iter_mut().for_each(|x| *x /= scale);
    }
    gradient.iter_mut().for_each(|x| *x /= scale);

    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut limits: Vec<f64> = Vec::new();
    for a in 0..n {
        let mut unit = vec![0.0; n];
        unit[a] = 1.0;
        limits.push((high[a] - z[a]).min(radius).max(0.0));
        rows.push(unit.clone());
        unit[a] = -1.0;
        limits.push((z[a] - low[a]).min(radius).max(0.0));
        rows.push(unit);
    }
    if let Some((value, row)) = problem.inequality(z) {
        // a start beyond the limit may take several steps to come within it
        let reach = radius * row.iter().map(|x| x.abs()).sum::<f64>();
        limits.push((-value).max(-0.5 * reach));
        rows.push(row);
    }
    let p: Vec<Vec<f64>> = hessian;
    let p = CscMatrix::from(p.iter()).to_triu();
    let a = CscMatrix::from(rows.iter());
    let settings = DefaultSettings { verbose: false, ..Default::default() };
    let cones = [NonnegativeConeT(limits.len())];
    let mut solver = DefaultSolver::new(&p, &gradient, &a, &limits, &cones, settings).ok()?;
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => Some(solver.solution.x.clone()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley as least squares, with an upper bound on x.
    struct Valley {
        high: f64,
    }

    impl LeastSquares for Valley {
        fn residuals(&self, z: &[f64]) -> Vec<f64> {
            vec![10.0 * (z[1] - z[0] * z[0]), 1.0 - z[0]]
        }
        fn gradients(&self, z: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
            (self.residuals(z), vec![vec![-20.0 * z[0], 10.0], vec![-1.0, 0.0]])
        }
        fn bounds(&self) -> (Vec<f64>, Vec<f64>) {
            (vec![-2.0, -2.0], vec![self.high, 2.0])
        }
        fn inequality(&self, _: &[f64]) -> Option<(f64, Vec<f64>)> {
            None
        }
    }

    #[test]
    fn it_walks_down_rosenbrocks_valley() {
        let end = descend(&Valley { high: 2.0 }, &[-1.2, 1.0], 0.5, 100);
        assert!(end.error < 1e-6, "{end:?}");
    }

    #[test]
    fn it_stops_at_a_bound_where_the_minimum_lies_there() {
        let end = descend(&Valley { high: 0.5 }, &[-1.2, 1.0], 0.5, 200);
        assert!((end.z[0] - 0.5).abs() < 1e-6 && (end.error - 0.5).abs() < 1e-5, "{end:?}");
    }
}
