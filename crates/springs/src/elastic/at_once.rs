//! Springs of an elastic structure before anything is searched: those that the search would begin
//! with.

use super::{
    ElasticTuneError, compliance_ratio,
    design::{CornerSprings, omega_n_hz, springs},
    ladder, landing_speed, stand,
};
use cases::Asked;
use frames::assembled::Assembled;

/// Springs within milliseconds, by the accuracy asked for; no history is looked at.
///
/// # Errors
/// A structure that does not stand.
pub fn springs_of_structure(
    model: &Assembled,
    asked: Asked,
) -> Result<CornerSprings, ElasticTuneError> {
    let standing = stand(model).ok_or(ElasticTuneError::Falls)?;
    let rungs = ladder(asked.error, None, |i| omega_n_hz(&standing, compliance_ratio(i)))?;
    Ok(springs(&standing, compliance_ratio(rungs.guess), landing_speed(&model.structure), 1.0))
}
