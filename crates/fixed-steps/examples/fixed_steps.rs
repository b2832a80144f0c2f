//! Histories with fixed time steps of cases on stdin, one JSON object a line; answers on stdout,
//! one a line. What `.ci/fixed_steps.py` compares with OpenSees.
//!
//! ```json
//! {"body": [height_m, half_width_m, mass_kg, inertia_kgm2], "vertical": [k1, k2, m2, c], "horizontal": [k1, k2, m2, c],
//!  "integrator": "trbdf2", "step": 0.001, "tolerance": 1e-12, "dt": 0.01, "accel": [0.0, 0.1]}
//! {"motions": 4, "seed": 1, "body": [61.0, 6.1, 680100.0, 0.0]}
//! ```

use std::{
    io::{BufRead, stdin},
    time::Instant,
};

use dynamics::spring::{Chain, Springs};
use fixed_steps::{ConvergenceTest, FixedStepAnalysis, FixedStepBody, Iteration};
use rocking::{structure::Body, synthetic};
use serde::Deserialize;
use serde_json::json;

#[derive(Deserialize)]
struct Asked {
    body: [f64; 4],
    motions: Option<usize>,
    seed: Option<u64>,
    vertical: Option<[f64; 4]>,
    horizontal: Option<[f64; 4]>,
    integrator: Option<String>,
    step: Option<f64>,
    tolerance: Option<f64>,
    dt: Option<f64>,
    accel: Option<Vec<f64>>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for line in stdin().lock().lines() {
        let asked: Asked = serde_json::from_str(&line?)?;
        let [height, half_width, mass, inertia] = asked.body;
        let body = Body { mass, half_width, height, inertia };
        let answer = match asked.motions {
            Some(count) => motions(&body, asked.seed.unwrap_or(1), count),
            None => history(&body, &asked).ok_or("a history needs springs, integrator, step, tolerance, dt, accel")?,
        };
        println!("{answer}");
    }
    Ok(())
}

/// Motions of the suite of a seed.
fn motions(body: &Body<f64>, seed: u64, count: usize) -> serde_json::Value {
    let (p, alpha) = (body.p_squared().sqrt(), body.alpha());
    let all = synthetic::suite(count, seed, p, alpha);
    all.map(|record| json!({"name": record.name, "dt": record.dt, "accel": record.accel})).collect()
}

fn history(body: &Body<f64>, asked: &Asked) -> Option<serde_json::Value> {
    let chain = |[k1, k2, m2, c]: [f64; 4]| Chain { k1, k2, m2, c };
    let springs = Springs { vertical: chain(asked.vertical?), horizontal: chain(asked.horizontal?) };
    let model = FixedStepBody::new(body, &springs);
    let accel = asked.accel.as_deref()?;
    let integrator = asked.integrator.as_deref()?.parse().ok()?;
    let iteration = Iteration { constant: 0, newton: 30, test: ConvergenceTest::Increment(asked.tolerance?) };
    let analysis =
        FixedStepAnalysis { iteration, ..FixedStepAnalysis::new(&model, integrator, asked.step?, asked.dt?, accel) };
    let begin = Instant::now();
    let history = analysis.history();
    let seconds = begin.elapsed().as_secs_f64();
    let stopped = history.through().err().map(|gave_up| gave_up.time);
    let motion = &history.motion;
    Some(json!({
        "u": motion.u, "v": motion.v, "theta": motion.theta, "stopped": stopped, "seconds": seconds,
        "steps": history.work.steps, "iterations": history.work.iterations,
    }))
}
