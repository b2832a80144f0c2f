//! Vertical ground acceleration: stiff springs follow Housner as well as without it, the account
//! closes, a thrown body flies.

use dynamics::{
    fem::{Analysis, History, HistoryOutcome},
    spring::{Chain, Design, Springs},
};
use rocking::synthetic;
use rocking::{
    conditioning::Conditioning,
    housner::{self, RockingOptions},
    motion::nrmse,
    scalar::GRAVITY,
    structure::{Body, Structure},
};

use crate::common::{lively, plastic, table_1};

/// Omega_n/p of the springs.
const STIFF: f64 = 1e5;

/// A chain that hardly rebounds, scaled by the mass that lands, under horizontals 20 times as
/// stiff.
fn springs(body: &Body<f64>) -> Springs<Chain> {
    let point = body.mass * body.radius().powi(2);
    let landing = 1.0 - point / (point + body.inertia) * body.alpha().sin().powi(2);
    let hz = STIFF * body.p() / std::f64::consts::TAU;
    let vertical = Design::from_kc(0.665 * landing, 0.02, 0.55 * landing.sqrt(), hz);
    Springs { vertical, horizontal: Design::from_kc(0.3, 1.0, 2.0, 20.0 * hz) }.chains(body.mass)
}

fn simulate(
    body: Body<f64>,
    springs: Springs<Chain>,
    dt: f64,
    accel: &[f64],
    vertical: &[f64],
) -> History {
    Analysis { vertical, ..Analysis::new(body, springs, dt, accel) }.simulate()
}

/// A horizontal motion, and another one with a peak of `peak` (g) as the vertical.
fn motions(body: &Body<f64>, n: usize, peak: f64) -> Vec<(f64, Vec<f64>, Vec<f64>)> {
    let suite = |seed: u64| synthetic::suite(n, seed, body.p(), body.alpha());
    suite(3)
        .zip(suite(4))
        .map(|(horizontal, vertical)| {
            let factor = peak / vertical.pga_g();
            let up = (0..horizontal.len())
                .map(|i| factor * vertical.at(i as f64 * horizontal.dt))
                .collect();
            (horizontal.dt, horizontal.accel, up)
        })
        .collect()
}

#[test]
fn stiff_springs_follow_housner_as_well_with_vertical_motion_as_without() {
    for structure in [Structure::paper(), Structure::block(12.0, 2.4, 350e3).unwrap()] {
        let body = structure.body::<f64>();
        let springs = springs(&body);
        let (mut with, mut without) = (Vec::new(), Vec::new());
        for (dt, accel, up) in motions(&body, 100, 0.6) {
            for (vertical, errors) in [(&up[..], &mut with), (&[][..], &mut without)] {
                let options =
                    RockingOptions { vertical: Some(vertical.into()), ..RockingOptions::default() };
                let rocking = housner::solve(&body, dt, &accel, &options);
                let history = simulate(body, springs, dt, &accel, vertical);
                assert!(history.energy_residual < 1e-6, "{:e}", history.energy_residual);
                let rocked = rocking.outcome == housner::RockingOutcome::Rocked
                    && history.outcome == HistoryOutcome::Completed;
                if rocked && Conditioning::new(&body, dt, &accel, &options).well_conditioned() {
                    errors.push(nrmse(&history.motion.u, &rocking.motion(&body).u));
                }
            }
        }
        for errors in [&mut with, &mut without] {
            errors.sort_by(f64::total_cmp);
        }
        println!("{with:?}\n{without:?}");
        let median = |errors: &[f64]| errors[errors.len() / 2];
        assert!(with.len() > 10 && without.len() > 10, "{} {}", with.len(), without.len());
        assert!(
            median(&with) < 1e-3 && median(&with) < 2.0 * median(&without),
            "{with:?} {without:?}"
        );
    }
}

/// Springs soft and stiff that bounce or not, a vertical motion of more than 1 g: the account
/// closes whether the body flies or not.
#[test]
fn the_energy_account_closes_with_vertical_motion() {
    for structure in [Structure::paper(), Structure::block(2.0, 0.5, 2.4e3).unwrap()] {
        let body = structure.body::<f64>();
        let stiff = 160.0 * (63.0 / body.radius()).sqrt();
        let mut flights = 0;
        for (dt, accel, up) in motions(&body, 8, 1.4) {
            for springs in
                [plastic(stiff, body.mass), lively(stiff, body.mass), table_1(stiff, body.mass)]
            {
                let history = simulate(body, springs, dt, &accel, &up);
                let residual = history.energy_residual;
                assert!(residual < 1e-6, "{residual:e} {:?}", history.outcome);
                flights += usize::from(history.airborne > 0.02);
            }
        }
        assert!(flights > 0);
    }
}

/// A ground that falls away for good at 1.5 g under a standing body: from then on it flies, at -g +
/// 1.5 g in the ground's frame.
#[test]
fn a_body_on_a_ground_that_falls_faster_flies() {
    let body = Structure::block(2.0, 0.5, 2.4e3).unwrap().body::<f64>();
    let (dt, n) = (1e-3, 201);
    let history =
        simulate(body, plastic(2e3, body.mass), dt, &vec![0.0; n], &vec![-1.5 * GRAVITY; n]);
    assert_eq!(history.outcome, HistoryOutcome::Completed);
    assert!(history.airborne > 0.19, "{}", history.airborne);
    let v = |i: usize| history.motion.v[i];
    let (i, step) = (100, 50);
    let second = (v(i + step) - 2.0 * v(i) + v(i - step)) / (dt * step as f64).powi(2);
    assert!((second / (0.5 * GRAVITY) - 1.0).abs() < 1e-9, "{second}");
    assert!(history.motion.theta.iter().all(|theta| theta.abs() < 1e-12));
}

/// Constant a_v = kappa g on a standing body: it presses 1 + kappa times as much, once settled
/// there.
#[test]
fn a_standing_body_presses_as_its_weight_in_the_moving_ground() {
    let body = Structure::block(2.0, 0.5, 2.4e3).unwrap().body::<f64>();
    let n = 2000;
    // slowly up to 0.7 g, then constant
    let up: Vec<f64> = (0..n).map(|i| 0.7 * GRAVITY * (i as f64 / 1000.0).min(1.0)).collect();
    let history = simulate(body, plastic(100.0, body.mass), 1e-3, &vec![0.0; n], &up);
    for foot in &history.forces.vertical {
        assert!(
            (foot[n - 1] / (0.5 * 1.7 * body.mass * GRAVITY) - 1.0).abs() < 1e-6,
            "{}",
            foot[n - 1]
        );
    }
}
