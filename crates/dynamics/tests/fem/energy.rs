//! The energy account closes in every run, and nothing creates energy.

use dynamics::fem::{Control, History};
use rocking::structure::Structure;
use rocking::synthetic;

use crate::common::{el_centro, free, lively, paper, plastic, settled, table_1};

/// The account closes to 1e-6 of the largest energy, and dissipation never runs backwards.
fn assert_closes(history: &History, what: &str) {
    assert!(history.energy_residual < 1e-6, "{what}: residual {:e}", history.energy_residual);
    let account = &history.account;
    let largest = account.stored.iter().chain(&account.input).fold(0.0_f64, |m, e| m.max(e.abs()));
    let falls = account.dissipated.windows(2).any(|w| w[1] < w[0] - 1e-9 * largest);
    assert!(!falls, "{what}: dissipation fell");
    // what is stored beyond the start came from the ground
    let created = account.stored.iter().zip(&account.input).map(|(s, i)| s - i).fold(0.0, f64::max);
    assert!(created <= 1e-6 * largest, "{what}: {created} J created of {largest}");
}

#[test]
fn the_account_closes_on_el_centro_for_springs_soft_and_stiff() {
    let record = el_centro();
    for share in [0.0, 1e-3, 1e-2] {
        let structure = paper(share);
        for hz in [40.0, 80.0, 160.0, 320.0] {
            let m = structure.mass_kg;
            for (name, springs) in [
                ("plastic", plastic(hz, m)),
                ("lively", lively(hz, m)),
                ("table 1", table_1(hz, m)),
            ] {
                let history = settled(&structure, springs, &record, Control::default());
                assert_closes(&history, &format!("{name} {hz} Hz, I_cg {share} m R^2"));
            }
        }
    }
}

#[test]
fn the_account_closes_in_free_rocking_from_any_lean() {
    let structure = paper(1e-3);
    let alpha = structure.body::<f64>().alpha();
    for phi in [0.9, 0.5, 0.07, 0.02] {
        let history = free(&structure, plastic(160.0, structure.mass_kg), phi * alpha, 0.01, 3000);
        assert_closes(&history, &format!("free rocking from {phi} alpha"));
    }
}

#[test]
fn the_account_closes_for_blocks_and_frames_on_pulses_and_noise() {
    let structures = [
        Structure::a_frame(5.0, 1.5, 1e4).unwrap(),
        Structure::block(2.0, 0.5, 2.4e3).unwrap(),
        Structure::block(0.6, 0.2, 1.5e2).unwrap(),
    ];
    for structure in structures {
        let body = structure.body::<f64>();
        let stiff = 160.0 * (63.0 / body.radius()).sqrt();
        for record in synthetic::suite(12, 7, body.p_squared().sqrt(), body.alpha()) {
            for springs in [plastic(stiff, body.mass), lively(stiff, body.mass)] {
                let history = settled(&structure, springs, &record, Control::default());
                assert_closes(&history, &record.name);
            }
        }
    }
}

#[test]
fn a_long_history_keeps_the_same_bound() {
    // undamped rotation of a kHz: hundreds of thousands of steps
    let structure = paper(1e-2);
    let history =
        settled(&structure, table_1(40.0, structure.mass_kg), &el_centro(), Control::default());
    assert!(history.work.steps > 50_000);
    assert_closes(&history, "undamped rotation");
}
