//! Springs for programs with one size of step.

use serde::Serialize;

use crate::{WebError, any_case::AnyCase, at_once::unit};
use fixed_steps::{
    FixedStepAnalysis, FixedStepBody, FixedStepOutcome, FixedStepSprings, Integrator,
};
use report::Unit;
use rocking::{
    housner::{RockingOptions, solve},
    motion::{Motion, nrmse},
    structure::Body,
};
use springs::fixed_steps::design;

/// Springs, what they err, and the history that the program would find.
#[derive(Serialize)]
pub(crate) struct FixedStepAnswer {
    springs: Vec<Unit>,
    omega_n_hz: f64,
    /// I_cg that the model is to have (kg m2).
    rotational_inertia_kgm2: f64,
    /// Test of the iteration: increment of displacements (m), iterations.
    tolerance_m: f64,
    /// Expected NRMSE of u: median and the 90 % quantile; the part that the step alone makes.
    median: f64,
    ninety: f64,
    floor: f64,
    /// On this record: NRMSE of u beside Housner's, none if it does not end as that does.
    nrmse: Option<f64>,
    /// Largest |theta|/alpha of this history and of Housner's.
    peak_ratio: [f64; 2],
    steps: usize,
    iterations: usize,
    /// How it ended.
    outcome: String,
}

pub(crate) fn answer(
    case: &AnyCase,
    step: f64,
    integrator: &str,
) -> Result<FixedStepAnswer, WebError> {
    let AnyCase::Rigid(case) = case else { return Err(WebError::FixedStepElastic) };
    let integrator: Integrator = integrator.parse()?;
    let body = case.structure.body::<f64>();
    let springs = FixedStepSprings::designed(&body, step, integrator, &design(&body, step))?;
    let record = case.excitation.used()?;
    let chains = springs.chains();
    let model = FixedStepBody::new(&springs.body, &chains);
    let settings = springs.settings();
    let analysis = FixedStepAnalysis {
        vertical: record.up(),
        ..FixedStepAnalysis::new(&model, settings, record.dt, &record.accel)
    };
    let history = analysis.history();
    let options = RockingOptions {
        restitution: Some(case.restitution),
        vertical: record.vertical_accel(),
        ..Default::default()
    };
    let housner = solve(&springs.body, record.dt, &record.accel, &options).motion(&springs.body);
    let expected = springs.expected();
    let tolerance_m = fixed_steps::recipe::TOLERANCE * rocking::scalar::GRAVITY * step.powi(2);
    Ok(FixedStepAnswer {
        springs: vec![unit("vertical", &chains.vertical), unit("horizontal", &chains.horizontal)],
        omega_n_hz: springs.units.vertical.omega_n_hz,
        rotational_inertia_kgm2: springs.rotational_inertia(),
        tolerance_m,
        median: expected.median,
        ninety: expected.ninety,
        floor: expected.floor,
        nrmse: beside(&history.outcome, &history.motion, &housner),
        peak_ratio: [&history.motion, &housner].map(|motion| peak_ratio(&springs.body, motion)),
        steps: history.work.steps,
        iterations: history.work.iterations,
        outcome: match history.outcome {
            FixedStepOutcome::Finished => "followed to its end".into(),
            FixedStepOutcome::Fallen { time } => format!("overturns at {time:.2} s"),
            FixedStepOutcome::GaveUp(gave_up) => gave_up.to_string(),
        },
    })
}

fn beside(outcome: &FixedStepOutcome, motion: &Motion, housner: &Motion) -> Option<f64> {
    let whole = matches!(outcome, FixedStepOutcome::Finished) && motion.len() == housner.len();
    whole.then(|| nrmse(&motion.u, &housner.u)).filter(|error| error.is_finite())
}

fn peak_ratio(body: &Body<f64>, motion: &Motion) -> f64 {
    motion.theta.iter().fold(0.0, |most: f64, theta| most.max(theta.abs())) / body.alpha()
}
