//! Units for steps of one size, in closed form.
//!
//! ```text
//!   stance   k_e = k1 K/(1 + K) = stance m p/(alpha^2 dt)
//!   rebound  20 alpha^3 (v_r/v_n)^2 = rebound 13 p dt,  v_r/v_n = rebound_over_k K   ->  K
//!   units    mu = mu_u(K) M times a share,  C = C_u(K) sqrt(M)  of what lands (`landing::design`)
//!            Omega_h/Omega_v at least 4, more under stocky frames
//! ```
//!
//! An absorber of half the mass that a landing asks for rebounds twice as much, which K makes up
//! for, and histories err less in steps that do not resolve the landing (`cargo bench --bench
//! fixed_steps -- numbers`).

use dynamics::spring::{Design, Springs};
use fixed_steps::{
    FixedStepDesign,
    expected::{FLOOR, REBOUND},
    recipe::UnitNumbers,
};
use landing::{corners::CornerDynamics, design::for_landing};
use rocking::structure::Body;

/// K at least: below it an absorber comes back late.
const LEAST_K: f64 = 0.02;

/// What units for a step follow from, whatever the body. Those of a run for steps of one size are
/// [`Self::EVEN`], those for substeps that resolve a landing [`Self::AT_TOUCHES`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignNumbers {
    /// k_e alpha^2 dt/(m p): how stiff the stance is.
    pub stance: f64,
    /// Error by the rebound, of the floor.
    pub rebound: f64,
    /// Rebound v_r/v_n over K, of these units.
    pub rebound_over_k: f64,
    /// K at most: bodies that land in long steps.
    pub largest_k: f64,
    /// mu over the mu_u(K) M of the body's own landing, in steps that do not resolve it.
    pub mu: f64,
}

impl DesignNumbers {
    /// `cargo bench --bench fixed_steps -- numbers` has them beside others.
    pub const EVEN: Self =
        Self { stance: 10.0, rebound: 0.75, rebound_over_k: 1.7, largest_k: 0.5, mu: 0.5 };
    /// The body's own landing. The stance is that of the substep
    /// (`FixedStepSprings::refined`), not this one.
    pub const AT_TOUCHES: Self =
        Self { rebound: 0.5, rebound_over_k: 0.8, largest_k: 0.25, mu: 1.0, ..Self::EVEN };

    /// The design for a body and a step (s).
    pub fn design(&self, body: &Body<f64>, step: f64) -> FixedStepDesign {
        let rebound = self.rebound * FLOOR * body.p() * step;
        let k = (rebound / (REBOUND * body.alpha().powi(3))).sqrt() / self.rebound_over_k;
        let corners = CornerDynamics::rigid(body.alpha(), body.mass_share());
        let effective = 1.0 - body.mass_share() * body.alpha().sin().powi(2);
        let Springs { vertical, horizontal } =
            for_landing(&corners, effective, k.clamp(LEAST_K, self.largest_k));
        let numbers = |unit: &Design<f64>| UnitNumbers { k: unit.k(), c: unit.c(), mu: unit.mu };
        // in the shortest steps nothing but the landing's own mass rebounds little enough
        let of_mass = if k < LEAST_K { 1.0 } else { self.mu };
        FixedStepDesign {
            stance: self.stance,
            vertical: UnitNumbers { mu: of_mass * vertical.mu, ..numbers(&vertical) },
            horizontal: numbers(&horizontal),
            horizontal_over_vertical: horizontal.omega_n_hz / vertical.omega_n_hz,
        }
    }
}

/// The design of a run for a body and steps of one size (s).
pub fn design(body: &Body<f64>, step: f64) -> FixedStepDesign {
    DesignNumbers::EVEN.design(body, step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use fixed_steps::{FixedStepSprings, Integrator};
    use rocking::structure::Structure;

    /// The rebound that K leaves is its share of the floor, or K is the largest; mu is its share of
    /// that of the body's own landing.
    #[test]
    fn numbers_follow_from_the_step() {
        let DesignNumbers { rebound: share, rebound_over_k, largest_k, mu, stance } =
            DesignNumbers::EVEN;
        let body = Structure::block(2.0, 1.0, 1e3).unwrap().body::<f64>();
        for step in [2.5e-4, 1e-3] {
            let k = design(&body, step).vertical.k;
            let rebound = REBOUND * body.alpha().powi(3) * (rebound_over_k * k).powi(2);
            assert_relative_eq!(rebound, share * FLOOR * body.p() * step, max_relative = 1e-9);
        }
        let paper = Structure::paper().body::<f64>();
        let own = design(&paper, 1e-2);
        assert_relative_eq!(own.vertical.k, largest_k, max_relative = 1e-12);
        let whole = DesignNumbers { mu: 1.0, ..DesignNumbers::EVEN }.design(&paper, 1e-2);
        assert_relative_eq!(own.vertical.mu, mu * whole.vertical.mu, max_relative = 1e-12);
        assert_eq!((own.horizontal, own.stance), (whole.horizontal, stance));
    }

    /// The emulated rebound of the units in short steps is what the closed form counts on, within a
    /// half.
    #[test]
    fn units_rebound_as_counted_on() {
        let body = Structure::block(2.0, 1.0, 1e3).unwrap().body::<f64>();
        for (numbers, step) in [DesignNumbers::EVEN, DesignNumbers::AT_TOUCHES]
            .into_iter()
            .flat_map(|numbers| [2.5e-5, 1e-4, 1e-3].map(|step| (numbers, step)))
        {
            let design = numbers.design(&body, step);
            let springs =
                FixedStepSprings::designed(&body, step, Integrator::Trbdf2, &design).unwrap();
            let found = fixed_steps::rebound::rebound(
                &body,
                &springs.chains().vertical,
                1e-7,
                &Integrator::Trbdf2,
            );
            let counted = numbers.rebound_over_k * design.vertical.k;
            assert!((found / counted - 1.0).abs() < 0.5, "{found} {counted}");
        }
    }
}
