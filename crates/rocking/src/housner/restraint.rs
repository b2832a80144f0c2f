//! What a tendon and dampers add to Housner's equation.
//!
//! ```text
//! w'' = (1), (3)  -  (d b R cos psi/l) k (l - l_0)/I0  -  c (2 b cos w)^2 w'/I0,     psi = alpha - w
//! l^2 = b^2 + R^2 - 2 b R sin psi,   l_0 = h - N_0/k
//! ```
//!
//! The body turns about one lower corner, on rigid ground. The tendon, of stiffness k and
//! pretension N_0, runs from the mass to the ground midway between the feet: its length l grows
//! with w, so that it is never slack. A damper c resists at each corner; that of the pivot does not
//! move. At rest the tendon holds the body down as a weight larger by N_0 does. Neither has a part
//! in an impact, which takes no time: equation (2) holds as it is.
//!
//! Within a Taylor step each of these is a power series in x, as the lean is (`series`):
//!
//! ```text
//! l^2 = Q:   Y = Q^(-1/2),   k Q_0 Y_k = sum_{j=1..k} (j/2 - k) Q_j Y_{k-j}      (Miller)
//! cos w = cos alpha cos psi + sin alpha sin psi
//! ```

#![allow(clippy::needless_range_loop)] // as in `series`

use std::f64::consts::FRAC_PI_2;

use super::series::{StepGround, StepStart};
use crate::{
    members::Members,
    scalar::{GRAVITY, Scalar, real},
    structure::Body,
};

/// Longest piece of a step over the time in which dampers stop a motion.
const DAMPED: f64 = 2.0;
/// Leans at which a fall is looked for.
const LEANS: usize = 400;

/// A tendon and dampers, over the body's inertia.
#[derive(Clone, Copy)]
pub(crate) struct Restraint<S> {
    /// b R k/I0 (1/s2).
    pull: S,
    /// l_0 (m).
    slack: S,
    /// 4 b^2 c/I0 (1/s).
    damping: S,
    /// b^2 + R^2 and 2 b R (m2).
    square: S,
    twice: S,
    sin_alpha: S,
    cos_alpha: S,
    /// I0/(m g b) (s2): a torque over I0 in units of the weight at the arm b.
    share: S,
    /// N_0/(m g).
    pub hold: S,
}

/// A step's series: of the lean, and of what tendon and dampers press on the pivot, over the
/// weight.
pub(crate) struct RestrainedSeries<S, const N: usize> {
    pub lean: [S; N],
    pub press: [f64; N],
}

impl<S: Scalar> Restraint<S> {
    /// Of a body's tendon and dampers, if it has any.
    pub(crate) fn of(body: &Body<S>, members: &Members) -> Option<Self> {
        let Members { damper, tendon, .. } = members;
        if !members.act() {
            return None;
        }
        let (b, h, radius) = (body.half_width, body.height, body.radius());
        let weight = body.mass * GRAVITY;
        // I0 = m g R/p^2
        let inertia = weight * radius / body.p_squared();
        let [k, n] = tendon.map_or([0.0; 2], |t| [t.stiffness, t.pretension]);
        let stretch: S = if k > 0.0 { real(n / k) } else { S::zero() };
        Some(Self {
            pull: b * radius * k / inertia,
            slack: h - stretch,
            damping: b * b * (4.0 * damper.map_or(0.0, |d| d.c)) / inertia,
            square: b * b + radius * radius,
            twice: b * radius * 2.0,
            sin_alpha: b / radius,
            cos_alpha: h / radius,
            share: inertia / (weight * b),
            hold: real::<S>(n) / weight,
        })
    }

    /// Torque towards the ground over I0 (rad/s2).
    pub(crate) fn torque(&self, at: &StepStart<S>) -> S {
        let length = (self.square - self.twice * at.sin).sqrt();
        let upright = self.cos_alpha * at.cos + self.sin_alpha * at.sin;
        self.pull * at.cos * (S::one() - self.slack / length)
            + self.damping * upright * upright * at.rate
    }

    /// What tendon and dampers take from the pivot over the weight: the tendon's pull on the mass
    /// away from the side that it leans to, and all that they press down.
    pub(crate) fn on_pivot(&self, at: &StepStart<S>) -> (S, S) {
        let (sin, cos) = (at.sin, at.cos);
        let length = (self.square - self.twice * sin).sqrt();
        let tendon = self.pull * cos * (S::one() - self.slack / length);
        let upright = self.cos_alpha * cos + self.sin_alpha * sin;
        let lifted = self.damping * upright * at.rate * 0.5;
        // towards the anchor, b - R sin psi across from the mass and R cos psi below it
        let across = (self.sin_alpha - sin) / cos;
        (self.share * tendon * across, self.share * (tendon + lifted))
    }

