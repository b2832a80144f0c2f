//! Springs of elastic structures: from what lands, as stiff as the accuracy asks for.
//!
//! ```text
//!   structure -> finite elements -> standing: W, reactions -> springs at a compliance ratio of the stance (`design`)
//!                                -> releases, motions, record: the reference, its predictable part (`suite`, `trial`)
//!   compliance_ratio = 10^(-i/10), the softest rung i that holds with the next above it
//!                                -> the softest from there on that follow the record to where it grows a change 100,000-fold, if any does
//! ```
//!
//! The accuracy is that of rotations against the reference (NRMSE, median); sways may have five
//! times as much, and so may one history in ten. Or it is that of peaks: the largest displacement,
//! drift, uplift and forces of columns (`frames::peaks`), all alike; one history in ten may have
//! five times as much. Forces are compared only then, for they need a second history of every
//! motion, on springs at 4 Omega_n.

pub mod at_once;
pub mod design;
mod error;
pub mod program;
pub mod referred;
pub mod suite;
pub mod trial;

pub use error::ElasticTuneError;

use self::{
    design::{CornerSprings, omega_n_hz, springs},
    program::ElasticProgramSprings,
    suite::{ElasticSuite, Measured},
    trial::ElasticTrial,
};
use super::{
    ladder::{DECADE, Ladder, RungProgress, best},
    stiffness_search::MARGIN,
};
use cases::{ACCURACY, Asked, PEAKS, Yardstick};
use dynamics::{
    effort::{CutBy, Effort},
    fem::Control,
};
use fixed_steps::FixedStepProgram;
use frames::{
    answer::Reference, assembled::Assembled, fem::default_control, reference::GroundAcceleration,
    standing::Standing, structure::ElasticStructure,
};
use results::{Finding, NotDone};
use strong_motion::Record;

/// Units of work that a search may take by default: about two minutes on two cores.
pub const MOST_WORK: u64 = 240_000_000;
/// Rungs: a compliance ratio of 0.1 to 1e-8.
const RUNGS: (i64, i64) = (10, 80);
/// Compliance ratio over the accuracy, where the search begins.
const BEGIN: f64 = 0.1;
/// Share of the balanced K that is tried where that one does not hold.
const QUIETER: f64 = 0.3;
/// Rungs above the softest that hold the accuracy at which the search begins for those that follow
/// the record further: a tenth of the compliance ratio.
const STIFFER: i64 = 10;

/// Springs of an elastic structure and what was measured of them.
#[derive(Clone, Debug)]
pub struct ElasticTuned {
    /// Springs of each corner, in the order of the frame's.
    pub springs: CornerSprings,
    /// Their errors on the motions on which they were judged; none if the search was stopped first.
    pub measured: Measured,
    /// Whether the accuracy asked for is reached; not if there was nothing to measure it on:
    /// springs are then those that the search would begin with.
    pub reached: bool,
    /// The reference on the record, with as much of it as these springs hold the accuracy over;
    /// none without a record.
    pub reference: Option<Reference>,
    /// Omega_n/2 pi of softer springs that hold the accuracy, too, but follow the record less far
    /// (Hz).
    pub softer_hz: Option<f64>,
    /// Rungs judged.
    pub stiffnesses: usize,
    /// What cut the search, if anything was left out of it, and what that is.
    pub cut: Option<CutBy>,
    pub not_done: Vec<NotDone>,
    /// Histories on springs that met their own bound on steps.
    pub unfinished: usize,
    /// Releases and motions left out since their reference met the bound on its work.
    pub out_of_work: usize,
    /// Springs for a program with fixed time steps.
    pub program: Option<ElasticProgramSprings>,
}

impl ElasticTuned {
    /// Findings about what the search left out or did not finish.
    pub fn findings(&self, asked: Asked) -> Vec<Finding> {
        let reached = self.measured.over(asked).map(|over| over * asked.error);
        let cut = self.cut.filter(|_| !self.not_done.is_empty()).map(|by| Finding::SearchCut {
            by,
            not_done: self.not_done.clone(),
            stiffnesses: self.stiffnesses,
            reached: reached.filter(|error| error.is_finite()),
            asked: asked.error,
        });
        let unfinished = |histories: usize, left_out: bool| {
            (histories > 0).then_some(Finding::HistoriesUnfinished { histories, left_out })
        };
        cut.into_iter()
            .chain(unfinished(self.unfinished, false))
            .chain(unfinished(self.out_of_work, true))
            .collect()
    }
}

