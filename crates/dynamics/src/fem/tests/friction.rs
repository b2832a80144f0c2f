//! Friction: its Newton matrix, slipping against closed forms, its energy, and the limit in which
//! feet hold.

use super::forces::complex_residual;
use crate::{
    fem::{
        Analysis, History,
        model::{Contact, Foot, Model},
    },
    spring::{Design, Springs},
};
use rocking::{
    members::{Friction, Members},
    motion::largest_magnitude,
    scalar::GRAVITY,
    structure::Body,
};
use strong_motion::Record;

const MU: f64 = 0.25;

pub(super) fn members(coefficient: f64) -> Members {
    Members { friction: Some(Friction { coefficient }), ..Members::default() }
}

/// With few rebounds.
fn springs() -> Springs<Design<f64>> {
    springs_of(80.0)
}

fn springs_of(hz: f64) -> Springs<Design<f64>> {
    let chain = Design::from_kc(0.5, 0.2, 0.92, hz);
    Springs { vertical: chain, horizontal: Design { mu: 0.3, ..chain } }
}

fn model(body: &Body<f64>) -> Model {
    Model::with_members(body, &springs().chains(body.mass), &members(MU))
}

fn run(body: Body<f64>, coefficient: f64, dt: f64, accel: &[f64]) -> History {
    let springs = springs().chains(body.mass);
    Analysis::new(body, springs, dt, accel).simulate_with(&members(coefficient)).0
}

/// A solid block, its centre of mass at `height`.
pub(super) fn block(height: f64, width: f64) -> Body<f64> {
    let (mass, half_width) = (1000.0, 0.5 * width);
    Body {
        mass,
        half_width,
        height,
        inertia: mass * (height * height + half_width * half_width) / 3.0,
    }
}

/// Four times as wide as it is high: it does not rock but slips.
fn flat() -> Body<f64> {
    block(0.25, 2.0)
}

#[test]
fn newton_solves_with_the_dense_matrix_while_feet_slip() {
    let body = super::body(0.1);
    let model = model(&body);
    let all = [Contact::Open, Contact::Stick, Contact::Slip(1.0), Contact::Slip(-1.0)];
    for (left, right_foot) in all.into_iter().flat_map(|l| all.map(|r| (l, r))) {
        let feet =
            [(left, 0.013), (right_foot, -0.007)].map(|(contact, anchor)| Foot { contact, anchor });
        for h in [1e-4, 3e-3, 0.05] {
            let missed = complex_residual(&model, &feet, h);
            assert!(missed < 1e-9, "{feet:?} {h}: {missed}");
        }
    }
}

#[test]
fn a_flat_block_slips_as_far_as_newton_says() {
    // ground accelerates at a for T, then not at all: the block slides back at (a - mu g), then
    // stops at mu g
    let (a, dt, n) = (0.6 * GRAVITY, 1e-3, 200);
    let mut accel = vec![a; n + 1];
    accel.extend(vec![0.0; 600]);
    // stiff springs: softer ones give way before friction has built up
    let springs = springs_of(2000.0).chains(1000.0);
    let case = Analysis::new(flat(), springs, dt, &accel);
    let history = case.simulate_with(&members(MU)).0;
    // the last interval of the pulse is a ramp down to zero: speed of the ground by the trapezoidal
    // rule
    let (pull, hold) = (a - MU * GRAVITY, MU * GRAVITY);
    let t = n as f64 * dt;
    let speed = pull * t + (a / 2.0 - hold) * dt;
    let slid = 0.5 * pull * t * t
        + pull * t * dt
        + (a / 3.0 - hold / 2.0) * dt * dt
        + speed * speed / (2.0 * hold);
    let u = history.motion.u.last().copied().unwrap();
    assert!((u + slid).abs() < 2e-3 * slid, "{u} {slid}");
    assert!(history.energy_residual < 1e-6, "{}", history.energy_residual);
    // what friction took is mu times the weight times the way, the rest is the springs'
    let lost = history.account.dissipated.last().copied().unwrap();
    let friction = MU * 1000.0 * GRAVITY * slid;
    assert!((lost / friction - 1.0).abs() < 0.01, "{lost} {friction}");
}

#[test]
fn no_foot_carries_more_than_friction_allows() {
    let record = Record::el_centro().truncated(8.0);
    let accel: Vec<f64> = record.accel.iter().map(|a| 2.0 * a).collect();
    for body in [flat(), block(2.0, 1.0)] {
        let springs = springs().chains(body.mass);
        let case = Analysis::new(body, springs, record.dt, &accel);
        let mut worst: f64 = 0.0;
        let mut slips = 0.0_f64;
        let mut watch = |_: usize, view: &crate::fem::View| {
            let [l, r] = view.model.contact(&view.state.q, view.feet);
            for f in [l, r] {
                worst = worst.max((f.horizontal.abs() - MU * f.vertical) / (body.mass * GRAVITY));
            }
            slips = slips.max(view.energy.dissipated);
            std::ops::ControlFlow::Continue(())
        };
        case.observe_with(&members(MU), &mut watch);
        assert!(worst <= 2e-6 * MU, "{worst}");
        assert!(slips > 0.0);
    }
}

#[test]
fn the_account_closes_while_feet_slip_and_hold() {
    let record = Record::el_centro().truncated(10.0);
    for (height, width, scale) in [(0.25, 2.0, 2.0), (2.0, 1.0, 2.0), (2.0, 0.5, 1.0)] {
        let accel: Vec<f64> = record.accel.iter().map(|a| scale * a).collect();
        let body = block(height, width);
        let history = run(body, MU, record.dt, &accel);
        assert!(history.energy_residual < 1e-6, "{height} {width}: {}", history.energy_residual);
        assert!(history.account.dissipated.windows(2).all(|w| w[1] >= w[0] - 1e-9 * w[1].abs()));
    }
}

#[test]
fn feet_that_never_slip_give_the_history_without_friction() {
    let record = Record::el_centro().truncated(10.0);
    let body = block(2.0, 0.5);
    let springs = springs().chains(body.mass);
    let case = Analysis::new(body, springs, record.dt, &record.accel);
    let (free, bound) = (case.simulate(), case.simulate_with(&members(50.0)).0);
    let worst =
        free.motion.u.iter().zip(&bound.motion.u).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let largest = largest_magnitude(&free.motion.u);
    assert!(worst < 1e-3 * largest, "{worst} {largest}");
}

#[test]
fn friction_goes_with_a_rigid_body_that_has_rotational_inertia() {
    let body = flat();
    let both = Members { damper: Some(rocking::members::Damper { c: 1.0 }), ..members(MU) };
    assert!(both.checked(&body).unwrap_err().to_string().contains("leave one out"));
    let spinning = members(MU).checked(&Body { inertia: 0.0, ..body });
    assert!(spinning.unwrap_err().to_string().contains("rotational_inertia_kgm2"));
    assert!(members(-0.1).checked(&body).is_err() && members(MU).checked(&body).is_ok());
}
