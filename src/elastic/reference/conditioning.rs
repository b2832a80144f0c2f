//! How long a history can be told.
//!
//! ```text
//! growth(t) = max over s <= t, coordinates and twins of |q_twin(s) - q(s)| / (peak of |q|) / d
//! ```
//!
//! One twin has the ground's acceleration scaled by 1 + d, in the other every landing leaves 1 - d of the velocities. A history that two models
//! share to within x can be compared up to where the growth times x is what the comparison allows; beyond, only statistics can.

use nalgebra::DVector;

use super::{ElasticRocking, Ground, Options, rock};
use crate::elastic::Mechanics;

/// A history can be compared one to one while a perturbation has grown less than this: springs within a thousandth of the reference are then
/// within 3e-5 of it at every landing, which is what a stance of such a give can be.
pub const FORETOLD: f64 = 30.0;

/// Perturbation whose growth tells how long a history can be foretold.
pub const PERTURBATION: f64 = 1e-6;

/// How perturbations grow.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Time step (s).
    pub dt: f64,
    /// Largest relative separation up to t = i dt, over the perturbation; as long as the shortest of the histories.
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

/// Growth of a perturbation d in the given coordinates of a history; start and options are the history's own.
pub fn growth(
    mechanics: &impl Mechanics,
    ground: Ground,
    start: (&DVector<f64>, &DVector<f64>),
    options: &Options,
    (history, coordinates, d): (&ElasticRocking, &[usize], f64),
) -> Growth {
    let scaled = Options { scale: options.scale * (1.0 + d), ..*options };
    let landed = Options { kept: options.kept * (1.0 - d), ..*options };
    let twins = [scaled, landed].map(|options| rock(mechanics, ground, start, &options));
    let peaks: Vec<f64> =
        coordinates.iter().map(|&c| history.q.iter().fold(0.0, |peak, q| f64::max(peak, q[c].abs()))).collect();
    let samples = twins.iter().map(|twin| twin.q.len()).fold(history.q.len(), usize::min);
    let mut most = 0.0;
    let separation = |i: usize| {
        for twin in &twins {
            for (&c, peak) in coordinates.iter().zip(&peaks) {
                let apart = (twin.q[i][c] - history.q[i][c]).abs();
                if apart > 0.0 {
                    most = f64::max(most, apart / (peak * d));
                }
            }
        }
        most
    };
    Growth { dt: ground.dt, factor: (0..samples).map(separation).collect() }
}
