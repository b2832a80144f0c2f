//! The springs in closed form on motions made for the body: the short form of the example
//! `medians`.

use fixed_steps::{FixedStepDesign, FixedStepSprings, Integrator, measured::WellConditioned};
use rocking::structure::Structure;

/// Median over p dt, at most.
const MOST: f64 = 22.0;

#[test]
fn medians_are_near_the_floor() {
    let frames = [Structure::paper(), Structure::a_frame(12.0, 2.2, 1e4).unwrap()];
    let blocks = [Structure::block(2.6, 0.7, 1e3).unwrap()];
    let all = [(&frames[..], 1e-2), (&frames[..], 1e-3), (&blocks[..], 1e-2)];
    for (structures, step) in all {
        for structure in structures {
            for integrator in [Integrator::Trbdf2, Integrator::BackwardEuler, Integrator::GENERALIZED_ALPHA_0] {
                let springs = FixedStepSprings::of(&structure.body(), step, integrator).unwrap();
                let motions = WellConditioned::of_seed(&springs.body, 34, 9, 72);
                assert!(motions.motions.len() >= 6);
                let settings = springs.settings().with_substeps(1.0 / 16.0);
                let errors = motions.errors(&springs.chains(), settings);
                let median = errors.quantile(0.5) / (springs.body.p_squared().sqrt() * step);
                assert!(median < MOST, "{integrator}, {step} s, {structure:?}: {median}, {errors:?}");
                assert_eq!(errors.stopped, 0, "{integrator}, {step} s, {structure:?}");
            }
        }
    }
}

/// Ten or twenty substeps in steps at touches break the floor, for a few more steps.
#[test]
fn refining_steps_at_touches_breaks_the_floor() {
    for (structure, design, substeps) in [
        (Structure::paper(), FixedStepDesign::RESOLVED, 10),
        (Structure::a_frame(12.0, 2.2, 1e4).unwrap(), FixedStepDesign::RECIPE, 20),
    ] {
        for integrator in [Integrator::Trbdf2, Integrator::BackwardEuler] {
            let springs = FixedStepSprings::refined(&structure.body(), 1e-3, integrator, &design, substeps).unwrap();
            let motions = WellConditioned::of_seed(&springs.body, 77, 9, 72);
            let settings = springs.settings().with_substeps(1.0 / (8.0 * substeps as f64));
            let errors = motions.errors(&springs.chains(), settings);
            let median = errors.quantile(0.5) / (springs.body.p_squared().sqrt() * 1e-3);
            assert!(median < 4.0, "{integrator}, {structure:?}: {median}, {errors:?}");
            assert_eq!(errors.stopped, 0, "{integrator}, {structure:?}");
            let even: f64 = motions.motions.iter().map(|m| (m.accel.len() - 1) as f64 * m.dt / 1e-3).sum();
            assert!((errors.steps as f64) < 1.2 * even, "{integrator}: {} steps, {even}", errors.steps);
        }
    }
}
