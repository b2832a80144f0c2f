//! The step: its order on smooth motions, and what it does to motions that it cannot follow.

use super::{omega, undamped};
use crate::fem::{
    model::{Contact, Foot, Model, State, X, Z, ax},
    step::{Ground, NO_GUESS, Request, Stages, Stepper},
};
use rocking::scalar::GRAVITY;

/// A step that begins with no guess and converges to rounding.
fn request(h: f64, ground: Ground) -> Request {
    Request { h, ground, guess: [NO_GUESS; 3], tolerance: 1e-15, rate: 1.0, turning: None }
}

/// n steps of size h with frozen contact, without any control.
fn march(model: &Model, start: State, feet: &[Foot; 2], h: f64, n: usize, slope: f64) -> State {
    let (mut state, mut stepper, mut stages) = (start, Stepper::new(model), Stages::none());
    for i in 0..n {
        let ground =
            Ground { start: [slope * h * i as f64, 0.0], slope: [slope, 0.0], curve: [0.0; 2] };
        assert!(
            stepper.step(&state, feet, &request(h, ground), &mut stages),
            "a linear step converges"
        );
        state = stages.end();
    }
    state
}

#[test]
fn the_order_on_a_smooth_motion_is_five() {
    // standing, pushed sideways: elastic rocking, sway and heave of some Hz, with the geometry's
    // nonlinearity
    let (model, mut start, feet) = undamped(0.3);
    start.v[X] = 0.5;
    start.v[Z] = -0.2;
    let end = 0.04;
    let at = |n: usize| march(&model, start, &feet, end / n as f64, n, 2.0);
    let fine = at(1024);
    let error = |n: usize| {
        let state = at(n);
        (0..7).map(|k| (state.q[k] - fine.q[k]).abs()).fold(0.0, f64::max)
    };
    let errors = [64, 128, 256].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((4.8..5.3).contains(&order), "{errors:?} {order}");
    }
}

/// What a formula of order three misses falls as h^4, in place and (once divided by h) in velocity;
/// what the step of order five misses is less.
#[test]
fn the_estimate_of_the_local_error_is_of_order_four_and_above_the_error() {
    let (model, mut start, feet) = undamped(0.3);
    start.v[X] = 0.5;
    start.v[Z] = -0.2;
    let slope = 2.0;
    let estimate = |h: f64| {
        let (mut stepper, mut stages) = (Stepper::new(&model), Stages::none());
        let ground = Ground { start: [0.0; 2], slope: [slope, 0.0], curve: [0.0; 2] };
        assert!(stepper.step(&start, &feet, &request(h, ground), &mut stages));
        let missed = stepper.local_error(&start, &feet, &ground, &stages);
        let fine = march(&model, start, &feet, h / 16.0, 16, slope);
        let off = |k: usize| {
            (stages.end().q[k] - fine.q[k]).abs().max(h * (stages.end().v[k] - fine.v[k]).abs())
        };
        for k in [X, Z] {
            assert!(missed.q[k].abs().max(h * missed.v[k].abs()) > off(k), "{h} {k}");
        }
        missed
    };
    let steps = [8e-4, 4e-4, 2e-4].map(estimate);
    for k in [X, Z] {
        let (q, v) = (steps.map(|e| e.q[k].abs()), steps.map(|e| e.v[k].abs()));
        for (name, e, orders) in [("place", q, 3.7..5.3), ("velocity", v, 3.7..5.3)] {
            for pair in e.windows(2) {
                let order = (pair[0] / pair[1]).log2();
                assert!(orders.contains(&order), "{name} {k}: {e:?} {order}");
            }
        }
    }
}

#[test]
fn a_motion_far_too_fast_for_the_step_is_gone_after_one_step() {
    // an open absorber of 1e5 rad per step: R(-infinity) = 0
    let (mut model, mut start, mut feet) = undamped(0.3);
    feet[0].contact = Contact::Open;
    feet[1].contact = Contact::Open;
    model.springs.horizontal.k2 = model.springs.horizontal.m2 * omega(1e4).powi(2);
    start.q[ax(0)] = 1e-3;
    let h = 1e5 / omega(1e4);
    let end = march(&model, start, &feet, h, 1, 0.0);
    assert!(end.q[ax(0)].abs() < 1e-3 * 1e-4, "{}", end.q[ax(0)]);
}

