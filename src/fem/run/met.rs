//! Contact events that a candidate step meets, found on its collocation polynomial.

use super::Run;
use crate::{
    fem::{
        model::{Contact, Pose},
        radau::C,
        step::Stages,
    },
    scalar::Scalar,
};

/// Halvings of a step in the search for a place where a foot is clear of the edge.
const MOST_HALVED: i32 = 30;

/// Where a step's values are known: its start and its stages.
const NODES: [f64; 4] = [0.0, C[0], C[1], C[2]];

/// By how much a cubic through values at the nodes can pass beyond the least of them, over their spread: half of what its
/// largest sum of |Lagrange polynomials| exceeds one by.
pub(crate) const OVERSHOOT: f64 = 0.4454;

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

impl Met {
    /// This, or `other` where this is nothing.
    pub(super) fn or(self, other: Self) -> Self {
        if matches!(self, Self::Nothing) { other } else { self }
    }
}

impl<S: Scalar> Run<'_, S> {
    /// Whether a foot's contact changes within the step, and where first.
    pub(super) fn met(&self, stages: &Stages<S>) -> Met {
        match (self.crosses(stages), self.loses_grip(stages)) {
            (Met::Unresolved, _) => Met::Unresolved,
            (Met::Crossing { tau: crossing, .. }, Some((foot, tau))) if tau < crossing => Met::Grip { foot, tau },
            (Met::Nothing, Some((foot, tau))) => Met::Grip { foot, tau },
            (crossing, _) => crossing,
        }
    }

    /// Whether a foot touches or leaves the ground, or begins to hold as it presses, and where first.
    pub(super) fn crosses(&self, stages: &Stages<S>) -> Met {
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
        first
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        fem::{
            control::Control,
            model::{Foot, Model, State, Z, az},
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
        for (i, tau) in C.into_iter().enumerate() {
            stages.q[i] = state.q;
            stages.q[i][az(0)] = rise(tau);
            stages.v[i][az(0)] = slope(tau) / stages.h;
        }
        match run.met(&stages) {
            Met::Crossing { foot: 0, level, tau } => assert!(level == 0.0 && (tau - 0.2).abs() < 1e-6, "{tau}"),
            _ => unreachable!("the touch is missed"),
        }
        // a hair lower it does not touch
        for q in &mut stages.q {
            q[Z] += 0.01 * 0.04 * 1.001;
        }
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
