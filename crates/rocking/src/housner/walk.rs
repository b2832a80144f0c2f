//! The walk through a record: rest, uplift, Taylor steps, impacts, rest again.
//!
//! A plain interval between two samples is one Taylor step. An interval with an event (uplift,
//! impact, rest, passing alpha, loss of contact) or too fast for one step is walked piece by piece
//! (`interval`). Control flow is decided on real parts.
//!
//! `V`: whether the ground moves vertically, too. Without it nothing is computed of what that asks
//! for.

use std::{f64::consts::FRAC_PI_2, mem};

use super::series::{
    LEAST, LONG, SHORT, SMALL, StepGround, StepStart, change, coefficients, end_slope, is_plain,
    pulls, real_parts, turned,
};
use super::{Rocking, RockingOutcome, contact, rest, restraint::Restraint, samples::WalkSamples};
use crate::scalar::{Scalar, real};

/// Sine and cosine are carried from step to step by a rotation, and taken anew after this many
/// steps.
const REFRESH: u64 = 256;

/// p^2 dt^2 from which on steps take the short series, and the long one.
const SLOW: f64 = 3e-5;
const FAST: f64 = 1e-4;

/// The series that the steps of a walk begin with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Pace {
    /// [`LEAST`] coefficients, [`SHORT`] where these do not suffice.
    Slow,
    /// [`SHORT`] coefficients.
    Walk,
    /// [`LONG`] coefficients.
    Fast,
}

impl Pace {
    fn of(q: f64) -> Self {
        match q {
            q if q <= SLOW => Self::Slow,
            q if q <= FAST => Self::Walk,
            // also what is not a number
            _ => Self::Fast,
        }
    }
}

/// The body and the record as the walk needs them.
pub(crate) struct Setting<'a, S> {
    pub dt: f64,
    /// Ground acceleration at the samples (m/s2).
    pub accel: &'a [f64],
    /// Its vertical part, positive upwards (m/s2); zero where it has no sample.
    pub vertical: &'a [f64],
    /// a_g/g per unit of `accel`, a_v/g per unit of `vertical`.
    pub unit: S,
    pub alpha: S,
    pub sin_alpha: S,
    pub cos_alpha: S,
    /// tan alpha: the |a_g|/g at which the body lifts.
    pub lift: S,
    pub p2: S,
    /// R/g (s2).
    pub arm: f64,
    /// Velocity restitution.
    pub e: S,
    /// A tendon and dampers.
    pub restraint: Option<Restraint<S>>,
    pub max_work: usize,
}

/// Where the body is.
pub(crate) struct WalkState<S> {
    pub at: StepStart<S>,
    /// s = sgn(theta).
    pub side: f64,
    pub rocking: bool,
    /// Steps since sine and cosine were computed.
    pub age: u64,
    /// It did not start at rest.
    started: bool,
    /// When |theta| last grew past alpha (s).
    pub passed: f64,
    /// Steps and impacts in intervals with events.
    pub work: usize,
}

/// The ground at an instant.
#[derive(Clone, Copy)]
pub(crate) struct Sample<S> {
    /// a_g/g.
    pub a: S,
    /// gamma = 1 + a_v/g.
    pub gamma: S,
}

/// A walk under way: where the body is, and the history until now.
pub(crate) struct Walk<'a, S, const V: bool> {
    pub set: Setting<'a, S>,
    pub state: WalkState<S>,
    /// Events and outcome; its samples stand in `samples` until the end.
    pub out: Rocking<S>,
    pub samples: WalkSamples<S>,
    /// p^2 dt^2.
    pub q: S,
    pub pace: Pace,
    /// A sample beyond this must be looked at; between two samples below it a resting body stays
    /// down.
    pub quiet: f64,
}

/// Walk from the given lean and rate at t = 0 to the last sample.
pub(crate) fn walk<S: Scalar, const V: bool>(set: Setting<S>, start: (S, S)) -> Rocking<S> {
    let samples = WalkSamples::kept(set.accel.len());
    let mut walk = Walk::<S, V>::new(set, start, samples);
    walk.go_to_end();
    walk.end()
}

impl<'a, S: Scalar, const V: bool> Walk<'a, S, V> {
    /// From the given lean and rate at t = 0.
    pub(crate) fn new(set: Setting<'a, S>, (theta, rate): (S, S), samples: WalkSamples<S>) -> Self {
        let out = Rocking {
            theta: Vec::new(),
            rate: Vec::new(),
            impacts: Vec::with_capacity(32),
            uplifts: Vec::new(),
            outcome: RockingOutcome::NeverMoved,
        };
        let q = set.p2 * (set.dt * set.dt);
        let quiet = (set.lift / set.unit).re().abs();
        let state = set.begin(theta, rate);
        let pace = match &set.restraint {
            None => Pace::of(q.re()),
            // those whose steps an interval takes
            Some(restraint) => Pace::of(q.re() + restraint.growth(set.dt)).max(Pace::Walk),
        };
        Self { set, state, out, samples, q, pace, quiet }
    }