    /// The part of a step of h (s) that one series can take, for dampers.
    pub(crate) fn part(&self, h: f64) -> f64 {
        (DAMPED / (self.damping.re() * h)).min(1.0)
    }

    /// What it adds to how fast coefficients grow in a step of h (s).
    pub(crate) fn growth(&self, h: f64) -> f64 {
        let stiff = self.pull.re() * (1.0 + (self.slack * self.slack / self.square).re());
        self.damping.re() * h + stiff * h * h
    }

    /// The series of a step of h (s), q = p^2 h^2.
    pub(crate) fn series<const N: usize>(
        &self,
        start: &StepStart<S>,
        h: S,
        ground: &StepGround<S>,
        q: S,
    ) -> RestrainedSeries<S, N> {
        let product =
            |a: &[S], b: &[S], k: usize| (0..=k).fold(S::zero(), |sum, j| sum + a[j] * b[k - j]);
        let zero = [S::zero(); N];
        let (mut c, mut rate) = (zero, zero);
        (c[0], c[1]) = (start.w, start.rate * h);
        rate[0] = c[1];
        let (mut sin, mut cos, mut upright) = (zero, zero, zero);
        let (mut square, mut inverse) = (zero, zero);
        let (mut cos2, mut press) = (zero, [0.0; N]);
        let (pulls, damps) = (self.pull.re() > 0.0, self.damping.re() > 0.0);
        for k in 0..N - 2 {
            let over = 1.0 / k.max(1) as f64;
            let mut earlier = S::zero();
            if k == 0 {
                (sin[0], cos[0]) = (start.sin, start.cos);
            } else {
                // rate[j - 1] = j c_j
                sin[k] = -product(&rate, &cos, k - 1) * over;
                cos[k] = product(&rate, &sin, k - 1) * over;
                earlier = ground.dgamma * sin[k - 1] + ground.db * cos[k - 1];
            }
            let (mut tendon, mut damper, mut lifted) = (S::zero(), S::zero(), S::zero());
            if pulls {
                square[k] = if k == 0 { self.square } else { S::zero() } - self.twice * sin[k];
                inverse[k] = if k == 0 {
                    S::one() / square[0].sqrt()
                } else {
                    let sum = (1..=k).fold(S::zero(), |sum, j| {
                        sum + square[j] * inverse[k - j] * (0.5 * j as f64 - k as f64)
                    });
                    sum * over / square[0]
                };
                tendon = self.pull * (cos[k] - self.slack * product(&cos, &inverse, k));
            }
            if damps {
                upright[k] = self.cos_alpha * cos[k] + self.sin_alpha * sin[k];
                cos2[k] = product(&upright, &upright, k);
                damper = self.damping * h * product(&cos2, &rate, k);
                lifted = self.damping / h * product(&upright, &rate, k) * 0.5;
            }
            let weight = ground.gamma * sin[k] + ground.b * cos[k] + earlier;
            // (1), (3)
            c[k + 2] = -(q * weight + h * h * tendon + damper) * (1.0 / ((k + 1) * (k + 2)) as f64);
            rate[k + 1] = c[k + 2] * (k + 2) as f64;
            press[k] = (self.share * (tendon + lifted)).re();
        }
        RestrainedSeries { lean: c, press }
    }

    /// Whether a body that leans so goes on falling when the ground stops, by its energy, which
    /// dampers only lessen.
    pub(crate) fn falls(&self, at: &StepStart<S>, alpha: f64, p2: f64) -> bool {
        let (w, rate) = (at.w.re(), at.rate.re());
        if w <= alpha {
            return false;
        }
        let [pull, slack, square, twice] =
            [self.pull, self.slack, self.square, self.twice].map(|x| x.re());
        // over I0 (1/s2): d/dw of this is the torque
        let stored = |w: f64| {
            let (sin, cos) = (alpha - w).sin_cos();
            let stretch = (square - twice * sin).sqrt() - slack;
            p2 * cos + pull * stretch * stretch / twice
        };
        let energy = stored(w) + 0.5 * rate * rate;
        let passes = |to: f64| {
            let lean = |i: usize| w + (to - w) * i as f64 / LEANS as f64;
            (1..=LEANS).all(|i| stored(lean(i)) < energy)
        };
        let outward = passes(FRAC_PI_2);
        if rate >= 0.0 { outward } else { !passes(0.0) && outward }
    }
}

#[cfg(test)]
mod tests {
    use super::super::series::{LONG, value_and_slope};
    use super::*;
    use crate::members::{Damper, Tendon};
    use approx::assert_relative_eq;

    const BODY: Body<f64> = Body { mass: 120e3, half_width: 1.05, height: 8.9, inertia: 3.0e5 };

