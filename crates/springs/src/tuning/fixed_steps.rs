//! Springs for programs with fixed time steps: units for the body's own landing, as stiff and with
//! as little rebound as the step has use for.
//!
//! ```text
//!   error of a history   floor    13 p dt
//!                        stance   80 (p/(alpha Omega_e))^2
//!                        rebound  20 alpha^3 (v_r/v_n)^2,   v_r/v_n about 0.8 K
//!
//!   stance  = floor/2  ->  k_e = k1 K/(1 + K) = 12 m p/(alpha^2 dt)
//!   rebound = floor/2  ->  K = sqrt(13 p dt/(2 20 0.8^2 alpha^3)),  at most 1/4
//!   units   mu = mu_u(K) M,  C = C_u(K) sqrt(M)  of what lands (`landing::design`)
//!           Omega_h/Omega_v at least 4, more under stocky frames
//! ```
//!
//! The floor is what springs cannot go below (`fixed_steps::expected`): a stance and a rebound
//! beyond half of it gain nothing, and stiffer springs, or softer k2, cost convergence. What such
//! springs err is measured by stepping the body as the program does, on the synthetic motions that
//! a run's other springs are judged on.
//!
//! Where a program loses more than one history in twenty on these units, as HHT does on some, those
//! of the recipe (`fixed_steps::recipe`) are tried, and kept if it loses fewer.
//!
//! Earthquake-like motions sway a frame before it lifts: there springs of twice Omega_n are better,
//! if the integrator ends stiff modes. Both are measured where a user asks for a program, and the
//! one is taken whose errors on both suites, multiplied, are less.

use rayon::prelude::*;

use super::{
    landing::{corners::CornerDynamics, design::for_landing},
    landing_simulation::differs_from_housner,
    suite::{JudgedOn, Suites},
};
use crate::case::Case;
use dynamics::{
    effort::Effort,
    spring::{Design, Springs},
};
use fixed_steps::{
    ExpectedError, FixedStepBody, FixedStepDesign, FixedStepProgram, FixedStepSprings,
    analysis::FixedStepOutcome,
    expected::{FLOOR, REBOUND},
    measured::{ErrorsOverMotions, ReferenceHistory, StepErrors},
    recipe::{FixedStepSpringsError, UnitNumbers},
};
use rocking::structure::Body;

/// Rebound v_r/v_n over K, of the universal chain.
const REBOUND_OVER_K: f64 = 0.8;
/// K at most: the body that lands in long steps.
const LARGEST_K: f64 = 0.25;
/// K at least: below it an absorber comes back late.
const LEAST_K: f64 = 0.02;
/// p dt up to which an error is told.
pub const LONGEST: f64 = 0.03;
/// Stance of springs of twice Omega_n, over that of the recipe.
const STIFFER: f64 = 4.0;
/// Histories that a program is to get through, of all.
pub const THROUGH: f64 = 0.95;

/// The design for a body and a step (s).
pub fn design(body: &Body<f64>, step: f64) -> FixedStepDesign {
    let floor = FLOOR * body.p_squared().sqrt() * step;
    let k = (floor / (2.0 * REBOUND * body.alpha().powi(3))).sqrt() / REBOUND_OVER_K;
    let corners = CornerDynamics::rigid(body.alpha(), body.mass_share());
    let effective = 1.0 - body.mass_share() * body.alpha().sin().powi(2);
    let Springs { vertical, horizontal } =
        for_landing(&corners, effective, k.clamp(LEAST_K, LARGEST_K));
    let numbers = |unit: &Design<f64>| UnitNumbers { k: unit.k(), c: unit.c(), mu: unit.mu };
    FixedStepDesign {
        vertical: numbers(&vertical),
        horizontal: numbers(&horizontal),
        horizontal_over_vertical: horizontal.omega_n_hz / vertical.omega_n_hz,
        ..FixedStepDesign::RECIPE
    }
}

