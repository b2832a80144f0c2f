//! The time loop: steps that end at every sample, contact events located in time, the energy account.

use std::ops::ControlFlow;

use super::{
    model::{Contact, Foot, Model, State, TH, Vector, X, Z},
    radau::C,
    step::{Ground, Request, Stages, no_guess, step},
};
use crate::scalar::{GRAVITY, Scalar, real};

/// How accurately and how long to work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// Energy that one step may lose or gain, relative to the largest energy so far.
    pub tolerance: f64,
    /// Steps per history before it is given up.
    pub most_steps: usize,
    /// Iterations added after convergence (2 for dual numbers).
    pub extra_iterations: usize,
}

impl Control {
    /// For comparing many candidates: errors of the history below 1e-4, at half the steps.
    pub fn search() -> Self {
        Self { tolerance: 1e-7, most_steps: 200_000, ..Self::default() }
    }
}

impl Default for Control {
    fn default() -> Self {
        Self { tolerance: 1e-9, most_steps: 2_000_000, extra_iterations: 0 }
    }
}

/// How a history ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The record was followed to its end.
    Completed,
    /// The body lay flat (|theta| > pi/2) at this time [s].
    Overturned { time: f64 },
    /// The observer asked to stop at this time [s].
    Stopped { time: f64 },
    /// The bound on steps was reached at this time [s].
    WorkBound { time: f64 },
}

/// Energy account since the start [J].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy<S> {
    /// Stored at the start.
    pub initial: S,
    /// Kinetic, gravitational and elastic energy now.
    pub stored: S,
    /// Work of the base excitation.
    pub input: S,
    /// Taken by the dashpots.
    pub dissipated: S,
    /// Elastic energy of horizontal springs let go when their foot left the ground.
    pub released: S,
}

impl<S: Scalar> Energy<S> {
    /// What the account leaves unexplained: stored - initial - input + dissipated + released [J].
    pub fn residual(&self) -> S {
        self.stored - self.initial - self.input + self.dissipated + self.released
    }
}

/// A foot that closes again this soon after it opened, in units of 1/Omega_n, has hardly left the ground.
const AT_ONCE: f64 = 0.1;

/// Least step that is tried unless the account has just refused a larger one, in units of 1/Omega_n: a step cut short by
/// an event says nothing of the next.
const RESTART: f64 = 0.1;

/// Share of the weight that a foot which hardly left the ground must carry before its horizontal spring holds.
///
/// A massless rotation jumps when a lifting foot lets its horizontal spring go, and the jump may press that foot down
/// again: it would open and close at an accumulating sequence of instants. What it does in the limit is slide under no
/// weight, and that is what it is let do.
const HOLDING: f64 = 1e-3;

/// A foot's change of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    TouchDown,
    LiftOff,
}

/// What a run shows while it goes.
pub struct View<'a, S> {
    /// Time [s].
    pub time: S,
    pub(crate) model: &'a Model<S>,
    pub(crate) state: &'a State<S>,
    pub(crate) feet: &'a [Foot<S>; 2],
    pub energy: &'a Energy<S>,
}

impl<S: Scalar> View<'_, S> {
    /// Horizontal displacement of the centre of mass [m].
    pub fn x(&self) -> S {
        self.state.q[X]
    }

    /// Vertical displacement of the centre of mass from the unstressed position [m].
    pub fn z(&self) -> S {
        self.state.q[Z]
    }

    /// Rotation [rad].
    pub fn theta(&self) -> S {
        self.state.q[TH]
    }

    /// Rotation rate [rad/s].
    pub fn theta_rate(&self) -> S {
        self.state.v[TH]
    }

    /// Whether foot i (0 left, 1 right) presses on the ground.
    pub fn presses(&self, i: usize) -> bool {
        self.feet[i].closed()
    }

    /// Kinetic energy of the body [J].
    pub fn body_kinetic(&self) -> S {
        self.model.body_kinetic(self.state)
    }
}

/// Receives a run's samples and events; may stop it.
pub trait Observer<S: Scalar> {
    /// Called at every sample, the first at t = 0.
    fn sample(&mut self, index: usize, view: &View<S>) -> ControlFlow<()>;
    /// Called right after foot `foot` (0 left, 1 right) changed its contact.
    fn event(&mut self, _foot: usize, _change: Change, _view: &View<S>) {}
}

