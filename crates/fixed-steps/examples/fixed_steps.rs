//! Histories with fixed time steps of cases on stdin, one JSON object a line; answers on stdout,
//! one a line. What `.ci/fixed_steps.py` compares with OpenSees.
//!
//! ```json
//! {"body": [height_m, half_width_m, mass_kg, inertia_kgm2], "vertical": [k1, k2, m2, c], "horizontal": [k1, k2, m2, c],
//!  "integrator": "trbdf2", "step": 0.001, "tolerance": 1e-12, "dt": 0.01, "accel": [0.0, 0.1]}
//! {"unbalance": 1e4, ... in place of "tolerance"}
//! {"pier": {"mass": 6e5, "height": 12.0, "width": 4.0, "footing": [1.2e5, 0.75, 1.5], "column": [EA, EI, eta_A, eta_I]}, ...}
//! {"motions": 4, "seed": 1, "body": [61.0, 6.1, 680100.0, 0.0]}
//! {"references": 4, "seed": 1, "body": [61.0, 6.1, 680100.0, 680.0]}
//! {"recipe": "trbdf2", "step": 0.001, "at_touches": 20, "body": [61.0, 6.1, 680100.0, 0.0]}
//! ```

use std::{
    error::Error,
    io::{BufRead, stdin},
    ops::ControlFlow,
    time::Instant,
};

use dynamics::spring::{Chain, Springs};
use fixed_steps::{
    ConvergenceTest, FixedStepAnalysis, FixedStepBody, FixedStepDesign, FixedStepFrame,
    FixedStepModel, FixedStepOutcome, FixedStepSprings, Iteration, MemberDamping, StepSettings,
    measured::WellConditioned,
};
use frames::{
    beam::BeamSection,
    frame::{Cantilever, Footing, StraightMember},
};
use rocking::{structure::Body, synthetic};
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
struct Pier {
    mass: f64,
    height: f64,
    width: f64,
    footing: [f64; 3],
    column: [f64; 4],
}

#[derive(Deserialize)]
struct Asked {
    body: Option<[f64; 4]>,
    pier: Option<Pier>,
    motions: Option<usize>,
    references: Option<usize>,
    seed: Option<u64>,
    recipe: Option<String>,
    at_touches: Option<usize>,
    substeps: Option<usize>,
    vertical: Option<[f64; 4]>,
    horizontal: Option<[f64; 4]>,
    integrator: Option<String>,
    step: Option<f64>,
    tolerance: Option<f64>,
    unbalance: Option<f64>,
    dt: Option<f64>,
    accel: Option<Vec<f64>>,
}

fn main() -> Result<(), Box<dyn Error>> {
    for line in stdin().lock().lines() {
        println!("{}", answer(&serde_json::from_str(&line?)?)?);
    }
    Ok(())
}

