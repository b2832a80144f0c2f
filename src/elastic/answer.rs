//! What an elastic structure does in a ground motion: on rigid ground, on its springs, held to the ground, and as a rigid body.

use nalgebra::DVector;

use super::{
    fem::{Case, History, Start},
    frame::{Base, EquilibriumError, Frame, Layout},
    reference::{
        Corners, ElasticRocking, FORETOLD, Ground, Options, Outcome, PERTURBATION, RestError, at_rest, growth, rock,
    },
    rigid::RigidForces,
    structure::ElasticStructure,
};
use crate::{
    elastic::Mechanics,
    record::Record,
    spring::{Chain, Springs},
};

/// What is watched: something that turns rigidly, and the node above it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Watched {
    /// A footing, or the line between two feet.
    pub base: Base,
    /// Node whose drift against it counts.
    pub top: usize,
}

/// Rotation of a base and drift of the node above it, sample by sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sway {
    /// Clockwise (rad).
    pub rotation: Vec<f64>,
    /// Across the base's axis, without the rigid rotation (m).
    pub drift: Vec<f64>,
}

impl Sway {
    fn of<'a>(frame: &Frame, watched: Watched, all: impl Iterator<Item = &'a [f64]> + Clone) -> Self {
        let Watched { base, top } = watched;
        Self {
            rotation: all.clone().map(|q| base.rotation(frame, q)).collect(),
            drift: all.map(|q| base.drift(frame, top, q)[0]).collect(),
        }
    }
}

/// An elastic structure, assembled.
#[derive(Clone, Debug)]
pub struct Assembled {
    /// As given.
    pub structure: ElasticStructure,
    /// Its parts.
    pub layout: Layout,
    /// The parts assembled.
    pub frame: Frame,
    /// What is watched of it, from left to right.
    pub watched: Vec<Watched>,
}

impl Assembled {
    /// Of a structure; its numbers were checked before, so that its parts fit together.
    ///
    /// # Errors
    /// Parts that do not fit together.
    pub fn new(structure: ElasticStructure) -> Result<Self, super::frame::FrameError> {
        let layout = structure.layout();
        let frame = layout.frame()?;
        let tops: &[usize] = match structure {
            ElasticStructure::Pier(_) => &[1],
            ElasticStructure::AFrame(_) => &[2],
            ElasticStructure::Frame(_) => &[2, 3],
        };
        let watched = Base::all(&frame).into_iter().zip(tops).map(|(base, &top)| Watched { base, top }).collect();
        Ok(Self { structure, layout, frame, watched })
    }

    /// What is watched, at every configuration.
    pub fn sways<'a>(&self, all: impl Iterator<Item = &'a [f64]> + Clone) -> Vec<Sway> {
        self.watched.iter().map(|&watched| Sway::of(&self.frame, watched, all.clone())).collect()
    }

    /// Coordinates whose growth tells of the conditioning: rotations of footings and the tops' displacements.
    fn telling(&self) -> Vec<usize> {
        let turn = |base: Base| match base {
            Base::Footing(node) => self.frame.coordinates(node)[2],
            Base::Feet => None,
        };
        self.watched.iter().flat_map(|w| [turn(w.base), self.frame.coordinates(w.top)[0]]).flatten().collect()
    }
}

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
        let ((reference, fem), fixed) = rayon::join(
            || {
                rayon::join(
                    || rocked(assembled, Ground { dt: record.dt, accel: &record.accel, vertical }),
                    || follow(frame, springs),
                )
            },
            || assembled.layout.fixed().frame().map(|held| follow(&held, &[])),
        );
        let ((reference, predictable), fem) = (reference?, fem?);
        // what holds a frame can hold it fixed
        let fixed = fixed.map_err(|_| EquilibriumError::NoRest { lean: 0.0 })??;
        let of_reference = assembled.sways(reference.q.iter().map(|q| q.as_slice()));
        let of_fem = assembled.sways(fem.q.iter().map(Vec::as_slice));
        let sways: Vec<[Sway; 2]> = of_reference.into_iter().zip(of_fem).map(|(a, b)| [a, b]).collect();
        let errors = errors(&sways, predictable);
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

/// The reference, and how many of its samples can be foretold.
fn rocked(assembled: &Assembled, ground: Ground) -> Result<(ElasticRocking, usize), AnswerError> {
    let frame = &assembled.frame;
    let all = (0..frame.footings().len()).fold(Corners::NONE, Corners::with);
    let q = at_rest(frame, &DVector::zeros(frame.size()), all, &[]).map_err(AnswerError::RestOnGround)?;
    let (still, options) = (DVector::zeros(q.len()), Options::default());
    let history = rock(frame, ground, (&q, &still), &options);
    let coordinates = assembled.telling();
    let grown = growth(frame, ground, (&q, &still), &options, (&history, &coordinates, PERTURBATION));
    let mut until = grown.samples_below(FORETOLD).min(history.q.len());
    if let Outcome::Overturned { time } = history.outcome {
        until = until.min((time / ground.dt) as usize + 1);
    }
    Ok((history, until))
}

/// NRMSE of rotations and drifts over the first samples, all bases together.
pub fn errors(sways: &[[Sway; 2]], samples: usize) -> [f64; 2] {
    let of = |pick: fn(&Sway) -> &[f64]| {
        let (mut difference, mut square) = (0.0, 0.0);
        for [reference, fem] in sways {
            let (reference, fem) = (pick(reference), pick(fem));
            let n = samples.min(reference.len());
            if fem.len() < n {
                return f64::INFINITY;
            }
            for (a, b) in reference[..n].iter().zip(fem) {
                difference += (a - b).powi(2);
                square += a * a;
            }
        }
        if square > 0.0 { (difference / square).sqrt() } else { 0.0 }
    };
    [of(|sway| &sway.rotation), of(|sway| &sway.drift)]
}
