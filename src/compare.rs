//! The finite element history beside Housner's: one set of numbers that says how well springs do.

use serde::{Deserialize, Serialize};

use crate::{
    fem::History,
    motion::{Motion, nrmse, peak},
};

/// How a finite element history matches Housner's over the same samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Match {
    /// Length compared [s].
    pub duration_s: f64,
    /// sqrt( sum (u - u_H)^2 / sum u_H^2 ).
    pub nrmse_horizontal: f64,
    /// The same for v, from the settled position.
    pub nrmse_vertical: f64,
    /// Largest |u| with its sign [m].
    pub peak_horizontal_housner_m: f64,
    pub peak_horizontal_fem_m: f64,
    /// Largest |v| with its sign [m].
    pub peak_vertical_housner_m: f64,
    pub peak_vertical_fem_m: f64,
    pub impacts_housner: usize,
    /// Landings, re-landings of a bounce not counted.
    pub impacts_fem: usize,
    /// Landing feet that opened again within 0.25 s, the body not having reversed.
    pub bounces: usize,
    /// Settlement of the standing body under its weight [m].
    pub settlement_m: f64,
    /// Largest |e_effective/e - 1| over the landings that matter (`effective_restitution`).
    pub restitution_error_max: f64,
    /// Largest |residual| of the energy account over the largest energy.
    pub energy_residual: f64,
}

impl Match {
    /// Compare a history with Housner's motion, both sampled at dt.
    pub fn new(dt: f64, housner: &Motion, impacts_housner: usize, fem: &History, restitution: f64) -> Self {
        let n = housner.len().min(fem.motion.len());
        Self {
            duration_s: n.saturating_sub(1) as f64 * dt,
            nrmse_horizontal: nrmse(&fem.motion.u[..n], &housner.u[..n]),
            nrmse_vertical: nrmse(&fem.motion.v[..n], &housner.v[..n]),
            peak_horizontal_housner_m: peak(&housner.u[..n]),
            peak_horizontal_fem_m: peak(&fem.motion.u[..n]),
            peak_vertical_housner_m: peak(&housner.v[..n]),
            peak_vertical_fem_m: peak(&fem.motion.v[..n]),
            impacts_housner,
            impacts_fem: fem.impacts(),
            bounces: fem.bounces(),
            settlement_m: -fem.initial_z,
            restitution_error_max: restitution_error(fem, restitution),
            energy_residual: fem.energy_residual,
        }
    }
}

/// Landings of less than this share of the largest kinetic energy do not count in `restitution_error`.
const LANDINGS_THAT_MATTER: f64 = 0.01;

/// sqrt(1 - lost/kinetic) of each impact: the velocity ratio that loses what the landing lost, up to the next landing.
pub fn effective_restitution(fem: &History) -> Vec<(f64, f64)> {
    let impacts = || fem.landings.iter().filter(|l| l.impact);
    let largest = impacts().map(|l| l.kinetic).fold(0.0, f64::max);
    impacts()
        .filter(|l| l.kinetic > LANDINGS_THAT_MATTER * largest)
        .map(|l| (l.time, (1.0 - l.lost / l.kinetic).max(0.0).sqrt()))
        .collect()
}

/// Largest |e_effective/e - 1| over the landings with more than 1 % of the largest kinetic energy; the last one is left
/// out, for its losses may not be complete.
pub fn restitution_error(fem: &History, restitution: f64) -> f64 {
    let all = effective_restitution(fem);
    let complete = &all[..all.len().saturating_sub(1)];
    complete.iter().map(|(_, e)| (e / restitution - 1.0).abs()).fold(0.0, f64::max)
}
