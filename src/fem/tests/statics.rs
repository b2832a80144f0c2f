//! The standing frame on elastic legs against beam theory; the leaning body under a tendon; the fall on dampers.

use nalgebra::{Matrix2, SMatrix, SVector, Vector2};
use num_dual::Dual64;

use crate::{
    fem::{
        Control, View,
        model::{Contact, Foot, Model, N, State, TH, Vector, X, Z},
        newton::Newton,
        run::{GroundMotion, Run},
    },
    members::{Damper, Legs, Members, Tendon},
    scalar::{GRAVITY, Scalar, real},
    spring::{Chain, Springs},
    structure::Body,
};

const EA: f64 = 3e11;
const EI: f64 = 2e10;

/// A stocky frame, so light for its legs (1e-8 of shortening) that second-order effects of the weight are below 1e-7.
fn frame<S: Scalar>(inertia: f64) -> Body<S> {
    Body { mass: real(1000.0), half_width: real(1.0), height: real(2.5), inertia: real(inertia) }
}

/// Springs of the legs' stiffness, their absorbers all but massless.
fn soft<S: Scalar>() -> Springs<Chain<S>> {
    let chain = |k1: f64, k2: f64| Chain { k1: real(k1), k2: real(k2), m2: real(1e-6), c: real(0.0) };
    Springs { vertical: chain(2e11, 3e11), horizontal: chain(4e11, 1e11) }
}

fn model<S: Scalar>(inertia: f64) -> Model<S> {
    let legs = Members { legs: Some(Legs { ea: EA, ei: EI }), ..Members::default() };
    Model::with_members(&frame(inertia), &soft(), &legs.lift())
}

/// Flexibility of leg and springs as the foot of this side feels it, the body held [m/N]: what each part gives under a
/// unit force, summed.
fn flexibility(side: f64) -> Matrix2<f64> {
    let (b, h) = (1.0, 2.5);
    let l = f64::hypot(b, h);
    let along = Vector2::new(side * b, -h) / l;
    let across = Vector2::new(h, side * b) / l;
    let leg = along * along.transpose() * (l / EA) + across * across.transpose() * (l.powi(3) / (3.0 * EI));
    let Springs { vertical: v, horizontal: h } = soft::<f64>();
    leg + Matrix2::from_diagonal(&Vector2::new(1.0 / h.k1 + 1.0 / h.k2, 1.0 / v.k1 + 1.0 / v.k2))
}

#[test]
fn the_weight_settles_the_frame_as_beam_theory_says() {
    let (state, feet) = model::<f64>(0.0).settled();
    // half the weight on each foot; the thrust H from the mass staying in the middle
    let c = flexibility(-1.0);
    let n = 0.5 * 1000.0 * GRAVITY;
    let thrust = -c[(0, 1)] / c[(0, 0)] * n;
    let settlement = c[(1, 0)] * thrust + c[(1, 1)] * n;
    assert!((state.q[Z] / -settlement - 1.0).abs() < 1e-6, "{} {settlement}", state.q[Z]);
    let [left, right] = model::<f64>(0.0).contact(&state.q, &feet);
    assert!((left.horizontal / thrust - 1.0).abs() < 1e-6, "{} {thrust}", left.horizontal);
    assert!((left.vertical / n - 1.0).abs() < 1e-6 && right.horizontal == -left.horizontal);
    assert_eq!((state.q[X], state.q[TH]), (0.0, 0.0));
}