/// What is asked of springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticAsked {
    /// NRMSE of rotations, or an error of peaks.
    pub error: Asked,
    /// Stiffest allowed, Omega_n/2 pi (Hz).
    pub most_hz: Option<f64>,
    /// The program with fixed time steps that springs are made for besides.
    pub program: FixedStepProgram,
}

/// Springs under every corner of a structure, its members at work, as stiff as what is asked for
/// needs, within an effort; what that cuts is told, with the best springs so far. `progress` is
/// told the rungs judged and the least error so far.
///
/// # Errors
/// A structure that does not stand; an accuracy that is none; springs allowed that are too soft for
/// any.
pub fn tune_within(
    model: &Assembled,
    ElasticAsked { error: asked, most_hz, program }: ElasticAsked,
    record: Option<(&Record, Reference)>,
    effort: &Effort,
    progress: RungProgress,
) -> Result<ElasticTuned, ElasticTuneError> {
    checked(asked)?;
    let standing = stand(model).ok_or(ElasticTuneError::Falls)?;
    let landing = landing_speed(&model.structure);
    let rungs = ladder(asked.error, most_hz, |i| omega_n_hz(&standing, compliance_ratio(i)))?;
    let (record, reference) = record.unzip();
    let suite =
        ElasticSuite::new(model.clone(), record.zip(reference.as_ref()), effort).by(asked.by);
    let out_of_work = suite.out_of_work;
    let whole = record.map(GroundAcceleration::of);
    let program =
        ElasticProgramSprings::measured(&suite, whole, program, &model.structure.body(), effort);
    let of = |i: i64, share: f64| springs(&standing, compliance_ratio(i), landing, share);
    let measure =
        |springs: &CornerSprings| suite.measure_within(springs, (Control::search(), effort));
    let chosen = search(rungs, asked, of, &measure, effort, progress);
    let mut not_done = Vec::new();
    if effort.cut().is_some() {
        not_done.push(NotDone::Stiffnesses);
    }
    let further = || {
        let (record, reference) = record.zip(reference.as_ref()).filter(|_| chosen.reached)?;
        let reference = reference.further(model, record).ok()??;
        if effort.stops() {
            not_done.push(NotDone::Further);
            return None;
        }
        let record = ElasticTrial::beside(model, record, &reference).trial();
        let suite = ElasticSuite { record, ..suite };
        let stiffer = Ladder {
            ends: (chosen.rung, rungs.ends.1),
            guess: (chosen.rung + STIFFER).min(rungs.ends.1),
        };
        // the record decides; all else is measured once
        let alone = |springs: &CornerSprings| suite.measure_record(springs, effort);
        let found = search(stiffer, asked, of, &alone, effort, progress);
        if effort.stops() {
            not_done.push(NotDone::Further);
            return None;
        }
        let rest = ElasticSuite { record: None, ..suite }
            .measure_within(&found.springs, (default_control(), effort));
        let measured = Measured { record: found.measured.record, ..rest };
        let reached = found.reached && measured.over(asked)? <= 1.0;
        reached.then_some((ElasticRung { measured, ..found }, reference))
    };
    let (chosen, reference, softer_hz) = match further() {
        Some((found, reference)) => {
            let softer =
                Some(chosen.springs.omega_n_hz).filter(|hz| *hz < found.springs.omega_n_hz);
            (found, Some(reference), softer)
        }
        None => (chosen, reference, None),
    };
    let ElasticRung { springs, measured, reached, judged: stiffnesses, .. } = chosen;
    let (cut, unfinished) = (effort.cut(), effort.unfinished());
    Ok(ElasticTuned {
        springs,
        measured,
        reached,
        reference,
        softer_hz,
        stiffnesses,
        cut,
        not_done,
        unfinished,
        out_of_work,
        program,
    })
}

