//! What an elastic structure does in a ground motion: on rigid ground, on its springs, held to the
//! ground, and as a rigid body.

use super::{
    assembled::{Assembled, Sway, errors},
    design_forces::{StructureForces, parts},
    ensemble::Ensemble,
    fem::{ElasticAnalysis, ElasticHistory},
    frame::{EquilibriumError, Frame},
    reference::{ElasticRocking, FOLLOWED, GroundAcceleration, ReferenceOutcome, RestError, TRIED},
    rigid::RigidForces,
};
use dynamics::{
    fem::HistoryOutcome,
    spring::{Chain, Springs},
};
use rocking::{members::Members, motion::samples_until};
use strong_motion::Record;

/// Over how much of a record two histories are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compared {
    /// Samples.
    pub samples: usize,
    /// The same as a length (s).
    pub seconds: f64,
    /// What ends it.
    pub end: ComparedEnd,
}

/// What ends a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComparedEnd {
    /// The record: histories are compared over all of it.
    Record,
    /// A history that ends before, overturned or not to be followed.
    History,
    /// What can be foretold: from then on two models of one structure part, and only statistics
    /// compare them.
    Foretold,
    /// A landing from which a corner slides on: what follows depends on friction.
    Slides,
}

impl Compared {
    /// Of a record of so many samples dt apart, of which `followed` can be compared one to one, by
    /// histories of these lengths.
    pub(crate) fn new(record: &Record, followed: usize, lengths: &[usize]) -> Self {
        let shortest = lengths.iter().copied().fold(record.len(), usize::min);
        let samples = followed.min(shortest);
        let end = match samples {
            n if n >= record.len() => ComparedEnd::Record,
            n if n >= shortest => ComparedEnd::History,
            _ => ComparedEnd::Foretold,
        };
        Self { samples, seconds: samples.saturating_sub(1) as f64 * record.dt, end }
    }

    /// Whether it is all of the record.
    pub fn whole(&self) -> bool {
        self.end == ComparedEnd::Record
    }
}

/// What a structure does in a ground motion on rigid ground with plastic landings.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Motion on rigid ground.
    pub history: ElasticRocking,
    /// Samples of it that can be foretold.
    pub foretold: usize,
    /// Samples that histories are compared over: those, or as many as springs stiff enough follow.
    pub followed: usize,
}

/// What a structure does in a ground motion on rigid ground and on its springs.
#[derive(Clone, Debug)]
pub struct ElasticHistories {
    /// On rigid ground.
    pub reference: Reference,
    /// On its springs.
    pub fem: ElasticHistory,
    /// Of each base in the reference and on the springs.
    pub sways: Vec<[Sway; 2]>,
}

