//! An elastic structure, assembled: what is watched of it, where it rests, how it rocks on rigid
//! ground and for how long that can be told.

use nalgebra::DVector;
use thiserror::Error;

use super::{
    Mechanics,
    frame::{Base, Frame, FrameError, FrameLayout, FrameTendon},
    reference::{
        CornerSet, ElasticRocking, GroundAcceleration, PERTURBATION, PerturbedPair,
        ReferenceOptions, RestError, at_rest, growth, rock,
    },
    standing::Standing,
    structure::ElasticStructure,
};
use rocking::{
    members::Members,
    motion::{nrmse_of, samples_until},
    scalar::GRAVITY,
};

/// Stiffness of the ground over all mass, on which a leaning structure is looked for before it is
/// put on rigid ground: its weight settles by g/FIRM, 1e-8 m [1/s2].
const FIRM: f64 = 1e9;

/// Share of its stiffness that a tendon keeps while the structure settles under a tension that is
/// given.
const SOFT: f64 = 1e-9;

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

/// Why a structure with its members cannot be assembled.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)] // messages say what variants are
pub enum AssemblyError {
    #[error(transparent)]
    Frame(#[from] FrameError),
    #[error("under its tendon {0}")]
    Rest(#[from] RestError),
}

/// An elastic structure and its finite elements.
#[derive(Clone, Debug)]
pub struct Assembled {
    /// As given.
    pub structure: ElasticStructure,
    /// What it has besides.
    pub members: Members,
    /// Its parts, members among them.
    pub layout: FrameLayout,
    /// The parts assembled.
    pub frame: Frame,
    /// What is watched of it, from left to right.
    pub watched: Vec<Watched>,
}

impl Assembled {
    /// Of a structure.
    ///
    /// # Errors
    /// Parts that do not fit together: not of a structure that was checked.
    pub fn new(structure: ElasticStructure) -> Result<Self, FrameError> {
        Self::of(structure, Members::default(), structure.layout())
    }

    /// Of a structure with dampers and tendons. A tendon has its pretension when the structure
    /// stands still on rigid ground, settled under its weight and the tendon; on springs and held
    /// to the ground it is the same tendon, as long when slack.
    ///
    /// # Errors
    /// Parts that do not fit together; a structure that does not stand under its tendon.
    pub fn with_members(
        structure: ElasticStructure,
        members: Members,
    ) -> Result<Self, AssemblyError> {
        let layout = stressed(structure.layout_with(&members))?;
        Ok(Self::of(structure, members, layout)?)
    }

    fn of(
        structure: ElasticStructure,
        members: Members,
        layout: FrameLayout,
    ) -> Result<Self, FrameError> {
        let frame = layout.frame()?;
        let tops: &[usize] = match structure {
            ElasticStructure::Pier(_) => &[1],
            ElasticStructure::AFrame(_) => &[2],
            ElasticStructure::Frame(_) => &[2, 3],
        };
        let watched = Base::all(&frame)
            .into_iter()
            .zip(tops)
            .map(|(base, &top)| Watched { base, top })
            .collect();
        Ok(Self { structure, members, layout, frame, watched })
    }

    /// What is watched, at every configuration.
    pub fn sways<'a>(&self, all: impl Iterator<Item = &'a [f64]> + Clone) -> Vec<Sway> {
        let of = |&Watched { base, top }: &Watched| Sway {
            rotation: all.clone().map(|q| base.rotation(&self.frame, q)).collect(),
            drift: all.clone().map(|q| base.drift(&self.frame, top, q)[0]).collect(),
        };
        self.watched.iter().map(of).collect()
    }

    /// At rest on rigid ground, upright.
    ///
    /// # Errors
    /// There is no such place.
    pub fn upright(&self) -> Result<DVector<f64>, RestError> {
        upright(&self.frame)
    }

    /// Ground acceleration, slowly applied, at which the first corner lifts (g), by the statics of
    /// the structure as it gives and sways under its weight; `None` if it does not stand on all of
    /// its corners.
    pub fn uplift_g(&self) -> Option<f64> {
        Some(Standing::new(&self.frame, &self.upright().ok()?)?.uplift()? / GRAVITY)
    }

    /// At rest on the corners of one side, leaning by `lean` (rad), on rigid ground; not of a
    /// frame, which leans as it bends.
    pub fn leaning(&self, lean: f64) -> Option<DVector<f64>> {
        let pivot = usize::from(lean > 0.0);
        let fixed = match self.structure {
            ElasticStructure::Pier(_) => self.frame.coordinates(0)[2]?,
            ElasticStructure::AFrame(_) => self.frame.coordinates(1 - pivot)[1]?,
            ElasticStructure::Frame(_) => return None,
        };
        let firm = FIRM * self.frame.total_mass();
        let q = self.frame.leaning(lean, &[Some([firm; 2]); 2]).ok()?;
        at_rest(&self.frame, &q, CornerSet::NONE.with(pivot), &[fixed]).ok()
    }

    /// From rest at `q` through a motion of rigid ground, by so many units of work at most.
    pub fn rock(
        &self,
        ground: GroundAcceleration,
        q: &DVector<f64>,
        most_work: u64,
    ) -> ElasticRocking {
        let options = ReferenceOptions { most_work, ..ReferenceOptions::default() };
        rock(&self.frame, ground, (q, &DVector::zeros(q.len())), &options)
    }

    /// Samples of such a history over which a perturbation grows less than `limit`, at most its
    /// own.
    pub(crate) fn grown(
        &self,
        ground: GroundAcceleration,
        q: &DVector<f64>,
        history: &ElasticRocking,
        limit: f64,
    ) -> usize {
        let options =
            ReferenceOptions { most_work: history.most_work, ..ReferenceOptions::default() };
        let still = DVector::zeros(q.len());
        let pair =
            PerturbedPair { coordinates: &self.telling(), perturbation: PERTURBATION, limit };
        growth(&self.frame, ground, (q, &still), &options, (history, &pair)).samples_below(limit)
    }

    /// The same, and at most up to where a corner slides on from a landing, which not all springs
    /// follow.
    pub fn foretold(
        &self,
        ground: GroundAcceleration,
        q: &DVector<f64>,
        history: &ElasticRocking,
        limit: f64,
    ) -> usize {
        let grown = self.grown(ground, q, history, limit);
        history
            .first_sliding_landing_s
            .map_or(grown, |time| grown.min(samples_until(Some(time), history.dt)))
    }

    /// Coordinates whose growth tells of the conditioning: rotations of footings and the tops'
    /// displacements.
    fn telling(&self) -> Vec<usize> {
        let turn = |base: Base| match base {
            Base::Footing(node) => self.frame.coordinates(node)[2],
            Base::Feet => None,
        };
        self.watched
            .iter()
            .flat_map(|w| [turn(w.base), self.frame.coordinates(w.top)[0]])
            .flatten()
            .collect()
    }
}

fn upright(frame: &Frame) -> Result<DVector<f64>, RestError> {
    let all = (0..frame.footings().len()).fold(CornerSet::NONE, CornerSet::with);
    at_rest(frame, &DVector::zeros(frame.size()), all, &[])
}

/// A layout whose tendons' tension is that of the settled structure, with that of the unstressed
/// one: it settles under that tension, as if by tendons that keep it, and so lengthens or shortens
/// the real ones.
fn stressed(layout: FrameLayout) -> Result<FrameLayout, AssemblyError> {
    if layout.tendons.is_empty() {
        return Ok(layout);
    }
    let soft = |tendon: &FrameTendon| FrameTendon { stiffness: SOFT * tendon.stiffness, ..*tendon };
    let frame =
        FrameLayout { tendons: layout.tendons.iter().map(soft).collect(), ..layout.clone() }
            .frame()?;
    let lengthened = frame.lengthened(upright(&frame)?.as_slice());
    let tendons = layout.tendons.iter().zip(lengthened);
    let tendons = tendons
        .map(|(t, by)| FrameTendon { pretension: t.pretension - t.stiffness * by, ..*t })
        .collect();
    Ok(FrameLayout { tendons, ..layout })
}

/// NRMSE of the rotations and of the drifts over the first samples, all bases together; infinite
/// where a history does not get so far, and where it moves and the reference does not.
pub fn errors(reference: &[Sway], others: &[Sway], samples: usize) -> [f64; 2] {
    let of = |pick: fn(&Sway) -> &[f64]| {
        let each = || {
            others.iter().zip(reference).map(|(other, reference)| (pick(other), pick(reference)))
        };
        if each().any(|(other, reference)| other.len() < samples.min(reference.len())) {
            return f64::INFINITY;
        }
        nrmse_of(each().flat_map(|(other, reference)| other.iter().zip(reference).take(samples)))
    };
    [of(|sway| &sway.rotation), of(|sway| &sway.drift)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sway(scale: f64) -> Sway {
        let rotation: Vec<f64> = (0..10).map(|i| scale * f64::from(i)).collect();
        Sway { drift: rotation.iter().map(|x| 2.0 * x).collect(), rotation }
    }

    #[test]
    fn errors_are_shares_of_the_reference_and_a_history_too_short_has_none() {
        let [rotation, drift] = errors(&[sway(1.0)], &[sway(1.1)], 10);
        assert!((rotation - 0.1).abs() < 1e-12 && (drift - 0.1).abs() < 1e-12);
        let short = Sway { rotation: vec![0.0; 3], drift: vec![0.0; 3] };
        assert_eq!(errors(&[sway(1.0)], &[short], 10), [f64::INFINITY; 2]);
        // two bases of which one is off by a tenth: over both
        let [both, _] = errors(&[sway(1.0), sway(1.0)], &[sway(1.0), sway(1.1)], 10);
        assert!((both - 0.1 / 2f64.sqrt()).abs() < 1e-12);
        // a reference that stands still: nothing to divide by
        assert_eq!(errors(&[sway(0.0)], &[sway(1.0)], 10), [f64::INFINITY; 2]);
        assert_eq!(errors(&[sway(0.0)], &[sway(0.0)], 10), [0.0; 2]);
    }
}
