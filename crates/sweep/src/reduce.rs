//! One pass over the parts of a sweep of histories, a part at a time.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    SweepError,
    parts::SweepParts,
    plan::{Cell, Plan},
};
use files::message::rounded;
use rocking::statistics::{ks_distance, quantile_of_ranks};
use sweep_table::{Column, SweepTable};

/// The models of a sweep's columns.
pub const MODELS: [&str; 2] = ["housner", "fem"];

/// What a model answered; none of histories that failed, or whose pivot let go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct KnownAnswer {
    /// Largest |theta|/alpha: zero of a body that was never lifted.
    pub peak: f64,
    pub overturned: bool,
}

/// One history as the reductions see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SeenHistory {
    pub cell: Cell,
    /// [m/s2, m/s]
    pub pga: f64,
    pub pgv: f64,
    /// By Housner, on springs.
    pub answers: [Option<KnownAnswer>; 2],
    pub nrmse: Option<f64>,
}

/// Which models a plan has, as indices into [`MODELS`].
pub fn models(plan: &Plan) -> Vec<usize> {
    [plan.model.housner(), plan.model.fem()]
        .iter()
        .enumerate()
        .filter(|(_, has)| **has)
        .map(|(i, _)| i)
        .collect()
}

/// Show every history that is there to `take`, in the order of cells.
///
/// # Errors
/// A part that cannot be read.
pub(crate) fn each(
    parts: &SweepParts,
    mut take: impl FnMut(&SeenHistory),
) -> Result<(), SweepError> {
    let models = models(parts.plan);
    let real = |name: &'static str| (name, Column::Real(Vec::new()));
    let mut columns =
        vec![("cell", Column::Count(Vec::new())), real("pga_m_per_s2"), real("pgv_m_per_s")];
    const NAMES: [[&str; 2]; 2] =
        [["housner_peak", "housner_overturned"], ["fem_peak", "fem_overturned"]];
    for &model in &models {
        columns.push(real(NAMES[model][0]));
        columns.push((NAMES[model][1], Column::Flag(Vec::new())));
    }
    if models.len() == 2 {
        columns.push(real("nrmse"));
    }
    parts.each(&SweepTable { columns }, |table| {
        let (pga, pgv) = (table.reals("pga_m_per_s2"), table.reals("pgv_m_per_s"));
        let answers = NAMES.map(|[peak, overturned]| (table.reals(peak), table.flags(overturned)));
        let nrmse = table.reals("nrmse");
        for (row, &cell) in table.counts("cell").iter().enumerate() {
            let known = |(peak, overturned): &(&[Option<f64>], &[Option<bool>])| {
                let (peak, overturned) = (peak.get(row).copied()??, overturned.get(row).copied()??);
                Some(KnownAnswer { peak, overturned })
            };
            take(&SeenHistory {
                cell: parts.plan.cell(cell as u64),
                pga: pga[row].unwrap_or(0.0),
                pgv: pgv[row].unwrap_or(0.0),
                answers: [known(&answers[0]), known(&answers[1])],
                nrmse: nrmse.get(row).copied().flatten(),
            });
        }
        Ok(())
    })
}

/// Numbers from zero to infinity. The first 4096 are kept, and what is asked of them is exact; when
/// there are more, all are counted in bins of the logarithm, so that memory does not grow.
#[derive(Clone, Debug)]
pub struct Histogram {
    numbers: Numbers,
    /// Numbers that are zero, and infinite.
    zero: u64,
    infinite: u64,
}

/// The others.
#[derive(Clone, Debug)]
enum Numbers {
    Kept(Vec<f64>),
    Binned(BTreeMap<i32, u64>),
}

impl Default for Histogram {
    fn default() -> Self {
        Self { numbers: Numbers::Kept(Vec::new()), zero: 0, infinite: 0 }
    }
}

/// Numbers that are kept.
const KEPT: usize = 4096;
/// Width of a bin of the natural logarithm.
const BIN: f64 = 0.002;

fn bin(x: f64) -> i32 {
    (x.ln() / BIN).floor() as i32
}

impl Histogram {
    pub(crate) fn add(&mut self, x: f64) {
        if x <= 0.0 {
            self.zero += 1;
        } else if x == f64::INFINITY {
            self.infinite += 1;
        } else {
            match &mut self.numbers {
                Numbers::Kept(kept) if kept.len() < KEPT => kept.push(x),
                Numbers::Kept(_) => {
                    let mut bins = self.bins();
                    *bins.entry(bin(x)).or_default() += 1;
                    self.numbers = Numbers::Binned(bins);
                }
                Numbers::Binned(bins) => *bins.entry(bin(x)).or_default() += 1,
            }
        }
    }

    /// How many numbers there are.
    pub(crate) fn count(&self) -> u64 {
        let others = match &self.numbers {
            Numbers::Kept(kept) => kept.len() as u64,
            Numbers::Binned(bins) => bins.values().sum(),
        };
        self.zero + self.infinite + others
    }

    /// The quantile of a share; infinite where it lies at or next to an infinite number.
    pub(crate) fn quantile(&self, share: f64) -> Option<f64> {
        let found = quantile_of_ranks(self.count(), share, |rank| self.ranked(rank))?;
        Some(match self.numbers {
            // the middle of a bin has no more digits
            Numbers::Binned(_) => rounded(found, 4),
            Numbers::Kept(_) => found,
        })
    }

