//! The time loop: steps that end at every sample, and between samples at every contact event (`run/events`); the energy
//! account accepts them and chooses the next (`run/account`).

mod account;
mod events;
mod grip;
mod met;
mod rest;

use std::f64::consts::FRAC_PI_2;

use super::{
    control::{Control, Outcome, Work},
    energy::Energy,
    model::{Foot, Model, State, TH, Vector, Z},
    observer::{Observer, View},
    step::{Ground, Request, Stages, Stepper, no_guess},
};
use crate::scalar::{GRAVITY, Scalar, real};
use met::Met;

/// A history in the making.
pub(crate) struct Run<'a, S> {
    model: &'a Model<S>,
    stepper: Stepper<'a, S>,
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
    /// What rounding makes of a foot's place [m]: some units in the last digit of R.
    rounding: f64,
    /// Lean of balance [rad], the scale of a local error.
    alpha: f64,
    /// What a step's local error may be, in that scale.
    error: f64,
    /// 1/p [s], the time in which an error of the rate becomes one of the lean.
    moment: f64,
    guess: [Vector<S>; 3],
    /// Factor by which an iteration of the next step is expected to reduce the error; 1 if unknown.
    rate: f64,
    /// When each foot last opened [s].
    opened: [f64; 2],
    /// Horizontal force that each foot let go when it last opened, over what it then leant on.
    let_go: [f64; 2],
    /// What the other foot carried when each foot last opened [N].
    leant_on: [f64; 2],
    /// Step size that the energy account asked for [s].
    h: f64,
    /// Whether a rotation without inertia is in balance.
    balanced: bool,
    /// How often it turned in the event under way.
    turns: usize,
    /// The body rests on still ground.
    resting: bool,
    pub work: Work,
}

impl<'a, S: Scalar> Run<'a, S> {
    pub fn new(model: &'a Model<S>, start: (State<S>, [Foot<S>; 2]), control: Control) -> Self {
        let (state, feet) = start;
        let stored = model.energy(&state, &feet);
        let weight = model.body.mass.re() * GRAVITY;
        let compression = weight / model.springs.vertical.k1.re();
        // of the standing body: energy at rest, less than a thousandth of which means nothing
        let settled = model.settled();
        let rest = model.energy(&settled.0, &settled.1).re();
        let scale = (stored.re() - rest).abs().max(1e-3 * rest.abs());
        Self {
            model,
            stepper: Stepper::new(model),
            control,
            state,
            feet,
            energy: Energy::new(stored),
            scale,
            compression,
            settling: (compression / GRAVITY).sqrt(),
            rounding: 8.0 * f64::EPSILON * model.body.radius().re(),
            alpha: model.body.alpha().re(),
            error: account::allowed_error(control.tolerance),
            moment: model.body.p_squared().re().sqrt().recip(),
            guess: no_guess(),
            rate: 1.0,
            opened: [f64::NEG_INFINITY; 2],
            let_go: [0.0; 2],
            leant_on: [0.0; 2],
            h: f64::INFINITY,
            balanced: state.q[Z].re().is_finite() && model.in_balance(&state, &feet),
            turns: 0,
            resting: false,
            work: Work::default(),
        }
    }

