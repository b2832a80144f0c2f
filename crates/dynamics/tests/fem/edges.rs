//! Edge cases of the finite element model, each against what physics says must happen: continuity
//! where contact only just changes, closed forms, and Housner's body where stiff springs must give
//! it.

use std::{f64::consts::FRAC_PI_4, ops::ControlFlow};

use dynamics::{
    fem::{Analysis, Control, Finish, History, HistoryOutcome, Start, View},
    spring::{Chain, Design, Springs},
};
use rocking::{
    housner::{self, RockingOptions},
    motion::nrmse,
    scalar::GRAVITY,
    structure::{Body, Structure},
};
use strong_motion::{Record, Source};

use crate::common::{chains, el_centro, free, paper, plastic, settled, table_1};

/// A solid block of tan(alpha) = 0.25.
fn block() -> Structure {
    Structure::block(2.0, 0.5, 1e3).unwrap()
}

/// g tan(alpha) of the block (m/s2).
const LIMIT: f64 = 0.25 * GRAVITY;

/// The block from rest on plastic springs.
fn shaken(hz: f64, dt: f64, accel: &[f64]) -> History {
    let record = Record {
        name: "made up".into(),
        dt,
        accel: accel.to_vec(),
        vertical: None,
        source: Source::Numbers,
    };
    settled(&block(), plastic(hz, block().mass_kg), &record, Control::default())
}

/// What every history here promises: numbers, all samples, a closed energy account, no energy from
/// nowhere.
fn assert_sound(history: &History, samples: usize) {
    let (motion, account) = (&history.motion, &history.account);
    assert_eq!((history.outcome, motion.len()), (HistoryOutcome::Completed, samples));
    assert!([&motion.u, &motion.v, &motion.theta].into_iter().flatten().all(|x| x.is_finite()));
    assert!(history.energy_residual < 1e-6, "{:e}", history.energy_residual);
    let largest = account.stored.iter().chain(&account.input).fold(0.0_f64, |m, e| m.max(e.abs()));
    assert!(account.dissipated.windows(2).all(|w| w[1] - w[0] > -1e-8 * largest));
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
            let (start, control) = (Start::Leaning(lean), Control::default());
            Analysis { body, springs, start, dt, accel: &accel, vertical: &[], scale: 1.0, control }
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
    let options = RockingOptions { initial: Some((lean, 0.0)), ..RockingOptions::default() };
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
    let rigid = housner::solve(&body, 0.01, &accel, &RockingOptions::default());
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
        let (alpha, p) = (body.alpha(), body.p_squared().sqrt());
        let (dt, n) = (0.1 / p, 400);
        for side in [1.0, -1.0] {
            let back = free(&structure, springs, side * alpha * (1.0 - 1e-6), dt, n);
            assert_sound(&back, n);
            // 1e-6 alpha cosh(p t) = alpha
            let landed = back.landings[0].time * p / 2e6_f64.ln();
            assert!((landed - 1.0).abs() < 0.02, "{landed}");
            let over = free(&structure, springs, side * alpha * (1.0 + 1e-6), dt, n);
            assert!(
                matches!(over.outcome, HistoryOutcome::Overturned { time } if time * p > 2e6_f64.ln()),
                "{:?}",
                over.outcome
            );
            // falling flat the body lets its foot go, and that may touch again; the other does not
            assert!(over.energy_residual < 1e-6 && over.impacts() == 0);
        }
        // in balance, to rounding: nothing moves for as long as rounding takes to grow, ln(1e9)/p
        let still = free(&structure, springs, alpha, dt, 200);
        assert!(still.motion.theta.iter().all(|theta| (theta / alpha - 1.0).abs() < 1e-3));
    }
}

/// An A-frame at alpha = 45 degrees lands along its other leg: e = cos 2 alpha = 0. On springs all
/// but 7 % of the energy goes at once (the rest swings across the leg, which no chain damps), and
/// the body stays down.
#[test]
fn a_frame_of_restitution_zero_loses_its_energy_in_the_first_landing() {
    let body = Body { mass: 1e4, half_width: 5.0, height: 5.0, inertia: 0.0 };
    assert!(body.restitution().abs() < 1e-15 && (body.alpha() - FRAC_PI_4).abs() < 1e-15);
    let (lean, accel) = (0.1, vec![0.0; 300]);
    let options = RockingOptions { initial: Some((lean, 0.0)), ..RockingOptions::default() };
    let rigid = housner::solve(&body, 0.01, &accel, &options);
    let landing = rigid.impacts[0].time;
    assert!(rigid.theta[(landing / 0.01) as usize + 1..].iter().all(|theta| theta.abs() < 1e-12));
    // along the leg both chains act as one
    let ratios = (0.5, 0.1, 0.64);
    for hz in [40.0, 160.0, 640.0] {
        let (springs, start) = (chains(ratios, ratios, hz, body.mass), Start::Leaning(lean));
        let control = Control::default();
        let history = Analysis {
            body,
            springs,
            start,
            dt: 0.01,
            accel: &accel,
            vertical: &[],
            scale: 1.0,
            control,
        }
        .simulate();
        assert_sound(&history, 300);
        let first = &history.landings[0];
        assert!(first.impact && (first.time / landing - 1.0).abs() < 0.01, "{first:?} {landing}");
        assert!(first.lost > 0.93 * first.kinetic, "{hz} Hz: {first:?}");
        let at = |t: f64| &history.motion.theta[(t / 0.01) as usize..];
        let largest = |theta: &[f64]| theta.iter().fold(0.0_f64, |m, theta| m.max(theta.abs()));
        assert!(largest(at(first.time + 0.01)) < 0.07 * lean);
        assert!(largest(at(2.0)) < 1e-6 * lean, "{hz} Hz: it rests");
    }
}

