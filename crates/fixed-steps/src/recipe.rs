//! Springs for a step and an integrator, in closed form.
//!
//! ```text
//!   foot - gap k1 - m2 - (k2 parallel c) - ground,  vertically and horizontally;  Omega_e^2 = k_e/m, k_e = k1 k2/(k1 + k2)
//!
//!   stance   80 (p/(alpha Omega_e))^2       a body on soft springs sways before it lifts
//!   floor    13 p dt                        a landing falls anywhere within a step
//! ```
//!
//! Both are medians of the normalised root-mean-square error of u against Housner's history, on
//! motions made for the body. The floor does not depend on the springs, and stiffer springs only
//! cost convergence; so the stance is given half of the floor:
//!
//! ```text
//!   80 p^2/(alpha^2 Omega_e^2) = 13 p dt/2     ->     k_e = m Omega_e^2 = (160/13) m p/(alpha^2 dt),   160/13 = 12.3: 12
//!   K = k2/k1 = 1/4:  k_e = k1 K/(1 + K) = k1/5     ->     Omega_n^2 = k1/m = 60 p/(alpha^2 dt),   Omega_n = 7.75 sqrt(p/dt)/alpha
//! ```
//!
//! These numbers with C = 0.6, mu = 0.2 in both directions and Omega_h = 4 Omega_v are
//! [`FixedStepDesign::RECIPE`]. A step of Omega_e dt above one ends whatever a landing leaves, and
//! then the numbers of the units hardly matter; below it the rebound of K = 0.25 shows, the more
//! the stockier the body (`expected`). Units for the body's own landing, and K by the step, do
//! better: the crate `springs` has them (`program`).

use dynamics::spring::{Chain, Design, Springs};
use rocking::structure::Body;
use thiserror::Error;

use crate::{
    analysis::StepSettings,
    expected::ExpectedError,
    integrator::{Integrator, IntegratorError},
    iteration::{ConvergenceTest, Iteration, NEWTON},
};
use rocking::scalar::GRAVITY;

/// Dimensionless numbers of the units of a design.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitNumbers {
    /// K = k2/k1.
    pub k: f64,
    /// C = c/(m Omega_n).
    pub c: f64,
    /// mu = m2/m.
    pub mu: f64,
}

/// A family of springs for fixed time steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedStepDesign {
    /// k_e alpha^2 dt/(m p) of the vertical unit: how stiff the stance is.
    pub stance: f64,
    /// The vertical unit.
    pub vertical: UnitNumbers,
    /// The horizontal unit.
    pub horizontal: UnitNumbers,
    /// Omega_n of the horizontal unit over that of the vertical one.
    pub horizontal_over_vertical: f64,
}

impl FixedStepDesign {
    /// The recipe in closed form.
    pub const RECIPE: Self = Self {
        stance: 12.0,
        vertical: UnitNumbers { k: 0.25, c: 0.6, mu: 0.2 },
        horizontal: UnitNumbers { k: 0.25, c: 0.6, mu: 0.2 },
        horizontal_over_vertical: 4.0,
    };

    /// Omega_n of the vertical unit, sqrt(k1/m) (rad/s).
    pub fn omega_n(&self, body: &Body<f64>, step: f64) -> f64 {
        let in_series = self.stance * body.p() / (body.alpha() * body.alpha() * step);
        (in_series * (1.0 + self.vertical.k) / self.vertical.k).sqrt()
    }

    /// Both units, the vertical one of this Omega_n (rad/s).
    fn units(&self, omega_n: f64) -> Springs<Design<f64>> {
        let hz = omega_n / std::f64::consts::TAU;
        let unit = |of: &UnitNumbers, hz: f64| Design::from_kc(of.mu, of.k, of.c, hz);
        Springs {
            vertical: unit(&self.vertical, hz),
            horizontal: unit(&self.horizontal, self.horizontal_over_vertical * hz),
        }
    }
}

/// Omega_n times a substep at touches: a landing, about 1/Omega_n long, is resolved.
const AT_TOUCHES: f64 = 0.5;

