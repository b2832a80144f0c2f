//! What springs err, measured on every suite of motions, and what an accuracy allows.

use serde::{Deserialize, Serialize};

use cases::{Asked, Yardstick};
use rocking::{
    json::{null_as_infinite, null_as_lost},
    statistics::largest,
};
use validation::PeakErrors;

/// A statistic of errors (NRMSE of u), and over how many motions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statistic {
    #[serde(deserialize_with = "null_as_infinite")]
    pub value: f64,
    pub count: usize,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// The error of springs against Housner, measured; `None` where there is no motion to measure it
/// on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// NRMSE of u or v, the larger, on the record at hand, if Housner's answer to it is well
    /// conditioned.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "null_as_lost")]
    pub record: Option<f64>,
    /// Median over the well-conditioned of the synthetic motions made for the structure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub synthetic_median: Option<Statistic>,
    /// 90 % of these are below it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub synthetic_p90: Option<Statistic>,
    /// Geometric mean over the earthquake-like motions on which Housner's sensitivity is below 150.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub earthquakes_mean: Option<Statistic>,
    /// How many of these were scaled down to what the structure stands.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub earthquakes_scaled_down: usize,
    /// The same with three standard errors on top: more than other earthquakes are likely to give,
    /// and what Omega_n is chosen by.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "null_as_lost")]
    pub earthquakes_upper: Option<f64>,
}

/// Standard errors of the earthquake-like motions' mean on top of it that are aimed at: they are
/// few, and real records differ from them.
pub(crate) const ERRORS: i32 = 3;
/// How much more the 90 % quantile and the earthquake-like motions may have than the accuracy asked
/// for; sways of elastic structures, too.
pub const LOOSER: f64 = 5.0;

impl Accuracy {
    /// Whether an accuracy is reached: by the record, the synthetic motions and the mean of the
    /// earthquake-like ones itself.
    pub fn reaches(&self, accuracy: f64) -> bool {
        let earthquakes = self
            .earthquakes_mean
            .is_none_or(|mean| mean.value <= self.looser_on_earthquakes() * accuracy);
        let others = [JudgedOn::Record, JudgedOn::Synthetic];
        earthquakes
            && others
                .iter()
                .filter_map(|suite| self.over_on(*suite, accuracy))
                .all(|over| over <= 1.0)
    }

    /// How much more than the accuracy the earthquake-like motions may have: [`LOOSER`] as they
    /// are, nothing more those scaled down, which are no stronger than the synthetic ones; between
    /// these in the mean of both.
    pub fn looser_on_earthquakes(&self) -> f64 {
        let share =
            |mean: Statistic| 1.0 - self.earthquakes_scaled_down as f64 / mean.count.max(1) as f64;
        LOOSER.powf(self.earthquakes_mean.map_or(1.0, share))
    }

    /// The largest error, in units of what an accuracy allows: at most 1 if it is surely reached; 0
    /// if nothing was measured.
    pub(crate) fn over(&self, accuracy: f64) -> f64 {
        largest(JudgedOn::ALL.iter().filter_map(|suite| self.over_on(*suite, accuracy)))
    }

    /// The same on one suite; `None` where it was not measured.
    pub(crate) fn over_on(&self, suite: JudgedOn, accuracy: f64) -> Option<f64> {
        match suite {
            JudgedOn::Record => self.record.map(|x| x / accuracy),
            JudgedOn::Synthetic => {
                let shares = [(self.synthetic_median, 1.0), (self.synthetic_p90, LOOSER)];
                shares
                    .into_iter()
                    .filter_map(|(s, looser)| s.map(|s| s.value / (looser * accuracy)))
                    .reduce(f64::max)
            }
            JudgedOn::Earthquakes => self
                .earthquakes_upper
                .map(|upper| upper / (self.looser_on_earthquakes() * accuracy)),
        }
    }
}

/// The errors of the largest displacement, uplift and forces between landings
/// (`validation::peaks`), on the same motions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PeakAccuracy {
    /// Of the one with the largest error, motion by motion.
    pub largest: Accuracy,
    /// Of each, on the record.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub record: Option<PeakErrors>,
    /// Of each, median over the synthetic motions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub synthetic_median: Option<PeakErrors>,
    /// Of each, geometric mean over the earthquake-like motions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub earthquakes_mean: Option<PeakErrors>,
}

/// All that was measured of springs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeasuredErrors {
    pub histories: Accuracy,
    pub peaks: PeakAccuracy,
}

