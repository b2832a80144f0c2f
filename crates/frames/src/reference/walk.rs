//! From sample to sample, from event to event.

use nalgebra::DVector;

use super::contact::Rule;
use super::hold::{Configuration, CornerContact};
use super::state::{Rates, ReferenceState, ReferenceStep};
use super::stiffness::Stiffness;
use super::{
    CornerSet, ElasticRocking, GroundAcceleration, Ledger, ReferenceOptions, ReferenceOutcome,
    Stop, dop853, implicit, search, step_units,
};
use crate::Mechanics;
use rocking::scalar::GRAVITY;

/// Height at which a corner is on the ground, to rounding (m).
pub(crate) const ON_GROUND: f64 = 1e-12;
/// Vertical force that is rounding, as a share of the weight.
const ROUNDING: f64 = 1e-9;
/// Shortest step, as a share of the time step.
const SHORTEST: f64 = 1e-9;

/// A state and its rates.
#[derive(Clone, Debug)]
pub(crate) struct Moment {
    pub state: ReferenceState,
    pub rates: Rates,
}

/// A structure on its way.
pub(crate) struct ReferenceWalk<'a, M> {
    pub(super) mechanics: &'a M,
    pub(super) ground: GroundAcceleration<'a>,
    pub(super) options: &'a ReferenceOptions,
    /// Vertical force that is rounding (N).
    pub(super) rounding: f64,
    pub(super) all: CornerSet,
    pub(super) contact: CornerContact,
    /// Sign of the force on each sliding corner.
    pub(super) sense: Vec<f64>,
    /// Free corners that have been clear of the ground since they lifted, or have the velocity to
    /// be so at once.
    pub(super) clear: CornerSet,
    /// Held corners that can neither press nor leave.
    pub(super) stuck: CornerSet,
    /// x at which each corner is held.
    pub(super) anchors: Vec<f64>,
    pub(super) now: Moment,
    /// Sample interval and the time since its start (s).
    interval: usize,
    since: f64,
    h: f64,
    /// Since the last event.
    stiffness: Stiffness,
    pub(super) history: ElasticRocking,
    /// Steps that may be tried.
    most_steps: u64,
}

impl<'a, M: Mechanics> ReferenceWalk<'a, M> {
    pub(crate) fn new(
        mechanics: &'a M,
        ground: GroundAcceleration<'a>,
        (q, v): (&DVector<f64>, &DVector<f64>),
        options: &'a ReferenceOptions,
    ) -> Self {
        let state = ReferenceState { q: q.clone(), v: v.clone(), work: [0.0; 3] };
        let rates = Rates { a: DVector::zeros(v.len()), power: [0.0; 3], forces: Vec::new() };
        let corners = mechanics.footings().len();
        let weight = mechanics.whole_mass(q) * GRAVITY;
        let start = mechanics.kinetic(q, v) + mechanics.potential(q);
        let history = ElasticRocking {
            dt: ground.dt,
            q: Vec::new(),
            v: Vec::new(),
            forces: Vec::new(),
            events: Vec::new(),
            outcome: ReferenceOutcome::Completed,
            ledger: Ledger { start, ..Ledger::default() },
            pulled: 0.0,
            first_sliding_landing_s: None,
            steps: 0,
            tried: 0,
            most_work: options.most_work,
        };
        Self {
            mechanics,
            ground,
            options,
            rounding: ROUNDING * weight,
            all: (0..corners.min(CornerSet::MOST)).collect(),
            contact: CornerContact::default(),
            sense: vec![0.0; corners],
            clear: CornerSet::NONE,
            stuck: CornerSet::NONE,
            anchors: vec![0.0; corners],
            now: Moment { state, rates },
            interval: 0,
            since: 0.0,
            h: ground.dt,
            stiffness: Stiffness::default(),
            history,
            most_steps: options.most_work / step_units(q.len()),
        }
    }

    /// To the end, or to the sample at which `go_on` of its coordinates is false.
    pub(crate) fn run(mut self, mut go_on: impl FnMut(&DVector<f64>) -> bool) -> ElasticRocking {
        if let Err(outcome) = self.follow(&mut go_on) {
            self.history.outcome = outcome;
        }
        self.history
    }

    fn follow(
        &mut self,
        go_on: &mut impl FnMut(&DVector<f64>) -> bool,
    ) -> Result<(), ReferenceOutcome> {
        if self.mechanics.footings().len() > CornerSet::MOST {
            return Err(self.stop(Stop::Corners));
        }
        self.stand()?;
        let duration = self.options.duration.unwrap_or_else(|| self.ground.duration());
        let intervals = (duration / self.ground.dt).round() as usize;
        self.sample()?;
        while go_on(&self.now.state.q) && self.interval < intervals {
            self.cross()?;
            self.put_back()?;
            self.sample()?;
            (self.interval, self.since) = (self.interval + 1, 0.0);
            if self.interval + 1 >= self.ground.accel.len().max(self.ground.vertical.len()) {
                // the ground stops at once
                self.refresh()?;
            }
        }
        Ok(())
    }

