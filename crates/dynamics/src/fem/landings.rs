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
//! - a *bounce* is a touch-down of the foot leaned on (or landed on) that opens again within a
//!   moment.

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
    /// Of an impact: energy taken by dashpots and let go by springs from it to the next impact, or
    /// to the end (J).
    pub lost: f64,
    /// Whether this foot, landed or leaned on, opened again within 0.1/p.
    pub bounced: bool,
    /// Whether it ends a lean on the other foot: no re-landing of a bounce, no touch within a lean.
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
    /// Energy lost since the start (J).
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
mod tests {
    use super::*;

    const LEFT: usize = 0;
    const RIGHT: usize = 1;

    /// Events from (time, foot, down), a moment of 0.25 s, both feet pressing at first; 1 J is lost
    /// every second.
    fn read(changes: &[(f64, usize, bool)], end: f64) -> (Vec<Landing>, f64) {
        at_speeds(changes, |_| 0.0).landings(end, end)
    }

    /// The same of a body with this speed at a time.
    fn at_speeds(changes: &[(f64, usize, bool)], speed: impl Fn(f64) -> f64) -> Events {
        let event = |&(time, foot, down): &(f64, usize, bool)| ContactEvent {
            time,
            foot,
            change: if down { Change::TouchDown } else { Change::LiftOff },
            kinetic: 100.0 - time,
            speed: speed(time),
            lost: time,
        };
        let events = changes.iter().map(event).collect();
        Events { events, pressing: [true; 2], moment: 0.25, slight: 50.0 }
    }

    fn impacts_of(events: &Events, end: f64) -> Vec<(f64, usize)> {
        events.landings(end, end).0.iter().filter(|l| l.impact).map(|l| (l.time, l.foot)).collect()
    }

    /// Speed of a body that leans on its left foot to 2.02 s, on the right one to 2.12 s, and then
    /// on the left.
    fn shaken(time: f64) -> f64 {
        if (1.5..2.06).contains(&time) || time > 2.5 { 1.0 } else { -1.0 }
    }

    /// A lean of 0.1 s on the right foot between two long ones on the left.
    const SHAKEN: [(f64, usize, bool); 6] = [
        (1.0, RIGHT, false),
        (2.0, RIGHT, true),
        (2.02, LEFT, false),
        (2.12, LEFT, true),
        (2.13, RIGHT, false),
        (3.0, RIGHT, true),
    ];

    #[test]
    fn a_body_shaken_hard_leans_for_less_than_a_moment() {
        let events = at_speeds(&SHAKEN, shaken);
        assert_eq!(impacts_of(&events, 9.0), [(2.0, RIGHT), (2.12, LEFT), (3.0, RIGHT)]);
        // it has not turned back, or falls slightly: chatter
        assert_eq!(impacts(&SHAKEN, 9.0), [(3.0, RIGHT)]);
        let slight = Events { slight: 99.0, ..events };
        assert_eq!(impacts_of(&slight, 9.0), [(3.0, RIGHT)]);
    }

    #[test]
    fn a_foot_that_stops_a_fall_and_opens_again_has_landed() {
        let changes =
            [(1.0, RIGHT, false), (2.0, RIGHT, true), (2.1, RIGHT, false), (3.0, RIGHT, true)];
        assert_eq!(impacts_of(&at_speeds(&changes, shaken), 9.0), [(2.0, RIGHT), (3.0, RIGHT)]);
        assert_eq!(impacts(&changes, 9.0), [(3.0, RIGHT)]);
    }

    #[test]
    fn the_history_s_end_is_no_impact_of_the_lean_it_cuts_short() {
        let mut changes = ROCKING.to_vec();
        changes.splice(3.., [(2.03, LEFT, true), (2.04, LEFT, false)]);
        assert_eq!(impacts(&changes, 2.1), [(2.0, RIGHT)]);
        assert_eq!(impacts(&changes, 2.5), [(2.0, RIGHT)]);
    }

    fn impacts(changes: &[(f64, usize, bool)], end: f64) -> Vec<(f64, usize)> {
        read(changes, end).0.iter().filter(|l| l.impact).map(|l| (l.time, l.foot)).collect()
    }

    /// Leans on the left foot from 1 s, lands on the right at 2 s, leans on it from 2.01 s, lands
    /// on the left at 3 s.
    const ROCKING: [(f64, usize, bool); 4] =
        [(1.0, RIGHT, false), (2.0, RIGHT, true), (2.01, LEFT, false), (3.0, LEFT, true)];

