//! What springs of an elastic structure are judged on: releases from leans, motions made for the
//! structure, earthquake-like motions, and the record at hand, each over the part in which the
//! reference can be predicted.

use serde::{Deserialize, Serialize};

use super::{
    design::CornerSprings,
    trial::{ElasticTrial, ElasticTrialOutcome, Judged},
};
use crate::suite::{LOOSER, SEED, quantile};
use cases::{Asked, Yardstick};
use dynamics::{effort::Effort, fem::Control};
use frames::{
    answer::Reference, assembled::Assembled, design_forces::ColumnForces, fem::default_control,
    peaks::StructurePeakErrors,
};
use rocking::{json::nulls_as_infinite, statistics::largest, synthetic};
use strong_motion::Record;

/// Leans that the structure is released from, over alpha.
pub(crate) const LEANS: [f64; 6] = [0.05, 0.2, 0.35, 0.5, 0.7, 0.9];
/// How long a release is followed, in 1/p, and its samples.
const RELEASE: f64 = 8.0;
const SAMPLES: f64 = 1600.0;
/// Motions of each suite that are kept; candidates tried to find them.
const MOTIONS: usize = 8;
const LOOKED_AT: usize = 12;

/// Errors of rotations and sways (NRMSE) over several histories; infinite, `null` in JSON, where
/// histories on springs do not get as far as the reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ElasticErrors {
    /// Median of rotations, of sways.
    #[serde(deserialize_with = "nulls_as_infinite")]
    pub median: [f64; 2],
    /// 90 % of them are below it.
    #[serde(deserialize_with = "nulls_as_infinite")]
    pub p90: [f64; 2],
    /// Histories compared.
    pub count: usize,
    /// Touches to a landing of the reference, over all.
    pub touches: f64,
    /// Of peaks; none in older files.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peaks: Option<ElasticPeaks>,
}

/// Errors of peaks over the same histories.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ElasticPeaks {
    /// Of the peak with the largest error, history by history: median, and what 90 % are below.
    #[serde(deserialize_with = "nulls_as_infinite")]
    pub largest: [f64; 2],
    /// Median of each.
    pub median: StructurePeakErrors,
}

impl ElasticPeaks {
    fn new(all: &[StructurePeakErrors]) -> Option<Self> {
        let at = |q: f64| {
            move |mut errors: Vec<f64>| {
                errors.sort_by(f64::total_cmp);
                quantile(&errors, q)
            }
        };
        let largest = || all.iter().map(StructurePeakErrors::largest).collect();
        let median = StructurePeakErrors::each(all, at(0.5))?;
        Some(Self { largest: [at(0.5)(largest())?, at(0.9)(largest())?], median })
    }

    /// Of one history, with an error of forces measured elsewhere, if none was measured here.
    pub fn with_forces(mut self, error: Option<f64>) -> Self {
        if let (None, Some(error)) = (self.median.design_forces, error) {
            self.median.design_forces = Some(error);
            self.largest = self.largest.map(|largest| largest.max(error));
        }
        self
    }

    /// The larger in units of what is allowed.
    fn over(&self, error: f64) -> f64 {
        let [median, p90] = self.largest;
        (median / error).max(p90 / (LOOSER * error))
    }
}

impl ElasticErrors {
    /// The largest in units of what is allowed; infinite where peaks were asked for and not
    /// measured.
    pub(crate) fn over(&self, asked: Asked) -> f64 {
        let accuracy = asked.error;
        if asked.by == Yardstick::Peaks {
            return self.peaks.map_or(f64::INFINITY, |peaks| peaks.over(accuracy));
        }
        let allowed = [accuracy, LOOSER * accuracy];
        let each =
            (0..2).map(|i| (self.median[i] / allowed[i]).max(self.p90[i] / (LOOSER * allowed[i])));
        largest(each)
    }
}

/// What was measured of springs; `None` where there is nothing to measure it on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    pub releases: Option<ElasticErrors>,
    pub motions: Option<ElasticErrors>,
    pub record: Option<ElasticErrors>,
    /// Releases and motions, the record among them, whose reference cannot be predicted: left out.
    pub ill_conditioned: usize,
}

impl Measured {
    fn errors(&self) -> impl Iterator<Item = ElasticErrors> {
        [self.releases, self.motions, self.record].into_iter().flatten()
    }

    /// Whether there was nothing to measure springs on.
    pub fn nothing(&self) -> bool {
        self.errors().next().is_none()
    }

    /// The largest error in units of what is allowed; none if nothing was measured.
    pub fn over(&self, asked: Asked) -> Option<f64> {
        self.errors().map(|errors| errors.over(asked)).reduce(f64::max)
    }
}

