//! Contact events: found on the collocation polynomial, located by repeating the step, then the foot switches.

use super::Run;
use crate::{
    fem::{
        model::{Contact, Foot, Pose, TH},
        observer::{Change, Observer},
        radau::C,
        step::{Ground, Stages, no_guess},
    },
    scalar::{Scalar, real},
};

/// A foot that closes again this soon after it opened, in units of 1/Omega_n, has hardly left the ground.
const AT_ONCE: f64 = 0.1;

/// Share of what the other foot carries: a lifting foot that lets go of a smaller horizontal force, once it closes again at
/// once, does not hold.
///
/// A foot lifts while its horizontal spring is still loaded. It lets that force go; a body without rotational inertia
/// turns at once and presses the foot down again, where it holds and takes part of the force back (about a half); soon it
/// lifts again, and so on, each time with less to let go, at an accumulating sequence of instants. OpenSees goes through
/// the same sequence as finely as its steps are, and converges to it as they get finer. Once little is let go the foot
/// slides without a horizontal force until it lifts for good or carries weight.
///
/// Little is measured by the force that the body leans on, so that a landing of twice the speed goes through twice the
/// same motion. What is left out is an impulse below a thousandth of the other foot's, over a time that is itself a small
/// part of the landing: 20 s of El Centro change by 4e-9 (frames up to alpha 0.13) and 1e-4 (0.2, springs that bounce) from a
/// share of 1e-4 of the weight, by 1e-6 and 2e-2 with one of 1e-2.
const LET_GO: f64 = 1e-3;

/// What such a sliding foot must carry before it holds, over that share.
const HOLDING: f64 = 0.1;

/// Steps that locate one event: Newton's method needs two or three, bisection where the gap all but grazes many more.
const MOST_LOCATED: usize = 40;

/// Halvings of a step in the search for a place where a foot is clear of the edge.
const MOST_HALVED: i32 = 30;

/// Touches and lift-offs of one jump of a massless rotation before it counts as having lost its balance.
const MOST_TURNS: usize = 50;

/// Radians within 1/Omega_n: a massless rotation that is let go faster than that was about to snap, and keeps no rate that
/// means anything.
const WHIRL: f64 = 100.0;

/// First step tried after an event, in units of 1/Omega_n: the transient that the event began decides the step, not the
/// step that the event cut short.
pub(super) const RESTART: f64 = 0.1;

/// Where a step's values are known: its start and its stages.
const NODES: [f64; 4] = [0.0, C[0], C[1], C[2]];

/// By how much a cubic through values at the nodes can pass beyond the least of them, over their spread: half of what its
/// largest sum of |Lagrange polynomials| exceeds one by.
const OVERSHOOT: f64 = 0.4454;

/// The cubic through values at the nodes, by ascending powers.
fn cubic(values: &[f64; 4]) -> [f64; 4] {
    // divided differences
    let mut d = *values;
    for order in 1..4 {
        for k in (order..4).rev() {
            d[k] = (d[k] - d[k - 1]) / (NODES[k] - NODES[k - order]);
        }
    }
    // Newton's form, multiplied out
    let mut p = [d[3], 0.0, 0.0, 0.0];
    for k in (0..3).rev() {
        for i in (1..4).rev() {
            p[i] = p[i - 1] - NODES[k] * p[i];
        }
        p[0] = d[k] - NODES[k] * p[0];
    }
    p
}

/// What a candidate step met.
pub(super) enum Met {
    Nothing,
    /// The compression of this foot's gap passes `level` [m].
    Crossing {
        foot: usize,
        level: f64,
        tau: f64,
    },
    /// This foot begins to slip, or to hold.
    Grip {
        foot: usize,
        tau: f64,
    },
    /// What it met is not told: the step is too long.
    Unresolved,
}

