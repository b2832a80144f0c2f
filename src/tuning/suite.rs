//! What springs are judged on: the record at hand where it can be followed, synthetic motions made for the structure, and
//! earthquake-like motions of real frequencies.
//!
//! Housner's answers are found once; the springs of every Omega_n are judged against them.

use std::{borrow::Cow, sync::Arc};

use std::ops::Range;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{
    conditioning::{CHANGES, ILL_CONDITIONED, changes, moved_by_width, sensitivity},
    fem::{Analysis, Control, Finish, HistoryOutcome, Start, histories},
    housner::{self, Rocking, RockingOptions},
    overturning::samples_until,
    record::Record,
    regime,
    spring::{Chain, Springs},
    structure::Body,
    synthetic,
    validate::{PREDICTABLE, Stream, push},
};

/// Motions of each suite that are followed.
const SYNTHETIC: usize = 24;
const EARTHQUAKES: usize = 16;
/// Earthquake-like motions that topple a structure, or cannot be foretold for it, are scaled down to so many times the acceleration that lifts it.
const MILD: (f64, f64) = (1.2, 6.0);
/// Motions of each suite that are looked at for them, so many at a time.
const LOOKED_AT: usize = 480;
/// The same of the motions that decide between springs which these do not tell apart.
const MORE: usize = 72;
const MORE_LOOKED_AT: usize = 480;
const AT_A_TIME: usize = 8;
/// Seed of both: not one that `tune validate` takes by itself.
const SEED: u64 = 1940;
/// A relative change of the width that must not move a predictable history by more than so many times what its sensitivity may.
const SMALL_CHANGE: f64 = 1e-6;
const BELIED: f64 = 4.0;

/// The errors of a history that says nothing.
const LOST: (f64, f64) = (f64::INFINITY, f64::INFINITY);

/// A motion and Housner's answer to it.
#[derive(Clone, Debug)]
pub struct Trial {
    dt: f64,
    accel: Vec<f64>,
    vertical: Option<Arc<[f64]>>,
    /// Housner's rotations at the samples, up to overturning if he overturns (rad).
    theta: Vec<f64>,
    overturns: bool,
}

/// What a motion must be like to be judged on.
#[derive(Clone, Copy, Debug, PartialEq)]
enum WantedMotion {
    /// Well conditioned, by the derivative and by finite changes.
    WellConditioned,
    /// The same up to overturning, if it overturns.
    WellConditionedWhileItStands,
    /// Of a sensitivity below [`PREDICTABLE`], which a small finite change does not belie.
    Predictable,
    /// The same up to overturning, if it overturns.
    PredictableWhileItStands,
}

impl WantedMotion {
    /// Whether it may topple the body.
    fn may_topple(self) -> bool {
        matches!(self, Self::WellConditionedWhileItStands | Self::PredictableWhileItStands)
    }

    /// Whether Housner's history `rocking` is so; the cheapest grounds to refuse it first.
    fn holds(self, body: &Body<f64>, record: &Record, options: &RockingOptions<f64>, rocking: &Rocking<f64>) -> bool {
        let Record { dt, ref accel, .. } = *record;
        let by_width = |change: f64| moved_by_width(body, dt, accel, options, rocking, change) / change;
        let worst = || sensitivity(body, dt, accel, options).worst();
        match self {
            Self::WellConditioned | Self::WellConditionedWhileItStands => {
                by_width(CHANGES[1]) < ILL_CONDITIONED
                    && worst() < ILL_CONDITIONED
                    && changes(body, dt, accel, options).proportionate()
            }
            Self::Predictable | Self::PredictableWhileItStands => {
                by_width(SMALL_CHANGE) < BELIED * PREDICTABLE && worst() < PREDICTABLE
            }
        }
    }
}

impl Trial {
    /// The motion, if Housner's body rocks on it, on a pivot that presses, and its history is as wanted.
    fn new(body: &Body<f64>, restitution: f64, record: Record, wanted: WantedMotion) -> Option<Self> {
        let vertical = record.vertical_accel();
        let options = RockingOptions { restitution: Some(restitution), vertical, ..RockingOptions::default() };
        let rocking = housner::solve(body, record.dt, &record.accel, &options);
        let overturned = rocking.overturned().filter(|_| wanted.may_topple());
        let rocks = rocking.outcome == housner::RockingOutcome::Rocked || overturned.is_some();
        let presses = || regime::pivot_pulls(body, record.dt, &record.accel, &rocking).is_none();
        let lands = !rocking.impacts.is_empty();
        let fit = rocks && lands && wanted.holds(body, &record, &options, &rocking) && presses();
        fit.then(|| {
            let Record { dt, accel, .. } = record;
            let mut theta = rocking.theta;
            theta.truncate(samples_until(overturned, dt));
            Self { dt, accel, vertical: options.vertical, theta, overturns: overturned.is_some() }
        })
    }

