//! Edge cases of the finite element model, each against what physics says must happen: continuity
//! where contact only just changes, closed forms, and Housner's body where stiff springs must give
//! it.

use dynamics::{
    fem::{Analysis, Control, History, HistoryOutcome, Start},
    spring::{Chain, Springs},
};
use rocking::{housner, motion::nrmse, scalar::GRAVITY, structure::Structure};
use strong_motion::Record;

use crate::common::{assert_sound, free, paper, plastic, settled, table_1};

/// A solid block of tan(alpha) = 0.25.
fn block() -> Structure {
    Structure::block(2.0, 0.5, 1e3).unwrap()
}

/// g tan(alpha) of the block (m/s2).
const LIMIT: f64 = 0.25 * GRAVITY;

/// The block from rest on plastic springs.
fn shaken(hz: f64, dt: f64, accel: &[f64]) -> History {
    let record = Record::new("made up", dt, accel.to_vec()).unwrap();
    settled(&block(), plastic(hz, block().mass_kg), &record)
}

/// A record that begins with a push below uplift, and falls: the springs ring at its start, and a
/// foot all but lifts within a step that goes on to the next sample. In the end the block leans as
/// statics say, m a h over the stiffness of both feet, 2 b^2 k, less m g h, which is little.
#[test]
fn a_push_that_all_but_lifts_a_foot_at_the_start_is_followed_to_its_end() {
    let structure = Structure::block(2.6, 0.7, 1e3).unwrap();
    let springs = Springs {
        vertical: Chain { k1: 1.373e14, k2: 9.624e11, m2: 600.5, c: 1.943e8 },
        horizontal: Chain { k1: 2.196e15, k2: 2.196e15, m2: 300.0, c: 2.964e9 },
    };
    let stiffness = 2.0 * 0.35_f64.powi(2) * springs.vertical.in_series();
    for fall in [-20.0, -8.5, -4.0, 8.5] {
        for push in (0..40).map(|i| 1.8 + 0.02 * f64::from(i)) {
            let accel: Vec<f64> =
                (0..6).map(|i| f64::copysign(push, fall) - 0.01 * fall * f64::from(i)).collect();
            let control = Control { most_steps: 20_000, ..Control::default() };
            let history =
                Analysis { control, ..Analysis::new(structure.body(), springs, 0.01, &accel) }
                    .simulate();
            let what = format!("{push:.2} m/s2, {fall} m/s3");
            assert_eq!(history.outcome, HistoryOutcome::Completed, "{what}");
            let lean = 1e3 * accel[5] * 1.3 / stiffness;
            let error = (history.motion.theta[5] + lean).abs();
            assert!(error < 0.01 * lean.abs(), "{what}: {error:e} of {lean:e}");
        }
    }
}

/// Two neighbouring numbers, the one that `passes` and the one that does not.
fn bisect(mut yes: f64, mut no: f64, passes: impl Fn(f64) -> bool) -> (f64, f64) {
    assert!(passes(yes) && !passes(no));
    loop {
        let middle = 0.5 * (yes + no);
        if middle == yes || middle == no {
            return (yes, no);
        }
        if passes(middle) {
            yes = middle;
        } else {
            no = middle;
        }
    }
}

/// A falling body is caught by the ground just as its foot comes down: between a push that still
/// lets the foot touch and the next number, that does not, lies a touch-down at zero velocity. What
/// it does must vanish with the step.
#[test]
fn a_touch_down_at_zero_velocity_is_the_same_as_none() {
    let lean = 0.3 * block().body::<f64>().alpha();
    let fall = free(&block(), plastic(160.0, 1e3), lean, 0.01, 200).landings[0].time;
    let rest = block().mass_kg * GRAVITY * block().body::<f64>().v(lean);
    let error = |samples: u16| {
        let dt = 0.9 / f64::from(samples);
        let run = |push: f64| {
            let accel: Vec<f64> = (0..samples)
                .map(|i| if f64::from(i) * dt < 0.5 * fall { 0.0 } else { -push })
                .collect();
            let (body, springs) = (block().body(), plastic(160.0, 1e3));
            Analysis { start: Start::Leaning(lean), ..Analysis::new(body, springs, dt, &accel) }
                .simulate()
        };
        // the left foot is in the air at first
        let touch = |h: &History| h.landings.iter().find(|l| l.foot == 0).copied();
        let (touches, misses) = bisect(0.0, 2.0 * LIMIT, |push| touch(&run(push)).is_some());
        let (one, other) = (run(touches), run(misses));
        assert_sound(&one, samples.into());
        assert_sound(&other, samples.into());
        let graze = touch(&one).unwrap();
        assert!(graze.time > 0.5 * fall && graze.kinetic < 1e-4 * rest, "{graze:?} {rest}");
        nrmse(&one.motion.theta, &other.motion.theta)
    };
    let (coarse, fine) = (error(90), error(900));
    assert!(coarse < 1e-5 && fine < 0.1 * coarse, "{coarse:e} {fine:e}");
}

