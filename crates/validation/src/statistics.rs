//! What many records say together.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{Row, Suite};
use rocking::statistics::{ks_distance, quantile};

/// Overturning in both models, in records.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Confusion {
    /// Records that overturn both models.
    pub both: usize,
    /// Records that overturn Housner's body alone.
    pub housner_only: usize,
    /// Records that overturn the finite elements alone.
    pub fem_only: usize,
    /// Records that overturn neither.
    pub neither: usize,
    /// Records in which a model failed: neither agreement nor a known disagreement, and counted as
    /// the latter.
    pub failed: usize,
}

impl Confusion {
    fn new(rows: &[&Row]) -> Self {
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
    /// The median; none if there is no record, or if it falls on a history that failed.
    pub median: Option<f64>,
    /// What 90 % of the records are below; none if there is no record, or if it falls on a history
    /// that failed.
    pub p90: Option<f64>,
}

impl Quantiles {
    /// Of all comparable rows; a missing error counts as infinite.
    fn new(rows: &[&Row], nrmse: fn(&Row) -> Option<f64>) -> Self {
        let comparable = rows.iter().filter(|row| row.comparable());
        let mut errors: Vec<f64> =
            comparable.map(|row| row.error(nrmse(row)).unwrap_or(f64::INFINITY)).collect();
        errors.sort_by(f64::total_cmp);
        let at = |q: f64| quantile(&errors, q).filter(|x| x.is_finite());
        Self { count: errors.len(), median: at(0.5), p90: at(0.9) }
    }
}

/// Sensitivity below which a history enters the geometric mean: such histories can be compared
/// statistically, though not one to one.
pub const PREDICTABLE: f64 = 150.0;

/// The geometric mean of the NRMSE of u over records with a sensitivity below 150 that lift
/// Housner's body and neither topple it nor ask its pivot to pull.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GeometricMean {
    /// How many such records the mean is over.
    pub count: usize,
    /// The geometric mean; none if there are no such records. A body that topples on its springs
    /// alone counts with 1 at least.
    pub mean: Option<f64>,
    /// How many more there are in which a history failed.
    pub failed: usize,
}

impl GeometricMean {
    /// Of all such rows.
    pub(crate) fn new<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Self {
        Self::by(rows, |row| row.nrmse_horizontal)
    }

    /// The same of another error.
    fn by<'a>(rows: impl IntoIterator<Item = &'a Row>, error: fn(&Row) -> Option<f64>) -> Self {
        let errors: Vec<_> = rows
            .into_iter()
            .filter(|row| row.rocked() && row.sensitivity < PREDICTABLE)
            .map(|row| row.error(error(row)))
            .collect();
        let found: Vec<f64> =
            errors.iter().flatten().map(|error| error.max(f64::MIN_POSITIVE).ln()).collect();
        let mean =
            (!found.is_empty()).then(|| (found.iter().sum::<f64>() / found.len() as f64).exp());
        Self { count: found.len(), mean, failed: errors.len() - found.len() }
    }
}

