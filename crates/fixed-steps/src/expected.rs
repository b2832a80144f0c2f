//! The expected error of springs in a program with fixed time steps, by its causes.
//!
//! ```text
//!   floor    13 p dt                       where in a step a landing falls
//!   stance   80 (p/(alpha Omega_e))^2      sway before uplift;   Omega_e^2 = k1 k2/((k1 + k2) m)
//!   rebound  20 alpha^3 (v_r/v_n)^2        what the landing foot gives back (`rebound`)
//! ```
//!
//! Medians of the normalised root-mean-square error (NRMSE) of u on motions made for a body, pulses
//! and noise. The floor: the sign of the weight's moment changes somewhere within the step in which
//! a foot lands, and what the step's formula makes of that is an error of the rate, relative to the
//! landing speed, spread evenly over a width of 2 p dt/sqrt(1 - (1 - phi)^2), phi = lean/alpha: its
//! standard deviation is this width over sqrt(12), 1.85, 0.81 and 0.59 p dt at leans of 0.05, 0.3
//! and 0.8 alpha. It grows like exp(p t) until the next landing. A landing that is resolved,
//! Omega_e dt < 0.3, has less.

use dynamics::spring::{Chain, Springs};
use rocking::structure::Body;

use crate::{integrator::Integrator, rebound::rebound};

/// Median NRMSE over p dt that springs hardly come below: 9 to 20 where neither stance nor rebound
/// shows (example `fixed_step_medians` of the crate `springs`).
pub const FLOOR: f64 = 13.0;
/// Median NRMSE over (p/(alpha Omega_e))^2 by the stance.
const STANCE: f64 = 80.0;
/// NRMSE over alpha^3 (v_r/v_n)^2 by the rebound: 14 to 29 on frames and blocks of 0.1 to 0.45 rad
/// on the recipe's springs, stepped by 2.5e-4 s (the same example).
pub const REBOUND: f64 = 20.0;
/// 90 % quantile over the median, of integrators that end stiff modes and of others (the same
/// example).
const SPREAD: [f64; 2] = [2.9, 4.6];

/// Median NRMSE of u on motions made for the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedError {
    /// From the step: the least error of any springs without touch refinement.
    pub floor: f64,
    /// By the sway before uplift.
    pub stance: f64,
    /// By what the landing foot gives back.
    pub rebound: f64,
    /// All three, as independent errors: the root of their squares' sum, at least the floor.
    pub median: f64,
    /// The 90 % quantile.
    pub ninety: f64,
}

impl ExpectedError {
    /// Of a body on these units, stepped by dt (s).
    pub fn of(
        body: &Body<f64>,
        springs: &Springs<Chain>,
        dt: f64,
        integrator: &Integrator,
    ) -> Self {
        let (p, alpha) = (body.p(), body.alpha());
        let omega_e = (springs.vertical.in_series() / body.mass).sqrt();
        let floor = FLOOR * p * dt;
        let stance = STANCE * (p / (alpha * omega_e)).powi(2);
        let rebound =
            REBOUND * alpha.powi(3) * rebound(body, &springs.vertical, dt, integrator).powi(2);
        let median = floor.hypot(stance).hypot(rebound);
        let spread = SPREAD[usize::from(!integrator.ends_stiff_modes())];
        Self { floor, stance, rebound, median, ninety: spread * median }
    }
}

/// The step that a median error needs, with any springs: accuracy/(13 p) (s).
pub fn step_for(body: &Body<f64>, accuracy: f64) -> f64 {
    accuracy / (FLOOR * body.p())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rocking::structure::Structure;

    /// 1.9 ms (61 m), 0.33 ms (block of 1.3 m) for one per cent.
    #[test]
    fn the_step_for_an_accuracy() {
        let frame = Structure::paper().body::<f64>();
        assert_relative_eq!(step_for(&frame, 0.01), 1.92e-3, max_relative = 1e-2);
        let block = Structure::block(2.6, 0.7, 1e3).unwrap().body::<f64>();
        assert_relative_eq!(step_for(&block, 0.01), 0.33e-3, max_relative = 2e-2);
    }
}
