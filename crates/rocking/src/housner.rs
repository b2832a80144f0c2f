//! Rigid rocking: Housner's equation through a record.
//!
//! ```text
//! (1),(3)  theta'' + p^2 [ gamma sin(alpha s - theta) + (a_g/g) cos(alpha s - theta) ] = 0,   s = sgn(theta)
//! (2)      at theta = 0 (impact) theta' jumps to e theta',   e = 1 - (m R^2/I0)(1 - cos 2 alpha)
//! ```
//!
//! from Ma, Butterworth & Davidson, NZSEE Conference 2005, after Housner (1963).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | theta | rotation, positive leaning to the right | rad |
//! | alpha | slenderness angle atan(b/h) | rad |
//! | p^2 | m g R / I0 | 1/s2 |
//! | a_g | horizontal ground acceleration, linear between samples | m/s2 |
//! | gamma | 1 + a_v/g: a_v is the vertical ground acceleration, positive upwards; 1 without it, as in the paper | - |
//! | e | velocity restitution; the paper's r = e^2 is an energy ratio | - |
//!
//! At rest the body stays down until |a_g| > (g + a_v) tan(alpha). With vertical motion a history
//! ends where the pivot's normal force falls to zero (`contact`); without it the regime's warnings
//! tell. A tendon and dampers add their torques (`restraint`). Every step ends at a sample, since
//! the record has a kink there: the kinks, not a tolerance, decide the accuracy. One Taylor step
//! spans an interval (`series`), impacts are roots of the step's polynomial (`root`), and all of it
//! is generic in the scalar, so derivatives pass through the events (`walk`).

mod contact;
mod interval;
mod lanes;
mod many;
mod numbers;
mod rest;
mod restraint;
mod root;
mod samples;
mod series;
mod walk;

pub use many::{RockingSummary, solve_lanes, summaries};
pub(crate) use restraint::Restraint;
pub(crate) use series::StepStart;

use crate::members::Members;
use crate::motion::{Motion, largest_magnitude, samples_until};
use crate::scalar::{GRAVITY, Scalar, real};
use crate::structure::Body;
use std::sync::Arc;
use strong_motion::Record;

/// How to solve.
#[derive(Clone, Debug)]
pub struct RockingOptions<S> {
    /// Factor on the record's acceleration, both components.
    pub scale: S,
    /// Vertical ground acceleration at the same times (m/s2), positive upwards; zero after its last
    /// sample. None: the ground does not move up and down, and the pivot's force is not looked at.
    pub vertical: Option<Arc<[f64]>>,
    /// Velocity restitution e, 0 to 1; by equation (2) unless given.
    pub restitution: Option<S>,
    /// What the body has besides; a tendon and dampers act on it, friction does not: the pivot
    /// holds.
    pub members: Members,
    /// Stop after this time (s); at the record's end unless given.
    pub duration: Option<f64>,
    /// theta (rad) and theta' (rad/s) at t = 0; at rest unless given.
    pub initial: Option<(S, S)>,
    /// Bound on steps and impacts in intervals with events, so that no input can hang.
    pub max_work: usize,
}

impl<S: Scalar> Default for RockingOptions<S> {
    fn default() -> Self {
        Self {
            scale: S::one(),
            vertical: None,
            restitution: None,
            members: Members::default(),
            duration: None,
            initial: None,
            max_work: 2_000_000,
        }
    }
}

impl RockingOptions<f64> {
    /// On a record, with its vertical component, and this restitution.
    pub fn on(record: &Record, restitution: f64) -> Self {
        let (vertical, restitution) = (record.vertical_accel(), Some(restitution));
        Self { vertical, restitution, ..Self::default() }
    }

    /// The same of a body with these members.
    #[must_use]
    pub fn with_members(self, members: Members) -> Self {
        Self { members, ..self }
    }
}

/// theta = 0: the body lands on its other foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<S> {
    /// Time of the impact (s).
    pub time: S,
    /// theta' before the impact (rad/s).
    pub rate_before: S,
    /// theta' after it, e times that (rad/s).
    pub rate_after: S,
}

/// A resting body leaves the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uplift<S> {
    /// Time of the uplift (s).
    pub time: S,
    /// +1 if it leans to the right, -1 if to the left.
    pub side: f64,
}

/// How a history ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RockingOutcome {
    /// It rocked and did not overturn.
    Rocked,
    /// The ground never lifted it.
    NeverMoved,
    /// It lay flat (|theta| = pi/2) within the history, which is cut there; or the history ends
    /// (with vertical motion also where the pivot lets go) with the body beyond alpha, and it would
    /// go on falling if the ground stopped.
    Overturned {
        /// When |theta| last grew past alpha (s).
        time: f64,
    },
    /// With vertical motion: the pivot's normal force falls to zero while the body is not falling
    /// over. The history is cut there, for Housner's equation says nothing of what follows.
    LeavesGround {
        /// When it does (s).
        time: f64,
    },
    /// More steps and impacts than [`RockingOptions::max_work`]; the history is cut there.
    WorkBound {
        /// When the bound was met (s).
        time: f64,
    },
    /// The input or the motion is not finite; the history is cut there.
    NotFinite {
        /// Where it is cut (s).
        time: f64,
    },
}

