//! Histories by another program (.ci/elastic.py says which, and how each file was made), at every
//! fifth sample.

use std::path::Path;

use frames::{
    Mechanics, Pier,
    reference::{ElasticRocking, GroundAcceleration, PerturbedPair, ReferenceOptions, growth},
};
use nalgebra::DVector;
use strong_motion::Record;

use crate::piers::{free_rocking, light, shaken, tight};

/// Samples between rows.
const EVERY: usize = 5;
/// Error allowed, of the peak, where perturbations have grown by less than [`GROWN`].
const SHARE: f64 = 1e-6;
const GROWN: f64 = 1e4;

/// (theta, u) of a file.
fn rows(name: &str) -> Vec<[f64; 2]> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/elastic/data")
        .join(name)
        .with_extension("csv");
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader
        .deserialize()
        .map(|row| row.unwrap())
        .map(|(_, theta, u): (f64, f64, f64)| [theta, u])
        .collect()
}

/// Equal to [`SHARE`] of the peaks in the first `samples`; at least so many seconds of it.
fn assert_equal(history: &ElasticRocking, name: &str, samples: usize, seconds: f64) {
    let rows = rows(name);
    let compared = samples.div_ceil(EVERY).min(rows.len());
    assert!(
        ((compared - 1) * EVERY) as f64 * 0.01 >= seconds - 1e-9,
        "{name}: {compared} rows of {}",
        rows.len()
    );
    for k in 0..2 {
        let peak = rows.iter().fold(0.0, |peak: f64, row| peak.max(row[k].abs()));
        let error =
            |(i, row): (usize, &[f64; 2])| (history.q[EVERY * i][2 + k] - row[k]).abs() / peak;
        let worst = rows[..compared].iter().enumerate().map(error).fold(0.0, f64::max);
        println!("{name}: {worst:.1e} over {compared} rows");
        assert!(worst < SHARE, "{name}: {worst}");
    }
}

fn axial() -> Pier {
    light().with_axial(4e9, 0.02)
}

#[test]
fn free_rocking_with_axial_stiffness_a_chord_and_without_hops() {
    let held_down = ReferenceOptions { hop: false, ..tight() };
    for (name, pier, options) in [
        ("free_axial", axial(), tight()),
        ("free_chord", axial().with_chord(12.0), tight()),
        ("free_bilateral", light(), held_down),
    ] {
        assert_equal(&free_rocking(&pier, 0.0975, 5.0, &options), name, 501, 5.0);
    }
}

#[test]
fn el_centro() {
    let accel = Record::el_centro().accel;
    let held_down = ReferenceOptions { hop: false, ..tight() };
    let soft = Pier::new([6e5, 12.0, 2.0], [1.5, 0.02], [6e4, 0.75]);
    for (name, pier, options) in [
        ("el_centro", light(), tight()),
        ("el_centro_axial", axial(), tight()),
        ("el_centro_chord", axial().with_chord(12.0), tight()),
        ("el_centro_bilateral", light(), held_down),
        ("el_centro_soft", soft, tight()),
    ] {
        let (q, v) = (pier.leaning(0.0), DVector::zeros(pier.size()));
        let options = ReferenceOptions { duration: Some(8.0), ..options };
        let history = shaken(&pier, &accel, 8.0, &options);
        let ground = GroundAcceleration::horizontal(0.01, &accel);
        let grown = growth(
            &pier,
            ground,
            (&q, &v),
            &options,
            (
                &history,
                &PerturbedPair { coordinates: &[2, 3], perturbation: 1e-6, limit: f64::INFINITY },
            ),
        );
        println!("{name}: growth {:.0} in 8 s", grown.last());
        assert_equal(&history, name, grown.samples_below(GROWN), 6.0);
    }
}
