//! Vertical ground acceleration: an exact similarity, a case of an independent program, loss of
//! contact.

use std::f64::consts::PI;
use std::sync::Arc;

use num_dual::Dual64;
use rocking::housner::{
    Rocking, RockingOptions, RockingOutcome, history, released, solve, solve_lanes,
    solve_with_derivatives,
};
use rocking::scalar::GRAVITY;
use rocking::structure::{Body, Structure};
use strong_motion::Record;

use super::{block, scaled};

fn with<S: Clone>(vertical: &[f64], options: &RockingOptions<S>) -> RockingOptions<S> {
    RockingOptions { vertical: Some(Arc::from(vertical)), ..options.clone() }
}

/// El Centro as the vertical component: shifted by 1.3 s, so that it has nothing to do with the
/// horizontal one.
fn vertical(factor: f64) -> Vec<f64> {
    let accel = Record::el_centro().accel;
    accel.iter().cycle().skip(130).take(accel.len()).map(|a| factor * a).collect()
}

/// Constant a_v = kappa g: time divided by sqrt(1 + kappa), a_g divided by 1 + kappa.
#[test]
fn a_constant_vertical_acceleration_is_another_gravity() {
    let body = block(3.0, 0.7);
    let accel: Vec<f64> = Record::el_centro().accel.into_iter().take(1500).collect();
    for kappa in [-0.4, 0.3, 1.2] {
        let constant = vec![kappa * GRAVITY; accel.len()];
        let scale = 1.1 * (1.0 + kappa);
        let there = solve(&body, 0.01, &accel, &with(&constant, &scaled(scale)));
        // the scale is on both components
        let vertical: Vec<f64> = constant.iter().map(|a| a / scale).collect();
        let here = solve(&body, 0.01, &accel, &with(&vertical, &scaled(scale)));
        let dt = 0.01 * f64::sqrt(1.0 + kappa);
        let level = solve(&body, dt, &accel, &scaled(scale / (1.0 + kappa)));
        assert!(level.impacts.len() > 5, "{kappa} {}", level.impacts.len());
        assert_eq!(
            (here.impacts.len(), here.outcome),
            (level.impacts.len(), RockingOutcome::Rocked)
        );
        for (a, b) in here.theta.iter().zip(&level.theta) {
            assert!((a - b).abs() < 1e-13, "{kappa}: {a} {b}");
        }
        for (a, b) in here.impacts.iter().zip(&level.impacts) {
            assert!((a.time * (1.0 + kappa).sqrt() - b.time).abs() < 1e-11);
        }
        assert_ne!(there.theta, here.theta);
    }
}

/// A block, alpha 0.2, R = 2 m, a_g = -2.5 sin(2 pi t), a_v = B sin(4 pi t + 0.5) m/s2 over the
/// first second; values of a classical Runge-Kutta program in Python with steps of 2e-5 s.
#[test]
fn a_block_on_a_sine_with_and_without_vertical_motion() {
    let (radius, alpha, dt) = (2.0, 0.2_f64, 2.5e-6);
    let body = Body {
        mass: 1.0,
        half_width: radius * alpha.sin(),
        height: radius * alpha.cos(),
        inertia: radius * radius / 3.0,
    };
    let n = 1_000_000;
    let sampled = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
        (0..=n).map(|i| if i <= 400_000 { f(f64::from(i) * dt) } else { 0.0 }).collect()
    };
    let accel = sampled(&|t| -2.5 * (2.0 * PI * t).sin());
    let options = RockingOptions {
        restitution: Some(1.0 - 1.5 * alpha.sin().powi(2)),
        ..RockingOptions::default()
    };
    let cases = [
        (0.0, 0.1463786, [0.5798270, 1.5757455], (0.2171948, -0.2499408)),
        (2.0, 0.1695078, [0.6197615, 1.9622997], (0.3677347, -0.4325412)),
    ];
    for (b, uplift, impacts, peaks) in cases {
        let vertical = sampled(&|t| b * (4.0 * PI * t + 0.5).sin());
        let found = solve(&body, dt, &accel, &with(&vertical, &options));
        // 1e-6: the jump at 1 s takes a sample, and has half of its effect
        assert!((found.uplifts[0].time - uplift).abs() < 1e-6, "{b}: {}", found.uplifts[0].time);
        for (time, impact) in impacts.into_iter().zip(&found.impacts) {
            assert!((impact.time - time).abs() < 1e-6, "{b}: {}", impact.time);
        }
        let most = found.theta.iter().fold(0.0, |a: f64, &b| a.max(b)) / alpha;
        let least = found.theta.iter().fold(0.0, |a: f64, &b| a.min(b)) / alpha;
        assert!(
            (most - peaks.0).abs() < 1e-6 && (least - peaks.1).abs() < 1e-6,
            "{b}: {most} {least}"
        );
    }
}