/// Whether this can be asked of springs.
fn checked(asked: Asked) -> Result<(), ElasticTuneError> {
    let (key, limits) = match asked.by {
        Yardstick::Histories => ("tuning.accuracy", ACCURACY),
        Yardstick::Peaks => ("tuning.peaks", PEAKS),
    };
    limits.check(asked.error).map_err(|(value, remedy)| ElasticTuneError::Accuracy {
        key,
        value,
        remedy,
    })?;
    Ok(())
}

/// What a search of the ladder comes to.
#[derive(Clone, Debug)]
struct ElasticRung {
    rung: i64,
    springs: CornerSprings,
    measured: Measured,
    reached: bool,
    /// Rungs judged.
    judged: usize,
}

/// The rungs for an accuracy, up to a frequency; `hz` is that of a rung (Hz).
fn ladder(
    accuracy: f64,
    most_hz: Option<f64>,
    hz: impl Fn(i64) -> f64,
) -> Result<Ladder, ElasticTuneError> {
    let (softest, stiffest) = RUNGS;
    let softest_hz = hz(softest);
    if let Some(most_hz) = most_hz.filter(|hz| *hz < softest_hz) {
        return Err(ElasticTuneError::TooSoft { most_hz, softest_hz });
    }
    // Omega_n^2 goes as 1/compliance_ratio
    let allowed = |hz: f64| softest + (2.0 * DECADE * (hz / softest_hz).log10()).floor() as i64;
    let stiffest = most_hz.map_or(stiffest, |hz| allowed(hz).min(stiffest));
    let guess = (-DECADE * (BEGIN * accuracy).log10()).round() as i64;
    Ok(Ladder { ends: (softest, stiffest), guess: guess.clamp(softest, stiffest) })
}

/// The softest that hold what is asked for, by what is measured of them; `springs` of a rung, at a
/// share of the balanced K.
fn search(
    ladder: Ladder,
    asked: Asked,
    springs: impl Fn(i64, f64) -> CornerSprings,
    measure: &dyn Fn(&CornerSprings) -> Measured,
    effort: &Effort,
    progress: RungProgress,
) -> ElasticRung {
    let allowed = asked.times(MARGIN);
    let over = |(_, measured): &(CornerSprings, Measured)| measured.over(allowed);
    // where springs at the balance of K do not hold, ones with less rebound may: a corner that
    // leaves as soon as it has landed keeps it
    let judged = |i: i64| {
        let of = |share: f64| {
            let springs = springs(i, share);
            let measured = measure(&springs);
            (springs, measured)
        };
        let balanced = of(1.0);
        if over(&balanced).unwrap_or(0.0) <= 1.0 {
            return balanced;
        }
        let quieter = of(QUIETER);
        if over(&quieter).unwrap_or(0.0) < over(&balanced).unwrap_or(0.0) {
            quieter
        } else {
            balanced
        }
    };
    let told = |rungs: usize, least: f64| progress(rungs, least * allowed.error);
    let (mut seen, found) = ladder.search(|i, _| Some(judged(i)), over, effort, &told);
    // cut: the best so far; else there is nothing to measure springs on
    let rung = found.or_else(|| best(&seen, over)).unwrap_or(ladder.guess);
    let stiffnesses = seen.len();
    let cut = effort.cut().is_some();
    let unmeasured = || if cut { (springs(rung, 1.0), Measured::default()) } else { judged(rung) };
    let (springs, measured) = seen.remove(&rung).unwrap_or_else(unmeasured);
    // by what was asked for, not by the margin that is aimed at
    let known = found.is_some() || cut;
    let reached = known && measured.over(asked).is_some_and(|over| over <= 1.0);
    ElasticRung { rung, springs, measured, reached, judged: stiffnesses }
}

/// The structure as it stands on rigid ground.
pub fn stand(model: &Assembled) -> Option<Standing> {
    Standing::new(&model.frame, &model.upright().ok()?)
}

/// Speed at which a corner lands that fell from half of what overturns, 2b p alpha sqrt(3)/2 (m/s).
pub fn landing_speed(structure: &ElasticStructure) -> f64 {
    let body = structure.body();
    2.0 * body.half_width * body.p() * body.alpha() * 0.75_f64.sqrt()
}

/// Compliance ratio of a rung.
fn compliance_ratio(i: i64) -> f64 {
    10f64.powf(-i as f64 / DECADE)
}

#[cfg(test)]
mod tests;