/// Work done by a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    pub steps: usize,
    pub rejected: usize,
    pub located: usize,
    pub events: usize,
    pub iterations: usize,
}

/// A history in the making.
pub(crate) struct Run<'a, S> {
    model: &'a Model<S>,
    control: Control,
    state: State<S>,
    feet: [Foot<S>; 2],
    energy: Energy<S>,
    /// Largest energy seen [J], the scale of the account.
    scale: f64,
    /// Static compression of k1 under the weight [m], the scale of contact.
    compression: f64,
    /// sqrt(compression/g) = 1/Omega_n of the vertical chain [s], the scale of time in contact.
    settling: f64,
    guess: [Vector<S>; 3],
    /// When each foot last opened [s].
    opened: [f64; 2],
    /// Step size that the energy account asked for [s].
    h: f64,
    pub work: Work,
}

/// What a candidate step met.
enum Met {
    Nothing,
    /// The compression of this foot's gap passes `level` [m].
    Crossing {
        foot: usize,
        level: f64,
        tau: f64,
    },
}

impl<'a, S: Scalar> Run<'a, S> {
    pub fn new(model: &'a Model<S>, start: (State<S>, [Foot<S>; 2]), control: Control) -> Self {
        let (state, feet) = start;
        let stored = model.energy(&state, &feet);
        let weight = model.body.mass.re() * GRAVITY;
        let compression = weight / model.springs.vertical.k1.re();
        // of the standing body: elastic energy at rest, the least energy that means anything
        let settled = model.settled();
        let rest = model.energy(&settled.0, &settled.1).re();
        let scale = (stored.re() - rest).abs().max(1e-3 * weight * compression);
        let energy = Energy { initial: stored, stored, ..Energy::default_zero() };
        Self {
            model,
            control,
            state,
            feet,
            energy,
            scale,
            compression,
            settling: (compression / GRAVITY).sqrt(),
            guess: no_guess(),
            opened: [f64::NEG_INFINITY; 2],
            h: f64::INFINITY,
            work: Work::default(),
        }
    }

