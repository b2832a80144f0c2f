//! For how much of the record `tune verify` judges a run's deck, where that is not all of it.

use decks::{DeckExpectation, with_inertia};
use frames::{answer::ElasticHistories, assembled::Assembled};
use parallel::join;
use parameters::{
    Parameters,
    predictability::{simulate, slightly_wider},
};
use results::{DeckEnd, Finding};
use rocking::structure::Structure;
use strong_motion::Record;

/// Of a rigid body, whose motion is well-conditioned or not, and can be foretold up to a time, if
/// not to its end (s).
pub(crate) fn rigid(
    structure: &Structure,
    parameters: &Parameters,
    record: &Record,
    (well_conditioned, until): (bool, Option<f64>),
) -> Option<Finding> {
    let verdict = parameters.verdict.as_ref()?;
    if well_conditioned
        && verdict.finite_elements.overturned_s.is_none()
        && record.vertical.is_none()
    {
        return None;
    }
    let parameters = &Parameters {
        structure: with_inertia(structure, &parameters.members()),
        ..parameters.clone()
    };
    let (own, changed) =
        join(|| simulate(parameters, record).motion, || slightly_wider(parameters, record));
    finding(record, DeckExpectation::rigid(parameters, record, &own, &changed, until))
}

/// Of an elastic structure.
pub(crate) fn elastic(
    assembled: &Assembled,
    histories: &ElasticHistories,
    record: &Record,
) -> Option<Finding> {
    let followed = histories.reference.tried(assembled, record).ok()?;
    let compared = histories.reference.compared(record, followed, &[histories.fem.q.len()]);
    finding(record, DeckExpectation::elastic(&compared))
}

fn finding(record: &Record, DeckExpectation { samples, end }: DeckExpectation) -> Option<Finding> {
    let seconds = |samples: usize| samples.saturating_sub(1) as f64 * record.dt;
    (end != DeckEnd::Record).then(|| Finding::DeckJudged {
        judged_s: seconds(samples),
        record_s: seconds(record.len()),
        end,
    })
}
