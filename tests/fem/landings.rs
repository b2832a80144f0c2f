//! Landings of whole histories: as many impacts as Housner's, whatever the springs do in them.

use groundspring::fem::Control;

use crate::common::{el_centro, free, lively, paper, plastic, settled, table_1};

/// Housner's rigid frame has 12 impacts in the first 20 s of this record (float128 Taylor reference).
#[test]
fn stiff_springs_have_housner_s_twelve_impacts_on_el_centro() {
    let record = el_centro();
    for share in [0.0, 1e-2] {
        let structure = paper(share);
        let m = structure.mass_kg;
        for hz in [160.0, 320.0] {
            for springs in [plastic(hz, m), lively(hz, m)] {
                let history = settled(&structure, springs, &record, Control::default());
                assert_eq!(history.impacts(), 12, "{hz} Hz, {share}");
            }
        }
    }
}

#[test]
fn springs_that_rebound_bounce_and_plastic_ones_do_not() {
    let structure = paper(0.0);
    let run = |springs| free(&structure, springs, 0.05, 0.01, 1000);
    let (dead, live) = (run(plastic(160.0, structure.mass_kg)), run(table_1(160.0, structure.mass_kg)));
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