/// A history of rigid rocking.
#[derive(Clone, Debug, PartialEq)]
pub struct Rocking<S> {
    /// theta at the samples t = i dt (rad); shorter than the record if the outcome says so.
    pub theta: Vec<S>,
    /// theta' at the samples (rad/s).
    pub rate: Vec<S>,
    /// Impacts in order of time; the last of infinitely many before a rest are left out.
    pub impacts: Vec<Impact<S>>,
    /// Uplifts from rest in order of time.
    pub uplifts: Vec<Uplift<S>>,
    /// How it ended.
    pub outcome: RockingOutcome,
}

/// Rock a body on a record: ground accelerations (m/s2) at t = 0, dt, 2 dt ... (s), linear between
/// them. It never fails: what went wrong is the history's [`RockingOutcome`].
pub fn solve(
    body: &Body<f64>,
    dt: f64,
    accel: &[f64],
    options: &RockingOptions<f64>,
) -> Rocking<f64> {
    solve_with_derivatives(body, dt, accel, options)
}

/// Options of a body that is let go at theta (rad) with its rate (rad/s).
pub fn released<S: Scalar>(theta: S, rate: S) -> RockingOptions<S> {
    RockingOptions { initial: Some((theta, rate)), ..RockingOptions::default() }
}

/// As [`solve`], from rest, unscaled, with equation 2's restitution and without vertical motion.
pub fn history(body: &Body<f64>, dt: f64, accel: &[f64]) -> Rocking<f64> {
    solve(body, dt, accel, &RockingOptions::default())
}

/// As [`solve`] in dual numbers: the history and its derivatives by what of body and options has
/// some.
pub fn solve_with_derivatives<S: Scalar>(
    body: &Body<S>,
    dt: f64,
    accel: &[f64],
    options: &RockingOptions<S>,
) -> Rocking<S> {
    let set = setting(body, dt, accel, options);
    match options.vertical {
        None => walk::walk::<S, false>(set, start(options)),
        Some(_) => walk::walk::<S, true>(set, start(options)),
    }
}

fn start<S: Scalar>(options: &RockingOptions<S>) -> (S, S) {
    options.initial.unwrap_or((real(0.0), real(0.0)))
}

fn setting<'a, S: Scalar>(
    body: &Body<S>,
    dt: f64,
    accel: &'a [f64],
    options: &'a RockingOptions<S>,
) -> walk::Setting<'a, S> {
    let radius = body.radius();
    walk::Setting {
        dt,
        accel: &accel[..samples_until(options.duration, dt).min(accel.len())],
        vertical: options.vertical.as_deref().unwrap_or_default(),
        unit: options.scale / GRAVITY,
        alpha: body.alpha(),
        sin_alpha: body.half_width / radius,
        cos_alpha: body.height / radius,
        lift: body.half_width / body.height,
        p2: body.p_squared(),
        arm: radius.re() / GRAVITY,
        e: options.restitution.unwrap_or_else(|| body.restitution()),
        restraint: restraint::Restraint::of(body, &options.members),
        max_work: options.max_work,
    }
}

/// Whether a body left alone on still ground with this theta (rad) and theta' (rad/s) falls: it is
/// beyond alpha, and what brings it back is too slow to reach alpha.
pub fn topples(body: &Body<f64>, theta: f64, rate: f64) -> bool {
    topples_with(body, Members::default(), theta, rate)
}

/// The same of a body with members: it falls where its energy takes it to the ground.
pub(crate) fn topples_with(body: &Body<f64>, members: Members, theta: f64, rate: f64) -> bool {
    let options = released(theta, rate).with_members(members);
    solve(body, 1.0, &[0.0], &options).overturned().is_some()
}

impl RockingOutcome {
    fn overturned(&self) -> Option<f64> {
        match *self {
            Self::Overturned { time } => Some(time),
            _ => None,
        }
    }
}

impl<S> Rocking<S> {
    /// When |theta| last grew past alpha, if the body overturned (s).
    pub fn overturned(&self) -> Option<f64> {
        self.outcome.overturned()
    }

    /// When the pivot let go of the ground, if that ended the history (s).
    pub fn left_ground(&self) -> Option<f64> {
        match self.outcome {
            RockingOutcome::LeavesGround { time } => Some(time),
            _ => None,
        }
    }
}

impl Rocking<f64> {
    /// What it came to.
    pub fn summary(&self) -> RockingSummary {
        let last = |samples: &[f64]| samples.last().copied().unwrap_or(0.0);
        RockingSummary {
            outcome: self.outcome,
            samples: self.theta.len(),
            peak: largest_magnitude(&self.theta),
            last: (last(&self.theta), last(&self.rate)),
            impacts: self.impacts.len(),
        }
    }

    /// The motion of the centre of mass.
    pub fn motion(&self, body: &Body<f64>) -> Motion {
        Motion {
            u: self.theta.iter().map(|&theta| body.u(theta)).collect(),
            v: self.theta.iter().map(|&theta| body.v(theta)).collect(),
            theta: self.theta.clone(),
        }
    }
}
