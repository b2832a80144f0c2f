//! Friction between foot and ground (optional): a foot that holds slips when |H| reaches mu N, and
//! holds again when its slipping stops.
//!
//! ```text
//!   slipping to the side s (+1 right):  H = -s mu N      slip rate  w = d/dt (p_x - a_x) - s mu dN/dt / k1_h
//!   lasts while s w > 0                                  power lost  mu N s w
//! ```

use super::TimeLoop;
use crate::fem::{
    model::{Contact, Foot, State, TH, X, Z},
    observer::Observer,
    step::Stages,
    strut::Strut,
};
use rocking::scalar::GRAVITY;

/// Share of mu times the weight by which the force of a holding foot may exceed its limit, and
/// share of g/Omega_n by which a slipping foot may turn back: a foot on the edge of slipping must
/// not change its mind within rounding.
const HESITATION: f64 = 1e-6;
/// Rounding of a foot's place, in units of `f64::EPSILON` of what it is the sum of: of the place,
/// of its anchor, and of the iteration that finds them.
const ROUNDED: f64 = 4.0;
/// Steps tried to locate the change.
const MOST_TRIALS: usize = 40;

impl TimeLoop<'_> {
    /// What must stay positive while foot i holds or slips as it does, in units of the hesitation;
    /// `None` without friction or in the air.
    fn grip(&self, foot: usize, state: &State) -> Option<f64> {
        let mu = self.model.law.coefficient();
        match self.feet[foot].contact {
            Contact::Trail => {
                let Strut { press, lift } = self.model.strut(foot, state);
                Some(-(press / self.settling).max(lift) / (HESITATION * GRAVITY))
            }
            _ if !self.model.law.slips() => None,
            Contact::Open | Contact::Slide => None,
            Contact::Stick => {
                let f = &self.model.contact(&state.q, &self.feet)[foot];
                let hesitation = self.force_hesitation(state);
                Some((mu * f.vertical - f.horizontal.abs()) / hesitation)
            }
            Contact::Slip(side) => {
                let rate = self.model.slip_rate(foot, &state.q, &state.v, side);
                Some(side * rate / (HESITATION * GRAVITY * self.settling))
            }
        }
    }

    /// By how much the force of a holding foot may exceed its limit (N): what rounding makes of it,
    /// at least. On stiff springs far from where the body stood, the last digit of its place is
    /// above that share of the limit, and a foot that has just come to hold would slip
    /// again at once, and hold again, without end.
    fn force_hesitation(&self, State { q, .. }: &State) -> f64 {
        let (mu, body) = (self.model.law.coefficient(), &self.model.body);
        let turned = q[TH].abs() * body.radius();
        let rounded = |k: f64, place: f64| ROUNDED * f64::EPSILON * k * (place + turned);
        let across = rounded(self.model.springs.horizontal.k1, q[X].abs());
        let upwards = rounded(self.model.springs.vertical.k1, q[Z].abs());
        (HESITATION * mu * body.mass * GRAVITY).max(across + mu * upwards)
    }

    /// Where in the step (0 to 1) a foot first changes between holding and slipping, roughly.
    pub(super) fn loses_grip(&self, stages: &Stages) -> Option<(usize, f64)> {
        let changes = (0..2).filter_map(|foot| {
            let mut last = (0.0, self.grip(foot, &self.state)?);
            for (tau, (q, v)) in
                crate::fem::radau::C.into_iter().zip(stages.q.iter().zip(&stages.v))
            {
                let value = self.grip(foot, &State { q: *q, v: *v })?;
                if value < -1.0 {
                    let share = (last.1 + 1.0).max(0.0) / (last.1 - value).max(1.0);
                    return Some((foot, (last.0 + (tau - last.0) * share.min(1.0)).max(1e-9)));
                }
                last = (tau, value);
            }
            None
        });
        changes.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Repeat the step so that it ends where the foot's grip changes (false position); whether that
    /// succeeds.
    pub(super) fn locate_grip(&mut self, foot: usize, tau: f64, stages: &mut Stages) -> bool {
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let (whole, mut at) = (stages.h, tau);
        for _ in 0..MOST_TRIALS {
            self.work.located += 1;
            if !self.attempt(whole * at, stages) {
                return false;
            }
            self.work.iterations += stages.iterations;
            let Some(value) = self.grip(foot, &stages.end()) else { return false };
            // at the edge, or as near to it as the clock can tell
            if (-1.0..=0.0).contains(&value) || whole * at <= 1e-9 * self.settling {
                return true;
            }
            if value > 0.0 {
                low = at;
            } else {
                high = at;
            }
            at = if high.is_finite() { 0.5 * (low + high) } else { (1.5 * at).min(1.0) };
            if high.is_finite() && high - low < 1e-12 {
                return true;
            }
        }
        false
    }

    /// A holding foot begins to slip, or a slipping one holds; its horizontal force stays what it
    /// is. Or a trailing one presses or lifts.
    pub(super) fn change_grip(&mut self, foot: usize, time: f64, observer: &mut dyn Observer) {
        if self.feet[foot].contact == Contact::Trail {
            self.turns = 0;
            return self.switch(foot, 0.0, time, observer);
        }
        let before = self.energy.stored;
        let force = self.model.contact(&self.state.q, &self.feet)[foot].horizontal;
        self.feet[foot] = match self.feet[foot].contact {
            Contact::Slip(_) => {
                let anchor = self.model.anchor_here(foot, &self.state.q)
                    + force / self.model.springs.horizontal.k1;
                Foot { contact: Contact::Stick, anchor }
            }
            _ => Foot { contact: Contact::Slip(-force.signum()), ..self.feet[foot] },
        };
        self.restart(before);
    }
}