#[test]
fn a_ground_that_does_not_move_up_gives_the_same_history() {
    let accel = Record::el_centro().accel;
    let body = block(3.0, 0.7);
    let without = history(&body, 0.01, &accel);
    // a vertical record may be shorter: the ground then moves no more
    for zeros in [vec![0.0; accel.len()], vec![0.0; 10], Vec::new()] {
        let with = solve(&body, 0.01, &accel, &with(&zeros, &RockingOptions::default()));
        assert_eq!((with.impacts.len(), with.outcome), (without.impacts.len(), without.outcome));
        assert!(with.theta.iter().zip(&without.theta).all(|(a, b)| (a - b).abs() < 1e-13));
    }
}

/// Resampling a piecewise linear ground changes nothing but where the steps end.
#[test]
fn a_ground_sampled_four_times_finer_gives_the_same_history() {
    let body = block(0.6, 0.12);
    let fine = |coarse: &[f64]| -> Vec<f64> {
        let between = coarse
            .windows(2)
            .flat_map(|p| [0.0, 0.25, 0.5, 0.75].map(|x| p[0] + (p[1] - p[0]) * x));
        between.chain(coarse.last().copied()).collect()
    };
    let (accel, up) = (Record::el_centro().accel[..700].to_vec(), vertical(0.9)[..700].to_vec());
    let options = scaled(0.68);
    let there = solve(&body, 0.04, &accel, &with(&up, &options));
    let here = solve(&body, 0.01, &fine(&accel), &with(&fine(&up), &options));
    assert!(
        here.impacts.len() > 10 && here.outcome == RockingOutcome::Rocked,
        "{} {:?}",
        here.impacts.len(),
        here.outcome
    );
    assert_eq!(there.outcome, here.outcome);
    for (a, b) in there.theta.iter().zip(here.theta.iter().step_by(4)) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}

/// (g + a_v) tan(alpha) with a_v falling linearly: 2 (1 + 10 t) against (9.81 - 60 t)/4 at t =
/// (9.81/4 - 2)/35.
#[test]
fn uplift_is_where_the_falling_limit_is_met() {
    let body = block(4.0, 1.0);
    let (accel, up) = ([-2.0, -4.0], [0.0, -6.0]);
    let found = solve(&body, 0.1, &accel, &with(&up, &RockingOptions::default()));
    assert!(
        (found.uplifts[0].time - (9.81 / 4.0 - 2.0) / 35.0).abs() < 1e-16,
        "{:?}",
        found.uplifts
    );
    assert_eq!(found.uplifts[0].side, 1.0);
}

#[test]
fn a_body_at_rest_leaves_a_ground_that_falls_faster_than_it() {
    let body = block(4.0, 1.0);
    let up = [0.0, -5.0, -15.0, -15.0, 0.0];
    let found = solve(&body, 0.1, &[0.0; 5], &with(&up, &RockingOptions::default()));
    let RockingOutcome::LeavesGround { time } = found.outcome else {
        panic!("{:?}", found.outcome)
    };
    assert!((time - (0.1 + 0.1 * 4.81 / 10.0)).abs() < 1e-15, "{time}");
    assert_eq!(found.theta, [0.0; 2]);
    assert_eq!(found.left_ground(), Some(time));
}

