//! A motion and the reference's answer to it: what springs of an elastic structure are judged on.

use nalgebra::DVector;

use super::design::CornerSprings;
use crate::{
    elastic::{
        Mechanics,
        fem::{Case, History, Start},
        frame::Frame,
        reference::{Corners, FORETOLD, Ground, Options, Outcome, PERTURBATION, at_rest, growth, rock},
        structure::ElasticStructure,
    },
    fem::Control,
    record::Record,
};

/// Stiffness of the ground, in units of the weight over a metre, on which a leaning structure is looked for before it is put on rigid ground.
const FIRM: f64 = 1e9;
/// A history whose predictable part is shorter than this share of it is not compared.
const LEAST_SHARE: f64 = 0.2;

/// Rotation and sway of each footing's column at a sample.
pub type Observed = Vec<[f64; 2]>;

/// An elastic structure and its finite elements.
#[derive(Clone, Debug)]
pub struct Model {
    pub structure: ElasticStructure,
    pub frame: Frame,
}

impl Model {
    /// Rotation of each footing [rad] and sway of the mass above it in the footing's axes [m]; of an A-frame, the rotation of the line
    /// between its feet and the displacement of its apex.
    pub fn observed(&self, q: &DVector<f64>) -> Observed {
        let q = q.as_slice();
        let at = |node: usize| {
            let ([x, z], [dx, dz, turn]) = (self.frame.centre(node), self.frame.displacement(node, q));
            ([x + dx, z + dz], turn)
        };
        let sway = |footing: usize, top: usize| {
            let (([x0, z0], turn), ([x, z], _)) = (at(footing), at(top));
            [turn, (x - x0) * turn.cos() - (z - z0) * turn.sin()]
        };
        match self.structure {
            ElasticStructure::Pier(_) => vec![sway(0, 1)],
            ElasticStructure::Frame(_) => vec![sway(0, 2), sway(1, 3)],
            ElasticStructure::AFrame(_) => {
                let ([x0, z0], [x1, z1]) = (at(0).0, at(1).0);
                vec![[(z0 - z1).atan2(x1 - x0), at(2).0[0]]]
            }
        }
    }

    /// Coordinates whose growth tells of a history's conditioning: rotations and sways, or what goes for them.
    fn telling(&self) -> Vec<usize> {
        let (turns, moves): (&[usize], &[usize]) = match self.structure {
            ElasticStructure::Pier(_) => (&[0], &[1]),
            ElasticStructure::Frame(_) => (&[0, 1], &[2, 3]),
            ElasticStructure::AFrame(_) => (&[], &[2]),
        };
        let turn = turns.iter().filter_map(|node| self.frame.coordinates(*node)[2]);
        turn.chain(moves.iter().filter_map(|node| self.frame.coordinates(*node)[0])).collect()
    }

    /// At rest on rigid ground, upright.
    pub fn upright(&self) -> Option<DVector<f64>> {
        let all = (0..self.frame.footings().len()).fold(Corners::NONE, Corners::with);
        at_rest(&self.frame, &DVector::zeros(self.frame.size()), all, &[]).ok()
    }

    /// At rest on the corners of one side, leaning by `lean` (rad), on rigid ground; not of a frame, which leans as it bends.
    pub fn leaning(&self, lean: f64) -> Option<DVector<f64>> {
        let pivot = usize::from(lean > 0.0);
        let fixed = match self.structure {
            ElasticStructure::Pier(_) => self.frame.coordinates(0)[2]?,
            ElasticStructure::AFrame(_) => self.frame.coordinates(1 - pivot)[1]?,
            ElasticStructure::Frame(_) => return None,
        };
        let firm = FIRM * self.frame.total_mass();
        let q = self.frame.leaning(lean, &[Some([firm; 2]); 2]).ok()?;
        at_rest(&self.frame, &q, Corners::NONE.with(pivot), &[fixed]).ok()
    }
}