    /// Walk to the last sample.
    #[inline(always)]
    pub(crate) fn go_to_end(&mut self) {
        let n = self.set.accel.len();
        // a step of the bare body's series does not take it
        let restrained = self.set.restraint.is_some();
        let mut i = 0;
        let mut a0 = self.ground(0);
        while self.arrive(i) {
            if !self.state.rocking {
                i = self.lie(i);
                a0 = self.ground(i);
            }
            if i + 1 >= n {
                break;
            }
            let a1 = self.ground(i + 1);
            if !self.advance(i, a0, a1, restrained) {
                break;
            }
            a0 = a1;
            i += 1;
        }
    }

    /// The ground at sample i; at rest beyond the record.
    pub(crate) fn ground(&self, i: usize) -> Sample<S> {
        let at = |record: &[f64]| record.get(i).copied().unwrap_or(0.0);
        self.set.sample::<V>(at(self.set.accel), at(self.set.vertical))
    }

    /// Whether the body does not lie flat, and its motion is finite.
    #[inline(always)]
    fn is_up(&self) -> bool {
        self.state.at.w.re() < FRAC_PI_2 && self.state.at.rate.re().is_finite()
    }

    /// Whether it rocks, and its history goes on.
    #[inline(always)]
    pub(crate) fn rocks(&self) -> bool {
        self.state.rocking && self.is_up()
    }

    /// Note the lean at sample i; false if the history ends before it.
    #[inline(always)]
    pub(crate) fn arrive(&mut self, i: usize) -> bool {
        let at = self.state.at;
        if i >= self.set.accel.len() {
            return false;
        }
        if !self.is_up() {
            let time = i as f64 * self.set.dt;
            let flat = at.w.re() >= FRAC_PI_2;
            self.out.outcome = if flat {
                RockingOutcome::Overturned { time: self.state.passed }
            } else {
                RockingOutcome::NotFinite { time }
            };
            return false;
        }
        // not -0.0 at rest
        let side: S = real(if self.state.rocking { self.state.side } else { 0.0 });
        self.samples.push(at.w * side, at.rate * side);
        true
    }

    /// Lie still at sample i for as long as the record is quiet; the last such sample.
    pub(crate) fn lie(&mut self, i: usize) -> usize {
        let accel = self.set.accel;
        if i + 1 == accel.len()
            || !(self.is_quiet(i) || self.set.is_grazing(self.ground(i), self.ground(i + 1)))
        {
            return i;
        }
        let still = (i + 1..accel.len()).take_while(|&i| self.is_quiet(i)).count();
        self.samples.rest(still);
        i + still
    }

    /// Whether sample i does not lift a body at rest.
    fn is_quiet(&self, i: usize) -> bool {
        let a = self.set.accel[i].abs();
        if V {
            let gamma = self.ground(i).gamma.re();
            gamma > 0.0 && a <= self.quiet * gamma
        } else {
            a <= self.quiet
        }
    }

    /// Interval i; false, with the outcome set, if the history ends in it. `tried`: a step at the
    /// walk's pace does not take it.
    #[inline(always)]
    pub(crate) fn advance(
        &mut self,
        i: usize,
        now: Sample<S>,
        then: Sample<S>,
        tried: bool,
    ) -> bool {
        let Self { set, state, out, q, pace, .. } = self;
        let ends = (now, then);
        let steps = state.rocking && !tried;
        match *pace {
            Pace::Slow => {
                (steps && set.step::<V, LEAST>(state, *q, ends))
                    || (state.rocking && set.step::<V, SHORT>(state, *q, ends))
                    || set.interval::<V, SHORT>(state, i, ends, out)
            }
            Pace::Walk => {
                (steps && set.step::<V, SHORT>(state, *q, ends))
                    || set.interval::<V, SHORT>(state, i, ends, out)
            }
            Pace::Fast => {
                (steps && set.step::<V, LONG>(state, *q, ends))
                    || set.interval::<V, LONG>(state, i, ends, out)
            }
        }
    }

    /// The history, its outcome told from its end unless something cut it.
    pub(crate) fn end(mut self) -> Rocking<S> {
        let Self { set, state, out, samples, .. } = &mut self;
        (out.theta, out.rate) = (mem::take(&mut samples.theta), mem::take(&mut samples.rate));
        if out.outcome == RockingOutcome::NeverMoved {
            if state.rocking && set.falls(&state.at) {
                out.outcome = RockingOutcome::Overturned { time: state.passed };
            } else if state.started || !out.uplifts.is_empty() {
                out.outcome = RockingOutcome::Rocked;
            }
        }
        self.out
    }
}

