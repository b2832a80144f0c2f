//! How far a history can be foretold at all: how sensitive our own is to the width.
//!
//! Some histories of rocking hang on so little that two programs agree on them only if both work much more accurately than
//! anyone needs. A deck's steps become finer where that is so (`export/model`).

use crate::{
    fem::{Analysis, Control, History, Start},
    motion::{Motion, nrmse},
    parameters::Parameters,
    record::Record,
    structure::Structure,
};

/// Relative change of the width.
const CHANGE: f64 = 1e-5;

/// Share of the largest u that the same change moves a history by where it can no longer be foretold: a deck's own error is
/// some ten times as much there, and grows as fast.
#[cfg(feature = "cli")]
const HANGS: f64 = 1e-4;

/// NRMSE of u by a relative change of the width by 1e-5 up to which a history can be foretold to its end.
#[cfg(feature = "cli")]
const FORETOLD: f64 = 5e-4;

/// NRMSE of u that a relative change of the width by 1e-5 makes, over the whole of `motion`, the history of the model on
/// `record`.
pub fn width_sensitivity(motion: &Motion, parameters: &Parameters, record: &Record) -> f64 {
    nrmse(&slightly_wider(parameters, record).u, &motion.u)
}

/// The history of the model with that change of the width.
pub fn slightly_wider(parameters: &Parameters, record: &Record) -> Motion {
    let structure = Structure { width_m: parameters.structure.width_m * (1.0 + CHANGE), ..parameters.structure };
    simulate(&Parameters { structure, ..parameters.clone() }, record).motion
}

/// How many samples of a history can be foretold, from the history of a body slightly wider, `changed`; `None` if all can.
#[cfg(feature = "cli")]
pub fn foretold_until(motion: &Motion, changed: &Motion) -> Option<usize> {
    if nrmse(&changed.u, &motion.u) <= FORETOLD {
        return None;
    }
    let far = HANGS * crate::motion::peak(&motion.u).abs();
    motion.u.iter().zip(&changed.u).position(|(a, b)| (a - b).abs() > far)
}

/// Our own history of a deck's model; `parameters` with inertia.
pub fn simulate(parameters: &Parameters, record: &Record) -> History {
    Analysis {
        body: parameters.structure.body::<f64>(),
        springs: parameters.chains(),
        start: Start::Settled,
        dt: record.dt,
        accel: &record.accel,
        vertical: record.up(),
        scale: 1.0,
        control: Control::default(),
    }
    .simulate_with(&parameters.members())
    .0
}
