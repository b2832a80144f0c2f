//! The walk through a record: rest, uplift, Taylor steps, impacts, rest again.
//!
//! A plain interval between two samples is one Taylor step. An interval with an event (uplift, impact, rest, passing
//! alpha) or too fast for one step is walked piece by piece. Control flow is decided on real parts. An event's time is solved
//! for in real numbers; its derivative comes from the equation it solves (implicit function theorem).

use std::f64::consts::FRAC_PI_2;

use super::rest;
use super::root::{crossing, first_root, impact_time};
use super::series::{
    LEAST, LONG, SHORT, SMALL, Series, Start, change, coefficients, end_slope, is_plain, pulls, real_parts, turned,
};
use super::{Impact, Outcome, Rocking, Uplift};
use crate::scalar::{Scalar, real};

/// Sine and cosine are carried from step to step by a rotation, and taken anew after this many steps.
const REFRESH: u64 = 256;

/// p^2 dt^2 from which on steps take the short series, and the long one.
const SLOW: f64 = 3e-5;
const FAST: f64 = 1e-4;

/// The series that the steps of a walk begin with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pace {
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
pub struct Setting<'a, S> {
    pub dt: f64,
    /// Ground acceleration at the samples (m/s2).
    pub accel: &'a [f64],
    /// u_g/g per unit of `accel`.
    pub unit: S,
    pub alpha: S,
    pub sin_alpha: S,
    pub cos_alpha: S,
    /// tan alpha: the |u_g|/g at which the body lifts.
    pub lift: S,
    pub p2: S,
    /// Velocity restitution.
    pub e: S,
    pub max_work: usize,
}

/// Where the body is.
pub struct State<S> {
    pub at: Start<S>,
    /// s = sgn(theta).
    pub side: f64,
    pub rocking: bool,
    /// Steps since sine and cosine were computed.
    pub age: u64,
    /// It did not start at rest.
    started: bool,
    /// When |theta| last grew past alpha (s).
    passed: f64,
    /// Steps and impacts in intervals with events.
    work: usize,
}

/// A walk under way: where the body is, and the history until now.
pub struct Walk<'a, S> {
    pub set: Setting<'a, S>,
    pub state: State<S>,
    pub out: Rocking<S>,
    /// p^2 dt^2.
    pub q: S,
    pub pace: Pace,
    /// A sample beyond this must be looked at; between two samples below it a resting body stays down.
    pub quiet: f64,
}

/// Walk from the given lean and rate at t = 0 to the last sample.
pub fn walk<S: Scalar>(set: Setting<S>, theta: S, rate: S) -> Rocking<S> {
    let n = set.accel.len();
    let mut walk = Walk::new(set, theta, rate);
    let mut i = 0;
    let mut a0 = walk.ground(0);
    while walk.arrive(i) {
        if !walk.state.rocking {
            i = walk.lie(i);
            a0 = walk.ground(i);
        }
        if i + 1 >= n {
            break;
        }
        let a1 = walk.ground(i + 1);
        if !walk.advance(i, a0, a1, false) {
            break;
        }
        a0 = a1;
        i += 1;
    }
    walk.end()
}

impl<'a, S: Scalar> Walk<'a, S> {
    pub fn new(set: Setting<'a, S>, theta: S, rate: S) -> Self {
        let n = set.accel.len();
        let out = Rocking {
            theta: Vec::with_capacity(n),
            rate: Vec::with_capacity(n),
            impacts: Vec::with_capacity(32),
            uplifts: Vec::new(),
            outcome: Outcome::NeverMoved,
        };
        let q = set.p2 * (set.dt * set.dt);
        let quiet = (set.lift / set.unit).re().abs();
        let state = set.begin(theta, rate);
        Self { set, state, out, q, pace: Pace::of(q.re()), quiet }
    }

    /// u_g/g at sample i; zero beyond the record.
    pub fn ground(&self, i: usize) -> S {
        self.set.unit * self.set.accel.get(i).copied().unwrap_or(0.0)
    }

    /// Whether the body does not lie flat, and its motion is finite.
    #[inline(always)]
    pub fn is_up(&self) -> bool {
        self.state.at.w.re() < FRAC_PI_2 && self.state.at.rate.re().is_finite()
    }

    /// Add a sample to the history.
    #[inline(always)]
    pub fn note(&mut self, theta: S, rate: S) {
        self.out.theta.push(theta);
        self.out.rate.push(rate);
    }

    /// Note the lean at sample i; false if the history ends before it.
    #[inline(always)]
    pub fn arrive(&mut self, i: usize) -> bool {
        let at = self.state.at;
        if i >= self.set.accel.len() {
            return false;
        }
        if !self.is_up() {
            let time = i as f64 * self.set.dt;
            let flat = at.w.re() >= FRAC_PI_2;
            self.out.outcome =
                if flat { Outcome::Overturned { time: self.state.passed } } else { Outcome::NotFinite { time } };
            return false;
        }
        // not -0.0 at rest
        let side: S = real(if self.state.rocking { self.state.side } else { 0.0 });
        self.note(at.w * side, at.rate * side);
        true
    }

