use super::*;
use crate::RecordOutcome;

fn row(
    peaks: (f64, Option<f64>),
    overturned: (bool, Option<bool>),
    sensitivity: f64,
    error: Option<f64>,
) -> Row {
    Row {
        name: "made-up".into(),
        outcome: if peaks.1.is_none() { RecordOutcome::FemFailed } else { RecordOutcome::Rocked },
        duration_s: 20.0,
        pga_g: 0.3,
        sensitivity,
        nrmse_horizontal: error,
        nrmse_vertical: error,
        displacement_error: error,
        uplift_error: error,
        base_shear_error: error,
        axial_error: error,
        peak_ratio_housner: peaks.0,
        peak_ratio_fem: peaks.1,
        overturned_housner: overturned.0,
        overturned_fem: overturned.1,
        impacts: 3,
        energy_residual: Some(1e-7),
        suite: Suite::Files,
        well_conditioned: sensitivity < 10.0,
        moved_by_0_1_percent: 1e-3 * sensitivity,
        moved_by_1_percent: 1e-2 * sensitivity,
        moved_by_0_1_percent_of_restitution: 1e-2,
        peak_ratio_housner_changed: peaks.0,
        overturned_housner_changed: overturned.0,
        pivot_pulls_s: None,
    }
}

fn rocked(sensitivity: f64, error: f64) -> Row {
    row((0.5, Some(0.5)), (false, Some(false)), sensitivity, Some(error))
}

#[test]
fn records_of_free_flight_are_counted_and_not_compared() {
    let flight = Row { pivot_pulls_s: Some(1.0), ..rocked(1.0, 0.5) };
    let all = Validation::new(vec![rocked(1.0, 0.1), flight, rocked(1.0, 0.1)]).all;
    assert_eq!((all.pivot_pulls, all.not_comparable, all.nrmse_well_conditioned.count), (1, 1, 2));
    assert_eq!(all.nrmse_geometric_mean.count, 2);
    assert!(all.nrmse_well_conditioned.p90.is_some_and(|p90| (p90 - 0.1).abs() < 1e-15));
}

/// F_a steps by 1/4 at 1, 2, 3, 4; F_b by 1/5 at 2.5, 3.5, 3.6, 3.7, 5. At x = 2: 2/4 - 0 = 0.5; at
/// 3: 3/4 - 1/5 = 0.55; at 3.7: 3/4 - 4/5; at 4: 1 - 4/5.
#[test]
fn the_ks_distance_is_that_of_a_case_worked_by_hand() {
    let (a, b) = ([3.0, 1.0, 4.0, 2.0], [5.0, 3.7, 2.5, 3.5, 3.6]);
    assert!((ks_distance(&a, &b) - 0.55).abs() < 1e-15);
    assert_eq!(ks_distance(&a, &b), ks_distance(&b, &a));
}

#[test]
fn the_ks_distance_of_equal_samples_is_zero_and_of_separate_ones_one() {
    let toppled = f64::INFINITY;
    assert_eq!(ks_distance(&[0.2, 0.2, toppled], &[toppled, 0.2, 0.2]), 0.0);
    assert_eq!(ks_distance(&[0.1, 0.2], &[0.3, toppled]), 1.0);
    // one tie moved: a third
    assert!((ks_distance(&[0.2, 0.2, 0.9], &[0.2, 0.9, 0.9]) - 1.0 / 3.0).abs() < 1e-15);
}

#[test]
fn overturning_is_counted_in_two_by_two_and_failures_apart() {
    let flat = 8.0;
    let rows = vec![
        row((flat, Some(flat)), (true, Some(true)), 50.0, Some(0.1)),
        row((flat, Some(0.9)), (true, Some(false)), 50.0, Some(0.9)),
        row((0.9, Some(flat)), (false, Some(true)), 50.0, Some(0.9)),
        rocked(2.0, 0.01),
        row((0.5, None), (false, None), 2.0, None),
    ];
    let all = Validation::new(rows);
    assert_eq!(
        all.all.overturning,
        Confusion { both: 1, housner_only: 1, fem_only: 1, neither: 1, failed: 1 }
    );
    assert_eq!(all.all.overturning_agreement, 2.0 / 5.0);
    assert_eq!(all.all.failed, ["made-up"]);
    // Housner 0.5 0.5 0.9 8 8 against 0.5 0.9 8 8 and the failure beyond: at 0.5 and at 0.9 one in
    // five apart, at 8 too
    assert!((all.all.ks_distance - 0.2).abs() < 1e-15);
}

