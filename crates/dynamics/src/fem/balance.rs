//! The rotation of a body without rotational inertia: it follows the contact forces at once, so it
//! stands where the elastic energy of the gaps is least,
//!
//! ```text
//!   V(theta) = sum ( N^2/(2 k1_v) + H^2/(2 k1_h) )        V' = - sum ( H dp_x/dtheta + N dp_z/dtheta ) = 0,   V'' > 0
//! ```
//!
//! and when a foot lands or lifts it jumps to the least that is nearest downhill.

use super::model::{Contact, Foot, FootForce, Model, State, TH, Vector, X, Z, ax, az};
use rocking::scalar::GRAVITY;

/// Newton steps from anywhere: V is all but quadratic, so that a few do.
const STEPS: usize = 6;

/// A Newton step this small ends them (rad): it converges to the square of it.
const LAST: f64 = 1e-12;

/// Steps of the guarded descent, where Newton's method alone does not find the least.
const DESCENT: usize = 60;

/// A step this small has arrived (rad).
const CLOSE: f64 = 1e-9;

/// Longest step of the descent (rad).
const LONGEST: f64 = 0.1;

impl Model {
    /// Turn a body without rotational inertia to where no moment acts on it. False if there is no
    /// such place downhill: the body has lost its balance, and the state means nothing any more.
    #[must_use]
    pub(crate) fn turn_to_balance(&self, state: &mut State, feet: &[Foot; 2]) -> bool {
        if !self.massless() || !(feet[0].closed() || feet[1].closed()) {
            return true;
        }
        if !self.law.slips() && !self.jumps() {
            return true;
        }
        let start = state.q[TH];
        let (before, ..) = self.potential(state, feet);
        if self.newton(state, feet, before) {
            return true;
        }
        if self.law.slips() {
            // a slipping foot's force has no potential to go down
            return state.q[TH].is_finite();
        }
        state.q[TH] = start;
        self.descend(state, feet) && self.newton(state, feet, before)
    }

    /// Whether the rotation stands where V is least, or has inertia and need not.
    pub(crate) fn in_balance(&self, state: &State, feet: &[Foot; 2]) -> bool {
        if !self.jumps() || !(feet[0].closed() || feet[1].closed()) {
            return true;
        }
        let (_, moment, stiffness) = self.potential(state, feet);
        stiffness > 0.0 && (moment / stiffness).abs() < CLOSE
    }

    /// The rotation near `theta` at which foot i just touches the ground; `theta` itself if it
    /// turns along the ground there.
    pub(crate) fn where_it_touches(&self, i: usize, q: &Vector, theta: f64) -> f64 {
        let mut at = *q;
        at[TH] = theta;
        for _ in 0..2 {
            let (compression, slope) = self.compression_and_slope(i, &at);
            let step = compression / slope;
            if step.abs() > CLOSE {
                return theta;
            }
            at[TH] -= step;
        }
        at[TH]
    }

    /// Give a rotation without inertia the rate at which it stays in balance while body and
    /// absorbers move on,
    ///
    /// ```text
    ///   theta' = sum ( H' dp_x/dtheta + N' dp_z/dtheta at theta' = 0 ) / V''
    /// ```
    ///
    /// A step too short to tell would leave it any rate, and a body that then leaves the ground
    /// keeps what it has.
    pub(crate) fn rotate_in_balance(&self, state: &mut State, feet: &[Foot; 2]) {
        let leans = feet[0].closed() || feet[1].closed();
        if !self.jumps() || !leans {
            return;
        }
        let contact = self.contact(&state.q, feet);
        let (_, stiffness) = self.moment_and_stiffness(&contact, feet);
        if stiffness <= 0.0 {
            return;
        }
        let v = &state.v;
        let moment = |i: usize| {
            let FootForce { px_th, pz_th, .. } = contact[i];
            let down = (v[az(i)] - v[Z]) * self.springs.vertical.k1 * pz_th;
            let along = (v[ax(i)] - v[X]) * self.springs.horizontal.k1 * px_th;
            match feet[i].contact {
                Contact::Open => 0.0,
                Contact::Slide | Contact::Trail | Contact::Slip(_) => down,
                Contact::Stick => down + along,
            }
        };
        state.v[TH] = (moment(0) + moment(1)) / stiffness;
    }

