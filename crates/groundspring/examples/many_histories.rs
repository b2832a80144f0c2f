//! Ten thousand histories and a row of each, as `groundspring.rocking` has them in Python:
//! `python/benches/many_histories.py` sets the two side by side.
//!
//! ```sh
//! cargo run --release --package groundspring --example many_histories [rounds]
//! ```

#![allow(clippy::print_stdout)]

use std::{f64::consts::FRAC_PI_2, time::Instant};

use groundspring::{Body, Record, Rocking, RockingOptions, RockingOutcome, Structure, rock_many};
use rayon::prelude::*;

/// Histories solved in one call: their samples stay in the cache.
const TOGETHER: usize = 256;

/// What is kept of a history.
struct Peak {
    ratio: f64,
    rate: f64,
    u: f64,
    time: f64,
    uplift: Option<f64>,
    impacts: usize,
    last_impact: Option<f64>,
    outcome: RockingOutcome,
}

impl Peak {
    fn new(body: &Body<f64>, dt: f64, rocking: &Rocking<f64>) -> Self {
        let (mut at, mut theta) = (0, 0.0);
        for (i, x) in rocking.theta.iter().enumerate() {
            if x.abs() > theta {
                (at, theta) = (i, x.abs());
            }
        }
        let lies = rocking.overturned().is_some();
        Self {
            ratio: if lies { FRAC_PI_2 } else { theta } / body.alpha(),
            rate: rocking.rate.iter().fold(0.0, |peak: f64, x| peak.max(x.abs())),
            u: body.u(theta).abs(),
            time: at as f64 * dt,
            uplift: rocking.uplifts.first().map(|uplift| uplift.time),
            impacts: rocking.impacts.len(),
            last_impact: rocking.impacts.last().map(|impact| impact.time),
            outcome: rocking.outcome,
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rounds: usize = std::env::args().nth(1).map_or(Ok(3), |rounds| rounds.parse())?;
    let mut structures = Vec::new();
    for i in 0..20_i32 {
        structures.push(Structure::block(2.0 + 0.2 * f64::from(i), 0.8, 1000.0)?);
    }
    let records: Vec<Record> = [20.0, 25.0, 30.0, 35.0, 40.0]
        .iter()
        .map(|&seconds| Record::el_centro().truncated(seconds))
        .collect();
    let mut jobs = Vec::new();
    for structure in &structures {
        for scale in (1..=100).map(|k| 0.02 * f64::from(k)) {
            jobs.push((structure.body::<f64>(), RockingOptions { scale, ..Default::default() }));
        }
    }
    for _ in 0..rounds {
        let start = Instant::now();
        let tasks: Vec<_> = records
            .iter()
            .flat_map(|record| jobs.chunks(TOGETHER).map(move |jobs| (record, jobs)))
            .collect();
        let peaks: Vec<Peak> = tasks
            .par_iter()
            .flat_map_iter(|(record, jobs)| {
                let (bodies, options): (Vec<_>, Vec<_>) = jobs.iter().cloned().unzip();
                let histories = rock_many(&bodies, record.dt, &record.accel, &options);
                let row = |(body, rocking)| Peak::new(body, record.dt, rocking);
                bodies.iter().zip(&histories).map(row).collect::<Vec<_>>()
            })
            .collect();
        let seconds = start.elapsed().as_secs_f64();
        let overturned =
            peaks.iter().filter(|p| matches!(p.outcome, RockingOutcome::Overturned { .. })).count();
        let impacts: usize = peaks.iter().map(|peak| peak.impacts).sum();
        let sum: f64 = peaks.iter().map(|peak| peak.ratio + peak.rate + peak.u + peak.time).sum();
        let times: f64 = peaks.iter().filter_map(|p| Some(p.uplift? + p.last_impact?)).sum();
        println!("{seconds:.6} {} {overturned} {impacts} {sum:.6} {times:.6}", peaks.len());
    }
    Ok(())
}
