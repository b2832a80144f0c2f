//! An elastic pier in fixed steps, beside OpenSees and beside the finite elements that follow
//! events.

use dynamics::spring::{Chain, Springs};
use fixed_steps::{
    FixedStepAnalysis, FixedStepFrame, FixedStepModel, FixedStepOutcome, Integrator, MemberDamping,
    StepSettings,
    contact::FixedFoot,
    kinematics::{TangentWeights, Trial},
};
use frames::{
    fem::{ElasticAnalysis, ElasticStart},
    frame::Frame,
};
use rocking::motion::nrmse;

use crate::common::{DT, newton, pier, pulse, units};

fn corners() -> Vec<Springs<Chain>> {
    vec![units(1.2e5, 20.0); 2]
}

/// Horizontal displacement of the mass at the samples.
fn top(frame: &Frame, integrator: Integrator, step: f64, below: f64) -> Vec<f64> {
    let (units, accel) = (corners(), pulse(4.5));
    let model = FixedStepFrame::new(frame, &units).unwrap();
    let damping = MemberDamping::OfChanges;
    let settings = StepSettings { damping, ..newton(integrator, step, below) };
    let found = FixedStepAnalysis::new(&model, settings, DT, &accel).history().unwrap();
    assert_eq!(found.outcome, FixedStepOutcome::Finished, "{integrator}, {step}");
    found.coordinates.iter().map(|q| frame.displacement(1, q)[0]).collect()
}

/// u of the mass, m, by OpenSees 3.7.1 with our deck's elements (`.ci/fixed_steps.py`) on arms 1000
/// times as stiff as k1, steps of 1e-3 s. Its damping objects act 1/(1 + alpha) times too strongly
/// under HHT: ours are given so.
#[test]
fn opensees_has_the_same_history() {
    for (name, stronger, at) in [
        (
            "hht:-0.3333333333333333",
            1.5,
            [(120, -8.603528492e-02), (200, 2.343418528e-02), (290, -9.939711646e-03)],
        ),
        ("trbdf2", 1.0, [(120, -8.606141055e-02), (200, 2.321816911e-02), (290, -9.539559125e-03)]),
        (
            "backward-euler",
            1.0,
            [(120, -8.605975775e-02), (200, 2.322077878e-02), (290, -9.542893799e-03)],
        ),
    ] {
        let u = top(&pier(stronger * 1e8), name.parse().unwrap(), 1e-3, 1e-12);
        for (i, expected) in at {
            assert!(
                (u[i] - expected).abs() < 1e-8 * 0.08,
                "{name}, sample {i}: {:e}, {expected:e}",
                u[i]
            );
        }
    }
}

/// Short steps come to the history that follows events (`frames::fem`).
#[test]
fn short_steps_come_to_what_follows_events() {
    let (frame, units, accel) = (pier(1e8), corners(), pulse(4.5));
    let history = ElasticAnalysis::new(&frame, &units, ElasticStart::Standing, DT, &accel)
        .simulate()
        .unwrap();
    let events: Vec<f64> = history.q.iter().map(|q| frame.displacement(1, q)[0]).collect();
    for integrator in [Integrator::HHT_MOST, Integrator::Trbdf2] {
        let [long, short] =
            [1e-3, 1e-4].map(|step| nrmse(&top(&frame, integrator, step, 1e-7), &events));
        assert!(short < 1e-3 && short < 0.5 * long, "{integrator}: {long}, {short}");
    }
}

/// It stands still under its weight, and the matrix is the derivative of the unbalance.
#[test]
fn it_stands_and_its_matrix_is_the_derivative() {
    let (frame, units) = (pier(1e8), corners());
    let model = FixedStepFrame::new(&frame, &units).unwrap();
    let (mut q, mut feet) = model.standing().unwrap();
    let n = q.len();
    let mut out = vec![0.0; n];
    let places = model.places(&q);
    model.meet(&places, &q, &mut feet);
    let still = Trial { q: q.clone(), v: vec![0.0; n], a: vec![0.0; n], change: None };
    model.unbalance((&still, &places), &feet, [0.0; 2], &mut out);
    assert!(out.iter().all(|f| f.abs() < 1e-8 * frame.total_mass() * 9.81), "{out:?}");

    // leaning, the left corner in the air
    for (i, x) in q.iter_mut().enumerate() {
        *x += 2e-3 * (1.7 * i as f64).sin();
    }
    q[2] += 0.01;
    let places = model.places(&q);
    model.meet(&places, &q, &mut feet);
    assert!(!feet[0].closed && feet[1].closed, "{feet:?}");
    let v: Vec<f64> = (0..n).map(|i| 0.1 * (2.3 * i as f64).cos()).collect();
    let mut at = Trial { q: q.clone(), v, a: vec![0.3; n], change: None };
    derivative(&model, &at, &feet);
    // in OpenSees, dashpots resist a change from elsewhere
    let from: Vec<f64> = (0..n).map(|i| q[i] + 1e-3 * (1.1 * i as f64).cos()).collect();
    at.change = Some((from, 2e-3));
    derivative(&model, &at, &feet);
    assert!(FixedStepFrame::new(&frame, &units[..1]).is_err());
}

/// The matrix of a trial against differences of its unbalance.
fn derivative(model: &FixedStepFrame, at: &Trial<Vec<f64>>, feet: &Vec<FixedFoot>) {
    let (n, places) = (at.q.len(), model.places(&at.q));
    let weights = TangentWeights { mass: 3e4, damping: 200.0, stiffness: 0.7 };
    let factor = model.factor((at, &places), feet, &weights).unwrap();
    let direction: Vec<f64> = (0..n).map(|i| (0.9 * i as f64 + 0.4).cos()).collect();
    let unbalance = |step: f64| {
        let mut trial = at.clone();
        for (k, d) in direction.iter().enumerate() {
            trial.q[k] += step * weights.stiffness * d;
            trial.v[k] += step * weights.damping * d;
            trial.a[k] += step * weights.mass * d;
        }
        let mut out = vec![0.0; n];
        model.unbalance((&trial, &model.places(&trial.q)), feet, [0.5, 0.2], &mut out);
        out
    };
    let (high, low) = (unbalance(1e-6), unbalance(-1e-6));
    let mut right: Vec<f64> =
        high.iter().zip(&low).map(|(high, low)| -(high - low) / 2e-6).collect();
    model.solve(&factor, &mut right);
    for (found, expected) in right.iter().zip(&direction) {
        assert!((found - expected).abs() < 1e-5, "{right:?}, {direction:?}");
    }
}

/// A pier that topples lies on the ground, and the history ends, as that of a rigid body does.
#[test]
fn a_toppled_pier_ends_the_history() {
    let (frame, units, accel) = (pier(1e8), corners(), vec![4.0; 600]);
    let model = FixedStepFrame::new(&frame, &units).unwrap();
    for integrator in [Integrator::BackwardEuler, Integrator::Trbdf2] {
        let settings = newton(integrator, 1e-3, 1e-6).with_substeps(1.0 / 16.0);
        let found = FixedStepAnalysis::new(&model, settings, DT, &accel).history().unwrap();
        let FixedStepOutcome::Fallen { time } = found.outcome else {
            panic!("{integrator}: {:?}", found.outcome)
        };
        assert!(time > 0.5 && time < 6.0 && found.coordinates.len() < accel.len(), "{time}");
    }
}
