//! Stage 2 of the inner fit: the Chebyshev (minimax) refinement by sequential convex steps.
//!
//! ```text
//!  minimise over (d, s)   s + 1/2 d' W d        W = sum lambda_i phi_i'' , its negative part left out
//!  subject to             phi_i + grad phi_i d <= s   for every end and peak i
//!                         low <= z + d <= high,  |d| <= Delta
//! ```
//!
//! Each step is a quadratic program for clarabel, whose duals are the lambda of the next; the peaks
//! are found anew after each step. Two parameters are often held by only two frequencies (both
//! fixed points, or g = 0 and the lower one): the curvature W of the peaks then fixes the rest, and
//! steps without it (W = 0) would only creep.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus,
};
use nalgebra::{Matrix2, Vector2};

use super::certificate::{Problem, follow};
use super::excess::{ExcessPoint, QuadraticModel, SearchParameters, largest};

/// Where the steps ended.
#[derive(Clone, Debug)]
pub(crate) struct Minimum {
    pub z: SearchParameters,
    /// t: the largest excess.
    pub excess: f64,
    pub active: Vec<ExcessPoint>,
    pub multipliers: Vec<f64>,
    /// Convex steps taken.
    pub iterations: usize,
}

/// Steps before giving up; a usual fit takes 5 to 15.
const ITERATIONS: usize = 100;
/// A frequency holds the fit if it has more than this share of the multipliers or of the balance of
/// gradients.
const ACTIVE: f64 = 1e-5;
/// Within this distance of the answer (in ln K, ln C) Newton's method is worth a try.
const NEAR: f64 = 1e-2;

/// The minimum that the steps reach from `start`.
pub(crate) fn minimise(problem: &Problem, start: &SearchParameters) -> Minimum {
    let mut z = problem.region.clamp(start);
    let mut points = problem.points(&z);
    let mut t = largest(&points);
    let mut lambda = softmax(&points, t);
    let mut radius = 0.5;
    let mut iterations = 0;
    while iterations < ITERATIONS {
        iterations += 1;
        let models: Vec<QuadraticModel> =
            points.iter().map(|point| problem.model(point, &z)).collect();
        let w = models.iter().zip(&lambda).map(|(model, &l)| model.curvature * l).sum();
        let Some(step) = convex_step(problem, &z, t, &models, &convex(w), radius) else {
            radius *= 0.25;
            if radius < 1e-12 {
                break;
            }
            continue;
        };
        if step.d.amax() < NEAR {
            let (active, held) = held(&points, &models, &step.lambda);
            if let Some((z, active, multipliers)) = problem.polish(&z, &active, &held) {
                let excess = largest(&problem.points(&z));
                return Minimum { z, excess, active, multipliers, iterations };
            }
        }
        // what the model promises is lost in the rounding of t: there is nothing left to gain
        if step.gain <= 1e-14 || radius < 1e-12 {
            lambda = step.lambda;
            break;
        }
        let mut trial = MinimaxTrial::at(problem, &z, &step.d);
        // Along a curved valley between two peaks the straight step is turned down however short
        // (Maratos); a second step with what the first did to each peak follows the valley.
        if t - trial.t < 0.75 * step.gain {
            let bent = corrected(&models, &points, &trial.points, &step.d);
            if let Some(second) = convex_step(problem, &z, t, &bent, &convex(w), radius) {
                let second = MinimaxTrial::at(problem, &z, &second.d);
                if second.t < trial.t {
                    trial = second;
                }
            }
        }
        let share = (t - trial.t) / step.gain;
        if share > 1e-3 {
            lambda = carried(&points, &step.lambda, &trial.points);
            (z, points, t) = (trial.z, trial.points, trial.t);
        } else {
            lambda = step.lambda;
        }
        radius = match share {
            share if share > 0.75 => (2.0 * radius).min(2.0),
            share if share > 0.1 => radius,
            _ => 0.25 * step.d.amax().min(radius),
        };
    }
    let models: Vec<QuadraticModel> = points.iter().map(|point| problem.model(point, &z)).collect();
    let (active, multipliers) = held(&points, &models, &lambda);
    Minimum { z, excess: t, active, multipliers, iterations }
}

struct MinimaxStep {
    d: Vector2<f64>,
    /// The model's fall of t.
    gain: f64,
    lambda: Vec<f64>,
}

/// Where a step leads.
struct MinimaxTrial {
    z: SearchParameters,
    points: Vec<ExcessPoint>,
    t: f64,
}

impl MinimaxTrial {
    fn at(problem: &Problem, z: &SearchParameters, d: &Vector2<f64>) -> Self {
        let z = problem.region.clamp(&(z + d));
        let points = problem.points(&z);
        let t = largest(&points);
        Self { z, points, t }
    }
}

