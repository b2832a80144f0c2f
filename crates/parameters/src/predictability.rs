//! How far a history can be foretold at all: how sensitive our own is to the width.
//!
//! Some rocking histories are so sensitive that two programs agree on them only if both compute far
//! more accurately than is otherwise needed. A deck's steps become finer where that is so
//! (`decks::model`).

use crate::{Parameters, answers::MemberHistory};
use dynamics::{
    fem::{Analysis, History},
    spring::{Chain, Springs},
};
use results::Finding;
use rocking::{
    conditioning::{self, Conditioning, ILL_CONDITIONED, SLIGHT_CHANGE},
    housner::RockingOptions,
    motion::{Motion, nrmse, samples_until},
    scalar::GRAVITY,
    structure::{Body, Structure},
};
use serde::{Deserialize, Serialize};
use strong_motion::Record;

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

/// Share of the half width below which a motion counts as standing; errors are taken relative to at
/// least this size.
pub const STANDING: f64 = 1e-3;

/// NRMSE of u by which `motion`, the history of the model on `record`, is moved by a relative
/// change of the width by 1e-5.
pub fn width_sensitivity(motion: &Motion, parameters: &Parameters, record: &Record) -> f64 {
    nrmse(&slightly_wider(parameters, record).u, &motion.u)
}

/// The history of the model with that change of the width.
pub fn slightly_wider(parameters: &Parameters, record: &Record) -> Motion {
    let structure = Structure {
        width_m: parameters.structure.width_m * (1.0 + SLIGHT_CHANGE),
        ..parameters.structure
    };
    simulate(&Parameters { structure, ..parameters.clone() }, record).motion
}

/// How far a change of 0.1 % moves the history of a structure with members: the larger of both
/// signs, as NRMSE of u.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MembersConditioning {
    /// Of the width.
    pub moved_by_width: f64,
    /// Of the record's scale.
    pub moved_by_scale: f64,
    /// Up to when none moves it by a twentieth of its largest displacement so far (s), as
    /// [`conditioning::Changes::holds_to_s`]; none: to its end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub holds_to_s: Option<f64>,
}

impl MembersConditioning {
    /// Of `with`, the history on these springs.
    pub fn new(
        body: &Body<f64>,
        springs: &Springs<Chain>,
        record: &Record,
        with: &MemberHistory,
    ) -> Self {
        let change = conditioning::CHANGES[0];
        let changed = [(change, 0.0), (-change, 0.0), (0.0, change), (0.0, -change)];
        let changed: Vec<Vec<f64>> = parallel::map(&changed, |(width, scale)| {
            let body = Body { half_width: body.half_width * (1.0 + width), ..*body };
            let analysis = Analysis {
                vertical: record.up(),
                scale: 1.0 + scale,
                ..Analysis::new(body, *springs, record.dt, &record.accel)
            };
            analysis.simulate_with(&with.members).0.motion.u
        });
        let standing = samples_until(with.matched.overturned_fem_s, record.dt);
        let u = &with.history.motion.u;
        let u = &u[..standing.min(u.len())];
        let moved = |pair: &[Vec<f64>]| {
            let one = |other: &Vec<f64>| {
                let samples = other.len().min(u.len());
                Some(nrmse(&other[..samples], &u[..samples])).filter(|x| x.is_finite())
            };
            pair.iter().map(|other| one(other).unwrap_or(1.0)).fold(0.0, f64::max)
        };
        Self {
            moved_by_width: moved(&changed[..2]),
            moved_by_scale: moved(&changed[2..]),
            holds_to_s: conditioning::holds_to(body, record.dt, u, &changed),
        }
    }

    /// Whether the history can be compared one to one.
    pub fn well_conditioned(&self) -> bool {
        let most = ILL_CONDITIONED * conditioning::CHANGES[0];
        self.moved_by_width.max(self.moved_by_scale) < most
    }

    /// That it cannot, with what moves it.
    pub fn finding(&self) -> Option<Finding> {
        (!self.well_conditioned()).then_some(Finding::IllConditioned {
            moved_by_width: self.moved_by_width,
            moved_by_scale: self.moved_by_scale,
            moved_by_restitution: None,
            holds_to_s: self.holds_to_s,
            springs_judged: false,
        })
    }

    /// Up to when it can be predicted (s), if it is not well-conditioned; none: to its end.
    pub fn predictable_to(&self) -> Option<f64> {
        self.holds_to_s.filter(|_| !self.well_conditioned())
    }
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

/// Samples before the two histories differ by more than `HANGS` of the peak; `None`: all.
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

/// Rock the finite elements on the springs and members of `parameters` through the whole of a
/// record, with its vertical component if it has one.
///
/// The springs are `vertical` and `horizontal`; those of `program`, for fixed steps, are not used.
/// The rotational inertia may be zero: the body is taken as it is, while decks give it the least
/// that other programs need (1e-5 m R^2). It never fails: what went wrong is the history's
/// `outcome`.
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
    use crate::answers::compare_models;
    use dynamics::spring::Design;
    use rocking::members::{Damper, Members};

    #[test]
    fn the_error_of_a_motion_that_only_stands_counts_by_a_thousandth_of_its_size() {
        let share = |motion: &[f64]| standing_share(motion.iter(), 0.2);
        assert_eq!([share(&[0.01, -0.01]), share(&[])], [1.0, 0.0]);
        assert!((share(&[1e-8, -1e-8]) / 5e-5 - 1.0).abs() < 1e-12);
        assert!((share(&[1e-8, -1e-8, 0.0, 0.0]) / (5e-5 / 2.0_f64.sqrt()) - 1.0).abs() < 1e-12);
    }

    /// A body that does not lift sways on its springs in proportion to the ground: a change of the
    /// scale by 0.1 % moves it by 0.1 %, and it is well-conditioned to its end.
    #[test]
    fn a_standing_body_with_members_is_moved_as_the_ground_is() {
        let structure = Structure::a_frame(9.0, 2.1, 120e3).unwrap();
        let body = structure.body::<f64>();
        let shake = (0..400).map(|i| 0.3 * (0.05 * f64::from(i)).sin()).collect();
        let record = Record::new("shake", 0.01, shake).unwrap();
        let design = Design::from_kc(0.3, 0.1, 0.75, 160.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(120e3);
        let damper = Some(Damper { c: 1e5 });
        let members = Members { damper, ..Members::default() };
        let both = compare_models(&body, body.restitution(), &springs, &members, &record);
        let with = both.with.as_ref().unwrap();
        assert!(with.history.landings.is_empty());
        let of = MembersConditioning::new(&body, &springs, &record, with);
        assert!((of.moved_by_scale / 1e-3 - 1.0).abs() < 0.02, "{of:?}");
        assert!(of.well_conditioned() && of.predictable_to().is_none(), "{of:?}");
        // as parameters.json keeps it
        let row = serde_json::to_value(of).unwrap();
        assert!(row.get("holds_to_s").is_none() && row["moved_by_scale"] == of.moved_by_scale);
        assert_eq!(serde_json::from_value::<MembersConditioning>(row).unwrap(), of);
    }
}