    fn push(&self) -> Cow<'_, [f64]> {
        push(&self.accel, self.vertical.as_deref().unwrap_or_default())
    }

    fn case(&self, body: &Body<f64>, springs: &Springs<Chain<f64>>, control: Control) -> Analysis<'_, f64> {
        Analysis {
            body: *body,
            springs: *springs,
            start: Start::Settled,
            dt: self.dt,
            accel: &self.accel,
            vertical: self.vertical.as_deref().unwrap_or_default(),
            scale: 1.0,
            control,
        }
    }
}

/// NRMSE of u and of v on these springs, of each trial, of a body that overturns up to then; infinite if the history does not get to
/// the record's end, or one body overturns and the other does not.
fn errors(trials: &[Trial], body: &Body<f64>, springs: &Springs<Chain<f64>>, control: Control) -> Vec<(f64, f64)> {
    let pushes: Vec<Cow<[f64]>> = trials.iter().map(Trial::push).collect();
    let cases: Vec<Analysis<f64>> = trials.iter().map(|trial| trial.case(body, springs, control)).collect();
    let followed = histories(&cases, |i| Stream::new(body, &trials[i].theta, &pushes[i]));
    let error = |((stream, finish), trial): ((Stream, Finish<f64>), &Trial)| {
        let overturned = match finish.outcome {
            HistoryOutcome::Completed => housner::topples(body, stream.last.0, stream.last.1),
            HistoryOutcome::Overturned { .. } | HistoryOutcome::Stopped { .. } => true,
            _ => return LOST,
        };
        if overturned != trial.overturns {
            return LOST;
        }
        let errors = if overturned { stream.upright } else { stream.errors };
        (errors.horizontal.value(), errors.vertical.value())
    };
    followed.into_iter().zip(trials).map(error).collect()
}

/// A statistic of errors (NRMSE of u), and over how many motions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statistic {
    pub value: f64,
    pub count: usize,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// The error of springs against Housner, measured; `None` where there is no motion to measure it on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// NRMSE of u or v, the larger, on the record at hand, if Housner's answer to it is well conditioned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<f64>,
    /// Median over the well-conditioned of the synthetic motions made for the structure.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub synthetic_median: Option<Statistic>,
    /// 90 % of these are below it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub synthetic_p90: Option<Statistic>,
    /// Geometric mean over the earthquake-like motions on which Housner's sensitivity is below 150.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub earthquakes_mean: Option<Statistic>,
    /// How many of these were scaled down to what the structure stands.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub earthquakes_scaled_down: usize,
    /// The same with three standard errors on top: more than other earthquakes are likely to give, and what Omega_n is chosen by.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub earthquakes_upper: Option<f64>,
}

/// Standard errors of the earthquake-like motions' mean on top of it that are aimed at: real records err about twice as much as these motions.
const ERRORS: i32 = 3;
/// How much more the 90 % quantile and the earthquake-like motions may have than the accuracy asked for.
pub const LOOSER: f64 = 5.0;

impl Accuracy {
    /// Whether an accuracy is reached: by the record, the synthetic motions and the mean of the earthquake-like ones itself.
    pub fn reaches(&self, accuracy: f64) -> bool {
        let earthquakes =
            self.earthquakes_mean.is_none_or(|mean| mean.value <= self.looser_on_earthquakes() * accuracy);
        let others = [JudgedOn::Record, JudgedOn::Synthetic];
        earthquakes && others.iter().filter_map(|suite| self.over_on(*suite, accuracy)).all(|over| over <= 1.0)
    }

    /// How much more than the accuracy the earthquake-like motions may have: [`LOOSER`] as they are, nothing more those scaled down, which are no
    /// stronger than the synthetic ones; between these in the mean of both.
    pub fn looser_on_earthquakes(&self) -> f64 {
        let share = |mean: Statistic| 1.0 - self.earthquakes_scaled_down as f64 / mean.count.max(1) as f64;
        LOOSER.powf(self.earthquakes_mean.map_or(1.0, share))
    }

