//! The rigid body in fixed steps beside other programs, and what must hold whatever the steps.

use dynamics::{fem::Analysis, spring::Chain};
use fixed_steps::{
    ConvergenceTest, FixedStepAnalysis, FixedStepBody, FixedStepOutcome, FixedStepSprings,
    Integrator, Iteration, StepSettings,
};
use rocking::{motion::nrmse, structure::Structure};

use crate::common::{DT, block, newton, pulse, units};

fn tight(integrator: Integrator, step: f64) -> StepSettings {
    newton(integrator, step, 1e-9)
}

/// With short steps every integrator comes to the history of the finite elements that follow events
/// (`dynamics::fem`), an independent program.
#[test]
fn short_steps_come_to_what_follows_events() {
    let body = block();
    let (springs, accel) = (units(body.mass, 20.0), pulse(4.5));
    let events = Analysis::new(body, springs, DT, &accel).simulate();
    let model = FixedStepBody::new(&body, &springs);
    assert!(events.motion.theta.iter().any(|theta| theta.abs() > 0.2 * body.alpha()));
    for integrator in [Integrator::AVERAGE_ACCELERATION, Integrator::HHT_MOST, Integrator::Trbdf2] {
        let error = |step: f64| {
            let history =
                FixedStepAnalysis::new(&model, tight(integrator, step), DT, &accel).history();
            assert_eq!(history.outcome, FixedStepOutcome::Finished, "{integrator}, {step}");
            nrmse(&history.motion.u, &events.motion.u)
        };
        let (long, short) = (error(1e-3), error(2e-5));
        assert!(short < 1.5e-3 && short < 0.2 * long, "{integrator}: {long}, {short}");
    }
}

/// u of the centre of mass, m, by OpenSees 3.7.1: our deck's model (`.ci/fixed_steps.py`) of the
/// block on plain units of 20 Hz under the pulse, stepped by 1e-3 s.
#[test]
fn opensees_has_the_same_history() {
    let body = block();
    let (springs, accel) = (units(body.mass, 20.0), pulse(4.5));
    let model = FixedStepBody::new(&body, &springs);
    for (name, at) in OPENSEES {
        let settings = tight(name.parse().unwrap(), 1e-3);
        let history = FixedStepAnalysis::new(&model, settings, DT, &accel).history();
        for (i, u) in at {
            let found = history.motion.u[i];
            assert!((found - u).abs() < 1e-6 * 0.1, "{name}, sample {i}: {found:e}, {u:e}");
        }
    }
}

/// Sample and u.
const OPENSEES: [(&str, [(usize, f64); 3]); 4] = [
    (
        "newmark:0.5:0.25",
        [(120, -9.071370381e-02), (200, 1.132591821e-01), (290, -7.010582694e-02)],
    ),
    (
        "hht:-0.3333333333333333",
        [(120, -9.071217777e-02), (200, 1.132287987e-01), (290, -7.004658778e-02)],
    ),
    ("trbdf2", [(120, -9.071427845e-02), (200, 1.132822857e-01), (290, -7.015346031e-02)]),
    ("backward-euler", [(120, -9.071246545e-02), (200, 1.132200226e-01), (290, -7.001247308e-02)]),
];

/// The mirrored record gives the mirrored history.
#[test]
fn left_is_right() {
    let body = block();
    let accel = pulse(4.5);
    let mirrored: Vec<f64> = accel.iter().map(|a| -a).collect();
    let springs = FixedStepSprings::of(&body, 1e-3, Integrator::Trbdf2).unwrap();
    let model = FixedStepBody::new(&body, &springs.chains());
    let [a, b] = [&accel, &mirrored]
        .map(|accel| FixedStepAnalysis::new(&model, springs.settings(), DT, accel).history());
    let back: Vec<f64> = b.motion.u.iter().map(|u| -u).collect();
    assert!(nrmse(&back, &a.motion.u) < 1e-6);
    assert!(nrmse(&b.motion.v, &a.motion.v) < 1e-6);
}

