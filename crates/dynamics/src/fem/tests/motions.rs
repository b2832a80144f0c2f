//! Statics and small vibrations of the standing body against closed forms and eigenvalues.

use nalgebra::Matrix2;

use super::{body, omega, springs, undamped};
use crate::{
    fem::{
        Analysis, Control, Start, View,
        model::{Model, N, State, TH, X, Z, ax, az},
        run::{GroundMotion, TimeLoop},
    },
    spring::{Chain, Design, Springs},
};
use rocking::{scalar::GRAVITY, structure::Body};

fn run(
    body: Body<f64>,
    springs: Springs<Chain>,
    start: Start,
    dt: f64,
    n: usize,
) -> crate::fem::History {
    let accel = vec![0.0; n];
    let control = Control { tolerance: 1e-11, ..Control::default() };
    Analysis { start, control, ..Analysis::new(body, springs, dt, &accel) }.simulate()
}

#[test]
fn the_standing_body_stays_where_its_weight_is_carried() {
    let body = body(0.0);
    let springs = springs();
    let history = run(body, springs, Start::Settled, 0.01, 500);
    let settlement =
        0.5 * body.mass * GRAVITY * (1.0 / springs.vertical.k1 + 1.0 / springs.vertical.k2);
    assert!((history.initial_z + settlement).abs() < 1e-15);
    assert!(history.motion.v.iter().chain(&history.motion.u).all(|x| x.abs() < 1e-12 * settlement));
    for force in &history.forces.vertical {
        assert!(force.iter().all(|n| (n / (0.5 * body.mass * GRAVITY) - 1.0).abs() < 1e-12));
    }
}

#[test]
fn a_leaning_body_begins_to_fall_back_as_a_rigid_body_does() {
    for share in [0.0, 1e-3, 0.2] {
        for theta in [0.05, -0.02] {
            let model = Model::new(&body(share), &springs());
            let (State { q, v }, feet) = model.leaning(theta);
            let pressing = usize::from(theta > 0.0);
            let (side, weight) = (theta.signum(), model.body.mass * GRAVITY);
            assert!(!feet[1 - pressing].closed() && model.compression(1 - pressing, &q) < 0.0);
            assert_eq!(v, [0.0; N]);
            // theta'' = -p^2 sin(alpha s - theta), the centre of mass turning about the foot;
            // absorbers at rest
            let f = model.forces(&q, &v, &feet, [0.0; 2]);
            let m = model.masses(&feet);
            let lean = model.body.alpha() - theta.abs();
            let thrust = model.body.p_squared() * model.body.radius() * lean.sin();
            assert!((f[X] / m[X] + side * thrust * lean.cos()).abs() < 1e-11, "{share} {theta}");
            assert!((f[Z] / m[Z] + thrust * lean.sin()).abs() < 1e-11, "{share} {theta}");
            let turning = -side * model.body.p_squared() * lean.sin() * m[TH];
            assert!(
                (f[TH] - turning).abs() < 1e-9 * weight * model.body.half_width,
                "{share} {theta}"
            );
            assert!((3..N).all(|k| f[k].abs() < 1e-9 * weight), "{f:?}");
        }
    }
}

#[test]
fn a_lean_of_less_than_the_settlement_presses_both_feet() {
    let model = Model::new(&body(0.0), &springs());
    let (state, feet) = model.leaning(1e-5);
    assert!(feet[0].closed() && feet[1].closed());
    assert!(model.compression(0, &state.q) > 0.0);
}

/// Eigenvalues of K x = w^2 M x for the chain m1 - k1 - m2 - k2 under each of two feet, moving
/// together.
fn heave(springs: &Springs<Chain>, m: f64) -> [f64; 2] {
    let Chain { k1, k2, m2, .. } = springs.vertical;
    let scale = |a: f64, b: f64| 1.0 / (a * b).sqrt();
    let (body, absorber) = (m / 2.0, m2);
    let coupling = -k1 * scale(body, absorber);
    let matrix = Matrix2::new(k1 / body, coupling, coupling, (k1 + k2) / absorber);
    let eigen = matrix.symmetric_eigenvalues();
    [eigen.min(), eigen.max()]
}