/// A slow pulse, 1 - cos, of 4 s. The elastic stance leans a little before a foot lifts, so the
/// limit lies below g tan(alpha), by the springs' compliance, 1/Omega_n^2. A foot that lifts lets
/// its horizontal spring go: what that frees, at the edge of balance, is all that one ulp of ground
/// acceleration changes, less the stiffer the springs.
#[test]
fn uplift_begins_at_g_tan_alpha_but_for_the_springs_compliance() {
    let pulse = |peak: f64| -> Vec<f64> {
        let turn = |i: i32| (std::f64::consts::TAU * f64::from(i) / 400.0).cos();
        (0..=400).map(|i| 0.5 * peak * (1.0 - turn(i))).collect()
    };
    let lifts = |history: &History| history.forces.vertical.iter().flatten().any(|n| *n == 0.0);
    let alpha = block().body::<f64>().alpha();
    let (mut missing, mut changes) = (Vec::new(), Vec::new());
    for hz in [40.0, 80.0, 160.0] {
        let run = |peak| shaken(hz, 0.01, &pulse(peak));
        let (above, below) = bisect(1.1 * LIMIT, 0.5 * LIMIT, |peak| lifts(&run(peak)));
        let (one, other) = (run(above), run(below));
        assert_sound(&one, 401);
        assert_sound(&other, 401);
        let change =
            one.motion.theta.iter().zip(&other.motion.theta).map(|(a, b)| (a - b).abs() / alpha);
        changes.push(change.fold(0.0, f64::max));
        missing.push(1.0 - above / LIMIT);
    }
    assert!(missing.windows(2).all(|w| (3.9..4.1).contains(&(w[0] / w[1]))), "{missing:?}");
    assert!(missing[2] > 0.0 && missing[2] < 2e-3, "{missing:?}");
    assert!(changes[0] < 1e-3 && changes.windows(2).all(|w| w[1] < w[0]), "{changes:?}");
}

#[test]
fn a_peak_at_g_tan_alpha_or_one_ulp_beside_it_is_the_same_peak() {
    let run = |peak: f64| {
        let accel = [0.0, 0.5, 1.0, 0.5, 0.0, -0.5, -1.0, -1.0, 0.0, 0.0].map(|x| x * peak);
        shaken(640.0, 0.01, &accel)
    };
    let at = run(LIMIT);
    let alpha = block().body::<f64>().alpha();
    for peak in [LIMIT.next_down(), LIMIT.next_up()] {
        let beside = run(peak);
        assert_sound(&beside, 10);
        assert!(nrmse(&beside.motion.theta, &at.motion.theta) < 1e-6);
        // Housner's body does not move; this one sways on its springs
        assert!(beside.motion.theta.iter().all(|theta| theta.abs() < 1e-4 * alpha));
    }
}

#[test]
fn a_landing_at_a_sample_is_one_landing() {
    let (structure, springs) = (block(), plastic(160.0, 1e3));
    let lean = 0.5 * structure.body::<f64>().alpha();
    let reference = free(&structure, springs, lean, 0.005, 400);
    let first = reference.landings[0].time;
    for nudge in [-1e-15, -1e-16, 0.0, 1e-16, 1e-15] {
        let history = free(&structure, springs, lean, (first + nudge) / 40.0, 100);
        assert_sound(&history, 100);
        let near = history.landings.iter().filter(|l| (l.time - first).abs() < 1e-6).count();
        assert_eq!((near, history.landings[0].foot), (1, reference.landings[0].foot));
        assert!(history.landings[0].impact);
        assert!(history.motion.theta[60] < -1e-2, "it goes over to the other foot");
    }
}

/// Sampled so coarsely that two impacts, or more, fall between two samples, it is the same motion.
#[test]
fn two_impacts_in_one_sample_are_both_found() {
    let (structure, springs) = (block(), plastic(320.0, 1e3));
    let lean = 0.03 * structure.body::<f64>().alpha();
    let (coarse, fine) =
        (free(&structure, springs, lean, 1.0, 3), free(&structure, springs, lean, 0.01, 201));
    assert_sound(&coarse, 3);
    assert_sound(&fine, 201);
    let times =
        |h: &History| h.landings.iter().filter(|l| l.impact).map(|l| l.time).collect::<Vec<_>>();
    let (coarse_times, fine_times) = (times(&coarse), times(&fine));
    assert!(fine_times.iter().filter(|t| **t < 1.0).count() >= 2, "{fine_times:?}");
    assert_eq!(coarse_times.len(), fine_times.len());
    assert!(
        coarse_times.iter().zip(&fine_times).all(|(a, b)| (a - b).abs() < 1e-4),
        "{coarse_times:?} {fine_times:?}"
    );
    for i in 0..3 {
        assert!((coarse.motion.theta[i] - fine.motion.theta[100 * i]).abs() < 1e-4 * lean);
    }
}

