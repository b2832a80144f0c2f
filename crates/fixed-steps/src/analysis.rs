//! A history with fixed time steps: the time loop, substeps where the iteration does not arrive,
//! and what gives up.

use std::ops::ControlFlow;

use thiserror::Error;

use crate::{
    contact::FixedFoot,
    events::{EventSearch, EventStepping, FirstEvent, end_substep},
    integrator::Integrator,
    iteration::{Iterates, Iteration},
    kinematics::{Kinematics, MemberDamping, StepKinematics},
    model::FixedStepModel,
    rigid::FixedStepBody,
};
use frames::frame::EquilibriumError;
use rocking::motion::Motion;

/// A program's iteration did not arrive, in its shortest step.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "no convergence at {time:.6} s in a step of {step:.3e} s: softer springs, a shorter step, or \
     an integrator that ends stiff modes (TRBDF2, backward Euler)"
)]
pub struct GaveUp {
    /// End of the last step that held (s).
    pub time: f64,
    /// Size of the step that failed (s).
    pub step: f64,
}

/// How a history ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FixedStepOutcome {
    /// It went through.
    Finished,
    /// The structure lies on the ground, or falls and cannot be followed.
    Fallen {
        /// When that was seen (s).
        time: f64,
    },
    /// The program gave up.
    GaveUp(GaveUp),
}

/// How a program steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepSettings {
    /// Its integrator.
    pub integrator: Integrator,
    /// Size of all steps (s).
    pub step: f64,
    /// The smallest substep: a step whose iteration does not arrive is halved, at most down to
    /// this, and what follows doubles again up to `step` (s). `step` itself: none.
    pub least: f64,
    /// Touch refinement: so many substeps in a step within which a gap is about to open or close,
    /// and in the step after one that did. 1: none.
    pub at_touches: usize,
    /// Event-to-event stepping, for programs that offer it: whether and how steps are cut where a
    /// contact changes; not together with `at_touches`.
    pub events: Option<EventStepping>,
    /// The iteration at a step's end.
    pub iteration: Iteration,
    /// What dashpots of members resist.
    pub damping: MemberDamping,
}

impl StepSettings {
    /// Without substeps, the iteration that of scripts.
    pub fn new(integrator: Integrator, step: f64) -> Self {
        let (at_touches, events, iteration) = (1, None, Iteration::SCRIPT);
        let damping = MemberDamping::OfVelocities;
        Self { integrator, step, least: step, at_touches, events, iteration, damping }
    }

    /// With substeps down to this part of a step: 1/16 for instance.
    pub fn with_substeps(self, part: f64) -> Self {
        Self { least: part * self.step, ..self }
    }

    /// With so many substeps in steps at touches, for springs of any stiffness: a program that can
    /// be scripted sees from the gap and its rate before a step whether it opens or closes within.
    pub fn with_touches(self, at_touches: usize) -> Self {
        let at_touches = at_touches.max(1);
        Self { at_touches, least: self.least.min(self.step / at_touches as f64), ..self }
    }
}

/// What a history is made of.
#[derive(Clone, Debug)]
pub struct FixedStepAnalysis<'a, M> {
    /// What is stepped.
    pub model: &'a M,
    /// How.
    pub settings: StepSettings,
    /// Sampling interval of the record (s).
    pub dt: f64,
    /// Ground acceleration at t = i dt (m/s2), linear in between.
    pub accel: &'a [f64],
    /// Vertical ground acceleration at the same times (m/s2), upwards, zero beyond its last sample:
    /// empty if there is none.
    pub vertical: &'a [f64],
    /// Factor on the ground acceleration, both components.
    pub scale: f64,
}

/// A history at the record's samples.
#[derive(Clone, Debug)]
pub struct FixedStepHistory {
    /// The centre of mass; shorter than the record if the outcome says so.
    pub motion: Motion,
    /// How it ended.
    pub outcome: FixedStepOutcome,
    /// What it cost.
    pub work: FixedStepWork,
}

/// What a history cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FixedStepWork {
    /// Steps that held.
    pub steps: usize,
    /// Steps that were given up, and taken shorter if that is allowed.
    pub failed: usize,
    /// Begin of the first of these that was a part of a step already (s).
    pub part_failed_s: Option<f64>,
    /// Iterations, those of failed steps too.
    pub iterations: usize,
    /// Events at which a step was cut.
    pub events: usize,
}

impl FixedStepHistory {
    /// Nothing if it went through or the structure fell; else why it did not.
    ///
    /// # Errors
    /// The program gave up.
    pub fn through(&self) -> Result<(), GaveUp> {
        match self.outcome {
            FixedStepOutcome::GaveUp(gave_up) => Err(gave_up),
            _ => Ok(()),
        }
    }
}

