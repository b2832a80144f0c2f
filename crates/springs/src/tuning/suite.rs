//! What springs are judged on: the record at hand where it can be followed, synthetic motions made
//! for the structure, and earthquake-like motions of real frequencies.
//!
//! Housner's answers are found once; the springs of every Omega_n are judged against them.

mod accuracy;

use std::{borrow::Cow, ops::Range, sync::Arc};

use rayon::prelude::*;

pub use accuracy::LOOSER;
pub(super) use accuracy::quantile;
pub use accuracy::{Accuracy, JudgedOn, MeasuredErrors, PeakAccuracy, Statistic};
use accuracy::{ERRORS, geometric_mean};

use crate::{
    case::Yardstick,
    validate::{ComparisonObserver, HousnerForces, PREDICTABLE, PeakErrors, push},
};
use dynamics::{
    effort::Effort,
    fem::{Analysis, Control, Finish, HistoryOutcome, Start, histories},
    spring::{Chain, Springs},
};
use rocking::{
    conditioning::{CHANGES, ILL_CONDITIONED, changes, moved_by_width, sensitivity},
    housner::{self, Rocking, RockingOptions},
    overturning::samples_until,
    regime,
    structure::Body,
    synthetic,
};
use strong_motion::Record;

/// Motions of each suite that are followed.
const SYNTHETIC: usize = 24;
const EARTHQUAKES: usize = 16;
/// Earthquake-like motions that topple a structure, or cannot be foretold for it, are scaled down
/// to so many times the acceleration that lifts it.
const MILD: (f64, f64) = (1.2, 6.0);
/// Motions of each suite that are looked at for them, so many at a time.
const LOOKED_AT: usize = 480;
/// The same of the motions that decide between springs which these do not tell apart.
const MORE: usize = 72;
const MORE_LOOKED_AT: usize = 480;
const AT_A_TIME: usize = 8;
/// Seed of both: not one that `tune validate` takes by itself.
const SEED: u64 = 1940;
/// A relative change of the width that must not move a predictable history by more than so many
/// times what its sensitivity may.
const SMALL_CHANGE: f64 = 1e-6;
const MOST_OVER_SENSITIVITY: f64 = 4.0;

/// The errors of one history.
#[derive(Clone, Copy, Debug)]
struct TrialErrors {
    /// NRMSE of u and of v.
    u: f64,
    v: f64,
    peaks: PeakErrors,
}

/// The errors of a history that says nothing.
const LOST: TrialErrors =
    TrialErrors { u: f64::INFINITY, v: f64::INFINITY, peaks: PeakErrors::LOST };

/// A motion and Housner's answer to it.
#[derive(Clone, Debug)]
pub(crate) struct ReferenceMotion {
    dt: f64,
    accel: Vec<f64>,
    vertical: Option<Arc<[f64]>>,
    /// Housner's rotations at the samples, up to overturning if he overturns (rad).
    theta: Vec<f64>,
    /// The ground's forces on it.
    forces: HousnerForces,
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
    fn holds(
        self,
        body: &Body<f64>,
        record: &Record,
        options: &RockingOptions<f64>,
        rocking: &Rocking<f64>,
    ) -> bool {
        let Record { dt, ref accel, .. } = *record;
        let by_width =
            |change: f64| moved_by_width(body, dt, accel, options, rocking, change) / change;
        let worst = || sensitivity(body, dt, accel, options).worst();
        match self {
            Self::WellConditioned | Self::WellConditionedWhileItStands => {
                by_width(CHANGES[1]) < ILL_CONDITIONED
                    && worst() < ILL_CONDITIONED
                    && changes(body, dt, accel, options).proportionate()
            }
            Self::Predictable | Self::PredictableWhileItStands => {
                by_width(SMALL_CHANGE) < MOST_OVER_SENSITIVITY * PREDICTABLE
                    && worst() < PREDICTABLE
            }
        }
    }
}