/// Springs for a body in a program, and what they err.
#[derive(Clone, Debug)]
pub struct ProgramSprings {
    /// The program.
    pub program: FixedStepProgram,
    /// The springs, and the body as both models are to have it.
    pub springs: FixedStepSprings,
    /// The parts of the error, in closed form.
    pub expected: ExpectedError,
    /// Measured on synthetic motions; none of a step too long to promise anything, or if the run
    /// was stopped before.
    pub synthetic: Option<ErrorsOverMotions>,
    /// Measured on earthquake-like motions, if it was asked for.
    pub earthquakes: Option<ErrorsOverMotions>,
    /// Whether springs of twice the recipe's Omega_n were taken, for what they do on
    /// earthquake-like motions.
    pub stiffer: bool,
}

/// Motions, and Housner's answers of the body as the program has it.
struct ProgramSuites {
    synthetic: Vec<ReferenceHistory>,
    earthquakes: Vec<ReferenceHistory>,
}

impl ProgramSuites {
    fn of(body: &Body<f64>, suites: &Suites, earthquakes: bool) -> Self {
        let of = |on: JudgedOn| {
            let motions: Vec<_> = suites.motions(on).collect();
            let answers = motions
                .into_par_iter()
                .map(|(dt, accel)| ReferenceHistory::new(body, dt, accel.to_vec()));
            answers.flatten().collect()
        };
        let earthquakes = if earthquakes { of(JudgedOn::Earthquakes) } else { Vec::new() };
        Self { synthetic: of(JudgedOn::Synthetic), earthquakes }
    }
}

impl ProgramSprings {
    /// Springs for the program that a case asks for, or for the usual one; none for a restitution
    /// other than equation 2's, which such springs do not have.
    pub(crate) fn of_case(
        case: &Case,
        body: &Body<f64>,
        suites: &Suites,
        effort: &Effort,
    ) -> Option<Self> {
        if differs_from_housner(body, case.restitution) {
            return None;
        }
        let program = case.program.unwrap_or_else(FixedStepProgram::usual);
        Self::measured(body, program, suites, case.program.is_some(), effort).ok()
    }

    /// Springs for a body, measured on the synthetic motions of its suites; on the earthquake-like
    /// ones, too, if a user asked for this program.
    ///
    /// # Errors
    /// A step that is none; an integrator that is unstable.
    pub fn measured(
        body: &Body<f64>,
        program: FixedStepProgram,
        suites: &Suites,
        asked: bool,
        effort: &Effort,
    ) -> Result<Self, FixedStepSpringsError> {
        let own = design(body, program.step);
        let mut found = Self::closed_form(body, program, own)?;
        let promises = body.p_squared().sqrt() * program.step <= LONGEST;
        if !promises || effort.stopped() {
            return Ok(found);
        }
        let motions = ProgramSuites::of(&found.springs.body, suites, asked);
        let lost = found.measure(&motions);
        if found.share_lost() > 1.0 - THROUGH && !effort.stopped() {
            let mut recipe = Self::closed_form(body, program, FixedStepDesign::RECIPE)?;
            // one that loses all of these loses no fewer
            let lost: Vec<&ReferenceHistory> =
                lost.iter().map(|&i| &motions.synthetic[i]).collect();
            if recipe.errors(&lost).iter().any(is_through) {
                recipe.measure(&motions);
                found = if recipe.share_lost() < found.share_lost() { recipe } else { found };
            }
        }
        if asked && program.integrator.ends_stiff_modes() && !effort.stopped() {
            let design = FixedStepDesign { stance: STIFFER * own.stance, ..own };
            let mut stiffer = Self { stiffer: true, ..Self::closed_form(body, program, design)? };
            stiffer.measure(&motions);
            found = if stiffer.on_both() < found.on_both() { stiffer } else { found };
        }
        Ok(found)
    }

    fn closed_form(
        body: &Body<f64>,
        program: FixedStepProgram,
        design: FixedStepDesign,
    ) -> Result<Self, FixedStepSpringsError> {
        let FixedStepProgram { step, integrator, .. } = program;
        let springs = FixedStepSprings::designed(body, step, integrator, &design)?;
        let expected = springs.expected();
        Ok(Self { program, springs, expected, synthetic: None, earthquakes: None, stiffer: false })
    }

    /// Share of the synthetic motions that the program does not get through.
    fn share_lost(&self) -> f64 {
        self.synthetic
            .as_ref()
            .map_or(0.0, |errors| errors.lost() as f64 / errors.count().max(1) as f64)
    }

