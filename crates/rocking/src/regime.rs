//! What Housner's solution asks of the contact: whether the body would slide, fly, or bounce
//! instead of rocking.
//!
//! With phi = alpha s - theta the pivot's forces on the body, horizontal F and vertical N, are
//!
//! ```text
//! F = m ( R [ cos(phi) theta'' + sin(phi) theta'^2 ] + a_g )
//! N = m ( R [ sin(phi) theta'' - cos(phi) theta'^2 ] + g + a_v )
//! ```
//!
//! and at rest F = m a_g, N = m (g + a_v); a_v is the vertical ground acceleration, if there is
//! any. Without sliding |F|/N is below the friction coefficient; N <= 0 is free flight.
//!
//! A landing turns the centre of mass, h above the ground and b beside either foot, from the rate w
//! about the old foot (the pivot until now) to e w about the new one. Whatever feet give the
//! impulses, momentum asks of the ground
//!
//! ```text
//! P_x = m h w - m h e w,   P_y = m b w + m b e w:   P_x/P_y = h (1 - e)/(b (1 + e))
//! ```
//!
//! I_cg does not enter but by equation (2), which leaves the old foot without impulse: with its e
//! that is m h b/(I_cg + m h^2). The pivot must then rise. An impulse with friction mu at the new
//! foot lifts the pivot if
//!
//! ```text
//! I_cg - m b^2 + mu m h b >= 0
//! ```
//!
//! (the change of the pivot's vertical velocity, P_y/m - b (P_y b - P_x h)/I_cg, times I_cg m/P_y).
//! Without friction that is I_cg >= m b^2: H/B >= sqrt(2) for a solid block of height H and width
//! B. With the friction of Housner's own impulse it is e > 0, I_cg > m (b^2 - h^2): H/B >
//! 1/sqrt(2). An A-frame needs mu >= b/h = tan(alpha), which it needs to lift off anyway.

use crate::housner::{Restraint, Rocking, StepStart};
use crate::members::Members;
use crate::motion::TimedPeak;
use crate::motion::samples_until;
use crate::scalar::GRAVITY;
use crate::structure::Body;

/// A geometry that does not land without bouncing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stocky {
    /// Restitution by equation (2); zero or less if no friction lets it land.
    pub restitution: f64,
    /// Friction coefficient with which the landing lifts the pivot.
    pub friction_needed: f64,
}

/// The regime of a history, under the friction coefficient that is available.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regime {
    /// The friction coefficient that is available.
    pub friction: f64,
    /// Largest |F|/N while the feet press on the ground, at rest and rocking.
    pub friction_needed: TimedPeak,
    /// P_x/P_y of its landings: the friction coefficient needed not to slide in an impact.
    pub landing_friction: f64,
    /// First time with N <= 0, and the lowest N/(m g) of the history.
    pub free_flight: Option<TimedPeak>,
    /// The lowest N/(m g) and its time, the first of equals.
    pub least_press: TimedPeak,
    /// The geometry, if it is too stocky to land without bouncing.
    pub too_stocky: Option<Stocky>,
}

/// Check a history against the record (m/s2; horizontal, and vertical, zero beyond its last sample)
/// and scale that made it, at the samples, where it first lifts and on either side of each impact,
/// up to its overturning: what a body asks of the ground while it falls is no question of rocking.
pub fn check(
    body: &Body<f64>,
    dt: f64,
    ground: (&[f64], &[f64]),
    scale: f64,
    rocking: &Rocking<f64>,
    friction: f64,
) -> Regime {
    check_with(body, &Members::default(), (dt, scale), ground, rocking, friction)
}

