//! What is kept of a finite element history while it runs: sums and peaks, no samples.
//!
//! A body beyond alpha by beta, not coming back, falls whatever the ground still does if the
//! tangent of beta is above max |a_g|/g of the rest of the record: by equation (1) theta'' = p^2
//! [sin(beta) - (a_g/g) cos(beta)] then stays on the side of the fall. The history is stopped
//! there. To follow the fall any further costs a lot and says nothing: from 48 degrees on an
//! A-frame's leg would have to pull, and a body without rotational inertia flies and spins.

use std::{borrow::Cow, ops::ControlFlow};

use super::peaks::{HousnerForces, PeakPairs};
use dynamics::fem::{Change, HistoryOutcome, Observer, View};
use rocking::{housner::topples, scalar::GRAVITY, structure::Body};

/// Effective horizontal acceleration a_g/(1 + a_v/g) at the samples (m/s2), against which a body
/// beyond alpha must fall. Its maximum lies at a sample; infinite where the ground falls faster
/// than the body. `vertical` is empty where there is none.
pub fn effective_acceleration<'a>(accel: &'a [f64], vertical: &[f64]) -> Cow<'a, [f64]> {
    if vertical.is_empty() {
        return Cow::Borrowed(accel);
    }
    let effective = |(i, a): (usize, &f64)| {
        let gamma = 1.0 + vertical.get(i).map_or(0.0, |up| up / GRAVITY);
        if gamma > 0.0 { a / gamma } else { f64::INFINITY }
    };
    Cow::Owned(accel.iter().enumerate().map(effective).collect())
}

/// sqrt( sum (x - x_ref)^2 / sum x_ref^2 ) of samples that come one by one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nrmse {
    above: f64,
    below: f64,
}

impl Nrmse {
    fn push(&mut self, x: f64, reference: f64) {
        self.above += (x - reference) * (x - reference);
        self.below += reference * reference;
    }

    /// As [`rocking::motion::nrmse`]: zero when all differences are, infinite when the reference
    /// alone is zero.
    pub fn value(&self) -> f64 {
        if self.above == 0.0 { 0.0 } else { (self.above / self.below).sqrt() }
    }
}

/// Errors over the samples that both histories have.
#[derive(Clone, Copy, Debug, Default)]
pub struct StreamErrors {
    pub horizontal: Nrmse,
    pub vertical: Nrmse,
    /// Peaks of both.
    pub peaks: PeakPairs,
    pub samples: usize,
}

/// Watches a finite element history beside Housner's rotations at the same samples.
pub struct ComparisonObserver<'a> {
    body: &'a Body<f64>,
    housner: &'a [f64],
    accel: &'a [f64],
    /// His forces, where peaks of forces are compared.
    forces: Option<&'a HousnerForces>,
    /// When a foot touched the ground last (s).
    touched: f64,
    /// Velocities u', v' of the centre of mass at the last sample (m/s).
    velocity: [f64; 2],
    /// Slenderness angle alpha (rad).
    alpha: f64,
    /// Index and size of the largest |a_g| of the rest of the record (m/s2).
    strongest: Option<(usize, f64)>,
    initial_z: f64,
    pub errors: StreamErrors,
    /// The same up to the last sample at which the body leaned by alpha or less: what a body that
    /// topples is judged by.
    pub upright: StreamErrors,
    /// Largest |theta| while a foot is off the ground (rad).
    pub peak: f64,
    /// theta (rad) and theta' (rad/s) at the last sample.
    pub last: (f64, f64),
    /// Samples seen.
    pub samples: usize,
    /// Largest |residual| of the energy account (J).
    pub residual: f64,
}

impl<'a> ComparisonObserver<'a> {
    /// Whether the body overturns in a history that ended so: one that stands at its end may fall
    /// after it. None if the history failed.
    pub fn overturned(&self, outcome: HistoryOutcome) -> Option<bool> {
        match outcome {
            HistoryOutcome::Overturned { .. } | HistoryOutcome::Stopped { .. } => Some(true),
            HistoryOutcome::Completed => Some(topples(self.body, self.last.0, self.last.1)),
            HistoryOutcome::WorkBound { .. } | HistoryOutcome::Unstable { .. } => None,
        }
    }

