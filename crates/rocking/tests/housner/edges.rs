//! Edge cases: each gives a finite history or a named outcome.

use std::f64::consts::FRAC_PI_2;

use rocking::housner::{RockingOptions, RockingOutcome, history, released, solve};
use rocking::structure::{Body, Structure};

/// tan(alpha) = 0.25 exactly.
fn block() -> Body<f64> {
    Structure::block(4.0, 1.0, 1.0).unwrap().body()
}

const LIMIT: f64 = 9.81 * 0.25;

#[test]
fn no_sample_and_one_sample_are_histories_without_motion() {
    let none = history(&block(), 0.01, &[]);
    assert_eq!((none.theta.len(), none.outcome), (0, RockingOutcome::NeverMoved));
    let one = history(&block(), 0.01, &[5.0]);
    assert_eq!((one.theta, one.outcome), (vec![0.0], RockingOutcome::NeverMoved));
}

#[test]
fn ground_below_the_limit_never_moves_the_body() {
    let accel: Vec<f64> = (0..500).map(|i| 0.999 * LIMIT * (0.3 * f64::from(i)).sin()).collect();
    let still = history(&block(), 0.01, &accel);
    assert_eq!((still.theta, still.outcome), (vec![0.0; 500], RockingOutcome::NeverMoved));
}

#[test]
fn a_record_starting_in_strong_motion_lifts_the_body_at_once() {
    let rocking = history(&block(), 0.01, &[2.0 * LIMIT, 2.0 * LIMIT, 0.0]);
    assert_eq!((rocking.uplifts[0].time, rocking.uplifts[0].side), (0.0, -1.0));
    // theta'' = -p^2 (2 - 1) sin(alpha) at first
    let body = block();
    let expected = -0.5 * body.p_squared() * body.alpha().sin() * 1e-4;
    assert!((rocking.theta[1] / expected - 1.0).abs() < 1e-4);
}

#[test]
fn a_peak_at_the_limit_or_one_ulp_beyond_does_no_harm() {
    for peak in
        [LIMIT.next_down(), LIMIT, LIMIT.next_up(), LIMIT * (1.0 + 1e-15), LIMIT * (1.0 + 1e-12)]
    {
        for sign in [1.0, -1.0] {
            let accel =
                [0.0, 0.5, 1.0, 0.5, 0.0, -0.5, -1.0, -1.0, 0.0, 0.0].map(|x| sign * x * peak);
            let rocking = history(&block(), 0.01, &accel);
            assert_eq!(rocking.theta.len(), accel.len());
            assert!(rocking.theta.iter().all(|theta| theta.abs() < 1e-9), "{peak}");
            assert!(matches!(rocking.outcome, RockingOutcome::Rocked | RockingOutcome::NeverMoved));
        }
    }
}

/// Lift-off where the record passes the limit: w'' = p^2 cos(alpha) (|a_g|/g - tan(alpha)) grows
/// from zero, w = c t^3/6.
#[test]
fn uplift_inside_a_sample_starts_with_no_acceleration() {
    let body = block();
    let rocking = history(&body, 0.01, &[0.0, -2.0 * LIMIT, -2.0 * LIMIT]);
    assert!((rocking.uplifts[0].time - 0.005).abs() < 1e-17);
    let jerk = body.p_squared() * body.alpha().cos() * 0.5 / 0.01;
    assert!((rocking.theta[1] / (jerk * 0.005_f64.powi(3) / 6.0) - 1.0).abs() < 1e-4);
}

/// A half cycle that lands exactly at a sample: the record is chosen so that theta = 0 there (its
/// impact time found first).
#[test]
fn an_impact_at_a_sample_is_one_impact() {
    let body = block();
    let start = |phi: f64| released(phi * body.alpha(), 0.0);
    let quarter = solve(&body, 0.01, &[0.0; 200], &start(0.5)).impacts[0].time;
    for nudge in [-1e-15, -1e-16, 0.0, 1e-16, 1e-15] {
        let rocking = solve(&body, (quarter + nudge) / 40.0, &[0.0; 100], &start(0.5));
        let near =
            rocking.impacts.iter().filter(|impact| (impact.time - quarter).abs() < 1e-12).count();
        assert_eq!(near, 1);
        assert!(rocking.theta[40].abs() < 1e-14);
        assert!(rocking.theta[60] < -1e-3);
    }
}

