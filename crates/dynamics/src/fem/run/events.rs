//! Contact events: located by repeating the step, then the foot switches (where they are met:
//! `met`).

use super::{TimeLoop, met::StepEvent};
use crate::fem::{
    cubic::falls_through_zero,
    model::{Contact, Foot, TH},
    observer::{Change, Observer},
    step::{NO_GUESS, Stages},
};

/// A foot that closes again this soon after it opened, in units of 1/Omega_n, has hardly left the
/// ground: its horizontal spring threw it up. It would do so again and again, at an accumulating
/// sequence of instants; it slides instead, until it stops.
pub const AT_ONCE: f64 = 0.1;

/// Share of what the other foot carries: a lifting foot that lets go of a smaller horizontal force,
/// once it closes again at once, does not hold.
///
/// A foot lifts while its horizontal spring is still loaded. It lets that force go; a body without
/// rotational inertia turns at once and presses the foot down again, where it holds and takes part
/// of the force back (about a half); soon it lifts again, and so on, each time with less to let go,
/// at an accumulating sequence of instants. OpenSees goes through the same sequence as finely as
/// its steps are, and converges to it as they get finer. Once little is let go the foot slides
/// without a horizontal force until it lifts for good or carries weight.
///
/// Little is measured by the force that the body leans on, so that a landing of twice the speed
/// goes through twice the same motion. What is left out is an impulse below a thousandth of the
/// other foot's, over a time that is itself a small part of the landing: 20 s of El Centro change
/// by 4e-9 (frames up to alpha 0.13) and 1e-4 (0.2, springs that bounce) from a share of 1e-4 of
/// the weight, by 1e-6 and 2e-2 with one of 1e-2.
const LEAST_RELEASED_SHEAR: f64 = 1e-3;

/// What such a sliding foot must carry before it holds, over that share.
const HOLDING: f64 = 0.1;

/// By how much a foot that dampers pull lifts later: they change within a step.
const LATER: f64 = 1.1;

/// Steps that locate one event: Newton's method needs two or three, bisection where the gap all but
/// grazes many more.
pub const MOST_LOCATED: usize = 40;

/// Touches and lift-offs of one jump of a massless rotation before it counts as having lost its
/// balance.
const MOST_TURNS: usize = 50;

/// Share of such a jump to which the place where a foot touches is found by halving, where it stood
/// at the edge.
const HALVED: f64 = 1e-8;

/// Radians within 1/Omega_n: a massless rotation that is let go faster than that was about to snap,
/// and keeps no rate that means anything.
const FASTEST_TURN: f64 = 100.0;

/// First step tried after an event, in units of 1/Omega_n: the transient that the event began
/// decides the step, not the step that the event cut short.
pub const RESTART: f64 = 0.1;

/// The event that a step is repeated for, so that it ends where a foot's compression passes a
/// level.
#[derive(Clone, Copy, Debug)]
pub(super) struct Locating {
    foot: usize,
    /// (m)
    level: f64,
    /// The size of the step that met it (s), and where in it.
    pub whole: f64,
    pub tau: f64,
    /// The size that is tried, and the sizes known to be too small and too large (s).
    pub h: f64,
    low: f64,
    high: f64,
    /// Sizes tried.
    trials: usize,
}

impl Locating {
    pub(crate) fn new(foot: usize, level: f64, (whole, tau): (f64, f64)) -> Self {
        let (low, high) = (0.0, f64::INFINITY);
        Self { foot, level, whole, tau, h: whole * tau, low, high, trials: 0 }
    }

    pub(crate) fn met(&self) -> StepEvent {
        StepEvent::Crossing { foot: self.foot, level: self.level, tau: self.tau }
    }
}

/// What came of a repeated step.
pub(super) enum Located {
    /// It is to be repeated with this size (s).
    Next(f64),
    /// It is taken; whether the foot passes the level there: if the polynomial saw a graze that the
    /// step itself does not make, it does not.
    Here { changes: bool },
    /// No step converges, or none ends there.
    Nowhere,
}