/// Whether a rotation may carry sine and cosine over a step.
#[inline(always)]
pub(crate) fn turns_well(age: u64, change: f64) -> bool {
    age < REFRESH && change.abs() < SMALL
}

impl<S: Scalar> Setting<'_, S> {
    fn begin(&self, theta: S, rate: S) -> WalkState<S> {
        let negative = theta.re() < 0.0 || (theta.re() == 0.0 && rate.re() < 0.0);
        let side = if negative { -1.0 } else { 1.0 };
        let w = theta * side;
        let (sin, cos) = (self.alpha - w).sin_cos();
        WalkState {
            at: StepStart { w, rate: rate * side, sin, cos },
            side,
            rocking: theta.re() != 0.0 || rate.re() != 0.0,
            age: 0,
            started: theta.re() != 0.0 || rate.re() != 0.0,
            passed: 0.0,
            work: 0,
        }
    }

    /// The ground at an instant from the record's numbers (m/s2).
    #[inline(always)]
    pub(crate) fn sample<const V: bool>(&self, accel: f64, vertical: f64) -> Sample<S> {
        Sample {
            a: self.unit * accel,
            gamma: if V { self.unit * vertical + 1.0 } else { S::one() },
        }
    }

    /// One Taylor step over a whole interval; false, with nothing changed, if the interval needs
    /// more than that.
    #[inline(always)]
    fn step<const V: bool, const N: usize>(
        &self,
        state: &mut WalkState<S>,
        q: S,
        (now, then): (Sample<S>, Sample<S>),
    ) -> bool {
        let at = &state.at;
        let (side, da) = (state.side, then.a - now.a);
        let ground = StepGround {
            b: now.a * side,
            db: da * side,
            gamma: now.gamma,
            dgamma: then.gamma - now.gamma,
        };
        let c = coefficients::<S, V, N>(at, real(self.dt), &ground, &pulls(q));
        let change = change(&c);
        let w = at.w + change;
        let (re, ground) = (real_parts(&c), ground.re());
        let plain =
            is_plain::<V, N>(&re, &ground, (q.re(), q.re().sqrt()), w.re(), self.alpha.re())
                && (!V
                    || contact::surely_presses(
                        &re,
                        at.sin.re(),
                        &ground,
                        self.share(),
                        self.arm_of(self.dt),
                    ));
        if plain {
            state.at.w = w;
            state.at.rate = end_slope(&c) * (1.0 / self.dt);
            self.turn(state, change);
        }
        plain
    }

    /// Whether a body beyond alpha goes on falling when the ground stops: w'^2/2 against p^2 (1 -
    /// cos(w - alpha)).
    pub(crate) fn falls(&self, at: &StepStart<S>) -> bool {
        let (alpha, p2) = (self.alpha.re(), self.p2.re());
        if let Some(restraint) = &self.restraint {
            return restraint.falls(at, alpha, p2);
        }
        let (beyond, rate) = (at.w.re() - alpha, at.rate.re());
        beyond > 0.0 && (rate >= 0.0 || rate * rate < 4.0 * p2 * (0.5 * beyond).sin().powi(2))
    }

    /// m R^2/I0 = p^2 R/g.
    #[inline(always)]
    pub(crate) fn share(&self) -> f64 {
        self.p2.re() * self.arm
    }

    /// R/(g h^2), for a step of h (s).
    #[inline(always)]
    pub(crate) fn arm_of(&self, h: f64) -> f64 {
        self.arm / (h * h)
    }

    /// Sine and cosine of alpha - w after w has changed.
    #[inline(always)]
    pub(crate) fn turn(&self, state: &mut WalkState<S>, change: S) {
        let at = &mut state.at;
        state.age += 1;
        if turns_well(state.age, change.re()) {
            (at.sin, at.cos) = turned(at.sin, at.cos, change);
        } else {
            (at.sin, at.cos) = (self.alpha - at.w).sin_cos();
            state.age = 0;
        }
    }

    /// gamma of a body at rest: with what a tendon adds to its weight.
    pub(crate) fn held(&self, gamma: S) -> S {
        self.restraint.as_ref().map_or(gamma, |restraint| gamma + restraint.hold)
    }

    /// The sample now is above the limit, but `rest::uplift` calls that a graze.
    fn is_grazing(&self, now: Sample<S>, then: Sample<S>) -> bool {
        let rest = |now: S, then: S| (now, then - now);
        let held = rest(self.held(now.gamma), self.held(then.gamma));
        rest::uplift(S::zero(), rest(now.a, then.a), held, self.lift).is_none()
            && self.held(now.gamma).re() > 0.0
    }
}