#[test]
fn two_impacts_in_one_sample_are_both_found() {
    // down at 1e-4 rad with hops of 2 v/d: a coarse sample holds several
    let body = block();
    let options = RockingOptions { restitution: Some(0.8), ..released(1e-4, 0.0) };
    let coarse = solve(&body, 0.05, &[0.0; 20], &options);
    let fine = solve(&body, 0.0005, &[0.0; 2000], &options);
    let in_second = |time: f64| (0.05..0.1).contains(&time);
    assert!(coarse.impacts.iter().filter(|impact| in_second(impact.time)).count() >= 2);
    for (a, b) in coarse.impacts.iter().zip(&fine.impacts).take(5) {
        assert!((a.time - b.time).abs() < 1e-14 && (a.rate_after - b.rate_after).abs() < 1e-15);
    }
}

/// Level ground: hops v, e v, e^2 v ... of 2 v/d each end after v0/d (1 + 2 e/(1 - e)).
#[test]
fn ever_smaller_impacts_end_in_rest_when_the_closed_form_says() {
    let body = block();
    let e = body.restitution();
    let d = body.p_squared() * body.alpha().sin();
    let theta = 1e-5_f64;
    let end = (2.0 * theta / d).sqrt() * (1.0 + 2.0 * e / (1.0 - e));
    let options = released(theta, 0.0);
    let dt = end / 100.0;
    let rocking = solve(&body, dt, &[0.0; 200], &options);
    assert!(rocking.theta[..98].iter().any(|theta| *theta != 0.0));
    // 1e-4: the field changes by phi over the first hop
    assert!(rocking.theta[101..].iter().all(|theta| *theta == 0.0));
    let last = rocking.impacts.last().unwrap().time;
    assert!(last > 0.97 * end && last < 1.001 * end, "{last} {end}");
}

#[test]
fn restitution_zero_rests_at_the_first_landing_and_lifts_again() {
    let body = block();
    let mut accel = vec![0.0; 300];
    accel[200..].fill(-1.5 * LIMIT);
    let options = RockingOptions { restitution: Some(0.0), ..released(0.3 * body.alpha(), 0.0) };
    let rocking = solve(&body, 0.01, &accel, &options);
    assert_eq!(rocking.impacts[0].rate_after, 0.0);
    let landed = (rocking.impacts[0].time / 0.01) as usize + 1;
    assert!(rocking.theta[landed..=199].iter().all(|theta| *theta == 0.0));
    assert_eq!(rocking.uplifts.len(), 1);
    assert!(rocking.theta[299] > 0.0);
}

#[test]
fn restitution_one_keeps_its_energy_over_hundreds_of_impacts() {
    let body = block();
    let (alpha, p2) = (body.alpha(), body.p_squared());
    let options = RockingOptions { restitution: Some(1.0), ..released(0.2 * alpha, 0.0) };
    let rocking = solve(&body, 0.02, &vec![0.0; 20_000], &options);
    assert!(rocking.impacts.len() > 200);
    let first = rocking.impacts[0].rate_after.abs();
    let level = (2.0 * p2 * ((0.8 * alpha).cos() - alpha.cos())).sqrt();
    assert!((first / level - 1.0).abs() < 1e-13);
    let last = rocking.impacts[rocking.impacts.len() - 1].rate_after.abs();
    assert!((last / first - 1.0).abs() < 1e-11, "{:e}", last / first - 1.0);
}

/// One ulp either side of balance: the fall grows as cosh(p t) from the difference.
#[test]
fn near_alpha_the_body_stays_long_and_then_decides() {
    let body = block();
    let alpha = body.alpha();
    let below = released(alpha * (1.0 - 1e-9), 0.0);
    let back = solve(&body, 0.01, &[0.0; 3000], &below);
    assert!(!back.impacts.is_empty());
    assert!(matches!(back.outcome, RockingOutcome::Rocked));
    // 1e-9 alpha cosh(p t) = alpha
    let p = body.p();
    assert!((back.impacts[0].time * p / 2e9_f64.ln() - 1.0).abs() < 0.01);
    let beyond = released(-alpha * (1.0 + 1e-9), 0.0);
    let fall = solve(&body, 0.01, &[0.0; 3000], &beyond);
    assert_eq!(fall.outcome, RockingOutcome::Overturned { time: 0.0 });
    assert!(fall.theta.len() < 3000 && fall.theta.iter().all(|theta| theta.abs() < FRAC_PI_2));
}