/// Sizes of steps from one to the next.
struct SubstepPace {
    /// Of the next substep (s).
    size: f64,
    /// Whether this step is refined for a touch, and whether a contact has changed in it.
    refined: bool,
    touched: bool,
}

/// Part of a step below which it is not a whole one.
const WHOLE: f64 = 0.75;
/// Part of a step within which times count as equal.
const SAME: f64 = 1e-6;

impl<'a, M: FixedStepModel> FixedStepAnalysis<'a, M> {
    /// On horizontal motion.
    pub fn new(model: &'a M, settings: StepSettings, dt: f64, accel: &'a [f64]) -> Self {
        Self { model, settings, dt, accel, vertical: &[], scale: 1.0 }
    }

    /// Ground acceleration (a_g, a_v) at a time (m/s2).
    #[inline]
    fn ground(&self, time: f64) -> [f64; 2] {
        let place = time / self.dt;
        let i = place as usize;
        let part = place - i as f64;
        let at = |values: &[f64]| match values.get(i..i + 2) {
            Some(&[a, b]) => self.scale * (a + part * (b - a)),
            // the last sample itself, within rounding; nothing beyond
            _ if part < SAME => self.scale * values.get(i).copied().unwrap_or(0.0),
            _ => 0.0,
        };
        [at(self.accel), if self.vertical.is_empty() { 0.0 } else { at(self.vertical) }]
    }

    /// Step through the record from rest, and show the place at every sample; in between steps, on
    /// the straight line. The observer may end it.
    ///
    /// # Errors
    /// The structure has no equilibrium to begin from.
    pub fn follow(
        &self,
        mut show: impl FnMut(usize, &M::Vector) -> ControlFlow<()>,
    ) -> Result<(FixedStepOutcome, FixedStepWork), EquilibriumError> {
        let (q, feet) = self.model.standing()?;
        Ok(self.follow_from(Kinematics::at_rest(q), feet, &mut show))
    }

    /// The same from any motion.
    pub fn follow_from(
        &self,
        mut motion: Kinematics<M::Vector>,
        mut feet: M::Feet,
        show: &mut impl FnMut(usize, &M::Vector) -> ControlFlow<()>,
    ) -> (FixedStepOutcome, FixedStepWork) {
        let mut work = FixedStepWork::default();
        let mut iterates = Iterates::new(self.model, &motion.q, self.settings.damping);
        let mut shown = 0;
        let last = self.accel.len();
        let count = ((last.saturating_sub(1)) as f64 * self.dt / self.settings.step - SAME)
            .ceil()
            .max(0.0) as usize;
        if last > 0 && show(0, &motion.q).is_continue() {
            shown = 1;
        }
        let mut previous = motion.q.clone();
        let mut pace = SubstepPace { size: self.settings.step, refined: false, touched: false };
        for n in 0..count {
            let (begin, end) = (n as f64 * self.settings.step, (n + 1) as f64 * self.settings.step);
            previous.as_mut().copy_from_slice(motion.q.as_ref());
            let held =
                self.one_step(begin, &mut pace, &mut motion, &mut feet, &mut iterates, &mut work);
            work.iterations = iterates.count;
            if let Err(gave_up) = held {
                if self.model.is_falling(&motion.q) {
                    return (FixedStepOutcome::Fallen { time: gave_up.time }, work);
                }
                return (FixedStepOutcome::GaveUp(gave_up), work);
            }
            while shown < last && shown as f64 * self.dt <= end + SAME * self.settings.step {
                let part = ((shown as f64 * self.dt - begin) / self.settings.step).min(1.0);
                for (a, b) in iterates
                    .change
                    .as_mut()
                    .iter_mut()
                    .zip(previous.as_ref().iter().zip(motion.q.as_ref()))
                {
                    *a = if part > 1.0 - SAME { *b.1 } else { b.0 + part * (b.1 - b.0) };
                }
                if show(shown, &iterates.change).is_break() {
                    return (FixedStepOutcome::Finished, work);
                }
                shown += 1;
            }
            if self.model.has_fallen(&motion.q) {
                return (FixedStepOutcome::Fallen { time: end }, work);
            }
        }
        (FixedStepOutcome::Finished, work)
    }

    /// The longest substep of the step to come.
    fn longest(&self, pace: &mut SubstepPace, motion: &Kinematics<M::Vector>) -> f64 {
        let StepSettings { step, at_touches, .. } = self.settings;
        if at_touches == 1 {
            return step;
        }
        let mut near = pace.touched;
        self.model
            .gaps(&motion.q, &motion.v, |d, rate| near |= (d > 0.0) != (d + rate * step > 0.0));
        pace.touched = false;
        let longest = if near { step / at_touches as f64 } else { step };
        if near || pace.refined {
            pace.size = longest;
        }
        pace.refined = near;
        longest
    }

