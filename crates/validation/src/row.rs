//! One record under both models.

use std::{borrow::Cow, f64::consts::FRAC_PI_2};

use serde::Serialize;

use super::{HousnerForces, JudgedModel, Validator, stream::ComparisonObserver};
use dynamics::{
    fem,
    spring::{Chain, Springs},
};
use rocking::{
    conditioning::{Conditioning, SLIGHT_CHANGE},
    housner,
    motion::{largest_magnitude, samples_until},
    regime,
};
use strong_motion::{Record, Source};

/// Whether the two models could be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RecordOutcome {
    /// Housner's body rocked without overturning.
    Rocked,
    /// Housner's body overturned.
    Overturned,
    /// The record never lifts Housner's body: there is no history to compare with.
    NeverLifted,
    /// Housner's solution met its bound on work or a number that is not finite.
    HousnerFailed,
    /// The finite element history met its bound on work or a number that is not finite, or the
    /// program that is emulated gave up.
    FemFailed,
}

/// Which set of records a record belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Suite {
    /// Of files, or of numbers from elsewhere.
    Files,
    /// Made for the structure.
    Synthetic,
    /// Made with the frequencies of earthquakes.
    Earthquakes,
}

impl From<&Source> for Suite {
    fn from(source: &Source) -> Self {
        match source {
            Source::Numbers | Source::Embedded | Source::File { .. } => Self::Files,
            Source::Synthetic => Self::Synthetic,
            Source::Earthquake => Self::Earthquakes,
        }
    }
}

/// What is kept of a record. Options are empty (`null` in JSON) where there is no such number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The record's name.
    pub name: String,
    /// What became of both histories: whether they could be compared, or which model failed.
    pub outcome: RecordOutcome,
    /// Length compared: up to the end of the shorter history, and to the first overturning (s).
    pub duration_s: f64,
    /// Peak ground acceleration, scaled as compared (g).
    pub pga_g: f64,
    /// Relative change of Housner's u per relative change of width or record scale, whichever is
    /// worse.
    pub sensitivity: f64,
    /// NRMSE of the horizontal displacement: sqrt( sum (u - u_H)^2 / sum u_H^2 ), u_H Housner's, up
    /// to the first overturning; none if the record never lifts the body or a model failed.
    pub nrmse_horizontal: Option<f64>,
    /// NRMSE of the vertical displacement v, from the settled position; none where
    /// `nrmse_horizontal` is.
    pub nrmse_vertical: Option<f64>,
    /// Peak |theta|/alpha of Housner's body at the samples; pi/2 / alpha if it toppled.
    pub peak_ratio_housner: f64,
    /// Peak |theta|/alpha of the finite elements while a foot is off the ground; pi/2 / alpha if
    /// they toppled; none if the history failed.
    pub peak_ratio_fem: Option<f64>,
    /// Whether Housner's body overturned.
    pub overturned_housner: bool,
    /// Whether the finite elements overturned; none if their history failed.
    pub overturned_fem: Option<bool>,
    /// Impacts of Housner's body.
    pub impacts: usize,
    /// Largest |residual| of the finite element model's energy account over the largest energy of
    /// the history; none of steps of one size, which have no such account.
    pub energy_residual: Option<f64>,
    /// Where the record comes from.
    pub suite: Suite,
    /// By the derivative and by finite changes; false if the record never lifts Housner's body.
    pub well_conditioned: bool,
    /// How far a change of 0.1 % in width or scale, whichever is worse, moves Housner's u, relative
    /// to it.
    pub moved_by_0_1_percent: f64,
    /// How far a change of 1 % in width or scale, whichever is worse, moves Housner's u, relative
    /// to it.
    pub moved_by_1_percent: f64,
    /// How far a change of 0.1 % in restitution moves Housner's u, relative to it.
    pub moved_by_0_1_percent_of_restitution: f64,
    /// As `peak_ratio_housner`, with a restitution smaller by 1e-5 of it.
    pub peak_ratio_housner_changed: f64,
    /// Whether Housner's body overturned with that restitution.
    pub overturned_housner_changed: bool,
    /// When Housner's pivot would first have to hold the body down (s); none if it presses
    /// throughout. A foot lifts there, and rocking does not hold any more.
    pub pivot_pulls_s: Option<f64>,
    /// Relative error of the largest |u|; this and the next ones are none where `nrmse_horizontal`
    /// is.
    pub displacement_error: Option<f64>,
    /// Relative error of the largest uplift of a foot.
    pub uplift_error: Option<f64>,
    /// Relative error of the largest base shear between landings; this and the next are none of
    /// steps of one size, too.
    pub base_shear_error: Option<f64>,
    /// Relative error of the largest vertical force of the ground between landings.
    pub axial_error: Option<f64>,
}

