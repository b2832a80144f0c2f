//! What the springs of a rigid body cannot do.

use cases::Yardstick;
use files::message::percent;
use parameters::{ConditioningRow, Parameters};
use results::Finding;
use springs::landing_simulation::{LEANS, MEASURED_SHARES, differs_from_housner};

/// Error of restitution that is worth a warning.
const RESTITUTION_MISSED: f64 = 0.005;

/// What these springs cannot do.
pub(super) fn springs_findings(parameters: &Parameters) -> Vec<Finding> {
    let mut all = Vec::new();
    let e = parameters.restitution();
    let body = parameters.structure.body::<f64>();
    let another_restitution = differs_from_housner(&body, e);
    if let Some(a) = &parameters.assessment {
        let (asked, capped) = (a.accuracy, a.capped);
        if !a.reached {
            all.push(match a.judged_by {
                Yardstick::Histories => {
                    Finding::AccuracyMissed { asked, capped, another_restitution }
                }
                Yardstick::Peaks => Finding::PeaksMissed { asked, capped, another_restitution },
            });
        } else if a.measured.record.is_none()
            && a.measured.synthetic_median.is_none()
            && a.measured.earthquakes_mean.is_none()
        {
            all.push(Finding::AccuracyNotMeasured);
        }
    }
    let share = e / body.restitution();
    let (least, most) = MEASURED_SHARES;
    if !(least..=most).contains(&share) {
        all.push(Finding::RestitutionOutOfReach { asked: e, share, least, most });
    }
    if let Some(of) = parameters.assessment.as_ref().and_then(|a| a.restitution_choice) {
        let both = [of.of_equation_2, of.of_bouncing];
        all.push(Finding::SpringsForRestitution {
            asked: e,
            share,
            equation_2: of.equation_2,
            peaks: both.map(|errors| errors.peaks),
            nrmse: both.map(|errors| errors.histories),
        });
    }
    let finished = parameters.landings.len();
    if finished < LEANS.len() {
        all.push(Finding::LandingsUnfinished { finished, all: LEANS.len() });
    }
    let errors = || parameters.landings.iter().map(|l| l.restitution_error);
    if errors().any(|error| error.abs() > RESTITUTION_MISSED) {
        let (low, high) = errors()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let [lowest, highest] = [low, high].map(|error| e * (1.0 + error));
        all.push(Finding::RestitutionMissed {
            asked: e,
            lowest,
            highest,
            of_equation_2: !another_restitution,
        });
    }
    all
}

/// How far changes of the structure and the record move Housner's history.
pub(super) fn conditioning(row: &ConditioningRow) -> Option<String> {
    let pair = |moved: Option<[f64; 2]>| moved.map(|moved| moved.map(percent).join(" and "));
    Some(format!(
        "Changes of 0.1 % and 1 % move Housner's history by {} (width), {} (scale of the record), \
            {} (restitution), as NRMSE.",
        pair(row.moved_by_width)?,
        pair(row.moved_by_scale)?,
        pair(row.moved_by_restitution)?
    ))
}
