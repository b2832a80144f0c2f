//! Elastic structures on rigid, rough ground with plastic landings: from event to event.
//!
//! ```text
//!   M(q) q'' = Q(q, q', t) + sum_i G_i' F_i       i: held corners, whose acceleration is zero
//!   lift      where the vertical force N_i of a held corner falls to zero; the last one of a footing only with hops
//!   landing   where a corner's height falls to zero: it is stopped, both ways. Of the corners that were held, as few as possible stay:
//!             q'_after = q' - M^-1 G' W^-1 G q',  W = G M^-1 G',  G: rows of the corners that stay and of the one that lands;
//!             one that stays is pushed, not pulled, and one that does not leaves the ground
//! ```
//!
//! The last corner of a footing may find that it cannot leave: without the ground's horizontal
//! force it would move down. It then slides and is kept at its height by that force alone, with N =
//! 0: what Coulomb's friction tends to as its coefficient grows. It leaves when the force has
//! fallen to zero, or stops when its velocity has.
//!
//! (theory: nonsmooth dynamics; the rigid body is the special case that is Housner's equation.) A
//! landing is a projection in the metric of M, so it never adds energy. Steps end at the record's
//! samples, between which the ground's acceleration is linear, and at events, which are located to
//! rounding. Held corners are put back to their places at every sample: the drift of an integrator
//! of order 8.
//!
//! | file | what |
//! |---|---|
//! | `corners` | sets of corners |
//! | `hold` | accelerations, impacts and displacements with a set of corners held |
//! | `contact` | which corners stay: after a landing, under forces |
//! | `state` | where it is, what a step leads to |
//! | `dop853`, `implicit` | one step; the same where the structure is stiff |
//! | `stiffness` | whether it is |
//! | `search` | events within a step |
//! | `walk`, `events` | from sample to sample, from event to event |
//! | `rest` | the structure at rest under its weight |
//! | `conditioning` | how long a history can be told |

mod conditioning;
mod contact;
mod corners;
mod dop853;
mod events;
mod hold;
mod implicit;
mod rest;
mod search;
mod state;
mod stiffness;
mod walk;

use nalgebra::DVector;

pub use conditioning::{FOLLOWED, FORETOLD, Growth, PERTURBATION, PerturbedPair, TRIED, growth};
pub use corners::CornerSet;
pub use hold::{Configuration, CornerContact, HeldMotion};
pub use rest::{RestError, at_rest};

use super::Mechanics;
use strong_motion::Record;

/// The ground's acceleration: at t = i dt, linear between samples, zero after the last (m/s2).
#[derive(Clone, Copy, Debug)]
pub struct GroundAcceleration<'a> {
    /// Time step (s).
    pub dt: f64,
    /// To the right.
    pub accel: &'a [f64],
    /// Upwards; none if empty.
    pub vertical: &'a [f64],
}

impl<'a> GroundAcceleration<'a> {
    /// Of a record.
    pub fn of(record: &'a Record) -> Self {
        Self { dt: record.dt, accel: &record.accel, vertical: record.up() }
    }

    /// Its first samples.
    #[must_use]
    pub fn first(self, samples: usize) -> Self {
        let part = |of: &'a [f64]| &of[..samples.min(of.len())];
        Self { accel: part(self.accel), vertical: part(self.vertical), ..self }
    }

    /// Horizontal motion alone.
    pub fn horizontal(dt: f64, accel: &'a [f64]) -> Self {
        Self { dt, accel, vertical: &[] }
    }

    /// Time of the last sample (s).
    pub(crate) fn duration(&self) -> f64 {
        self.accel.len().max(self.vertical.len()).saturating_sub(1) as f64 * self.dt
    }
}

/// Units of work that a history may take unless told otherwise.
pub const MOST_WORK: u64 = 20_000_000;

/// Units of work of a step tried of a structure of so many coordinates.
pub fn step_units(coordinates: usize) -> u64 {
    let n = coordinates as u64;
    12 + 5 * n * n / 16
}

/// How to solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceOptions {
    /// Whether the last corner of a footing lets go where its force falls to zero; else it is held,
    /// pushed or pulled.
    pub hop: bool,
    /// Error allowed in a step, relative to a coordinate (at least 0.01 m or rad) and a velocity
    /// (at least 0.1 m/s or rad/s).
    pub rtol: f64,
    /// Factor on the ground's acceleration.
    pub scale: f64,
    /// Share of every velocity that a landing leaves; 1 but to see how sensitive a history is.
    pub kept: f64,
    /// Length (s); the record's unless given.
    pub duration: Option<f64>,
    /// Rotation of a footing at which the structure has overturned (rad).
    pub overturned_at: f64,
    /// Bound on changes of contact.
    pub max_events: usize,
    /// Bound on work, in units: of a step by the number of coordinates ([`step_units`]).
    pub most_work: u64,
}

