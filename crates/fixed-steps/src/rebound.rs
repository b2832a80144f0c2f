//! What a spring-absorber unit gives back of a landing, as the program steps it.
//!
//! ```text
//!   a mass of M m falls with 1 on  gap k1 - m2 - (k2 parallel c),  no gravity:   time in 1/Omega_n, k1 = m = 1
//!   M u'' = k1 (a - u)+,    mu a'' = -k1 (a - u)+ - K a - C a'                   v_r/v_n: u' when it is over
//! ```
//!
//! The old foot has no part in it: horizontal units do not lag. M = 1 - (m R^2/I0) sin^2 alpha is
//! what lands on the new foot of a rigid body, over m. The place in the step where it lands is
//! arbitrary, so the root mean square over 16 places is taken. In steps longer than the landing the
//! integrator decides, not the unit: generalized alpha of rho_inf 0 gives back least, HHT more than
//! there was.

use std::ops::ControlFlow;

use frames::frame::EquilibriumError;
use nalgebra::{Matrix2, Vector2};
use rocking::structure::Body;

use crate::{
    analysis::{FixedStepAnalysis, StepSettings},
    contact::FixedFoot,
    integrator::Integrator,
    iteration::{ConvergenceTest, Iteration, NEWTON},
    kinematics::{Kinematics, TangentWeights, Trial},
    model::FixedStepModel,
};
use dynamics::spring::Chain;

/// A landing is followed so long (1/Omega_n).
const LENGTH: f64 = 30.0;
/// At most so many steps.
const STEPS: f64 = 3000.0;
/// Places within a step at which a foot touches.
const PHASES: usize = 16;
/// Steps of free fall before.
const BEFORE: f64 = 3.0;

/// Mass and unit, k1 = 1.
struct FallingMass {
    mass: f64,
    mu: f64,
    k: f64,
    c: f64,
}

impl FallingMass {
    fn press(q: &[f64; 2], feet: &[FixedFoot; 1]) -> f64 {
        if feet[0].closed { q[1] - q[0] } else { 0.0 }
    }
}

impl FixedStepModel for FallingMass {
    type Vector = [f64; 2];
    type Feet = [FixedFoot; 1];
    type Places = ();
    type Factor = Matrix2<f64>;

    fn standing(&self) -> Result<([f64; 2], [FixedFoot; 1]), EquilibriumError> {
        Ok(([0.0; 2], [FixedFoot::new(false, 0.0)]))
    }

    fn places(&self, _: &[f64; 2]) {}

    fn meet(&self, (): &(), q: &[f64; 2], feet: &mut [FixedFoot; 1]) {
        feet[0].closed = q[1] >= q[0];
    }

    fn unbalance(
        &self,
        (trial, ()): (&Trial<[f64; 2]>, &()),
        feet: &[FixedFoot; 1],
        _: [f64; 2],
        out: &mut [f64; 2],
    ) {
        let Trial { q, v, a, .. } = trial;
        let press = Self::press(q, feet);
        *out = [press - self.mass * a[0], -press - self.k * q[1] - self.c * v[1] - self.mu * a[1]];
    }

    fn factor(
        &self,
        _: (&Trial<[f64; 2]>, &()),
        feet: &[FixedFoot; 1],
        w: &TangentWeights,
    ) -> Option<Matrix2<f64>> {
        let k1 = if feet[0].closed { w.stiffness } else { 0.0 };
        let own = w.mass * self.mu + w.damping * self.c + w.stiffness * self.k;
        Matrix2::new(w.mass * self.mass + k1, -k1, -k1, own + k1).try_inverse()
    }

    fn solve(&self, factor: &Matrix2<f64>, right: &mut [f64; 2]) {
        *right = (factor * Vector2::from(*right)).into();
    }
}