/// A motion, a start, and the reference's history.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Time step (s).
    pub dt: f64,
    /// Ground acceleration [m/s2].
    pub accel: Vec<f64>,
    /// Lean it is let go from (rad); none if it stands.
    pub lean: Option<f64>,
    /// The reference at the samples, over its predictable part.
    pub reference: Vec<Observed>,
    /// Landings of the reference in it.
    pub landings: usize,
}

/// A history on springs beside the reference.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    /// NRMSE of rotations, of sways.
    pub errors: [f64; 2],
    /// Touches of corners over the reference's part.
    pub touches: usize,
}

/// What a motion comes to.
#[derive(Clone, Debug)]
pub enum Found {
    /// A history to compare with.
    Trial(Trial),
    /// It does not lift the structure, or overturns it, or cannot be followed.
    Unfit,
    /// Its reference cannot be predicted for long enough.
    IllConditioned,
}

impl Found {
    /// The trial, if it is one.
    pub fn trial(self) -> Option<Trial> {
        if let Self::Trial(trial) = self { Some(trial) } else { None }
    }
}

impl Trial {
    /// Let go from a lean.
    pub fn released(model: &Model, lean: f64, dt: f64, duration: f64) -> Found {
        let still = vec![0.0; (duration / dt).ceil() as usize + 1];
        Self::found(model, dt, still, Some(lean))
    }

    /// From rest through a record.
    pub fn shaken(model: &Model, record: &Record) -> Found {
        Self::found(model, record.dt, record.accel.clone(), None)
    }

    fn found(model: &Model, dt: f64, accel: Vec<f64>, lean: Option<f64>) -> Found {
        let Some(q) = lean.map_or_else(|| model.upright(), |lean| model.leaning(lean)) else { return Found::Unfit };
        let still = DVector::zeros(q.len());
        let ground = Ground::horizontal(dt, &accel);
        let options = Options::default();
        let history = rock(&model.frame, ground, (&q, &still), &options);
        if history.outcome != Outcome::Completed || history.landings().next().is_none() {
            return Found::Unfit;
        }
        let coordinates = model.telling();
        let grown = growth(&model.frame, ground, (&q, &still), &options, (&history, &coordinates, PERTURBATION));
        let until = grown.samples_below(FORETOLD).min(history.q.len());
        let landings = history.landings().take_while(|event| event.time < until as f64 * dt).count();
        if (until as f64) < LEAST_SHARE * accel.len() as f64 || landings == 0 {
            return Found::IllConditioned;
        }
        let reference = history.q[..until].iter().map(|q| model.observed(q)).collect();
        Found::Trial(Self { dt, accel, lean, reference, landings })
    }

    /// The finite elements' history on springs; as far as it got.
    pub fn follow(&self, model: &Model, springs: &CornerSprings, control: Control) -> Option<History> {
        let start = self.lean.map_or(Start::Standing, Start::Leaning);
        let case = Case { control, ..Case::new(&model.frame, &springs.corners, start, self.dt, &self.accel) };
        case.simulate().ok()
    }

    /// The errors on springs; infinite where their history does not get as far as the reference.
    pub fn judge(&self, model: &Model, springs: &CornerSprings, control: Control) -> Judged {
        let Some(history) = self.follow(model, springs, control) else {
            return Judged { errors: [f64::INFINITY; 2], touches: 0 };
        };
        let observed = |q: &Vec<f64>| model.observed(&DVector::from_column_slice(q));
        let end = self.reference.len() as f64 * self.dt;
        let touches = history.contacts.iter().filter(|contact| contact.touches && contact.time < end).count();
        Judged { errors: self.errors(&history.q.iter().map(observed).collect::<Vec<_>>()), touches }
    }

    /// NRMSE of rotations and of sways of another history.
    pub fn errors(&self, history: &[Observed]) -> [f64; 2] {
        if history.len() < self.reference.len() {
            return [f64::INFINITY; 2];
        }
        [0, 1].map(|k| {
            let (mut difference, mut square) = (0.0, 0.0);
            for (a, b) in self.reference.iter().zip(history) {
                for (a, b) in a.iter().zip(b) {
                    difference += (a[k] - b[k]).powi(2);
                    square += a[k] * a[k];
                }
            }
            (difference / square).sqrt()
        })
    }
}
