//! How far a history can be foretold at all: what a hair of width does to our own.
//!
//! Some histories of rocking hang on so little that two programs agree on them only if both work much more accurately than
//! anyone needs. A deck's steps become finer where that is so (`export/model`).

use crate::{
    fem::{Case, Control, History, Start},
    motion::{Motion, nrmse},
    parameters::Parameters,
    record::Record,
    structure::Structure,
};

/// Relative change of the width.
const CHANGE: f64 = 1e-5;

/// NRMSE of u that a relative change of the width by 1e-5 makes, over the whole of `motion`, the history of the model on
/// `record`.
pub fn moved_by_a_hair(motion: &Motion, parameters: &Parameters, record: &Record) -> f64 {
    let structure = Structure { width_m: parameters.structure.width_m * (1.0 + CHANGE), ..parameters.structure };
    let changed = simulate(&Parameters { structure, ..parameters.clone() }, record).motion;
    nrmse(&changed.u, &motion.u)
}

/// Our own history of a deck's model; `parameters` with inertia.
pub fn simulate(parameters: &Parameters, record: &Record) -> History {
    Case {
        body: parameters.structure.body::<f64>(),
        springs: parameters.chains(),
        start: Start::Settled,
        dt: record.dt,
        accel: &record.accel,
        scale: 1.0,
        control: Control::default(),
    }
    .simulate_with(&parameters.members())
    .0
}