    /// One step, in substeps of `size` if its iteration does not arrive.
    #[inline]
    fn one_step(
        &self,
        begin: f64,
        pace: &mut SubstepPace,
        motion: &mut Kinematics<M::Vector>,
        feet: &mut M::Feet,
        iterates: &mut Iterates<M>,
        work: &mut FixedStepWork,
    ) -> Result<(), GaveUp> {
        let longest = self.longest(pace, motion);
        let mut done = 0.0;
        let mut cuts = self.settings.events.map_or(0, |events| events.most);
        // what is left of a step after its events is halved down to the same part of it
        let mut least = self.settings.least;
        while done < self.settings.step * (1.0 - SAME) {
            let this = pace.size.min(self.settings.step - done);
            // the same number each time, to the last digit
            let this = if (this - self.settings.step).abs() <= SAME * self.settings.step {
                self.settings.step
            } else {
                this
            };
            if cuts > 0 {
                let from = (begin + done, this);
                match self.to_event(from, motion, feet, iterates, work) {
                    Some((size, event)) => {
                        pace.touched |= event;
                        cuts -= usize::from(event);
                        done += size;
                    }
                    None => cuts = 0,
                }
                least = self.settings.least * (1.0 - done / self.settings.step);
                continue;
            }
            let step = motion.step(&self.settings.integrator, this);
            let ground = self.ground(begin + done + step.forces_at());
            if iterates.arrives(self.model, &self.settings.iteration, motion, &step, feet, ground) {
                self.reach(&step, motion, feet, iterates);
                pace.touched |= feet.as_ref().iter().any(FixedFoot::has_changed);
                feet.as_mut().iter_mut().for_each(FixedFoot::commit);
                work.steps += 1;
                done += this;
                pace.size = (2.0 * pace.size).min(longest);
            } else {
                work.failed += 1;
                if this < WHOLE * longest {
                    work.part_failed_s.get_or_insert(begin + done);
                }
                if 0.5 * this < least * (1.0 - SAME) {
                    return Err(GaveUp { time: begin + done, step: this });
                }
                feet.as_mut().iter_mut().for_each(FixedFoot::revert);
                motion.begin_anew();
                pace.size = 0.5 * this;
            }
        }
        Ok(())
    }

    /// The end of a step that has arrived.
    #[inline]
    fn reach(
        &self,
        step: &StepKinematics<M::Vector>,
        motion: &mut Kinematics<M::Vector>,
        feet: &mut M::Feet,
        iterates: &Iterates<M>,
    ) {
        motion.advance(step, &iterates.change);
        if step.forces_at() != step.size {
            let part = step.forces_at() / step.size;
            self.model.meet_end(&iterates.places, part, &motion.q, feet);
        }
    }

    /// A step of a size from a time, or up to its first event: its size, and whether an event ends
    /// it. `None` if the usual iteration is to go on from there.
    fn to_event(
        &self,
        (begin, size): (f64, f64),
        motion: &mut Kinematics<M::Vector>,
        feet: &mut M::Feet,
        iterates: &mut Iterates<M>,
        work: &mut FixedStepWork,
    ) -> Option<(f64, bool)> {
        let StepSettings { integrator, step: whole, iteration, .. } = &self.settings;
        // nothing in a browser asks for them, and the page is to stay small
        let events = self.settings.events.filter(|_| cfg!(not(target_family = "wasm")))?;
        let (model, whole) = (self.model, *whole);
        let search = EventSearch { model, events, iteration, integrator, whole };
        let ground = |after: f64| self.ground(begin + after);
        match search.first(size, motion, feet, iterates, ground) {
            FirstEvent::Substep { step, changing } => {
                self.reach(&step, motion, feet, iterates);
                end_substep(feet, &changing);
                feet.as_mut().iter_mut().for_each(FixedFoot::commit);
                work.steps += 1;
                work.events += usize::from(!changing.is_empty());
                Some((step.size, !changing.is_empty()))
            }
            FirstEvent::Unclear => None,
        }
    }
}

impl FixedStepAnalysis<'_, FixedStepBody> {
    /// The motion of the rigid body's centre of mass at the record's samples.
    pub fn history(&self) -> FixedStepHistory {
        let mut motion = Motion::with_capacity(self.accel.len());
        let ended = self.follow(|_, q| {
            let [u, v, theta] = self.model.displacement(q);
            motion.push(u, v, theta);
            ControlFlow::Continue(())
        });
        // a rigid body on springs always stands
        let (outcome, work) =
            ended.unwrap_or((FixedStepOutcome::Finished, FixedStepWork::default()));
        FixedStepHistory { motion, outcome, work }
    }
}
