//! What springs for programs with fixed time steps err, and how near they come to the best there
//! are.
//!
//! ```sh
//! cargo bench --bench fixed_steps                 # error over the step, and figures/fixed_steps.png
//! cargo bench --bench fixed_steps -- search       # a run's beside the best of 500 springs drawn at random
//! cargo bench --bench fixed_steps -- stance       # error and lost histories over the stance
//! cargo bench --bench fixed_steps -- numbers      # the same over the units' numbers
//! cargo bench --bench fixed_steps -- tolerance    # the same over the tolerance of an unbalance
//! cargo bench --bench fixed_steps -- events       # with and without event-to-event stepping
//! ```
//!
//! Motions are of seed 31; the search chooses on those of seed 77. No spring of the program was
//! chosen on either. The stances that a run tries (`springs::fixed_steps::STANCES`) were chosen by
//! what the third command prints, the numbers of the units (`DesignNumbers::EVEN`) by what the
//! fourth does, the tolerance of an unbalance (`fixed_steps::program`) by what the fifth does, on
//! motions of seeds 5 and 6.

use std::path::Path;

use dynamics::effort::Effort;
use figures::precision::{self, PrecisionFigure, ToolSeries};
use fixed_steps::{
    ConvergenceTest, EventStepping, FixedStepBody, FixedStepDesign, FixedStepProgram,
    FixedStepSprings, Integrator, ProgramName, StepSettings,
    expected::FLOOR,
    measured::{ErrorsOverMotions, WellConditioned},
    recipe::UnitNumbers,
};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use rocking::structure::{Body, Structure};
use springs::{
    fixed_steps::{DesignNumbers, LONGEST, ProgramSprings, design},
    suite::{self, Suites},
};

type BenchError = Box<dyn std::error::Error>;

/// Seeds of motions: measured on, chosen on by the search.
const SEED: u64 = 31;
const SEARCHED_ON: u64 = 77;
/// Motions of a row, of so many that are looked at.
const MOTIONS: usize = 24;
const LOOKED_AT: usize = 200;
/// Steps (s).
const STEPS: [f64; 6] = [1e-2, 4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4];
/// The step of the search (s), and how many springs it tries.
const SEARCH_STEP: f64 = 1e-3;
const EVALUATIONS: usize = 500;

/// Stances of the third command, numbers of the fourth, tolerances of the fifth (over
/// W tan(alpha)); the seeds of their motions, how many motions, and their steps (s).
const STANCES: [f64; 8] = [4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0];
const REBOUNDS: [f64; 3] = [0.5, 0.75, 1.5];
const LARGEST_K: [f64; 3] = [0.25, 0.5, 1.0];
const MASS_RATIOS: [f64; 3] = [0.25, 0.5, 1.0];
const TOLERANCES: [f64; 6] = [0.5, 0.7, 1.0, 1.41, 2.0, 3.0];
const CHOSEN_ON_SEEDS: [u64; 2] = [5, 6];
const CHOSEN_ON_MOTIONS: usize = 64;
const CHOSEN_ON_STEPS: [f64; 3] = [1e-2, 1e-3, 2.5e-4];

/// Motions of a row of the sixth command, its steps (s), and its programs: those of CSI test the
/// unbalance, scripts the change of place.
const EVENT_MOTIONS: usize = 64;
const EVENT_STEPS: [f64; 2] = [1e-2, 1e-3];
const EVENT_PROGRAMS: [(&str, Option<ProgramName>, Integrator); 4] = [
    ("SAP2000, HHT -1/3", Some(ProgramName::Sap2000), Integrator::HHT_MOST),
    ("SAP2000, HHT 0", Some(ProgramName::Sap2000), Integrator::Hht { alpha: 0.0 }),
    ("script, HHT -1/3", None, Integrator::HHT_MOST),
    ("script, TRBDF2", None, Integrator::Trbdf2),
];

const INTEGRATORS: [(&str, Integrator); 4] = [
    ("TRBDF2", Integrator::Trbdf2),
    ("backward Euler", Integrator::BackwardEuler),
    ("HHT, alpha = -1/3", Integrator::HHT_MOST),
    ("HHT, alpha = -0.1", Integrator::Hht { alpha: -0.1 }),
];