impl ReferenceMotion {
    /// The motion, if Housner's body rocks on it, on a pivot that presses, and its history is as
    /// wanted.
    fn new(
        body: &Body<f64>,
        restitution: f64,
        record: Record,
        wanted: WantedMotion,
    ) -> Option<Self> {
        let vertical = record.vertical_accel();
        let options = RockingOptions {
            restitution: Some(restitution),
            vertical,
            ..RockingOptions::default()
        };
        let rocking = housner::solve(body, record.dt, &record.accel, &options);
        let overturned = rocking.overturned().filter(|_| wanted.may_topple());
        let rocks = rocking.outcome == housner::RockingOutcome::Rocked || overturned.is_some();
        let presses = || regime::pivot_pulls(body, record.dt, &record.accel, &rocking).is_none();
        let lands = !rocking.impacts.is_empty();
        let fit = rocks && lands && wanted.holds(body, &record, &options, &rocking) && presses();
        fit.then(|| {
            let forces =
                HousnerForces::new(body, record.dt, (&record.accel, record.up()), &rocking);
            let Record { dt, accel, .. } = record;
            let mut theta = rocking.theta;
            theta.truncate(samples_until(overturned, dt));
            Self {
                dt,
                accel,
                vertical: options.vertical,
                theta,
                forces,
                overturns: overturned.is_some(),
            }
        })
    }

    fn push(&self) -> Cow<'_, [f64]> {
        push(&self.accel, self.vertical.as_deref().unwrap_or_default())
    }

    fn case(
        &self,
        body: &Body<f64>,
        springs: &Springs<Chain<f64>>,
        control: Control,
    ) -> Analysis<'_, f64> {
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

/// The errors on these springs, of each trial, of a body that overturns up to then; infinite if the
/// history does not get to the record's end, or one body overturns and the other does not.
fn errors(
    trials: &[ReferenceMotion],
    body: &Body<f64>,
    springs: &Springs<Chain<f64>>,
    (control, effort): (Control, &Effort),
) -> Vec<TrialErrors> {
    let pushes: Vec<Cow<[f64]>> = trials.iter().map(ReferenceMotion::push).collect();
    let cases: Vec<Analysis<f64>> =
        trials.iter().map(|trial| trial.case(body, springs, control)).collect();
    let followed = histories(&cases, |i| {
        ComparisonObserver::new(body, &trials[i].theta, &pushes[i]).with_forces(&trials[i].forces)
    });
    let error =
        |((stream, finish), trial): ((ComparisonObserver, Finish<f64>), &ReferenceMotion)| {
            finish.spend(effort);
            effort.judged(matches!(finish.outcome, HistoryOutcome::WorkBound { .. }));
            let overturned = match finish.outcome {
                HistoryOutcome::Completed => housner::topples(body, stream.last.0, stream.last.1),
                HistoryOutcome::Overturned { .. } | HistoryOutcome::Stopped { .. } => true,
                _ => return LOST,
            };
            if overturned != trial.overturns {
                return LOST;
            }
            let errors = if overturned { stream.upright } else { stream.errors };
            TrialErrors {
                u: errors.horizontal.value(),
                v: errors.vertical.value(),
                peaks: errors.peaks.errors(),
            }
        };
    followed.into_iter().zip(trials).map(error).collect()
}

/// All motions that springs of a body are judged on.
#[derive(Clone, Debug)]
pub struct Suites {
    body: Body<f64>,
    record: Option<ReferenceMotion>,
    synthetic: Vec<ReferenceMotion>,
    earthquakes: Vec<ReferenceMotion>,
    /// How many of the earthquakes, the last ones, are scaled down.
    scaled_down: usize,
}

impl Suites {
    /// Of a body that lands with velocity restitution `restitution`, with this record if there is
    /// one: as many motions as are found before it is stopped from outside.
    pub(crate) fn within(
        body: &Body<f64>,
        restitution: f64,
        record: Option<&Record>,
        effort: &Effort,
    ) -> Self {
        Self::seeded(SEED, body, restitution, record, effort)
    }

    /// The same of other motions.
    pub fn of_seed(seed: u64, body: &Body<f64>, restitution: f64, record: Option<&Record>) -> Self {
        Self::seeded(seed, body, restitution, record, &Effort::unbounded())
    }