    /// Lie still at sample i for as long as the record is quiet; the last such sample.
    pub fn lie(&mut self, i: usize) -> usize {
        let accel = self.set.accel;
        if i + 1 == accel.len() || !(accel[i].abs() <= self.quiet || self.set.is_grazing(i)) {
            return i;
        }
        let still = accel[i + 1..].iter().take_while(|a| a.abs() <= self.quiet).count();
        self.out.theta.resize(i + still + 1, S::zero());
        self.out.rate.resize(i + still + 1, S::zero());
        i + still
    }

    /// Interval i; false, with the outcome set, if the work bound is reached. `tried`: a step at the walk's pace does not take it.
    #[inline(always)]
    pub fn advance(&mut self, i: usize, a0: S, a1: S, tried: bool) -> bool {
        let Self { set, state, out, q, pace, .. } = self;
        let (h, da) = (real(set.dt), a1 - a0);
        let steps = state.rocking && !tried;
        let done = match *pace {
            Pace::Slow => {
                (steps && set.step::<LEAST>(state, h, *q, a0, da))
                    || (state.rocking && set.step::<SHORT>(state, h, *q, a0, da))
                    || set.interval::<SHORT>(state, i, a0, a1, out)
            }
            Pace::Walk => {
                (steps && set.step::<SHORT>(state, h, *q, a0, da)) || set.interval::<SHORT>(state, i, a0, a1, out)
            }
            Pace::Fast => {
                (steps && set.step::<LONG>(state, h, *q, a0, da)) || set.interval::<LONG>(state, i, a0, a1, out)
            }
        };
        if !done {
            out.outcome = Outcome::WorkBound { time: i as f64 * set.dt };
        }
        done
    }

    /// The history, its outcome told from its end unless something cut it.
    pub fn end(mut self) -> Rocking<S> {
        let Self { set, state, out, .. } = &mut self;
        if out.outcome == Outcome::NeverMoved {
            if state.rocking && falls(&state.at, set.alpha.re(), set.p2.re()) {
                out.outcome = Outcome::Overturned { time: state.passed };
            } else if state.started || !out.uplifts.is_empty() {
                out.outcome = Outcome::Rocked;
            }
        }
        self.out
    }
}

/// Whether a rotation may carry sine and cosine over a step.
#[inline(always)]
pub fn turns_well(age: u64, change: f64) -> bool {
    age < REFRESH && change.abs() < SMALL
}

/// Whether a body beyond alpha goes on falling when the ground stops: w'^2/2 against p^2 (1 - cos(w - alpha)).
fn falls<S: Scalar>(at: &Start<S>, alpha: f64, p2: f64) -> bool {
    let (beyond, rate) = (at.w.re() - alpha, at.rate.re());
    beyond > 0.0 && (rate >= 0.0 || rate * rate < 4.0 * p2 * (0.5 * beyond).sin().powi(2))
}