    /// The largest error, in units of what an accuracy allows: at most 1 if it is surely reached; 0 if nothing was measured.
    pub fn over(&self, accuracy: f64) -> f64 {
        JudgedOn::ALL.iter().filter_map(|suite| self.over_on(*suite, accuracy)).fold(0.0, f64::max)
    }

    /// The same on one suite; `None` where it was not measured.
    pub fn over_on(&self, suite: JudgedOn, accuracy: f64) -> Option<f64> {
        match suite {
            JudgedOn::Record => self.record.map(|x| x / accuracy),
            JudgedOn::Synthetic => {
                let shares = [(self.synthetic_median, 1.0), (self.synthetic_p90, LOOSER)];
                shares.into_iter().filter_map(|(s, looser)| s.map(|s| s.value / (looser * accuracy))).reduce(f64::max)
            }
            JudgedOn::Earthquakes => {
                self.earthquakes_upper.map(|upper| upper / (self.looser_on_earthquakes() * accuracy))
            }
        }
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
    pub const ALL: [Self; 3] = [Self::Record, Self::Synthetic, Self::Earthquakes];
}

/// All motions that springs of a body are judged on.
#[derive(Clone, Debug)]
pub struct Suites {
    body: Body<f64>,
    record: Option<Trial>,
    synthetic: Vec<Trial>,
    earthquakes: Vec<Trial>,
    /// How many of the earthquakes, the last ones, are scaled down.
    scaled_down: usize,
}

impl Suites {
    /// Of a body that lands with velocity restitution `restitution`, with this record if there is one.
    pub fn new(body: &Body<f64>, restitution: f64, record: Option<&Record>) -> Self {
        Self::of_seed(SEED, body, restitution, record)
    }

    /// The same of other motions.
    pub fn of_seed(seed: u64, body: &Body<f64>, restitution: f64, record: Option<&Record>) -> Self {
        let (p, alpha) = (body.p_squared().sqrt(), body.alpha());
        let well = |record| Trial::new(body, restitution, record, WantedMotion::WellConditioned);
        let standing = |record| Trial::new(body, restitution, record, WantedMotion::WellConditionedWhileItStands);
        let predictable = |record| Trial::new(body, restitution, record, WantedMotion::Predictable);
        let mild = |record| Trial::new(body, restitution, record, WantedMotion::PredictableWhileItStands);
        let earthquake = |i| synthetic::earthquake(seed, i, p);
        let mut earthquakes = first(EARTHQUAKES, 0..LOOKED_AT, |i| predictable(earthquake(i)));
        let mild = first(EARTHQUAKES - earthquakes.len(), 0..LOOKED_AT, |i| mild(milder(earthquake(i), alpha)?));
        let scaled_down = mild.len();
        earthquakes.extend(mild);
        Self {
            body: *body,
            record: record.and_then(|record| standing(record.clone())),
            synthetic: first(SYNTHETIC, 0..LOOKED_AT, |i| well(synthetic::record(seed, i, p, alpha))),
            earthquakes,
            scaled_down,
        }
    }

    /// More synthetic motions, none of which is one of these, to tell springs apart on which these do not decide; nothing else.
    pub fn more(&self, restitution: f64) -> Self {
        let (p, alpha) = (self.body.p_squared().sqrt(), self.body.alpha());
        let well = |record| Trial::new(&self.body, restitution, record, WantedMotion::WellConditioned);
        let others = LOOKED_AT..LOOKED_AT + MORE_LOOKED_AT;
        Self {
            body: self.body,
            record: None,
            synthetic: first(MORE, others, |i| well(synthetic::record(SEED, i, p, alpha))),
            earthquakes: Vec::new(),
            scaled_down: 0,
        }
    }

    /// Whether the record is one of the motions judged on.
    pub fn has_record(&self) -> bool {
        self.record.is_some()
    }

    /// Whether the record is one of the motions judged on, from its beginning to its end.
    pub fn has_whole_record(&self) -> bool {
        self.record.as_ref().is_some_and(|trial| !trial.overturns)
    }

    /// The error of springs on every suite.
    pub fn accuracy(&self, springs: &Springs<Chain<f64>>, control: Control) -> Accuracy {
        let mut accuracy = Accuracy::default();
        JudgedOn::ALL.iter().for_each(|suite| self.measure(*suite, springs, control, &mut accuracy));
        accuracy
    }

