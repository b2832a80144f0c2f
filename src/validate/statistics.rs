//! What many records say together.

use serde::Serialize;

use super::Row;

/// Overturning in both models, in records.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Confusion {
    pub both: usize,
    pub housner_only: usize,
    pub fem_only: usize,
    pub neither: usize,
    /// A model failed: neither agreement nor a known disagreement, and counted as the latter.
    pub failed: usize,
}

impl Confusion {
    fn new(rows: &[Row]) -> Self {
        let mut table = Self::default();
        for row in rows {
            *match (row.overturned_housner, row.overturned_fem) {
                _ if row.failed() => &mut table.failed,
                (true, Some(true)) => &mut table.both,
                (true, _) => &mut table.housner_only,
                (false, Some(true)) => &mut table.fem_only,
                (false, _) => &mut table.neither,
            } += 1;
        }
        table
    }
}

/// Quantiles of the NRMSE of the comparable records.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quantiles {
    /// How many records are comparable.
    pub count: usize,
    /// None if there is no record, or if the quantile falls on a history that failed.
    pub median: Option<f64>,
    /// 90 % of the records are below it.
    pub p90: Option<f64>,
}

impl Quantiles {
    /// Of all comparable rows; a missing error counts as infinite.
    fn new(rows: &[Row], error: fn(&Row) -> Option<f64>) -> Self {
        let comparable = rows.iter().filter(|row| row.comparable());
        let mut errors: Vec<f64> = comparable.map(|row| error(row).unwrap_or(f64::INFINITY)).collect();
        errors.sort_by(f64::total_cmp);
        Self { count: errors.len(), median: quantile(&errors, 0.5), p90: quantile(&errors, 0.9) }
    }
}

/// The q-quantile of sorted numbers, linear between the two nearest ranks (Hyndman and Fan 1996, definition 7).
fn quantile(sorted: &[f64], q: f64) -> Option<f64> {
    let rank = q * sorted.len().checked_sub(1)? as f64;
    let (low, share) = (rank.floor() as usize, rank.fract());
    let x = sorted[low];
    let x = if share == 0.0 { x } else { x + share * (sorted[low + 1] - x) };
    x.is_finite().then_some(x)
}

/// Two-sample Kolmogorov-Smirnov distance: the largest difference of the two empirical distributions; ties are one step.
pub fn ks_distance(a: &[f64], b: &[f64]) -> f64 {
    if a.is_empty() || b.is_empty() {
        return 0.0;
    }
    let sorted = |x: &[f64]| {
        let mut x = x.to_vec();
        x.sort_by(f64::total_cmp);
        x
    };
    let (a, b) = (sorted(a), sorted(b));
    let (mut i, mut j, mut widest) = (0, 0, 0.0_f64);
    while i < a.len() && j < b.len() {
        let x = a[i].min(b[j]);
        i += a[i..].iter().take_while(|y| **y <= x).count();
        j += b[j..].iter().take_while(|y| **y <= x).count();
        widest = widest.max((i as f64 / a.len() as f64 - j as f64 / b.len() as f64).abs());
    }
    widest
}

/// All records, and what they say together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Validation {
    /// Kolmogorov-Smirnov distance of the peak ratios, all records.
    pub ks_distance: f64,
    /// Share of the records on whose overturning both models agree; a failure is a disagreement.
    pub overturning_agreement: f64,
    pub overturning: Confusion,
    /// NRMSE of u over the comparable records.
    pub nrmse_well_conditioned: Quantiles,
    /// NRMSE of v over the same records.
    pub nrmse_vertical_well_conditioned: Quantiles,
    /// Records that never lift Housner's body.
    pub never_lifted: usize,
    /// Records whose histories cannot be compared: toppled, or with a sensitivity of 10 and more.
    pub not_comparable: usize,
    /// Names of the records in which a model failed.
    pub failed: Vec<String>,
    /// Largest energy residual of all finite element histories.
    pub energy_residual_max: f64,
    pub records: Vec<Row>,
}