    /// The number of a rank from zero, in ascending order.
    fn ranked(&self, rank: u64) -> f64 {
        let Some(rank) = rank.checked_sub(self.zero) else { return 0.0 };
        match &self.numbers {
            Numbers::Kept(kept) => {
                let mut kept = kept.clone();
                kept.sort_by(f64::total_cmp);
                kept.get(rank as usize).copied().unwrap_or(f64::INFINITY)
            }
            Numbers::Binned(bins) => {
                let mut below = 0;
                let found = bins.iter().find(|(_, count)| {
                    below += **count;
                    rank < below
                });
                found.map_or(f64::INFINITY, |(bin, _)| ((f64::from(*bin) + 0.5) * BIN).exp())
            }
        }
    }

    /// The counts in bins.
    fn bins(&self) -> BTreeMap<i32, u64> {
        match &self.numbers {
            Numbers::Kept(kept) => kept.iter().fold(BTreeMap::new(), |mut bins, x| {
                *bins.entry(bin(*x)).or_default() += 1;
                bins
            }),
            Numbers::Binned(bins) => bins.clone(),
        }
    }

    /// The largest distance of two cumulative distributions (Smirnov 1939); at the bins' ends,
    /// which is no more, where numbers are binned.
    pub(crate) fn ks_distance(&self, other: &Self) -> f64 {
        if let (Numbers::Kept(mine), Numbers::Kept(others)) = (&self.numbers, &other.numbers) {
            let all = |kept: &[f64], h: &Self| {
                let zeros = std::iter::repeat_n(0.0, h.zero as usize);
                let infinite = std::iter::repeat_n(f64::INFINITY, h.infinite as usize);
                zeros.chain(kept.iter().copied()).chain(infinite).collect::<Vec<f64>>()
            };
            return ks_distance(&all(mine, self), &all(others, other));
        }
        let all = [self, other].map(|h| h.count().max(1) as f64);
        let mut below = [self.zero, other.zero].map(|n| n as f64);
        let distance = |below: [f64; 2]| (below[0] / all[0] - below[1] / all[1]).abs();
        let mut worst = distance(below);
        let counts = [self, other].map(Self::bins);
        let bins: BTreeSet<i32> = counts.iter().flat_map(|bins| bins.keys().copied()).collect();
        for bin in bins {
            for (below, counts) in below.iter_mut().zip(&counts) {
                *below += counts.get(&bin).copied().unwrap_or(0) as f64;
            }
            worst = worst.max(distance(below));
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(numbers: impl IntoIterator<Item = f64>) -> Histogram {
        let mut histogram = Histogram::default();
        numbers.into_iter().for_each(|x| histogram.add(x));
        histogram
    }

    /// The median of two is their mean, and of 1, 2, 3 it is 2, to the last digit.
    #[test]
    fn quantiles_are_those_of_the_sorted_numbers() {
        assert_eq!(of([1.0, 3.0]).quantile(0.5), Some(2.0));
        assert_eq!(of([3.0, 1.0, 2.0]).quantile(0.5), Some(2.0));
        assert_eq!(of([0.0, 0.0, 1.0]).quantile(0.5), Some(0.0));
        assert_eq!(of([0.0, 1.0]).quantile(0.5), Some(0.5));
        assert_eq!(Histogram::default().quantile(0.5), None);
    }

    /// Where half overturn, no peak is in the middle; where fewer do, one is.
    #[test]
    fn a_median_is_infinite_where_at_least_half_of_the_numbers_are() {
        let over = f64::INFINITY;
        assert_eq!(of([1.0, over]).quantile(0.5), Some(over));
        assert_eq!(of([1.0, over, over]).quantile(0.5), Some(over));
        assert_eq!(of([over, over]).quantile(0.5), Some(over));
        assert_eq!(of([1.0, 2.0, over]).quantile(0.5), Some(2.0));
    }

    /// Many are as near as their bins are wide, and have no more digits than that.
    #[test]
    fn quantiles_of_more_than_are_kept_are_those_of_the_sorted_numbers_to_a_bin() {
        let n = KEPT + 1000;
        let mut histogram = of((1..=n).map(|i| 0.01 * i as f64));
        assert!(matches!(histogram.numbers, Numbers::Binned(_)) && histogram.count() == n as u64);
        for share in [0.16, 0.5, 0.84, 0.999] {
            let exact = 0.01 * (1.0 + share * (n - 1) as f64);
            let found = histogram.quantile(share).unwrap();
            assert!((found / exact - 1.0).abs() < BIN, "{share}");
            assert!(found.to_string().len() < 7, "{found}");
        }
        histogram.add(f64::INFINITY);
        histogram.add(0.0);
        assert_eq!(
            (histogram.quantile(0.0), histogram.quantile(1.0)),
            (Some(0.0), Some(f64::INFINITY))
        );
    }

    /// 1, 2, 3, 4 against 3, 4, 5, 6: half of the first lie below all of the second.
    #[test]
    fn the_distance_of_two_samples_is_the_largest_step_between_their_stairs() {
        let four = || of([1.0, 2.0, 3.0, 4.0]);
        assert_eq!(four().ks_distance(&of([3.0, 4.0, 5.0, 6.0])), 0.5);
        assert_eq!(four().ks_distance(&four()), 0.0);
        // however near
        assert_eq!(of([1.0, 1.000_001]).ks_distance(&of([1.000_002, 1.000_003])), 1.0);
        assert_eq!(of([0.0, 1.0]).ks_distance(&of([1.0, f64::INFINITY])), 0.5);
    }

    #[test]
    fn the_distance_of_many_numbers_is_that_of_their_bins() {
        let many = |shift: usize| of((1..=2 * KEPT).map(|i| (i + shift) as f64));
        let shift = KEPT / 2;
        assert_eq!(many(0).ks_distance(&many(0)), 0.0);
        let found = many(0).ks_distance(&many(shift));
        assert!(found <= 0.25 && found > 0.249, "{found}");
    }
}
