//! What a deck can be expected to find, said before anyone opens the program it is for.

#![allow(dead_code)] // for what is said of a run

use super::{DeckFormat, FALLEN};
use crate::{
    elastic::answer::{Compared, ComparedEnd},
    members::Members,
    motion::Motion,
    parameters::Parameters,
    predictability::{Foretold, ForetoldEnd, foretold_until, until_flight},
    record::Record,
};

/// Why a deck's history is judged for less than the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeckEnd {
    /// All of the record is judged.
    Record,
    /// The body falls over, or our own history ends.
    History,
    /// From there on it hangs on the fifth digit of the width, or on small changes of the motion.
    Foretold,
    /// The ground falls faster than a body that has no rotational inertia of its own.
    Flight,
    /// A corner slides on from a landing: what follows depends on friction.
    Slides,
}

/// A deck beside our own history.
#[derive(Clone, Debug, PartialEq)]
pub struct DeckExpectation {
    /// Samples over which the deck must find our own history.
    pub samples: usize,
    /// The same as a length (s).
    pub judged_s: f64,
    /// Length of the record (s).
    pub record_s: f64,
    /// What ends it.
    pub end: DeckEnd,
    /// What a format leaves out, for which reason there is no deck in it.
    pub left_out: Vec<(DeckFormat, &'static str)>,
}

impl DeckExpectation {
    fn new(record: &Record, (samples, end): (usize, DeckEnd), members: &Members<f64>) -> Self {
        let seconds = |samples: usize| samples.saturating_sub(1) as f64 * record.dt;
        let left_out = [
            ("friction", members.friction.is_some()),
            ("damper", members.damper.is_some()),
            ("tendon", members.tendon.is_some()),
            ("vertical ground motion", record.vertical.is_some()),
        ];
        let left_out = left_out.into_iter().filter(|(_, there)| *there).map(|(name, _)| (DeckFormat::Sap2000, name));
        let (judged_s, record_s) = (seconds(samples), seconds(record.len()));
        Self { samples, judged_s, record_s, end, left_out: left_out.collect() }
    }

    /// Of a rigid body's history, beside that of one slightly wider.
    pub fn rigid(parameters: &Parameters, record: &Record, motion: &Motion, changed: &Motion) -> Self {
        let until = foretold_rigid(parameters, record, motion, changed);
        let fallen = motion.theta.iter().position(|theta| theta.abs() >= FALLEN).map_or(motion.len(), |i| i + 1);
        let part = match until {
            Some(Foretold { samples, end }) if samples < fallen => {
                let end = if end == ForetoldEnd::Flight { DeckEnd::Flight } else { DeckEnd::Foretold };
                (samples.max(2), end)
            }
            _ if fallen < record.len() => (fallen, DeckEnd::History),
            _ => (fallen, DeckEnd::Record),
        };
        Self::new(record, part, &parameters.members())
    }

    /// Of an elastic structure's histories, compared while a change of the motion grows less than 30-fold, as `tune verify` does.
    pub fn elastic(compared: &Compared, record: &Record, members: &Members<f64>) -> Self {
        let end = match compared.end {
            ComparedEnd::Record => DeckEnd::Record,
            ComparedEnd::History => DeckEnd::History,
            ComparedEnd::Foretold => DeckEnd::Foretold,
            ComparedEnd::Slides => DeckEnd::Slides,
        };
        Self::new(record, (compared.samples, end), members)
    }
}

/// Up to where a rigid body's history can be foretold, if not to its end.
pub fn foretold_rigid(parameters: &Parameters, record: &Record, motion: &Motion, changed: &Motion) -> Option<Foretold> {
    foretold_until(motion, changed)
        .into_iter()
        .chain(until_flight(&parameters.structure, record))
        .filter(|foretold| foretold.samples < motion.len())
        .min_by_key(|foretold| foretold.samples)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        spring::{Design, Springs},
        structure::Structure,
    };

    fn motion(theta: Vec<f64>) -> Motion {
        Motion { u: theta.clone(), v: theta.clone(), theta }
    }

    fn expected(theta: Vec<f64>, changed: Vec<f64>, up: Option<Vec<f64>>) -> DeckExpectation {
        let chain = Design::from_kc(0.5, 0.2, 0.92, 40.0);
        let frame = crate::export::with_inertia(&Structure::paper());
        let parameters = Parameters::new(frame, &Springs { vertical: chain, horizontal: chain });
        let mut record = Record::new("made up", 0.01, vec![0.0; 101]).unwrap();
        if let Some(up) = up {
            record = record.with_vertical(Record::new("up", 0.01, up).unwrap()).unwrap();
        }
        DeckExpectation::rigid(&parameters, &record, &motion(theta), &motion(changed))
    }

    #[test]
    fn what_ends_a_history_is_named() {
        let of = |e: DeckExpectation| (e.samples, e.end);
        let small = vec![0.1; 101];
        assert_eq!(of(expected(small.clone(), small.clone(), None)), (101, DeckEnd::Record));
        let parts: Vec<f64> = (0..101).map(|i| if i < 60 { 0.1 } else { 0.2 }).collect();
        assert_eq!(of(expected(small.clone(), parts, None)), (60, DeckEnd::Foretold));
        let falls: Vec<f64> = (0..80).map(|i| 0.02 * f64::from(i)).collect();
        assert_eq!(of(expected(falls.clone(), falls, None)), (51, DeckEnd::History));
        let up = (0..101).map(|i| if i == 40 { -9.9 } else { 0.0 }).collect();
        let flies = expected(small.clone(), small, Some(up));
        assert_eq!((flies.samples, flies.end, flies.left_out.len()), (40, DeckEnd::Flight, 1));
    }
}
