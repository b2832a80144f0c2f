//! Up to where histories beside each other tell something, and what sets the deck's body apart.

use super::simulate;
use crate::samples_to_fall;
use dynamics::fem::{History, HistoryOutcome};
use parameters::Parameters;
use rocking::{
    housner::Rocking,
    motion::{peak, samples_until},
    regime::check_with,
    structure::Structure,
};
use strong_motion::Record;

/// Why our own history ends before its record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnEnd {
    /// The body has fallen over.
    Falls,
    /// The bound on steps was reached.
    WorkBound,
    /// Its rotation lost its balance.
    Unstable,
    /// It could not be followed further.
    Stopped,
}

/// A structure whose rotational inertia a deck makes larger, since other programs need some.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AddedInertia {
    /// Of the structure as given, which `tune run` follows (kg m2).
    pub given_kgm2: f64,
    /// Of the body that is verified (kg m2).
    pub deck_kgm2: f64,
    /// The same over m R^2.
    pub share: f64,
    /// Largest |u| of our own history of the one and of the other, over what is judged (m).
    pub largest_m: [f64; 2],
    /// How far these two histories are apart at most there (m).
    pub apart_m: f64,
}

/// Up to where a verification tells something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparedReach {
    /// Samples that were followed and compared.
    pub samples: usize,
    /// Samples of the record.
    pub of: usize,
    /// What ends our own history there, if that does.
    pub own_end: Option<OwnEnd>,
    /// Samples from the start that Housner's history counts for: his pivot would have to be pulled
    /// down then, or his history ends, or he overturns and the body on springs does not.
    pub housner: usize,
    /// When he overturns, if that ends them (s).
    pub housner_overturns_s: Option<f64>,
    /// What the deck's body has that the structure has not.
    pub added: Option<AddedInertia>,
}

impl ComparedReach {
    /// Of our own history and Housner's, compared over so many samples.
    pub(super) fn new(
        parameters: &Parameters,
        record: &Record,
        history: &History,
        rocking: &Rocking<f64>,
        samples: usize,
    ) -> Self {
        let body = parameters.structure.body::<f64>();
        let ground = (&record.accel[..], record.up());
        let members = parameters.members();
        let regime = check_with(&body, &members, (record.dt, 1.0), ground, rocking, f64::INFINITY);
        let flight = regime.free_flight.map(|flight| flight.time);
        let ends = rocking.left_ground().into_iter().chain(flight).reduce(f64::min);
        let stands = samples_to_fall(&history.motion.theta) >= history.motion.len();
        let overturns_s = rocking.overturned().filter(|_| stands);
        let overturns_s = overturns_s.filter(|time| ends.is_none_or(|end| *time < end));
        let ends = overturns_s.or(ends);
        let ended = samples >= history.motion.len().min(samples_to_fall(&history.motion.theta));
        Self {
            samples,
            of: record.len(),
            own_end: own_end(history).filter(|_| ended && samples < record.len()),
            housner: samples_until(ends, record.dt).min(rocking.theta.len()).min(samples),
            housner_overturns_s: overturns_s.filter(|time| *time < samples as f64 * record.dt),
            added: None,
        }
    }

    /// With what a body of the structure's own inertia does, if the deck's has more.
    #[must_use]
    pub(super) fn beside(
        self,
        given: &Structure,
        parameters: &Parameters,
        record: &Record,
        history: &History,
    ) -> Self {
        let (given_kgm2, deck_kgm2) =
            (given.rotational_inertia_kgm2, parameters.structure.rotational_inertia_kgm2);
        if given_kgm2 == deck_kgm2 {
            return self;
        }
        let own = simulate(&Parameters { structure: *given, ..parameters.clone() }, record);
        let part = |u: &[f64]| u[..self.samples.min(u.len())].to_vec();
        let [own, deck] = [&own, history].map(|history| part(&history.motion.u));
        let apart = own.iter().zip(&deck).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let body = given.body::<f64>();
        let added = AddedInertia {
            given_kgm2,
            deck_kgm2,
            share: deck_kgm2 / (body.mass * body.radius().powi(2)),
            largest_m: [&own, &deck].map(|u| peak(u).abs()),
            apart_m: apart,
        };
        Self { added: Some(added), ..self }
    }
}

