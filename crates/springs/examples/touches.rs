//! Touch refinement: median and 90 % quantile of the error with substeps in steps at touches, and
//! what they cost in steps.
//!
//! ```sh
//! cargo run --release -p springs --example touches -- [MOTIONS] [SEED]
//! ```

#![allow(clippy::print_stdout)]

use std::env;

use fixed_steps::{FixedStepDesign, FixedStepSprings, Integrator, measured::WellConditioned};
use rocking::structure::Structure;
use springs::fixed_steps::DesignNumbers;

const STEP: f64 = 1e-3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut numbers = env::args().skip(1);
    let count = numbers.next().map_or(Ok(24), |n| n.parse())?;
    let seed = numbers.next().map_or(Ok(77), |n| n.parse())?;
    println!(
        "| body | integrator | springs | substeps | median | 90 % | stopped | steps | expected |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for (name, structure) in [
        ("frame 61 m", Structure::paper()),
        ("frame 12 m", Structure::a_frame(12.0, 2.2, 1e4)?),
        ("block 1.3 m", Structure::block(2.6, 0.7, 1e3)?),
    ] {
        for integrator in [Integrator::Trbdf2, Integrator::BackwardEuler, Integrator::HHT_MOST] {
            let body = FixedStepSprings::of(&structure.body(), STEP, integrator)?.body;
            let motions = WellConditioned::of_seed(&body, seed, count, 8 * count);
            let even: f64 =
                motions.motions.iter().map(|m| (m.accel.len() - 1) as f64 * m.dt / STEP).sum();
            for (which, given) in [("recipe", Some(FixedStepDesign::RECIPE)), ("own", None)] {
                for substeps in [10, 20] {
                    let own = || DesignNumbers::AT_TOUCHES.design(&body, STEP / substeps as f64);
                    let design = given.unwrap_or_else(own);
                    let springs =
                        FixedStepSprings::refined(&body, STEP, integrator, &design, substeps)?;
                    let settings = springs.settings().with_substeps(1.0 / (8.0 * substeps as f64));
                    let errors = motions.errors(&springs.chains(), settings);
                    println!(
                        "| {name} | {integrator} | {which} | {substeps} | {:.5} | {:.4} | {} of {} \
                         | {:.2} | {:.5} |",
                        errors.quantile(0.5),
                        errors.quantile(0.9),
                        errors.stopped + errors.toppled,
                        motions.motions.len(),
                        errors.steps as f64 / even,
                        springs.expected().median
                    );
                }
            }
        }
    }
    Ok(())
}