    fn view(&self, time: S) -> View<'_, S> {
        View { time, model: self.model, state: &self.state, feet: &self.feet, energy: &self.energy }
    }

    /// Follow the record (m/s2 at steps of dt, times `scale`).
    pub fn follow(&mut self, dt: f64, accel: &[f64], scale: S, observer: &mut impl Observer<S>) -> Outcome {
        let n = accel.len();
        if n == 0 {
            return Outcome::Completed;
        }
        if observer.sample(0, &self.view(S::zero())).is_break() {
            return Outcome::Stopped { time: 0.0 };
        }
        for i in 0..n - 1 {
            let t0 = i as f64 * dt;
            let ground = Ground { start: scale * accel[i], slope: scale * ((accel[i + 1] - accel[i]) / dt) };
            if let Err(time) = self.cross_sample(t0, dt, &ground, observer) {
                return Outcome::WorkBound { time };
            }
            if self.state.q[TH].re().abs() > std::f64::consts::FRAC_PI_2 {
                return Outcome::Overturned { time: t0 + dt };
            }
            if observer.sample(i + 1, &self.view(real(t0 + dt))).is_break() {
                return Outcome::Stopped { time: t0 + dt };
            }
        }
        Outcome::Completed
    }

    /// From one sample to the next; the time when the work bound is met.
    fn cross_sample(
        &mut self,
        t0: f64,
        dt: f64,
        ground: &Ground<S>,
        observer: &mut impl Observer<S>,
    ) -> Result<(), f64> {
        let mut t = S::zero();
        loop {
            let left = -t + dt;
            if left.re() <= 1e-13 * dt {
                return Ok(());
            }
            if self.work.steps + self.work.rejected >= self.control.most_steps {
                return Err(t0 + t.re());
            }
            let h = self.next_size(left);
            let here = Ground { start: ground.start + ground.slope * t, slope: ground.slope };
            let Some(stages) = self.attempt(h, &here) else {
                self.work.rejected += 1;
                self.h = h.re() * 0.25;
                if self.h < 1e-14 * dt {
                    return Err(t0 + t.re());
                }
                continue;
            };
            let (stages, crossed) = match self.met(&stages) {
                Met::Nothing => (stages, None),
                Met::Crossing { foot, level, tau } => {
                    (self.locate(foot, level, stages, tau, &here), Some((foot, level)))
                }
            };
            let accepted = self.account(&stages, &here);
            if !accepted {
                self.work.rejected += 1;
                if self.h < 1e-14 * dt {
                    return Err(t0 + t.re());
                }
                continue;
            }
            t += stages.h;
            if let Some((foot, level)) = crossed {
                self.switch(foot, level, real::<S>(t0) + t, observer);
            }
        }
    }

    /// The next step: what the account allows, never past the sample, and no sliver left over.
    fn next_size(&self, left: S) -> S {
        let l = left.re();
        if self.h >= 0.999 * l {
            left
        } else if self.h > 0.5 * l {
            left * 0.5
        } else {
            real(self.h)
        }
    }

    fn attempt(&mut self, h: S, ground: &Ground<S>) -> Option<Stages<S>> {
        let request = Request {
            h,
            ground: *ground,
            guess: &self.guess,
            tolerance: 1e-7 * self.compression,
            extra: self.control.extra_iterations,
        };
        let stages = step(self.model, &self.state, &self.feet, &request)?;
        self.work.iterations += stages.iterations;
        Some(stages)
    }

    /// Contact force scale below which a gap counts as zero [m].
    fn gap_tolerance(&self) -> f64 {
        (1e-9 * self.compression).max(4e-16 * self.model.body.radius().re())
    }

    /// Whether a foot's contact changes within the step, and where first.
    fn met(&self, stages: &Stages<S>) -> Met {
        let mut first = Met::Nothing;
        let mut earliest = f64::INFINITY;
        for foot in 0..2 {
            // the contact lasts while sign (compression - level) is positive
            let limits: &[(f64, f64)] = match self.feet[foot].contact {
                Contact::Open => &[(-1.0, 0.0)],
                Contact::Stick => &[(1.0, 0.0)],
                Contact::Slide => &[(1.0, 0.0), (-1.0, HOLDING * self.compression)],
            };
            let compression = |q| self.model.compression(foot, q).re();
            let values = [&self.state.q, &stages.q[0], &stages.q[1], &stages.q[2]].map(compression);
            for &(sign, level) in limits {
                let inside = values.map(|d| sign * (d - level));
                let Some(k) = (1..4).find(|&k| inside[k] < -self.gap_tolerance()) else { continue };
                let node = |k: usize| if k == 0 { 0.0 } else { C[k - 1] };
                let low = (node(k - 1), inside[k - 1].max(0.0));
                let tau = self.first_zero(foot, sign, level, stages, low, (node(k), inside[k]));
                if tau < earliest {
                    earliest = tau;
                    first = Met::Crossing { foot, level, tau };
                }
            }
        }
        first
    }

    /// Where the compression passes `level` on the collocation polynomial, between two bracketing points (Illinois).
    fn first_zero(
        &self,
        foot: usize,
        sign: f64,
        level: f64,
        stages: &Stages<S>,
        mut low: (f64, f64),
        mut high: (f64, f64),
    ) -> f64 {
        let value = |tau: f64| (self.model.compression(foot, &stages.position(&self.state, tau)).re() - level) * sign;
        let mut side = 0;
        for _ in 0..60 {
            let tau = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            if !(tau > low.0 && tau < high.0) || high.0 - low.0 < 1e-12 {
                break;
            }
            let d = value(tau);
            if d.abs() < 0.1 * self.gap_tolerance() {
                return tau;
            }
            if d > 0.0 {
                low = (tau, d);
                if side == 1 {
                    high.1 *= 0.5;
                }
                side = 1;
            } else {
                high = (tau, d);
                if side == -1 {
                    low.1 *= 0.5;
                }
                side = -1;
            }
        }
        low.0.max(1e-9)
    }

    /// Repeat the step so that it ends where the foot's gap is zero.
    fn locate(&mut self, foot: usize, level: f64, stages: Stages<S>, tau: f64, ground: &Ground<S>) -> Stages<S> {
        let mut best = stages;
        let mut h = stages.h * tau;
        for _ in 0..6 {
            self.work.located += 1;
            let Some(next) = self.attempt(h, ground) else { break };
            best = next;
            let end = next.end();
            let gap = self.model.compression(foot, &end.q) - level;
            let rate = self.model.compression_rate(foot, &end);
            if gap.re().abs() <= self.gap_tolerance() && self.control.extra_iterations == 0 {
                break;
            }
            let correction = gap / rate;
            if !correction.re().is_finite() || correction.re().abs() > 0.5 * h.re() {
                break;
            }
            let done = gap.re().abs() <= self.gap_tolerance();
            h -= correction;
            if done {
                // derivatives of the event's time, by the implicit function theorem
                if let Some(next) = self.attempt(h, ground) {
                    best = next;
                }
                break;
            }
        }
        best
    }

    /// Book the step if the account closes well enough; choose the next step's size.
    fn account(&mut self, stages: &Stages<S>, ground: &Ground<S>) -> bool {
        let end = stages.end();
        let stored = self.model.energy(&end, &self.feet);
        let (input, dissipated) = stages.work(self.model, ground);
        let defect = (stored - self.energy.stored - input + dissipated).re().abs();
        let allowed = self.control.tolerance * self.scale;
        // a radau step loses energy as h^6
        let factor = 0.9 * (allowed / defect.max(1e-300)).powf(1.0 / 6.0);
        let h = stages.h.re();
        // at a force discontinuity no step size satisfies the account: the smallest may break it, but not with a NaN
        let acceptable = defect <= allowed || (h <= 1e-9 * self.settling && defect.is_finite());
        if !acceptable {
            self.h = h * factor.clamp(0.1, 0.9);
            return false;
        }
        self.work.steps += 1;
        self.h = (h * factor.clamp(0.2, 5.0)).max(RESTART * self.settling);
        self.state = end;
        self.energy.stored = stored;
        self.energy.input += input;
        self.energy.dissipated += dissipated;
        self.scale = self.scale.max(self.energy.input.re().abs()).max((stored - self.energy.initial).re().abs());
        self.guess = [stages.a[2]; 3];
        true
    }

    /// Change a foot's contact.
    fn switch(&mut self, foot: usize, level: f64, time: S, observer: &mut impl Observer<S>) {
        let before = self.energy.stored;
        let was = self.feet[foot].contact;
        let anchor = self.model.anchor_here(foot, &self.state.q);
        self.feet[foot] = match was {
            Contact::Open => {
                let at_once = time.re() - self.opened[foot] < AT_ONCE * self.settling;
                let held = self.model.compression(foot, &self.state.q).re() >= HOLDING * self.compression;
                let contact = if at_once && !held { Contact::Slide } else { Contact::Stick };
                Foot { contact, anchor }
            }
            Contact::Slide if level > 0.0 => Foot { contact: Contact::Stick, anchor },
            Contact::Slide | Contact::Stick => {
                self.opened[foot] = time.re();
                Foot { contact: Contact::Open, anchor }
            }
        };
        self.model.turn_to_balance(&mut self.state, &self.feet);
        self.energy.stored = self.model.energy(&self.state, &self.feet);
        self.energy.released += before - self.energy.stored;
        self.guess = no_guess();
        self.work.events += 1;
        match (was, self.feet[foot].contact) {
            (Contact::Open, _) => observer.event(foot, Change::TouchDown, &self.view(time)),
            (_, Contact::Open) => observer.event(foot, Change::LiftOff, &self.view(time)),
            _ => {}
        }
    }

    pub fn energy(&self) -> &Energy<S> {
        &self.energy
    }

    /// Largest energy of the history [J].
    pub fn energy_scale(&self) -> f64 {
        self.scale
    }
}

impl<S: Scalar> Energy<S> {
    fn default_zero() -> Self {
        let zero = S::zero();
        Self { initial: zero, stored: zero, input: zero, dissipated: zero, released: zero }
    }
}