impl Row {
    /// Whether one of the models failed.
    pub fn failed(&self) -> bool {
        matches!(self.outcome, RecordOutcome::HousnerFailed | RecordOutcome::FemFailed)
    }

    /// The largest of the peaks' errors; of steps of one size, which have no energy account,
    /// without those of forces.
    pub(crate) fn peak_error(&self) -> Option<f64> {
        let displacements = self.displacement_error?.max(self.uplift_error?);
        if self.energy_residual.is_none() {
            return Some(displacements);
        }
        Some(displacements.max(self.base_shear_error?).max(self.axial_error?))
    }

    /// Whether Housner's body rocked without toppling and its history is well conditioned: NRMSE
    /// means something one to one.
    pub fn comparable(&self) -> bool {
        self.rocked() && self.well_conditioned
    }

    /// Whether Housner's body rocked without toppling, and on a pivot that never had to pull. A
    /// body that was never lifted did not, whatever became of the finite elements.
    pub(crate) fn rocked(&self) -> bool {
        let rocked = matches!(self.outcome, RecordOutcome::Rocked | RecordOutcome::FemFailed);
        let lifted = self.peak_ratio_housner > 0.0;
        rocked && lifted && !self.overturned_housner && self.pivot_pulls_s.is_none()
    }

    /// The NRMSE of a row: at least 1 where one body topples and the other does not, however long
    /// they went together.
    pub(crate) fn error(&self, nrmse: Option<f64>) -> Option<f64> {
        if self.agrees() { nrmse } else { nrmse.map(|x| x.max(1.0)) }
    }

    /// Whether both models say the same of overturning.
    pub(crate) fn agrees(&self) -> bool {
        !self.failed() && self.overturned_fem == Some(self.overturned_housner)
    }
}

/// Housner's answer to a record.
pub(crate) struct HousnerAnswer<'a> {
    pub(crate) record: Cow<'a, Record>,
    options: housner::RockingOptions<f64>,
    rocking: housner::Rocking<f64>,
    forces: HousnerForces,
    conditioning: Option<Conditioning>,
}

/// How a history on springs ended.
pub(crate) struct HistoryEnd {
    /// Whether it overturned; none if it failed.
    pub(crate) overturned: Option<bool>,
    /// As [`Row::energy_residual`].
    pub(crate) energy_residual: Option<f64>,
}

impl HistoryEnd {
    fn of(stream: &ComparisonObserver, finish: &fem::Finish) -> Self {
        let overturned = stream.overturned(finish.outcome);
        let residual = stream.residual / finish.energy_scale;
        let energy_residual = (!residual.is_nan()).then(|| residual.min(f64::MAX));
        Self { overturned, energy_residual }
    }
}

impl HousnerAnswer<'_> {
    /// His rotations until the body lies.
    pub(crate) fn standing(&self) -> &[f64] {
        let Self { record, rocking, .. } = self;
        let samples = samples_until(rocking.overturned(), record.dt);
        &rocking.theta[..samples.min(rocking.theta.len())]
    }
}

impl Validator {
    /// Run both models over records, the finite element histories side by side.
    pub(crate) fn judge(&self, records: &[Record]) -> Vec<Row> {
        let answers = parallel::map(records, |record| self.answer(record));
        let (springs, control) = match &self.model {
            JudgedModel::Events { springs, control } => (springs, *control),
            JudgedModel::Even { model, settings } => {
                return parallel::map(&answers, |answer| {
                    let (stream, end) = self.follow_even(answer, model, *settings);
                    self.row(answer, &stream, &end)
                });
            }
        };
        let cases: Vec<fem::Analysis> =
            answers.iter().map(|answer| self.case(&answer.record, springs, control)).collect();
        let watch = |i: usize| {
            ComparisonObserver::new(&self.body, answers[i].standing(), cases[i].accel)
                .with_forces(&answers[i].forces)
        };
        let followed = fem::histories(&cases, watch);
        parallel::map_range(0..answers.len(), |i| {
            let (stream, finish) = &followed[i];
            self.row(&answers[i], stream, &HistoryEnd::of(stream, finish))
        })
    }

