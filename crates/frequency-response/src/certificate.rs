//! The first-order proof that a fit cannot be bettered nearby, and the Newton iteration that makes
//! it exact.
//!
//! At a minimum of t(z) = max phi_i(z) in the box there are multipliers lambda_i >= 0 of the active
//! points (phi_i = t) and nu of the active bounds with
//!
//! ```text
//!  sum lambda_i = 1,   sum lambda_i grad phi_i = nu_low - nu_high
//! ```
//!
//! The convex steps of the minimax give the active points and multipliers to the interior-point
//! solver's tolerance; Newton's method on these equations and phi_i = t, in (z, t, lambda), then
//! takes them to rounding.

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};
use serde::Serialize;

use super::excess::{
    BoundSide, ExcessPoint, QuadraticModel, SearchParameters, largest, points, response,
};
use crate::bounds::Region;

/// A frequency at which the fit is held: the largest excess is reached there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Active {
    /// Frequency ratio g = omega/Omega_n [-]; may be 0, or infinite (`null` in JSON).
    pub g: f64,
    /// ARR there.
    pub arr: f64,
    /// Number of the band, from 1.
    pub band: usize,
    /// Whether the band's lower side holds it (a uniform or rigid band), not the upper.
    pub below: bool,
    /// lambda; those of all active frequencies sum to 1.
    pub multiplier: f64,
}

/// A bound that holds the fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ActiveBound {
    /// Its name, as in the case file; `search_range` is the range within which the program looks.
    pub bound: &'static str,
    /// nu: what the excess would fall by, per unit of ln K or ln C that the bound is loosened.
    pub multiplier: f64,
}

/// Active frequencies and bounds, multipliers, and how well they satisfy the conditions of a
/// minimum.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Certificate {
    pub active: Vec<Active>,
    pub bounds: Vec<ActiveBound>,
    /// || sum lambda grad phi + nu || / sum lambda ||grad phi||, gradients by (ln K, ln C).
    pub residual: f64,
    /// Largest difference between the excess at an active frequency and the largest excess.
    pub spread: f64,
}

impl Certificate {
    /// Whether the conditions of a minimum are met: the gradients balance to 1e-7 of their size,
    /// and the active frequencies have one excess to 1e-9 of ln ARR.
    pub fn holds(&self) -> bool {
        self.residual < 1e-7 && self.spread < 1e-9
    }
}

/// The problem at one mu: the curves and the box.
#[derive(Clone, Copy)]
pub(crate) struct Problem<'a> {
    pub curves: &'a [BoundSide],
    pub mu: f64,
    pub region: &'a Region,
}

