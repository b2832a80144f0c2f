//! A motion with Housner's answer to it, and how far springs are from that.

use std::{borrow::Cow, ops::ControlFlow, sync::Arc};

use dynamics::{
    effort::Effort,
    fem::{Analysis, Change, Control, Finish, HistoryOutcome, Observer, View, histories},
    spring::{Chain, Springs},
};
use rocking::{
    conditioning::{CHANGES, ILL_CONDITIONED, changes, moved_by_width, sensitivity},
    housner::{self, Rocking, RockingOptions},
    motion::samples_until,
    regime,
    structure::Body,
};
use strong_motion::Record;
use validation::{
    ComparisonObserver, HousnerForces, PREDICTABLE, PeakErrors, effective_acceleration,
};

/// A relative change of the width that must not move a predictable history by more than so many
/// times what its sensitivity may.
const SMALL_CHANGE: f64 = 1e-6;
const MOST_OVER_SENSITIVITY: f64 = 4.0;

/// The errors of one history.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrialErrors {
    /// NRMSE of u and of v.
    pub u: f64,
    pub v: f64,
    pub peaks: PeakErrors,
}

/// The errors of a history that says nothing.
const LOST: TrialErrors =
    TrialErrors { u: f64::INFINITY, v: f64::INFINITY, peaks: PeakErrors::LOST };

/// A motion and Housner's answer to it.
#[derive(Clone, Debug)]
pub(super) struct ReferenceMotion {
    pub dt: f64,
    pub accel: Vec<f64>,
    vertical: Option<Arc<[f64]>>,
    /// Housner's rotations at the samples, up to overturning if he overturns (rad).
    theta: Vec<f64>,
    /// The ground's forces on it.
    forces: HousnerForces,
    pub overturns: bool,
}

/// What a motion must be like to be judged on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum WantedMotion {
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
    pub(super) fn new(
        body: &Body<f64>,
        restitution: f64,
        record: Record,
        wanted: WantedMotion,
    ) -> Option<Self> {
        let options = RockingOptions::on(&record, restitution);
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

    fn effective_acceleration(&self) -> Cow<'_, [f64]> {
        effective_acceleration(&self.accel, self.vertical.as_deref().unwrap_or_default())
    }

    fn case(&self, body: &Body<f64>, springs: &Springs<Chain>, control: Control) -> Analysis<'_> {
        Analysis {
            vertical: self.vertical.as_deref().unwrap_or_default(),
            control,
            ..Analysis::new(*body, *springs, self.dt, &self.accel)
        }
    }
}

/// The errors on these springs, of each trial, of a body that overturns up to then; infinite if the
/// history does not get to the record's end, or one body overturns and the other does not.
pub(super) fn errors(
    trials: &[ReferenceMotion],
    body: &Body<f64>,
    springs: &Springs<Chain>,
    (control, effort): (Control, &Effort),
) -> Vec<TrialErrors> {
    let effective: Vec<Cow<[f64]>> =
        trials.iter().map(ReferenceMotion::effective_acceleration).collect();
    let cases: Vec<Analysis> =
        trials.iter().map(|trial| trial.case(body, springs, control)).collect();
    let followed = histories(&cases, |i| {
        ComparisonObserver::new(body, &trials[i].theta, &effective[i])
            .with_forces(&trials[i].forces)
    });
    let error = |((stream, finish), trial): ((ComparisonObserver, Finish), _)| {
        TrialErrors::of(trial, (&stream, &finish), effort)
    };
    followed.into_iter().zip(trials).map(error).collect()
}

/// The errors on one trial, with a second observer of the same history.
pub(super) fn errors_watched(
    trial: &ReferenceMotion,
    body: &Body<f64>,
    springs: &Springs<Chain>,
    (control, effort): (Control, &Effort),
    watch: &mut dyn Observer,
) -> TrialErrors {
    let effective = trial.effective_acceleration();
    let stream = ComparisonObserver::new(body, &trial.theta, &effective).with_forces(&trial.forces);
    let mut both = WatchedComparison { stream, watch };
    let finish = trial.case(body, springs, control).observe(&mut both);
    TrialErrors::of(trial, (&both.stream, &finish), effort)
}

/// Compares a history, and shows it to another observer, who decides how long it is followed.
struct WatchedComparison<'a, 'w> {
    stream: ComparisonObserver<'a>,
    watch: &'w mut dyn Observer,
}

impl Observer for WatchedComparison<'_, '_> {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        // a body that falls has toppled at the end, too
        let _ = self.stream.sample(index, view);
        self.watch.sample(index, view)
    }

    fn step(&mut self, view: &View) {
        self.watch.step(view);
    }

    fn event(&mut self, index: usize, change: Change, view: &View) {
        self.stream.event(index, change, view);
        self.watch.event(index, change, view);
    }
}

impl TrialErrors {
    /// Of a history that was followed so, on a motion.
    fn of(
        trial: &ReferenceMotion,
        (stream, finish): (&ComparisonObserver, &Finish),
        effort: &Effort,
    ) -> Self {
        finish.spend(effort);
        effort.judged(matches!(finish.outcome, HistoryOutcome::WorkBound { .. }));
        let Some(overturned) = stream.overturned(finish.outcome) else { return LOST };
        if overturned != trial.overturns {
            return LOST;
        }
        let errors = if overturned { &stream.upright } else { &stream.errors };
        Self {
            u: errors.horizontal.value(),
            v: errors.vertical.value(),
            peaks: errors.peaks.errors(),
        }
    }
}