impl Default for ReferenceOptions {
    fn default() -> Self {
        Self {
            hop: true,
            rtol: 1e-9,
            scale: 1.0,
            kept: 1.0,
            duration: None,
            overturned_at: std::f64::consts::FRAC_PI_2,
            max_events: 100_000,
            most_work: MOST_WORK,
        }
    }
}

/// What happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// Corners left the ground.
    Lift,
    /// Corners landed.
    Land,
    /// Corners that no longer press began to slide.
    Slip,
    /// Sliding corners stopped.
    Stick,
}

/// A change of contact.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceEvent {
    /// (s)
    pub time: f64,
    /// What it was.
    pub what: What,
    /// Corners that it was about.
    pub corners: CornerSet,
    /// Corners held after it.
    pub held: CornerSet,
    /// Coordinates.
    pub q: DVector<f64>,
    /// Velocities before and after.
    pub velocity: [DVector<f64>; 2],
    /// Kinetic and potential energy before and after (J).
    pub energy: [f64; 2],
}

impl ReferenceEvent {
    /// Energy that it took (J); none but at a landing.
    pub fn loss(&self) -> f64 {
        self.energy[0] - self.energy[1]
    }
}

/// Why a history ended early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// More events than allowed.
    Events,
    /// More work than allowed.
    Work,
    /// Steps became too short: forces grow without bound, or numbers are not finite.
    Step,
    /// M(q) or W is singular: a coordinate without inertia, or a held corner that cannot move.
    Singular,
    /// The structure has more corners than sets are looked at.
    Corners,
}

/// How a history ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReferenceOutcome {
    /// At its duration.
    Completed,
    /// A footing overturned.
    Overturned {
        /// (s)
        time: f64,
    },
    /// It could not be followed.
    Stopped {
        /// (s)
        time: f64,
        /// Why.
        why: Stop,
    },
}

/// Where the energy went, at the end (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Kinetic and potential energy at the start.
    pub start: f64,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Taken by dampers; for checks, as what slid.
    pub damped: f64,
    /// Taken by landings.
    pub landings: f64,
    /// Taken by corners that slid.
    pub slid: f64,
    /// Put in by the ground's motion.
    pub input: f64,
    /// Largest amount, at any sample, by which the account did not close.
    pub open: f64,
    /// Largest kinetic energy and change of potential energy at any sample: what `open` is to be
    /// compared with.
    pub largest: f64,
}

/// A history.
#[derive(Clone, Debug)]
pub struct ElasticRocking {
    /// Time step (s).
    pub dt: f64,
    /// Coordinates at t = i dt; fewer than the duration's if the history ended early.
    pub q: Vec<DVector<f64>>,
    /// Velocities there.
    pub v: Vec<DVector<f64>>,
    /// (horizontal, vertical) force of the ground on every corner there (N).
    pub forces: Vec<Vec<[f64; 2]>>,
    /// Changes of contact.
    pub events: Vec<ReferenceEvent>,
    /// How it ended.
    pub outcome: ReferenceOutcome,
    /// Account of energy.
    pub ledger: Ledger,
    /// Largest force that pulled at a corner which could neither press nor leave nor slide (N).
    pub pulled: f64,
    /// Time of the first landing, of any energy to speak of, from which a corner slid on (s): it
    /// would have had to be pulled to stop. What follows depends on friction, which ground springs
    /// that hold a corner until it lifts do not have.
    pub first_sliding_landing_s: Option<f64>,
    /// Steps taken.
    pub steps: usize,
    /// Steps tried.
    pub tried: usize,
    /// Units of work that it might take.
    pub most_work: u64,
}

impl ElasticRocking {
    /// Whether a corner ever leaves the ground.
    pub fn lifts(&self) -> bool {
        self.events.iter().any(|event| event.what == What::Lift)
    }

    /// When a corner first lifts (s).
    pub fn first_lift(&self) -> Option<f64> {
        self.events.iter().find(|event| event.what == What::Lift).map(|event| event.time)
    }

    /// Landings.
    pub fn landings(&self) -> impl Iterator<Item = &ReferenceEvent> {
        self.events.iter().filter(|event| event.what == What::Land)
    }
}

/// Follow a structure from coordinates and velocities through the ground's motion. A corner is held
/// at first if it is on the ground and at rest.
pub fn rock(
    mechanics: &impl Mechanics,
    ground: GroundAcceleration,
    start: (&DVector<f64>, &DVector<f64>),
    options: &ReferenceOptions,
) -> ElasticRocking {
    walk::ReferenceWalk::new(mechanics, ground, start, options).run(|_| true)
}
