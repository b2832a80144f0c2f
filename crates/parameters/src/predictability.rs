//! How far a history can be foretold at all: how sensitive our own is to the width.
//!
//! Some histories of rocking hang on so little that two programs agree on them only if both work
//! much more accurately than anyone needs. A deck's steps become finer where that is so
//! (`decks::model`).

use crate::Parameters;
use dynamics::fem::{Analysis, History};
use rocking::{
    conditioning::Conditioning,
    housner::RockingOptions,
    motion::{Motion, nrmse, samples_until},
    scalar::GRAVITY,
    structure::Structure,
};
use strong_motion::Record;

/// Relative change of the width.
const CHANGE: f64 = 1e-5;

/// Share of the largest u that the same change moves a history by where it can no longer be
/// foretold: a deck's own error is some ten times as much there, and grows as fast.
const HANGS: f64 = 1e-4;

/// NRMSE of u by a relative change of the width by 1e-5 up to which a history can be foretold to
/// its end.
const FORETOLD: f64 = 5e-4;

/// Rotational inertia over m R^2 from which on a body's turning in the air can be foretold: what
/// decks give to a point mass is 1e-5, and a force that a foot lets go within a step turns it by as
/// much more as that is less than one.
const INERTIA_OF_ITS_OWN: f64 = 1e-3;

/// Share of the half width below which a motion counts as standing: an error is told against at
/// least that.
pub const STANDING: f64 = 1e-3;

/// NRMSE of u by which `motion`, the history of the model on `record`, is moved by a relative
/// change of the width by 1e-5.
pub fn width_sensitivity(motion: &Motion, parameters: &Parameters, record: &Record) -> f64 {
    nrmse(&slightly_wider(parameters, record).u, &motion.u)
}

/// The history of the model with that change of the width.
pub fn slightly_wider(parameters: &Parameters, record: &Record) -> Motion {
    let structure = Structure {
        width_m: parameters.structure.width_m * (1.0 + CHANGE),
        ..parameters.structure
    };
    simulate(&Parameters { structure, ..parameters.clone() }, record).motion
}

/// Why a history cannot be foretold to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForetoldEnd {
    /// A change of the width by 1e-5 moves it by as much as a program's own steps do, or more.
    Width,
    /// The ground falls away under a body that has no rotational inertia of its own: how it turns
    /// in the air is not defined.
    Flight,
    /// The run found that a change of 0.1 % moves it too much from there on.
    IllConditioned,
}

/// Up to where a history can be foretold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foretold {
    /// Samples before that.
    pub samples: usize,
    /// What ends them.
    pub end: ForetoldEnd,
}

/// Up to where a history can be foretold, from the history of a body slightly wider, `changed`;
/// `None` if all can.
pub fn foretold_until(motion: &Motion, changed: &Motion) -> Option<Foretold> {
    let samples = foretold_samples(motion, changed)?;
    Some(Foretold { samples, end: ForetoldEnd::Width })
}

/// Up to where the run found that it can be foretold (s), of samples dt apart (s).
pub fn until_time(until: f64, dt: f64) -> Foretold {
    Foretold { samples: samples_until(Some(until), dt), end: ForetoldEnd::IllConditioned }
}

/// How many samples that is.
fn foretold_samples(motion: &Motion, changed: &Motion) -> Option<usize> {
    if nrmse(&changed.u, &motion.u) <= FORETOLD {
        return None;
    }
    let far = HANGS * rocking::motion::peak(&motion.u).abs();
    motion.u.iter().zip(&changed.u).position(|(a, b)| (a - b).abs() > far)
}

/// NRMSE of u over the first samples, told against at least the motion of a body that stands
/// (`half_width`, m).
pub fn standing_error(u: &[f64], reference: &[f64], half_width: f64) -> f64 {
    nrmse(u, reference) * standing_share(reference.iter(), half_width)
}

/// Share that an error counts by: 1 of a motion that rocks; the root mean square over a thousandth
/// of the size (m, rad) of one that only stands.
pub fn standing_share<'a>(motion: impl Iterator<Item = &'a f64>, size: f64) -> f64 {
    let (sum, count) = motion.fold((0.0, 0), |(sum, count), x| (sum + x * x, count + 1));
    let rms = (sum / count.max(1) as f64).sqrt();
    let least = STANDING * size;
    if rms < least { rms / least } else { 1.0 }
}

/// Up to where a body without rotational inertia of its own stays on the ground for sure: the first
/// sample at which the ground falls as fast as bodies do. `None` for other bodies, and where it
/// never does.
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

/// Up to when the motion of Housner's body on a record can be predicted, if not to its end (s).
pub fn predictable_to(parameters: &Parameters, record: &Record) -> Option<f64> {
    let options = RockingOptions::on(record, parameters.restitution());
    Conditioning::new(&parameters.structure.body(), record.dt, &record.accel, &options)
        .predictable_to()
}

/// Our own history of a deck's model; `parameters` with inertia.
pub fn simulate(parameters: &Parameters, record: &Record) -> History {
    Analysis {
        vertical: record.up(),
        ..Analysis::new(
            parameters.structure.body::<f64>(),
            parameters.chains(),
            record.dt,
            &record.accel,
        )
    }
    .simulate_with(&parameters.members())
    .0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_a_motion_that_only_stands_counts_by_a_thousandth_of_its_size() {
        let share = |motion: &[f64]| standing_share(motion.iter(), 0.2);
        assert_eq!([share(&[0.01, -0.01]), share(&[])], [1.0, 0.0]);
        assert!((share(&[1e-8, -1e-8]) / 5e-5 - 1.0).abs() < 1e-12);
        assert!((share(&[1e-8, -1e-8, 0.0, 0.0]) / (5e-5 / 2.0_f64.sqrt()) - 1.0).abs() < 1e-12);
    }
}