/// Vertical ground motion of a standing body: a slow push sinks it by m a/(2 k_e), and by what the
/// absorber's own weight m2 a does to k2.
#[test]
fn a_slow_push_upwards_sinks_it() {
    let body = block();
    let springs = units(body.mass, 20.0);
    let model = FixedStepBody::new(&body, &springs);
    let push = 2.0;
    let vertical: Vec<f64> = (0..600).map(|i| push * (i as f64 / 300.0).min(1.0)).collect();
    let accel = vec![0.0; 600];
    let analysis = FixedStepAnalysis {
        vertical: &vertical,
        ..FixedStepAnalysis::new(&model, tight(Integrator::HHT_MOST, 1e-2), DT, &accel)
    };
    let history = analysis.history();
    let Chain { k2, m2, .. } = springs.vertical;
    let sunk = -push * (0.5 * body.mass / springs.vertical.in_series() + m2 / k2);
    let last = history.motion.v[599];
    assert!((last / sunk - 1.0).abs() < 1e-3, "{last}, {sunk}");
    assert!(history.motion.u.iter().all(|u| u.abs() < 1e-12));
}

/// A program that cannot converge says when; with substeps it goes on. On stiff springs without
/// algorithmic damping a frame does not get through.
#[test]
fn giving_up_has_a_time_and_substeps_help() {
    let body = FixedStepSprings::of(
        &Structure::a_frame(12.0, 2.2, 1e4).unwrap().body(),
        1e-3,
        Integrator::Trbdf2,
    )
    .unwrap()
    .body;
    let model = FixedStepBody::new(&body, &units(body.mass, 160.0));
    let accel = pulse(3.0);
    let settings = tight(Integrator::AVERAGE_ACCELERATION, 1e-3);
    let history = FixedStepAnalysis::new(&model, settings, DT, &accel).history();
    let gave_up = history.through().unwrap_err();
    assert!(gave_up.time > 0.0 && gave_up.time < 3.0 && gave_up.step == 1e-3, "{gave_up:?}");
    assert!(gave_up.to_string().contains("no convergence at"), "{gave_up}");
    assert_eq!(history.motion.len(), (gave_up.time / DT + 1e-9) as usize + 1);
    let finer =
        FixedStepAnalysis::new(&model, settings.with_substeps(1.0 / 1024.0), DT, &accel).history();
    assert!(finer.motion.len() > history.motion.len() && finer.work.failed > 0, "{:?}", finer.work);
}

/// Constant-stiffness iterations arrive where Newton's do.
#[test]
fn iterations_of_both_kinds_arrive_at_the_same_place() {
    let body = block();
    let (springs, accel) = (units(body.mass, 20.0), pulse(4.5));
    let model = FixedStepBody::new(&body, &springs);
    let newton = tight(Integrator::Trbdf2, 1e-3);
    let weight = body.mass * 9.81;
    let all = [
        newton.iteration,
        Iteration { constant: 60, ..newton.iteration },
        Iteration { constant: 0, newton: 40, test: ConvergenceTest::Unbalance(1e-9 * weight) },
    ]
    .map(|iteration| {
        FixedStepAnalysis::new(&model, StepSettings { iteration, ..newton }, DT, &accel).history()
    });
    for history in &all[1..] {
        assert_eq!(history.outcome, FixedStepOutcome::Finished);
        let error = nrmse(&history.motion.u, &all[0].motion.u);
        assert!(error < 1e-5, "{error}");
    }
    assert!(all[1].work.iterations > all[0].work.iterations);
    // SAP2000's own numbers: its tolerance, of the weight, is looser
    let test = ConvergenceTest::Unbalance(1e-4 * weight);
    let sap = StepSettings { iteration: Iteration { constant: 10, newton: 40, test }, ..newton };
    let history = FixedStepAnalysis::new(&model, sap, DT, &accel).history();
    assert!(nrmse(&history.motion.u, &all[0].motion.u) < 0.02);
}

/// A body that topples lies on the ground, and the history ends.
#[test]
fn a_toppled_body_ends_the_history() {
    let body = block();
    let accel = vec![4.0; 600];
    let springs = FixedStepSprings::of(&body, 1e-3, Integrator::BackwardEuler).unwrap();
    let model = FixedStepBody::new(&body, &springs.chains());
    let history = FixedStepAnalysis::new(&model, springs.settings(), DT, &accel).history();
    assert!(
        matches!(history.outcome, FixedStepOutcome::Fallen { time } if time > 0.5 && time < 6.0),
        "{:?}",
        history.outcome
    );
}