/// N/(m g), by its equation.
fn pressure(body: &Body<f64>, (theta, rate): (f64, f64), (a, up): (f64, f64)) -> f64 {
    let phi = body.alpha() * theta.signum() - theta;
    let second = -body.p_squared() * ((1.0 + up / GRAVITY) * phi.sin() + a / GRAVITY * phi.cos());
    1.0 + (up + body.radius() * (phi.sin() * second - phi.cos() * rate * rate)) / GRAVITY
}

/// When the pivot's force first falls to zero by classical Runge-Kutta steps of a thousandth of dt,
/// the body not landing before.
fn leaves(body: &Body<f64>, start: (f64, f64), dt: f64, accel: &[f64], up: &[f64]) -> f64 {
    let (mut theta, mut rate) = start;
    let at = |record: &[f64], x: f64| {
        let i = (x as usize).min(record.len() - 2);
        record[i] + (record[i + 1] - record[i]) * (x - i as f64)
    };
    let force = |theta: f64, x: f64| {
        let phi = body.alpha() * theta.signum() - theta;
        -body.p_squared()
            * ((1.0 + at(up, x) / GRAVITY) * phi.sin() + at(accel, x) / GRAVITY * phi.cos())
    };
    let h = dt / 1000.0;
    let mut before = f64::NAN;
    for step in 0.. {
        let x = f64::from(step) / 1000.0;
        let now = pressure(body, (theta, rate), (at(accel, x), at(up, x)));
        if now <= 0.0 {
            // linear within the last small step
            return h * (f64::from(step) - now / (now - before));
        }
        before = now;
        let k1 = (rate, force(theta, x));
        let k2 = (rate + 0.5 * h * k1.1, force(theta + 0.5 * h * k1.0, x + 0.0005));
        let k3 = (rate + 0.5 * h * k2.1, force(theta + 0.5 * h * k2.0, x + 0.0005));
        let k4 = (rate + h * k3.1, force(theta + h * k3.0, x + 0.001));
        theta += h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
        rate += h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
    }
    f64::NAN
}

#[test]
fn loss_of_contact_is_located_as_a_fine_integration_finds_it() {
    for structure in
        [Structure::block(2.0, 0.6, 1.0).unwrap(), Structure::a_frame(3.0, 0.9, 1.0).unwrap()]
    {
        let body = structure.body::<f64>();
        let start = (-0.15 * body.alpha(), -0.4);
        // down to -1.4 g within 0.3 s, pushing about at 0.2 g
        let up: Vec<f64> =
            (0..40).map(|i| -1.4 * GRAVITY * (PI * f64::from(i) / 30.0).sin()).collect();
        let accel: Vec<f64> = (0..40).map(|i| 0.2 * GRAVITY * (0.7 * f64::from(i)).sin()).collect();
        let options = released(start.0, start.1);
        let found = solve(&body, 0.02, &accel, &with(&up, &options));
        let RockingOutcome::LeavesGround { time } = found.outcome else {
            panic!("{:?}", found.outcome)
        };
        let expected = leaves(&body, start, 0.02, &accel, &up);
        assert!((time - expected).abs() < 1e-9, "{time} {expected}");
        assert!(found.impacts.is_empty() && found.theta.len() == (time / 0.02) as usize + 1);
    }
}

/// The force at the samples and beside each impact tells where a history must have ended.
#[test]
fn histories_end_where_the_force_at_the_samples_says_and_not_before() {
    let accel = Record::el_centro().accel;
    let mut ended = [0; 2];
    for i in 0..40 {
        let height = 0.4 * 1.1_f64.powi(i);
        let body = block(height, height * (0.15 + 0.01 * f64::from(i % 10)));
        let up = vertical(1.2 + 0.1 * f64::from(i));
        let found = solve(&body, 0.01, &accel, &with(&up, &RockingOptions::default()));
        let force = |i: usize| pressure(&body, (found.theta[i], found.rate[i]), (accel[i], up[i]));
        let upright = |i: &usize| found.theta[*i] != 0.0 && found.theta[*i].abs() < body.alpha();
        assert!((0..found.theta.len()).filter(upright).all(|i| force(i) > 0.0), "{i}");
        if let Some(time) = found.left_ground() {
            assert_eq!(found.theta.len(), (time / 0.01) as usize + 1);
            ended[0] += 1;
        } else if found.outcome == RockingOutcome::Rocked {
            ended[1] += 1;
        }
    }
    assert!(ended.iter().all(|&count| count > 3), "{ended:?}");
}

