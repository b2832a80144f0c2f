//! How long a history can be told.
//!
//! ```text
//! growth(t) = max over s <= t, coordinates and perturbed histories of |q_perturbed(s) - q(s)| / (peak of |q|, at least 1e-9) / d
//! ```
//!
//! One perturbed history has the ground's acceleration scaled by 1 + d, in the other every landing
//! leaves 1 - d of the velocities. A history that two models share to within x can be compared up
//! to where the growth times x is what the comparison allows; beyond, only statistics can.

use nalgebra::DVector;

use super::{ElasticRocking, GroundAcceleration, ReferenceOptions, walk::ReferenceWalk};
use crate::Mechanics;

/// A history can be foretold while a perturbation has grown less than this: what began as a
/// millionth is then a thousandth of the peak.
pub const FORETOLD: f64 = 1e3;

/// Springs stiffer than the accuracy asks for may follow a history on, while it has grown less than
/// this.
pub const FOLLOWED: f64 = 1e5;

/// Springs are tried on motions, and OpenSees is compared, while it has grown less than this: what
/// is then within a thousandth is within 3e-5 at every landing.
pub const TRIED: f64 = 30.0;

/// Perturbation whose growth tells how long a history can be foretold.
pub const PERTURBATION: f64 = 1e-6;

/// A coordinate that never becomes larger than this stands still: what two histories differ by is
/// rounding (m or rad).
const STILL: f64 = 1e-9;

/// How perturbations grow.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Time step (s).
    pub dt: f64,
    /// Largest relative separation up to t = i dt, over the perturbation; as long as the shortest
    /// of the histories, or up to the limit.
    pub factor: Vec<f64>,
}

impl Growth {
    /// Number of samples over which the growth stays below a limit.
    pub fn samples_below(&self, limit: f64) -> usize {
        self.factor.iter().take_while(|&&factor| factor < limit).count()
    }

    /// Time up to which it does (s).
    pub fn predictable(&self, limit: f64) -> f64 {
        self.samples_below(limit).saturating_sub(1) as f64 * self.dt
    }

    /// Growth at the end.
    pub fn last(&self) -> f64 {
        self.factor.last().copied().unwrap_or(0.0)
    }
}

/// What two histories are told apart by: a perturbation d, in these coordinates, up to a growth.
#[derive(Clone, Copy, Debug)]
pub struct PerturbedPair<'a> {
    /// Indices of coordinates.
    pub coordinates: &'a [usize],
    /// d.
    pub perturbation: f64,
    /// Growth beyond which a perturbed history is not followed.
    pub limit: f64,
}

/// Growth of a perturbation of a history; start and options are the history's own.
pub fn growth(
    mechanics: &(impl Mechanics + Sync),
    ground: GroundAcceleration,
    start: (&DVector<f64>, &DVector<f64>),
    options: &ReferenceOptions,
    (history, pair): (&ElasticRocking, &PerturbedPair),
) -> Growth {
    let &PerturbedPair { coordinates, perturbation: d, limit } = pair;
    let peaks: Vec<f64> = coordinates
        .iter()
        .map(|&c| history.q.iter().fold(STILL, |peak, q| f64::max(peak, q[c].abs())))
        .collect();
    let perturbed = |options: &ReferenceOptions| {
        let (mut most, mut factor) = (0.0, Vec::with_capacity(history.q.len()));
        let apart = |q: &DVector<f64>| {
            let Some(other) = history.q.get(factor.len()) else { return false };
            for (&c, peak) in coordinates.iter().zip(&peaks) {
                let apart = (q[c] - other[c]).abs();
                if apart > 0.0 {
                    most = f64::max(most, apart / (peak * d));
                }
            }
            factor.push(most);
            most < limit
        };
        ReferenceWalk::new(mechanics, ground, start, options).run(apart);
        factor
    };
    let (scaled, landed) = parallel::join(
        || perturbed(&ReferenceOptions { scale: options.scale * (1.0 + d), ..*options }),
        || perturbed(&ReferenceOptions { kept: options.kept * (1.0 - d), ..*options }),
    );
    Growth {
        dt: ground.dt,
        factor: scaled.iter().zip(&landed).map(|(a, b)| f64::max(*a, *b)).collect(),
    }
}
