//! Steps over several samples, while the body leans on one foot.
//!
//! A body on one foot answers the ground's kinks by their double integral: it does not feel that
//! the ground acceleration is another one within the step, as long as its moments are the same. So
//! the step follows the parabola P of the same moments,
//!
//! ```text
//!   int (a - P) dt = int (a - P) t dt = int (a - P) t^2 dt = 0
//! ```
//!
//! and at a sample within the step the body is where the parabola takes it, turned about its foot
//! by what is missing,
//!
//! ```text
//!   (I + m R^2) d_theta = -m dX/dtheta D,    D = int int (a - P) dt dt
//! ```
//!
//! and its velocities by the same of D'.
//!
//! What is left of the kinks at the step's end is p^2 h^2 of the largest D, and what springs give
//! way under a - P; both are counted as local error. A step that meets a change of contact, or
//! whose body comes to lie, is refused: the steps up to it end at samples. Contact is looked for
//! along the parabola; a touch that only what is missing would make is not seen.

use super::{Contacts, Scales, StepEvent, StepMeasures, TimeLoop};
use crate::fem::{
    control::HistoryOutcome,
    model::{Contact, Model, Pose, State, TH, Vector, X, Z},
    observer::{Observer, View},
    radau::C,
    step::{Ground, NO_GUESS, Stages},
    turning::Turning,
};
use rocking::scalar::GRAVITY;
use std::{f64::consts::FRAC_PI_2, ops::ControlFlow};

/// Intervals between samples in a step, at most.
pub(super) const MOST: usize = 32;

/// Share of what such a step may miss from which on a turn counts in its iteration.
const TURN: f64 = 1e-2;

/// Growth from such a step to the next.
const GROWTH: f64 = 1.6;

// a multiplication where a division would be: they are done at every sample
const THIRD: f64 = 1.0 / 3.0;
const SIXTH: f64 = 1.0 / 6.0;

/// A step over several samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    /// Intervals between samples.
    intervals: usize,
    /// What the parabola adds to the step's local error.
    missed: f64,
}

/// Displacement of the mass per unit acceleration on the springs (s2).
pub(super) fn compliance(model: &Model) -> f64 {
    let chains = [&model.springs.vertical, &model.springs.horizontal];
    let give = chains.map(|chain| chain.k1.recip() + chain.k2.recip());
    model.body.mass * (give[0] + give[1])
}

