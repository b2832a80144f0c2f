//! Rigid against springs: how Housner's answers and those of the finite elements differ over a
//! whole sweep.

use super::{
    SweepError,
    fragility::subject_name,
    parts::SweepParts,
    plan::Plan,
    reduce::{self, Histogram},
};
use sweep_table::{SweepTable, TableOf};

/// One structure, or all of them.
#[derive(Clone, Debug, Default)]
pub struct ComparisonRow {
    /// None: all structures together.
    pub subject: Option<usize>,
    /// Histories that both models followed.
    pub n: u64,
    /// One of them failed, or Housner's pivot let go.
    pub left_out: u64,
    /// Overturned in both, in Housner's alone, on springs alone, in neither.
    pub both: u64,
    /// Histories in which Housner's body overturns alone.
    pub housner_only: u64,
    /// Histories in which the finite elements overturn alone.
    pub fem_only: u64,
    /// Histories in which neither overturns.
    pub neither: u64,
    /// |theta|/alpha; infinite for a body that overturned.
    pub peaks: [Histogram; 2],
    /// |difference| of |theta|/alpha where neither overturned and Housner's body was lifted.
    pub difference: Histogram,
    /// NRMSE of u, where Housner's body was lifted.
    pub nrmse: Histogram,
}

impl ComparisonRow {
    /// Share of histories on whose overturning both agree.
    pub(crate) fn agreement(&self) -> Option<f64> {
        (self.n > 0).then(|| (self.both + self.neither) as f64 / self.n as f64)
    }

    /// Distance of the distributions of the peaks.
    pub(crate) fn ks_distance(&self) -> f64 {
        self.peaks[0].ks_distance(&self.peaks[1])
    }
}

/// The comparison of a sweep.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Every structure, and all of them last.
    pub rows: Vec<ComparisonRow>,
    /// |theta|/alpha by Housner and on springs of some histories, for the figure; infinite for a body that overturned.
    pub sample: Vec<(f64, f64)>,
}

/// Histories that the figure shows.
const SAMPLE: u64 = 2000;

impl Comparison {
    /// Of the parts that are there.
    ///
    /// # Errors
    /// A part that cannot be read.
    pub fn new(parts: &SweepParts) -> Result<Self, SweepError> {
        let n = parts.plan.subjects.len();
        let named = |subject| ComparisonRow { subject, ..ComparisonRow::default() };
        let mut rows: Vec<ComparisonRow> = (0..n).map(Some).chain([None]).map(named).collect();
        let stride = parts.plan.cells().div_ceil(SAMPLE);
        let mut sample = Vec::new();
        reduce::each(parts, |seen| {
            for place in [seen.cell.subject, n] {
                let row = &mut rows[place];
                let [Some(rigid), Some(fem)] = seen.answers else {
                    row.left_out += 1;
                    continue;
                };
                row.n += 1;
                match (rigid.overturned, fem.overturned) {
                    (true, true) => row.both += 1,
                    (true, false) => row.housner_only += 1,
                    (false, true) => row.fem_only += 1,
                    (false, false) => row.neither += 1,
                }
                let peak = |known: reduce::KnownAnswer| {
                    if known.overturned { f64::INFINITY } else { known.peak }
                };
                let pair = [peak(rigid), peak(fem)];
                for (peaks, peak) in row.peaks.iter_mut().zip(pair) {
                    peaks.add(peak);
                }
                if rigid.peak > 0.0 {
                    if !rigid.overturned && !fem.overturned {
                        row.difference.add((rigid.peak - fem.peak).abs());
                    }
                    seen.nrmse.iter().for_each(|nrmse| row.nrmse.add(*nrmse));
                }
                if place == n && seen.cell.index.is_multiple_of(stride) {
                    sample.push((pair[0], pair[1]));
                }
            }
        })?;
        Ok(Self { rows, sample })
    }

    /// All structures together.
    pub fn all(&self) -> Option<&ComparisonRow> {
        self.rows.last()
    }

    /// `compare.csv`.
    pub fn table(&self, plan: &Plan) -> SweepTable {
        TableOf::new(&self.rows)
            .text("structure", |row| subject_name(plan, row.subject))
            .count("histories", |row| row.n)
            .count("left_out", |row| row.left_out)
            .count("overturned_both", |row| row.both)
            .count("overturned_housner_only", |row| row.housner_only)
            .count("overturned_fem_only", |row| row.fem_only)
            .count("overturned_neither", |row| row.neither)
            .real("agreement", ComparisonRow::agreement)
            .real("ks_distance_of_peaks", |row| Some(row.ks_distance()))
            .real("peak_difference_50", |row| row.difference.quantile(0.5))
            .real("peak_difference_90", |row| row.difference.quantile(0.9))
            .real("nrmse_50", |row| row.nrmse.quantile(0.5))
            .real("nrmse_90", |row| row.nrmse.quantile(0.9))
            .table()
    }
}