/// I_cg/(m R^2) of a body that has none, where the integrator leaves something of stiff modes: with
/// less, its rotation is a mode of several kHz that HHT neither resolves nor ends.
const INERTIA_FOR_RINGING: f64 = 1e-3;
/// The same for integrators that end stiff modes within a few steps: that of our decks.
pub const LEAST_INERTIA: f64 = rocking::structure::LEAST_INERTIA;

/// Convergence tolerance over g dt^2: see [`FixedStepSprings::iteration`].
pub const TOLERANCE: f64 = 0.1;

/// Springs for a body in a program with one size of step.
#[derive(Clone, Copy, Debug)]
pub struct FixedStepSprings {
    /// The body as both models are to have it: with the rotational inertia that the program needs.
    pub body: Body<f64>,
    /// Under each foot.
    pub units: Springs<Design<f64>>,
    /// The program's integrator.
    pub integrator: Integrator,
    /// The program's step (s).
    pub step: f64,
    /// Substeps of a step at touches; 1: none.
    pub at_touches: usize,
}

/// No springs follow from these numbers.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum FixedStepSpringsError {
    /// A step that is none.
    #[error(
        "step: {step:?} s is not a time step; give a finite number greater than zero, for example \
         0.001"
    )]
    Step {
        /// As given (s).
        step: f64,
    },
    /// An integrator that is unstable.
    #[error(transparent)]
    Integrator(#[from] IntegratorError),
}

impl FixedStepSprings {
    /// The recipe for a body, a step (s) and an integrator.
    ///
    /// # Errors
    /// The step is not positive, or the integrator is unstable.
    pub fn of(
        body: &Body<f64>,
        step: f64,
        integrator: Integrator,
    ) -> Result<Self, FixedStepSpringsError> {
        Self::designed(body, step, integrator, &FixedStepDesign::RECIPE)
    }

    /// The same of another family of springs.
    ///
    /// # Errors
    /// The step is not positive, or the integrator is unstable.
    pub fn designed(
        body: &Body<f64>,
        step: f64,
        integrator: Integrator,
        design: &FixedStepDesign,
    ) -> Result<Self, FixedStepSpringsError> {
        let body = prepared(body, step, integrator)?;
        let units = design.units(design.omega_n(&body, step));
        Ok(Self { body, units, integrator, step, at_touches: 1 })
    }

    /// Springs for a program that takes so many substeps in steps at touches
    /// ([`StepSettings::with_touches`]): as stiff as these resolve, Omega_n = substeps/(2 dt), so
    /// that the floor is that of the substep and the stance hardly sways.
    ///
    /// # Errors
    /// The step is not positive, or the integrator is unstable.
    pub fn refined(
        body: &Body<f64>,
        step: f64,
        integrator: Integrator,
        design: &FixedStepDesign,
        at_touches: usize,
    ) -> Result<Self, FixedStepSpringsError> {
        let (body, at_touches) = (prepared(body, step, integrator)?, at_touches.max(1));
        let units = design.units(AT_TOUCHES * at_touches as f64 / step);
        Ok(Self { body, units, integrator, step, at_touches })
    }

    /// With units.
    pub fn chains(&self) -> Springs<Chain> {
        self.units.chains(self.body.mass)
    }

    /// I_cg that both models have (kg m2).
    pub fn rotational_inertia(&self) -> f64 {
        self.body.inertia
    }

    /// What these springs leave of an error on motions made for the body.
    pub fn expected(&self) -> ExpectedError {
        ExpectedError::of(&self.body, &self.chains(), self.shortest(), &self.integrator)
    }

    /// How the program is to step: without substeps but for those at touches. One that splits a
    /// step that fails ([`StepSettings::with_substeps`], down to 1/16) gets stocky bodies through,
    /// too, of which one history in four stops without.
    pub fn settings(&self) -> StepSettings {
        let settings = StepSettings {
            iteration: self.iteration(),
            ..StepSettings::new(self.integrator, self.step)
        };
        settings.with_touches(self.at_touches)
    }

    /// The step at a landing (s).
    fn shortest(&self) -> f64 {
        self.step / self.at_touches as f64
    }

