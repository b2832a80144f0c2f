//! Immediate answers while the user changes inputs: histories on springs from the geometry, and
//! their findings.
//!
//! Of a rigid body both models' histories; of an elastic structure the one on springs alone, since
//! that on rigid ground takes ten times as long.

use std::sync::{Mutex, PoisonError};

use crate::{
    WebError,
    any_case::AnyCase,
    said::{Does, PeaksFound, Said, Working, does},
    series::HistorySeries,
};
use cases::{Case, ElasticCase};
use dynamics::fem::HistoryOutcome;
use frames::{
    assembled::Assembled,
    fem::{ElasticAnalysis, ElasticHistory},
    structure::ElasticStructure,
};
use report::{
    Taken, Unit, elastic::peaks_on_springs, filed_of_elastic, reference::uplift_g,
    rigid::at_once::RunAtOnce, sentence,
};
use results::{Finding, Peaks};
use springs::{
    at_once::springs_at_once,
    elastic::{at_once::springs_of_structure, design::CornerSprings},
};
use strong_motion::Record;

pub(crate) fn answer(case: &AnyCase, friction: f64) -> Result<Said, WebError> {
    match case {
        AnyCase::Rigid(case) => rigid(case, friction),
        AnyCase::Elastic(case) => elastic(case),
    }
}

fn rigid(case: &Case, friction: f64) -> Result<Said, WebError> {
    let body = case.structure.body::<f64>();
    let springs = springs_at_once(&body, case.tuning.asked()).ok_or(WebError::NoSprings)?;
    let RunAtOnce { record, both, run } = RunAtOnce::new(case, &springs, friction)?;
    let history = HistorySeries::of_rigid(case.structure.kind, &body, &both, &record);
    let working = Working::of(&body, uplift_g(&case.structure, &case.members));
    let said = Said::of(&run, working, history);
    Ok(Said { verdict: run.preliminary_verdict(), ..said })
}

/// The springs of the last structure: a search each, whatever the record.
static LAST: Mutex<Option<(String, CornerSprings)>> = Mutex::new(None);

fn springs_of(case: &ElasticCase, assembled: &Assembled) -> Result<CornerSprings, WebError> {
    let key = format!("{:?} {:?} {:?}", case.structure, case.members, case.asked);
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, springs)) = last.as_ref().filter(|(known, _)| *known == key) {
        return Ok(springs.clone());
    }
    let springs = springs_of_structure(assembled, case.asked)?;
    *last = Some((key, springs.clone()));
    Ok(springs)
}

fn elastic(case: &ElasticCase) -> Result<Said, WebError> {
    let assembled = Assembled::with_members(case.structure, case.members)?;
    let record = case.excitation.used()?;
    let springs = springs_of(case, &assembled)?;
    let analysis = ElasticAnalysis::on_record(&assembled.frame, &springs.corners, &record);
    let fem = analysis.simulate().map_err(frames::answer::AnswerError::from)?;
    let body = case.structure.body();
    let uplift_g = assembled.uplift_g().unwrap_or(body.half_width / body.height);
    let working = Working::of_elastic(&assembled);
    let found = what_it_does(&assembled, &fem, &record, uplift_g);
    let (does, share_of_overturning) = does(&found);
    let findings = filed_of_elastic([found]);
    let verdict = findings.first().map(|filed| sentence(&filed.message)).unwrap_or_default();
    let peaks = (!matches!(does, Does::Unknown)).then(|| PeaksFound {
        reference: None,
        reference_ends_s: None,
        springs: peaks(&assembled, &fem, record.dt),
        with_members: None,
    });
    let title = report::elastic::title(&case.structure);
    let mut taken = Taken::new(title, Vec::new());
    taken.record = Some(case.excitation.line());
    let springs = springs
        .corners
        .first()
        .map(|s| [Unit::new("vertical", &s.vertical), Unit::new("horizontal", &s.horizontal)]);
    Ok(Said {
        verdict,
        does,
        share_of_overturning,
        by_chance: false,
        findings,
        taken,
        peaks,
        friction_needed: None,
        springs: springs.into_iter().flatten().collect(),
        springs_at: "each corner of the first footing",
        working,
        history: HistorySeries::on_springs(&assembled, &fem, &record),
    })
}

fn what_it_does(
    assembled: &Assembled,
    fem: &ElasticHistory,
    record: &Record,
    uplift_g: f64,
) -> Finding {
    let alpha = assembled.structure.body().alpha();
    let largest = assembled
        .sways(fem.q.iter().map(Vec::as_slice))
        .iter()
        .flat_map(|sway| sway.rotation.clone())
        .fold(0.0, |most: f64, rotation| most.max(rotation.abs()));
    match fem.outcome {
        HistoryOutcome::Overturned { time } => {
            Finding::Overturns { time_s: time, reference_s: None }
        }
        HistoryOutcome::Completed
            if record.pga_g() < uplift_g && !fem.contacts.iter().any(|c| c.touches) =>
        {
            Finding::NeverLifts { pga_g: record.pga_g(), uplift_g }
        }
        HistoryOutcome::Completed => Finding::Stands {
            share_of_overturning: largest / alpha,
            reference_share: None,
            over_s: record.duration(),
            largest_at_s: None,
            if_feet_hold: false,
            of_columns: matches!(assembled.structure, ElasticStructure::Frame(_)),
            tied: false,
        },
        HistoryOutcome::Stopped { time }
        | HistoryOutcome::WorkBound { time }
        | HistoryOutcome::Unstable { time } => {
            Finding::NoAnswer { model: results::FindingModel::Springs, time_s: time }
        }
    }
}

/// Largest displacements on springs, up to an overturning.
fn peaks(assembled: &Assembled, fem: &ElasticHistory, dt: f64) -> Peaks {
    let alpha = assembled.structure.body().alpha();
    let sways = assembled.sways(fem.q.iter().map(Vec::as_slice));
    let fallen = matches!(fem.outcome, HistoryOutcome::Overturned { .. });
    let falls = sways.iter().filter_map(|s| s.rotation.iter().position(|r| r.abs() > alpha)).min();
    let n = falls.filter(|_| fallen).unwrap_or(fem.q.len());
    peaks_on_springs(assembled, fem, &sways.iter().collect::<Vec<_>>(), dt, n)
}