    fn view(&self, time: S) -> View<'_, S> {
        View { time, model: self.model, state: &self.state, feet: &self.feet, energy: &self.energy }
    }

    /// Follow the record (m/s2 at steps of dt, times `scale`): horizontal, and vertical, which is zero beyond its last sample.
    pub fn follow(
        &mut self,
        dt: f64,
        (accel, vertical): (&[f64], &[f64]),
        scale: S,
        observer: &mut impl Observer<S>,
    ) -> Outcome {
        let n = accel.len();
        let up = |i: usize| vertical.get(i).copied().unwrap_or(0.0);
        if n == 0 {
            return Outcome::Completed;
        }
        if observer.sample(0, &self.view(S::zero())).is_break() {
            return Outcome::Stopped { time: 0.0 };
        }
        let mut stages = Stages::none();
        for i in 0..n - 1 {
            let t0 = i as f64 * dt;
            let slope = |now: f64, next: f64| scale * ((next - now) / dt);
            let ground = Ground {
                start: [scale * accel[i], scale * up(i)],
                slope: [slope(accel[i], accel[i + 1]), slope(up(i), up(i + 1))],
            };
            if self.rests(&ground) {
                observer.step(&self.view(real(t0 + dt)));
            } else if let Err(outcome) = self.cross_sample(t0, dt, &ground, &mut stages, observer) {
                return outcome;
            }
            if observer.sample(i + 1, &self.view(real(t0 + dt))).is_break() {
                return Outcome::Stopped { time: t0 + dt };
            }
        }
        Outcome::Completed
    }

    /// From one sample to the next; the outcome if the history ends in between.
    fn cross_sample(
        &mut self,
        t0: f64,
        dt: f64,
        ground: &Ground<S>,
        stages: &mut Stages<S>,
        observer: &mut impl Observer<S>,
    ) -> Result<(), Outcome> {
        let mut t = S::zero();
        loop {
            let left = -t + dt;
            if left.re() <= 1e-13 * dt {
                return Ok(());
            }
            let time = t0 + t.re();
            if self.work.steps + self.work.rejected >= self.control.most_steps {
                return Err(Outcome::WorkBound { time });
            }
            // no step is short enough: where a massless rotation is about to snap its rate has no bound
            if !self.balanced || self.h < 1e-14 * dt {
                return Err(Outcome::Unstable { time });
            }
            let h = self.next_size(left);
            let here = ground.from(t);
            if !self.attempt(h, &here, stages) {
                self.refuse(h.re() * 0.25);
                continue;
            }
            let mut met = self.met(stages);
            if let Met::Grip { foot, tau } = met {
                if !self.locate_grip(foot, tau, stages, &here) {
                    self.refuse(h.re() * tau * 0.5);
                    continue;
                }
                // where it changes was but estimated: a foot may touch or leave the ground before
                met = self.crosses(stages).or(met);
            }
            let (located, tau) = match met {
                Met::Unresolved => (None, 0.5),
                Met::Nothing => (Some(false), 1.0),
                Met::Crossing { foot, level, tau } => (self.locate(foot, level, stages, tau, &here), tau),
                Met::Grip { .. } => (Some(true), 1.0),
            };
            let Some(changes) = located else {
                // nearer to the event, the step that ends there is easier
                self.refuse(h.re() * tau * 0.5);
                continue;
            };
            if !self.account(stages, &here) {
                self.work.rejected += 1;
                continue;
            }
            t += stages.h;
            if self.state.q[TH].re().abs() > FRAC_PI_2 {
                return Err(Outcome::Overturned { time: t0 + t.re() });
            }
            observer.step(&self.view(real::<S>(t0) + t));
            match met {
                Met::Crossing { foot, level, .. } if changes => {
                    self.turns = 0;
                    self.switch(foot, level, real::<S>(t0) + t, observer);
                }
                Met::Grip { foot, .. } if changes => self.change_grip(foot, real::<S>(t0) + t, observer),
                _ => {}
            }
        }
    }

    /// Count a step that did not converge; try again with size h [s].
    fn refuse(&mut self, h: f64) {
        self.work.rejected += 1;
        self.rate = 1.0;
        self.h = h;
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

    /// Take a step of size h into `stages`; whether it converges.
    fn attempt(&mut self, h: S, ground: &Ground<S>, stages: &mut Stages<S>) -> bool {
        // a share of what presses the feet that the energy account would not notice
        let share = (1e3 * self.control.tolerance).clamp(1e-7, 1e-3);
        let request = Request {
            h,
            ground: *ground,
            guess: &self.guess,
            tolerance: (share * self.compression).max(self.rounding),
            extra: self.control.extra_iterations,
            rate: self.rate,
        };
        let converged = self.stepper.step(&self.state, &self.feet, &request, stages);
        if converged {
            self.work.iterations += stages.iterations;
        }
        converged
    }

    pub fn energy(&self) -> &Energy<S> {
        &self.energy
    }

    /// Largest energy of the history [J].
    pub fn energy_scale(&self) -> f64 {
        self.scale
    }
}
