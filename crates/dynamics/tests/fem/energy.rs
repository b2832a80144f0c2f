//! The energy account closes in every run, and nothing creates energy.

use rocking::structure::Structure;
use rocking::synthetic;

use crate::common::{assert_closes, el_centro, free, lively, paper, plastic, settled, table_1};

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
                let history = settled(&structure, springs, &record);
                assert_closes(&history, &format!("{name} {hz} Hz, I_cg {share} m R^2"));
                // undamped rotation of a kHz: a long history keeps the same bound
                let long = (share, hz, name) == (1e-2, 40.0, "table 1");
                assert!(!long || history.work.steps > 50_000);
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
        for record in synthetic::suite(12, 7, body.p(), body.alpha()) {
            for springs in [plastic(stiff, body.mass), lively(stiff, body.mass)] {
                let history = settled(&structure, springs, &record);
                assert_closes(&history, &record.name);
            }
        }
    }
}
