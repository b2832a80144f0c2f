//! Where a reference history is, how it goes on, and what a step makes of it.

use nalgebra::DVector;

use super::{hold::force, stiffness::LastStage};

/// Where the structure is, and what dampers have taken and the ground put in since the start (J).
#[derive(Clone, Debug)]
pub(crate) struct ReferenceState {
    /// Coordinates.
    pub q: DVector<f64>,
    /// Their velocities.
    pub v: DVector<f64>,
    /// Work: taken by dampers, put in by the ground, taken by sliding.
    pub work: [f64; 3],
}

/// How it goes on from there.
#[derive(Clone, Debug)]
pub(crate) struct Rates {
    /// q''.
    pub a: DVector<f64>,
    /// Power: taken by dampers, put in by the ground, taken by sliding (W).
    pub power: [f64; 3],
    /// (corner, horizontal, vertical) force of the ground (N).
    pub forces: Vec<(usize, [f64; 2])>,
}

impl Rates {
    /// Force on a corner; zero if it is not on the ground.
    pub(crate) fn force(&self, corner: usize) -> [f64; 2] {
        force(&self.forces, corner)
    }
}

/// What a step leads to.
#[derive(Clone, Debug)]
pub(crate) struct ReferenceStep {
    pub state: ReferenceState,
    /// Estimate of its error over what is allowed: at most 1 is good.
    pub error: f64,
    /// Power of h that the estimate falls with.
    pub order: f64,
    /// Of an explicit step.
    pub last: Option<LastStage>,
}

/// Errors allowed in a step: this share of a coordinate or velocity, of which 1 % and 10 % of the
/// unit are the least that counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepTolerance(pub f64);

impl StepTolerance {
    /// Of a coordinate that has these values at the ends of the step (m or rad).
    pub(crate) fn place(self, a: f64, b: f64) -> f64 {
        self.0 * (0.01 + a.abs().max(b.abs()))
    }

    /// Of its velocity (m/s or rad/s).
    pub(crate) fn velocity(self, a: f64, b: f64) -> f64 {
        self.0 * (0.1 + a.abs().max(b.abs()))
    }
}

/// The state at a share of a step, by Hermite's polynomial through q, q', q'' of both ends: good
/// enough to look for events.
pub(crate) fn within(ends: [(&ReferenceState, &Rates); 2], h: f64, share: f64) -> ReferenceState {
    let [(start, first), (end, last)] = ends;
    let s = share;
    let (s2, s3) = (s * s, s * s * s);
    let (s4, s5) = (s3 * s, s3 * s2);
    let place = [
        1.0 - 10.0 * s3 + 15.0 * s4 - 6.0 * s5,
        10.0 * s3 - 15.0 * s4 + 6.0 * s5,
        h * (s - 6.0 * s3 + 8.0 * s4 - 3.0 * s5),
        h * (-4.0 * s3 + 7.0 * s4 - 3.0 * s5),
        h * h * 0.5 * (s2 - 3.0 * s3 + 3.0 * s4 - s5),
        h * h * 0.5 * (s3 - 2.0 * s4 + s5),
    ];
    let rate = [
        (-30.0 * s2 + 60.0 * s3 - 30.0 * s4) / h,
        (30.0 * s2 - 60.0 * s3 + 30.0 * s4) / h,
        1.0 - 18.0 * s2 + 32.0 * s3 - 15.0 * s4,
        -12.0 * s2 + 28.0 * s3 - 15.0 * s4,
        h * 0.5 * (2.0 * s - 9.0 * s2 + 12.0 * s3 - 5.0 * s4),
        h * 0.5 * (3.0 * s2 - 8.0 * s3 + 5.0 * s4),
    ];
    let known = [&start.q, &end.q, &start.v, &end.v, &first.a, &last.a];
    let sum = |weights: [f64; 6]| {
        known
            .iter()
            .zip(weights)
            .fold(DVector::zeros(start.q.len()), |sum, (x, weight)| sum + *x * weight)
    };
    let work = std::array::from_fn(|k| start.work[k] + share * (end.work[k] - start.work[k]));
    ReferenceState { q: sum(place), v: sum(rate), work }
}
