//! What the feet's touch-downs and lift-offs mean: impacts, bounces, time in the air.
//!
//! Housner's body leans on one foot, lands on the other (the impact) and leans on that one. On
//! springs a landing may take several touch-downs: the foot may bounce, the old foot may touch
//! again. What is told apart here:
//!
//! - a *lean* on a foot is the time in which that foot, and for no longer than a moment the other,
//!   carries the body alone; a moment is 0.1/p (0.25 s for the paper's structure), the time in
//!   which a rigid body rocks from and to 0.1 % of alpha. Shorter leans, and touches of the other
//!   foot within a lean, are chatter, unless the body turns back in them and falls with more energy
//!   than from 0.1 % of alpha: shaken hard, it rocks that fast;
//! - an *impact* ends a lean: the first touch-down of the other foot, whether the body goes on
//!   leaning on that or rests. A lean that the history's end cuts short has none;
//! - a *bounce* is a touch-down of the foot that the last impact was on, that impact included,
//!   which opens again within a moment and before the next impact.

use super::observer::Change;

/// A moment, in units of 1/p.
pub const MOMENT: f64 = 0.1;
/// The lean from and to which a rigid body rocks in a moment, share of alpha.
pub(super) const SLIGHT: f64 = 1e-3;

/// One touch-down of a foot and what came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// Touch-down (s).
    pub time: f64,
    /// 0 left, 1 right.
    pub foot: usize,
    /// Kinetic energy of the body at touch-down (J).
    pub kinetic: f64,
    /// Of an impact: energy taken by the springs' dashpots and let go by springs from it to the
    /// next impact, or to the end (J); members apart.
    pub lost: f64,
    /// Whether it is a bounce: a touch-down of the foot that the last impact was on, that impact
    /// included, which opens again within 0.1/p (s) and before the next impact; p is the body's
    /// frequency parameter (1/s).
    pub bounced: bool,
    /// Whether it is an impact: it ends a lean on the other foot. No re-landing of a bounce and no
    /// touch within a lean is one.
    pub impact: bool,
    /// Of an impact: time with both feet in the air from it to the next impact, or to the end (s).
    pub airborne: f64,
}

/// A foot's change of contact, as it was seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactEvent {
    pub time: f64,
    pub foot: usize,
    pub change: Change,
    /// Kinetic energy of the body (J).
    pub kinetic: f64,
    /// Horizontal velocity of its centre of mass (m/s).
    pub speed: f64,
    /// Energy that springs took since the start (J).
    pub lost: f64,
}

/// All events of a history, and what is needed to read them.
#[derive(Clone, Debug, Default)]
pub(super) struct Events {
    pub events: Vec<ContactEvent>,
    /// Which feet press at t = 0.
    pub pressing: [bool; 2],
    /// A moment (s).
    pub moment: f64,
    /// Energy of a fall from and to what a rigid body rocks in a moment (J).
    pub slight: f64,
}

/// The body when a contact changes.
#[derive(Clone, Copy, Debug)]
struct Instant {
    time: f64,
    speed: f64,
    kinetic: f64,
}

/// A time of unchanged contact.
#[derive(Clone, Copy, Debug)]
struct ContactSpan {
    from: Instant,
    to: Instant,
    pressing: [bool; 2],
}

/// A time in which one foot carries the body alone.
#[derive(Clone, Copy, Debug)]
struct Lean {
    foot: usize,
    from: Instant,
    to: Instant,
}

impl Lean {
    /// Whether the body turned back and fell with more energy than this (J).
    fn falls(&self, energy: f64) -> bool {
        turned(self.from, self.to) && self.to.kinetic > energy
    }
}

fn turned(before: Instant, after: Instant) -> bool {
    before.speed * after.speed < 0.0
}

