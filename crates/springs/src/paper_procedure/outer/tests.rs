use super::*;
use rocking::{housner::history, structure::Structure};
use strong_motion::Record;

/// Soft and stiff springs. Not such as chatter (K = 9): no two sizes of steps agree on those.
fn candidates() -> Vec<Springs<Design<f64>>> {
    let unit = |mu: f64, k: f64, hz: f64| Design::from_kc(mu, k, 0.6, hz);
    let pair = |k: f64, hz: f64, times: f64| Springs {
        vertical: unit(0.3, k, hz),
        horizontal: unit(1.0, k, times * hz),
    };
    vec![pair(0.25, 160.0, 1.0), pair(0.35, 640.0, 2.0), pair(0.5, 2560.0, 4.0)]
}

/// Beside Housner's history of so many samples of a record.
fn on(record: &Record, structure: &Structure, samples: usize, judge: impl FnOnce(&Benchmark)) {
    let (body, dt, accel) = (structure.body::<f64>(), record.dt, &record.accel[..samples]);
    let housner = &history(&body, dt, accel).motion(&body);
    judge(&Benchmark { body, dt, accel, vertical: &[], housner, effort: &Effort::unbounded() });
}

/// The error of a candidate hardly depends on the steps that it is first measured with, on bodies
/// and springs that these were not chosen on: beside a tolerance of a hundredth.
#[test]
fn coarse_steps_err_by_a_few_hundredths_of_an_error_that_is_left_to_them() {
    let record = Record::el_centro().scaled(1.2).unwrap();
    for (structure, samples) in [
        (Structure::paper(), 2000),
        (Structure::a_frame(24.0, 6.0, 2e5).unwrap(), 1200),
        (Structure::block(9.0, 2.0, 5e4).unwrap(), 1200),
    ] {
        on(&record, &structure, samples, |benchmark| {
            let mut left = 0;
            for springs in candidates() {
                let fine = benchmark.judge_with(&springs, f64::INFINITY, Control::default());
                let found = benchmark.judge(&springs, f64::INFINITY);
                let first = benchmark.judge_with(&springs, f64::INFINITY, coarse());
                assert!((found.error / fine.error - 1.0).abs() < 0.03, "{found:?}, {fine:?}");
                left += usize::from(found == first);
            }
            assert!(left > 0, "all were measured again");
        });
    }
}

/// A small error is that of fine steps, to the last bit.
#[test]
fn small_errors_are_measured_again_with_fine_steps() {
    on(&Record::el_centro(), &Structure::paper(), 2000, |benchmark| {
        let springs = landing::design::springs_at_stiffness(&benchmark.body, 1e5).unwrap();
        let found = benchmark.judge(&springs, f64::INFINITY);
        assert!(found.error < CERTAIN, "{}", found.error);
        assert_eq!(found, benchmark.judge_with(&springs, f64::INFINITY, Control::search()));
    });
}

/// Side by side, whether abandoned or measured again, they are judged as alone, to the last bit.
#[test]
fn springs_are_judged_side_by_side_as_alone() {
    on(&Record::el_centro(), &Structure::paper(), 1000, |benchmark| {
        let mut all: Vec<_> = candidates().into_iter().map(|springs| (springs, 0.01)).collect();
        let stiff = landing::design::springs_at_stiffness(&benchmark.body, 1e5).unwrap();
        all.push((stiff, f64::INFINITY));
        let found = benchmark.judge_all(&all);
        for (found, (springs, limit)) in found.iter().zip(&all) {
            assert_eq!(*found, benchmark.judge(springs, *limit));
        }
        assert!(found.iter().any(|found| found.abandoned), "{found:?}");
        assert!(found.iter().any(|found| found.error < CERTAIN), "{found:?}");
    });
}
