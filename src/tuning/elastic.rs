//! Springs of elastic structures: from what lands, as stiff as the accuracy asks for.
//!
//! ```text
//!   structure -> finite elements -> standing: W, reactions -> springs at a give of the stance (`design`)
//!                                -> releases, motions, record: the reference, its predictable part (`suite`, `trial`)
//!   give = 10^(-i/10), the softest rung i that holds with the next above it
//! ```
//!
//! The accuracy is that of rotations against the reference (NRMSE, median); sways may have five times as much, and so may one history in ten.

pub mod design;
pub mod suite;
pub mod trial;

use std::collections::BTreeMap;

use thiserror::Error;

use self::{
    design::{CornerSprings, springs},
    suite::{Measured, Suite},
};
use super::ladder::{DECADE, seek};
use crate::{
    elastic::{
        assembled::Assembled,
        frame::FrameError,
        standing::Standing,
        structure::{ElasticError, ElasticStructure},
    },
    fem::Control,
    record::Record,
};

/// Share of the accuracy asked for that is aimed at.
const MARGIN: f64 = 0.7;
/// Rungs: a give of 0.1 to 1e-8.
const RUNGS: (i64, i64) = (10, 80);
/// Give over accuracy where the search begins.
const BEGIN: f64 = 0.1;

/// Why an elastic structure cannot be tuned, and what to do.
#[derive(Debug, Error)]
#[non_exhaustive]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum ElasticTuneError {
    #[error(transparent)]
    Structure(#[from] ElasticError),
    #[error(transparent)]
    Frame(#[from] FrameError),
    #[error("structure: it does not stand under its weight; give stiffer members")]
    Falls,
    #[error("tuning.accuracy is {0:?}; give a number between 1e-5 and 1")]
    Accuracy(f64),
}

/// Springs of an elastic structure and what was measured of them.
#[derive(Clone, Debug)]
pub struct ElasticTuned {
    pub springs: CornerSprings,
    pub measured: Measured,
    /// Whether the accuracy asked for is reached.
    pub reached: bool,
}

/// Springs under every corner of a structure, as stiff as `accuracy` (NRMSE of rotations) asks for, at most `most_hz` (Omega_n/2 pi, Hz); `progress` is told the rungs judged and the
/// least error so far.
///
/// # Errors
/// A structure that cannot be or does not stand; an accuracy that is none.
pub fn tune(
    structure: &ElasticStructure,
    accuracy: f64,
    most_hz: Option<f64>,
    record: Option<&Record>,
    progress: &dyn Fn(usize, f64),
) -> Result<ElasticTuned, ElasticTuneError> {
    if !(1e-5..=1.0).contains(&accuracy) {
        return Err(ElasticTuneError::Accuracy(accuracy));
    }
    let structure = structure.checked()?;
    let model = Assembled::new(structure)?;
    let standing = stand(&model).ok_or(ElasticTuneError::Falls)?;
    let suite = Suite::new(model, record);
    let landing = landing_speed(&structure);
    let allowed = MARGIN * accuracy;
    let mut seen: BTreeMap<i64, (CornerSprings, Measured)> = BTreeMap::new();
    let mut judge = |i: i64| {
        if let Some((_, measured)) = seen.get(&i) {
            return Some(measured.over(allowed));
        }
        let springs = springs(&standing, give(i), landing);
        let measured = suite.measure(&springs, Control::search());
        seen.insert(i, (springs, measured));
        let least = seen.values().map(|(_, m)| m.over(allowed)).fold(f64::INFINITY, f64::min);
        progress(seen.len(), least * allowed);
        Some(measured.over(allowed))
    };
    let guess = (-DECADE * (BEGIN * accuracy).log10()).round() as i64;
    // Omega_n^2 goes as 1/give
    let soft = springs(&standing, give(RUNGS.0), landing).omega_n_hz;
    let stiffest = most_hz.map_or(RUNGS.1, |hz| RUNGS.0 + (2.0 * DECADE * (hz / soft).log10()).floor() as i64);
    let found = seek(RUNGS.0, stiffest.clamp(RUNGS.0, RUNGS.1), guess, &mut judge);
    let best = found.and_then(|found| Some((seen.remove(&found.rung)?, found.holds)));
    let ((springs, measured), holds) = best.ok_or(ElasticTuneError::Falls)?;
    let reached = holds && measured.over(allowed) <= 1.0;
    Ok(ElasticTuned { springs, measured, reached })
}

/// The structure as it stands on rigid ground.
pub fn stand(model: &Assembled) -> Option<Standing> {
    Standing::new(&model.frame, &model.upright().ok()?)
}

/// Speed at which a corner lands that fell from half of what overturns, 2b p alpha sqrt(3)/2 (m/s).
pub fn landing_speed(structure: &ElasticStructure) -> f64 {
    let body = structure.body();
    2.0 * body.half_width * body.p_squared().sqrt() * body.alpha() * 0.75_f64.sqrt()
}

/// Give of a rung.
fn give(i: i64) -> f64 {
    10f64.powf(-i as f64 / DECADE)
}