#[test]
fn free_flight_is_a_parabola() {
    let (model, mut start, mut feet) = undamped(0.3);
    feet.iter_mut().for_each(|f| f.contact = Contact::Open);
    start.v[X] = 0.7;
    start.v[Z] = 1.3;
    start.v[2] = 0.02;
    let z = start.q[Z];
    // one step, with ground acceleration growing at 2 m/s3
    let (t, slope) = (0.1, 2.0);
    let end = march(&model, start, &feet, t, 1, slope);
    assert!((end.q[Z] - (z + 1.3 * t - 0.5 * GRAVITY * t * t)).abs() < 1e-14);
    assert!((end.q[X] - (0.7 * t - slope * t.powi(3) / 6.0)).abs() < 1e-14);
    assert!((end.q[2] - 0.02 * t).abs() < 1e-16);
}

/// In free flight over ground that accelerates by c0 + c1 t + c2 t^2 the velocity is v0 - c0 t - c1
/// t^2/2 - c2 t^3/3 everywhere in the step. A slope of the places errs at the start by h^3 v'''/60,
/// that is c2 h^3/30, which 32 samples of this step would take for a force of 1 m/s2.
#[test]
fn the_velocity_within_a_step_is_a_cubic_through_its_start() {
    let (model, mut start, mut feet) = undamped(0.3);
    feet.iter_mut().for_each(|f| f.contact = Contact::Open);
    start.v[X] = 0.7;
    let [c0, c1, c2] = [1.3, -4.0, 9.0];
    let place_slope = |stages: &Stages, tau: f64| {
        let near = |tau: f64| stages.position(&start, tau)[X];
        (near(tau + 1e-4) - near(tau - 1e-4)) / (2e-4 * stages.h)
    };
    for h in [0.32, 0.16] {
        let ground = Ground { start: [c0, 0.0], slope: [c1, 0.0], curve: [c2, 0.0] };
        let mut stages = Stages::none();
        assert!(Stepper::new(&model).step(&start, &feet, &request(h, ground), &mut stages));
        for i in 0..=32 {
            let tau = f64::from(i) / 32.0;
            let t = tau * h;
            let exact = 0.7 - t * (c0 + t * (c1 / 2.0 + t * c2 / 3.0));
            assert!((stages.velocity(&start, tau)[X] - exact).abs() < 1e-13, "{h} {tau}");
        }
        let missed = place_slope(&stages, 0.0) - 0.7;
        assert!((missed.abs() / (c2 * h * h * h / 30.0) - 1.0).abs() < 1e-2, "{missed}");
    }
}

#[test]
fn an_open_absorber_is_the_damped_oscillator() {
    let model = Model::new(&super::body(0.3), &super::springs());
    let (mut start, mut feet) = model.settled();
    feet.iter_mut().for_each(|f| f.contact = Contact::Open);
    let chain = model.springs.horizontal;
    let (a0, v0) = (2e-3, -0.1);
    start.q[ax(1)] = a0;
    start.v[ax(1)] = v0;
    let (decay, w2) = (chain.c / (2.0 * chain.m2), chain.k2 / chain.m2);
    let wd = (w2 - decay * decay).sqrt();
    assert!(wd.is_finite());
    let t: f64 = 0.02;
    let exact =
        (-decay * t).exp() * (a0 * (wd * t).cos() + (v0 + decay * a0) / wd * (wd * t).sin());
    let end = march(&model, start, &feet, t / 200.0, 200, 0.0);
    assert!(
        (end.q[ax(1)] - exact).abs() < 1e-12 * a0.max(exact.abs()) + 1e-14,
        "{} {exact}",
        end.q[ax(1)]
    );
}