/// The trials of a structure.
#[derive(Debug)]
pub struct ElasticSuite {
    pub model: Assembled,
    pub releases: Vec<ElasticTrial>,
    pub motions: Vec<ElasticTrial>,
    pub record: Option<ElasticTrial>,
    /// Releases and motions, the record among them, left out since their reference cannot be
    /// predicted.
    pub ill_conditioned: usize,
    /// Releases and motions, the record among them, left out since their reference met the bound on
    /// its work.
    pub out_of_work: usize,
    /// How forces are taken, if springs are judged by them, too: it takes a second history of each
    /// trial.
    pub forces: Option<ColumnForces>,
}

impl ElasticSuite {
    /// Of a structure, with this record and its reference if there is one, its work counted; less
    /// of it once it is stopped from outside.
    pub fn new(model: Assembled, record: Option<(&Record, &Reference)>, effort: &Effort) -> Self {
        let body = model.structure.body();
        let (p, alpha) = (body.p(), body.alpha());
        let times = (RELEASE / p / SAMPLES, RELEASE / p);
        let released = |lean: f64| ElasticTrial::released(&model, lean * alpha, times, effort);
        let releases = parallel::map(&LEANS, |lean| released(*lean));
        let motion = |i: usize| match i % 2 {
            0 => synthetic::record(SEED, i / 2, p, alpha),
            _ => synthetic::earthquake(SEED, i / 2, p),
        };
        let shaken = |i: usize| ElasticTrial::shaken(&model, &motion(i), effort);
        let motions = parallel::map_range(0..LOOKED_AT, shaken);
        let record =
            record.map(|(record, reference)| ElasticTrial::beside(&model, record, reference));
        let all = || releases.iter().chain(&motions).chain(&record);
        let ill_conditioned =
            all().filter(|found| matches!(found, ElasticTrialOutcome::IllConditioned)).count();
        let out_of_work =
            all().filter(|found| matches!(found, ElasticTrialOutcome::OutOfWork)).count();
        let trials = |found: Vec<ElasticTrialOutcome>, most| {
            found.into_iter().filter_map(ElasticTrialOutcome::trial).take(most).collect()
        };
        Self {
            releases: trials(releases, LEANS.len()),
            motions: trials(motions, MOTIONS),
            record: record.and_then(ElasticTrialOutcome::trial),
            ill_conditioned,
            out_of_work,
            forces: None,
            model,
        }
    }

    /// The same for a yardstick: by peaks, forces count.
    pub(crate) fn by(self, yardstick: Yardstick) -> Self {
        let forces =
            (yardstick == Yardstick::Peaks).then(|| ColumnForces::of(&self.model.structure));
        Self { forces, ..self }
    }

    /// The errors of springs; on the record, which is followed to where it grows a change the most,
    /// with steps as close as the answer's.
    pub fn measure(&self, springs: &CornerSprings, control: Control) -> Measured {
        self.measure_within(springs, (control, &Effort::unbounded()))
    }

    /// The same, its work counted; of no worth if it is stopped from outside meanwhile.
    pub(crate) fn measure_within(
        &self,
        springs: &CornerSprings,
        (control, effort): (Control, &Effort),
    ) -> Measured {
        Measured {
            releases: self.errors(&self.releases, springs, (control, effort)),
            motions: self.errors(&self.motions, springs, (control, effort)),
            ill_conditioned: self.ill_conditioned,
            ..self.measure_record(springs, effort)
        }
    }

    /// Those on the record alone.
    pub(crate) fn measure_record(&self, springs: &CornerSprings, effort: &Effort) -> Measured {
        let record = self.errors(self.record.as_slice(), springs, (default_control(), effort));
        Measured { record, ..Measured::default() }
    }

    fn errors(
        &self,
        trials: &[ElasticTrial],
        springs: &CornerSprings,
        (control, effort): (Control, &Effort),
    ) -> Option<ElasticErrors> {
        let judge = |trial: &ElasticTrial| match effort.stopped() {
            true => Judged::LOST,
            false => trial.judge(&self.model, springs, self.forces.as_ref(), (control, effort)),
        };
        let judged = parallel::map(trials, judge);
        let sorted = |i: usize| {
            let mut errors: Vec<f64> = judged.iter().map(|judged| judged.errors[i]).collect();
            errors.sort_by(f64::total_cmp);
            errors
        };
        let (turns, sways) = (sorted(0), sorted(1));
        let of = |q: f64| Some([quantile(&turns, q)?, quantile(&sways, q)?]);
        let landings: usize = trials.iter().map(|trial| trial.landings).sum();
        let touches: usize = judged.iter().map(|judged| judged.touches).sum();
        let touches = touches as f64 / landings as f64;
        let peaks: Vec<StructurePeakErrors> = judged.iter().map(|judged| judged.peaks).collect();
        let peaks = ElasticPeaks::new(&peaks);
        Some(ElasticErrors { median: of(0.5)?, p90: of(0.9)?, count: judged.len(), touches, peaks })
    }
}
