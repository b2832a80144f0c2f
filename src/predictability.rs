//! How far a history can be foretold at all: how sensitive our own is to the width.
//!
//! Some histories of rocking hang on so little that two programs agree on them only if both work much more accurately than
//! anyone needs. A deck's steps become finer where that is so (`export/model`).

#[cfg(feature = "cli")]
use crate::scalar::GRAVITY;
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

/// Rotational inertia over m R^2 from which on a body's turning in the air can be foretold: what decks give to a point mass is 1e-5, and a
/// force that a foot lets go within a step turns it by as much more as that is less than one.
#[cfg(feature = "cli")]
const INERTIA_OF_ITS_OWN: f64 = 1e-3;

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

/// Why a history cannot be foretold to its end.
#[cfg(feature = "cli")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForetoldEnd {
    /// A change of the width by 1e-5 moves it by as much as a program's own steps do, or more.
    Width,
    /// The ground falls away under a body that has no rotational inertia of its own: how it turns in the air is not defined.
    Flight,
}

/// Up to where a history can be foretold.
#[cfg(feature = "cli")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foretold {
    /// Samples before that.
    pub samples: usize,
    /// What ends them.
    pub end: ForetoldEnd,
}

/// Up to where a history can be foretold, from the history of a body slightly wider, `changed`; `None` if all can. `size` is the least
/// root mean square of u that an error is told against (m).
#[cfg(feature = "cli")]
pub fn foretold_until(motion: &Motion, changed: &Motion, size: f64) -> Option<Foretold> {
    if nrmse(&changed.u, &motion.u) <= FORETOLD {
        return None;
    }
    let far = HANGS * crate::motion::peak(&motion.u).abs();
    // no further than the error of all samples so far stays below the same share, told as a program's is
    let (mut above, mut below) = (0.0, 0.0);
    let hangs = |(i, (a, b)): (usize, (&f64, &f64))| {
        above += (a - b).powi(2);
        below += a.powi(2);
        let least = (i + 1) as f64 * size * size;
        (a - b).abs() > far || above > HANGS * HANGS * f64::max(below, least)
    };
    let samples = motion.u.iter().zip(&changed.u).enumerate().position(hangs)?;
    Some(Foretold { samples, end: ForetoldEnd::Width })
}

/// Up to where a body without rotational inertia of its own stays on the ground for sure: the first sample at which the ground falls as fast as
/// bodies do. `None` for other bodies, and where it never does.
#[cfg(feature = "cli")]
pub fn until_flight(structure: &Structure, record: &Record) -> Option<Foretold> {
    let body = structure.body::<f64>();
    // rounding of what decks give to a body that has none
    let share = structure.rotational_inertia_kgm2 / (body.mass * body.radius().powi(2));
    if share > INERTIA_OF_ITS_OWN {
        return None;
    }
    let samples = record.up().iter().position(|a| *a <= -GRAVITY)?;
    Some(Foretold { samples, end: ForetoldEnd::Flight })
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