impl<S: Scalar> Run<'_, S> {
    /// Contact force scale below which a gap counts as zero [m].
    fn gap_tolerance(&self) -> f64 {
        (1e-9 * self.compression).max(4e-16 * self.model.body.radius().re())
    }

    /// Whether this foot, touching the ground, trails on it rather than holds (`strut`).
    fn trails(&self, foot: usize) -> bool {
        let strut = self.model.strut(foot, &self.state);
        self.model.is_strut() && !self.feet[1 - foot].closed() && strut.press <= 0.0
    }

    fn on_legs(&self) -> bool {
        self.model.frame.is_some_and(|frame| frame.leg.is_some())
    }

    /// Compression of k1 from which this foot, sliding, holds [m].
    fn holding(&self, foot: usize) -> f64 {
        HOLDING * LET_GO * self.leant_on[foot] / self.model.springs.vertical.k1.re()
    }

    /// Whether a foot's contact changes within the step, and where first.
    pub(super) fn met(&self, stages: &Stages<S>) -> Met {
        let mut first = Met::Nothing;
        let mut earliest = f64::INFINITY;
        let nodes = [&self.state.q, &stages.q[0], &stages.q[1], &stages.q[2]];
        let poses = [Pose::of(nodes[0]), Pose::of(nodes[1]), Pose::of(nodes[2]), Pose::of(nodes[3])];
        for foot in 0..2 {
            // the contact lasts while sign (compression - level) is positive
            let limits: &[(f64, f64)] = match self.feet[foot].contact {
                Contact::Open => &[(-1.0, 0.0)],
                Contact::Stick | Contact::Slip(_) => &[(1.0, 0.0)],
                // see `grip`
                Contact::Trail => &[],
                Contact::Slide => &[(1.0, 0.0), (-1.0, self.holding(foot))],
            };
            let at = |k: usize| self.model.compression_at(&poses[k], foot, nodes[k], &self.feet[foot]).re();
            let values: [f64; 4] = [at(0), at(1), at(2), at(3)];
            for &(sign, level) in limits {
                let inside = values.map(|d| sign * (d - level));
                let past = (1..4).find(|&k| inside[k] < -self.gap_tolerance());
                let high = past.map(|k| (NODES[k], inside[k]));
                // a node past the level may come after a passage that is over before the node ahead of it
                let between = self.dip(foot, sign, level, stages, &inside, past.map_or(1.0, |k| NODES[k - 1]));
                let Some(high) = between.or(high) else { continue };
                let k = NODES.iter().rposition(|&node| node < high.0).unwrap_or(0);
                let low = (NODES[k], inside[k].max(0.0));
                let Some(tau) = self.first_zero(foot, sign, level, stages, low, high) else { return Met::Unresolved };
                if tau < earliest {
                    earliest = tau;
                    first = Met::Crossing { foot, level, tau };
                }
            }
        }
        match self.loses_grip(stages) {
            Some((foot, tau)) if tau < earliest => Met::Grip { foot, tau },
            _ => first,
        }
    }

    /// A passage over before the next node of the step: the point between two nodes, no later than `until`, at which the
    /// compression is least inside its limit, if that is past it. Found on the cubic through the nodes' values.
    fn dip(
        &self,
        foot: usize,
        sign: f64,
        level: f64,
        stages: &Stages<S>,
        inside: &[f64; 4],
        until: f64,
    ) -> Option<(f64, f64)> {
        let (low, high) = inside.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), &x| (l.min(x), h.max(x)));
        if low > OVERSHOOT * (high - low) {
            return None;
        }
        let [_, first, second, third] = cubic(inside);
        let root = (second * second - 3.0 * first * third).sqrt();
        // the slope first + 2 second tau + 3 third tau^2 grows through zero there
        let tau = if second >= 0.0 { -first / (second + root) } else { (root - second) / (3.0 * third) };
        if !(tau > 0.0 && tau < until) {
            return None;
        }
        let q = stages.position(&self.state, tau);
        let value = (self.model.compression(foot, &q, &self.feet[foot]).re() - level) * sign;
        (value < -self.gap_tolerance()).then_some((tau, value))
    }

    /// Where the compression passes `level` on the collocation polynomial, between two bracketing points (Illinois). `None` if
    /// the polynomial leaves at once where the foot itself moves in: it need not begin with the state's velocity, and does not
    /// in a step too long for the springs.
    fn first_zero(
        &self,
        foot: usize,
        sign: f64,
        level: f64,
        stages: &Stages<S>,
        mut low: (f64, f64),
        mut high: (f64, f64),
    ) -> Option<f64> {
        let value = |tau: f64| {
            let q = stages.position(&self.state, tau);
            (self.model.compression(foot, &q, &self.feet[foot]).re() - level) * sign
        };
        // a foot at the edge that moves off it first must come back before it crosses
        let edge = 0.1 * self.gap_tolerance();
        if low.1 <= edge {
            let inner =
                (1..MOST_HALVED).map(|k| low.0 + (high.0 - low.0) * 0.5_f64.powi(k)).find(|&tau| value(tau) > edge);
            match inner {
                Some(tau) => low = (tau, value(tau)),
                None if low.0 == 0.0 && self.moves_in(foot, sign) * stages.h.re() > self.gap_tolerance() => {
                    return None;
                }
                None => {}
            }
        }
        let mut side = 0;
        for _ in 0..60 {
            let tau = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            if !(tau > low.0 && tau < high.0) || high.0 - low.0 < 1e-12 {
                break;
            }
            let d = value(tau);
            if d.abs() < edge {
                return Some(tau);
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
        Some(low.0.max(1e-9))
    }

    /// Speed at which a foot moves off the edge of its limit, into it [m/s].
    fn moves_in(&self, foot: usize, sign: f64) -> f64 {
        sign * self.model.compression_rate(foot, &self.state, &self.feet[foot]).re()
    }

    /// Repeat the step so that it ends where the foot's compression passes `level`. Whether it passes there: if the polynomial
    /// saw a graze that the step itself does not make, it does not. `None` if no step converges, or none ends there.
    pub(super) fn locate(
        &mut self,
        foot: usize,
        level: f64,
        stages: &mut Stages<S>,
        tau: f64,
        ground: &Ground<S>,
    ) -> Option<bool> {
        // the contact lasts while sign (compression - level) is positive
        let sign = if self.feet[foot].closed() && level == 0.0 { 1.0 } else { -1.0 };
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut h = stages.h * tau;
        for _ in 0..MOST_LOCATED {
            self.work.located += 1;
            if !self.attempt(h, ground, stages) {
                return None;
            }
            let end = stages.end();
            let gap = self.model.compression(foot, &end.q, &self.feet[foot]) - level;
            let met = gap.re().abs() <= self.gap_tolerance();
            if met && self.control.extra_iterations == 0 {
                return Some(true);
            }
            let correction = gap / self.model.compression_rate(foot, &end, &self.feet[foot]);
            let usable = correction.re().abs() <= 0.5 * h.re();
            if met {
                // derivatives of the event's time, by the implicit function theorem
                return if usable && !self.attempt(h - correction, ground, stages) { None } else { Some(true) };
            }
            // steps too small for the clock
            if h.re() <= 1e-9 * self.settling {
                return Some(true);
            }
            if sign * gap.re() > 0.0 {
                low = h.re();
            } else {
                high = h.re();
            }
            let next = h - correction;
            h = if usable && next.re() > low && next.re() < high {
                next
            } else if high.is_finite() {
                real(0.5 * (low + high))
            } else {
                return Some(false);
            };
        }
        None
    }

    /// A foot on an elastic leg springs sideways, and maybe down, when its horizontal force is let go: it opens only if it
    /// would not press without that force. If it would, it holds where the leg, relaxed, has carried it; and if that took more
    /// than the `stored` energy [J], it slides, which never does: leg and contact are then free to stay as they were.
    fn catch(&mut self, foot: usize, relaxed: S, stored: S) {
        if !self.on_legs() || self.feet[foot].closed() || !self.feet[1 - foot].holds() {
            return;
        }
        let open = (self.state, self.feet[foot]);
        let holds = self.let_go[foot] > LET_GO;
        for contact in if holds { [Contact::Stick, Contact::Slide] } else { [Contact::Slide; 2] } {
            (self.state, self.feet[foot]) = (open.0, Foot { contact, anchor: relaxed });
            self.balanced = self.model.turn_to_balance(&mut self.state, &self.feet);
            if self.model.energy(&self.state, &self.feet).re() <= stored.re() {
                break;
            }
        }
        if self.model.compression(foot, &self.state.q, &self.feet[foot]).re() <= self.gap_tolerance() {
            (self.state, self.feet[foot]) = open;
        }
    }

    /// Change a foot's contact.
    pub(super) fn switch(&mut self, foot: usize, level: f64, time: S, observer: &mut impl Observer<S>) {
        let before = self.energy.stored;
        let was = self.feet[foot].contact;
        self.model.rotate_in_balance(&mut self.state, &self.feet);
        let anchor = self.model.anchor_here(foot, &self.state.q, &self.feet[foot]);
        self.feet[foot] = match was {
            Contact::Open => {
                let at_once = time.re() - self.opened[foot] < AT_ONCE * self.settling;
                let held = self.let_go[foot] > LET_GO
                    || self.model.compression(foot, &self.state.q, &self.feet[foot]).re() >= self.holding(foot);
                // a body on sliding feet alone has nothing to lean on
                let leans = self.feet[1 - foot].holds();
                // with friction the force has gone before the foot opens, and nothing jumps
                let jumps = self.model.friction.is_none();
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
                self.opened[foot] = time.re();
                let forces = self.model.contact(&self.state.q, &self.feet);
                self.leant_on[foot] = forces[1 - foot].vertical.re().max(0.0);
                self.let_go[foot] = forces[foot].horizontal.re().abs() / self.leant_on[foot];
                Foot { contact: Contact::Open, anchor }
            }
        };
        let other = 1 - foot;
        let trails = self.feet[other].contact == Contact::Trail;
        if trails || self.feet[other].contact == Contact::Slide && !self.feet[foot].holds() {
            let anchor = self.model.anchor_here(other, &self.state.q, &self.feet[other]);
            self.feet[other] = Foot { contact: Contact::Stick, anchor };
        }
        // a leg that lets its force go carries the foot to where it would be without
        let relaxed = self.model.anchor_here(foot, &self.state.q, &self.feet[foot]);
        let met = self.turn();
        if was == Contact::Stick {
            self.catch(foot, relaxed, before);
        }
        self.model.rotate_in_balance(&mut self.state, &self.feet);
        self.energy.stored = self.model.energy(&self.state, &self.feet);
        self.energy.released += before - self.energy.stored;
        self.guess = no_guess();
        self.rate = 1.0;
        self.h = self.h.min(RESTART * self.settling);
        self.work.events += 1;
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

    /// Turn a massless rotation to its balance, but no further than to where a foot touches or leaves the ground: that foot.
    fn turn(&mut self) -> Option<usize> {
        let start = self.state.q[TH];
        self.turns += 1;
        let whirls = self.state.v[TH].re().abs() * self.settling > WHIRL;
        let flies = !self.feet[0].closed() && !self.feet[1].closed();
        self.balanced = self.turns < MOST_TURNS
            && !(whirls && flies && self.model.massless())
            && self.model.turn_to_balance(&mut self.state, &self.feet);
        let end = self.state.q[TH];
        // feet on elastic legs, and feet that may slip, are met by the steps that follow
        let simple = self.model.frame.is_none() && self.model.friction.is_none();
        if !self.balanced || end.re() == start.re() || !simple {
            return None;
        }
        let passed = |foot: usize| {
            let sign = if self.feet[foot].closed() { 1.0 } else { -1.0 };
            let inside = |theta: S| {
                let mut q = self.state.q;
                q[TH] = theta;
                sign * self.model.compression(foot, &q, &self.feet[foot]).re()
            };
            if inside(end) >= -self.gap_tolerance() {
                return None;
            }
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if inside(start + (end - start) * middle) >= 0.0 {
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
        self.state.q[TH] = self.model.where_it_touches(foot, &self.state.q, start + (end - start) * share);
        Some(foot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        fem::{
            control::Control,
            model::{Model, State, Z, az},
        },
        spring::{Chain, Springs},
        structure::Structure,
    };

    /// An absorber comes up under a foot in the air and is gone again before the next stage: f = -(tau - 0.2)(tau - 0.6) is
    /// negative at all nodes.
    #[test]
    fn a_touch_between_two_stages_is_found() {
        let body = Structure::paper().body::<f64>();
        let chain = Chain { k1: 1e9, k2: 1e8, m2: 1e5, c: 1e6 };
        let model = Model::new(&body, &Springs { vertical: chain, horizontal: chain });
        let rise = |tau: f64| -0.01 * (tau - 0.2) * (tau - 0.6);
        let slope = |tau: f64| -0.01 * (2.0 * tau - 0.8);
        let mut state = State { q: [0.0; 7], v: [0.0; 7] };
        // the right foot far above the ground
        (state.q[az(0)], state.q[az(1)]) = (rise(0.0), -1.0);
        let feet = [Foot { contact: Contact::Open, anchor: 0.0 }; 2];
        let run = Run::new(&model, (state, feet), Control::default());
        let mut stages = Stages::none();
        stages.h = 1e-3;
        for i in 0..3 {
            stages.q[i] = state.q;
            stages.q[i][az(0)] = rise(C[i]);
            stages.v[i][az(0)] = slope(C[i]) / stages.h;
        }
        match run.met(&stages) {
            Met::Crossing { foot: 0, level, tau } => assert!(level == 0.0 && (tau - 0.2).abs() < 1e-6, "{tau}"),
            _ => unreachable!("the touch is missed"),
        }
        // a hair lower it does not touch
        for q in &mut stages.q {
            q[Z] += 0.01 * 0.04 * 1.001;
        }
        let mut state = state;
        state.q[Z] = stages.q[0][Z];
        let run = Run::new(&model, (state, feet), Control::default());
        assert!(matches!(run.met(&stages), Met::Nothing));
    }

    #[test]
    fn the_cubic_passes_through_its_values_and_no_further_beyond_them() {
        for values in [[1.0, -0.3, 0.4, 2.0], [0.0, 0.0, 0.0, 1.0], [0.3, -2.0, 5.0, 0.1]] {
            let p = cubic(&values);
            let at = |t: f64| p.iter().rev().fold(0.0, |sum, c| sum * t + c);
            for (node, value) in NODES.into_iter().zip(values) {
                assert!((at(node) - value).abs() < 1e-14 * 10.0, "{} {value}", at(node));
            }
        }
        // the worst values are the extremes 0 and 1, where each Lagrange polynomial has the sign that adds
        let mut beyond: f64 = 0.0;
        for bits in 0..16 {
            let values = [0, 1, 2, 3].map(|k| f64::from((bits >> k) & 1));
            let p = cubic(&values);
            for i in 0..=10_000 {
                let t = f64::from(i) * 1e-4;
                beyond = beyond.max(-p.iter().rev().fold(0.0, |sum, c| sum * t + c));
            }
        }
        assert!(beyond <= OVERSHOOT && beyond > 0.9 * OVERSHOOT, "{beyond}");
    }
}