#[test]
fn a_sideways_push_moves_the_frame_as_beam_theory_says() {
    // by symmetry each foot takes half of F and, for the moment, F h / 2b up or down: a force along the leg, no bending
    let model = model::<f64>(0.0);
    let (start, feet) = model.settled();
    let push = 100.0;
    let mut state = start;
    for _ in 0..8 {
        let mut r = model.forces(&state.q, &[0.0; N], &feet, [0.0; 2]);
        r[X] += push;
        let a = Newton::new(&model, &state, &feet, 1e6, |x: f64| x).solve(&r);
        state.q.iter_mut().zip(a).for_each(|(q, a)| *q += a * 1e12);
    }
    let (b, h) = (1.0, 2.5);
    let l = f64::hypot(b, h);
    let Springs { vertical: v, horizontal: ground } = soft::<f64>();
    let series = |c: &Chain<f64>| 1.0 / c.k1 + 1.0 / c.k2;
    let deflection =
        push * (l / (2.0 * EA * (b / l).powi(2)) + (h / b).powi(2) / 2.0 * series(&v) + series(&ground) / 2.0);
    let moved = state.q[X] - start.q[X];
    assert!((moved / deflection - 1.0).abs() < 1e-6, "{moved} {deflection}");
}

/// K = -df/dq of the standing frame, by dual numbers.
fn stiffness(inertia: f64, state: &State<f64>, feet: &[Foot<f64>; 2]) -> SMatrix<f64, N, N> {
    let dual = model::<Dual64>(inertia);
    let feet = feet.map(|f| Foot { contact: f.contact, anchor: Dual64::from_re(f.anchor) });
    SMatrix::from_fn(|i, j| {
        let q: Vector<Dual64> = std::array::from_fn(|k| Dual64::new(state.q[k], if k == j { 1.0 } else { 0.0 }));
        -dual.forces(&q, &[Dual64::from_re(0.0); N], &feet, [Dual64::from_re(0.0); 2])[i].eps
    })
}

#[test]
fn the_first_frequency_of_the_frame_is_beam_theory_s() {
    let inertia: f64 = 800.0;
    // sway and rotation of the mass on two clamped-hinged legs
    let mut k = Matrix2::zeros();
    for side in [-1.0, 1.0] {
        let foot = flexibility(side).try_inverse().unwrap();
        let moves = Matrix2::new(1.0, -2.5, 0.0, -side);
        k += moves.transpose() * foot * moves;
    }
    let root = Matrix2::from_diagonal(&Vector2::new(1000.0_f64.sqrt().recip(), inertia.sqrt().recip()));
    let beam = (root * k * root).symmetric_eigenvalues().min().sqrt();

    let model = model::<f64>(inertia);
    let (start, feet) = model.settled();
    let root = SVector::from(model.masses(&feet).map(|m: f64| m.sqrt().recip()));
    let k = stiffness(inertia, &start, &feet);
    let eigen =
        SMatrix::<f64, N, N>::from_fn(|i, j| root[i] * 0.5 * (k[(i, j)] + k[(j, i)]) * root[j]).symmetric_eigen();
    let first = eigen.eigenvalues.imin();
    let omega = eigen.eigenvalues[first].sqrt();
    assert!((omega / beam - 1.0).abs() < 1e-6, "{omega} {beam}");

    // and in time: along the first mode, over a period and a quarter
    let mut mode: Vector<f64> = std::array::from_fn(|i| root[i] * eigen.eigenvectors[(i, first)]);
    let amplitude = 1e-9 / mode[X];
    mode.iter_mut().for_each(|x| *x *= amplitude);
    let moved = State { q: std::array::from_fn(|k| start.q[k] + mode[k]), v: start.v };
    let dt = std::f64::consts::TAU / beam / 32.0;
    let mut run = Run::new(&model, (moved, feet), Control { tolerance: 1e-13, ..Control::default() });
    let mut worst: f64 = 0.0;
    let mut observer = |i: usize, view: &View<f64>| {
        let exact = 1e-9 * (beam * i as f64 * dt).cos();
        worst = worst.max((view.x() - exact).abs());
        std::ops::ControlFlow::Continue(())
    };
    run.follow(GroundMotion { dt, accel: &[0.0; 41], vertical: &[], scale: 1.0 }, &mut observer);
    // displacements of 1e-9 m round at 1e-16 of the frame's height
    assert!(worst < 1e-5 * 1e-9, "{worst:e}");
}