impl MeasuredErrors {
    /// The errors by a yardstick.
    pub(crate) fn by(&self, yardstick: Yardstick) -> &Accuracy {
        match yardstick {
            Yardstick::Histories => &self.histories,
            Yardstick::Peaks => &self.peaks.largest,
        }
    }

    /// Whether anything was measured by a yardstick.
    pub(crate) fn measured(&self, yardstick: Yardstick) -> bool {
        JudgedOn::ALL.iter().any(|suite| self.by(yardstick).over_on(*suite, 1.0).is_some())
    }

    /// Whether what is asked for is reached ([`Accuracy::reaches`]).
    pub(crate) fn reaches(&self, asked: Asked) -> bool {
        self.by(asked.by).reaches(asked.error)
    }

    /// The largest error in units of what is allowed (`Accuracy::over`).
    pub fn over(&self, asked: Asked) -> f64 {
        self.by(asked.by).over(asked.error)
    }

    /// The same on one suite.
    pub(crate) fn over_on(&self, suite: JudgedOn, asked: Asked) -> Option<f64> {
        self.by(asked.by).over_on(suite, asked.error)
    }
}

/// What springs can be judged on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JudgedOn {
    Record,
    Synthetic,
    Earthquakes,
}

impl JudgedOn {
    /// The cheapest first.
    pub(crate) const ALL: [Self; 3] = [Self::Record, Self::Synthetic, Self::Earthquakes];
}

/// The q-quantile of sorted numbers, linear between the two nearest ranks; infinite if it falls on
/// an infinite one.
pub(crate) fn quantile(sorted: &[f64], q: f64) -> Option<f64> {
    let rank = q * sorted.len().checked_sub(1)? as f64;
    let (low, share) = (rank.floor() as usize, rank.fract());
    Some(if share == 0.0 {
        sorted[low]
    } else {
        sorted[low] * (1.0 - share) + sorted[low + 1] * share
    })
}

/// Geometric mean, and the factor of its standard error; errors are clamped to 1e-12..1: a lost
/// history counts as one that stands still, so that no single motion dominates. To the squared
/// deviations of ln(error) one of 1, a factor of e, is added, so that few motions do not look
/// certain.
pub(crate) fn geometric_mean(
    errors: impl ExactSizeIterator<Item = f64> + Clone,
) -> Option<(f64, f64)> {
    let n = errors.len() as f64;
    let logarithms = errors.map(|e| e.clamp(1e-12, 1.0).ln());
    let mean = logarithms.clone().sum::<f64>() / n;
    let variance = (1.0 + logarithms.map(|x| (x - mean).powi(2)).sum::<f64>()) / n;
    (n > 0.0).then(|| (mean.exp(), (variance / n).sqrt().exp()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_accuracy_allows() {
        let statistic = |value| Some(Statistic { value, count: 30 });
        let accuracy = Accuracy {
            record: Some(1e-3),
            synthetic_median: statistic(1.5e-3),
            synthetic_p90: statistic(4e-3),
            earthquakes_mean: statistic(9e-3),
            earthquakes_scaled_down: 0,
            earthquakes_upper: Some(1.2e-2),
        };
        assert!((accuracy.over(2e-3) - 1.2).abs() < 1e-12);
        // the mean of the earthquake-like motions is within 5 times as much, with its standard
        // errors it is not
        assert!(accuracy.reaches(2e-3) && !accuracy.reaches(1.7e-3));
        assert_eq!(Accuracy::default().over(2e-3), 0.0);
        // half of them scaled down: sqrt(5) times as much
        let scaled = Accuracy { earthquakes_scaled_down: 15, ..accuracy };
        assert!(
            (scaled.looser_on_earthquakes() - 5f64.sqrt()).abs() < 1e-12 && !scaled.reaches(2e-3)
        );
    }

    #[test]
    fn quantiles_and_means_are_those_worked_by_hand() {
        assert_eq!(quantile(&[1.0, 2.0, 3.0, 5.0], 0.5), Some(2.5));
        assert_eq!(quantile(&[1.0, f64::INFINITY], 0.9), Some(f64::INFINITY));
        let (mean, factor) = geometric_mean([1e-4, 1e-2, 1e-3].into_iter()).unwrap();
        assert!((mean - 1e-3).abs() < 1e-15);
        // logarithms -l, l, 0 about the mean, l = ln 10
        assert!((factor.ln() - ((1.0 + 2.0 * 10f64.ln().powi(2)) / 9.0).sqrt()).abs() < 1e-12);
        assert_eq!((quantile(&[], 0.5), geometric_mean([].into_iter())), (None, None));
    }
}
