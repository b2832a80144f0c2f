//! The inner fit: f and xi of a given mu, so that the frequency response follows the target as
//! closely as it can.
//!
//! ```text
//!  minimise over (f, xi)   t = max over bands and g of the excess      (see `target`)
//! ```
//!
//! Stage 1 (`smooth`) minimises a smooth stand-in by L-BFGS from several starts; stage 2
//! (`minimax`) takes the best of them to the minimum by convex steps; a certificate of optimality
//! comes with every fit.

use nalgebra::Vector2;
use serde::Serialize;
use thiserror::Error;

use super::certificate::{Certificate, Problem};
use super::excess::{SearchParameters, curves, largest, points, response};
use super::minimax::{Minimum, minimise};
use super::smooth::Smooth;
use crate::bounds::{Bounds, BoundsError};
use crate::target::{Target, TargetError};

/// How a fit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FitOutcome {
    /// A minimum, confirmed by its certificate.
    Converged,
    /// The best that was found; the certificate's residual tells how far the conditions are from
    /// met.
    NotConverged,
}

/// Springs without units for one mu, and the proof of their quality.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// Mass ratio mu = m2/m1.
    pub mu: f64,
    /// Frequency ratio f = omega_a/Omega_n.
    pub f: f64,
    /// Damping ratio xi = c/(2 m2 Omega_n).
    pub xi: f64,
    /// Stiffness ratio K = k2/k1 = mu f^2.
    pub k: f64,
    /// Damping number C = c/(m1 Omega_n) = 2 mu xi.
    pub c: f64,
    /// The largest ARR over all g, whatever the target.
    pub peak: f64,
    /// Where it is, g = omega/Omega_n.
    pub peak_g: f64,
    /// ARR(0) = 1 + 1/K.
    pub arr_at_zero: f64,
    /// The largest excess over the target; zero or less if the target is met. ln(peak) for the
    /// default target.
    pub excess: f64,
    pub outcome: FitOutcome,
    /// Convex steps of the minimax.
    pub iterations: usize,
    pub certificate: Certificate,
}

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum FitError {
    #[error("fit: mu is {mu:?}; give a mass ratio between 1e-6 and 1e6")]
    Mu { mu: f64 },
    #[error(transparent)]
    Target(#[from] TargetError),
    #[error(transparent)]
    Bounds(#[from] BoundsError),
}

/// Stage 1 runs from this many of the best starts, stage 2 from what they reach.
const STARTS: usize = 3;
/// Two ends of stage 1 this near to each other (in ln K, ln C) are one.
const SAME: f64 = 0.05;

/// The springs of mass ratio mu whose response follows the target best.
///
/// ```
/// use frequency_response::{bounds::Bounds, inner::fit, target::Target};
///
/// // mu -> 0: K = 1/2 and a largest ARR of 3
/// let fit = fit(1e-3, &Target::default(), &Bounds::default()).unwrap();
/// assert!((fit.k - 0.5).abs() < 1e-3 && (fit.peak - 3.0).abs() < 1e-3);
/// ```
pub fn fit(mu: f64, target: &Target, bounds: &Bounds) -> Result<Fit, FitError> {
    if !(1e-6..=1e6).contains(&mu) {
        return Err(FitError::Mu { mu });
    }
    let target = target.clone().checked()?;
    let region = bounds.region(mu)?;
    let curves = curves(&target);
    let problem = Problem { curves: &curves, mu, region: &region };
    let smooth = Smooth { curves: &curves, mu, region: &region };

    let mut starts: Vec<(f64, SearchParameters)> =
        starts(mu).into_iter().map(|z| region.clamp(&z)).map(|z| (smooth.value(&z), z)).collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut ends: Vec<SearchParameters> = Vec::new();
    for (_, start) in starts.iter().take(STARTS) {
        let (z, _) = smooth.minimise(start);
        if ends.iter().all(|end| (end - z).amax() > SAME) {
            ends.push(z);
        }
    }
    let mut best: Option<Minimum> = None;
    for end in &ends {
        let found = minimise(&problem, end);
        // a later one must be better by more than rounding, so that the order of starts decides
        // ties
        if best.as_ref().is_none_or(|best| found.excess < best.excess - 1e-12) {
            best = Some(found);
        }
    }
    let minimum = best.unwrap_or_else(|| minimise(&problem, &region.clamp(&Vector2::zeros())));
    Ok(Fit::new(&problem, &minimum))
}

/// Starts for stage 1: K about the closed forms' (1/2 for small mu, mu - 1 for large) and away from
/// them.
fn starts(mu: f64) -> Vec<SearchParameters> {
    let mut out = Vec::new();
    for k in [0.5, 1.0, mu.max(0.1), 4.0, 20.0] {
        for c in [0.5, 2.0, 8.0, 1.3 * mu.sqrt()] {
            out.push(Vector2::new(f64::ln(k), f64::ln(c)));
        }
    }
    out
}

impl Fit {
    fn new(problem: &Problem, minimum: &Minimum) -> Self {
        let Minimum { z, excess, active, multipliers, iterations } = minimum;
        let certificate = problem.certificate(z, active, multipliers);
        let mu = problem.mu;
        let response = response(mu, z);
        let (k, c) = (response.k, response.c);
        let all = points(&curves(&Target::default()), mu, z);
        let top = largest(&all);
        let peak_g = all.iter().find(|point| point.value == top).map_or(0.0, |point| point.g);
        Self {
            mu,
            f: (k / mu).sqrt(),
            xi: c / (2.0 * mu),
            k,
            c,
            peak: response.arr(peak_g),
            peak_g,
            arr_at_zero: response.at_zero(),
            excess: *excess,
            outcome: if certificate.holds() {
                FitOutcome::Converged
            } else {
                FitOutcome::NotConverged
            },
            iterations: *iterations,
            certificate,
        }
    }
}
