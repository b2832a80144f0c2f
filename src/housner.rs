//! Rigid rocking: Housner's equation through a record.
//!
//! ```text
//! (1),(3)  theta'' + p^2 [ sin(alpha s - theta) + (u_g/g) cos(alpha s - theta) ] = 0,   s = sgn(theta)
//! (2)      at theta = 0 (impact) theta' jumps to e theta',   e = 1 - (m R^2/I0)(1 - cos 2 alpha)
//! ```
//!
//! from Ma, Butterworth & Davidson, NZSEE Conference 2005, after Housner (1963).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | theta | rotation, positive leaning to the right | rad |
//! | alpha | atan(b/h), the lean of balance | rad |
//! | p^2 | m g R / I0 | 1/s2 |
//! | u_g | ground acceleration, linear between samples | m/s2 |
//! | e | velocity restitution; the paper's r = e^2 is an energy ratio | - |
//!
//! At rest the body stays down until |u_g| > g tan(alpha). Every step ends at a sample, since the record has a kink there:
//! the kinks, not a tolerance, decide the accuracy. One Taylor step spans an interval (`series`), impacts are roots of the step's polynomial
//! (`root`), and all of it is generic in the scalar, so derivatives pass through the events (`walk`).

mod lanes;
mod rest;
mod root;
mod series;
mod walk;

use crate::motion::Motion;
use crate::scalar::{GRAVITY, Scalar, real};
use crate::structure::Body;
use rayon::prelude::*;

/// How to solve.
#[derive(Clone, Debug)]
pub struct Options<S> {
    /// Factor on the record's acceleration.
    pub scale: S,
    /// Velocity restitution e, 0 to 1; by equation (2) unless given.
    pub restitution: Option<S>,
    /// Stop after this time (s); at the record's end unless given.
    pub duration: Option<f64>,
    /// theta (rad) and theta' (rad/s) at t = 0; at rest unless given.
    pub initial: Option<(S, S)>,
    /// Bound on steps and impacts in intervals with events, so that no input can hang.
    pub max_work: usize,
}

impl<S: Scalar> Default for Options<S> {
    fn default() -> Self {
        Self { scale: S::one(), restitution: None, duration: None, initial: None, max_work: 2_000_000 }
    }
}

/// theta = 0: the body lands on its other foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<S> {
    /// (s)
    pub time: S,
    /// theta' before the impact (rad/s).
    pub rate_before: S,
    /// theta' after it, e times that (rad/s).
    pub rate_after: S,
}

/// A resting body leaves the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uplift<S> {
    /// (s)
    pub time: S,
    /// +1 if it leans to the right, -1 if to the left.
    pub side: f64,
}

/// How a history ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// It rocked and did not overturn.
    Rocked,
    /// The ground never lifted it.
    NeverMoved,
    /// It lay flat (|theta| = pi/2) within the history, which is cut there; or the history ends with the body beyond
    /// alpha, and it would go on falling if the ground stopped.
    Overturned {
        /// When |theta| last grew past alpha (s).
        time: f64,
    },
    /// More steps and impacts than `Options::max_work`; the history is cut there.
    WorkBound {
        /// (s)
        time: f64,
    },
    /// The input or the motion is not finite; the history is cut there.
    NotFinite {
        /// (s)
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
    pub outcome: Outcome,
}

/// Rock a body on a record: ground accelerations (m/s2) at t = 0, dt, 2 dt ... (s), linear between them.
///
/// ```
/// use groundspring::{housner, structure::Structure};
/// let body = Structure::paper().body::<f64>();
/// // 0.5 s at 2 m/s2, just above g tan(alpha) = 0.981 m/s2
/// let accel: Vec<f64> = (0..1000).map(|i| if i < 50 { 2.0 } else { 0.0 }).collect();
/// let rocking = housner::solve(&body, 0.01, &accel, &housner::Options::default());
/// assert_eq!(rocking.uplifts[0].side, -1.0);
/// assert!(!rocking.impacts.is_empty());
/// ```
pub fn solve<S: Scalar>(body: &Body<S>, dt: f64, accel: &[f64], options: &Options<S>) -> Rocking<S> {
    let (theta, rate) = start(options);
    walk::walk(setting(body, dt, accel, options), theta, rate)
}

