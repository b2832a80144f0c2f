use super::*;
use crate::housner::{RockingOptions, RockingOutcome, history, released, solve};
use crate::structure::Structure;
use strong_motion::Record;

fn block(height: f64, width: f64) -> Body<f64> {
    let r2 = (height * height + width * width) / 12.0;
    Body { mass: 3.0, half_width: width / 2.0, height: height / 2.0, inertia: 3.0 * r2 }
}

/// Whether nothing speaks against pure rocking.
fn sound(regime: &Regime) -> bool {
    let enough = regime.friction >= regime.friction_needed.value.max(regime.landing_friction);
    enough && regime.free_flight.is_none() && regime.too_stocky.is_none()
}

/// F and N against m times the finite difference of the centre of mass's displacement, plus ground
/// and gravity; on level ground, and with a vertical motion that is half the horizontal one, 0.5 s
/// later.
#[test]
fn forces_are_mass_times_acceleration_of_the_history() {
    let body = Structure::paper().body::<f64>();
    let record = Record::el_centro();
    let finely = |accel: &[f64], factor: f64| -> Vec<f64> {
        let between = accel.windows(2).take(800);
        let fine = between
            .flat_map(|p| (0..10).map(|k| factor * (p[0] + (p[1] - p[0]) * f64::from(k) / 10.0)));
        fine.collect()
    };
    let (fine, up) = (finely(&record.accel, 1.0), finely(&record.accel[50..], 0.5));
    let dt = record.dt / 10.0;
    forces_are_those_of(&body, dt, &fine, &vec![0.0; fine.len()], None);
    forces_are_those_of(&body, dt, &fine, &up, Some(up[..].into()));
}

fn forces_are_those_of(
    body: &Body<f64>,
    dt: f64,
    fine: &[f64],
    up: &[f64],
    vertical: Option<std::sync::Arc<[f64]>>,
) {
    let rocking = solve(body, dt, fine, &RockingOptions { vertical, ..RockingOptions::default() });
    let motion = rocking.motion(body);
    let mut compared = 0;
    for i in (10..7990).filter(|i| i % 10 == 5) {
        let same_side =
            motion.theta[i - 2..=i + 2].iter().all(|theta| theta * motion.theta[i] > 0.0);
        if !same_side {
            continue;
        }
        let second = |x: &[f64]| {
            (-x[i - 2] + 16.0 * x[i - 1] - 30.0 * x[i] + 16.0 * x[i + 1] - x[i + 2])
                / (12.0 * dt * dt)
        };
        let ground = (fine[i] / GRAVITY, 1.0 + up[i] / GRAVITY);
        let (f, n) =
            forces(body, motion.theta[i].signum(), motion.theta[i], rocking.rate[i], ground);
        // the differences lose 1e-16 m / dt^2
        assert!((f - (second(&motion.u) + fine[i]) / GRAVITY).abs() < 1e-9);
        assert!((n - (second(&motion.v) + up[i] + GRAVITY) / GRAVITY).abs() < 1e-9);
        compared += 1;
    }
    assert!(compared > 300);
}

/// Standing still, the demand is PGA/g; a little before uplift it is tan(alpha).
#[test]
fn at_rest_the_friction_needed_is_the_ground_acceleration_over_g() {
    let body = Structure::paper().body::<f64>();
    let accel = [0.0, 0.3, -0.9, 0.5];
    let rocking = history(&body, 0.01, &accel);
    assert_eq!(rocking.outcome, RockingOutcome::NeverMoved);
    let regime = check(&body, 0.01, (&accel, &[]), 1.0, &rocking, 0.5);
    assert!((regime.friction_needed.value - 0.9 / GRAVITY).abs() < 1e-16);
    assert_eq!(regime.friction_needed.time, 0.02);
    assert!(sound(&regime));
}

