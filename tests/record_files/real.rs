//! Real files: every component has the peak and the time that its header gives.
//!
//! The files that may not be distributed are looked for in `../shared` beside the repository; the
//! tests on them are left out where that folder is absent.

use std::path::{Path, PathBuf};

use strong_motion::{Direction, ReadOptions, RecordFormat, Recording};

/// What a header says of a component: direction, PGA (m/s2) and its time (s).
type Header = (Direction, f64, Option<f64>);

fn committed(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/records").join(name)
}

fn shared(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/records/formats").join(name);
    path.exists().then_some(path)
}

/// Read a file and compare its components with the printed header; `digit` is half of the last
/// digit there (m/s2).
fn check(
    path: &Path,
    format: RecordFormat,
    dt: f64,
    headers: &[Header],
    samples: &[usize],
    digit: f64,
) -> Recording {
    let recording =
        Recording::read(path, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((recording.format, recording.components.len()), (format, headers.len()));
    for ((component, header), samples) in recording.components.iter().zip(headers).zip(samples) {
        let (direction, value, time) = *header;
        assert_eq!(component.direction, direction);
        let record = &component.record;
        assert!(
            (record.dt - dt).abs() < 1e-12 && record.len() == *samples,
            "{} {}",
            record.dt,
            record.len()
        );
        assert!(
            (record.pga() - value.abs()).abs() <= digit * (1.0 + 1e-9),
            "{} {value}",
            record.pga()
        );
        if let Some(time) = time {
            let at = (0..record.len())
                .find(|&i| (record.accel[i] - value).abs() <= digit * (1.0 + 1e-9))
                .unwrap();
            assert!((component.start + at as f64 * dt - time).abs() <= dt, "{at} {time}");
        }
    }
    recording
}

#[test]
fn kaikoura_at_te_mara_farm() {
    use Direction::{Azimuth, Vertical};
    let headers = [
        (Azimuth(332.0), -9.7331, Some(44.88)),
        (Azimuth(242.0), 7.9664, Some(45.96)),
        (Vertical, 18.0219, Some(44.14)),
    ];
    let path = committed("20161113_110259_WTMC_20.V2A");
    let recording = check(&path, RecordFormat::GeoNet, 0.02, &headers, &[8192; 3], 5e-5);
    assert_eq!(recording.station.as_deref(), Some("WTMC Te Mara Farm Waiau"));
    let velocity: Vec<f64> =
        recording.components.iter().map(|c| c.header_pgv.unwrap().value).collect();
    assert_eq!(velocity, [-1.01655, 0.68643, -0.39493]);
    // 0.99 g of the northern component against 0.81 g
    let record = recording.into_record();
    assert_eq!(record.name, "20161113_110259_WTMC_20 N28W");
    // the velocity by integration has the peak that GeoNet printed, to what its filter and the mean
    // make
    let pgv = strong_motion::measures(&record).pgv;
    assert!((pgv.value + 1.01655).abs() < 0.01 * 1.01655, "{pgv:?}");
    assert!((pgv.time.unwrap() - 5.0 - 46.58).abs() < 0.03, "{pgv:?}");
}

#[test]
fn a_small_earthquake_at_waipawa() {
    use Direction::{Azimuth, Vertical};
    let headers = [
        (Azimuth(196.0), -0.0416, Some(43.68)),
        (Azimuth(106.0), -0.1940, Some(43.66)),
        (Vertical, -0.0273, Some(40.36)),
    ];
    let path = committed("20180212_211557_WPWS_20.V2A");
    let recording = check(&path, RecordFormat::GeoNet, 0.02, &headers, &[5800; 3], 5e-5);
    assert_eq!(recording.taken, 1);
}

#[test]
fn a_cosmos_file_of_the_vertical_at_bremner_river() {
    let Some(path) = shared("us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c") else { return };
    let headers = [(Direction::Vertical, -0.06851512, Some(76.215))];
    check(&path, RecordFormat::Cosmos, 0.005, &headers, &[42000], 5e-9);
}

#[test]
fn a_csmip_file_of_three_channels() {
    use Direction::{Azimuth, Vertical};
    let Some(path) = shared("CIWLT.V2") else { return };
    let headers = [
        (Azimuth(90.0), 0.82584, Some(14.84)),
        (Azimuth(0.0), -1.15845, Some(14.52)),
        (Vertical, 0.69662, Some(12.06)),
    ];
    let recording = check(&path, RecordFormat::Csmip, 0.02, &headers, &[15050, 15029, 15050], 5e-6);
    let velocity: Vec<f64> =
        recording.components.iter().map(|c| c.header_pgv.unwrap().value).collect();
    for (found, printed) in velocity.iter().zip([-6.863, -8.141, -5.845]) {
        assert!((found - 0.01 * printed).abs() < 1e-12);
    }
    assert_eq!(recording.taken, 1);
}

#[test]
fn an_afad_file() {
    let Some(path) = shared("20101114230825_3104_ap_RawAcc_E.asc") else { return };
    let headers = [(Direction::Azimuth(90.0), 0.01632, None)];
    check(&path, RecordFormat::Dyna, 0.01, &headers, &[5600], 5e-6);
}
