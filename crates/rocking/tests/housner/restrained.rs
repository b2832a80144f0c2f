//! Housner's body with a tendon and dampers: another program, energy, limits, derivatives.

use num_dual::Dual64;
use rocking::{
    housner::{
        Rocking, RockingOptions, RockingOutcome, history, released, solve, solve_lanes,
        solve_with_derivatives,
    },
    members::{Damper, Members, Tendon},
    scalar::GRAVITY,
    structure::Body,
};

use super::{block, in_si};

const BODY: Body<f64> = Body { mass: 120e3, half_width: 1.05, height: 8.9, inertia: 3.0e5 };
const TENDON: Option<Tendon> = Some(Tendon { stiffness: 4e7, pretension: 2e5 });
const DAMPER: Option<Damper> = Some(Damper { c: 8e4 });

fn of(tendon: Option<Tendon>, damper: Option<Damper>) -> RockingOptions<f64> {
    let members = Members { tendon, damper, friction: None };
    RockingOptions { members, ..RockingOptions::default() }
}

/// Three sines (m/s2), rounded as `.ci/restrained.py` does.
fn ground() -> Vec<f64> {
    let sines = |t: f64| {
        0.25 * (5.1 * t).sin() + 0.2 * (11.3 * t + 1.0).sin() + 0.15 * (23.7 * t + 2.0).sin()
    };
    let at = |i: i32| 0.01 * f64::from(i);
    (0..=800)
        .map(|i| (sines(at(i)) * (0.5 * at(i)).min(1.0) * GRAVITY * 1e6).round() / 1e6)
        .collect()
}

/// Values of SciPy's DOP853, which works with places and forces in x and z (`python3
/// .ci/restrained.py`).
#[test]
fn another_program_has_the_same_history() {
    let cases = [
        (TENDON, None, 350, -0.03906785840028339, -0.006627876438554603, 1.2583689263218611),
        (None, DAMPER, 464, -0.03787566697351506, -0.0032638744677839573, 1.3432084643702795),
        (TENDON, DAMPER, 349, -0.038373199870574116, -0.006595317435374939, 1.2578239165719736),
    ];
    for (tendon, damper, at, peak, end, first) in cases {
        let found = solve(&BODY, 0.01, &ground(), &of(tendon, damper));
        assert_eq!((found.outcome, found.impacts.len()), (RockingOutcome::Rocked, 11));
        let largest = found.theta.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!((found.theta[at] - peak).abs() < 1e-9, "{} {peak}", found.theta[at]);
        assert!((largest - peak.abs()).abs() < 1e-9);
        assert!((found.theta[800] - end).abs() < 1e-9, "{} {end}", found.theta[800]);
        assert!((found.impacts[0].time - first).abs() < 1e-9, "{}", found.impacts[0].time);
    }
}

/// Energy of the body and its tendon (J).
fn energy(theta: f64, rate: f64, Tendon { stiffness, pretension }: Tendon) -> f64 {
    let (b, h) = (BODY.half_width, BODY.height);
    let (sin, cos) = theta.abs().sin_cos();
    // from the pivot
    let (x, z) = (b * cos - h * sin, b * sin + h * cos);
    let stretch = (x - b).hypot(z) - (h - pretension / stiffness);
    let inertia = BODY.inertia + BODY.mass * (b * b + h * h);
    0.5 * inertia * rate * rate + BODY.mass * GRAVITY * z + 0.5 * stiffness * stretch * stretch
}