/// A ramp lifts an A-frame between two samples, where the ground's force passes through its foot;
/// later it lies along the leg, which leans.
#[test]
fn a_body_lifts_where_the_friction_needed_is_its_slope() {
    let body = Structure::paper().body::<f64>();
    let slope = 0.1;
    let accel: Vec<f64> = (0..40).map(|i| 0.04 * GRAVITY * f64::from(i.min(3))).collect();
    let rocking = history(&body, 0.01, &accel);
    let lifts = rocking.uplifts[0].time;
    assert!((lifts - 0.025).abs() < 1e-9, "{lifts}");
    let regime = check(&body, 0.01, (&accel, &[]), 1.0, &rocking, 0.5);
    assert!((regime.friction_needed.value - slope).abs() < 1e-12, "{regime:?}");
    assert_eq!(regime.friction_needed.time, lifts);
}

/// At the start of free rocking (no rate) the A-frame's force lies along its leg: |F|/N = tan(alpha
/// - theta).
#[test]
fn an_a_frames_contact_force_points_along_the_leg() {
    let body = Structure::paper().body::<f64>();
    let theta = 0.4 * body.alpha();
    let (f, n) = forces(&body, 1.0, theta, 0.0, (0.0, 1.0));
    assert!((f.abs() / n - (body.alpha() - theta).tan()).abs() < 1e-15);
}

#[test]
fn el_centro_on_the_papers_frame_rocks_without_warnings() {
    let body = Structure::paper().body::<f64>();
    let record = Record::el_centro();
    let rocking = history(&body, record.dt, &record.accel);
    let regime = check(&body, record.dt, (&record.accel, &[]), 1.0, &rocking, 0.5);
    // the A-frame's force stays near its leg: tan(alpha) = 0.1, and at uplift exactly that
    assert!((0.0999..0.11).contains(&regime.friction_needed.value), "{regime:?}");
    assert!((regime.landing_friction - 0.1).abs() < 1e-15);
    assert_eq!((regime.free_flight, regime.too_stocky), (None, None));
    assert!(sound(&regime));
    let slippery = check(&body, record.dt, (&record.accel, &[]), 1.0, &rocking, 0.05);
    assert!(
        slippery.friction_needed.value > 0.05
            && slippery.landing_friction > 0.05
            && slippery.too_stocky.is_some()
    );
}

/// At rest the ground presses with m (g + a_v); the least of that, and when, is kept.
#[test]
fn the_least_press_of_a_body_at_rest_is_that_of_the_ground() {
    let body = Structure::paper().body::<f64>();
    let vertical: Vec<f64> = [0.0, 0.3, -0.95, 0.1].map(|g: f64| g * GRAVITY).to_vec();
    let options = RockingOptions { vertical: Some(vertical.clone().into()), ..Default::default() };
    let rocking = solve(&body, 0.5, &[0.0; 4], &options);
    let regime = check(&body, 0.5, (&[0.0; 4], &vertical), 1.0, &rocking, 0.5);
    assert!((regime.least_press.value - 0.05).abs() < 1e-12, "{regime:?}");
    assert_eq!((regime.least_press.time, regime.free_flight), (1.0, None));
}

/// N = 0 where R theta'^2 = g for an upright A-frame leg: a start at that rate and beyond flies.
#[test]
fn a_fast_body_leaves_the_ground_where_the_centripetal_force_exceeds_the_weight() {
    let body = Structure::paper().body::<f64>();
    let theta = body.alpha();
    let limit = (GRAVITY / body.radius()).sqrt();
    for (rate, flies) in [(0.999 * limit, false), (1.001 * limit, true)] {
        let options = released(theta, rate);
        let rocking = solve(&body, 0.01, &[0.0], &options);
        let regime = check(&body, 0.01, (&[0.0], &[]), 1.0, &rocking, 0.5);
        assert_eq!(regime.free_flight.is_some(), flies);
        assert_eq!(regime.free_flight.is_some(), flies);
    }
}

#[test]
fn without_friction_a_solid_block_lands_cleanly_from_h_over_b_of_sqrt_2() {
    let limit = 2.0_f64.sqrt();
    assert!(stockiness(&block(1.001 * limit, 1.0), 0.0).is_none());
    assert!(stockiness(&block(0.999 * limit, 1.0), 0.0).is_some());
}