    /// Beside Housner's rotations (rad), as far as they shall be compared; `accel` is the record
    /// (m/s2).
    pub fn new(body: &'a Body<f64>, housner: &'a [f64], accel: &'a [f64]) -> Self {
        Self {
            body,
            housner,
            accel,
            forces: None,
            touched: f64::NEG_INFINITY,
            velocity: [0.0; 2],
            alpha: body.alpha(),
            strongest: None,
            initial_z: 0.0,
            errors: StreamErrors::default(),
            upright: StreamErrors::default(),
            peak: 0.0,
            last: (0.0, 0.0),
            samples: 0,
            residual: 0.0,
        }
    }

    /// The same that compares the peaks of forces, too.
    pub fn with_forces(self, forces: &'a HousnerForces) -> Self {
        Self { forces: Some(forces), ..self }
    }

    /// The largest |a_g| from a sample to the end (m/s2); looked for anew only when that sample has
    /// passed.
    fn strongest_from(&mut self, index: usize) -> f64 {
        match self.strongest {
            Some((at, size)) if at >= index => size,
            _ => {
                let rest = self.accel.iter().map(|a| a.abs()).enumerate().skip(index);
                let found =
                    rest.fold((index, 0.0), |best, (i, a)| if a >= best.1 { (i, a) } else { best });
                self.strongest = Some(found);
                found.1
            }
        }
    }

    /// Whether the body falls whatever the ground does from this sample on.
    fn falls_from(&mut self, index: usize) -> bool {
        let (theta, rate) = self.last;
        let beyond = theta.abs() - self.alpha;
        beyond > 0.0 && theta * rate >= 0.0 && beyond.tan() > self.strongest_from(index) / GRAVITY
    }
}

/// A history on springs at a sample.
pub(crate) struct HistorySample {
    /// Displacement of the centre of mass from where it stands, to the right and up (m).
    pub place: [f64; 2],
    /// Its velocity (m/s).
    pub velocity: [f64; 2],
    /// (rad)
    pub theta: f64,
    /// (rad/s)
    pub rate: f64,
    /// Whether both feet press.
    pub stands: bool,
}

impl ComparisonObserver<'_> {
    /// Records a sample; returns Break once the body is certain to fall.
    #[inline]
    pub(crate) fn take(&mut self, index: usize, now: &HistorySample) -> ControlFlow<()> {
        let HistorySample { place, velocity, theta, rate, stands } = *now;
        let lean = if stands { 0.0 } else { theta };
        if let Some(&housner) = self.housner.get(index) {
            let u = self.body.u(housner);
            self.errors.peaks.motion([place[0], u], [lean, housner]);
            if let Some(forces) = self.forces {
                self.errors.peaks.interval(forces, index, self.touched, [self.velocity, velocity]);
            }
            self.errors.horizontal.push(place[0], u);
            self.errors.vertical.push(place[1], self.body.v(housner));
            self.errors.samples = index + 1;
        }
        self.velocity = velocity;
        if theta.abs() <= self.alpha {
            self.upright = self.errors;
        }
        self.peak = self.peak.max(lean.abs());
        self.last = (theta, rate);
        self.samples = index + 1;
        if self.falls_from(index) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Observer for ComparisonObserver<'_> {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        if index == 0 {
            self.initial_z = view.z();
        }
        self.residual = self.residual.max(view.energy.residual().abs());
        self.take(
            index,
            &HistorySample {
                place: [view.x(), view.z() - self.initial_z],
                velocity: [view.speed(), view.climb()],
                theta: view.theta(),
                rate: view.theta_rate(),
                stands: view.presses(0) && view.presses(1),
            },
        )
    }

    fn event(&mut self, _: usize, change: Change, view: &View) {
        if change == Change::TouchDown {
            self.touched = view.time;
        }
    }
}