impl Problem<'_> {
    /// Every end and peak at z.
    pub(crate) fn points(&self, z: &SearchParameters) -> Vec<ExcessPoint> {
        points(self.curves, self.mu, z)
    }

    /// The second-order model of a point.
    pub(crate) fn model(&self, point: &ExcessPoint, z: &SearchParameters) -> QuadraticModel {
        self.curves[point.curve].model(point, self.mu, z)
    }

    /// The certificate of z with these active points and multipliers.
    pub(crate) fn certificate(
        &self,
        z: &SearchParameters,
        active: &[ExcessPoint],
        multipliers: &[f64],
    ) -> Certificate {
        let t = largest(&self.points(z));
        let response = response(self.mu, z);
        let (mut sum, mut size) = (Vector2::zeros(), 0.0);
        let (mut spread, mut rows) = (0.0_f64, Vec::new());
        for (point, &multiplier) in active.iter().zip(multipliers) {
            let slope = self.model(point, z).slope;
            sum += multiplier * slope;
            size += multiplier * slope.norm();
            spread = spread.max((point.value - t).abs());
            let curve = &self.curves[point.curve];
            rows.push(Active {
                g: point.g,
                arr: response.arr(point.g),
                band: curve.band + 1,
                below: curve.side < 0.0,
                multiplier,
            });
        }
        let mut bounds = Vec::new();
        for j in 0..2 {
            if let Some(bound) =
                self.bound(z, j).filter(|&(_, sign)| sum[j] * sign > 0.0).map(|(name, _)| name)
            {
                bounds.push(ActiveBound { bound, multiplier: sum[j].abs() });
                sum[j] = 0.0;
            }
        }
        // without any gradient (the target is met at a point that nothing moves) the conditions
        // hold exactly
        let residual = if size > 0.0 { sum.norm() / size } else { 0.0 };
        Certificate { active: rows, bounds, residual, spread }
    }

    /// The bound that z lies on in direction j, and the sign of the slope that it can balance.
    fn bound(&self, z: &SearchParameters, j: usize) -> Option<(&'static str, f64)> {
        let Region { low, high, low_names, high_names } = self.region;
        if z[j] <= low[j] {
            Some((low_names[j], 1.0))
        } else if z[j] >= high[j] {
            Some((high_names[j], -1.0))
        } else {
            None
        }
    }

    /// Newton's method from near a minimum: the z it reaches with its active points and
    /// multipliers, or nothing if that is no minimum (a multiplier has the wrong sign, a point has
    /// gone) or no better than `z` was.
    pub(crate) fn polish(
        &self,
        z: &SearchParameters,
        active: &[ExcessPoint],
        multipliers: &[f64],
    ) -> Option<(SearchParameters, Vec<ExcessPoint>, Vec<f64>)> {
        /// A step this small in ln K and ln C is rounding.
        const STEP: f64 = 1e-14;
        let mut lambda = multipliers.to_vec();
        let t_before = largest(&self.points(z));
        let mut z = self.snapped(z);
        let mut active = self.followed(active, &self.points(&z))?;
        // Along a flat valley rounding throws the last steps about: the best of them is kept.
        let (mut best, mut best_residual) = (None, f64::INFINITY);
        for _ in 0..12 {
            let models: Vec<QuadraticModel> =
                active.iter().map(|point| self.model(point, &z)).collect();
            let (d, next) = self.newton(&z, &models, &lambda)?;
            if d.norm() > 0.5 {
                break;
            }
            z = self.region.clamp(&(z + d));
            lambda = next;
            let now = self.points(&z);
            let Some(followed) = self.followed(&active, &now) else { break };
            active = followed;
            let total: f64 = lambda.iter().map(|l| l.max(0.0)).sum();
            let shares: Vec<f64> = lambda.iter().map(|l| l.max(0.0) / total).collect();
            let certificate = self.certificate(&z, &active, &shares);
            let wrong = lambda.iter().any(|&l| l < -1e-9);
            // 1e-9 of ln ARR: far above rounding (1e-15), far below what a different minimum would
            // differ by
            let good = !wrong && certificate.holds() && largest(&now) < t_before + 1e-9;
            if good && certificate.residual < best_residual {
                best_residual = certificate.residual;
                best = Some((z, active.clone(), shares));
            }
            if d.norm() < STEP {
                break;
            }
        }
        best
    }

    /// z moved onto a bound that it all but touches.
    fn snapped(&self, z: &SearchParameters) -> SearchParameters {
        /// What the interior-point solver leaves between a solution and an active bound.
        const GAP: f64 = 1e-6;
        let Region { low, high, .. } = self.region;
        Vector2::from_fn(|j, _| match z[j] {
            x if x - low[j] < GAP => low[j],
            x if high[j] - x < GAP => high[j],
            x => x,
        })
    }

    /// Where the active points have gone: of the same curve and sort, the nearest.
    fn followed(&self, active: &[ExcessPoint], now: &[ExcessPoint]) -> Option<Vec<ExcessPoint>> {
        active.iter().map(|point| follow(point, now).map(|index| now[index])).collect()
    }

    /// One Newton step in z, and the new multipliers. Least squares of least norm where points
    /// depend on each other.
    fn newton(
        &self,
        z: &SearchParameters,
        models: &[QuadraticModel],
        lambda: &[f64],
    ) -> Option<(Vector2<f64>, Vec<f64>)> {
        let n = models.len();
        let top = models.iter().fold(f64::NEG_INFINITY, |top, model| top.max(model.value));
        // slopes may be 1e-6 (a flat band is flat for any z): in units of the steepest all entries
        // are of order one
        let steepest = models.iter().map(|model| model.slope.norm()).fold(0.0, f64::max);
        let unit = if steepest > 0.0 { steepest } else { 1.0 };
        let w = models
            .iter()
            .zip(lambda)
            .map(|(model, &l)| model.curvature * (l / unit))
            .sum::<Matrix2<f64>>();
        let free = [0, 1].map(|j| self.bound(z, j).is_none());
        // unknowns d_0, d_1, the rise of t in that unit, lambda_1..n
        let mut matrix = DMatrix::zeros(n + 3, n + 3);
        let mut right = DVector::zeros(n + 3);
        for j in 0..2 {
            if free[j] {
                (matrix[(j, 0)], matrix[(j, 1)]) = (w[(j, 0)], w[(j, 1)]);
                models
                    .iter()
                    .enumerate()
                    .for_each(|(i, model)| matrix[(j, 3 + i)] = model.slope[j] / unit);
            } else {
                matrix[(j, j)] = 1.0;
            }
        }
        for (i, model) in models.iter().enumerate() {
            matrix[(3 + i, 0)] = model.slope[0] / unit;
            matrix[(3 + i, 1)] = model.slope[1] / unit;
            matrix[(3 + i, 2)] = -1.0;
            right[3 + i] = (top - model.value) / unit;
            matrix[(2, 3 + i)] = 1.0;
        }
        right[2] = 1.0;
        // elimination keeps the digits of badly scaled rows, which the singular value decomposition
        // loses
        let solution = match matrix.clone().full_piv_lu().solve(&right) {
            Some(solution) => solution,
            None => matrix.svd(true, true).solve(&right, 1e-12).ok()?,
        };
        let finite = solution.iter().all(|x| x.is_finite());
        // a bound is held exactly: one rounding off it and it would no longer count as active
        let d = Vector2::from_fn(|j, _| if free[j] { solution[j] } else { 0.0 });
        finite.then(|| (d, solution.rows(3, n).iter().copied().collect()))
    }
}

/// Which of `now` is `point` after a small move: of the same curve and sort, the nearest in ln g.
pub(crate) fn follow(point: &ExcessPoint, now: &[ExcessPoint]) -> Option<usize> {
    let distance =
        |other: &ExcessPoint| if other.g == point.g { 0.0 } else { (other.g / point.g).ln().abs() };
    now.iter()
        .enumerate()
        .filter(|(_, other)| other.curve == point.curve && other.inside == point.inside)
        .min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))
        .map(|(index, _)| index)
}