/// The other end: e goes to 1 as the body gets slender, and so does what a landing on springs
/// leaves.
#[test]
fn slender_frames_approach_restitution_one_as_housner_s_do() {
    for alpha in [0.2, 0.1, 0.05_f64] {
        let structure = Structure::a_frame(20.0, 40.0 * alpha.tan(), 1e4).unwrap();
        let body = structure.body::<f64>();
        let history = free(&structure, plastic(640.0, 1e4), 0.5 * alpha, 0.02, 1500);
        assert_sound(&history, 1500);
        let impacts: Vec<_> = history.landings.iter().filter(|l| l.impact).collect();
        assert!(impacts.len() >= 4);
        // the account from impact to impact
        let expected = 1.0 - body.restitution().powi(2);
        for landing in &impacts[..3] {
            let lost = landing.lost / landing.kinetic;
            assert!((lost / expected - 1.0).abs() < 0.05, "alpha {alpha}: {lost} {expected}");
        }
    }
}

/// Equal chains both ways: repeated eigenvalues, contact forces without a preferred direction.
#[test]
fn equal_vertical_and_horizontal_springs_are_no_special_case() {
    let (structure, record) = (paper(1e-5), el_centro());
    let ratios = (0.3, 0.1, 0.75);
    let springs = chains(ratios, ratios, 320.0, structure.mass_kg);
    assert_eq!(springs.vertical, springs.horizontal);
    let history = settled(&structure, springs, &record, Control::default());
    assert_sound(&history, record.accel.len());
    let body = structure.body::<f64>();
    let rigid = housner::solve(&body, record.dt, &record.accel, &RockingOptions::default());
    let error = nrmse(&history.motion.u, &rigid.motion(&body).u);
    assert!(error < 0.05, "{error}");
    let nearly = Chain { k1: springs.horizontal.k1 * (1.0 + 1e-9), ..springs.horizontal };
    let beside =
        settled(&structure, Springs { horizontal: nearly, ..springs }, &record, Control::default());
    let change = nrmse(&beside.motion.u, &history.motion.u);
    assert!(change < 1e-5, "{change:e}");
}

/// Without dashpots only springs that let go take energy: none is dissipated, to the last bit.
#[test]
fn without_dampers_nothing_is_dissipated() {
    for share in [0.0, 1e-2] {
        let structure = paper(share);
        let design = |mu, k| Design::from_kc(mu, k, 0.0, 40.0);
        let springs = Springs { vertical: design(0.3, 1.0), horizontal: design(0.3, 0.57) }
            .chains(structure.mass_kg);
        let record = el_centro();
        let (mut samples, mut released) = (0, 0.0);
        let case = Analysis {
            body: structure.body(),
            springs,
            start: Start::Settled,
            dt: record.dt,
            accel: &record.accel,
            vertical: &[],
            scale: 1.0,
            control: Control::default(),
        };
        let finish: Finish<f64> = case.observe(&mut |_: usize, view: &View<f64>| {
            samples += 1;
            assert!(view.x().is_finite() && view.z().is_finite());
            ControlFlow::Continue(())
        });
        assert_eq!((finish.outcome, samples), (HistoryOutcome::Completed, record.accel.len()));
        assert_eq!(finish.energy.dissipated, 0.0);
        released += finish.energy.released;
        assert!(released > 0.0, "a foot that lifts lets its horizontal spring go");
        let residual = finish.energy.residual().abs() / finish.energy_scale;
        assert!(residual < 1e-6, "{residual:e}");
    }
}

#[test]
fn records_of_no_sample_one_and_two() {
    for (start, theta) in [(Start::Settled, 0.0), (Start::Leaning(0.1), 0.1)] {
        for n in 0..3 {
            let (body, springs, accel) =
                (block().body(), table_1(160.0, 1e3), vec![3.0 * LIMIT; n]);
            let history = Analysis {
                body,
                springs,
                start,
                dt: 0.01,
                accel: &accel,
                vertical: &[],
                scale: 1.0,
                control: Control::default(),
            }
            .simulate();
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