    fn restraint() -> Restraint<f64> {
        let tendon = Some(Tendon { stiffness: 4e7, pretension: 2e5 });
        let damper = Some(Damper { c: 8e4 });
        Restraint::of(&BODY, &Members { tendon, damper, friction: None }).unwrap()
    }

    fn start(w: f64, rate: f64) -> StepStart<f64> {
        let (sin, cos) = (BODY.alpha() - w).sin_cos();
        StepStart { w, rate, sin, cos }
    }

    /// The torque, of forces on the mass and on the corner that lifts: the mass stands at R (sin
    /// psi, cos psi) from the pivot, the anchor at b, the corner at 2 b (cos w, sin w).
    #[test]
    fn the_torque_is_that_of_the_forces() {
        let of = restraint();
        let inertia = BODY.mass * GRAVITY * BODY.radius() / BODY.p_squared();
        for (w, rate) in [(0.0, 0.0), (0.04, 0.3), (0.4, -0.2)] {
            let at = start(w, rate);
            let mass = [BODY.radius() * at.sin, BODY.radius() * at.cos];
            let anchor = [BODY.half_width, 0.0];
            let along = [mass[0] - anchor[0], mass[1] - anchor[1]];
            let length = along[0].hypot(along[1]);
            let tension = 2e5 + 4e7 * (length - BODY.height);
            let force = along.map(|x| -tension * x / length);
            let b2 = 2.0 * BODY.half_width;
            let lifts = b2 * w.cos() * rate;
            // w turns the mass away from the anchor's side of the pivot
            let tendon = mass[1] * force[0] - mass[0] * force[1];
            let torque = tendon + 8e4 * lifts * b2 * w.cos();
            assert_relative_eq!(of.torque(&at), torque / inertia, max_relative = 1e-12);
        }
    }
    /// w'' of the series against the right hand side, at points of the step; and the pivot's share
    /// against the forces there.
    #[test]
    fn the_series_satisfies_the_equation_inside_the_step() {
        let (of, h, p2) = (restraint(), 0.01, BODY.p_squared());
        let ground = StepGround { b: 0.15, db: -0.1, gamma: 0.9, dgamma: 0.2 };
        let series = of.series::<LONG>(&start(0.05, 0.2), h, &ground, p2 * h * h);
        let c = series.lean;
        for x in [0.0, 0.3, 0.6] {
            let (w, slope) = value_and_slope(&c, x);
            let at = start(w, slope / h);
            let second: f64 =
                (2..LONG).map(|k| (k * (k - 1)) as f64 * c[k] * f64::powi(x, k as i32 - 2)).sum();
            let (gamma, b) = (ground.gamma + ground.dgamma * x, ground.b + ground.db * x);
            let expected = -p2 * (gamma * at.sin + b * at.cos) - of.torque(&at);
            assert_relative_eq!(second / (h * h), expected, max_relative = 1e-11);
            let tension = {
                let z = BODY.radius() * at.cos;
                let length = (BODY.half_width - BODY.radius() * at.sin).hypot(z);
                (2e5 + 4e7 * (length - BODY.height)) * z / length
            };
            let pressed = tension + 8e4 * 2.0 * BODY.half_width * w.cos() * at.rate;
            let found = value_and_slope(&series.press, x).0 * BODY.mass * GRAVITY;
            assert_relative_eq!(found, pressed, max_relative = 1e-10);
        }
    }

    /// The forces on the pivot turn the body about its mass, with the dampers' on the other corner:
    /// I_cg w''. The tendon acts on the mass.
    #[test]
    fn the_pivots_forces_turn_the_body_about_its_mass() {
        let of = restraint();
        let (r, b2) = (BODY.radius(), 2.0 * BODY.half_width);
        let (gamma, ground) = (0.9, 0.2);
        for (w, rate) in [(0.01, 0.2), (0.05, -0.3)] {
            let at = start(w, rate);
            let second = -BODY.p_squared() * (gamma * at.sin + ground * at.cos) - of.torque(&at);
            // x from the pivot towards the other foot; the ground moves the other way
            let across = r / GRAVITY * (-at.cos * second - at.sin * rate * rate) - ground;
            let upwards = r / GRAVITY * (at.sin * second - at.cos * rate * rate) + gamma;
            let (pull, press) = of.on_pivot(&at);
            let (x, z) = (across - pull, upwards + press);
            let damper = 8e4 * b2 * w.cos() * rate / (BODY.mass * GRAVITY);
            let arm = b2 * w.cos() - r * at.sin;
            let moment = (r * at.cos * x - r * at.sin * z - damper * arm) * BODY.mass * GRAVITY;
            assert_relative_eq!(moment, BODY.inertia * second, max_relative = 1e-9);
        }
    }
}