    /// Errors of the springs in the program, motion by motion.
    fn errors(&self, motions: &[&ReferenceHistory]) -> Vec<StepErrors> {
        let springs = &self.springs;
        let model = FixedStepBody::new(&springs.body, &springs.chains());
        let settings = self.program.settings(springs.chains().vertical.k1, springs.body.mass);
        motions.par_iter().map(|motion| motion.errors(&model, settings)).collect()
    }

    /// Over both suites; which of the synthetic motions are lost.
    fn measure(&mut self, motions: &ProgramSuites) -> Vec<usize> {
        let all = |motions: &[ReferenceHistory]| self.errors(&motions.iter().collect::<Vec<_>>());
        let [synthetic, earthquakes] = [&motions.synthetic, &motions.earthquakes].map(|m| all(m));
        let lost = (0..synthetic.len()).filter(|&i| !is_through(&synthetic[i])).collect();
        let some = |all: Vec<StepErrors>| (!all.is_empty()).then(|| ErrorsOverMotions::of(all));
        (self.synthetic, self.earthquakes) = (some(synthetic), some(earthquakes));
        lost
    }

    /// Median errors on both suites, multiplied.
    fn on_both(&self) -> f64 {
        let median = |errors: &Option<ErrorsOverMotions>| {
            errors.as_ref().map_or(1.0, |errors| errors.quantile(0.5))
        };
        median(&self.synthetic) * median(&self.earthquakes)
    }
}

/// Whether the program gets through a history.
fn is_through(errors: &StepErrors) -> bool {
    errors.outcome == FixedStepOutcome::Finished
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use fixed_steps::{Integrator, ProgramName};
    use rocking::structure::Structure;

    /// The rebound that K leaves is half of the floor, or K is 1/4.
    #[test]
    fn k_follows_from_the_step() {
        let body = Structure::block(2.0, 1.0, 1e3).unwrap().body::<f64>();
        for step in [2.5e-4, 1e-3] {
            let k = design(&body, step).vertical.k;
            let rebound = REBOUND * body.alpha().powi(3) * (REBOUND_OVER_K * k).powi(2);
            assert_relative_eq!(
                rebound,
                0.5 * FLOOR * body.p_squared().sqrt() * step,
                max_relative = 1e-9
            );
        }
        assert_relative_eq!(
            design(&Structure::paper().body(), 1e-3).vertical.k,
            LARGEST_K,
            max_relative = 1e-12
        );
    }

    /// The emulated rebound of the units in short steps is what the closed form counts on, within a
    /// half.
    #[test]
    fn units_rebound_as_counted_on() {
        let body = Structure::block(2.0, 1.0, 1e3).unwrap().body::<f64>();
        for step in [2.5e-5, 1e-4] {
            let design = design(&body, step);
            let springs =
                FixedStepSprings::designed(&body, step, Integrator::Trbdf2, &design).unwrap();
            let found = fixed_steps::rebound::rebound(
                &body,
                &springs.chains().vertical,
                1e-7,
                &Integrator::Trbdf2,
            );
            let counted = REBOUND_OVER_K * design.vertical.k;
            assert!((found / counted - 1.0).abs() < 0.5, "{found} {counted}");
        }
    }

    #[test]
    fn a_step_too_long_promises_nothing() {
        let body = Structure::block(0.3, 0.1, 10.0).unwrap().body::<f64>();
        let suites = Suites::of_seed(7, &body, body.restitution(), None);
        let program = FixedStepProgram::of(ProgramName::OpenSees, 1e-2);
        let found =
            ProgramSprings::measured(&body, program, &suites, true, &Effort::unbounded()).unwrap();
        assert!(found.synthetic.is_none() && found.earthquakes.is_none());
        let program = FixedStepProgram { step: 1e-3, ..program };
        let found =
            ProgramSprings::measured(&body, program, &suites, false, &Effort::unbounded()).unwrap();
        assert!(
            found.synthetic.is_some_and(|errors| errors.count() > 12)
                && found.earthquakes.is_none()
        );
    }
}
