//! What must hold for any bytes whatever: no panic, no hang, an answer that is checked or an error
//! of one clear line.
//!
//! Shared by the fuzz targets and by `tests/fuzz_corpus.rs`, which replays the corpus on every
//! `cargo test`.

#![allow(dead_code)] // each target uses its own check

use std::path::Path;

use cases::Case;
use dynamics::fem;
use parameters::Parameters;
use rocking::housner::{self, RockingOptions};
use strong_motion::{ReadOptions, Record, Recording, Units};

/// An error's message is one line a user can read.
fn clear(error: &dyn std::error::Error) {
    let message = error.to_string();
    assert!(!message.is_empty() && message.chars().count() < 700, "{message}");
    assert!(!message.chars().any(char::is_control), "{message:?}");
}

/// What every reader promises of a record.
fn checked(record: &Record) {
    assert!((1e-6..=1.0).contains(&record.dt), "dt {}", record.dt);
    assert!(!record.is_empty() && record.accel.iter().all(|a| a.is_finite()));
    assert!(record.pga_g() <= 50.0, "{} g", record.pga_g());
}

/// A record file under every combination of what a user may say of it. What was read, written as
/// columns and as AT2, is read as the same.
pub fn record(bytes: &[u8]) {
    for name in ["a.at2", "a.txt"] {
        for (dt, units) in [
            (None, None),
            (None, Some(Units::G)),
            (Some(0.01), Some(Units::MetrePerSecond2)),
            (Some(0.02), None),
            (Some(1e-6), Some(Units::CentimetrePerSecond2)),
        ] {
            match Recording::parse(
                name,
                bytes,
                &ReadOptions { dt, units, ..ReadOptions::default() },
            ) {
                Ok(recording) => {
                    whole(&recording, bytes);
                    read_again(&recording.into_record());
                }
                Err(error) => clear(&error),
            }
        }
    }
}

/// Every component is a record, and can be asked for where its name is its own.
fn whole(recording: &Recording, bytes: &[u8]) {
    for notice in recording.notices() {
        let notice = notice.to_string();
        assert!(!notice.is_empty() && !notice.chars().any(char::is_control), "{notice:?}");
    }
    for component in &recording.components {
        checked(&component.record);
        let m = strong_motion::measures(&component.record);
        assert!(
            [m.pga.value, m.pgv.value, m.arias_m_per_s, m.duration_5_95_s]
                .iter()
                .all(|x| x.is_finite()),
            "{m:?}"
        );
        let options = ReadOptions {
            component: component.name.clone(),
            baseline: true,
            ..ReadOptions::default()
        };
        if let Err(error) = Recording::parse("a.txt", bytes, &options) {
            clear(&error);
        }
    }
}

fn read_again(record: &Record) {
    let (n, dt) = (record.len(), record.dt);
    let samples: Vec<String> = record.accel.iter().map(|a| format!("{a:e}")).collect();
    let at2 = format!(
        "ACCELERATION IN UNITS OF M/S/S\nNPTS= {n}, DT= {dt:e} SEC\n{}\n",
        samples.join(" ")
    );
    let columns = format!("# acceleration (m/s2), dt = {dt:e} s\n{}\n", samples.join("\n"));
    for (name, text) in [("b.at2", at2), ("b.txt", columns)] {
        let again = Record::parse(name, text.as_bytes(), &ReadOptions::default());
        let again = again.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((again.dt, &again.accel), (record.dt, &record.accel), "{name}");
    }
}

/// A case file; the record it names is not looked for on the disk.
pub fn case(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let no_file = |path: &Path, options: &ReadOptions| {
        assert!(!path.as_os_str().is_empty());
        Record::parse("motion.txt", b"0.1\n0.3\n-0.2\n", options)
    };
    let case: Result<Case, _> =
        cases::parse_with("case.toml", text, &ReadOptions::default(), no_file);
    match case {
        Ok(case) => {
            checked(&case.record);
            assert!(case.structure.checked().is_ok());
            assert!((0.0..=1.0).contains(&case.restitution) && case.duration_s > 0.0);
            assert!(case.tuning.max_omega_hz.is_none_or(|hz| (0.1..=1e6).contains(&hz)));
        }
        Err(error) => clear(&error),
    }
}

/// A parameter file, and a short history with what it holds: finite, or a said outcome.
pub fn parameters(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let parameters = match Parameters::parse("parameters.json", text) {
        Ok(parameters) => parameters,
        Err(error) => return clear(&error),
    };
    let again = Parameters::parse("again.json", &parameters.to_json())
        .unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.chains(), parameters.chains());

    let body = parameters.structure.body::<f64>();
    let accel: Vec<f64> = (0..40).map(|i| 6.0 * (0.4 * f64::from(i)).sin()).collect();
    let rocking = housner::solve(
        &body,
        0.01,
        &accel,
        &RockingOptions { max_work: 1000, ..RockingOptions::default() },
    );
    assert!(rocking.theta.iter().all(|theta| theta.is_finite()));
    let case = fem::Analysis {
        control: fem::Control { most_steps: 1000, ..fem::Control::default() },
        ..fem::Analysis::new(body, parameters.chains(), 0.01, &accel)
    };
    let history = case.simulate();
    let motion = &history.motion;
    assert!(
        [&motion.u, &motion.v, &motion.theta].into_iter().flatten().all(|x| x.is_finite()),
        "{:?}",
        history.outcome
    );
    assert!(history.energy_residual < 1e-6, "{:e} {:?}", history.energy_residual, history.outcome);
}
