//! The same case mirrored, shifted in time, in other units, scaled by similarity: the same answer.

use rocking::housner::{history, solve};
use rocking::structure::Structure;
use strong_motion::{ReadOptions, Record};

use super::{block, scaled};

#[test]
fn a_mirrored_record_gives_the_mirrored_history_bit_for_bit() {
    let body = block(3.0, 0.7);
    let accel = Record::el_centro().accel;
    let mirrored: Vec<f64> = accel.iter().map(|a| -a).collect();
    let here = history(&body, 0.01, &accel);
    let there = history(&body, 0.01, &mirrored);
    assert!(here.impacts.len() > 10, "{} {:?}", here.impacts.len(), here.outcome);
    assert_eq!(here.impacts.len(), there.impacts.len());
    assert!(here.theta.iter().zip(&there.theta).all(|(a, b)| *a == -*b));
}

#[test]
fn quiet_samples_before_a_record_only_shift_the_history() {
    let body = block(3.0, 0.7);
    let accel = Record::el_centro().accel;
    let mut shifted = vec![0.0; 137];
    shifted.extend_from_slice(&accel);
    let here = history(&body, 0.01, &accel);
    let there = history(&body, 0.01, &shifted);
    assert_eq!(here.theta[..], there.theta[137..]);
    assert!(there.theta[..137].iter().all(|theta| *theta == 0.0));
}

/// Lengths times 4, time times 2: powers of two, so that nothing but the rounding of trigonometry
/// could differ.
#[test]
fn a_similar_body_on_a_similar_record_has_the_same_angles() {
    let accel = Record::el_centro().accel;
    let small = history(&block(3.0, 0.7), 0.01, &accel);
    let large = history(&Structure::block(12.0, 2.8, 64.0).unwrap().body::<f64>(), 0.02, &accel);
    assert_eq!(small.impacts.len(), large.impacts.len());
    for (a, b) in small.theta.iter().zip(&large.theta) {
        assert!((a - b).abs() < 1e-13);
    }
}

#[test]
fn a_record_file_in_g_or_centimetres_gives_the_same_history() {
    let body = block(3.0, 0.7);
    let record = Record::el_centro();
    let one = history(&body, record.dt, &record.accel);
    for (header, unit) in [("g", 9.81), ("m/s2", 1.0), ("cm/s2", 0.01)] {
        let numbers: Vec<String> = record.accel.iter().map(|a| format!("{:e}", a / unit)).collect();
        let text = format!("# acceleration ({header}), dt = 0.01 s\n{}\n", numbers.join("\n"));
        let read = Record::parse("a.txt", text.as_bytes(), &ReadOptions::default()).unwrap();
        let other = history(&body, read.dt, &read.accel);
        assert_eq!(one.impacts.len(), other.impacts.len());
        assert!(one.theta.iter().zip(&other.theta).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}

/// Mass and inertia only enter as their ratio.
#[test]
fn a_mass_in_tonnes_gives_the_same_history() {
    let accel = Record::el_centro().accel;
    let run =
        |mass| history(&Structure::block(3.0, 0.7, mass).unwrap().body::<f64>(), 0.01, &accel);
    let (kilograms, tonnes) = (run(2500.0), run(2.5));
    assert_eq!(kilograms.impacts.len(), tonnes.impacts.len());
    assert!(kilograms.theta.iter().zip(&tonnes.theta).all(|(a, b)| (a - b).abs() < 1e-12));
}

/// Resampling a piecewise linear record changes nothing but where the steps end.
#[test]
fn a_record_sampled_four_times_finer_gives_the_same_history() {
    let body = block(0.6, 0.12);
    let coarse: Vec<f64> = Record::el_centro().accel.into_iter().take(700).collect();
    let fine: Vec<f64> = coarse
        .windows(2)
        .flat_map(|pair| [0.0, 0.25, 0.5, 0.75].map(|x| pair[0] + (pair[1] - pair[0]) * x))
        .chain(coarse.last().copied())
        .collect();
    // 0.04 s: p dt = 0.2
    let there = solve(&body, 0.04, &coarse, &scaled(0.68));
    let here = solve(&body, 0.01, &fine, &scaled(0.68));
    assert!(here.impacts.len() > 10, "{} {:?}", here.impacts.len(), here.outcome);
    for (a, b) in there.theta.iter().zip(here.theta.iter().step_by(4)) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}
