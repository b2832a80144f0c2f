//! An interval with an event, piece by piece: uplift, impacts, rest, passing alpha, loss of
//! contact.
//!
//! An event's time is solved for in real numbers; its derivative comes from the equation it solves
//! (implicit function theorem).

use std::f64::consts::FRAC_PI_2;

use super::restraint::{RestrainedSeries, Restraint};
use super::root::{crossing, first_root, impact_time};
use super::series::{PowerSeries, StepGround, StepStart, value_and_slope};
use super::walk::{Sample, Setting, WalkState};
use super::{Impact, Rocking, RockingOutcome, Uplift, contact, rest};
use crate::scalar::{Scalar, real};

impl<S: Scalar> Setting<'_, S> {
    /// Interval i, piece by piece; false, with the outcome set, if the history ends in it.
    #[cold]
    #[inline(never)]
    pub(crate) fn interval<const V: bool, const N: usize>(
        &self,
        state: &mut WalkState<S>,
        i: usize,
        (now, then): (Sample<S>, Sample<S>),
        out: &mut Rocking<S>,
    ) -> bool {
        let start = i as f64 * self.dt;
        let (a0, da) = (now.a, then.a - now.a);
        let (g0, dg) = (now.gamma, then.gamma - now.gamma);
        // x: the fraction of the interval behind us
        let mut x = S::zero();
        let mut lifting = false;
        while x.re() < 1.0 {
            if !state.rocking {
                let held = (self.held(g0), dg);
                let side = match rest::outcome::<V, S>(x, (a0, da), held, self.lift) {
                    rest::RestOutcome::Lasts => return true,
                    rest::RestOutcome::LetsGo { at } => {
                        out.outcome = RockingOutcome::LeavesGround { time: start + at * self.dt };
                        return false;
                    }
                    rest::RestOutcome::Lifts { at, side } => {
                        x = at;
                        side
                    }
                };
                self.ground(state, side, S::zero());
                (state.rocking, lifting) = (true, true);
                out.uplifts.push(Uplift { time: x * self.dt + start, side });
                if x.re() >= 1.0 {
                    break;
                }
            }
            state.work += 1;
            if state.work > self.max_work {
                out.outcome = RockingOutcome::WorkBound { time: start };
                return false;
            }
            let left = S::one() - x;
            let h = left * self.dt;
            let (b, db) = ((a0 + da * x) * state.side, da * left * state.side);
            let ground = StepGround { b, db, gamma: g0 + dg * x, dgamma: dg * left };
            let (series, reach, press) = self.piece::<V, N>(&state.at, h, &ground);
            let mut c = series.re();
            if lifting {
                // at the limit w'' = 0, and its rounding error must not press the body into the
                // ground
                c[2] = c[2].max(0.0);
                lifting = false;
            }
            let impact = first_root(&c);
            if V && let Some(z) = self.loss(&state.at, (&c, press), &ground.re(), h.re(), reach)
                && impact.is_none_or(|impact| z < impact)
            {
                let time = start + (x.re() + left.re() * reach * z) * self.dt;
                self.leave(state, &c, z, time, h.re() * reach, out);
                return false;
            }
            match impact {
                Some(z) => {
                    let z = impact_time(&series, z);
                    let rate = series.at(z).1 / (h * reach);
                    x += left * z * reach;
                    if self.land(state, (x, rate), (now, then), start, out) {
                        return true;
                    }
                }
                None => {
                    let time = |z: f64| start + (x + left * reach * z).re() * self.dt;
                    if self.end_of_piece(state, &series, &c, h * reach, time) || reach >= 1.0 {
                        return true;
                    }
                    x += left * reach;
                }
            }
        }
        self.at_sample(state, x, then);
        true
    }

    /// The motion from `at` on over at most a time h (s), the share of h over which it holds, and
    /// what members press on the pivot in it.
    #[inline(always)]
    fn piece<const V: bool, const N: usize>(
        &self,
        at: &StepStart<S>,
        h: S,
        ground: &StepGround<S>,
    ) -> (PowerSeries<S, N>, f64, Option<[f64; N]>) {
        if let Some(restraint) = &self.restraint {
            return self.restrained_piece(restraint, at, h, ground);
        }
        let mut series = PowerSeries::new::<V>(at, h, ground, self.p2 * h * h);
        let reach = series.reach();
        if reach < 1.0 {
            series.shorten(reach);
        }
        (series, reach, None)
    }

    /// The same of a body with a tendon or dampers.
    #[inline(never)]
    fn restrained_piece<const N: usize>(
        &self,
        restraint: &Restraint<S>,
        at: &StepStart<S>,
        h: S,
        ground: &StepGround<S>,
    ) -> (PowerSeries<S, N>, f64, Option<[f64; N]>) {
        let part = restraint.part(h.re());
        let h = h * part;
        let ground = StepGround { db: ground.db * part, dgamma: ground.dgamma * part, ..*ground };
        let q = self.p2 * h * h;
        let RestrainedSeries { lean, mut press } = restraint.series(at, h, &ground, q);
        let mut series = PowerSeries::of(lean, &ground, q, restraint.growth(h.re()));
        let reach = series.reach();
        if reach < 1.0 {
            series.shorten(reach);
            for (k, press) in press.iter_mut().enumerate() {
                *press *= reach.powi(k as i32);
            }
        }
        (series, part * reach, Some(press))
    }

    /// Carry the state over a piece of length h without an event, `time` (s) the time at a fraction
    /// of it; true if the history ends there.
    fn end_of_piece<const N: usize>(
        &self,
        state: &mut WalkState<S>,
        series: &PowerSeries<S, N>,
        c: &[f64; N],
        h: S,
        time: impl Fn(f64) -> f64,
    ) -> bool {
        let before = state.at.w.re();
        let change = series.change();
        state.at.w += change;
        state.at.rate = series.end_slope() / h;
        self.turn(state, change);
        let alpha = self.alpha.re();
        if before < alpha && state.at.w.re() >= alpha {
            state.passed = time(crossing(c, alpha));
        }
        if state.at.w.re() >= FRAC_PI_2 || state.at.w.re().is_nan() {
            return true;
        }
        if state.at.w.re() == 0.0 && state.at.rate.re() == 0.0 {
            state.rocking = false;
        }
        false
    }

    /// After an event exactly at the sample: its time x may move with the parameters, the sample
    /// does not.
    fn at_sample(&self, state: &mut WalkState<S>, x: S, then: Sample<S>) {
        let late = S::one() - x;
        let late = (late - late.re()) * self.dt;
        let weight = self.p2 * (then.gamma * state.at.sin + then.a * state.at.cos * state.side);
        let force = match &self.restraint {
            Some(restraint) => weight + restraint.torque(&state.at),
            None => weight,
        };
        state.at.w += state.at.rate * late;
        state.at.rate -= force * late;
    }

    /// Where in a piece of the interval, a fraction of its `reach`, the pivot's force falls to
    /// zero.
    fn loss<const N: usize>(
        &self,
        at: &StepStart<S>,
        (c, press): (&[f64; N], Option<[f64; N]>),
        ground: &StepGround<f64>,
        h: f64,
        reach: f64,
    ) -> Option<f64> {
        let at = StepStart { w: at.w.re(), rate: at.rate.re(), sin: at.sin.re(), cos: at.cos.re() };
        // a force of zero has members in `contact::loss`
        if press.is_none() && contact::pressure(&at, ground, self.p2.re(), self.arm) <= 0.0 {
            return Some(0.0);
        }
        let ground = StepGround { db: ground.db * reach, dgamma: ground.dgamma * reach, ..*ground };
        contact::loss(c, &at, &ground, self.arm_of(h * reach), press.as_ref())
    }

    /// The pivot lets go at z of a piece of length h (s), at a time (s): the end, which a body that
    /// falls over has reached already.
    fn leave<const N: usize>(
        &self,
        state: &mut WalkState<S>,
        c: &[f64; N],
        z: f64,
        time: f64,
        h: f64,
        out: &mut Rocking<S>,
    ) {
        let (w, slope) = value_and_slope(c, z);
        let alpha = self.alpha.re();
        let [w, rate] = [w, slope / h].map(real::<S>);
        out.outcome = if self.falls(&StepStart { w, rate, ..state.at }) {
            if state.at.w.re() < alpha {
                let mut part = *c;
                (1..N).fold(1.0, |power, k| {
                    part[k] *= power * z;
                    power * z
                });
                state.passed = time - h * z * (1.0 - crossing(&part, alpha));
            }
            RockingOutcome::Overturned { time: state.passed }
        } else {
            RockingOutcome::LeavesGround { time }
        };
    }

    /// Put the body on the ground, leaning to a side at a rate.
    fn ground(&self, state: &mut WalkState<S>, side: f64, rate: S) {
        state.at = StepStart { w: S::zero(), rate, sin: self.sin_alpha, cos: self.cos_alpha };
        state.side = side;
        state.age = 0;
    }

    /// An impact at fraction x of the interval, w' before it given. True if the body rests until
    /// the interval's end.
    fn land(
        &self,
        state: &mut WalkState<S>,
        (x, rate): (S, S),
        (now, then): (Sample<S>, Sample<S>),
        start: f64,
        out: &mut Rocking<S>,
    ) -> bool {
        // theta' jumps to e theta' and keeps its sign: s, and with it w', turns round
        let before = rate * state.side;
        let after = before * self.e; // (2)
        out.impacts.push(Impact {
            time: x * self.dt + start,
            rate_before: before,
            rate_after: after,
        });
        self.ground(state, -state.side, -(rate * self.e));
        let hop = rest::Hop {
            rate: state.at.rate.re(),
            left: (1.0 - x.re()) * self.dt,
            now: (now.a + (then.a - now.a) * x).re(),
            then: then.a.re(),
            gamma: (
                self.held(now.gamma + (then.gamma - now.gamma) * x).re(),
                self.held(then.gamma).re(),
            ),
            e: self.e.re(),
            alpha: self.alpha.re(),
            ground: (self.sin_alpha.re(), self.cos_alpha.re()),
            p2: self.p2.re(),
        };
        match hop.fate() {
            rest::AfterImpact::Hops => false,
            rest::AfterImpact::Stops => {
                self.ground(state, state.side, S::zero());
                state.rocking = false;
                false
            }
            rest::AfterImpact::DiesOut => {
                self.ground(state, state.side, S::zero());
                state.rocking = false;
                true
            }
        }
    }
}