#[test]
fn heave_of_the_standing_body_is_the_two_mass_chain() {
    let (model, mut start, feet) = undamped(0.3);
    let [slow, fast] = heave(&model.springs, model.body.mass);
    // along the first mode: x2/x1 from the first row, (k1 - w^2 m/2) x1 = k1 x2
    let ratio = 1.0 - slow * model.body.mass / 2.0 / model.springs.vertical.k1;
    let rest = start;
    let amplitude = 1e-4;
    start.q[Z] += amplitude;
    start.q[az(0)] += amplitude * ratio;
    start.q[az(1)] += amplitude * ratio;
    let accelerations = |s: &State| {
        let f = model.forces(&s.q, &s.v, &feet, [0.0; 2]);
        let m = model.masses(&feet);
        [f[Z] / m[Z], f[az(0)] / m[az(0)]]
    };
    let [a, b] = accelerations(&start);
    assert!((a / (-slow * amplitude) - 1.0).abs() < 1e-9);
    assert!((b / (-slow * amplitude * ratio) - 1.0).abs() < 1e-9);
    assert!(fast > slow && rest.q[Z] < 0.0);

    // and followed in time: one period later it is where it began
    let period = std::f64::consts::TAU / slow.sqrt();
    let mut run =
        TimeLoop::new(&model, (start, feet), Control { tolerance: 1e-13, ..Control::default() });
    let mut last = 0.0;
    let mut observer = |_: usize, view: &View| {
        last = view.z();
        std::ops::ControlFlow::Continue(())
    };
    run.follow(
        GroundMotion { dt: period / 8.0, accel: &[0.0; 9], vertical: &[], scale: 1.0 },
        &mut observer,
    );
    assert!((last - start.q[Z]).abs() < 1e-6 * amplitude, "{} {}", last - rest.q[Z], amplitude);
}

#[test]
fn damped_heave_decays_by_the_chain_s_complex_eigenvalue() {
    // s^2 m/2 x1 + k1 (x1 - x2) = 0, (s^2 m2 + s c + k1 + k2) x2 = k1 x1: the root near the
    // undamped one, by Newton
    let mut springs = springs();
    springs.vertical.c *= 0.02;
    let model = Model::new(&body(0.3), &springs);
    let Chain { k1, k2, m2, c } = springs.vertical;
    let m = model.body.mass / 2.0;
    type C = num_complex::Complex<f64>;
    let f = |s: C| (s * s * m + k1) * (s * s * m2 + s * c + k1 + k2) - k1 * k1;
    let df = |s: C| {
        s * (2.0 * m) * (s * s * m2 + s * c + k1 + k2) + (s * s * m + k1) * (s * (2.0 * m2) + c)
    };
    let mut s = C::new(0.0, heave(&springs, model.body.mass)[0].sqrt());
    for _ in 0..30 {
        s -= f(s) / df(s);
    }
    assert!(s.re < 0.0);
    let ratio = (s * s * m + k1) / k1;
    let (mut start, feet) = model.settled();
    let rest = start.q[Z];
    let amplitude = 1e-4;
    start.q[Z] += amplitude;
    start.v[Z] = (s * amplitude).re;
    for i in 0..2 {
        start.q[az(i)] += (ratio * amplitude).re;
        start.v[az(i)] = (s * ratio * amplitude).re;
    }
    let mut run =
        TimeLoop::new(&model, (start, feet), Control { tolerance: 1e-13, ..Control::default() });
    let dt = 0.003;
    let mut worst: f64 = 0.0;
    let mut observer = |i: usize, view: &View| {
        let exact = ((s * (i as f64 * dt)).exp() * amplitude).re;
        worst = worst.max((view.z() - rest - exact).abs());
        std::ops::ControlFlow::Continue(())
    };
    run.follow(GroundMotion { dt, accel: &[0.0; 100], vertical: &[], scale: 1.0 }, &mut observer);
    assert!(worst < 1e-5 * amplitude, "{worst:e}");
}

#[test]
fn elastic_rocking_is_omega_n_root_2k_over_1_plus_k_times_b_over_r() {
    // All mass in the body, equal chains both ways, light absorbers: each foot is a spring k1
    // K/(1+K).
    let hz = 50.0;
    let chain = Design::from_kc(1e-6, 0.7, 0.0, hz);
    let body = body(0.0);
    let springs = Springs { vertical: chain, horizontal: chain }.chains(body.mass);
    let model = Model::new(&body, &springs);
    let (start, feet) = model.settled();
    // dynamic stiffness of the massless rotation: condense theta and the absorbers by a static push
    // on X
    let push = 1e-3 * body.mass * GRAVITY * body.half_width / body.height;
    let mut state = start;
    for _ in 0..50 {
        let newton = crate::fem::newton::Newton::new(&model, &state, &feet, 1e6);
        let mut r = model.forces(&state.q, &state.v, &feet, [0.0; 2]);
        r[X] += push;
        let a = newton.solve(&r);
        for (q, a) in state.q.iter_mut().zip(a) {
            *q += a * 1e12;
        }
    }
    let stiffness = push / (state.q[X] - start.q[X]);
    let formula = omega(hz) * (2.0 * 0.7 / 1.7_f64).sqrt() * body.half_width / body.radius();
    let measured = (stiffness / body.mass).sqrt();
    // the weight on the leaning body takes m g h off the rotational stiffness 2 k b^2
    let p_delta = GRAVITY * body.height / (2.0 * 0.7 / 1.7 * (omega(hz) * body.half_width).powi(2));
    assert!(
        (measured / formula - 1.0 + p_delta / 2.0).abs() < 0.02 * p_delta,
        "{measured} {formula} {p_delta}"
    );
    assert!(state.q[ax(0)] > start.q[ax(0)]);
}