/// v_r/v_n of a unit under a body's new foot with this step (s): the root of the mean square over
/// the places within a step at which it lands.
pub fn rebound(body: &Body<f64>, chain: &Chain, dt: f64, integrator: &Integrator) -> f64 {
    let design = chain.design(body.mass);
    let sin = body.half_width / body.radius();
    let mass = 1.0 - body.mass_share() * sin * sin;
    let model = FallingMass { mass, mu: design.mu, k: design.k(), c: design.c() };
    let step = (dt * (chain.k1 / body.mass).sqrt()).max(LENGTH / STEPS);
    let square = |phase: usize| {
        model.speed(step, (phase as f64 + 0.5) / PHASES as f64, integrator).max(0.0).powi(2)
    };
    ((0..PHASES).map(square).sum::<f64>() / PHASES as f64).sqrt()
}

impl FallingMass {
    /// Upward speed after the landing; it touches in this part of a step.
    fn speed(&self, step: f64, phase: f64, integrator: &Integrator) -> f64 {
        let count = ((LENGTH / step).ceil() + 2.0 * BEFORE) as usize;
        let accel = vec![0.0; count + 1];
        let iteration =
            Iteration { constant: 0, newton: NEWTON, test: ConvergenceTest::Increment(1e-9) };
        let settings = StepSettings { iteration, ..StepSettings::new(*integrator, step) };
        let height = (BEFORE + phase) * step;
        let start = Kinematics::moving([height, 0.0], [-1.0, 0.0], [0.0; 2]);
        let mut last = [height; 2];
        let analysis = FixedStepAnalysis::new(self, settings, step, &accel);
        analysis.follow_from(start, [FixedFoot::new(false, 0.0)], &mut |_, q| {
            last = [last[1], q[0]];
            ControlFlow::Continue(())
        });
        (last[1] - last[0]) / step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resolved(mu: f64, k: f64, c: f64) -> f64 {
        FallingMass { mass: 1.0, mu, k, c }.speed(0.005, 0.5, &Integrator::Trbdf2)
    }

    /// By a Runge-Kutta program of fourth order, steps of 0.002/Omega_n; the second of them lands
    /// twice. The paper's vertical unit gives back nearly all.
    #[test]
    fn units_give_back_what_another_program_says() {
        for (k, c, mu, expected) in [
            (0.25, 0.6, 0.2, 0.346),
            (0.1, 0.64, 0.5, 0.154),
            (0.1, 0.75, 0.3, 0.133),
            (9.214, 4.0, 10.2, 0.905),
            (0.05, 0.6, 0.66, 0.044),
            (0.1, 0.643, 0.675, 0.080),
            (0.2, 0.647, 0.77, 0.140),
        ] {
            let found = resolved(mu, k, c);
            assert!((found - expected).abs() < 2e-3, "{k}, {c}, {mu}: {found}, {expected}");
        }
    }

    /// A mass on a spring alone gives back all; one that meets only a dashpot, nothing.
    #[test]
    fn limits() {
        assert!((resolved(1e6, 1e6, 0.0) - 1.0).abs() < 1e-3);
        assert!(resolved(1e-3, 1e-9, 0.5).abs() < 2e-2, "{}", resolved(1e-3, 1e-9, 0.5));
    }

    /// A step that is longer than the landing ends the unit's motion, not the mass's: the
    /// integrator itself gives back a part, HHT more than there was.
    #[test]
    fn long_steps_rebound_by_themselves() {
        let of = |integrator: Integrator| {
            let mass = FallingMass { mass: 1.0, mu: 0.2, k: 0.25, c: 0.6 };
            let square = |phase: usize| {
                mass.speed(20.0, (phase as f64 + 0.5) / 16.0, &integrator).max(0.0).powi(2)
            };
            ((0..16).map(square).sum::<f64>() / 16.0).sqrt()
        };
        let [alpha, euler, trbdf2, hht] = [
            Integrator::GENERALIZED_ALPHA_0,
            Integrator::BackwardEuler,
            Integrator::Trbdf2,
            Integrator::HHT_MOST,
        ]
        .map(of);
        assert!(
            alpha < euler && euler < 0.8 && euler < trbdf2 && trbdf2 < hht && hht > 1.2,
            "{alpha} {euler} {trbdf2} {hht}"
        );
    }
}