/// What a set of records says together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Records in the set.
    pub count: usize,
    /// Kolmogorov-Smirnov distance of the peak ratios, all records.
    pub ks_distance: f64,
    /// Kolmogorov-Smirnov distance of Housner's peak ratios from his own with a restitution smaller
    /// by 1e-5: less than this no model can show.
    pub ks_distance_of_housner_changed: f64,
    /// Share of the records on whose overturning both models agree; a failure is a disagreement.
    pub overturning_agreement: f64,
    /// Share of the records on whose overturning Housner's body agrees with his own of a
    /// restitution smaller by 1e-5: more than this no model can show but by chance.
    pub overturning_agreement_of_housner_changed: f64,
    /// Overturning in both models.
    pub overturning: Confusion,
    /// NRMSE of u over the comparable records ([`Row::comparable`]).
    pub nrmse_well_conditioned: Quantiles,
    /// NRMSE of v over the comparable records.
    pub nrmse_vertical_well_conditioned: Quantiles,
    /// Relative error of the largest displacement, uplift, base shear and axial force, the worst of
    /// those that are compared, over the comparable records.
    pub peaks_well_conditioned: Quantiles,
    /// Geometric mean of the NRMSE of u over the records that [`GeometricMean`] names: a
    /// sensitivity below 150, Housner's body lifts, does not topple, and its pivot presses.
    pub nrmse_geometric_mean: GeometricMean,
    /// Geometric mean of the error of peaks over those records.
    pub peaks_geometric_mean: GeometricMean,
    /// Records that never lift Housner's body.
    pub never_lifted: usize,
    /// Records whose histories cannot be compared one to one: toppled, not well conditioned, or
    /// with a pivot that would have to pull.
    pub not_comparable: usize,
    /// Records that do not topple Housner's body but ask his pivot to pull: free flight, where
    /// rocking does not hold.
    pub pivot_pulls: usize,
    /// Names of the records in which a model failed ([`Row::failed`]).
    pub failed: Vec<String>,
    /// Largest energy residual of all finite element histories; none where they have none.
    pub energy_residual_max: Option<f64>,
}

/// All records, what they say together, and what each suite says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Validation {
    /// All records together.
    #[serde(flatten)]
    pub all: Summary,
    /// Of the suites that are there.
    pub suites: BTreeMap<Suite, Summary>,
    /// A row a record, in their order.
    pub records: Vec<Row>,
}

impl Validation {
    /// From the rows of all records.
    pub(crate) fn new(records: Vec<Row>) -> Self {
        let mut suites = BTreeMap::<Suite, Vec<&Row>>::new();
        for row in &records {
            suites.entry(row.suite).or_default().push(row);
        }
        let suites = suites.into_iter().map(|(suite, rows)| (suite, Summary::new(&rows))).collect();
        Self { all: Summary::new(&records.iter().collect::<Vec<_>>()), suites, records }
    }
}

impl Summary {
    /// From the rows of a set.
    pub(crate) fn new(records: &[&Row]) -> Self {
        let (housner, fem): (Vec<f64>, Vec<f64>) = records.iter().map(|row| peaks(row)).unzip();
        let changed: Vec<f64> = records.iter().map(|row| row.peak_ratio_housner_changed).collect();
        let never_lifted =
            records.iter().filter(|row| row.outcome == super::RecordOutcome::NeverLifted).count();
        let comparable = records.iter().filter(|row| row.comparable()).count();
        let share = |of: fn(&Row) -> bool| {
            records.iter().filter(|row| of(row)).count() as f64 / records.len().max(1) as f64
        };
        Self {
            count: records.len(),
            ks_distance: ks_distance(&housner, &fem),
            ks_distance_of_housner_changed: ks_distance(&housner, &changed),
            overturning_agreement: share(Row::agrees),
            overturning_agreement_of_housner_changed: share(|row| {
                row.overturned_housner_changed == row.overturned_housner
            }),
            overturning: Confusion::new(records),
            nrmse_well_conditioned: Quantiles::new(records, |row| row.nrmse_horizontal),
            nrmse_vertical_well_conditioned: Quantiles::new(records, |row| row.nrmse_vertical),
            peaks_well_conditioned: Quantiles::new(records, Row::peak_error),
            nrmse_geometric_mean: GeometricMean::new(records.iter().copied()),
            peaks_geometric_mean: GeometricMean::by(records.iter().copied(), Row::peak_error),
            never_lifted,
            not_comparable: records.len() - comparable - never_lifted,
            pivot_pulls: records
                .iter()
                .filter(|row| row.pivot_pulls_s.is_some() && !row.overturned_housner)
                .count(),
            failed: records.iter().filter(|row| row.failed()).map(|row| row.name.clone()).collect(),
            energy_residual_max: records
                .iter()
                .filter_map(|row| row.energy_residual)
                .reduce(f64::max),
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
mod tests;