/// Housner's body has infinitely many impacts before a rest. On springs they end where the hops are
/// as small as the compliance: the body rests, having lost all that it had.
#[test]
fn ever_smaller_impacts_end_in_rest_and_all_energy_is_accounted_for() {
    let (structure, springs) = (block(), plastic(320.0, 1e3));
    let body = structure.body::<f64>();
    let lean = 0.3 * body.alpha();
    let history = free(&structure, springs, lean, 0.01, 1501);
    assert_sound(&history, 1501);
    let options = housner::released(lean, 0.0);
    let rigid = housner::solve(&body, 0.01, &[0.0; 1501], &options);
    let rest = rigid.theta.iter().position(|theta| *theta == 0.0).unwrap();
    assert!(rigid.theta[rest..].iter().all(|theta| *theta == 0.0));
    assert!(
        history.motion.theta[rest + 100..].iter().all(|theta| theta.abs() < 1e-6 * body.alpha())
    );
    // the first impacts are Housner's; the last, of hops no higher than the settlement, are not
    // told apart
    let times: Vec<f64> = history.landings.iter().filter(|l| l.impact).map(|l| l.time).collect();
    assert!(times.len() > 5, "{times:?}");
    for (time, impact) in times.iter().zip(&rigid.impacts).take(5) {
        assert!((time / impact.time - 1.0).abs() < 0.01, "{time} {}", impact.time);
    }
    let all = body.mass * GRAVITY * body.v(lean);
    let lost = history.account.dissipated[1500];
    assert!((lost / all - 1.0).abs() < 0.01, "{lost} of {all}");
    assert!((lost + history.account.stored[1500]).abs() < 1e-6 * lost);
}

#[test]
fn a_record_that_starts_in_strong_motion_gives_housner_s_history() {
    let accel: Vec<f64> = (0..100).map(|i| if i < 20 { 2.0 * LIMIT } else { 0.0 }).collect();
    let body = block().body::<f64>();
    let rigid = housner::history(&body, 0.01, &accel);
    assert_eq!(rigid.uplifts[0].time, 0.0);
    let error = |hz: f64| {
        let history = shaken(hz, 0.01, &accel);
        assert_sound(&history, 100);
        nrmse(&history.motion.theta, &rigid.theta)
    };
    let (soft, stiff) = (error(320.0), error(1280.0));
    assert!(stiff < 0.02 && stiff < soft / 3.0, "{soft} {stiff}");
}

/// The mass stands above the foot at theta = alpha whatever the springs: on either side the fall
/// grows as cosh(p t).
#[test]
fn near_alpha_the_body_stays_long_and_then_decides() {
    for (structure, springs) in
        [(block(), plastic(320.0, 1e3)), (paper(1e-5), plastic(160.0, 680.1e3))]
    {
        let body = structure.body::<f64>();
        let (alpha, p) = (body.alpha(), body.p());
        let (dt, n) = (0.1 / p, 400);
        for side in [1.0, -1.0] {
            let back = free(&structure, springs, side * alpha * (1.0 - 1e-6), dt, n);
            assert_sound(&back, n);
            // 1e-6 alpha cosh(p t) = alpha
            let landed = back.landings[0].time * p / 2e6_f64.ln();
            assert!((landed - 1.0).abs() < 0.02, "{landed}");
            let over = free(&structure, springs, side * alpha * (1.0 + 1e-6), dt, n);
            let falls = over.outcome;
            assert!(
                matches!(falls, HistoryOutcome::Overturned { time } if time * p > 2e6_f64.ln()),
                "{falls:?}"
            );
            // falling flat the body lets its foot go, and that may touch again; the other does not
            assert!(over.energy_residual < 1e-6 && over.impacts() == 0);
        }
        // in balance, to rounding: nothing moves for as long as rounding takes to grow, ln(1e9)/p
        let still = free(&structure, springs, alpha, dt, 200);
        assert!(still.motion.theta.iter().all(|theta| (theta / alpha - 1.0).abs() < 1e-3));
    }
}

#[test]
fn records_of_no_sample_one_and_two() {
    for (start, theta) in [(Start::Settled, 0.0), (Start::Leaning(0.1), 0.1)] {
        for n in 0..3 {
            let (body, springs, accel) =
                (block().body(), table_1(160.0, 1e3), vec![3.0 * LIMIT; n]);
            let history =
                Analysis { start, ..Analysis::new(body, springs, 0.01, &accel) }.simulate();
            assert_eq!((history.outcome, history.motion.len()), (HistoryOutcome::Completed, n));
            assert_eq!((history.impacts(), history.bounces()), (0, 0));
            let first = history.motion.theta.first();
            assert!(first.is_none_or(|first| (first - theta).abs() < 1e-12), "{first:?}");
            assert!(
                history.energy_residual < 1e-6 && history.motion.u.iter().all(|u| u.is_finite())
            );
            // pushed for 0.01 s: the rigid body leans to the left by p^2 (3 - 1) sin(alpha) t^2/2
            if let (Start::Settled, [_, then]) = (start, &history.motion.theta[..]) {
                let body = block().body::<f64>();
                let rigid = body.p_squared() * body.alpha().sin() * 1e-4;
                assert!(*then < 0.0 && *then > -1.5 * rigid, "{then} {rigid}");
            }
        }
    }
}
