//! Contact events that a candidate step meets, found on the cubic through each gap's values.

use super::{TimeLoop, account::Contacts};
use crate::fem::{
    cubic::{Cubic, NODES, falls_through_zero},
    model::{Contact, Pose},
    step::Stages,
};

/// What a candidate step met.
pub(super) enum StepEvent {
    Nothing,
    /// The compression of this foot's gap passes `level` (m).
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

impl StepEvent {
    /// This, or `other` where this is nothing.
    pub(super) fn or(self, other: Self) -> Self {
        if matches!(self, Self::Nothing) { other } else { self }
    }
}

impl TimeLoop<'_> {
    /// Whether a foot's contact changes within the step, and where first; `contacts` is what is
    /// known of it.
    pub(super) fn met(&self, stages: &Stages, contacts: &Contacts) -> StepEvent {
        if matches!(contacts, Contacts::Unchanged) {
            return StepEvent::Nothing;
        }
        match (self.crosses(stages, contacts), self.loses_grip(stages)) {
            (StepEvent::Unresolved, _) => StepEvent::Unresolved,
            (StepEvent::Crossing { tau: crossing, .. }, Some((foot, tau))) if tau < crossing => {
                StepEvent::Grip { foot, tau }
            }
            (StepEvent::Nothing, Some((foot, tau))) => StepEvent::Grip { foot, tau },
            (crossing, _) => crossing,
        }
    }

    /// Whether a foot touches or leaves the ground, or begins to hold as it presses, and where
    /// first.
    pub(super) fn crosses(&self, stages: &Stages, contacts: &Contacts) -> StepEvent {
        let mut first = StepEvent::Nothing;
        let mut earliest = f64::INFINITY;
        let gaps = if let Contacts::Gaps(gaps) = contacts { *gaps } else { self.gaps(stages) };
        for (foot, gaps) in gaps.iter().enumerate() {
            // the contact lasts while sign (compression - level) is positive
            let limits: &[(f64, f64)] = match self.feet[foot].contact {
                Contact::Open => &[(-1.0, 0.0)],
                Contact::Stick | Contact::Slip(_) => &[(1.0, self.letting_go(foot))],
                // see `grip`
                Contact::Trail => &[],
                Contact::Slide => &[(1.0, 0.0), (-1.0, self.holding(foot))],
            };
            for &(sign, level) in limits {
                let inside = gaps.map(|d| sign * (d - level));
                let cubic = Cubic::through(&inside);
                let past = (1..4).find(|&k| inside[k] < -self.gap_tolerance());
                let high = past.map(|k| (NODES[k], inside[k]));
                // a node past the level may come after a passage that is over before the node ahead
                // of it
                let between = self.dip(&cubic, past.map_or(1.0, |k| NODES[k - 1]));
                let Some(high) = between.or(high) else { continue };
                let k = NODES.iter().rposition(|&node| node < high.0).unwrap_or(0);
                let low = (NODES[k], inside[k].max(0.0));
                let moves_in = || self.moves_in(foot, sign) * stages.h > self.gap_tolerance();
                let Some(tau) = self.first_zero(&cubic, low, high, moves_in) else {
                    return StepEvent::Unresolved;
                };
                if tau < earliest {
                    earliest = tau;
                    first = StepEvent::Crossing { foot, level, tau };
                }
            }
        }
        first
    }

    /// The compressions of both feet's gaps at the step's start and stages (m).
    fn gaps(&self, stages: &Stages) -> [[f64; 4]; 2] {
        let nodes = [&self.state.q, &stages.q[0], &stages.q[1], &stages.q[2]];
        let poses = nodes.map(Pose::of);
        let at = |foot: usize, k: usize| self.model.compression_at(&poses[k], foot, nodes[k]);
        [0, 1].map(|foot| [0, 1, 2, 3].map(|k| at(foot, k)))
    }

    /// A passage over before the next node of the step: the point between two nodes, no later than
    /// `until`, at which the compression is least inside its limit, if that is past it.
    fn dip(&self, cubic: &Cubic, until: f64) -> Option<(f64, f64)> {
        let tau = cubic.least();
        let value = cubic.at(tau);
        (tau > 0.0 && tau < until && value < -self.gap_tolerance()).then_some((tau, value))
    }

    /// Where the compression passes its limit between two bracketing points. `None` if the cubic
    /// leaves at once where the foot itself moves in: it need not begin with the state's velocity,
    /// and does not in a step too long for the springs.
    fn first_zero(
        &self,
        cubic: &Cubic,
        low: (f64, f64),
        high: (f64, f64),
        moves_in: impl Fn() -> bool,
    ) -> Option<f64> {
        let edge = 0.1 * self.gap_tolerance();
        let tau = match cubic.falls(low, high, edge) {
            Some(tau) => tau,
            None if low.0 == 0.0 && moves_in() => return None,
            None => falls_through_zero(low, high, edge, |tau| cubic.at(tau)),
        };
        Some(tau.max(1e-9))
    }

    /// Speed at which a foot moves off the edge of its limit, into it (m/s).
    fn moves_in(&self, foot: usize, sign: f64) -> f64 {
        sign * self.model.compression_rate(foot, &self.state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        fem::{
            control::Control,
            model::{Foot, Model, State, Z, az},
            radau::C,
        },
        spring::{Chain, Springs},
    };
    use rocking::structure::Structure;

    /// An absorber comes up under a foot in the air and is gone again before the next stage: f =
    /// -(tau - 0.2)(tau - 0.6) is negative at all nodes.
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
        let run = TimeLoop::new(&model, (state, feet), Control::default());
        let mut stages = Stages::none();
        stages.h = 1e-3;
        for (i, tau) in C.into_iter().enumerate() {
            stages.q[i] = state.q;
            stages.q[i][az(0)] = rise(tau);
            stages.v[i][az(0)] = slope(tau) / stages.h;
        }
        match run.met(&stages, &Contacts::Unknown) {
            StepEvent::Crossing { foot: 0, level, tau } => {
                assert!(level == 0.0 && (tau - 0.2).abs() < 1e-6, "{tau}")
            }
            _ => unreachable!("the touch is missed"),
        }
        // a hair lower it does not touch
        for q in &mut stages.q {
            q[Z] += 0.01 * 0.04 * 1.001;
        }
        state.q[Z] = stages.q[0][Z];
        let run = TimeLoop::new(&model, (state, feet), Control::default());
        assert!(matches!(run.met(&stages, &Contacts::Unknown), StepEvent::Nothing));
    }
}
