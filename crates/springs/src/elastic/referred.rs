//! What an elastic structure does in a record on rigid ground, within the effort of a whole run.

use frames::{
    Mechanics,
    answer::{AnswerError, Reference},
    assembled::Assembled,
    fem::{default_control, most_steps},
    reference::{self, FORETOLD},
};
use thiserror::Error;

use crate::job::JobError;
use dynamics::effort::Effort;
use strong_motion::Record;

/// A history on rigid ground through the record may take one in so many of all units of work.
const RECORD: u64 = 12;
/// Each of the motions near the record may take one in so many.
pub const NEAR: u64 = 120;

/// Why there is no history on rigid ground.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum ReferredError {
    #[error(transparent)]
    TooShort(#[from] JobError),
    #[error(
        "{record}: {steps} steps at least, one to a sample, are out of reach: a history of this \
         structure may take {most}; \
         shorten it (--duration), give the structure fewer elements, or allow more (--work)"
    )]
    OutOfReach { record: String, steps: usize, most: usize },
    #[error(transparent)]
    Answer(#[from] AnswerError),
}

/// What the structure does in the record on rigid ground.
///
/// # Errors
/// A record of one sample, or of more than a history may take steps; a structure that does not
/// stand.
pub fn referred(
    assembled: &Assembled,
    record: &Record,
    effort: &Effort,
) -> Result<Reference, ReferredError> {
    if record.len() < 2 {
        return Err(
            JobError::TooShort { samples: record.len(), record: record.name.clone() }.into()
        );
    }
    let most_work = effort.part(RECORD);
    let coordinates = assembled.frame.size();
    let by_work = (most_work / reference::step_units(coordinates)) as usize;
    let most = by_work.min(most_steps(default_control(), coordinates));
    let steps = record.len() - 1;
    if steps > most {
        return Err(ReferredError::OutOfReach { record: record.name.clone(), steps, most });
    }
    Ok(Reference::new(assembled, record, FORETOLD, most_work)?)
}
