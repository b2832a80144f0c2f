//! Springs for fixed time steps on motions made for the body: the short form of the example
//! `fixed_step_medians`.

use fixed_steps::{FixedStepDesign, FixedStepSprings, Integrator, measured::WellConditioned};
use rocking::{statistics::quantile, structure::Structure};
use springs::fixed_steps::{DesignNumbers, design};

/// Median over p dt, at most.
const MOST: f64 = 22.0;
const INTEGRATORS: [Integrator; 3] =
    [Integrator::Trbdf2, Integrator::BackwardEuler, Integrator::GENERALIZED_ALPHA_0];

fn structures() -> [Structure; 4] {
    [
        Structure::paper(),
        Structure::a_frame(12.0, 2.2, 1e4).unwrap(),
        Structure::block(2.6, 0.7, 1e3).unwrap(),
        Structure::block(2.0, 0.9, 1e3).unwrap(),
    ]
}

/// Over structures and integrators together: a dozen motions of one alone have a median that
/// another dozen moves by a half.
#[test]
fn medians_are_near_the_floor() {
    for step in [1e-2, 1e-3] {
        let (mut errors, mut lost) = (Vec::new(), 0);
        for (structure, integrator) in structures().iter().flat_map(|s| INTEGRATORS.map(|i| (s, i)))
        {
            let design = design(&structure.body(), step);
            let springs =
                FixedStepSprings::designed(&structure.body(), step, integrator, &design).unwrap();
            let motions = WellConditioned::of_seed(&springs.body, 34, 8, 64);
            assert!(motions.motions.len() >= 6);
            let found =
                motions.errors(&springs.chains(), springs.settings().with_substeps(1.0 / 16.0));
            let unit = springs.body.p() * step;
            errors.extend(found.errors.iter().map(|error| error / unit));
            lost += found.lost();
        }
        errors.sort_by(f64::total_cmp);
        let median = quantile(&errors, 0.5).unwrap();
        assert!(median < MOST, "{step} s: {median}");
        assert!(lost * 50 <= errors.len(), "{step} s: {lost} of {} lost", errors.len() + lost);
    }
}

/// In steps that resolve a landing the recipe's units give back too much of it; K by the step and
/// units for the body's own landing leave less than half of its error.
#[test]
fn stocky_bodies_in_short_steps_need_units_of_their_own() {
    let step = 2.5e-4;
    for structure in &structures()[2..] {
        for integrator in INTEGRATORS {
            let median = |design: &FixedStepDesign| {
                let springs =
                    FixedStepSprings::designed(&structure.body(), step, integrator, design)
                        .unwrap();
                let motions = WellConditioned::of_seed(&springs.body, 34, 8, 64);
                motions
                    .errors(&springs.chains(), springs.settings().with_substeps(1.0 / 16.0))
                    .quantile(0.5)
            };
            let (own, recipe) =
                (median(&design(&structure.body(), step)), median(&FixedStepDesign::RECIPE));
            assert!(own < 0.5 * recipe, "{integrator}, {structure:?}: {own}, {recipe}");
        }
    }
}

/// Ten or twenty substeps in steps at touches break the floor, for a few more steps.
#[test]
fn refining_steps_at_touches_breaks_the_floor() {
    for (structure, substeps) in structures().into_iter().zip([10, 20]) {
        for integrator in [Integrator::Trbdf2, Integrator::BackwardEuler] {
            let substep = 1e-3 / substeps as f64;
            let design = DesignNumbers::AT_TOUCHES.design(&structure.body(), substep);
            let springs =
                FixedStepSprings::refined(&structure.body(), 1e-3, integrator, &design, substeps)
                    .unwrap();
            let motions = WellConditioned::of_seed(&springs.body, 77, 9, 72);
            let settings = springs.settings().with_substeps(1.0 / (8.0 * substeps as f64));
            let errors = motions.errors(&springs.chains(), settings);
            let median = errors.quantile(0.5) / (springs.body.p() * 1e-3);
            assert!(median < 4.0, "{integrator}, {structure:?}: {median}, {errors:?}");
            assert_eq!(errors.stopped, 0, "{integrator}, {structure:?}");
            let even: f64 =
                motions.motions.iter().map(|m| (m.accel.len() - 1) as f64 * m.dt / 1e-3).sum();
            assert!(
                (errors.steps as f64) < 1.2 * even,
                "{integrator}: {} steps, {even}",
                errors.steps
            );
        }
    }
}