/// The same of a body with a tendon and dampers, whose history has them, too: forces are those of
/// the pivot; `friction` of the ground is the coefficient that is available.
pub fn check_with(
    body: &Body<f64>,
    members: &Members,
    (dt, scale): (f64, f64),
    (accel, vertical): (&[f64], &[f64]),
    rocking: &Rocking<f64>,
    friction: f64,
) -> Regime {
    let restraint = Restraint::of(body, members);
    let hold = restraint.as_ref().map_or(0.0, |restraint| restraint.hold);
    let forces = |side, theta, rate, ground| {
        forces_with(body, restraint.as_ref(), side, (theta, rate), ground)
    };
    // in g; gamma = 1 + a_v/g beside a_g/g
    let at = |record: &[f64], i: usize| record.get(i).copied().unwrap_or(0.0) * scale / GRAVITY;
    let sample = |i: usize| (at(accel, i), 1.0 + at(vertical, i));
    let mut worst = Worst {
        friction: TimedPeak { value: 0.0, time: 0.0 },
        lowest: TimedPeak { value: 1.0, time: 0.0 },
        flight: None,
    };
    let mut impacts = rocking.impacts.iter().peekable();
    let upright = samples_until(rocking.overturned(), dt);
    // it lifts where the ground's force passes through the foot, between samples
    if let Some(uplift) = rocking.uplifts.first() {
        let value = body.half_width / body.height;
        worst.friction = TimedPeak { value, time: uplift.time };
    }
    for (i, (&theta, &rate)) in rocking.theta.iter().zip(&rocking.rate).enumerate().take(upright) {
        let time = i as f64 * dt;
        while let Some(impact) = impacts.next_if(|impact| impact.time <= time) {
            let x = impact.time / dt;
            let k = (x as usize).min(accel.len().saturating_sub(2));
            let ((a0, g0), (a1, g1)) =
                (sample(k), sample((k + 1).min(accel.len().saturating_sub(1))));
            let part = x - k as f64;
            let ground = (a0 + (a1 - a0) * part, g0 + (g1 - g0) * part);
            // the body comes from the side that it moves away from
            let from = -impact.rate_before.signum();
            worst.take(impact.time, forces(from, 0.0, impact.rate_before, ground));
            worst.take(impact.time, forces(-from, 0.0, impact.rate_after, ground));
        }
        let ground = sample(i);
        if theta == 0.0 && rate == 0.0 {
            worst.take(time, (ground.0, ground.1 + hold));
        } else {
            let side = if theta == 0.0 { rate.signum() } else { theta.signum() };
            worst.take(time, forces(side, theta, rate, ground));
        }
    }
    Regime {
        friction,
        friction_needed: worst.friction,
        landing_friction: landing_friction(body, rocking),
        free_flight: worst.flight.map(|time| TimedPeak { value: worst.lowest.value, time }),
        least_press: worst.lowest,
        too_stocky: stockiness(body, friction),
    }
}

/// P_x/P_y of the landings of a history, by the restitution that they have; without any, by
/// equation (2).
fn landing_friction(body: &Body<f64>, rocking: &Rocking<f64>) -> f64 {
    let lost = |before: f64, after: f64| (before - after) / (before + after);
    let landing = rocking.impacts.iter().map(|impact| [impact.rate_before, impact.rate_after]);
    // one that ends the motion is no rule
    let landing = landing.map(|rates| rates.map(f64::abs)).find(|[_, after]| *after > 0.0);
    match landing {
        Some([before, after]) => body.height / body.half_width * lost(before, after),
        None => {
            body.mass * body.height * body.half_width
                / (body.inertia + body.mass * body.height.powi(2))
        }
    }
}

/// When the pivot would first have to hold the body down (s), if ever, up to its overturning;
/// arguments as of [`check`]. The feet of a finite element model leave the ground there, as real
/// ones do: Housner's equation says nothing of what follows.
pub fn pivot_pulls(
    body: &Body<f64>,
    dt: f64,
    accel: &[f64],
    rocking: &Rocking<f64>,
) -> Option<f64> {
    check(body, dt, (accel, &[]), 1.0, rocking, f64::INFINITY).free_flight.map(|flight| flight.time)
}

/// The geometry, if it does not land without bouncing under a friction coefficient.
pub(crate) fn stockiness(body: &Body<f64>, friction: f64) -> Option<Stocky> {
    let restitution = body.restitution();
    let friction_needed =
        (body.half_width - body.inertia / (body.mass * body.half_width)) / body.height;
    (restitution <= 0.0 || friction_needed > friction)
        .then_some(Stocky { restitution, friction_needed: friction_needed.max(0.0) })
}