impl Validation {
    /// From the rows of all records.
    pub fn new(records: Vec<Row>) -> Self {
        let (housner, fem): (Vec<f64>, Vec<f64>) = records.iter().map(peaks).unzip();
        let never_lifted = records.iter().filter(|row| row.outcome == super::Outcome::NeverLifted).count();
        let comparable = records.iter().filter(|row| row.comparable()).count();
        let agreeing = records.iter().filter(|row| row.agrees()).count();
        Self {
            ks_distance: ks_distance(&housner, &fem),
            overturning_agreement: agreeing as f64 / records.len().max(1) as f64,
            overturning: Confusion::new(&records),
            nrmse_well_conditioned: Quantiles::new(&records, |row| row.nrmse_horizontal),
            nrmse_vertical_well_conditioned: Quantiles::new(&records, |row| row.nrmse_vertical),
            never_lifted,
            not_comparable: records.len() - comparable - never_lifted,
            failed: records.iter().filter(|row| row.failed()).map(|row| row.name.clone()).collect(),
            energy_residual_max: records.iter().map(|row| row.energy_residual).fold(0.0, f64::max),
            records,
        }
    }
}

/// Both peak ratios; a failed history's stands at the other end of the scale than Housner's.
fn peaks(row: &Row) -> (f64, f64) {
    // pi/2 / alpha is more than 1, and what a toppled body has at least whatever alpha
    let other_end = if row.overturned_housner { 0.0 } else { f64::INFINITY };
    let fem = row.peak_ratio_fem.filter(|_| !row.failed()).unwrap_or(other_end);
    (row.peak_ratio_housner, fem)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validate::Outcome;

    fn row(peaks: (f64, Option<f64>), overturned: (bool, Option<bool>), sensitivity: f64, error: Option<f64>) -> Row {
        Row {
            name: "made-up".into(),
            outcome: if peaks.1.is_none() { Outcome::FemFailed } else { Outcome::Rocked },
            duration_s: 20.0,
            pga_g: 0.3,
            sensitivity,
            nrmse_horizontal: error,
            nrmse_vertical: error,
            peak_ratio_housner: peaks.0,
            peak_ratio_fem: peaks.1,
            overturned_housner: overturned.0,
            overturned_fem: overturned.1,
            impacts: 3,
            energy_residual: 1e-7,
        }
    }

    fn rocked(sensitivity: f64, error: f64) -> Row {
        row((0.5, Some(0.5)), (false, Some(false)), sensitivity, Some(error))
    }

    /// F_a steps by 1/4 at 1, 2, 3, 4; F_b by 1/5 at 2.5, 3.5, 3.6, 3.7, 5. At x = 2: 2/4 - 0 = 0.5; at 3: 3/4 - 1/5 = 0.55;
    /// at 3.7: 3/4 - 4/5; at 4: 1 - 4/5.
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
        assert_eq!(all.overturning, Confusion { both: 1, housner_only: 1, fem_only: 1, neither: 1, failed: 1 });
        assert_eq!(all.overturning_agreement, 2.0 / 5.0);
        assert_eq!(all.failed, ["made-up"]);
        // Housner 0.5 0.5 0.9 8 8 against 0.5 0.9 8 8 and the failure beyond: at 0.5 and at 0.9 one in five apart, at 8 too
        assert!((all.ks_distance - 0.2).abs() < 1e-15);
    }

    #[test]
    fn only_well_conditioned_records_that_do_not_topple_enter_the_quantiles() {
        let mut never = rocked(0.0, 0.0);
        (never.outcome, never.nrmse_horizontal) = (Outcome::NeverLifted, None);
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
        let found = all.nrmse_well_conditioned;
        // numpy.quantile([0.01, 0.02, 0.03, 0.04], [0.5, 0.9]) = 0.025, 0.037
        assert_eq!((found.count, all.never_lifted, all.not_comparable), (4, 1, 2));
        assert!((found.median.unwrap() - 0.025).abs() < 1e-16 && (found.p90.unwrap() - 0.037).abs() < 1e-16);
    }

    #[test]
    fn a_history_that_failed_is_an_infinite_error_and_no_number() {
        let failed = || row((0.5, None), (false, None), 2.0, None);
        let all = Validation::new(vec![rocked(1.0, 0.01), rocked(1.0, 0.02), failed()]);
        let found = all.nrmse_well_conditioned;
        assert_eq!((found.count, found.median, found.p90), (3, Some(0.02), None));
        let none = Validation::new(vec![]);
        assert_eq!(none.nrmse_well_conditioned, Quantiles { count: 0, median: None, p90: None });
    }
}