impl TimeLoop<'_> {
    /// The step over several samples that begins at this sample, and its size, if there is one.
    pub(super) fn span(&mut self) -> Option<f64> {
        let dt = self.motion.dt;
        let model = self.model;
        let contacts = self.feet.map(|foot| foot.contact);
        let leans =
            matches!(contacts, [Contact::Stick, Contact::Open] | [Contact::Open, Contact::Stick]);
        let simple = model.is_plain() && self.motion.vertical.is_empty();
        if !(leans && simple && self.control.long_steps && self.h >= 2.0 * dt) {
            return None;
        }
        if self.interval > self.event_by.saturating_add(1) {
            self.event_by = usize::MAX;
        }
        let left = (self.motion.accel.len() - 1 - self.interval)
            .min(self.event_by.saturating_sub(self.interval));
        let intervals = ((self.h / dt) as usize).min(left).min(MOST);
        if intervals < 2 {
            return None;
        }
        let (ground, span) = self.parabola(intervals);
        (self.here, self.spanning, self.locating) = (ground, Some(span), None);
        Some(intervals as f64 * dt)
    }

    /// The parabola over so many intervals from here.
    fn parabola(&mut self, n: usize) -> (Ground, Span) {
        let (dt, count) = (self.motion.dt, n as f64);
        let (motion, from) = (self.motion, self.interval);
        let a = |i: usize| motion.scale * motion.accel[from + i];
        let (mut m0, mut m1, mut m2) = (0.0, 0.0, 0.0);
        for i in 0..n {
            let (now, next, at) = (a(i), a(i + 1), i as f64);
            let (zeroth, first) = ((now + next) * 0.5, now * SIXTH + next * THIRD);
            m0 += zeroth;
            m1 += zeroth * at + first;
            m2 += (zeroth * at + first * 2.0) * at + (now * THIRD + next) * 0.25;
        }
        // over a step of length 1
        let (m0, m1, m2) = (m0 / count, m1 / (count * count), m2 / (count * count * count));
        let c0 = m0 * 9.0 - m1 * 36.0 + m2 * 30.0;
        let c1 = m1 * 192.0 - m0 * 36.0 - m2 * 180.0;
        let c2 = m0 * 30.0 - m1 * 180.0 + m2 * 180.0;

        let (h, per) = (count * dt, count.recip());
        let (mut speed, mut place) = (0.0, 0.0);
        let (mut latest, mut most) = (0.0_f64, (a(0) - c0).abs());
        for i in 1..=n {
            let (before, now, x) = (a(i - 1), a(i), i as f64 * per);
            place += (speed + (before * THIRD + now * SIXTH) * dt) * dt;
            speed += (before + now) * (0.5 * dt);
            let parabola = (c0 * 0.5 + (c1 + c2 * (0.5 * x)) * (SIXTH * x)) * (h * x * h * x);
            most = most.max((now - (c0 + (c1 + c2 * x) * x)).abs());
            if i < n {
                self.late[i] = place - parabola;
                self.late_rate[i] = speed - (c0 + (c1 * 0.5 + c2 * (THIRD * x)) * x) * (h * x);
                latest = latest.max(self.late[i].abs());
            }
        }
        let kinks = (h / self.scales.moment).powi(2) * latest + self.compliance * most;
        let missed = kinks / (self.scales.radius * self.scales.alpha);
        let ground = Ground { start: [c0, 0.0], slope: [c1 / h, 0.0], curve: [c2 / (h * h), 0.0] };
        (ground, Span { intervals: n, missed })
    }

    /// The accelerations at the stages of a step of size h, of a rigid body that turns about its
    /// foot,
    ///
    /// ```text
    ///   (I + m R^2) theta'' = -m (a_g dX/dtheta + g dZ/dtheta)
    /// ```
    pub(super) fn pendulum(&self, h: f64) -> [Vector; 3] {
        let Self { model, scales, state, .. } = self;
        let foot = usize::from(self.feet[1].closed());
        let inertia = model.rotation + model.translation * (scales.radius * scales.radius);
        let share = model.body.mass / inertia;
        let Pose { sin: sin_0, cos: cos_0 } = Pose::of(&state.q);
        C.map(|c| {
            let (time, last) = (h * c, self.guess[TH]);
            let rate = state.v[TH] + last * time;
            let turn = (state.v[TH] + last * time * 0.5) * time;
            // near enough for a guess
            let level = -turn * turn * 0.5 + 1.0;
            let (sin, cos) = (sin_0 * level + cos_0 * turn, cos_0 * level - sin_0 * turn);
            let (_, _, px_th, pz_th) = model.foot(foot, &state.q, sin, cos);
            let [ground, _] = self.here.after(h, c);
            let turning = share * (ground * px_th + pz_th * GRAVITY);
            let mut a = NO_GUESS;
            a[TH] = turning;
            a[X] = -(px_th * turning + pz_th * rate * rate);
            a[Z] = px_th * rate * rate - pz_th * turning;
            a
        })
    }

    /// How it turns about its foot in a step of size h (s), where a displacement of the foot counts
    /// from `tolerance` (m) on. A turn counts from a share of the error that the step may have,
    /// which its rate reaches first.
    pub(super) fn turning(&self, h: f64, tolerance: f64) -> Turning {
        let Scales { radius, alpha, moment, .. } = self.scales;
        let turn = TURN * self.error * radius * alpha * (h / moment).min(1.0);
        Turning { foot: usize::from(self.feet[1].closed()), weight: (tolerance / turn).min(1.0) }
    }

    /// Take note of such a step.
    pub(super) fn tried_span(
        &mut self,
        span: &Span,
        converged: bool,
        stages: &Stages,
        measures: Option<&StepMeasures>,
        observer: &mut dyn Observer,
    ) -> Result<(), HistoryOutcome> {
        let h = stages.h;
        if !converged {
            self.refuse(h * 0.25);
            return Ok(());
        }
        let met = self.met(stages, measures.map_or(&Contacts::Unknown, |m| &m.contacts));
        // a body that lies is followed to the sample at which it does
        let flat = stages.end().q[TH].abs() > FRAC_PI_2;
        let until = match met {
            StepEvent::Nothing => flat.then_some(0.5),
            StepEvent::Crossing { tau, .. } | StepEvent::Grip { tau, .. } => Some(tau),
            StepEvent::Unresolved => Some(0.25),
        };
        if let Some(tau) = until {
            self.event_by = self.interval + (tau * span.intervals as f64) as usize;
            self.work.rejected += 1;
            return Ok(());
        }
        let mut measured = measures.copied().unwrap_or_else(|| self.measure(stages));
        measured.missed += span.missed;
        let start = self.state;
        if !self.account(stages, &measured) {
            self.work.rejected += 1;
            return Ok(());
        }
        self.h = self.h.min(GROWTH * h);
        for i in 1..span.intervals {
            let time = (self.interval + i) as f64 * self.motion.dt;
            // forces are those at the end
            observer.step(&self.view(time));
            let late = [self.late[i], self.late_rate[i]];
            let state = self.within(&start, stages, i as f64 / span.intervals as f64, late);
            let view = View {
                time,
                model: self.model,
                state: &state,
                feet: &self.feet,
                energy: &self.energy,
            };
            if let ControlFlow::Break(()) = observer.sample(self.interval + i, &view) {
                return Err(HistoryOutcome::Stopped { time });
            }
        }
        self.interval += span.intervals - 1;
        (self.t, self.crossing) = (self.motion.dt, true);
        let time = (self.interval + 1) as f64 * self.motion.dt;
        observer.step(&self.view(time));
        Ok(())
    }

    /// The state at a sample within the step, at tau of it.
    fn within(&self, start: &State, stages: &Stages, tau: f64, late: [f64; 2]) -> State {
        let (mut q, mut v) = (stages.position(start, tau), stages.velocity(start, tau));
        let foot = usize::from(self.feet[1].closed());
        let (sin, cos) = rocking::scalar::sin_cos(q[TH]);
        let (_, _, px_th, pz_th) = self.model.foot(foot, &q, sin, cos);
        let Self { model, scales, .. } = self;
        let inertia = model.rotation + model.translation * (scales.radius * scales.radius);
        let turn = model.body.mass * px_th * late[0] / inertia;
        // the lever turns with the body: its rate is (pz_th, -px_th) theta'
        let (px_rate, pz_rate) = (pz_th * v[TH], -px_th * v[TH]);
        let turning = model.body.mass * (px_th * late[1] + px_rate * late[0]) / inertia;
        q[TH] += turn;
        q[X] -= px_th * turn;
        q[Z] -= pz_th * turn;
        v[TH] += turning;
        v[X] -= px_th * turning + px_rate * turn;
        v[Z] -= pz_th * turning + pz_rate * turn;
        State { q, v }
    }
}