    /// Newton's method from where the body stands; whether it ends at a least of V below `before`.
    fn newton(&self, state: &mut State, feet: &[Foot; 2], before: f64) -> bool {
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let (moment, stiffness) =
                self.moment_and_stiffness(&self.contact(&state.q, feet), feet);
            let step = moment / stiffness;
            last = step;
            state.q[TH] += step;
            if last.abs() < LAST {
                break;
            }
        }
        let (after, _, stiffness) = self.potential(state, feet);
        last.abs() < CLOSE && stiffness > 0.0 && after <= before + self.rounding(before)
    }

    /// By how much rounding may change V where it is `stored` (J): on stiff springs that of the
    /// feet's places, a few units in the last digit of R times the force; and a billionth of what
    /// the standing body stores, where a foot has just touched.
    fn rounding(&self, stored: f64) -> f64 {
        let (k_v, k_h) = (self.springs.vertical.k1, self.springs.horizontal.k1);
        let weight = self.body.mass * GRAVITY;
        let force = (2.0 * stored * k_v.max(k_h)).sqrt();
        32.0 * f64::EPSILON * self.body.radius() * force + 1e-9 * weight * weight / k_v
    }

    /// Go downhill, never up; whether it ends where V curves upwards.
    fn descend(&self, state: &mut State, feet: &[Foot; 2]) -> bool {
        let (mut here, mut moment, mut stiffness) = self.potential(state, feet);
        for _ in 0..DESCENT {
            let mut step = moment / stiffness.abs();
            if step.abs() < 1e-6 {
                return stiffness > 0.0;
            }
            step = step.clamp(-LONGEST, LONGEST);
            let from = state.q[TH];
            loop {
                state.q[TH] = from + step;
                let next = self.potential(state, feet);
                if next.0 < here {
                    (here, moment, stiffness) = next;
                    break;
                }
                step *= 0.25;
                if step.abs() < 1e-12 || !step.is_finite() {
                    return false;
                }
            }
        }
        false
    }

    /// V (J), the moment -V' (N m) and the stiffness V'' (N m).
    fn potential(&self, state: &State, feet: &[Foot; 2]) -> (f64, f64, f64) {
        let contact = self.contact(&state.q, feet);
        let (k_v, k_h) = (self.springs.vertical.k1, self.springs.horizontal.k1);
        let mut twice = 0.0;
        for (foot, &FootForce { horizontal, vertical, .. }) in feet.iter().zip(&contact) {
            if foot.closed() {
                twice += horizontal * horizontal / k_h + vertical * vertical / k_v;
            }
        }
        let (moment, stiffness) = self.moment_and_stiffness(&contact, feet);
        (twice * 0.5, moment, stiffness)
    }

    /// The moment -V' (N m) and the stiffness V'' (N m).
    #[inline(always)]
    fn moment_and_stiffness(&self, contact: &[FootForce; 2], feet: &[Foot; 2]) -> (f64, f64) {
        let (k_v, k_h) = (self.springs.vertical.k1, self.springs.horizontal.k1);
        let (mut moment, mut stiffness) = (0.0, 0.0);
        for (foot, f) in feet.iter().zip(contact) {
            if foot.closed() {
                let &FootForce { px_th, pz_th, horizontal, vertical } = f;
                moment += horizontal * px_th + vertical * pz_th;
                let mut share = k_v * pz_th * pz_th + vertical * px_th - horizontal * pz_th;
                if foot.holds() {
                    share += k_h * px_th * px_th;
                }
                stiffness += share;
            }
        }
        (moment, stiffness)
    }
}