    #[test]
    fn every_lean_ends_in_an_impact_even_the_last_before_rest() {
        assert_eq!(impacts(&ROCKING, 9.0), [(2.0, RIGHT), (3.0, LEFT)]);
        let (landings, airborne) = read(&ROCKING, 9.0);
        assert_eq!(landings.iter().map(|l| l.lost).collect::<Vec<_>>(), [1.0, 6.0]);
        assert_eq!(landings[0].kinetic, 98.0);
        assert!(landings.iter().all(|l| !l.bounced));
        assert_eq!(airborne, 0.0);
    }

    #[test]
    fn a_foot_that_chatters_a_hundred_thousand_times_is_read_in_a_moment() {
        let mut changes = ROCKING.to_vec();
        let chatter = (0..100_000).flat_map(|i| {
            let time = 2.02 + 1e-6 * f64::from(i);
            [(time, RIGHT, false), (time + 5e-7, RIGHT, true)]
        });
        changes.splice(3..3, chatter);
        assert_eq!(impacts(&changes, 9.0), [(2.0, RIGHT), (3.0, LEFT)]);
        assert_eq!(read(&changes, 9.0).0.iter().filter(|l| l.bounced).count(), 100_000);
    }

    #[test]
    fn a_bouncing_foot_lands_once() {
        let mut changes = ROCKING.to_vec();
        changes.splice(
            3..3,
            [(2.02, RIGHT, false), (2.05, RIGHT, true), (2.06, RIGHT, false), (2.07, RIGHT, true)],
        );
        assert_eq!(impacts(&changes, 9.0), [(2.0, RIGHT), (3.0, LEFT)]);
        let (landings, airborne) = read(&changes, 9.0);
        assert_eq!(
            landings.iter().map(|l| l.bounced).collect::<Vec<_>>(),
            [true, true, false, false]
        );
        assert!((airborne - 0.04).abs() < 1e-15 && (landings[0].airborne - 0.04).abs() < 1e-15);
    }

    #[test]
    fn a_foot_that_bounces_before_the_other_lifts_landed_at_its_first_touch() {
        let mut changes = ROCKING.to_vec();
        changes.splice(2..2, [(2.002, RIGHT, false), (2.006, RIGHT, true)]);
        assert_eq!(impacts(&changes, 9.0), [(2.0, RIGHT), (3.0, LEFT)]);
        assert!(read(&changes, 9.0).0[0].bounced);
    }

    #[test]
    fn the_old_foot_touching_again_is_no_impact_and_no_bounce() {
        let mut changes = ROCKING.to_vec();
        changes.splice(3..3, [(2.03, LEFT, true), (2.05, LEFT, false)]);
        assert_eq!(impacts(&changes, 9.0), [(2.0, RIGHT), (3.0, LEFT)]);
        assert!(read(&changes, 9.0).0.iter().all(|l| !l.bounced));
    }

    #[test]
    fn a_body_that_turns_back_within_its_lean_has_no_impact() {
        let mut changes = ROCKING.to_vec();
        changes.splice(1..1, [(1.4, RIGHT, true), (1.43, RIGHT, false)]);
        assert_eq!(impacts(&changes, 9.0), [(2.0, RIGHT), (3.0, LEFT)]);
        assert!(!read(&changes, 9.0).0[0].bounced);
    }

    #[test]
    fn a_rest_between_two_leans_on_one_foot_is_an_impact() {
        let changes =
            [(1.0, RIGHT, false), (2.0, RIGHT, true), (4.0, RIGHT, false), (5.0, RIGHT, true)];
        assert_eq!(impacts(&changes, 9.0), [(2.0, RIGHT), (5.0, RIGHT)]);
    }

    #[test]
    fn a_landing_out_of_the_air_is_an_impact() {
        let changes =
            [(1.0, RIGHT, false), (1.98, LEFT, false), (2.0, RIGHT, true), (3.0, LEFT, true)];
        assert_eq!(impacts(&changes, 9.0), [(2.0, RIGHT), (3.0, LEFT)]);
        let (landings, airborne) = read(&changes, 9.0);
        assert!((airborne - 0.02).abs() < 1e-15);
        assert!(
            landings.iter().all(|l| l.airborne == 0.0),
            "the flight comes before the first impact"
        );
    }

    #[test]
    fn a_flutter_of_the_standing_body_is_no_impact() {
        let changes =
            [(1.0, RIGHT, false), (1.02, RIGHT, true), (1.5, LEFT, false), (1.53, LEFT, true)];
        assert_eq!(impacts(&changes, 9.0), []);
    }
}