fn bodies() -> Result<[(&'static str, Body<f64>); 3], BenchError> {
    Ok([
        ("A-frame 61 m high, feet 12.2 m apart", Structure::paper().body()),
        ("A-frame 12 m high, feet 2.4 m apart", Structure::a_frame(12.0, 2.4, 2e5)?.body()),
        ("block 2.6 m high, 0.9 m wide", Structure::block(2.6, 0.9, 2e3)?.body()),
    ])
}

/// Springs of a design, stepped over motions.
fn errors(
    of: &WellConditioned,
    step: f64,
    integrator: Integrator,
    numbers: &FixedStepDesign,
) -> Option<ErrorsOverMotions> {
    let program = FixedStepProgram { name: None, integrator, step, ..FixedStepProgram::usual() };
    errors_with(of, &program, numbers, None)
}

/// The same in any program, steps cut at events or not.
fn errors_with(
    of: &WellConditioned,
    program: &FixedStepProgram,
    numbers: &FixedStepDesign,
    events: Option<EventStepping>,
) -> Option<ErrorsOverMotions> {
    let FixedStepProgram { integrator, step, .. } = *program;
    let springs = FixedStepSprings::designed(&of.body, step, integrator, numbers).ok()?;
    Some(errors_of(of, program, &springs, events))
}

/// The same of springs.
fn errors_of(
    of: &WellConditioned,
    program: &FixedStepProgram,
    springs: &FixedStepSprings,
    events: Option<EventStepping>,
) -> ErrorsOverMotions {
    let settings = program.settings(springs.body.lifting_force());
    errors_in(of, springs, StepSettings { events, ..settings })
}

/// The same in steps that are set so.
fn errors_in(
    of: &WellConditioned,
    springs: &FixedStepSprings,
    settings: StepSettings,
) -> ErrorsOverMotions {
    let model = FixedStepBody::new(&springs.body, &springs.chains());
    let all = of.motions.par_iter().map(|motion| motion.errors(&model, settings));
    ErrorsOverMotions::of(all.collect::<Vec<_>>())
}

fn over_steps() -> Result<(), BenchError> {
    let mut sheets = Vec::new();
    println!("median NRMSE over p dt; motions lost");
    for (name, body) in bodies()? {
        let p = body.p();
        let of = WellConditioned::of_seed(&body, SEED, MOTIONS, LOOKED_AT);
        let floor: Vec<(f64, f64)> = STEPS.iter().map(|dt| (*dt, FLOOR * p * dt)).collect();
        let mut series = vec![("floor, 13 p dt".to_string(), floor)];
        for (integrator_name, integrator) in INTEGRATORS {
            let mut points = Vec::new();
            let mut line = String::new();
            for step in STEPS {
                let own = design(&body, step);
                let Some(errors) = errors(&of, step, integrator, &own) else { continue };
                let median = errors.quantile(0.5);
                line += &format!("  {:6.1} ({})", median / (p * step), errors.lost());
                if median.is_finite() {
                    points.push((step, median));
                }
            }
            println!("{name}, {integrator_name}, {} motions: {line}", of.motions.len());
            series.push((integrator_name.to_string(), points));
        }
        series.retain(|(_, points)| !points.is_empty());
        let remark = "motions of a seed that nothing was chosen on; where the program loses half \
            of them there is no point";
        sheets.push((format!("{name}\n{} {remark}", of.motions.len()), series));
    }
    let series: Vec<Vec<ToolSeries>> = sheets
        .iter()
        .map(|(_, all)| all.iter().map(|(label, points)| ToolSeries { label, points }).collect())
        .collect();
    let figures: Vec<PrecisionFigure> = sheets
        .iter()
        .zip(&series)
        .map(|((title, _), series)| PrecisionFigure {
            title: title.as_str(),
            error_label: "time step of the program (s)",
            time_label: "error of the history, NRMSE, median",
            series,
        })
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../figures/fixed_steps.png");
    precision::draw(&figures)?.save(&path)?;
    println!("{}", path.display());
    Ok(())
}

/// Springs drawn evenly in the logarithms of their numbers.
fn drawn(random: &mut ChaCha8Rng) -> FixedStepDesign {
    let mut between = |least: f64, most: f64| (random.random_range(least.ln()..most.ln())).exp();
    let mut unit =
        || UnitNumbers { k: between(0.02, 1.0), c: between(0.1, 3.0), mu: between(0.02, 1.0) };
    let (vertical, horizontal) = (unit(), unit());
    FixedStepDesign {
        stance: between(3.0, 200.0),
        vertical,
        horizontal,
        horizontal_over_vertical: between(1.0, 16.0),
    }
}

/// What the springs err that a run takes for this integrator, chosen on its suites.
fn errors_of_a_run(
    of: &WellConditioned,
    suites: &Suites,
    integrator: Integrator,
) -> Result<ErrorsOverMotions, BenchError> {
    let step = SEARCH_STEP;
    let program = FixedStepProgram { name: None, integrator, step, ..FixedStepProgram::usual() };
    let run = ProgramSprings::measured(&of.body, program, suites, true, &Effort::unbounded())?;
    Ok(errors_of(of, &program, &run.springs, None))
}

fn search() -> Result<(), BenchError> {
    println!(
        "median NRMSE over p dt at {SEARCH_STEP} s: a run's springs, the best of {EVALUATIONS}"
    );
    for (name, body) in bodies()? {
        let p_dt = body.p() * SEARCH_STEP;
        let chosen_on = WellConditioned::of_seed(&body, SEARCHED_ON, MOTIONS, LOOKED_AT);
        let judged_on = WellConditioned::of_seed(&body, SEED, MOTIONS, LOOKED_AT);
        let suites = Suites::of_seed(suite::SEED, &body, body.restitution(), None);
        for (integrator_name, integrator) in &INTEGRATORS[..3] {
            let median = |of: &WellConditioned, numbers: &FixedStepDesign| {
                errors(of, SEARCH_STEP, *integrator, numbers)
                    .map_or(f64::INFINITY, |errors| errors.quantile(0.5))
            };
            let mut random = ChaCha8Rng::seed_from_u64(SEED);
            let mut best = (f64::INFINITY, FixedStepDesign::RECIPE);
            for _ in 0..EVALUATIONS {
                let numbers = drawn(&mut random);
                let found = median(&chosen_on, &numbers);
                if found < best.0 {
                    best = (found, numbers);
                }
            }
            let own = errors_of_a_run(&judged_on, &suites, *integrator)?.quantile(0.5);
            let found = median(&judged_on, &best.1);
            println!(
                "{name}, {integrator_name}: {:.1}, {:.1}; ratio {:.2}",
                own / p_dt,
                found / p_dt,
                own / found
            );
        }
    }
    Ok(())
}

/// Over seven bodies and three steps, for every number: geometric mean and largest of the medians
/// over p dt, histories lost.
fn over_bodies(
    name: &str,
    integrator: Integrator,
    numbers: &[f64],
    errors: impl Fn(f64, &WellConditioned, f64) -> Option<ErrorsOverMotions>,
) -> Result<(), BenchError> {
    let more = [
        ("A-frame 10 m high, feet 3.6 m apart", Structure::a_frame(10.0, 3.6, 2e5)?.body()),
        ("A-frame 30 m high, feet 3 m apart", Structure::a_frame(30.0, 3.0, 2e5)?.body()),
        ("block 2.6 m high, 1.1 m wide", Structure::block(2.6, 1.1, 2e3)?.body()),
        ("block 1 m high, 0.2 m wide", Structure::block(1.0, 0.2, 2e3)?.body()),
    ];
    let mut suites = Vec::new();
    for (_, body) in bodies()?.into_iter().chain(more) {
        let body = FixedStepSprings::of(&body, 1e-3, integrator)?.body;
        let of = |seed| WellConditioned::of_seed(&body, seed, CHOSEN_ON_MOTIONS, 960);
        suites.extend(CHOSEN_ON_SEEDS.map(of));
    }
    for &number in numbers {
        let (mut medians, mut lost, mut count) = (Vec::new(), 0, 0);
        for (of, step) in suites.iter().flat_map(|of| CHOSEN_ON_STEPS.map(|step| (of, step))) {
            let p_dt = of.body.p() * step;
            let found = if p_dt < LONGEST { errors(number, of, step) } else { None };
            if let Some(errors) = found {
                medians.push(errors.quantile(0.5) / p_dt);
                lost += errors.lost();
                count += errors.count();
            }
        }
        let mean = medians.iter().map(|m| m.ln()).sum::<f64>() / medians.len() as f64;
        let most = medians.iter().copied().fold(0.0, f64::max);
        println!("{name}, {number}: {:.1}, {most:.1}; {lost} of {count}", mean.exp());
    }
    Ok(())
}

fn stance() -> Result<(), BenchError> {
    println!("stance: geometric mean, largest median NRMSE over p dt; histories lost");
    for (name, integrator) in &INTEGRATORS[..3] {
        over_bodies(name, *integrator, &STANCES, |stance, of, step| {
            let springs = FixedStepDesign { stance, ..design(&of.body, step) };
            errors(of, step, *integrator, &springs)
        })?;
    }
    Ok(())
}

/// Each number of the units beside others, at a stance of 10.
fn numbers() -> Result<(), BenchError> {
    println!("numbers: geometric mean, largest median NRMSE over p dt; histories lost");
    let chosen = DesignNumbers { stance: 10.0, ..DesignNumbers::EVEN };
    type With = fn(DesignNumbers, f64) -> DesignNumbers;
    let over: [(&str, [f64; 3], With); 3] = [
        ("rebound/floor", REBOUNDS, |of, rebound| DesignNumbers { rebound, ..of }),
        ("largest K", LARGEST_K, |of, largest_k| DesignNumbers { largest_k, ..of }),
        ("mu/(mu_u M)", MASS_RATIOS, |of, mu| DesignNumbers { mu, ..of }),
    ];
    for (what, values, with) in over {
        for (name, integrator) in &INTEGRATORS[..3] {
            over_bodies(&format!("{what}, {name}"), *integrator, &values, |value, of, step| {
                errors(of, step, *integrator, &with(chosen, value).design(&of.body, step))
            })?;
        }
    }
    Ok(())
}

fn tolerance() -> Result<(), BenchError> {
    println!("unbalance over W tan(alpha): geometric mean, largest median over p dt; lost");
    let integrator = Integrator::HHT_MOST;
    for stance in [12.0, 7.0] {
        let name = format!("SAP2000, HHT -1/3, stance {stance}");
        over_bodies(&name, integrator, &TOLERANCES, |below, of, step| {
            let numbers = FixedStepDesign { stance, ..design(&of.body, step) };
            let springs = FixedStepSprings::designed(&of.body, step, integrator, &numbers).ok()?;
            let lifting = springs.body.lifting_force();
            let program = FixedStepProgram::of(ProgramName::Sap2000, step);
            let mut settings = program.settings(lifting);
            settings.iteration.test = ConvergenceTest::Unbalance(below * lifting);
            Some(errors_in(of, &springs, settings))
        })?;
    }
    Ok(())
}

/// What cutting steps at events does: median NRMSE over p dt and histories lost without and with
/// it, and how many times the iterations it takes.
fn events() -> Result<(), BenchError> {
    println!("median NRMSE over p dt (lost): without, with event-to-event stepping; iterations");
    for (name, body) in bodies()? {
        for step in EVENT_STEPS {
            let (own, p_dt) = (design(&body, step), body.p() * step);
            for (program_name, name_of, integrator) in EVENT_PROGRAMS {
                let body = FixedStepSprings::designed(&body, step, integrator, &own)?.body;
                let of = WellConditioned::of_seed(&body, SEED, EVENT_MOTIONS, 960);
                let usual = FixedStepProgram::usual();
                let program = FixedStepProgram { name: name_of, integrator, step, ..usual };
                let found = [None, Some(EventStepping::USUAL)]
                    .map(|events| errors_with(&of, &program, &own, events));
                let [Some(without), Some(with)] = found else { continue };
                let told = |errors: &ErrorsOverMotions| {
                    format!("{:.1} ({})", errors.quantile(0.5) / p_dt, errors.lost())
                };
                println!(
                    "{name}, {step} s, {program_name}, {} motions: {}, {}; {:.2} times",
                    of.motions.len(),
                    told(&without),
                    told(&with),
                    with.iterations as f64 / without.iterations as f64
                );
            }
        }
    }
    Ok(())
}

fn main() -> Result<(), BenchError> {
    match std::env::args().nth(1).as_deref() {
        Some("search") => search(),
        Some("stance") => stance(),
        Some("numbers") => numbers(),
        Some("tolerance") => tolerance(),
        Some("events") => events(),
        _ => over_steps(),
    }
}
