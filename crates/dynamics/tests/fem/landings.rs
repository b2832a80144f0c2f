//! Landings of whole histories: as many impacts as Housner's, whatever the springs do in them.

use dynamics::compare::Match;
use rocking::{housner, structure::Structure};

use crate::common::{chains, el_centro, free, lively, paper, plastic, settled, table_1};

/// Housner's rigid frame has 12 impacts in the first 20 s of this record (float128 Taylor
/// reference).
#[test]
fn stiff_springs_have_housner_s_twelve_impacts_on_el_centro() {
    let record = el_centro();
    for share in [0.0, 1e-2] {
        let structure = paper(share);
        let m = structure.mass_kg;
        for hz in [160.0, 320.0] {
            for springs in [plastic(hz, m), lively(hz, m)] {
                let history = settled(&structure, springs, &record);
                assert_eq!(history.impacts(), 12, "{hz} Hz, {share}");
            }
        }
    }
}

#[test]
fn springs_that_rebound_bounce_and_plastic_ones_do_not() {
    let structure = paper(0.0);
    let run = |springs| free(&structure, springs, 0.05, 0.01, 1000);
    let (dead, live) =
        (run(plastic(160.0, structure.mass_kg)), run(table_1(160.0, structure.mass_kg)));
    assert_eq!((dead.bounces(), dead.airborne), (0, 0.0));
    assert!(live.bounces() > 3 && live.airborne > 0.1, "{} {}", live.bounces(), live.airborne);
}

#[test]
fn losses_of_the_impacts_add_up_to_all_that_was_lost_since_the_first() {
    let structure = paper(0.0);
    let history = free(&structure, plastic(160.0, structure.mass_kg), 0.05, 0.01, 6000);
    let impacts: Vec<_> = history.landings.iter().filter(|l| l.impact).collect();
    assert!(impacts.len() > 5);
    assert!(impacts.windows(2).all(|w| w[0].foot != w[1].foot), "rocking changes feet");
    let before = history.account.dissipated[(impacts[0].time / 0.01) as usize];
    let lost: f64 = impacts.iter().map(|l| l.lost).sum();
    let all = history.account.dissipated.last().unwrap() - before;
    assert!((lost / all - 1.0).abs() < 1e-6, "{lost} {all}");
}

/// Shaken hard, a small block leans for less time than it would rock by itself: 18 ms here, between
/// two landings.
#[test]
fn every_firm_landing_of_a_block_shaken_hard_loses_what_housner_s_does() {
    let structure = Structure::block(0.6, 0.2, 100.0).unwrap();
    let springs = chains((0.70265, 0.12858, 0.82828), (0.05404, 0.46478, 0.18445), 640.0, 100.0);
    let mut record = el_centro();
    record.accel.iter_mut().for_each(|a| *a *= 1.5);
    let history = settled(&structure, springs, &record);
    let short: Vec<_> =
        history.landings.iter().filter(|l| l.impact && (4.67..4.70).contains(&l.time)).collect();
    assert_eq!(short.iter().map(|l| l.foot).collect::<Vec<_>>(), [0, 1], "{short:?}");
    let body = structure.body::<f64>();
    let rocking = housner::history(&body, record.dt, &record.accel);
    let housner = (&rocking.motion(&body), &rocking.impacts[..]);
    let found = Match::new(&body, record.dt, housner, &history, body.restitution());
    // the least lean is a share of alpha; gentler landings lose more to the elastic stance
    let firm = found.restitution_error_firm.unwrap();
    assert!(firm < 1e-3, "{found:?}");
    assert!(found.restitution_error_max > firm, "{found:?}");
    let weak: Vec<f64> = record.accel.iter().map(|a| 0.01 * a).collect();
    record.accel = weak;
    let still = settled(&structure, springs, &record);
    assert_eq!(
        Match::new(&body, record.dt, housner, &still, body.restitution()).restitution_error_firm,
        None
    );
}