    /// The iteration that goes with them: Newton's, 30 at most, to a change of g dt^2/10.
    ///
    /// A foot that lifts drops its horizontal force at once. There are steps at whose end neither a
    /// foot on the ground nor one in the air fits its own force, and Newton's iteration goes to and
    /// fro between both, apart by what a weight does within a step, g dt^2. A tighter test stops
    /// the program there, however many iterations it allows.
    pub fn iteration(&self) -> Iteration {
        let below = TOLERANCE * GRAVITY * self.shortest().powi(2);
        Iteration { constant: 0, newton: NEWTON, test: ConvergenceTest::Increment(below) }
    }
}

/// The body as a program can step it.
fn prepared(
    body: &Body<f64>,
    step: f64,
    integrator: Integrator,
) -> Result<Body<f64>, FixedStepSpringsError> {
    if !(step.is_finite() && step > 0.0) {
        return Err(FixedStepSpringsError::Step { step });
    }
    Ok(with_inertia(body, &integrator.checked()?))
}

/// The body with the rotational inertia that an integrator needs, if it has none of its own.
fn with_inertia(body: &Body<f64>, integrator: &Integrator) -> Body<f64> {
    let share = if integrator.ends_stiff_modes() { LEAST_INERTIA } else { INERTIA_FOR_RINGING };
    Body { inertia: body.inertia.max(share * body.mass * body.radius().powi(2)), ..*body }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rocking::structure::Structure;

    /// The paper's frame at 1e-3 s: 247 Hz.
    #[test]
    fn the_papers_frame_at_a_millisecond() {
        let body = Structure::paper().body::<f64>();
        let springs = FixedStepSprings::of(&body, 1e-3, Integrator::HHT_MOST).unwrap();
        assert_relative_eq!(springs.units.vertical.omega_n_hz, 247.0, max_relative = 3e-3);
        assert_relative_eq!(
            springs.rotational_inertia(),
            1e-3 * 680.1e3 * body.radius().powi(2),
            max_relative = 1e-12
        );
        let stable = FixedStepSprings::of(&body, 1e-3, Integrator::Trbdf2).unwrap();
        assert_relative_eq!(
            stable.rotational_inertia(),
            1e-5 * 680.1e3 * body.radius().powi(2),
            max_relative = 1e-12
        );
    }

    #[test]
    fn the_closed_form_is_what_it_says() {
        let body = Structure::block(2.6, 0.7, 1e3).unwrap().body::<f64>();
        let (p, alpha, step) = (body.p(), body.alpha(), 2.5e-4);
        let springs = FixedStepSprings::of(&body, step, Integrator::Trbdf2).unwrap();
        assert_eq!(springs.body.inertia, body.inertia);
        let Springs { vertical, horizontal } = springs.chains();
        assert_relative_eq!(
            vertical.in_series(),
            12.0 * body.mass * p / (alpha * alpha * step),
            max_relative = 1e-12
        );
        let omega = (vertical.k1 / body.mass).sqrt();
        assert_relative_eq!(omega, 7.75 * (p / step).sqrt() / alpha, max_relative = 1e-3);
        assert_relative_eq!(horizontal.k1, 16.0 * vertical.k1, max_relative = 1e-12);
        for unit in [vertical, horizontal] {
            let omega = (unit.k1 / body.mass).sqrt();
            assert_relative_eq!(unit.k2, 0.25 * unit.k1, max_relative = 1e-12);
            assert_relative_eq!(unit.m2, 0.2 * body.mass, max_relative = 1e-12);
            assert_relative_eq!(unit.c, 0.6 * body.mass * omega, max_relative = 1e-12);
        }
        // the stance is about half of the floor, 12 in place of 160/13
        let expected = springs.expected();
        assert_relative_eq!(
            expected.stance / expected.floor,
            0.5 * (160.0 / 13.0) / 12.0,
            max_relative = 1e-9
        );
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let body = Structure::paper().body::<f64>();
        for step in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
            let error = FixedStepSprings::of(&body, step, Integrator::Trbdf2).unwrap_err();
            assert!(matches!(error, FixedStepSpringsError::Step { .. }), "{error}");
        }
        assert!(FixedStepSprings::of(&body, 1e-3, Integrator::Hht { alpha: 0.9 }).is_err());
    }
}