#[test]
fn lanes_give_what_single_walks_give_bit_for_bit_with_vertical_motion() {
    let accel = Record::el_centro().accel;
    let ups: Vec<Option<Arc<[f64]>>> =
        vec![Some(vertical(0.8).into()), None, Some(vertical(3.6).into())];
    let bodies: Vec<Body<f64>> = (0..60)
        .map(|i| {
            let height = 0.3 * 1.12_f64.powi(i);
            block(height, height * (0.1 + 0.005 * f64::from(i)))
        })
        .collect();
    let options: Vec<RockingOptions<f64>> = (0..60)
        .map(|i| RockingOptions {
            scale: [0.8, 1.3][i / 3 % 2],
            vertical: ups[i % 3].clone(),
            duration: (i % 4 == 0).then_some(12.0 + i as f64),
            ..RockingOptions::default()
        })
        .collect();
    let mut left = 0;
    for (i, lane) in solve_lanes(&bodies, 0.01, &accel, &options).iter().enumerate() {
        assert_eq!(*lane, solve(&bodies[i], 0.01, &accel, &options[i]), "{i}");
        left += usize::from(lane.left_ground().is_some());
    }
    assert!((3..40).contains(&left), "{left}");
}

#[test]
fn derivatives_pass_through_uplifts_and_impacts_with_vertical_motion() {
    let structure = Structure::block(4.0, 1.0, 100.0).unwrap();
    let (accel, up) = (Record::el_centro().accel[..700].to_vec(), vertical(0.7)[..700].to_vec());
    let run = |width: f64, scale: f64| -> Rocking<f64> {
        let body = structure.body::<f64>();
        let body = Body { half_width: body.half_width * (1.0 + width), ..body };
        solve(&body, 0.01, &accel, &with(&up, &scaled(scale)))
    };
    let dual = |width: f64, scale: f64| {
        let body = structure.body::<Dual64>();
        let body = Body { half_width: body.half_width * Dual64::new(1.0, width), ..body };
        solve_with_derivatives(&body, 0.01, &accel, &with(&up, &scaled(Dual64::new(1.5, scale))))
    };
    let differences = |f: &dyn Fn(f64) -> Vec<f64>| -> Vec<f64> {
        let [a, b, c, d] = [-2e-5, -1e-5, 1e-5, 2e-5].map(f);
        (0..a.len()).map(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / 12e-5).collect()
    };
    assert!(run(0.0, 1.5).impacts.len() > 3 && run(0.0, 1.5).outcome == RockingOutcome::Rocked);
    let theta = |rocking: Rocking<Dual64>| -> Vec<f64> {
        rocking.theta.iter().map(|theta| theta.eps).collect()
    };
    for (exact, expected) in [
        (theta(dual(1.0, 0.0)), differences(&|x| run(x, 1.5).theta)),
        (theta(dual(0.0, 1.0)), differences(&|x| run(0.0, 1.5 + x).theta)),
    ] {
        let error = rocking::motion::nrmse(&exact, &expected);
        assert!(error < 1e-6, "{error:e}");
    }
    // the uplift's time, too: a quotient of two things that the scale moves
    let expected = differences(&|x| vec![run(0.0, 1.5 + x).uplifts[0].time])[0];
    let exact = dual(0.0, 1.0).uplifts[0].time.eps;
    assert!((exact - expected).abs() < 1e-7 * expected.abs(), "{exact} {expected}");
}