impl Events {
    /// The landings, and the time with both feet in the air, of a history that ended at `end` (s),
    /// `lost` (J) having been lost.
    pub(crate) fn landings(&self, end: f64, lost: f64) -> (Vec<Landing>, f64) {
        let touch_downs = || self.events.iter().filter(|e| e.change == Change::TouchDown);
        let mut landings: Vec<Landing> = touch_downs()
            .map(|e| Landing {
                time: e.time,
                foot: e.foot,
                kinetic: e.kinetic,
                lost: 0.0,
                bounced: false,
                impact: false,
                airborne: 0.0,
            })
            .collect();
        let lost_at: Vec<f64> = touch_downs().map(|e| e.lost).collect();

        let leans = self.leans(end);
        for (i, lean) in leans.iter().enumerate().filter(|(_, lean)| lean.to.time < end) {
            let next = leans.get(i + 1).map_or(f64::INFINITY, |next| next.from.time);
            let since = lean.from.time.max(lean.to.time - self.moment);
            let first = landings.partition_point(|l| l.time <= since);
            let mut near = landings[first..].iter_mut().take_while(|l| l.time <= next);
            if let Some(landing) = near.find(|l| l.foot != lean.foot) {
                landing.impact = true;
            }
        }

        let impacts: Vec<usize> = (0..landings.len()).filter(|&i| landings[i].impact).collect();
        for (k, &i) in impacts.iter().enumerate() {
            landings[i].lost = impacts.get(k + 1).map_or(lost, |&next| lost_at[next]) - lost_at[i];
        }
        let mut airborne = 0.0;
        for flight in self.spans(end).filter(|span| span.pressing == [false; 2]) {
            let (from, to) = (flight.from.time, flight.to.time);
            airborne += to - from;
            let before = impacts.partition_point(|&i| landings[i].time <= from);
            if let Some(&i) = impacts[..before].last() {
                landings[i].airborne += to - from;
            }
        }
        self.mark_bounces(&mut landings);
        (landings, airborne)
    }

    /// Spans of unchanged contact.
    fn spans(&self, end: f64) -> impl Iterator<Item = ContactSpan> {
        let mut pressing = self.pressing;
        let still = |time: f64| Instant { time, speed: 0.0, kinetic: 0.0 };
        let mut from = still(0.0);
        let at = |e: &ContactEvent| Instant { time: e.time, speed: e.speed, kinetic: e.kinetic };
        let changes = self.events.iter().map(move |e| (at(e), Some(e))).chain([(still(end), None)]);
        changes.map(move |(to, event)| {
            let span = ContactSpan { from, to, pressing };
            from = to;
            if let Some(e) = event {
                pressing[e.foot] = e.change == Change::TouchDown;
            }
            span
        })
    }

    /// The leans in order of time, chatter removed.
    fn leans(&self, end: f64) -> Vec<Lean> {
        let alone = self.spans(end).filter_map(|ContactSpan { from, to, pressing }| {
            (pressing[0] != pressing[1]).then_some(Lean {
                foot: usize::from(pressing[1]),
                from,
                to,
            })
        });
        // interruptions of a lean that the other foot did not take over
        let leans = self.joined(alone);
        // a lean that the record's end cut short may still have become one
        let lasting = leans.into_iter().filter(|l| {
            l.to.time - l.from.time >= self.moment || l.to.time == end || l.falls(self.slight)
        });
        self.joined(lasting)
    }

    /// Leans on the same foot that follow each other within a moment joined, unless the other foot
    /// stopped a fall between them.
    fn joined(&self, leans: impl Iterator<Item = Lean>) -> Vec<Lean> {
        let mut joined: Vec<Lean> = Vec::new();
        for lean in leans {
            let same = |last: &Lean| {
                last.foot == lean.foot
                    && lean.from.time - last.to.time < self.moment
                    && !(last.falls(self.slight) && turned(last.to, lean.from))
            };
            match joined.last_mut().filter(|last| same(last)) {
                Some(last) => last.to = lean.to,
                None => joined.push(lean),
            }
        }
        joined
    }

    /// Mark the touch-downs of the foot leaned on that opened again within a moment.
    fn mark_bounces(&self, landings: &mut [Landing]) {
        let lift_offs = |foot: usize| -> Vec<f64> {
            let of_foot =
                self.events.iter().filter(|e| e.foot == foot && e.change == Change::LiftOff);
            of_foot.map(|e| e.time).collect()
        };
        let lift_offs = [lift_offs(0), lift_offs(1)];
        let opened = |foot: usize, time: f64| {
            let times: &[f64] = &lift_offs[foot];
            times.get(times.partition_point(|&t| t < time)).copied()
        };
        // of each landing, the next impact after it
        let mut next_impact = vec![f64::INFINITY; landings.len()];
        for i in (1..landings.len()).rev() {
            next_impact[i - 1] = if landings[i].impact { landings[i].time } else { next_impact[i] };
        }
        let mut on = None;
        for i in 0..landings.len() {
            if landings[i].impact {
                on = Some(landings[i].foot);
            }
            let Landing { foot, time, .. } = landings[i];
            let Some(opens) = opened(foot, time).filter(|opens| opens - time < self.moment) else {
                continue;
            };
            landings[i].bounced = on == Some(foot) && next_impact[i] > opens;
        }
    }
}

#[cfg(test)]
mod tests;
