//! The standing and the leaning body under a tendon; the fall on dampers.

use crate::{
    fem::{
        Control, View,
        model::{Contact, Foot, Model, N, X, Z},
        run::{GroundMotion, TimeLoop},
    },
    spring::{Chain, Springs},
};
use rocking::{
    members::{Damper, Members, Tendon},
    scalar::GRAVITY,
};

#[test]
fn a_tendon_adds_its_moment_to_the_leaning_body_s() {
    // m g R sin(alpha - theta) plus the tension times its distance from the foot; springs all but
    // rigid
    let body = rocking::structure::Structure::paper().body::<f64>();
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
        assert!(
            (acceleration * body.mass * radius / moment - 1.0).abs() < 1e-6,
            "{theta}: {acceleration}"
        );
        assert!(f[X] * theta < 0.0);
    }
}

#[test]
fn the_settled_tendon_has_its_pretension() {
    let tendon = Some(Tendon { stiffness: 4e6, pretension: 1.5e6 });
    let model = Model::with_members(
        &super::body(0.0),
        &super::springs(),
        &Members { tendon, ..Members::default() },
    );
    let (state, feet) = model.settled();
    let tension = model.elements.tendon.unwrap().tension(&state.q);
    assert!((tension / 1.5e6 - 1.0).abs() < 1e-9, "{tension}");
    let [l, r] = model.contact(&state.q, &feet);
    assert!(((l.vertical + r.vertical) / (model.body.mass * GRAVITY + 1.5e6) - 1.0).abs() < 1e-9);
    // and nothing moves it
    let forces = model.forces(&state.q, &[0.0; N], &feet, [0.0; 2]);
    assert!(forces.iter().all(|f| f.abs() < 1e-8 * model.body.mass * GRAVITY), "{forces:?}");
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
    let mut run =
        TimeLoop::new(&model, (start, feet), Control { tolerance: 1e-13, ..Control::default() });
    let rate = 2.0 * c / body.mass;
    let terminal = GRAVITY / rate;
    let mut worst: f64 = 0.0;
    let mut observer = |i: usize, view: &View| {
        let t = i as f64 * 0.02;
        let decay = (-rate * t).exp();
        let z = 1.0 - terminal * (t - (1.0 - decay) / rate);
        // integral of 2 c (terminal (1 - decay))^2
        let lost = 2.0
            * c
            * terminal.powi(2)
            * (t - 2.0 * (1.0 - decay) / rate + (1.0 - decay * decay) / (2.0 * rate));
        worst = worst.max((view.z() - z).abs());
        assert!(
            (view.energy.dissipated - lost).abs() < 1e-9 * body.mass * GRAVITY,
            "{}",
            view.energy.dissipated
        );
        std::ops::ControlFlow::Continue(())
    };
    run.follow(
        GroundMotion { dt: 0.02, accel: &[0.0; 20], vertical: &[], scale: 1.0 },
        &mut observer,
    );
    assert!(worst < 1e-10, "{worst:e}");
}