    fn answer<'a>(&self, record: &'a Record) -> HousnerAnswer<'a> {
        // the whole record as it is, without a copy
        let short = self.duration_s.map(|duration| record.truncated(duration));
        let record = short.map_or(Cow::Borrowed(record), Cow::Owned);
        let options =
            housner::RockingOptions { restitution: Some(self.restitution), ..Default::default() };
        let rocking = housner::solve(&self.body, record.dt, &record.accel, &options);
        let lifted = rocking.outcome != housner::RockingOutcome::NeverMoved;
        let conditioning =
            lifted.then(|| Conditioning::new(&self.body, record.dt, &record.accel, &options));
        let forces = HousnerForces::new(&self.body, record.dt, (&record.accel, &[]), &rocking);
        HousnerAnswer { record, options, rocking, forces, conditioning }
    }

    fn case<'a>(
        &self,
        record: &'a Record,
        springs: &Springs<Chain>,
        control: fem::Control,
    ) -> fem::Analysis<'a> {
        fem::Analysis {
            control,
            ..fem::Analysis::new(self.body, *springs, record.dt, &record.accel)
        }
    }

    fn row(&self, answer: &HousnerAnswer, stream: &ComparisonObserver, end: &HistoryEnd) -> Row {
        let HousnerAnswer { record, options, rocking, conditioning, .. } = answer;
        let (body, dt, accel) = (&self.body, record.dt, &record.accel[..]);
        let overturned_fem = end.overturned;
        let errors = if overturned_fem == Some(true) { stream.upright } else { stream.errors };
        let (horizontal, vertical) = (errors.horizontal.value(), errors.vertical.value());
        let finite = !horizontal.is_nan() && !vertical.is_nan() && stream.peak.is_finite();
        let outcome = match rocking.outcome {
            housner::RockingOutcome::LeavesGround { .. }
            | housner::RockingOutcome::WorkBound { .. }
            | housner::RockingOutcome::NotFinite { .. } => RecordOutcome::HousnerFailed,
            _ if overturned_fem.is_none() || !finite => RecordOutcome::FemFailed,
            housner::RockingOutcome::NeverMoved => RecordOutcome::NeverLifted,
            _ if rocking.overturned().is_some() => RecordOutcome::Overturned,
            _ => RecordOutcome::Rocked,
        };
        let overturned_housner = rocking.overturned().is_some();
        let overturned_fem = overturned_fem.filter(|_| outcome != RecordOutcome::FemFailed);
        let ratio =
            |peak: f64, overturned| if overturned { FRAC_PI_2 } else { peak } / body.alpha();
        let peak_of = |rocking: &housner::Rocking<f64>| {
            let peak = largest_magnitude(&rocking.theta);
            ratio(peak, rocking.overturned().is_some())
        };
        let changed = housner::RockingOptions {
            restitution: Some(self.restitution * (1.0 - SLIGHT_CHANGE)),
            ..options.clone()
        };
        let changes = conditioning.map(|c| c.changes).unwrap_or_default();
        let moved = |k: usize| changes.width[k].max(changes.scale[k]);
        let changed = housner::solve(body, dt, accel, &changed);
        let lifted = matches!(outcome, RecordOutcome::Rocked | RecordOutcome::Overturned);
        let error = |x: f64| (lifted && x.is_finite()).then_some(x);
        let peaks = errors.peaks.errors();
        let forces = |x: f64| {
            let known = error(horizontal).and(error(x));
            known.filter(|_| matches!(self.model, JudgedModel::Events { .. }))
        };
        Row {
            name: record.name.clone(),
            outcome,
            duration_s: errors.samples.saturating_sub(1) as f64 * dt,
            pga_g: record.pga_g(),
            sensitivity: conditioning.map_or(0.0, |c| c.sensitivity.worst()),
            nrmse_horizontal: error(horizontal),
            nrmse_vertical: error(vertical),
            peak_ratio_housner: peak_of(rocking),
            peak_ratio_fem: overturned_fem.map(|overturned| ratio(stream.peak, overturned)),
            overturned_housner,
            overturned_fem,
            impacts: rocking.impacts.len(),
            energy_residual: end.energy_residual,
            suite: (&record.source).into(),
            well_conditioned: conditioning.is_some_and(|c| c.well_conditioned()),
            moved_by_0_1_percent: moved(0),
            moved_by_1_percent: moved(1),
            moved_by_0_1_percent_of_restitution: changes.restitution[0],
            peak_ratio_housner_changed: peak_of(&changed),
            overturned_housner_changed: changed.overturned().is_some(),
            pivot_pulls_s: regime::pivot_pulls(body, dt, accel, rocking),
            displacement_error: error(horizontal).and(error(peaks.displacement)),
            uplift_error: error(horizontal).and(error(peaks.uplift)),
            base_shear_error: forces(peaks.base_shear),
            axial_error: forces(peaks.axial),
        }
    }
}