/// Between impacts on still ground a tendon keeps the energy, and dampers take from it what their
/// forces do; an impact takes 1 - e^2 of what moves.
#[test]
fn a_tendon_keeps_the_energy_between_impacts() {
    let tendon = TENDON.unwrap();
    let options = RockingOptions { members: of(TENDON, None).members, ..released(0.05, 0.0) };
    let free = solve(&BODY, 0.01, &[0.0; 300], &options);
    let of_sample = |i: usize| energy(free.theta[i], free.rate[i], tendon);
    let rest = energy(0.0, 0.0, tendon);
    let first = (free.impacts[0].time / 0.01) as usize;
    assert!(first > 10 && free.impacts.len() > 2);
    for i in 0..=first {
        assert!((of_sample(i) - of_sample(0)).abs() < 1e-12 * (of_sample(0) - rest), "{i}");
    }
    let e = BODY.restitution();
    let second = (free.impacts[1].time / 0.01) as usize;
    for i in first + 1..=second {
        let left = (of_sample(i) - rest) / (of_sample(0) - rest);
        assert!((left / (e * e) - 1.0).abs() < 1e-10, "{i}");
    }
}

/// On still ground 4 b^2 c/I0 stops the body: far above p it sinks as on a dashpot, at m g b/(4 b^2
/// c) at first.
#[test]
fn strong_dampers_let_the_body_sink_slowly() {
    let c = 1e9;
    let options =
        RockingOptions { members: of(None, Some(Damper { c })).members, ..released(0.01, 0.0) };
    let found = solve(&BODY, 0.01, &[0.0; 101], &options);
    let weight = BODY.mass * GRAVITY * BODY.radius();
    let expected = -weight * (BODY.alpha() - 0.01).sin() / (4.0 * BODY.half_width.powi(2) * c);
    let sinks = (found.theta[100] - found.theta[50]) / 0.5;
    assert!((sinks / expected - 1.0).abs() < 0.01, "{sinks} {expected}");
    // beyond what steps can follow it says so
    let stiff = RockingOptions {
        members: of(None, Some(Damper { c: 1e18 })).members,
        max_work: 10_000,
        ..released(0.01, 0.0)
    };
    let outcome = solve(&BODY, 0.01, &[0.0; 101], &stiff).outcome;
    assert!(matches!(outcome, RockingOutcome::WorkBound { .. }), "{outcome:?}");
}

/// |a_g| m h against (m g + N_0) b.
#[test]
fn a_tendon_holds_the_body_down_as_a_weight_does() {
    let limit = BODY.half_width / BODY.height * (GRAVITY + 2e5 / BODY.mass);
    let ramp: Vec<f64> = (0..400).map(|i| 0.01 * f64::from(i)).collect();
    let found = solve(&BODY, 0.01, &ramp, &of(TENDON, None));
    assert!((found.uplifts[0].time - limit).abs() < 1e-12, "{}", found.uplifts[0].time);
    let below = vec![0.999 * limit; 400];
    let outcome = solve(&BODY, 0.01, &below, &of(TENDON, None)).outcome;
    assert_eq!(outcome, RockingOutcome::NeverMoved);
}

#[test]
fn members_of_no_force_change_nothing() {
    let none = of(Some(Tendon { stiffness: 1e-6, pretension: 0.0 }), Some(Damper { c: 0.0 }));
    let (bare, found) = (history(&BODY, 0.01, &ground()), solve(&BODY, 0.01, &ground(), &none));
    assert_eq!(found.impacts.len(), bare.impacts.len());
    for (a, b) in found.theta.iter().zip(&bare.theta) {
        assert!((a - b).abs() < 1e-13, "{a} {b}");
    }
}

/// A tendon that grows taut brings back a body from beyond alpha; the bare one falls.
#[test]
fn a_tendon_brings_back_what_would_fall() {
    let push: Vec<f64> = (0..900).map(|i| if i < 100 { -2.2 } else { 0.0 }).collect();
    let bare = history(&BODY, 0.01, &push);
    assert!(bare.overturned().is_some());
    let tendon = Some(Tendon { stiffness: 5e6, pretension: 0.0 });
    let held = solve(&BODY, 0.01, &push, &of(tendon, None));
    let alpha = BODY.alpha();
    let largest = held.theta.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(largest > alpha && held.outcome == RockingOutcome::Rocked, "{largest} {alpha}");
    // the record ends where it is far beyond alpha, on its way out or back
    for cut in [120, 300] {
        let part = solve(&BODY, 0.01, &push[..cut], &of(tendon, None));
        assert_eq!(part.overturned(), None, "{cut}");
    }
    let slack = Some(Tendon { stiffness: 1e3, pretension: 0.0 });
    assert!(solve(&BODY, 0.01, &push[..300], &of(slack, None)).overturned().is_some());
}