#[test]
fn with_any_friction_a_solid_block_lands_cleanly_only_above_1_over_sqrt_2() {
    let limit = 0.5_f64.sqrt();
    assert!(stockiness(&block(1.001 * limit, 1.0), 1e9).is_none());
    let stocky = stockiness(&block(0.999 * limit, 1.0), 1e9).unwrap();
    assert!(stocky.restitution < 0.0);
}

/// Impulse and momentum of Housner's landing by the velocities before and after: (-(1 - e) h, b (1
/// + e)) m |theta'|.
#[test]
fn landing_friction_is_the_ratio_of_housners_impulses() {
    for body in [Structure::paper().body::<f64>(), block(2.0, 0.8)] {
        let e = body.restitution();
        let expected = (1.0 - e) * body.height / ((1.0 + e) * body.half_width);
        let rocking = history(&body, 0.01, &[0.0]);
        let regime = check(&body, 0.01, (&[0.0], &[]), 1.0, &rocking, 0.5);
        assert!((regime.landing_friction / expected - 1.0).abs() < 1e-14);
    }
}

/// A push of twice the limit topples the block; lying down it would ask for any friction.
#[test]
fn what_a_falling_body_asks_of_the_ground_does_not_count() {
    let body = block(2.0, 0.5);
    let limit = GRAVITY * body.half_width / body.height;
    let accel = vec![2.0 * limit; 1000];
    let rocking = history(&body, 0.01, &accel);
    let time = rocking.overturned().unwrap();
    let regime = check(&body, 0.01, (&accel, &[]), 1.0, &rocking, 0.5);
    assert!(regime.friction_needed.time <= time, "{regime:?}");
    // it stands under twice tan(alpha) for the first sample, and needs less once it leans: see
    // equation 1
    assert!(
        (regime.friction_needed.value - 2.0 * body.half_width / body.height).abs() < 1e-12,
        "{regime:?}"
    );
    assert_eq!(regime.free_flight, None);
    // uncut, the same samples need more
    let uncut = Rocking { outcome: RockingOutcome::Rocked, ..rocking };
    assert!(
        check(&body, 0.01, (&accel, &[]), 1.0, &uncut, 0.5).friction_needed.value
            > 1.5 * regime.friction_needed.value
    );
}

/// What a landing asks of the ground is its momentum along over its momentum upwards, by the
/// velocities of the centre of mass on either side of it, whatever the restitution and the inertia:
/// of a body 3.818 times as high as wide that keeps 0.82, 3.818 0.18/1.82 = 0.378.
#[test]
fn a_landing_that_loses_more_asks_for_more_friction() {
    let frame = Structure::a_frame(38.18, 20.0, 4e5).unwrap().body::<f64>();
    for (body, e) in [(frame, 0.82), (block(2.0, 0.6), 0.7)] {
        let dt = 1e-5;
        let options = RockingOptions {
            restitution: Some(e),
            initial: Some((0.3 * body.alpha(), 0.0)),
            ..RockingOptions::default()
        };
        let still = vec![0.0; 250_000];
        let rocking = solve(&body, dt, &still, &options);
        let (u, v) = {
            let motion = rocking.motion(&body);
            (motion.u, motion.v)
        };
        let at = (rocking.impacts[0].time / dt) as usize;
        let speed = |x: &[f64], i: usize| (x[i + 1] - x[i]) / dt;
        let [along, up] = [&u, &v].map(|x| speed(x, at + 2) - speed(x, at - 3));
        let regime = check(&body, dt, (&still, &[]), 1.0, &rocking, 0.5);
        let due = along.abs() / up;
        assert!((regime.landing_friction / due - 1.0).abs() < 1e-3, "{regime:?} {due}");
        let by_hand = body.height / body.half_width * (1.0 - e) / (1.0 + e);
        assert!((regime.landing_friction / by_hand - 1.0).abs() < 1e-9, "{regime:?} {by_hand}");
        // more than by equation 2, and more than the motion between impacts asks for
        assert!(regime.landing_friction > regime.friction_needed.value, "{regime:?}");
    }
    let by_hand: f64 = 3.818 * 0.18 / 1.82;
    assert!((by_hand - 0.378).abs() < 5e-4);
}