#[test]
fn a_tendon_adds_its_moment_to_the_leaning_body_s() {
    // m g R sin(alpha - theta) plus the tension times its distance from the foot; springs all but rigid
    let body = crate::structure::Structure::paper().body::<f64>();
    let stiff = Chain { k1: 1e14, k2: 1e14, m2: 1e3, c: 0.0 };
    let springs = Springs { vertical: stiff, horizontal: stiff };
    let tendon = Tendon { stiffness: 4e6, pretension: 1.5e6 };
    let members = Members { tendon: Some(tendon), ..Members::default() };
    let model = Model::with_members(&body, &springs, &members);
    let (b, h) = (body.half_width, body.height);
    for theta in [0.01_f64, 0.05, -0.03] {
        let (state, feet) = model.leaning(theta);
        let lean = theta.abs();
        // of the mass, from the foot it leans on; that foot stands b from the tendon's anchor
        let (x, z) = (h * lean.sin() - b * lean.cos(), b * lean.sin() + h * lean.cos());
        let length = (b + x).hypot(z);
        let tension = tendon.pretension + tendon.stiffness * (length - h);
        let moment = -body.mass * GRAVITY * x + tension * b * z / length;
        let f = model.forces(&state.q, &state.v, &feet, [0.0; 2]);
        let m = model.masses(&feet);
        let acceleration = (f[X] / m[X]).hypot(f[Z] / m[Z]);
        let radius = body.radius();
        assert!((acceleration * body.mass * radius / moment - 1.0).abs() < 1e-6, "{theta}: {acceleration}");
        assert!(f[X] * theta < 0.0);
    }
}

#[test]
fn the_settled_tendon_has_its_pretension() {
    for legs in [None, Some(Legs { ea: 6e9, ei: 1e10 })] {
        let tendon = Some(Tendon { stiffness: 4e6, pretension: 1.5e6 });
        let model =
            Model::with_members(&super::body(0.0), &super::springs(), &Members { legs, tendon, ..Members::default() });
        let (state, feet) = model.settled();
        let tendon = model.elements.tendon.unwrap();
        let tension = tendon.tension(&state.q);
        assert!((tension / 1.5e6 - 1.0).abs() < 1e-9, "{tension}");
        let [l, r] = model.contact(&state.q, &feet);
        assert!(((l.vertical + r.vertical) / (model.body.mass * GRAVITY + 1.5e6) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn a_body_falling_on_dampers_alone_is_the_exponential() {
    let c = 4e5;
    let members = Members { damper: Some(Damper { c }), ..Members::default() };
    let body = super::body(0.3);
    let model = Model::with_members(&body, &super::springs(), &members);
    let (mut start, _) = model.settled();
    start.q = [0.0; N];
    start.q[Z] = 1.0;
    let feet = [Foot { contact: Contact::Open, anchor: 0.0 }; 2];
    let mut run = Run::new(&model, (start, feet), Control { tolerance: 1e-13, ..Control::default() });
    let rate = 2.0 * c / body.mass;
    let terminal = GRAVITY / rate;
    let mut worst: f64 = 0.0;
    let mut observer = |i: usize, view: &View<f64>| {
        let t = i as f64 * 0.02;
        let decay = (-rate * t).exp();
        let z = 1.0 - terminal * (t - (1.0 - decay) / rate);
        // integral of 2 c (terminal (1 - decay))^2
        let lost = 2.0 * c * terminal.powi(2) * (t - 2.0 * (1.0 - decay) / rate + (1.0 - decay * decay) / (2.0 * rate));
        worst = worst.max((view.z() - z).abs());
        assert!((view.energy.dissipated - lost).abs() < 1e-9 * body.mass * GRAVITY, "{}", view.energy.dissipated);
        std::ops::ControlFlow::Continue(())
    };
    run.follow(GroundMotion { dt: 0.02, accel: &[0.0; 20], vertical: &[], scale: 1.0 }, &mut observer);
    assert!(worst < 1e-10, "{worst:e}");
}
