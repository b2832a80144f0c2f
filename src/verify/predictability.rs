//! How far a history can be foretold at all: what a hair of width does to our own.
//!
//! Some histories of rocking hang on so little that no two programs agree on them. A deck mostly differs from our model by
//! what acts like a relative change of width by up to 6e-5. The difference arises where a foot lifts and lets its horizontal
//! force go, in a fast sequence of lift-offs and touch-downs that OpenSees follows to the first order of its time step.

use super::simulate;
use crate::{
    motion::{Motion, nrmse},
    parameters::Parameters,
    record::Record,
    structure::Structure,
};

/// Relative change of the width.
const CHANGE: f64 = 1e-5;
/// NRMSE of u up to which such a change leaves a history comparable: as a rule OpenSees then agrees within 0.005.
const COMPARABLE: f64 = 5e-4;

/// What a relative change of the width by 1e-5 does to our own history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Predictability {
    /// NRMSE of u over the whole history.
    pub change: f64,
    /// Length of the beginning over which that NRMSE stays within 5e-4 [samples].
    pub samples: usize,
}

impl Predictability {
    /// Of the model on `record`.
    pub fn new(parameters: &Parameters, record: &Record) -> Self {
        Self::of(&simulate(parameters, record).motion, parameters, record)
    }

    /// Of `ours`, the history of the model on `record`.
    pub(super) fn of(ours: &Motion, parameters: &Parameters, record: &Record) -> Self {
        let structure = Structure { width_m: parameters.structure.width_m * (1.0 + CHANGE), ..parameters.structure };
        let changed = simulate(&Parameters { structure, ..parameters.clone() }, record).motion;
        let (mut above, mut below, mut samples) = (0.0, 0.0, 0);
        for (i, (a, b)) in changed.u.iter().zip(&ours.u).enumerate() {
            above += (a - b) * (a - b);
            below += b * b;
            if above <= COMPARABLE * COMPARABLE * below {
                samples = i + 1;
            }
        }
        Self { change: nrmse(&changed.u, &ours.u), samples }
    }
}
