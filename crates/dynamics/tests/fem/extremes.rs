//! Extremes of the structure and of its springs: restitution zero and one, equal chains, no
//! dashpots.

use std::{f64::consts::FRAC_PI_4, ops::ControlFlow};

use dynamics::{
    fem::{Analysis, Finish, HistoryOutcome, Start, View},
    spring::{Chain, Design, Springs},
};
use rocking::{
    housner,
    motion::{largest_magnitude, nrmse},
    structure::{Body, Structure},
};

use crate::common::{assert_sound, chains, el_centro, free, paper, plastic, settled};

/// An A-frame at alpha = 45 degrees lands along its other leg: e = cos 2 alpha = 0. On springs all
/// but 7 % of the energy goes at once (the rest swings across the leg, which no chain damps), and
/// the body stays down.
#[test]
fn a_frame_of_restitution_zero_loses_its_energy_in_the_first_landing() {
    let body = Body { mass: 1e4, half_width: 5.0, height: 5.0, inertia: 0.0 };
    assert!(body.restitution().abs() < 1e-15 && (body.alpha() - FRAC_PI_4).abs() < 1e-15);
    let (lean, accel) = (0.1, vec![0.0; 300]);
    let options = housner::released(lean, 0.0);
    let rigid = housner::solve(&body, 0.01, &accel, &options);
    let landing = rigid.impacts[0].time;
    assert!(rigid.theta[(landing / 0.01) as usize + 1..].iter().all(|theta| theta.abs() < 1e-12));
    // along the leg both chains act as one
    let ratios = (0.5, 0.1, 0.64);
    for hz in [40.0, 160.0, 640.0] {
        let (springs, start) = (chains(ratios, ratios, hz, body.mass), Start::Leaning(lean));
        let history = Analysis { start, ..Analysis::new(body, springs, 0.01, &accel) }.simulate();
        assert_sound(&history, 300);
        let first = &history.landings[0];
        assert!(first.impact && (first.time / landing - 1.0).abs() < 0.01, "{first:?} {landing}");
        assert!(first.lost > 0.93 * first.kinetic, "{hz} Hz: {first:?}");
        let at = |t: f64| &history.motion.theta[(t / 0.01) as usize..];
        assert!(largest_magnitude(at(first.time + 0.01)) < 0.07 * lean);
        assert!(largest_magnitude(at(2.0)) < 1e-6 * lean, "{hz} Hz: it rests");
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
    let history = settled(&structure, springs, &record);
    assert_sound(&history, record.accel.len());
    let body = structure.body::<f64>();
    let rigid = housner::history(&body, record.dt, &record.accel);
    let error = nrmse(&history.motion.u, &rigid.motion(&body).u);
    assert!(error < 0.05, "{error}");
    let nearly = Chain { k1: springs.horizontal.k1 * (1.0 + 1e-9), ..springs.horizontal };
    let beside = settled(&structure, Springs { horizontal: nearly, ..springs }, &record);
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
        let case = Analysis::new(structure.body(), springs, record.dt, &record.accel);
        let finish: Finish = case.observe(&mut |_: usize, view: &View| {
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
