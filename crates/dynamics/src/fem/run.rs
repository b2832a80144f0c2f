//! The time loop: steps that end at every sample, and between samples at every contact event
//! (`run/events`); the energy account accepts them (`run/tried`) and chooses the next
//! (`run/account`).

mod account;
mod events;
mod grip;
mod ground;
mod met;
mod rest;
mod span;
mod tried;

use std::ops::ControlFlow;

pub(super) use super::cubic::stays_inside;
use super::{
    Finish,
    acceptance::allowed_error,
    control::{Control, HistoryOutcome, Work},
    energy::Energy,
    model::{Foot, Model, State, Vector, Z},
    observer::{Observer, View},
    step::{Ground, NO_GUESS, Request, Stages, Stepper},
};
pub(super) use account::{Contacts, Scales, StepMeasures};
use events::Locating;
pub use events::{AT_ONCE, MOST_LOCATED, RESTART};
pub(crate) use ground::GroundMotion;
use met::StepEvent;
use rocking::scalar::GRAVITY;
use span::Span;

/// A history in the making.
pub(crate) struct TimeLoop<'a> {
    pub model: &'a Model,
    motion: GroundMotion<'a>,
    /// The interval between two samples that is crossed, or that comes next.
    interval: usize,
    /// Whether it is under way.
    crossing: bool,
    /// Time since its start (s).
    t: f64,
    /// Ground acceleration from its start on, and from now on.
    ground: Ground,
    here: Ground,
    /// The step over several samples under way.
    spanning: Option<Span>,
    /// By how far the parabola is late at the samples within it (m).
    late: [f64; span::MOST],
    /// Its rate (m/s).
    late_rate: [f64; span::MOST],
    /// Displacement of the mass per unit acceleration on the springs (s2).
    compliance: f64,
    /// The sample up to which steps over several samples may go: an event comes after it.
    event_by: usize,
    /// The event that the step under way is repeated for.
    locating: Option<Locating>,
    stepper: Stepper<'a>,
    control: Control,
    state: State,
    feet: [Foot; 2],
    energy: Energy,
    /// Largest energy seen (J), the scale of the account.
    scale: f64,
    /// Static compression of k1 under the weight (m), the scale of contact.
    compression: f64,
    /// sqrt(compression/g) = 1/Omega_n of the vertical chain (s), the scale of time in contact.
    settling: f64,
    /// What rounding makes of a foot's place (m): some units in the last digit of R.
    rounding: f64,
    /// The scales of a local error.
    pub scales: Scales,
    /// What a step's local error may be, in these scales.
    error: f64,
    /// First guess of the next step's acceleration.
    guess: Vector,
    /// Factor by which an iteration of the next step is expected to reduce the error; 1 if unknown.
    rate: f64,
    /// When each foot last opened (s).
    opened: [f64; 2],
    /// Horizontal force that each foot let go when it last opened, over what it then leant on.
    released_shear: [f64; 2],
    /// What the other foot carried when each foot last opened (N).
    leant_on: [f64; 2],
    /// Step size that the energy account asked for (s).
    h: f64,
    /// Whether a rotation without inertia is in balance.
    balanced: bool,
    /// How often it turned in the event under way.
    turns: usize,
    /// The body rests on still ground.
    resting: bool,
    pub work: Work,
}

impl<'a> TimeLoop<'a> {
    pub(crate) fn new(model: &'a Model, start: (State, [Foot; 2]), control: Control) -> Self {
        let (state, feet) = start;
        let stored = model.energy(&state, &feet);
        let weight = model.body.mass * GRAVITY;
        let compression = weight / model.springs.vertical.k1;
        // of the standing body: energy at rest, less than a thousandth of which means nothing
        let settled = model.settled();
        let rest = model.energy(&settled.0, &settled.1);
        let scale = (stored - rest).abs().max(1e-3 * rest.abs());
        Self {
            model,
            motion: GroundMotion { dt: 0.0, accel: &[], vertical: &[], scale: 1.0 },
            interval: 0,
            crossing: false,
            t: 0.0,
            ground: Ground::still(),
            here: Ground::still(),
            spanning: None,
            late: [0.0; span::MOST],
            late_rate: [0.0; span::MOST],
            compliance: span::compliance(model),
            event_by: usize::MAX,
            locating: None,
            stepper: Stepper::new(model),
            control,
            state,
            feet,
            energy: Energy::new(stored),
            scale,
            compression,
            settling: (compression / GRAVITY).sqrt(),
            rounding: 8.0 * f64::EPSILON * model.body.radius(),
            scales: Scales::of(model),
            error: allowed_error(control.tolerance),
            guess: NO_GUESS,
            rate: 1.0,
            opened: [f64::NEG_INFINITY; 2],
            released_shear: [0.0; 2],
            leant_on: [0.0; 2],
            h: f64::INFINITY,
            balanced: state.q[Z].is_finite() && model.in_balance(&state, &feet),
            turns: 0,
            resting: false,
            work: Work::default(),
        }
    }