/// How it ended, if before its record.
fn own_end(history: &History) -> Option<OwnEnd> {
    let falls = samples_to_fall(&history.motion.theta) < history.motion.len();
    match history.outcome {
        _ if falls => Some(OwnEnd::Falls),
        HistoryOutcome::Completed => None,
        HistoryOutcome::Overturned { .. } => Some(OwnEnd::Falls),
        HistoryOutcome::WorkBound { .. } => Some(OwnEnd::WorkBound),
        HistoryOutcome::Unstable { .. } => Some(OwnEnd::Unstable),
        HistoryOutcome::Stopped { .. } => Some(OwnEnd::Stopped),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::with_inertia;
    use dynamics::spring::{Design, Springs};
    use rocking::{
        housner::{self, RockingOptions},
        members::{Damper, Friction, Members},
    };

    fn parameters(structure: Structure) -> Parameters {
        let chain = Design::from_kc(0.5, 0.2, 0.92, 160.0);
        Parameters::new(structure, &Springs { vertical: chain, horizontal: chain })
    }

    fn reach(parameters: &Parameters, record: &Record) -> (History, ComparedReach) {
        let history = simulate(parameters, record);
        let options = RockingOptions::on(record, parameters.restitution());
        let body = parameters.structure.body();
        let rocking = housner::solve(&body, record.dt, &record.accel, &options);
        let samples = history.motion.len().min(samples_to_fall(&history.motion.theta));
        let reach = ComparedReach::new(parameters, record, &history, &rocking, samples);
        (history, reach)
    }

    /// A push of 0.6 g topples a block of width to height 0.25; one of 0.1 g does not lift it.
    #[test]
    fn a_body_that_falls_ends_the_comparison_and_one_that_stands_does_not() {
        let block = parameters(Structure::block(2.0, 0.5, 1000.0).unwrap());
        let push = |a: f64| Record::new("push", 0.01, vec![a; 400]).unwrap();
        let (history, fallen) = reach(&block, &push(6.0));
        assert_eq!(fallen.own_end, Some(OwnEnd::Falls));
        assert!(fallen.samples < 400 && history.motion.theta[fallen.samples - 1].abs() >= 1.0);
        let (_, stands) = reach(&block, &push(1.0));
        assert_eq!((stands.own_end, stands.samples, stands.housner), (None, 400, 400));
    }

    /// Ground that falls at 1.5 g from 1 s on lets go of a standing body then.
    #[test]
    fn housners_history_counts_until_his_pivot_leaves_the_ground() {
        let block = parameters(Structure::block(2.0, 0.5, 1000.0).unwrap());
        let up: Vec<f64> = (0..200).map(|i| if i < 100 { 0.0 } else { -14.7 }).collect();
        let record = Record::new("fall", 0.01, vec![0.1; 200]).unwrap();
        let record = record.with_vertical(Record::new("up", 0.01, up).unwrap()).unwrap();
        let (_, reach) = reach(&block, &record);
        assert!((100..=101).contains(&reach.housner), "{reach:?}");
    }

    /// On friction of half of b/h a block slides under the push that topples Housner's.
    #[test]
    fn housners_history_counts_until_he_overturns_beside_a_body_that_slides() {
        let friction = Some(Friction { coefficient: 0.125 });
        let block = parameters(Structure::block(2.0, 0.5, 1000.0).unwrap())
            .with_members(Members { friction, ..Members::default() });
        let record = Record::new("push", 0.01, vec![6.0; 400]).unwrap();
        let (history, slides) = reach(&block, &record);
        let body = block.structure.body::<f64>();
        assert_eq!(slides.samples, history.motion.len());
        let options = RockingOptions::on(&record, block.restitution());
        let rocking = housner::solve(&body, record.dt, &record.accel, &options);
        let time = rocking.overturned().unwrap();
        assert_eq!(slides.housner_overturns_s, Some(time));
        let last = slides.housner - 1;
        assert!(rocking.theta[last].abs() <= body.alpha(), "{slides:?}");
        assert!(rocking.theta[last + 1].abs() > body.alpha(), "{slides:?}");
    }

    /// A point mass with dampers has 5e-4 m R^2 in a deck: said, with how far that moves it. A body
    /// with as much of its own is what its deck holds.
    #[test]
    fn inertia_that_a_deck_adds_is_told_with_what_it_changes() {
        let frame = Structure::a_frame(9.0, 2.1, 120e3).unwrap();
        let frame = Structure { rotational_inertia_kgm2: 90.0, ..frame };
        let damper = Some(Damper { c: 8e4 });
        let given = parameters(frame).with_members(Members { damper, ..Members::default() });
        let structure = with_inertia(&frame, &given.members());
        let deck = Parameters { structure, ..given.clone() };
        let record = Record::el_centro().truncated(4.0);
        let (history, all) = reach(&deck, &record);
        let added = all.beside(&frame, &deck, &record, &history).added.unwrap();
        assert!((added.share / 5e-4 - 1.0).abs() < 1e-12, "{added:?}");
        assert_eq!(added.given_kgm2, 90.0);
        let [own, other] = added.largest_m;
        assert!(added.apart_m > 0.0 && (own - other).abs() <= added.apart_m, "{added:?}");
        assert_eq!(all.beside(&structure, &deck, &record, &history).added, None);
    }
}
