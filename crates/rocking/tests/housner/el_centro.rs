//! The paper's A-frame on El Centro, against float128 values of an independent Taylor program
//! (degree 26).

use rocking::housner::{RockingOutcome, solve};
use rocking::motion::peak;
use rocking::structure::Structure;

use strong_motion::Record;

use super::twenty_seconds;

fn el_centro() -> Vec<f64> {
    Record::el_centro().accel
}

#[test]
fn peaks_of_the_first_20_s_agree_with_float128_to_1e_10_m() {
    let body = Structure::paper().body();
    let rocking = solve(&body, 0.01, &el_centro(), &twenty_seconds());
    let motion = rocking.motion(&body);
    let max = motion.u.iter().copied().fold(0.0, f64::max);
    let min = motion.u.iter().copied().fold(0.0, f64::min);
    println!("{:.12e} {:.12e}", max - 0.35908856534, min + 0.401181622959);
    assert!((max - 0.35908856534).abs() < 1e-10, "{max}");
    assert!((min + 0.401181622959).abs() < 1e-10, "{min}");
    assert_eq!(rocking.impacts.len(), 12);
    assert_eq!(rocking.theta.len(), 2001);
    assert_eq!(rocking.outcome, RockingOutcome::Rocked);
    assert!((peak(&motion.v) - 0.0388).abs() < 5e-5);
}

#[test]
fn the_first_uplift_is_where_the_record_passes_g_tan_alpha() {
    let body = Structure::paper().body::<f64>();
    let accel = el_centro();
    let uplift = solve(&body, 0.01, &accel, &twenty_seconds()).uplifts[0];
    let limit = 9.81 * 6.1 / 61.0;
    let i = (uplift.time / 0.01) as usize;
    let there = accel[i] + (accel[i + 1] - accel[i]) * (uplift.time / 0.01 - i as f64);
    assert!((there.abs() - limit).abs() < 1e-12 * limit);
    assert!(accel[..=i].iter().all(|a| a.abs() <= limit));
    assert_eq!(uplift.side, -there.signum());
}