/// By the width of the body and the record's scale, through impacts.
#[test]
fn derivatives_are_those_of_differences() {
    let theta = |dx: f64, ds: f64| -> Vec<f64> {
        let body = Body { half_width: BODY.half_width * (1.0 + dx), ..BODY };
        solve(&body, 0.01, &ground(), &RockingOptions { scale: 1.0 + ds, ..of(TENDON, DAMPER) })
            .theta
    };
    for by_width in [true, false] {
        let mut one = [Dual64::from_re(1.0); 2];
        one[usize::from(!by_width)] = one[usize::from(!by_width)].derivative();
        let real = Dual64::from_re;
        let body = Body {
            mass: real(BODY.mass),
            half_width: one[0] * BODY.half_width,
            height: real(BODY.height),
            inertia: real(BODY.inertia),
        };
        let options = RockingOptions {
            scale: one[1],
            members: of(TENDON, DAMPER).members,
            ..RockingOptions::default()
        };
        let exact = solve_with_derivatives(&body, 0.01, &ground(), &options);
        let d = 1e-6;
        let (up, down) = if by_width {
            (theta(d, 0.0), theta(-d, 0.0))
        } else {
            (theta(0.0, d), theta(0.0, -d))
        };
        let largest = exact.theta.iter().fold(0.0, |most: f64, x| most.max(x.eps.abs()));
        for (i, x) in exact.theta.iter().enumerate() {
            let difference = (up[i] - down[i]) / (2.0 * d);
            assert!((x.eps - difference).abs() < 1e-5 * largest, "{i} {} {difference}", x.eps);
        }
    }
}

/// With vertical motion a history ends where the pivot lets go: later where tendon and dampers
/// press on it.
#[test]
fn members_press_the_pivot_on_the_ground() {
    let accel: Vec<f64> = (0..400).map(|i| if i < 40 { -3.0 } else { 0.0 }).collect();
    let up: Vec<f64> = (0..400).map(|i| -0.05 * f64::from(i)).collect();
    let left = |options: RockingOptions<f64>| -> Rocking<f64> {
        let vertical = Some(up.clone().into());
        solve(&BODY, 0.01, &accel, &RockingOptions { vertical, ..options })
    };
    let [bare, tendon, both] =
        [of(None, None), of(TENDON, None), of(TENDON, DAMPER)].map(|of| left(of).left_ground());
    // at rest it does at a_v = -g, or where the tendon's pull is lost, too
    let rest = solve(
        &BODY,
        0.01,
        &[0.0; 400],
        &RockingOptions { vertical: Some(up.clone().into()), ..of(TENDON, None) },
    );
    let expected = (GRAVITY + 2e5 / BODY.mass) / 5.0;
    assert!((rest.left_ground().unwrap() - expected).abs() < 1e-9, "{rest:?}");
    assert!(bare < tendon && bare.is_some(), "{bare:?} {tendon:?} {both:?}");
    assert!(both != tendon, "{both:?}");
}

#[test]
fn many_at_once_are_as_one_alone() {
    let body = block(3.0, 0.7);
    let record = in_si(&super::noise(0.01, 6.0));
    let all = [of(None, None), of(TENDON, None), of(None, DAMPER), of(None, None)];
    let together = solve_lanes(&[BODY, BODY, BODY, body], 0.01, &record, &all);
    for (i, (body, options)) in [BODY, BODY, BODY, body].iter().zip(&all).enumerate() {
        assert!(together[i] == solve(body, 0.01, &record, options), "{i}");
    }
}