#[test]
fn only_well_conditioned_records_that_do_not_topple_enter_the_quantiles() {
    let mut never = rocked(0.0, 0.0);
    (never.outcome, never.nrmse_horizontal) = (RecordOutcome::NeverLifted, None);
    let rows = vec![
        rocked(2.0, 0.04),
        rocked(9.9, 0.01),
        rocked(1.0, 0.02),
        rocked(3.0, 0.03),
        rocked(10.0, 1.0),
        row((8.0, Some(8.0)), (true, Some(true)), 2.0, Some(1.0)),
        never,
    ];
    let all = Validation::new(rows);
    let found = all.all.nrmse_well_conditioned;
    // numpy.quantile([0.01, 0.02, 0.03, 0.04], [0.5, 0.9]) = 0.025, 0.037
    assert_eq!((found.count, all.all.never_lifted, all.all.not_comparable), (4, 1, 2));
    assert!(
        (found.median.unwrap() - 0.025).abs() < 1e-16 && (found.p90.unwrap() - 0.037).abs() < 1e-16
    );
}

#[test]
fn a_history_that_failed_is_an_infinite_error_and_no_number() {
    let failed = || row((0.5, None), (false, None), 2.0, None);
    let all = Validation::new(vec![rocked(1.0, 0.01), rocked(1.0, 0.02), failed()]);
    let found = all.all.nrmse_well_conditioned;
    assert_eq!((found.count, found.median, found.p90), (3, Some(0.02), None));
    let none = Validation::new(vec![]);
    assert_eq!(none.all.nrmse_well_conditioned, Quantiles { count: 0, median: None, p90: None });
}

/// exp(mean of ln): of 0.01 and 0.04, 0.02. A body that topples on its springs alone counts with 1.
#[test]
fn the_geometric_mean_is_over_predictable_records_that_topple_no_housner_body() {
    let topples_alone = row((0.9, Some(8.0)), (false, Some(true)), 50.0, Some(0.3));
    let toppled = row((8.0, Some(8.0)), (true, Some(true)), 50.0, Some(0.3));
    let failed = row((0.5, None), (false, None), 2.0, None);
    let rows = [rocked(2.0, 0.01), rocked(149.0, 0.04), rocked(150.0, 0.9), toppled, failed];
    let found = GeometricMean::new(&rows);
    assert_eq!((found.count, found.failed), (2, 1));
    assert!((found.mean.unwrap() - 0.02).abs() < 1e-15);
    let found = GeometricMean::new(&[rocked(2.0, 0.01), topples_alone]);
    assert!((found.mean.unwrap() - 0.1).abs() < 1e-15);
    assert_eq!(GeometricMean::new(&[]), GeometricMean { count: 0, mean: None, failed: 0 });
}

#[test]
fn suites_are_judged_apart_and_together() {
    let mut rows = vec![rocked(2.0, 0.04), rocked(2.0, 0.01), rocked(2.0, 0.02)];
    rows[1].suite = Suite::Earthquakes;
    rows[2].suite = Suite::Earthquakes;
    rows[2].peak_ratio_housner_changed = 0.6;
    rows[2].overturned_housner_changed = true;
    let found = Validation::new(rows);
    let suites: Vec<_> = found.suites.iter().map(|(suite, s)| (*suite, s.count)).collect();
    assert_eq!(suites, [(Suite::Files, 1), (Suite::Earthquakes, 2)]);
    let earthquakes = &found.suites[&Suite::Earthquakes];
    assert_eq!((found.all.count, earthquakes.nrmse_well_conditioned.count), (3, 2));
    assert_eq!(found.suites[&Suite::Files].ks_distance_of_housner_changed, 0.0);
    assert_eq!(earthquakes.ks_distance_of_housner_changed, 0.5);
    assert_eq!(
        (earthquakes.overturning_agreement, earthquakes.overturning_agreement_of_housner_changed),
        (1.0, 0.5)
    );
    let json = serde_json::to_value(&found).unwrap();
    assert!(
        json["ks_distance"].is_f64()
            && json["suites"]["earthquakes"]["nrmse_geometric_mean"]["mean"].is_f64()
    );
}

/// A record that never lifts Housner's body is none of those that lift it, though the history on
/// springs fails.
#[test]
fn a_failed_history_of_a_body_that_is_never_lifted_is_not_of_the_geometric_mean() {
    let failed = |peak: f64| row((peak, None), (false, None), 0.0, None);
    let mean = |peak| GeometricMean::new([&failed(peak)]);
    assert_eq!(mean(0.0), GeometricMean { count: 0, mean: None, failed: 0 });
    assert_eq!(mean(0.2), GeometricMean { count: 0, mean: None, failed: 1 });
}