/// The same, and what it is judged beside.
#[derive(Clone, Debug)]
pub struct ElasticAnswer {
    /// On rigid ground and on its springs.
    pub histories: ElasticHistories,
    /// Over how much of the record these two are compared.
    pub compared: Compared,
    /// NRMSE of the rotations and of the drifts over that; infinite where the springs' history does
    /// not get so far, and where it moves and the reference does not.
    pub errors: [f64; 2],
    /// Held to the ground.
    pub fixed: ElasticHistory,
    /// Drift of the first watched node held to the ground (m).
    pub fixed_drift: Vec<f64>,
    /// Peaks over motions near the record, where it cannot be foretold to its end.
    pub ensemble: Option<Ensemble>,
    /// Motions near the record that are left out since a history met its bound.
    pub near_left_out: usize,
    /// The rigid body of the same masses, by Housner's equation; none of a frame, whose columns
    /// rock side by side, and of a structure with members.
    pub rigid: Option<RigidForces>,
    /// Forces to design for, each with whether it is the structure's own.
    pub design: StructureForces,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // messages say what variants are
pub enum AnswerError {
    #[error(transparent)]
    Rest(#[from] EquilibriumError),
    #[error("the structure has no equilibrium on rigid ground ({0}); stiffen its columns")]
    RestOnGround(#[from] RestError),
}

/// The history of a frame through a record, from rest, its forces finely sampled in so many parts
/// to a time step.
fn follow(
    frame: &Frame,
    springs: &[Springs<Chain>],
    record: &Record,
    parts: usize,
) -> Result<ElasticHistory, EquilibriumError> {
    ElasticAnalysis { parts, ..ElasticAnalysis::on_record(frame, springs, record) }.simulate()
}

impl Reference {
    /// Through a record, from rest, foretold for as long as a perturbation grows less than `limit`,
    /// by so many units of work a history.
    ///
    /// # Errors
    /// The structure does not stand.
    pub fn new(
        assembled: &Assembled,
        record: &Record,
        limit: f64,
        most_work: u64,
    ) -> Result<Self, AnswerError> {
        let ground = GroundAcceleration::of(record);
        let q = assembled.upright()?;
        let history = assembled.rock(ground, &q, most_work);
        let foretold = assembled.foretold(ground, &q, &history, limit);
        Ok(Self { history, foretold, followed: foretold })
    }

    /// Length that can be foretold, if that is not all of it (s).
    pub fn foretold_seconds(&self, dt: f64) -> Option<f64> {
        (self.foretold < self.history.q.len()).then(|| self.foretold.saturating_sub(1) as f64 * dt)
    }

    /// When a corner slides on from a landing, if that is where the part that can be foretold ends
    /// (s).
    pub fn slides_on(&self) -> Option<f64> {
        self.history
            .first_sliding_landing_s
            .filter(|time| self.foretold == samples_until(Some(*time), self.history.dt))
    }

    /// The same compared over as much as springs stiff enough may follow, a perturbation growing
    /// less than [`FOLLOWED`]; none if that is no more.
    ///
    /// # Errors
    /// The structure does not stand.
    pub fn further(
        &self,
        assembled: &Assembled,
        record: &Record,
    ) -> Result<Option<Self>, AnswerError> {
        if self.foretold >= self.history.q.len() {
            return Ok(None);
        }
        let ground = GroundAcceleration::of(record);
        let followed = assembled.grown(ground, &assembled.upright()?, &self.history, FOLLOWED);
        Ok((followed > self.followed).then(|| Self { followed, ..self.clone() }))
    }

    /// Samples over which another program's history is compared one to one: a perturbation grows
    /// less than [`TRIED`].
    ///
    /// # Errors
    /// The structure does not stand.
    pub fn tried(&self, assembled: &Assembled, record: &Record) -> Result<usize, AnswerError> {
        let ground = GroundAcceleration::of(record);
        Ok(assembled.foretold(ground, &assembled.upright()?, &self.history, TRIED))
    }

    /// Over how much of the record histories of these lengths, beside this one, are compared, so
    /// many samples being followed.
    pub fn compared(&self, record: &Record, followed: usize, lengths: &[usize]) -> Compared {
        let history = &self.history;
        let compared = Compared::new(record, followed, &[&[history.q.len()], lengths].concat());
        let slides = history
            .first_sliding_landing_s
            .is_some_and(|time| compared.samples == samples_until(Some(time), history.dt));
        let end = if compared.end == ComparedEnd::Foretold && slides {
            ComparedEnd::Slides
        } else {
            compared.end
        };
        Compared { end, ..compared }
    }
}

impl ElasticHistories {
    /// Through a record, from rest, beside its reference.
    ///
    /// # Errors
    /// The structure does not stand.
    pub fn new(
        assembled: &Assembled,
        springs: &[Springs<Chain>],
        record: &Record,
        reference: Reference,
    ) -> Result<Self, AnswerError> {
        let fem =
            follow(&assembled.frame, springs, record, parts(&assembled.structure, record.dt))?;
        let of_reference = assembled.sways(reference.history.q.iter().map(|q| q.as_slice()));
        let of_fem = assembled.sways(fem.q.iter().map(Vec::as_slice));
        let sways = of_reference.into_iter().zip(of_fem).map(|(a, b)| [a, b]).collect();
        Ok(Self { reference, fem, sways })
    }

    /// The sample from which on one of the two overturns: its rotation has passed alpha (rad).
    pub fn falls(&self, alpha: f64) -> Option<usize> {
        let overturned =
            matches!(self.reference.history.outcome, ReferenceOutcome::Overturned { .. })
                || matches!(self.fem.outcome, HistoryOutcome::Overturned { .. });
        let passed = |sway: &Sway| sway.rotation.iter().position(|rotation| rotation.abs() > alpha);
        self.sways.iter().flatten().filter_map(passed).min().filter(|_| overturned)
    }

    /// Over how much of the record histories of these lengths, beside the reference's, are
    /// compared.
    pub fn compared(&self, record: &Record, lengths: &[usize]) -> Compared {
        self.reference.compared(record, self.reference.followed, lengths)
    }
}

impl ElasticAnswer {
    /// Through a record, from rest, beside its reference; motions near the record by so many units
    /// of work each. None: neither these nor the histories by which forces are checked, so that no
    /// force holds.
    ///
    /// # Errors
    /// The structure does not stand.
    pub fn new(
        assembled: &Assembled,
        springs: &[Springs<Chain>],
        record: &Record,
        reference: Reference,
        near: Option<u64>,
    ) -> Result<Self, AnswerError> {
        let held = || {
            // what holds a frame can hold it fixed
            let frame = assembled
                .layout
                .fixed()
                .frame()
                .map_err(|_| EquilibriumError::NoRest { lean: 0.0 })?;
            let history = follow(&frame, &[], record, parts(&assembled.structure, record.dt))?;
            let top = assembled.watched.first().map_or(0, |watched| watched.top);
            let drift = history.q.iter().map(|q| frame.displacement(top, q)[0]).collect();
            Ok::<_, AnswerError>((history, drift))
        };
        let (histories, held) =
            parallel::join(|| ElasticHistories::new(assembled, springs, record, reference), held);
        let (histories, (fixed, fixed_drift)) = (histories?, held?);
        let compared = histories.compared(record, &[]);
        let [reference, fem] =
            [0, 1].map(|k| histories.sways.iter().map(|pair| pair[k].clone()).collect::<Vec<_>>());
        let errors = errors(&reference, &fem, compared.samples);
        let foretold = histories.reference.foretold_seconds(record.dt);
        // a history on the springs that ends before what can be foretold says nothing of peaks
        let ends = histories.fem.outcome.ends_early();
        let short = ends.is_some_and(|end| foretold.is_none_or(|foretold| end < foretold));
        let checked = near.is_some() && !short;
        let near = near.filter(|_| foretold.is_some() && !short);
        let near = near
            .map(|most_work| Ensemble::new(assembled, springs, record, most_work))
            .transpose()?;
        let (ensemble, near_left_out) = near.unwrap_or_default();
        // Housner's equation has no members
        let bare = assembled.members == Members::default();
        let rigid = RigidForces::of(&assembled.structure, record).filter(|_| bare);
        // what is borne in a fall is no demand of rocking
        let alpha = assembled.structure.body().alpha();
        let foretold = foretold
            .into_iter()
            .chain(histories.falls(alpha).map(|i| i as f64 * record.dt))
            .reduce(f64::min);
        let design = StructureForces::new(
            checked,
            (assembled, springs, record),
            (&histories.fem, &fixed),
            foretold,
            rigid.as_ref(),
        )?;
        Ok(Self {
            histories,
            compared,
            errors,
            fixed,
            fixed_drift,
            ensemble,
            near_left_out,
            rigid,
            design,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comparison_ends_with_the_record_a_history_or_what_can_be_foretold() {
        let record = Record::new("made up", 0.01, vec![0.0; 101]).unwrap();
        let of = |followed, lengths: &[usize]| {
            let compared = Compared::new(&record, followed, lengths);
            (compared.samples, compared.end)
        };
        assert_eq!(of(101, &[101]), (101, ComparedEnd::Record));
        assert_eq!(of(60, &[101]), (60, ComparedEnd::Foretold));
        // the reference overturns: all of it can be foretold, and it is not all of the record
        assert_eq!(of(60, &[60]), (60, ComparedEnd::History));
        assert_eq!(of(70, &[101, 60]), (60, ComparedEnd::History));
        assert_eq!(Compared::new(&record, 101, &[101]).seconds, 1.0);
    }
}