/// Horizontal and vertical force of the ground on Housner's body (N) at the samples of its history:
/// what of it stands between impacts. Ground accelerations (horizontal, vertical) in m/s2, zero
/// beyond their last sample.
pub fn ground_forces(
    body: &Body<f64>,
    (accel, vertical): (&[f64], &[f64]),
    rocking: &Rocking<f64>,
) -> Vec<(f64, f64)> {
    let weight = body.mass * GRAVITY;
    let at = |record: &[f64], i: usize| record.get(i).copied().unwrap_or(0.0) / GRAVITY;
    let force = |(i, (&theta, &rate)): (usize, (&f64, &f64))| {
        let ground = (at(accel, i), 1.0 + at(vertical, i));
        let (f, n) = if theta == 0.0 && rate == 0.0 {
            // at the instant that lifts it, the body turns about the foot that it leans away on
            match stands(body, ground) {
                true => ground,
                false => forces(body, -ground.0.signum(), theta, rate, ground),
            }
        } else {
            let side = if theta == 0.0 { rate.signum() } else { theta.signum() };
            forces(body, side, theta, rate, ground)
        };
        (weight * f, weight * n)
    };
    rocking.theta.iter().zip(&rocking.rate).enumerate().map(force).collect()
}

/// Whether a body at rest stays at rest under a_g/g and gamma: |a_g|/g below gamma tan(alpha).
pub fn stands(body: &Body<f64>, (ground, gamma): (f64, f64)) -> bool {
    ground.abs() * body.height <= gamma * body.half_width
}

/// F and N of a body that rocks on the foot of a side (1: right) over its weight m g; the ground
/// has a_g/g and gamma.
pub fn forces(
    body: &Body<f64>,
    side: f64,
    theta: f64,
    rate: f64,
    ground: (f64, f64),
) -> (f64, f64) {
    forces_with(body, None, side, (theta, rate), ground)
}

/// The same of a body with a tendon and dampers, of its motion (theta, theta'): what of it the foot
/// bears.
pub fn forces_of_foot(
    body: &Body<f64>,
    members: &Members,
    side: f64,
    motion: (f64, f64),
    ground: (f64, f64),
) -> (f64, f64) {
    forces_with(body, Restraint::of(body, members).as_ref(), side, motion, ground)
}

fn forces_with(
    body: &Body<f64>,
    restraint: Option<&Restraint<f64>>,
    side: f64,
    (theta, rate): (f64, f64),
    (ground, gamma): (f64, f64),
) -> (f64, f64) {
    let (sin, cos) = (body.alpha() * side - theta).sin_cos();
    let at = StepStart { w: theta * side, rate: rate * side, sin: sin * side, cos };
    let torque = restraint.map_or(0.0, |restraint| restraint.torque(&at));
    let (pull, press) = restraint.map_or((0.0, 0.0), |restraint| restraint.on_pivot(&at));
    let r = body.radius() / GRAVITY;
    let acceleration = -body.p_squared() * (gamma * sin + ground * cos) - side * torque; // (1), (3)
    let horizontal = r * (cos * acceleration + sin * rate * rate) + ground;
    let vertical = r * (sin * acceleration - cos * rate * rate) + gamma;
    (horizontal + side * pull, vertical + press)
}

struct Worst {
    friction: TimedPeak,
    lowest: TimedPeak,
    flight: Option<f64>,
}

impl Worst {
    fn take(&mut self, time: f64, (horizontal, vertical): (f64, f64)) {
        if vertical < self.lowest.value {
            self.lowest = TimedPeak { value: vertical, time };
        }
        if vertical <= 0.0 {
            self.flight.get_or_insert(time);
        } else if horizontal.abs() > self.friction.value * vertical {
            self.friction = TimedPeak { value: horizontal.abs() / vertical, time };
        }
    }
}

#[cfg(test)]
mod tests;
