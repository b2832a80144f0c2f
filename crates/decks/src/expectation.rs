//! Over how much of a record a deck is judged by `tune verify`, said before anyone opens OpenSees.

use super::samples_to_fall;
use frames::answer::{Compared, ComparedEnd};
use parameters::{
    Parameters,
    predictability::{Foretold, ForetoldEnd, foretold_until, until_flight, until_time},
};
use results::DeckEnd;
use rocking::motion::Motion;
use strong_motion::Record;

/// Over how much of a record a deck must find our own history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeckExpectation {
    /// Samples.
    pub samples: usize,
    /// What ends it.
    pub end: DeckEnd,
}

impl DeckExpectation {
    /// Of a rigid body's history, beside that of one slightly wider; `until`: up to when the run
    /// found that it can be foretold, if that is not all of it (s).
    pub fn rigid(
        parameters: &Parameters,
        record: &Record,
        motion: &Motion,
        changed: &Motion,
        until: Option<f64>,
    ) -> Self {
        let until = foretold_rigid(parameters, record, [motion, changed], until);
        let fallen = samples_to_fall(&motion.theta);
        match until {
            Some(Foretold { samples, end }) if samples < fallen => {
                let end = match end {
                    ForetoldEnd::Flight => DeckEnd::Flight,
                    ForetoldEnd::Width => DeckEnd::Foretold,
                    ForetoldEnd::IllConditioned => DeckEnd::IllConditioned,
                };
                Self { samples: samples.max(2), end }
            }
            _ if fallen < record.len() => Self { samples: fallen, end: DeckEnd::History },
            _ => Self { samples: fallen, end: DeckEnd::Record },
        }
    }

    /// Of an elastic structure's histories, compared while a change of the motion grows less than
    /// 30-fold.
    pub fn elastic(compared: &Compared) -> Self {
        let end = match compared.end {
            ComparedEnd::Record => DeckEnd::Record,
            ComparedEnd::History => DeckEnd::History,
            ComparedEnd::Foretold => DeckEnd::Foretold,
            ComparedEnd::Slides => DeckEnd::Slides,
        };
        Self { samples: compared.samples, end }
    }
}

/// Up to where a rigid body's history can be foretold, if not to its end: from the history and that
/// of one slightly wider, and from when the run found that it can be foretold (s).
pub fn foretold_rigid(
    parameters: &Parameters,
    record: &Record,
    [motion, changed]: [&Motion; 2],
    until: Option<f64>,
) -> Option<Foretold> {
    foretold_until(motion, changed)
        .into_iter()
        .chain(until_flight(&parameters.structure, record))
        .chain(until.map(|until| until_time(until, record.dt)))
        .filter(|foretold| foretold.samples < motion.len())
        .min_by_key(|foretold| foretold.samples)
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics::spring::{Design, Springs};
    use rocking::{members::Members, structure::Structure};

    fn motion(theta: Vec<f64>) -> Motion {
        Motion { u: theta.clone(), v: theta.clone(), theta }
    }

    fn expected(
        theta: Vec<f64>,
        changed: Vec<f64>,
        up: Option<Vec<f64>>,
        until: Option<f64>,
    ) -> DeckExpectation {
        let chain = Design::from_kc(0.5, 0.2, 0.92, 40.0);
        let frame = crate::with_inertia(&Structure::paper(), &Members::default());
        let parameters = Parameters::new(frame, &Springs { vertical: chain, horizontal: chain });
        let mut record = Record::new("made up", 0.01, vec![0.0; 101]).unwrap();
        if let Some(up) = up {
            record = record.with_vertical(Record::new("up", 0.01, up).unwrap()).unwrap();
        }
        DeckExpectation::rigid(&parameters, &record, &motion(theta), &motion(changed), until)
    }

    #[test]
    fn what_ends_a_history_is_named() {
        let of = |e: DeckExpectation| (e.samples, e.end);
        let small = vec![0.1; 101];
        assert_eq!(of(expected(small.clone(), small.clone(), None, None)), (101, DeckEnd::Record));
        let parts: Vec<f64> = (0..101).map(|i| if i < 60 { 0.1 } else { 0.2 }).collect();
        assert_eq!(of(expected(small.clone(), parts, None, None)), (60, DeckEnd::Foretold));
        let falls: Vec<f64> = (0..80).map(|i| 0.02 * f64::from(i)).collect();
        assert_eq!(of(expected(falls.clone(), falls, None, None)), (51, DeckEnd::History));
        let up = (0..101).map(|i| if i == 40 { -9.9 } else { 0.0 }).collect();
        let flies = expected(small.clone(), small.clone(), Some(up), None);
        assert_eq!((flies.samples, flies.end), (40, DeckEnd::Flight));
        let sensitive = expected(small.clone(), small, None, Some(0.3));
        assert_eq!(of(sensitive), (31, DeckEnd::IllConditioned));
    }
}
