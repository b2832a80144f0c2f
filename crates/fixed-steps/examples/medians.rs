//! Median and 90 % quantile of the error over p dt, for three bodies, four integrators, several
//! steps: `cargo run --release -p fixed-steps --example medians -- [MOTIONS] [TOLERANCE over g dt^2]`.

use std::env;

use fixed_steps::{ConvergenceTest, FixedStepSprings, Integrator, Iteration, measured::WellConditioned};
use rocking::structure::{Structure, StructureError};

fn bodies() -> Result<[(&'static str, Structure); 3], StructureError> {
    Ok([
        ("frame 61 m", Structure::paper()),
        ("frame 12 m", Structure::a_frame(12.0, 2.2, 1e4)?),
        ("block 1.3 m", Structure::block(2.6, 0.7, 1e3)?),
    ])
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut numbers = env::args().skip(1);
    let count = numbers.next().map_or(Ok(24), |n| n.parse())?;
    let tolerance: Option<f64> = numbers.next().map(|n| n.parse()).transpose()?;
    let inertia: Option<f64> = numbers.next().map(|n| n.parse()).transpose()?;
    let integrators =
        [Integrator::GENERALIZED_ALPHA_0, Integrator::Trbdf2, Integrator::BackwardEuler, Integrator::HHT_MOST];
    println!(
        "| body | dt (s) | p dt | integrator | median/(p dt) | 90 %/(p dt) | stopped | toppled | of | expected/(p dt) |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for (name, structure) in bodies()? {
        for integrator in integrators {
            let mut body = structure.body();
            if let Some(share) = inertia {
                body.inertia = f64::max(body.inertia, share * body.mass * body.radius().powi(2));
            }
            let motions =
                WellConditioned::of_seed(&FixedStepSprings::of(&body, 1e-3, integrator)?.body, 34, count, 8 * count);
            for step in [1e-2, 1e-3, 2.5e-4] {
                let springs = FixedStepSprings::of(&body, step, integrator)?;
                let iteration = match tolerance {
                    Some(share) => Iteration {
                        test: ConvergenceTest::Increment(share * 9.81 * step * step),
                        ..springs.iteration()
                    },
                    None => springs.iteration(),
                };
                let errors = motions.errors(&springs.chains(), integrator, step, iteration);
                let unit = springs.body.p_squared().sqrt() * step;
                println!(
                    "| {name} | {step} | {unit:.5} | {integrator} | {:.1} | {:.1} | {} | {} | {} | {:.1} |",
                    errors.quantile(0.5) / unit,
                    errors.quantile(0.9) / unit,
                    errors.stopped,
                    errors.toppled,
                    motions.motions.len(),
                    springs.expected().median / unit
                );
            }
        }
    }
    Ok(())
}