/// Energy decides on level ground: a rate at theta = 0 that just passes the barrier p^2 (1 - cos
/// alpha).
#[test]
fn overturning_follows_the_energy_barrier() {
    let body = block();
    let barrier = (2.0 * body.p_squared() * (1.0 - body.alpha().cos())).sqrt();
    let run = |rate: f64| {
        let options = released(0.0, rate);
        solve(&body, 0.01, &[0.0; 3000], &options)
    };
    assert_eq!(run(barrier * (1.0 - 1e-6)).outcome, RockingOutcome::Rocked);
    let over = run(barrier * (1.0 + 1e-6));
    let RockingOutcome::Overturned { time } = over.outcome else { panic!("{:?}", over.outcome) };
    let i = (time / 0.01) as usize;
    assert!(over.theta[i] < body.alpha() && over.theta[i + 1] >= body.alpha());
    // a history that ends beyond alpha, still falling
    let options = RockingOptions { duration: Some(0.9), ..released(0.0, barrier * 1.1) };
    let cut = solve(&body, 0.01, &[0.0; 3000], &options);
    assert_eq!(cut.theta.len(), 91);
    assert!(cut.theta[90] > body.alpha());
    assert!(matches!(cut.outcome, RockingOutcome::Overturned { .. }));
}

/// Uplift under a steady push, run backwards in time: the body comes down to theta = 0 and theta' =
/// 0 at one instant, and the push lifts it as it did.
#[test]
fn a_touch_down_at_zero_velocity_is_followed_by_the_same_uplift() {
    let body = block();
    for push in [2.0 * LIMIT, -2.0 * LIMIT] {
        let up = history(&body, 0.01, &[push; 51]);
        let back = released(up.theta[50], -up.rate[50]);
        let there_and_back = solve(&body, 0.01, &[push; 101], &back);
        assert_eq!(there_and_back.outcome, RockingOutcome::Rocked);
        for k in 0..=50 {
            let scale = up.theta[50].abs();
            assert!(
                (there_and_back.theta[50 - k] - up.theta[k]).abs() < 1e-14 * scale,
                "{k} before"
            );
            assert!(
                (there_and_back.theta[50 + k] - up.theta[k]).abs() < 1e-13 * scale,
                "{k} after"
            );
        }
        assert!(there_and_back.impacts.iter().all(|impact| impact.rate_before.abs() < 1e-7));
    }
}

#[test]
fn a_start_at_the_ground_without_a_rate_moves_only_if_pushed() {
    let body = block();
    let options = released(1e-300, 0.0);
    for accel in [[0.0; 50], [-1.2 * LIMIT; 50], [1.2 * LIMIT; 50]] {
        let rocking = solve(&body, 0.01, &accel, &options);
        assert_eq!(rocking.theta.len(), 50);
        assert!(rocking.theta.iter().all(|theta| theta.is_finite()));
        assert_eq!(rocking.theta[49].abs() > 1e-3, accel[0] != 0.0);
    }
}

#[test]
fn elastic_hops_too_small_to_end_stop_at_the_work_bound() {
    let body = block();
    let options = RockingOptions { restitution: Some(1.0), max_work: 1000, ..released(1e-12, 0.0) };
    let rocking = solve(&body, 0.05, &[0.0; 100], &options);
    assert!(matches!(rocking.outcome, RockingOutcome::WorkBound { .. }));
    assert!(rocking.theta.len() < 100);
}

#[test]
fn numbers_that_are_not_finite_are_an_outcome() {
    for bad in [f64::NAN, f64::INFINITY] {
        let rocking = history(&block(), 0.01, &[0.0, 2.0 * LIMIT, bad, 0.0, 0.0]);
        assert!(
            matches!(
                rocking.outcome,
                RockingOutcome::NotFinite { .. } | RockingOutcome::Overturned { .. }
            ),
            "{:?}",
            rocking.outcome
        );
        assert!(rocking.theta.iter().all(|theta| theta.is_finite()));
    }
}

#[test]
fn ten_g_on_a_hand_sized_block_at_a_coarse_step_is_finite() {
    let body = Structure::block(0.1, 0.05, 0.1).unwrap().body::<f64>();
    let accel: Vec<f64> = (0..400).map(|i| 98.1 * (1.7 * f64::from(i)).sin()).collect();
    let rocking = history(&body, 0.05, &accel);
    assert!(matches!(rocking.outcome, RockingOutcome::Overturned { .. }));
    assert!(rocking.theta.iter().all(|theta| theta.abs() < FRAC_PI_2));
}