impl TimeLoop<'_> {
    /// Compression below which a gap counts as zero (m): a share of the weight's that is far below
    /// what a step may miss.
    pub(crate) fn gap_tolerance(&self) -> f64 {
        let share = (0.01 * self.control.tolerance).clamp(1e-9, 1e-6);
        (share * self.compression).max(4e-16 * self.model.body.radius())
    }

    /// Whether this foot, touching the ground, trails on it rather than holds (`strut`).
    fn trails(&self, foot: usize) -> bool {
        let strut = self.model.strut(foot, &self.state);
        self.model.is_strut() && !self.feet[1 - foot].closed() && strut.press <= 0.0
    }

    /// Compression of k1 from which this foot, sliding, holds (m).
    pub(super) fn holding(&self, foot: usize) -> f64 {
        HOLDING * LEAST_RELEASED_SHEAR * self.leant_on[foot] / self.model.springs.vertical.k1
    }

    /// Compression of k1 at which this foot lifts (m), zero or less.
    pub(super) fn letting_go(&self, foot: usize) -> f64 {
        if self.feet[1 - foot].closed() {
            return 0.0;
        }
        LATER * self.model.lets_go_at(foot, &self.state) / self.model.springs.vertical.k1
    }

    /// Take note of the repeated step of an event that is sought, and say how to go on.
    pub(super) fn locate(
        &mut self,
        event: &mut Locating,
        converged: bool,
        stages: &Stages,
    ) -> Located {
        self.work.located += 1;
        event.trials += 1;
        if !converged {
            return Located::Nowhere;
        }
        let (foot, h, end) = (event.foot, event.h, stages.end());
        // the contact lasts while sign (compression - level) is positive
        let sign = if self.feet[foot].closed() && event.level <= 0.0 { 1.0 } else { -1.0 };
        let gap = self.model.compression(foot, &end.q) - event.level;
        if gap.abs() <= self.gap_tolerance() {
            return Located::Here { changes: true };
        }
        let correction = gap / self.model.compression_rate(foot, &end);
        let usable = correction.abs() <= 0.5 * h;
        // steps too small for the clock
        if h <= 1e-9 * self.settling {
            return Located::Here { changes: true };
        }
        if sign * gap > 0.0 {
            event.low = h;
        } else {
            event.high = h;
        }
        // what comes after the step is none of its events
        let next = (h - correction).min(event.whole);
        event.h = if usable && next > event.low && next < event.high {
            next
        } else if event.high.is_finite() {
            0.5 * (event.low + event.high)
        } else {
            return Located::Here { changes: false };
        };
        if event.trials == MOST_LOCATED { Located::Nowhere } else { Located::Next(event.h) }
    }

    /// Begin anew after a change of contact, before which this energy was stored (J).
    pub(super) fn restart(&mut self, before: f64) {
        self.energy.stored = self.model.energy(&self.state, &self.feet);
        self.energy.released += before - self.energy.stored;
        self.guess = NO_GUESS;
        self.rate = 1.0;
        self.h = self.h.min(RESTART * self.settling);
        self.work.events += 1;
    }

    /// Change a foot's contact.
    pub(super) fn switch(
        &mut self,
        foot: usize,
        level: f64,
        time: f64,
        observer: &mut dyn Observer,
    ) {
        let before = self.energy.stored;
        let was = self.feet[foot].contact;
        self.model.rotate_in_balance(&mut self.state, &self.feet);
        let anchor = self.model.anchor_here(foot, &self.state.q);
        self.feet[foot] = match was {
            Contact::Open => {
                let at_once = time - self.opened[foot] < AT_ONCE * self.settling;
                let held = self.released_shear[foot] > LEAST_RELEASED_SHEAR
                    || self.model.compression(foot, &self.state.q) >= self.holding(foot);
                // a body on sliding feet alone has nothing to lean on
                let leans = self.feet[1 - foot].holds();
                // with friction the force has gone before the foot opens, and nothing jumps
                let jumps = !self.model.law.slips();
                let contact = if at_once && !held && leans && jumps {
                    Contact::Slide
                } else if self.trails(foot) {
                    Contact::Trail
                } else {
                    Contact::Stick
                };
                Foot { contact, anchor }
            }
            Contact::Trail if self.model.strut(foot, &self.state).press > 0.0 => {
                Foot { contact: Contact::Stick, anchor }
            }
            Contact::Trail => Foot { contact: Contact::Open, anchor },
            Contact::Slide if level > 0.0 => Foot { contact: Contact::Stick, anchor },
            Contact::Slide | Contact::Stick | Contact::Slip(_) => {
                self.opened[foot] = time;
                let forces = self.model.contact(&self.state.q, &self.feet);
                self.leant_on[foot] = forces[1 - foot].vertical.max(0.0);
                self.released_shear[foot] = forces[foot].horizontal.abs() / self.leant_on[foot];
                Foot { contact: Contact::Open, anchor }
            }
        };
        let other = 1 - foot;
        let trails = self.feet[other].contact == Contact::Trail;
        if trails || self.feet[other].contact == Contact::Slide && !self.feet[foot].holds() {
            let anchor = self.model.anchor_here(other, &self.state.q);
            self.feet[other] = Foot { contact: Contact::Stick, anchor };
        }
        let met = self.turn();
        self.model.rotate_in_balance(&mut self.state, &self.feet);
        self.restart(before);
        if trails {
            observer.event(other, Change::TouchDown, &self.view(time));
        }
        // a trailing foot counts as one in the air
        let pressed = !matches!(was, Contact::Open | Contact::Trail);
        match (pressed, self.feet[foot].presses()) {
            (false, true) => observer.event(foot, Change::TouchDown, &self.view(time)),
            (true, false) => observer.event(foot, Change::LiftOff, &self.view(time)),
            _ => {}
        }
        if let Some(foot) = met {
            self.switch(foot, 0.0, time, observer);
        }
    }

    /// Turn a massless rotation to its balance, but no further than to where a foot touches or
    /// leaves the ground: that foot.
    fn turn(&mut self) -> Option<usize> {
        let start = self.state.q[TH];
        self.turns += 1;
        let whirls = self.state.v[TH].abs() * self.settling > FASTEST_TURN;
        let flies = !self.feet[0].closed() && !self.feet[1].closed();
        self.balanced = self.turns < MOST_TURNS
            && !(whirls && flies && self.model.massless())
            && self.model.turn_to_balance(&mut self.state, &self.feet);
        let end = self.state.q[TH];
        // feet that may slip are met by the steps that follow
        if !self.balanced || end == start || !self.model.jumps() {
            return None;
        }
        let passed = |foot: usize| {
            let sign = if self.feet[foot].closed() { 1.0 } else { -1.0 };
            let inside = |theta: f64| {
                let mut q = self.state.q;
                q[TH] = theta;
                sign * self.model.compression(foot, &q)
            };
            if inside(end) >= -self.gap_tolerance() {
                return None;
            }
            let within = |share: f64| inside(start + (end - start) * share);
            let edge = 0.1 * self.gap_tolerance();
            let first = within(0.0);
            if first > edge {
                return Some((
                    falls_through_zero((0.0, first), (1.0, within(1.0)), edge, within),
                    foot,
                ));
            }
            // at the edge, and off it at once: half a turn away it does not come back
            let mut q = self.state.q;
            q[TH] = start;
            let (_, slope) = self.model.compression_and_slope(foot, &q);
            if sign * slope * (end - start) < 0.0 {
                return Some((0.0, foot));
            }
            let (mut low, mut high) = (0.0, 1.0);
            // near enough for Newton's method (`where_it_touches`)
            while high - low > HALVED {
                let middle = 0.5 * (low + high);
                if within(middle) >= 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            Some((low, foot))
        };
        let (share, foot) = match (passed(0), passed(1)) {
            (Some(a), Some(b)) => {
                if a.0 <= b.0 {
                    a
                } else {
                    b
                }
            }
            (a, b) => a.or(b)?,
        };
        self.state.q[TH] =
            self.model.where_it_touches(foot, &self.state.q, start + (end - start) * share);
        Some(foot)
    }
}
