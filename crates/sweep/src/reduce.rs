//! One pass over the parts of a sweep of histories, a part at a time.

use super::{
    SweepError,
    parts::SweepParts,
    plan::{Cell, Plan},
};
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

/// Counts in bins of the logarithm, of numbers greater than zero: quantiles to the width of a bin,
/// in memory that does not grow with the number of numbers.
#[derive(Clone, Debug, Default)]
pub struct Histogram {
    bins: std::collections::BTreeMap<i32, u64>,
    /// Numbers that are zero, and infinite.
    zero: u64,
    infinite: u64,
}

/// Width of a bin of the natural logarithm.
const BIN: f64 = 0.002;

impl Histogram {
    pub(crate) fn add(&mut self, x: f64) {
        if x <= 0.0 {
            self.zero += 1;
        } else if x == f64::INFINITY {
            self.infinite += 1;
        } else {
            *self.bins.entry((x.ln() / BIN).floor() as i32).or_default() += 1;
        }
    }

    /// How many numbers there are.
    pub(crate) fn count(&self) -> u64 {
        self.zero + self.infinite + self.bins.values().sum::<u64>()
    }

    /// The number below which a share of all lie, the upper one of two in the middle; infinite
    /// where these are.
    pub(crate) fn quantile(&self, share: f64) -> Option<f64> {
        let all = self.count();
        if all == 0 {
            return None;
        }
        let rank = ((share * all as f64) as u64).min(all - 1);
        let mut below = self.zero;
        if rank < below {
            return Some(0.0);
        }
        for (bin, count) in &self.bins {
            below += count;
            if rank < below {
                return Some(((f64::from(*bin) + 0.5) * BIN).exp());
            }
        }
        Some(f64::INFINITY)
    }

    /// The largest distance of two cumulative distributions (Smirnov 1939), at the bins' ends.
    pub(crate) fn ks_distance(&self, other: &Self) -> f64 {
        let all = [self, other].map(|h| h.count().max(1) as f64);
        let mut below = [self.zero, other.zero].map(|n| n as f64);
        let distance = |below: [f64; 2]| (below[0] / all[0] - below[1] / all[1]).abs();
        let mut worst = distance(below);
        let bins: std::collections::BTreeSet<i32> =
            self.bins.keys().chain(other.bins.keys()).copied().collect();
        for bin in bins {
            for (below, h) in below.iter_mut().zip([self, other]) {
                *below += h.bins.get(&bin).copied().unwrap_or(0) as f64;
            }
            worst = worst.max(distance(below));
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_sorted_numbers_to_a_bin() {
        let mut histogram = Histogram::default();
        let numbers: Vec<f64> = (1..=1000).map(|i| 0.01 * f64::from(i)).collect();
        numbers.iter().for_each(|x| histogram.add(*x));
        for share in [0.16, 0.5, 0.84, 0.999] {
            let exact = numbers[(share * 1000.0) as usize];
            assert!((histogram.quantile(share).unwrap() / exact - 1.0).abs() < BIN, "{share}");
        }
        histogram.add(f64::INFINITY);
        histogram.add(0.0);
        assert_eq!(
            (histogram.quantile(0.0), histogram.quantile(1.0)),
            (Some(0.0), Some(f64::INFINITY))
        );
        assert_eq!(Histogram::default().quantile(0.5), None);
    }

    /// 1, 2, 3, 4 against 3, 4, 5, 6: half of the first lie below all of the second.
    #[test]
    fn the_distance_of_two_samples_is_the_largest_step_between_their_stairs() {
        let of = |numbers: [f64; 4]| {
            let mut h = Histogram::default();
            numbers.iter().for_each(|x| h.add(*x));
            h
        };
        assert_eq!(of([1.0, 2.0, 3.0, 4.0]).ks_distance(&of([3.0, 4.0, 5.0, 6.0])), 0.5);
        assert_eq!(of([1.0, 2.0, 3.0, 4.0]).ks_distance(&of([1.0, 2.0, 3.0, 4.0])), 0.0);
    }
}