    /// Add the error of springs on one suite to what was measured.
    pub fn measure(&self, suite: JudgedOn, springs: &Springs<Chain<f64>>, control: Control, accuracy: &mut Accuracy) {
        let errors = |trials: &[Trial]| errors(trials, &self.body, springs, control);
        let statistic = |value: Option<f64>, count| value.map(|value| Statistic { value, count });
        match suite {
            JudgedOn::Record => {
                accuracy.record = errors(self.record.as_slice()).first().map(|(u, v)| u.max(*v));
            }
            JudgedOn::Synthetic => {
                let mut sorted: Vec<f64> = errors(&self.synthetic).iter().map(|e| e.0).collect();
                sorted.sort_by(f64::total_cmp);
                accuracy.synthetic_median = statistic(quantile(&sorted, 0.5), sorted.len());
                accuracy.synthetic_p90 = statistic(quantile(&sorted, 0.9), sorted.len());
            }
            JudgedOn::Earthquakes => {
                let errors = errors(&self.earthquakes);
                let found = geometric_mean(errors.iter().map(|e| e.0));
                accuracy.earthquakes_mean = statistic(found.map(|(mean, _)| mean), errors.len());
                accuracy.earthquakes_scaled_down = self.scaled_down;
                accuracy.earthquakes_upper = found.map(|(mean, factor)| mean * factor.powi(ERRORS));
            }
        }
    }

    /// The error on the record, or the median of the synthetic motions where it cannot be followed: one number for a figure.
    pub fn error(&self, springs: &Springs<Chain<f64>>, control: Control) -> Option<f64> {
        let trials = if self.has_record() { self.record.as_slice() } else { &self.synthetic };
        let mut errors: Vec<f64> = errors(trials, &self.body, springs, control).iter().map(|e| e.0).collect();
        errors.sort_by(f64::total_cmp);
        quantile(&errors, 0.5)
    }
}

/// The q-quantile of sorted numbers, linear between the two nearest ranks; infinite if it falls on an infinite one.
pub(super) fn quantile(sorted: &[f64], q: f64) -> Option<f64> {
    let rank = q * sorted.len().checked_sub(1)? as f64;
    let (low, share) = (rank.floor() as usize, rank.fract());
    Some(if share == 0.0 { sorted[low] } else { sorted[low] * (1.0 - share) + sorted[low + 1] * share })
}

/// Geometric mean, and the factor of its standard error; a history that lost the motion altogether counts as one that stands
/// still, lest one decide for all. A factor of e is the spread that few motions are taken to have: it counts as one of them.
fn geometric_mean(errors: impl ExactSizeIterator<Item = f64> + Clone) -> Option<(f64, f64)> {
    let n = errors.len() as f64;
    let logarithms = errors.map(|e| e.clamp(1e-12, 1.0).ln());
    let mean = logarithms.clone().sum::<f64>() / n;
    let variance = (1.0 + logarithms.map(|x| (x - mean).powi(2)).sum::<f64>()) / n;
    (n > 0.0).then(|| (mean.exp(), (variance / n).sqrt().exp()))
}

/// An earthquake-like motion scaled down: its acceleration, of all that these motions may have, becomes as much of [`MILD`]; `None` where that would
/// not be less.
fn milder(motion: Record, alpha: f64) -> Option<Record> {
    let (least, most) = synthetic::EARTHQUAKE_PGA_G;
    let pga = motion.pga_g();
    let share = (pga - least) / (most - least);
    let factor = alpha.tan() * (MILD.0 + share * (MILD.1 - MILD.0)) / pga;
    if factor < 1.0 { motion.scaled(factor).ok() } else { None }
}

/// The first `count` of these motions of a suite that `pick` finds fit; fewer if there are no more.
fn first(count: usize, motions: Range<usize>, pick: impl Fn(usize) -> Option<Trial> + Sync) -> Vec<Trial> {
    let mut trials: Vec<Trial> = Vec::new();
    let mut begin = motions.start;
    while trials.len() < count && begin < motions.end {
        let end = (begin + (count - trials.len()).max(AT_A_TIME)).min(motions.end);
        trials.par_extend((begin..end).into_par_iter().with_max_len(1).filter_map(&pick));
        begin = end;
    }
    trials.truncate(count);
    trials
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
        // the mean of the earthquake-like motions is within 5 times as much, with its standard errors it is not
        assert!(accuracy.reaches(2e-3) && !accuracy.reaches(1.7e-3));
        assert_eq!(Accuracy::default().over(2e-3), 0.0);
        // half of them scaled down: sqrt(5) times as much
        let scaled = Accuracy { earthquakes_scaled_down: 15, ..accuracy };
        assert!((scaled.looser_on_earthquakes() - 5f64.sqrt()).abs() < 1e-12 && !scaled.reaches(2e-3));
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