/// The models with, for each value, what the step d showed that its slope had left out.
fn corrected(
    models: &[QuadraticModel],
    points: &[ExcessPoint],
    after: &[ExcessPoint],
    d: &Vector2<f64>,
) -> Vec<QuadraticModel> {
    let bent = |(model, point): (&QuadraticModel, &ExcessPoint)| match follow(point, after) {
        Some(index) => QuadraticModel { value: after[index].value - model.slope.dot(d), ..*model },
        None => *model,
    };
    models.iter().zip(points).map(bent).collect()
}

/// One convex step, or nothing if the solver did not solve it.
fn convex_step(
    problem: &Problem,
    z: &SearchParameters,
    t: f64,
    models: &[QuadraticModel],
    w: &Matrix2<f64>,
    radius: f64,
) -> Option<MinimaxStep> {
    // rows: a d - s <= t - phi, with s counted from t; then the box
    let mut rows: Vec<[f64; 3]> = Vec::with_capacity(models.len() + 4);
    let mut right = Vec::with_capacity(models.len() + 4);
    let mut of_row = Vec::with_capacity(models.len());
    for (index, model) in models.iter().enumerate().filter(|(_, model)| model.value.is_finite()) {
        rows.push([model.slope[0], model.slope[1], -1.0]);
        right.push(t - model.value);
        of_row.push(index);
    }
    let (down, up) = (z - problem.region.low, problem.region.high - z);
    for j in 0..2 {
        let mut row = [0.0; 3];
        row[j] = 1.0;
        rows.push(row);
        right.push(up[j].min(radius));
        rows.push(row.map(|x| -x));
        right.push(down[j].min(radius));
    }
    let quadratic =
        CscMatrix::from(&[[w[(0, 0)], w[(0, 1)], 0.0], [0.0, w[(1, 1)], 0.0], [0.0, 0.0, 0.0]]);
    let cones = [NonnegativeConeT(rows.len())];
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .max_threads(1)
        .tol_gap_abs(1e-12)
        .tol_gap_rel(1e-12)
        .tol_feas(1e-12)
        .build()
        .ok()?;
    let mut solver = DefaultSolver::new(
        &quadratic,
        &[0.0, 0.0, 1.0],
        &CscMatrix::from(&rows),
        &right,
        &cones,
        settings,
    )
    .ok()?;
    solver.solve();
    // AlmostSolved: short of 1e-12 but within 1e-4; good enough for a step, the polish does the
    // rest
    if !matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved) {
        return None;
    }
    let x = &solver.solution.x;
    let d = Vector2::new(x[0], x[1]);
    let mut lambda = vec![0.0; models.len()];
    of_row.iter().zip(&solver.solution.z).for_each(|(&index, &dual)| lambda[index] = dual.max(0.0));
    Some(MinimaxStep { d, gain: -(x[2] + 0.5 * d.dot(&(w * d))), lambda })
}

/// W without its negative part.
fn convex(w: Matrix2<f64>) -> Matrix2<f64> {
    let eigen = w.symmetric_eigen();
    eigen.eigenvectors
        * Matrix2::from_diagonal(&eigen.eigenvalues.map(|value| value.max(0.0)))
        * eigen.eigenvectors.transpose()
}

/// First guess of the multipliers: by how near each point is to the largest.
fn softmax(points: &[ExcessPoint], t: f64) -> Vec<f64> {
    let weights: Vec<f64> = points.iter().map(|point| (30.0 * (point.value - t)).exp()).collect();
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|weight| weight / sum).collect()
}

/// The multipliers handed on to the points after a step.
fn carried(before: &[ExcessPoint], lambda: &[f64], now: &[ExcessPoint]) -> Vec<f64> {
    let mut out = vec![0.0; now.len()];
    for (point, &l) in before.iter().zip(lambda) {
        if let Some(index) = follow(point, now) {
            out[index] += l;
        }
    }
    out
}

/// The points that hold the fit, and their multipliers, which sum to 1.
fn held(
    points: &[ExcessPoint],
    models: &[QuadraticModel],
    lambda: &[f64],
) -> (Vec<ExcessPoint>, Vec<f64>) {
    let pulls: Vec<f64> =
        models.iter().zip(lambda).map(|(model, &l)| l * model.slope.norm()).collect();
    let pull: f64 = pulls.iter().sum();
    let (active, mut held): (Vec<ExcessPoint>, Vec<f64>) = points
        .iter()
        .zip(lambda)
        .zip(&pulls)
        .filter(|&((_, &l), &p)| l > ACTIVE || p > ACTIVE * pull)
        .map(|((&point, &l), _)| (point, l))
        .unzip();
    let sum: f64 = held.iter().sum();
    held.iter_mut().for_each(|l| *l /= sum);
    (active, held)
}