    fn view(&self, time: f64) -> View<'_> {
        View { time, model: self.model, state: &self.state, feet: &self.feet, energy: &self.energy }
    }

    /// Follow a motion of the ground to its end.
    pub(crate) fn follow(
        &mut self,
        motion: GroundMotion<'a>,
        observer: &mut dyn Observer,
    ) -> HistoryOutcome {
        let begun = self.begin(motion, observer);
        match begun.and_then(|()| self.plan(observer)) {
            Ok(h) => self.go_on(h, observer),
            Err(outcome) => outcome,
        }
    }

    /// Go on to the motion's end, with a step of size h (s) first.
    pub(crate) fn go_on(&mut self, mut h: f64, observer: &mut dyn Observer) -> HistoryOutcome {
        let mut stages = Stages::none();
        loop {
            let converged = self.attempt(h, &mut stages);
            let next = match self.process_step(converged, &mut stages, None, observer) {
                Ok(Some(h)) => Ok(h),
                Ok(None) => self.plan(observer),
                Err(outcome) => Err(outcome),
            };
            match next {
                Ok(next) => h = next,
                Err(outcome) => return outcome,
            }
        }
    }

    /// Whether the step that was planned goes over several samples.
    pub(crate) fn spans(&self) -> bool {
        self.spanning.is_some()
    }

    /// Set out on a motion and show the first sample; the outcome if there is nothing to follow.
    pub(crate) fn begin(
        &mut self,
        motion: GroundMotion<'a>,
        observer: &mut dyn Observer,
    ) -> Result<(), HistoryOutcome> {
        self.motion = motion;
        if self.motion.accel.is_empty() {
            return Err(HistoryOutcome::Completed);
        }
        self.show_sample(0, observer)
    }

    fn show_sample(
        &mut self,
        index: usize,
        observer: &mut dyn Observer,
    ) -> Result<(), HistoryOutcome> {
        let time = index as f64 * self.motion.dt;
        self.interval = index;
        self.crossing = false;
        match observer.sample(index, &self.view(time)) {
            ControlFlow::Break(()) => Err(HistoryOutcome::Stopped { time }),
            ControlFlow::Continue(()) => Ok(()),
        }
    }

    /// Size of the next step to try, past samples and rests; the outcome once the history has
    /// ended.
    pub(crate) fn plan(&mut self, observer: &mut dyn Observer) -> Result<f64, HistoryOutcome> {
        let dt = self.motion.dt;
        loop {
            if self.crossing {
                let left = -self.t + dt;
                if left > 1e-13 * dt {
                    return self.next_step(left);
                }
                self.show_sample(self.interval + 1, observer)?;
            }
            if self.interval + 1 >= self.motion.accel.len() {
                return Err(HistoryOutcome::Completed);
            }
            self.ground = self.motion.ground(self.interval);
            if self.rests() {
                observer.step(&self.view(self.interval as f64 * dt + dt));
                self.show_sample(self.interval + 1, observer)?;
            } else {
                self.check(self.start_of_interval())?;
                if let Some(size) = self.span() {
                    return Ok(size);
                }
                (self.t, self.crossing) = (0.0, true);
            }
        }
    }

    /// The next step, `left` being left of the interval between two samples.
    fn next_step(&mut self, left: f64) -> Result<f64, HistoryOutcome> {
        self.check(self.start_of_interval() + self.t)?;
        self.here = self.ground.from(self.t);
        self.locating = None;
        Ok(self.next_size(left))
    }

    /// The outcome if the history can go no further.
    fn check(&self, time: f64) -> Result<(), HistoryOutcome> {
        if self.work.steps + self.work.rejected >= self.control.most_steps {
            return Err(HistoryOutcome::WorkBound { time });
        }
        // no step is short enough: where a massless rotation is about to snap its rate has no bound
        if !self.balanced || self.h < 1e-14 * self.motion.dt {
            return Err(HistoryOutcome::Unstable { time });
        }
        Ok(())
    }

    fn start_of_interval(&self) -> f64 {
        self.interval as f64 * self.motion.dt
    }

    /// The next step: what the account allows, never past the sample, and no sliver left over.
    fn next_size(&self, left: f64) -> f64 {
        if self.h >= 0.999 * left {
            left
        } else if self.h > 0.5 * left {
            left * 0.5
        } else {
            self.h
        }
    }

    /// What is asked of a step of size h.
    fn request(&self, h: f64) -> Request {
        // a share of what presses the feet that the energy account would not notice
        let share = (1e3 * self.control.tolerance).clamp(1e-7, 1e-3);
        let tolerance = (share * self.compression).max(self.rounding);
        let spans = self.spanning.is_some();
        Request {
            h,
            ground: self.here,
            guess: if spans { self.pendulum(h) } else { [self.guess; 3] },
            tolerance,
            rate: self.rate,
            turning: spans.then(|| self.turning(h, tolerance)),
        }
    }

    /// Hand over what a step of size h needs: start, contacts, what is asked, and what rounding
    /// alone may make of an iteration (m).
    pub(crate) fn submit(&self, h: f64, take: impl FnOnce(&State, &[Foot; 2], &Request, f64)) {
        take(&self.state, &self.feet, &self.request(h), self.stepper.rounding);
    }

    /// Take a step of size h into `stages`; whether it converges.
    pub(crate) fn attempt(&mut self, h: f64, stages: &mut Stages) -> bool {
        let request = self.request(h);
        self.stepper.step(&self.state, &self.feet, &request, stages)
    }

    /// How it ended, and what it cost.
    pub(crate) fn finish(&self, outcome: HistoryOutcome) -> Finish {
        Finish { outcome, work: self.work, energy: self.energy, energy_scale: self.scale }
    }
}