    fn seeded(
        seed: u64,
        body: &Body<f64>,
        restitution: f64,
        record: Option<&Record>,
        effort: &Effort,
    ) -> Self {
        let (p, alpha) = (body.p_squared().sqrt(), body.alpha());
        let well =
            |record| ReferenceMotion::new(body, restitution, record, WantedMotion::WellConditioned);
        let standing = |record| {
            ReferenceMotion::new(
                body,
                restitution,
                record,
                WantedMotion::WellConditionedWhileItStands,
            )
        };
        let predictable =
            |record| ReferenceMotion::new(body, restitution, record, WantedMotion::Predictable);
        let mild = |record| {
            ReferenceMotion::new(body, restitution, record, WantedMotion::PredictableWhileItStands)
        };
        let earthquake = |i| synthetic::earthquake(seed, i, p);
        let mut earthquakes =
            first(EARTHQUAKES, 0..LOOKED_AT, effort, |i| predictable(earthquake(i)));
        let missing = EARTHQUAKES - earthquakes.len();
        let mild = first(missing, 0..LOOKED_AT, effort, |i| mild(milder(earthquake(i), alpha)?));
        let scaled_down = mild.len();
        earthquakes.extend(mild);
        Self {
            body: *body,
            record: record.and_then(|record| standing(record.clone())),
            synthetic: first(SYNTHETIC, 0..LOOKED_AT, effort, |i| {
                well(synthetic::record(seed, i, p, alpha))
            }),
            earthquakes,
            scaled_down,
        }
    }

    /// More synthetic motions, none of which is one of these, to tell springs apart on which these
    /// do not decide; nothing else.
    pub(crate) fn more(&self, restitution: f64, effort: &Effort) -> Self {
        let (p, alpha) = (self.body.p_squared().sqrt(), self.body.alpha());
        let well = |record| {
            ReferenceMotion::new(&self.body, restitution, record, WantedMotion::WellConditioned)
        };
        let others = LOOKED_AT..LOOKED_AT + MORE_LOOKED_AT;
        Self {
            body: self.body,
            record: None,
            synthetic: first(MORE, others, effort, |i| well(synthetic::record(SEED, i, p, alpha))),
            earthquakes: Vec::new(),
            scaled_down: 0,
        }
    }

    /// Sampling intervals (s) and ground accelerations (m/s2) of the motions of a suite.
    pub(crate) fn motions(&self, on: JudgedOn) -> impl Iterator<Item = (f64, &[f64])> {
        let trials = match on {
            JudgedOn::Record => self.record.as_slice(),
            JudgedOn::Synthetic => &self.synthetic,
            JudgedOn::Earthquakes => &self.earthquakes,
        };
        trials.iter().map(|trial| (trial.dt, trial.accel.as_slice()))
    }

    /// Whether the record is one of the motions judged on.
    pub fn has_record(&self) -> bool {
        self.record.is_some()
    }

    /// Whether the record is one of the motions judged on, from its beginning to its end.
    pub(crate) fn has_whole_record(&self) -> bool {
        self.record.as_ref().is_some_and(|trial| !trial.overturns)
    }

    /// The error of springs on every suite.
    pub fn accuracy(&self, springs: &Springs<Chain<f64>>, control: Control) -> MeasuredErrors {
        self.accuracy_within(springs, (control, &Effort::unbounded()))
    }

    /// The same, its work counted; nothing more is measured once it is stopped from outside.
    pub(crate) fn accuracy_within(
        &self,
        springs: &Springs<Chain<f64>>,
        (control, effort): (Control, &Effort),
    ) -> MeasuredErrors {
        let mut measured = MeasuredErrors::default();
        for suite in JudgedOn::ALL {
            if !effort.stopped() {
                self.measure(suite, springs, (control, effort), &mut measured);
            }
        }
        measured
    }

    /// Add the error of springs on one suite to what was measured.
    pub(crate) fn measure(
        &self,
        suite: JudgedOn,
        springs: &Springs<Chain<f64>>,
        (control, effort): (Control, &Effort),
        measured: &mut MeasuredErrors,
    ) {
        let MeasuredErrors { histories, peaks } = measured;
        match suite {
            JudgedOn::Record => {
                if let Some(found) =
                    errors(self.record.as_slice(), &self.body, springs, (control, effort)).first()
                {
                    histories.record = Some(found.u.max(found.v));
                    peaks.largest.record = Some(found.peaks.largest());
                    peaks.record = Some(found.peaks);
                }
            }
            JudgedOn::Synthetic => {
                let found = errors(&self.synthetic, &self.body, springs, (control, effort));
                quantiles(&found, |e| e.u, histories);
                quantiles(&found, |e| e.peaks.largest(), &mut peaks.largest);
                let median = |i: usize| quantile(&sorted(&found, |e| e.peaks.all()[i]), 0.5);
                peaks.synthetic_median = each(median);
            }
            JudgedOn::Earthquakes => {
                let found = errors(&self.earthquakes, &self.body, springs, (control, effort));
                self.means(&found, |e| e.u, histories);
                self.means(&found, |e| e.peaks.largest(), &mut peaks.largest);
                let mean = |i: usize| {
                    geometric_mean(found.iter().map(|e| e.peaks.all()[i])).map(|(mean, _)| mean)
                };
                peaks.earthquakes_mean = each(mean);
            }
        }
    }