    /// One sample interval.
    fn cross(&mut self) -> Result<(), ReferenceOutcome> {
        self.release()?;
        while self.since < self.ground.dt {
            let left = self.ground.dt - self.since;
            let h = if self.h > left * (1.0 - SHORTEST) { left } else { self.h };
            if self.history.tried as u64 >= self.most_steps {
                return Err(self.stop(Stop::Work));
            }
            self.history.tried += 1;
            let tried = self.step(&self.now, h);
            let factor = tried
                .as_ref()
                .map_or(0.0, |tried| 0.9 * tried.error.powf(-1.0 / tried.order))
                .clamp(0.2, 6.0);
            let tried = tried.filter(|tried| tried.error <= 1.0);
            let Some((end, last)) =
                tried.and_then(|tried| Some((self.moment(h, tried.state)?, tried.last)))
            else {
                self.h = h * factor.min(0.5);
                if self.h < SHORTEST * self.ground.dt {
                    return Err(self.stop(Stop::Step));
                }
                continue;
            };
            self.history.steps += 1;
            if let Some(last) = last {
                self.stiffness.note(h * last.fastest(&end.state, &end.rates));
            }
            let event = search::first(self, &self.now, &end, h);
            // an event's step is short; what the error allows is what counts for the next
            self.h = if h < self.h { self.h.max(h * factor) } else { h * factor };
            match event {
                None => {
                    self.since = if h == left { self.ground.dt } else { self.since + h };
                    self.now = end;
                    self.look()?;
                }
                Some(crossing) => {
                    self.now = self
                        .advanced(&self.now, crossing.after)
                        .ok_or_else(|| self.stop(Stop::Singular))?;
                    self.since += crossing.after;
                    // fast motions that it begins are for the explicit method
                    self.stiffness = Stiffness::default();
                    self.happen(crossing.corner)?;
                }
            }
        }
        Ok(())
    }

    /// The ground's acceleration at a time since the present.
    pub(super) fn ground(&self, t: f64) -> [f64; 2] {
        let share = (self.since + t) / self.ground.dt;
        [self.ground.accel, self.ground.vertical].map(|accel| {
            match accel.get(self.interval..self.interval + 2) {
                Some(ends) => self.options.scale * (ends[0] + share * (ends[1] - ends[0])),
                None => 0.0,
            }
        })
    }

    pub(super) fn rates(&self, t: f64, state: &ReferenceState) -> Option<Rates> {
        let (q, v, ground) = (&state.q, &state.v, self.ground(t));
        let at = Configuration::new(self.mechanics, q, v)?;
        let held = at.accelerations(ground, self.contact)?;
        let slid: f64 =
            self.contact.sliding.iter().map(|i| -held.force(i)[0] * at.velocity(i, v)[0]).sum();
        let power =
            [self.mechanics.dissipation(q, v), self.mechanics.input_power(q, v, ground), slid];
        Some(Rates { a: held.motion, power, forces: held.forces })
    }

    /// A state at a time since the present, with its rates.
    pub(crate) fn moment(&self, t: f64, state: ReferenceState) -> Option<Moment> {
        Some(Moment { rates: self.rates(t, &state)?, state })
    }

    /// What one step of length s from the present leads to.
    pub(crate) fn advanced(&self, start: &Moment, s: f64) -> Option<Moment> {
        if s == 0.0 {
            return Some(start.clone());
        }
        let state = self.step(start, s)?.state;
        self.moment(s, state)
    }

    /// One step of length h.
    fn step(&self, start: &Moment, h: f64) -> Option<ReferenceStep> {
        let Moment { state, rates } = start;
        let of = |t: f64, state: &ReferenceState| self.rates(t, state);
        if !self.stiffness.found() {
            return dop853::step(of, state, rates, h, self.options.rtol);
        }
        let at = Configuration::new(self.mechanics, &state.q, &state.v)?;
        let jacobian = at.tangent(self.ground(0.0), self.contact)?;
        implicit::step(of, &jacobian, (state, rates), h, self.options.rtol)
    }

    /// Corners at which something may happen.
    pub(crate) fn watched(&self) -> impl Iterator<Item = usize> {
        let (rule, held) = (self.rule(), self.contact.held);
        self.all
            .iter()
            .filter(move |&i| !held.contains(i) || !(self.stuck.contains(i) || rule.bound(held, i)))
    }

    /// What falls to zero at a corner's lift (N), at its landing (m), or at the end of its sliding
    /// (either way).
    pub(crate) fn margin(&self, corner: usize, moment: &Moment) -> f64 {
        let Moment { state, rates } = moment;
        if self.contact.held.contains(corner) {
            rates.force(corner)[1]
        } else if self.contact.sliding.contains(corner) {
            let sense = self.sense[corner];
            let speed = self.mechanics.corner(corner, &state.q, &state.v).jacobian[0].dot(&state.v);
            (rates.force(corner)[0] * sense).min(-speed * sense)
        } else {
            self.height(corner, state) + if self.clear.contains(corner) { 0.0 } else { ON_GROUND }
        }
    }

    /// Whether a corner's margin may start at zero and grow: it slides, or was let go with a
    /// velocity.
    pub(crate) fn begins(&self, corner: usize) -> bool {
        self.contact.sliding.contains(corner) || self.clear.contains(corner)
    }

    fn height(&self, corner: usize, state: &ReferenceState) -> f64 {
        self.mechanics.corner(corner, &state.q, &state.v).place[1]
    }

    pub(super) fn rule(&self) -> Rule<'a> {
        Rule { footings: self.mechanics.footings(), hop: self.options.hop, rounding: self.rounding }
    }

    pub(super) fn time(&self) -> f64 {
        self.interval as f64 * self.ground.dt + self.since
    }

    pub(super) fn stop(&self, why: Stop) -> ReferenceOutcome {
        ReferenceOutcome::Stopped { time: self.time(), why }
    }
}
