//! What an elastic structure does in a ground motion: on rigid ground, on its springs, held to the ground, and as a rigid body.

use super::{
    assembled::{Assembled, Sway, errors},
    fem::{Case, History, Start},
    frame::{EquilibriumError, Frame},
    reference::{ElasticRocking, Ground, RestError},
    rigid::RigidForces,
};
use crate::{
    record::Record,
    spring::{Chain, Springs},
};

/// What a structure does in a ground motion.
#[derive(Clone, Debug)]
pub struct ElasticAnswer {
    /// On rigid ground with plastic landings.
    pub reference: ElasticRocking,
    /// Samples over which the reference can be foretold.
    pub predictable: usize,
    /// On its springs.
    pub fem: History,
    /// Held to the ground.
    pub fixed: History,
    /// The rigid body of the same masses, by Housner's equation; none of a frame, whose columns rock side by side.
    pub rigid: Option<RigidForces>,
    /// Of each base in the reference and on the springs.
    pub sways: Vec<[Sway; 2]>,
    /// NRMSE of the rotations and of the drifts over the predictable part.
    pub errors: [f64; 2],
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // messages say what variants are
pub enum AnswerError {
    #[error(transparent)]
    Rest(#[from] EquilibriumError),
    #[error("the structure finds no rest on rigid ground ({0}); stiffen its columns")]
    RestOnGround(RestError),
}

impl ElasticAnswer {
    /// Through a record, from rest.
    ///
    /// # Errors
    /// The structure does not stand.
    pub fn new(assembled: &Assembled, springs: &[Springs<Chain<f64>>], record: &Record) -> Result<Self, AnswerError> {
        let frame = &assembled.frame;
        let vertical: &[f64] = record.vertical.as_ref().map_or(&[], |vertical| &vertical.accel);
        let follow = |frame: &Frame, springs: &[Springs<Chain<f64>>]| {
            Case { vertical, ..Case::new(frame, springs, Start::Standing, record.dt, &record.accel) }.simulate()
        };
        let ground = Ground { dt: record.dt, accel: &record.accel, vertical };
        let reference = || {
            let q = assembled.upright().map_err(AnswerError::RestOnGround)?;
            let history = assembled.rock(ground, &q);
            let predictable = assembled.foretold(ground, &q, &history);
            Ok::<_, AnswerError>((history, predictable))
        };
        let ((reference, fem), fixed) = rayon::join(
            || rayon::join(reference, || follow(frame, springs)),
            || assembled.layout.fixed().frame().map(|held| follow(&held, &[])),
        );
        let ((reference, predictable), fem) = (reference?, fem?);
        // what holds a frame can hold it fixed
        let fixed = fixed.map_err(|_| EquilibriumError::NoRest { lean: 0.0 })??;
        let of_reference = assembled.sways(reference.q.iter().map(|q| q.as_slice()));
        let of_fem = assembled.sways(fem.q.iter().map(Vec::as_slice));
        let errors = errors(&of_reference, &of_fem, predictable);
        let sways: Vec<[Sway; 2]> = of_reference.into_iter().zip(of_fem).map(|(a, b)| [a, b]).collect();
        let rigid = RigidForces::of(&assembled.structure, record);
        Ok(Self { reference, predictable, fem, fixed, rigid, sways, errors })
    }

    /// Length over which both can be compared (s).
    pub fn compared_s(&self) -> f64 {
        self.predictable.saturating_sub(1) as f64 * self.fem.dt
    }

    /// Whether the whole motion can be foretold.
    pub fn predictable_to_its_end(&self) -> bool {
        self.predictable >= self.reference.q.len()
    }
}