    fn means(
        &self,
        found: &[TrialErrors],
        of: impl Fn(&TrialErrors) -> f64 + Clone,
        accuracy: &mut Accuracy,
    ) {
        let mean = geometric_mean(found.iter().map(of));
        accuracy.earthquakes_mean = mean.map(|(value, _)| Statistic { value, count: found.len() });
        accuracy.earthquakes_scaled_down = self.scaled_down;
        accuracy.earthquakes_upper = mean.map(|(mean, factor)| mean * factor.powi(ERRORS));
    }

    /// The error of histories on the record, or the median of the synthetic motions where it cannot
    /// be followed: one number for a figure.
    pub fn error(&self, springs: &Springs<Chain<f64>>, control: Control) -> Option<f64> {
        self.error_by(Yardstick::Histories, springs, control)
    }

    /// The same by a yardstick.
    pub(crate) fn error_by(
        &self,
        yardstick: Yardstick,
        springs: &Springs<Chain<f64>>,
        control: Control,
    ) -> Option<f64> {
        let trials = if self.has_record() { self.record.as_slice() } else { &self.synthetic };
        let of = |e: &TrialErrors| match yardstick {
            Yardstick::Histories => e.u,
            Yardstick::Peaks => e.peaks.largest(),
        };
        let found = errors(trials, &self.body, springs, (control, &Effort::unbounded()));
        quantile(&sorted(&found, of), 0.5)
    }
}

fn sorted(found: &[TrialErrors], of: impl Fn(&TrialErrors) -> f64) -> Vec<f64> {
    let mut all: Vec<f64> = found.iter().map(of).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn quantiles(found: &[TrialErrors], of: impl Fn(&TrialErrors) -> f64, accuracy: &mut Accuracy) {
    let sorted = sorted(found, of);
    let statistic =
        |q: f64| quantile(&sorted, q).map(|value| Statistic { value, count: sorted.len() });
    (accuracy.synthetic_median, accuracy.synthetic_p90) = (statistic(0.5), statistic(0.9));
}

/// A number of every peak; `None` of none.
fn each(number: impl Fn(usize) -> Option<f64>) -> Option<PeakErrors> {
    Some(PeakErrors::of([number(0)?, number(1)?, number(2)?, number(3)?]))
}

/// An earthquake-like motion scaled down: its acceleration, of all that these motions may have,
/// becomes as much of [`MILD`]; `None` where that would not be less.
fn milder(motion: Record, alpha: f64) -> Option<Record> {
    let (least, most) = synthetic::EARTHQUAKE_PGA_G;
    let pga = motion.pga_g();
    let share = (pga - least) / (most - least);
    let factor = alpha.tan() * (MILD.0 + share * (MILD.1 - MILD.0)) / pga;
    if factor < 1.0 { motion.scaled(factor).ok() } else { None }
}

/// The first `count` of these motions of a suite that `pick` finds fit; fewer if there are no more.
fn first(
    count: usize,
    motions: Range<usize>,
    effort: &Effort,
    pick: impl Fn(usize) -> Option<ReferenceMotion> + Sync,
) -> Vec<ReferenceMotion> {
    let mut trials: Vec<ReferenceMotion> = Vec::new();
    let mut begin = motions.start;
    while trials.len() < count && begin < motions.end && !effort.stopped() {
        let end = (begin + (count - trials.len()).max(AT_A_TIME)).min(motions.end);
        trials.par_extend((begin..end).into_par_iter().with_max_len(1).filter_map(&pick));
        begin = end;
    }
    trials.truncate(count);
    trials
}
