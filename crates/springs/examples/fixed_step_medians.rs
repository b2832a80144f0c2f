//! The error of springs for fixed time steps over p dt, of the recipe (`fixed_steps::recipe`) and
//! of those of a run (`springs::fixed_steps`), on motions made for a body: median, 90 % quantile,
//! histories that the program gave up, for three bodies, four integrators, three steps; the same
//! with substeps down to a sixteenth of a step.
//!
//! ```sh
//! cargo run --release -p springs --example fixed_step_medians -- [MOTIONS] [SEED]
//! ```

#![allow(clippy::print_stdout)]

use std::env;

use fixed_steps::{FixedStepDesign, FixedStepSprings, Integrator, measured::WellConditioned};
use rocking::structure::{Structure, StructureError};
use springs::fixed_steps::design;

/// Motions of a suite that are looked at for one that is well-conditioned.
const LOOKED_AT: usize = 8;

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
    let seed = numbers.next().map_or(Ok(34), |n| n.parse())?;
    let integrators = [
        ("generalized alpha 0", Integrator::GENERALIZED_ALPHA_0),
        ("TRBDF2", Integrator::Trbdf2),
        ("BackwardEuler", Integrator::BackwardEuler),
        ("HHT -1/3", Integrator::HHT_MOST),
    ];
    println!(
        "| body | dt (s) | p dt | integrator | springs | median | 90 % | stopped | with substeps | \
         expected |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for (name, structure) in bodies()? {
        for (stepped, integrator) in integrators {
            let body = FixedStepSprings::of(&structure.body(), 1e-3, integrator)?.body;
            let motions = WellConditioned::of_seed(&body, seed, count, LOOKED_AT * count);
            for step in [1e-2, 1e-3, 2.5e-4] {
                let unit = body.p() * step;
                let designs = [FixedStepDesign::RECIPE, design(&body, step)];
                for (which, design) in ["recipe", "own"].into_iter().zip(designs) {
                    let springs = FixedStepSprings::designed(&body, step, integrator, &design)?;
                    println!(
                        "| {name} | {step} | {unit:.5} | {stepped} | {which} | {}",
                        row(&motions, &springs)
                    );
                }
            }
        }
    }
    Ok(())
}

/// Quantiles and stops without substeps, then with them; in units of p dt.
fn row(motions: &WellConditioned, springs: &FixedStepSprings) -> String {
    let (chains, settings) = (springs.chains(), springs.settings());
    let unit = springs.body.p() * springs.step;
    let [plain, finer] =
        [settings, settings.with_substeps(1.0 / 16.0)].map(|s| motions.errors(&chains, s));
    format!(
        "{:.1} | {:.1} | {} of {} | {:.1}, {:.1}, {} | {:.1} |",
        plain.quantile(0.5) / unit,
        plain.quantile(0.9) / unit,
        plain.stopped + plain.toppled,
        motions.motions.len(),
        finer.quantile(0.5) / unit,
        finer.quantile(0.9) / unit,
        finer.stopped + finer.toppled,
        springs.expected().median / unit
    )
}