fn answer(asked: &Asked) -> Result<Value, Box<dyn Error>> {
    let body = asked.body.map(|[height, half_width, mass, inertia]| Body {
        mass,
        half_width,
        height,
        inertia,
    });
    match (&body, asked) {
        (Some(body), Asked { motions: Some(count), .. }) => {
            let (p, alpha) = (body.p(), body.alpha());
            let all = synthetic::suite(*count, asked.seed.unwrap_or(1), p, alpha);
            Ok(all
                .map(|record| json!({"name": record.name, "dt": record.dt, "accel": record.accel}))
                .collect())
        }
        (Some(body), Asked { references: Some(count), .. }) => {
            let all =
                WellConditioned::of_seed(body, asked.seed.unwrap_or(1), *count, 8 * count).motions;
            Ok(all
                .into_iter()
                .map(|motion| json!({"dt": motion.dt, "accel": motion.accel, "u": motion.u}))
                .collect())
        }
        (Some(body), Asked { recipe: Some(integrator), step: Some(step), .. }) => {
            let (integrator, design) = (integrator.parse()?, FixedStepDesign::RECIPE);
            let springs = match asked.at_touches {
                Some(substeps) => {
                    FixedStepSprings::refined(body, *step, integrator, &design, substeps)?
                }
                None => FixedStepSprings::of(body, *step, integrator)?,
            };
            let Springs { vertical, horizontal } = springs.chains();
            let unit = |c: Chain| [c.k1, c.k2, c.m2, c.c];
            let ConvergenceTest::Increment(tolerance) = springs.iteration().test else {
                return Err("no test".into());
            };
            Ok(json!({
                "vertical": unit(vertical), "horizontal": unit(horizontal),
                "inertia": springs.rotational_inertia(),
                "tolerance": tolerance, "median": springs.expected().median,
            }))
        }
        (Some(body), _) => {
            let model = FixedStepBody::new(body, &units(asked)?);
            history(&model, asked, |q| model.displacement(q))
        }
        (None, Asked { pier: Some(pier), .. }) => {
            let [mass, centre, top] = pier.footing;
            let [axial, bending, axial_damping, bending_damping] = pier.column;
            let section = BeamSection {
                axial_damping,
                bending_damping,
                ..BeamSection::elastic(axial, bending)
            };
            let footing = Footing::block(pier.width, mass, centre, top);
            let column = StraightMember { section, elements: 1 };
            let (mass, height) = (pier.mass, pier.height);
            let frame =
                Cantilever { mass, inertia: None, height, footing, column, consistent: false }
                    .layout()
                    .frame()?;
            let units = vec![units(asked)?; frame.places().len()];
            let model = FixedStepFrame::new(&frame, &units)?;
            let settled = frame.displacement(1, &model.standing()?.0)[1];
            history(&model, asked, |q| {
                let [x, z, _] = frame.displacement(1, q);
                [x, z - settled, frame.displacement(0, q)[2]]
            })
        }
        _ => Err("give a body or a pier".into()),
    }
}

fn units(asked: &Asked) -> Result<Springs<Chain>, Box<dyn Error>> {
    let chain = |[k1, k2, m2, c]: [f64; 4]| Chain { k1, k2, m2, c };
    let (vertical, horizontal) =
        asked.vertical.zip(asked.horizontal).ok_or("give vertical and horizontal units")?;
    Ok(Springs { vertical: chain(vertical), horizontal: chain(horizontal) })
}

fn history<M: FixedStepModel>(
    model: &M,
    asked: &Asked,
    shown: impl Fn(&M::Vector) -> [f64; 3],
) -> Result<Value, Box<dyn Error>> {
    let Asked { integrator: Some(integrator), step: Some(step), .. } = asked else {
        return Err("give integrator and step".into());
    };
    let test = match (asked.unbalance, asked.tolerance) {
        (Some(below), _) => ConvergenceTest::Unbalance(below),
        (None, Some(below)) => ConvergenceTest::Increment(below),
        _ => return Err("give a tolerance or an unbalance".into()),
    };
    let (dt, accel) = asked.dt.zip(asked.accel.as_deref()).ok_or("give dt and accel")?;
    let iteration = Iteration { constant: 0, newton: 30, test };
    let settings = StepSettings::new(integrator.parse()?, *step);
    let settings = StepSettings { iteration, damping: MemberDamping::OfChanges, ..settings };
    let at_touches = asked.at_touches.unwrap_or(1);
    let settings = settings.with_touches(at_touches);
    let settings = match asked.substeps {
        Some(parts) => settings.with_substeps(1.0 / (parts * at_touches) as f64),
        None => settings,
    };
    let analysis = FixedStepAnalysis::new(model, settings, dt, accel);
    let begin = Instant::now();
    let mut rows = Vec::with_capacity(accel.len());
    let (outcome, work) = analysis.follow(|_, q| {
        rows.push(shown(q));
        ControlFlow::Continue(())
    })?;
    let seconds = begin.elapsed().as_secs_f64();
    let stopped = match outcome {
        FixedStepOutcome::GaveUp(gave_up) => Some(gave_up.time),
        _ => None,
    };
    let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<_>>();
    Ok(json!({
        "u": column(0), "v": column(1), "theta": column(2), "stopped": stopped, "seconds": seconds,
        "steps": work.steps, "iterations": work.iterations,
    }))
}
