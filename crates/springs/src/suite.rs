//! What springs are judged on: the record at hand where it can be followed, synthetic motions made
//! for the structure, and earthquake-like motions of real frequencies.
//!
//! Housner's answers are found once; the springs of every Omega_n are judged against them.

mod accuracy;
mod reference;

use std::ops::Range;

pub use accuracy::LOOSER;
pub(super) use accuracy::quantile;
pub use accuracy::{Accuracy, JudgedOn, MeasuredErrors, PeakAccuracy, Statistic};
use accuracy::{ERRORS, geometric_mean};
use reference::{ReferenceMotion, TrialErrors, WantedMotion, errors, errors_watched};

use crate::landing_simulation::differs_from_housner;
use cases::Yardstick;
use dynamics::{
    effort::Effort,
    fem::{Control, Observer},
    spring::{Chain, Springs},
};
use rocking::{structure::Body, synthetic};
use strong_motion::Record;
use validation::PeakErrors;

/// Motions of each suite that are followed.
const SYNTHETIC: usize = 24;
const EARTHQUAKES: usize = 16;
/// Earthquake-like motions that topple a structure, or cannot be foretold for it, are scaled down
/// to so many times the acceleration that lifts it.
const MILD: (f64, f64) = (1.2, 6.0);
/// Candidates tried to find them.
const LOOKED_AT: usize = 480;
/// Candidates tried in one parallel batch.
const AT_A_TIME: usize = 8;
/// Further motions, where the first do not separate two designs: kept; candidates tried.
const MORE: usize = 72;
const MORE_LOOKED_AT: usize = 480;
/// Seed of all motions by which a run chooses springs: not one that `tune validate` takes by
/// itself.
pub const SEED: u64 = 1940;

/// All motions that springs of a body are judged on.
#[derive(Clone, Debug)]
pub struct Suites {
    body: Body<f64>,
    /// Velocity restitution of its landings.
    restitution: f64,
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
        let (p, alpha) = (body.p(), body.alpha());
        let fit = |record, wanted| ReferenceMotion::new(body, restitution, record, wanted);
        let earthquake = |i| synthetic::earthquake(seed, i, p);
        let as_they_are = || {
            let pick = |i| fit(earthquake(i), WantedMotion::Predictable);
            first(EARTHQUAKES, 0..LOOKED_AT, effort, pick)
        };
        let synthetic = || {
            let motion = |i| synthetic::record(seed, i, p, alpha);
            let pick = |i| fit(motion(i), WantedMotion::WellConditioned);
            first(SYNTHETIC, 0..LOOKED_AT, effort, pick)
        };
        // side by side: the last motion of a batch leaves a core to the other suite
        let (mut earthquakes, synthetic) = parallel::join(as_they_are, synthetic);
        let missing = EARTHQUAKES - earthquakes.len();
        let mild = first(missing, 0..LOOKED_AT, effort, |i| {
            fit(milder(earthquake(i), alpha)?, WantedMotion::PredictableWhileItStands)
        });
        let scaled_down = mild.len();
        earthquakes.extend(mild);
        Self {
            body: *body,
            restitution,
            record: record
                .and_then(|record| fit(record.clone(), WantedMotion::WellConditionedWhileItStands)),
            synthetic,
            earthquakes,
            scaled_down,
        }
    }

    /// More synthetic motions, none of which is one of these, to tell springs apart on which these
    /// do not decide; nothing else.
    pub(crate) fn more(&self, restitution: f64, effort: &Effort) -> Self {
        let (p, alpha) = (self.body.p(), self.body.alpha());
        let well = |record| {
            ReferenceMotion::new(&self.body, restitution, record, WantedMotion::WellConditioned)
        };
        let others = LOOKED_AT..LOOKED_AT + MORE_LOOKED_AT;
        Self {
            body: self.body,
            restitution,
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

    /// The restitution that the motions were followed with, if it is not equation 2's.
    pub(crate) fn another_restitution(&self) -> Option<f64> {
        let other = differs_from_housner(&self.body, self.restitution);
        other.then_some(self.restitution)
    }

    /// Whether the record is one of the motions judged on.
    pub fn has_record(&self) -> bool {
        self.record.is_some()
    }

    /// Whether the record is one of the motions judged on, from its beginning to its end.
    pub fn has_whole_record(&self) -> bool {
        self.record.as_ref().is_some_and(|trial| !trial.overturns)
    }

    /// The error of springs on every suite, its work counted; nothing more is measured once it is
    /// stopped from outside.
    pub fn accuracy(
        &self,
        springs: &Springs<Chain>,
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
        springs: &Springs<Chain>,
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
    pub fn error(&self, springs: &Springs<Chain>, control: Control) -> Option<f64> {
        self.error_by(Yardstick::Histories, springs, control)
    }

    /// The error of the history on the record, which another observer sees, too; none of a record
    /// that is not judged on from its beginning to its end, which is then not followed.
    pub fn error_on_whole_record(
        &self,
        springs: &Springs<Chain>,
        control: Control,
        watch: &mut dyn Observer,
    ) -> Option<f64> {
        let trial = self.record.as_ref().filter(|trial| !trial.overturns)?;
        let effort = Effort::unbounded();
        Some(errors_watched(trial, &self.body, springs, (control, &effort), watch).u)
    }

    /// The same by a yardstick.
    pub(crate) fn error_by(
        &self,
        yardstick: Yardstick,
        springs: &Springs<Chain>,
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
        trials.extend(parallel::map_range(begin..end, &pick).into_iter().flatten());
        begin = end;
    }
    trials.truncate(count);
    trials
}
