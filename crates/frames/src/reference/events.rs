//! What a walk does at events and samples.

use nalgebra::DVector;

use super::contact::{AT_REST, Landed, land, stay};
use super::hold::{Configuration, CornerContact};
use super::state::ReferenceState;
use super::walk::{ON_GROUND, ReferenceWalk};
use super::{CornerSet, Ledger, ReferenceEvent, ReferenceOutcome, Stop, What};
use crate::Mechanics;

/// Height and speed at which a corner counts as standing at the start (m, m/s).
const STANDING: f64 = 1e-9;
/// Energy at stake where a corner slides on from a landing, as a share of the largest so far, below
/// which it cannot be seen: 1e-4 of velocities.
const SKID: f64 = 1e-8;

impl<M: Mechanics> ReferenceWalk<'_, M> {
    /// Corners that are on the ground and at rest at the start are held, as far as they press.
    pub(super) fn stand(&mut self) -> Result<(), ReferenceOutcome> {
        let ReferenceState { q, v, .. } = &self.now.state;
        let singular = self.stop(Stop::Singular);
        let at = Configuration::new(self.mechanics, q, v).ok_or(singular)?;
        let standing = |i: &usize| {
            let height = self.mechanics.corner(*i, q, v).place[1];
            height.abs() <= STANDING && at.speed(*i, v) <= STANDING
        };
        self.contact = CornerContact::held(self.all.iter().filter(standing).collect());
        self.clear = self.all.minus(self.contact.held);
        self.anchor(self.contact.held);
        self.refresh()?;
        self.release()
    }

    /// At a crossing: the corner lifts, comes to rest, or lands with all others that are on the
    /// ground.
    pub(super) fn happen(&mut self, corner: usize) -> Result<(), ReferenceOutcome> {
        if self.contact.held.contains(corner) {
            self.choose(CornerSet::NONE.with(corner))
        } else if self.contact.sliding.contains(corner) {
            self.end_slip(corner)
        } else {
            self.land(corner)
        }
    }

    /// A corner and all others that are on the ground land.
    fn land(&mut self, corner: usize) -> Result<(), ReferenceOutcome> {
        let ReferenceState { q, v, .. } = &self.now.state;
        let singular = self.stop(Stop::Singular);
        let at = Configuration::new(self.mechanics, q, v).ok_or(singular)?;
        let down = |i: &usize| *i == corner || at.velocity(*i, v)[1] < 0.0;
        let was = self.contact;
        let there = |i: &usize| *i == corner || self.margin(*i, &self.now) <= 2.0 * ON_GROUND;
        let there: CornerSet = self.all.minus(was.all()).iter().filter(there).collect();
        let landing: CornerSet = there.iter().filter(down).collect();
        let touching = was.all().and(there);
        let Landed { velocity: mut after, held, sliding: skidding } =
            land(&at, self.ground(0.0), touching, landing, &self.rule()).ok_or(singular)?;
        let slides = |&i: &usize| !held.contains(i) && at.velocity(i, &after)[1].abs() <= AT_REST;
        self.contact = CornerContact { held, sliding: was.sliding.iter().filter(slides).collect() };
        after *= self.options.kept;
        let before = std::mem::replace(&mut self.now.state.v, after);
        // those that were let go have a velocity to leave with
        self.clear = self.clear.and(touching).minus(self.contact.all());
        self.stuck = CornerSet::NONE;
        self.anchor(held.minus(was.held));
        self.put_back()?;
        self.note(What::Land, landing, before)?;
        if let Some((corner, sense, energy)) = skidding {
            if energy > SKID * self.history.ledger.largest {
                self.history.first_sliding_landing_s =
                    self.history.first_sliding_landing_s.or(Some(self.time()));
            }
            self.skid(corner, sense)?;
        }
        self.release()
    }

    /// A corner slides on from a landing, unless it rises at once.
    fn skid(&mut self, corner: usize, sense: f64) -> Result<(), ReferenceOutcome> {
        let free = self.contact;
        self.contact.sliding = free.sliding.with(corner);
        self.sense[corner] = sense;
        self.refresh()?;
        if self.now.rates.force(corner)[0] * sense <= 0.0 {
            self.contact = free;
            self.refresh()?;
        }
        Ok(())
    }

    /// A sliding corner leaves the ground, or stops.
    fn end_slip(&mut self, corner: usize) -> Result<(), ReferenceOutcome> {
        let ReferenceState { q, v, .. } = &self.now.state;
        let singular = self.stop(Stop::Singular);
        let at = Configuration::new(self.mechanics, q, v).ok_or(singular)?;
        let CornerContact { held, sliding } = self.contact;
        let (one, sliding) = (CornerSet::NONE.with(corner), sliding.without(corner));
        let stopped = CornerContact { held: held.and(one), sliding };
        let pressed = at.accelerations(self.ground(0.0), stopped).ok_or(singular)?.force(corner)[1];
        let v = v.clone();
        // where it cannot stop, its force has fallen to zero too soon after the start of sliding
        // for its velocity to tell
        if self.now.rates.force(corner)[0] * self.sense[corner] <= self.rounding || pressed < 0.0 {
            self.contact.sliding = sliding;
            self.refresh()?;
            return self.note(What::Lift, one, v);
        }
        self.contact = stopped;
        self.anchor(one);
        self.put_back()?;
        self.note(What::Stick, one, v)?;
        self.release()
    }

    /// Held corners that would have to be pulled are let go.
    pub(super) fn release(&mut self) -> Result<(), ReferenceOutcome> {
        let rule = self.rule();
        let pulled = |&(i, force): &(usize, [f64; 2])| {
            force[1] < -self.rounding && !rule.bound(self.contact.held, i)
        };
        if self.now.rates.forces.iter().any(pulled) { self.choose(CornerSet::NONE) } else { Ok(()) }
    }

    /// Choose those that stay of the held corners, without those that are to go if that is
    /// possible.
    fn choose(&mut self, going: CornerSet) -> Result<(), ReferenceOutcome> {
        let ReferenceState { q, v, .. } = &self.now.state;
        let singular = self.stop(Stop::Singular);
        let at = Configuration::new(self.mechanics, q, v).ok_or(singular)?;
        let was = self.contact;
        let mut tried = was.held.minus(going).subsets();
        tried.reverse();
        let (contact, forces, consistent) =
            stay(&at, self.ground(0.0), was, &tried, &self.rule()).ok_or(singular)?;
        if !consistent {
            // it can neither press nor leave nor slide: held, and looked at again
            let pulls = |i: &usize| self.margin(*i, &self.now) <= self.rounding;
            self.stuck = was.held.iter().filter(pulls).collect();
            return Ok(());
        }
        let slips = contact.sliding.minus(was.sliding);
        for i in slips.iter() {
            self.sense[i] = forces.force(i)[0].signum();
        }
        self.contact = contact;
        self.stuck = CornerSet::NONE;
        self.refresh()?;
        for (what, corners) in [(What::Lift, was.all().minus(contact.all())), (What::Slip, slips)] {
            if !corners.is_empty() {
                self.note(what, corners, self.now.state.v.clone())?;
            }
        }
        Ok(())
    }

    /// After a step: corners that are clear of the ground, those that were stuck, footings that
    /// have overturned.
    pub(super) fn look(&mut self) -> Result<(), ReferenceOutcome> {
        for i in self.all.minus(self.contact.all()).minus(self.clear).iter() {
            if self.margin(i, &self.now) > 2.0 * ON_GROUND {
                self.clear = self.clear.with(i);
            }
        }
        if !self.stuck.is_empty() {
            let pull = self.stuck.iter().map(|i| -self.margin(i, &self.now)).fold(0.0, f64::max);
            self.history.pulled = self.history.pulled.max(pull);
            self.stuck = CornerSet::NONE;
            self.release()?;
        }
        let turned = |&footing: &usize| self.mechanics.rotation(footing, &self.now.state.q).abs();
        if self
            .mechanics
            .footings()
            .iter()
            .any(|footing| turned(footing) >= self.options.overturned_at)
        {
            return Err(ReferenceOutcome::Overturned { time: self.time() });
        }
        Ok(())
    }

    /// Held corners back to their places and at rest: what rounding and the integrator's error
    /// moved them by.
    pub(super) fn put_back(&mut self) -> Result<(), ReferenceOutcome> {
        let singular = self.stop(Stop::Singular);
        if !self.contact.all().is_empty() {
            let ReferenceState { q, v, .. } = &self.now.state;
            let at = Configuration::new(self.mechanics, q, v).ok_or(singular)?;
            let q = q + at.shift(self.contact, &self.anchors).ok_or(singular)?.motion;
            let v = Configuration::new(self.mechanics, &q, v)
                .and_then(|at| at.impact(self.contact))
                .ok_or(singular)?;
            (self.now.state.q, self.now.state.v) = (q, v.motion);
        }
        self.refresh()
    }

    /// Rates of the present state.
    pub(super) fn refresh(&mut self) -> Result<(), ReferenceOutcome> {
        self.now.rates =
            self.rates(0.0, &self.now.state).ok_or_else(|| self.stop(Stop::Singular))?;
        Ok(())
    }

    fn anchor(&mut self, corners: CornerSet) {
        for i in corners.iter() {
            self.anchors[i] =
                self.mechanics.corner(i, &self.now.state.q, &self.now.state.v).place[0];
        }
    }

    fn energy(&self, v: &DVector<f64>) -> f64 {
        let q = &self.now.state.q;
        self.mechanics.kinetic(q, v) + self.mechanics.potential(q)
    }

    fn note(
        &mut self,
        what: What,
        corners: CornerSet,
        before: DVector<f64>,
    ) -> Result<(), ReferenceOutcome> {
        let after = self.now.state.v.clone();
        let energy = [self.energy(&before), self.energy(&after)];
        let q = self.now.state.q.clone();
        self.history.ledger.landings += energy[0] - energy[1];
        let event = ReferenceEvent {
            time: self.time(),
            what,
            corners,
            held: self.contact.held,
            q,
            velocity: [before, after],
            energy,
        };
        self.history.events.push(event);
        if self.history.events.len() > self.options.max_events {
            Err(self.stop(Stop::Events))
        } else {
            Ok(())
        }
    }

    /// Keep the present state, which is a sample's.
    pub(super) fn sample(&mut self) -> Result<(), ReferenceOutcome> {
        let ReferenceState { q, v, work } = &self.now.state;
        let mut forces = vec![[0.0; 2]; self.anchors.len()];
        for (i, force) in &self.now.rates.forces {
            forces[*i] = *force;
        }
        let (kinetic, potential) = (self.mechanics.kinetic(q, v), self.mechanics.potential(q));
        let ledger = &self.history.ledger;
        let open =
            (kinetic + potential + work[0] + work[2] + ledger.landings - work[1] - ledger.start)
                .abs();
        self.history.ledger = Ledger {
            kinetic,
            damped: work[0],
            input: work[1],
            slid: work[2],
            open: ledger.open.max(open),
            largest: ledger.largest.max(kinetic).max((potential - ledger.start).abs()),
            ..*ledger
        };
        self.history.q.push(q.clone());
        self.history.v.push(v.clone());
        self.history.forces.push(forces);
        Ok(())
    }
}