impl<S: Scalar> Setting<'_, S> {
    fn begin(&self, theta: S, rate: S) -> State<S> {
        let negative = theta.re() < 0.0 || (theta.re() == 0.0 && rate.re() < 0.0);
        let side = if negative { -1.0 } else { 1.0 };
        let w = theta * side;
        let (sin, cos) = (self.alpha - w).sin_cos();
        State {
            at: Start { w, rate: rate * side, sin, cos },
            side,
            rocking: theta.re() != 0.0 || rate.re() != 0.0,
            age: 0,
            started: theta.re() != 0.0 || rate.re() != 0.0,
            passed: 0.0,
            work: 0,
        }
    }

    /// One Taylor step over a whole interval; false, with nothing changed, if the interval needs more than that.
    #[inline(always)]
    fn step<const N: usize>(&self, state: &mut State<S>, h: S, q: S, a0: S, da: S) -> bool {
        let at = &state.at;
        let (b0, db) = (a0 * state.side, da * state.side);
        let c = coefficients::<S, N>(at, h, b0, db, &pulls(q));
        let change = change(&c);
        let w = at.w + change;
        let (q, root) = (q.re(), q.re().sqrt());
        let plain = is_plain(&real_parts(&c), b0.re(), db.re(), q, root, w.re(), self.alpha.re());
        if plain {
            state.at.w = w;
            state.at.rate = end_slope(&c) * (1.0 / self.dt);
            self.turn(state, change);
        }
        plain
    }

    /// Sine and cosine of alpha - w after w has changed.
    #[inline(always)]
    fn turn(&self, state: &mut State<S>, change: S) {
        let at = &mut state.at;
        state.age += 1;
        if turns_well(state.age, change.re()) {
            (at.sin, at.cos) = turned(at.sin, at.cos, change);
        } else {
            (at.sin, at.cos) = (self.alpha - at.w).sin_cos();
            state.age = 0;
        }
    }

    /// Interval i, piece by piece; false if the work bound is reached.
    #[cold]
    #[inline(never)]
    fn interval<const N: usize>(&self, state: &mut State<S>, i: usize, a0: S, a1: S, out: &mut Rocking<S>) -> bool {
        let start = i as f64 * self.dt;
        let da = a1 - a0;
        // x: the fraction of the interval behind us
        let mut x = S::zero();
        let mut lifting = false;
        while x.re() < 1.0 {
            if !state.rocking {
                match rest::uplift(x, a0, da, self.lift) {
                    Some((at, side)) => {
                        x = at;
                        self.ground(state, side, S::zero());
                        state.rocking = true;
                        lifting = true;
                        out.uplifts.push(Uplift { time: x * self.dt + start, side });
                        if x.re() >= 1.0 {
                            break;
                        }
                    }
                    None => return true,
                }
            }
            state.work += 1;
            if state.work > self.max_work {
                return false;
            }
            let left = S::one() - x;
            let h = left * self.dt;
            let b = (a0 + da * x) * state.side;
            let mut series = Series::<S, N>::new(&state.at, h, b, da * left * state.side, self.p2 * h * h);
            let reach = series.reach();
            if reach < 1.0 {
                series.shorten(reach);
            }
            let mut c = series.re();
            if lifting {
                // at the limit w'' = 0, and its rounding error must not press the body into the ground
                c[2] = c[2].max(0.0);
                lifting = false;
            }
            match first_root(&c) {
                Some(z) => {
                    let z = impact_time(&series, z);
                    let rate = series.at(z).1 / (h * reach);
                    x += left * z * reach;
                    if self.land(state, x, rate, a0, a1, start, out) {
                        return true;
                    }
                }
                None => {
                    let before = state.at.w.re();
                    let change = series.change();
                    state.at.w += change;
                    state.at.rate = series.end_slope() / (h * reach);
                    self.turn(state, change);
                    let alpha = self.alpha.re();
                    if before < alpha && state.at.w.re() >= alpha {
                        let passed = (x + left * reach * crossing(&c, alpha)).re();
                        state.passed = start + passed * self.dt;
                    }
                    if state.at.w.re() >= FRAC_PI_2 || state.at.w.re().is_nan() {
                        return true;
                    }
                    if state.at.w.re() == 0.0 && state.at.rate.re() == 0.0 {
                        state.rocking = false;
                    }
                    if reach >= 1.0 {
                        return true;
                    }
                    x += left * reach;
                }
            }
        }
        // an event exactly at the sample: its time may move with the parameters, the sample does not
        let late = S::one() - x;
        let late = (late - late.re()) * self.dt;
        let force = self.p2 * (state.at.sin + a1 * state.at.cos * state.side);
        state.at.w += state.at.rate * late;
        state.at.rate -= force * late;
        true
    }

    /// Put the body on the ground, leaning to a side at a rate.
    fn ground(&self, state: &mut State<S>, side: f64, rate: S) {
        state.at = Start { w: S::zero(), rate, sin: self.sin_alpha, cos: self.cos_alpha };
        state.side = side;
        state.age = 0;
    }

    /// An impact at fraction x of the interval, w' before it given. True if the body rests until the interval's end.
    #[allow(clippy::too_many_arguments)]
    fn land(&self, state: &mut State<S>, x: S, rate: S, a0: S, a1: S, start: f64, out: &mut Rocking<S>) -> bool {
        // theta' jumps to e theta' and keeps its sign: s, and with it w', turns round
        let before = rate * state.side;
        let after = before * self.e; // (2)
        out.impacts.push(Impact { time: x * self.dt + start, rate_before: before, rate_after: after });
        self.ground(state, -state.side, -(rate * self.e));
        let hop = rest::Hop {
            rate: state.at.rate.re(),
            left: (1.0 - x.re()) * self.dt,
            now: (a0 + (a1 - a0) * x).re(),
            then: a1.re(),
            e: self.e.re(),
            alpha: self.alpha.re(),
            ground: (self.sin_alpha.re(), self.cos_alpha.re()),
            p2: self.p2.re(),
        };
        match hop.fate() {
            rest::Fate::Hops => false,
            rest::Fate::Stops => {
                self.ground(state, state.side, S::zero());
                state.rocking = false;
                false
            }
            rest::Fate::DiesOut => {
                self.ground(state, state.side, S::zero());
                state.rocking = false;
                true
            }
        }
    }

    /// Sample i is above the limit, but `rest::uplift` calls that a graze.
    fn is_grazing(&self, i: usize) -> bool {
        let a0 = self.unit * self.accel[i];
        rest::uplift(S::zero(), a0, self.unit * self.accel[i + 1] - a0, self.lift).is_none()
    }
}