/// Rock many bodies on one record, or one body on many scales of it, sixteen at a time in lock-step, on every
/// thread; each result is, bit for bit, that of [`solve`]. The longer of the two lists decides how many there are; the shorter one is repeated from its start.
pub fn solve_lanes(bodies: &[Body<f64>], dt: f64, accel: &[f64], options: &[Options<f64>]) -> Vec<Rocking<f64>> {
    if bodies.is_empty() || options.is_empty() {
        return Vec::new();
    }
    let mut walks: Vec<_> = (0..bodies.len().max(options.len()))
        .map(|i| {
            let options = &options[i % options.len()];
            let (theta, rate) = start(options);
            (i, walk::Walk::new(setting(&bodies[i % bodies.len()], dt, accel, options), theta, rate))
        })
        .collect();
    // those that take the same steps side by side
    walks.sort_by_key(|(_, walk)| walk.pace);
    let mut chunks = Vec::with_capacity(walks.len().div_ceil(lanes::WIDTH));
    while !walks.is_empty() {
        chunks.push(walks.drain(..walks.len().min(lanes::WIDTH)).collect::<Vec<_>>());
    }
    let placed: Vec<Vec<_>> = chunks
        .into_par_iter()
        .with_max_len(1)
        .map(|chunk| {
            let (places, together): (Vec<_>, Vec<_>) = chunk.into_iter().unzip();
            places.into_iter().zip(lanes::walk(together)).collect()
        })
        .collect();
    let mut placed: Vec<_> = placed.into_iter().flatten().collect();
    placed.sort_by_key(|(i, _)| *i);
    placed.into_iter().map(|(_, rocking)| rocking).collect()
}

fn start<S: Scalar>(options: &Options<S>) -> (S, S) {
    options.initial.unwrap_or((real(0.0), real(0.0)))
}

fn setting<'a, S: Scalar>(body: &Body<S>, dt: f64, accel: &'a [f64], options: &Options<S>) -> walk::Setting<'a, S> {
    let radius = body.radius();
    walk::Setting {
        dt,
        accel: &accel[..samples(dt, accel.len(), options.duration)],
        unit: options.scale / GRAVITY,
        alpha: body.alpha(),
        sin_alpha: body.half_width / radius,
        cos_alpha: body.height / radius,
        lift: body.half_width / body.height,
        p2: body.p_squared(),
        e: options.restitution.unwrap_or_else(|| body.restitution()),
        max_work: options.max_work,
    }
}

/// Whether a body left alone on still ground with this theta (rad) and theta' (rad/s) falls: it is beyond alpha, and what
/// brings it back is too slow to reach alpha.
pub fn topples(body: &Body<f64>, theta: f64, rate: f64) -> bool {
    let options = Options { initial: Some((theta, rate)), ..Options::default() };
    solve(body, 1.0, &[0.0], &options).overturned().is_some()
}

/// Number of samples up to a duration, the one at its end included.
fn samples(dt: f64, len: usize, duration: Option<f64>) -> usize {
    match duration {
        // a duration that is a multiple of dt but for rounding counts as one
        Some(duration) => len.min(((duration / dt) * (1.0 + 1e-12)) as usize + 1),
        None => len,
    }
}

impl<S> Rocking<S> {
    /// When |theta| last grew past alpha, if the body overturned [s].
    pub fn overturned(&self) -> Option<f64> {
        match self.outcome {
            Outcome::Overturned { time } => Some(time),
            _ => None,
        }
    }
}

impl Rocking<f64> {
    /// The motion of the centre of mass.
    pub fn motion(&self, body: &Body<f64>) -> Motion {
        Motion {
            u: self.theta.iter().map(|&theta| body.u(theta)).collect(),
            v: self.theta.iter().map(|&theta| body.v(theta)).collect(),
            theta: self.theta.clone(),
        }
    }
}
