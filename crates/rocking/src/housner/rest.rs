//! Leaving the ground, and coming to rest on it.
//!
//! Uplift: a resting body stays down until |a_g| > (g + a_v) tan(alpha), then leans away, s =
//! -sgn(a_g). Both sides are linear between two samples. In terms of gamma = 1 + a_v/g: |a_g|/g >
//! gamma tan(alpha).
//!
//! Rest: with restitution e < 1 and |a_g| < (g + a_v) tan(alpha) the body makes infinitely many
//! ever smaller hops in a finite time. Near the ground w'' = -d with d between bounds, so a hop
//! that starts at rate v lasts at most 2 v/d_min, is at most v^2/(2 d_min) high, and ends at a rate
//! of at most v sqrt(d_max/d_min). Hence all hops together last at most
//!
//! ```text
//! 2 v / ( d_min [1 - e sqrt(d_max/d_min)] )
//! ```
//!
//! If that is less than what is left of the interval between two samples, in which |a_g| stays
//! below the limit, the body lies still at the next sample: nothing is neglected but the list of
//! its last impacts.

use crate::scalar::Scalar;

/// Highest hop [in units of alpha] that counts as none when hops do not die out by themselves (e
/// close to 1): rounding of theta.
const FLOOR: f64 = f64::EPSILON;

/// An excess over the limit this small, relative to it, on the falling side of a peak, is a graze:
/// the hop that it would make is of the order of its cube.
const GRAZE: f64 = 4.0 * f64::EPSILON;

/// When and to which side a body resting at fraction x of an interval lifts in what is left of it.
/// a_g/g is a + da x and gamma is g + dg x, each given as (a, da); lift is tan(alpha).
pub(crate) fn uplift<S: Scalar>(
    x: S,
    (a, da): (S, S),
    (g, dg): (S, S),
    lift: S,
) -> Option<(S, f64)> {
    // the earlier of the two sides: both lift where gamma falls below zero
    let sides = [1.0, -1.0]
        .map(|sign| above(x, (a * sign, da * sign), (g, dg), lift).map(|at| (at, -sign)));
    sides
        .into_iter()
        .flatten()
        .reduce(|first, other| if other.0.re() < first.0.re() { other } else { first })
}

/// Where a + da x is above the limit lift (g + dg x), from x on.
fn above<S: Scalar>(x: S, (a, da): (S, S), (g, dg): (S, S), lift: S) -> Option<S> {
    let excess = |x: f64| (a.re() + da.re() * x) - lift.re() * (g.re() + dg.re() * x);
    let rate = da - lift * dg;
    let limit = (lift * (g + dg * x)).re();
    let now = excess(x.re());
    if now > 0.0 && (rate.re() >= 0.0 || now > GRAZE * limit) {
        return Some(x);
    }
    if excess(1.0) > 0.0 && rate.re() > 0.0 {
        // differentiable where it lies inside
        let at = (lift * g - a) / rate;
        return Some(if at.re() < x.re() { x } else { at });
    }
    None
}

/// Where gamma = g + dg x, from x on, falls to zero under a body at rest on both feet.
pub(crate) fn release(x: f64, g: f64, dg: f64) -> Option<f64> {
    if g + dg * x <= 0.0 {
        return Some(x);
    }
    (g + dg <= 0.0).then(|| (-g / dg).clamp(x, 1.0))
}

/// How a rest goes on in what is left of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum RestOutcome<S> {
    /// The body rests to the interval's end.
    Lasts,
    /// It lifts at a fraction of the interval, to a side.
    Lifts { at: S, side: f64 },
    /// Before it lifts the ground falls away from under both feet, at a fraction of the interval.
    LetsGo { at: f64 },
}

/// How a rest goes on from fraction x of an interval; `V` is whether the ground moves vertically.
#[inline(always)]
pub(crate) fn outcome<const V: bool, S: Scalar>(
    x: S,
    (a, da): (S, S),
    (g, dg): (S, S),
    lift: S,
) -> RestOutcome<S> {
    let lifts = uplift(x, (a, da), (g, dg), lift);
    let lets_go = if V { release(x.re(), g.re(), dg.re()) } else { None };
    match (lifts, lets_go) {
        (lifts, Some(at)) if lifts.is_none_or(|(lift, _)| at <= lift.re()) => {
            RestOutcome::LetsGo { at }
        }
        (Some((at, side)), _) => RestOutcome::Lifts { at, side },
        (None, _) => RestOutcome::Lasts,
    }
}

/// What becomes of a body just after an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum AfterImpact {
    /// It hops on.
    Hops,
    /// It has no rate left: it rests now.
    Stops,
    /// All its hops end before the interval does.
    DiesOut,
}

/// A body just after an impact.
pub(crate) struct Hop {
    /// w' after the impact (rad/s).
    pub rate: f64,
    /// Time left in the interval (s).
    pub left: f64,
    /// a_g/g now.
    pub now: f64,
    /// a_g/g at the end of the interval.
    pub then: f64,
    /// gamma now, and at the end of the interval.
    pub gamma: (f64, f64),
    pub e: f64,
    pub alpha: f64,
    /// Sine and cosine of alpha.
    pub ground: (f64, f64),
    pub p2: f64,
}

impl Hop {
    pub(crate) fn fate(&self) -> AfterImpact {
        let v = self.rate;
        if v <= 0.0 {
            return AfterImpact::Stops;
        }
        let peak = self.now.abs().max(self.then.abs());
        let (least, most) = (self.gamma.0.min(self.gamma.1), self.gamma.0.max(self.gamma.1));
        let d = |(sin, cos): (f64, f64), gamma: f64, a: f64| self.p2 * (gamma * sin + a * cos);
        let d_ground = d(self.ground, least, -peak);
        // d falls as the body leans out, so that d_min <= d_ground and the ratios below are 1 at
        // least
        if d_ground > 0.0 && 2.0 * v < self.left * d_ground * (1.0 - self.e) {
            // twice the height of a hop in the field at the ground as the lean to bound d at
            let lean = v * v / d_ground;
            let out = (self.alpha - lean).sin_cos();
            let d_min = d(out, least, -peak);
            if lean < self.alpha && d_min > 0.5 * d_ground {
                let ratio = |side: f64| {
                    let (now, then) = (side * self.now, side * self.then);
                    d(self.ground, most, now.max(then)) / d(out, least, now.min(then))
                };
                let loss = 1.0 - self.e * ratio(1.0).max(ratio(-1.0)).sqrt();
                if 2.0 * v < self.left * d_min * loss {
                    return AfterImpact::DiesOut;
                }
            }
        }
        let d_now = d(self.ground, self.gamma.0, -self.now.abs());
        if d_now > 0.0 && v * v < 2.0 * d_now * FLOOR * self.alpha {
            return AfterImpact::Stops;
        }
        AfterImpact::Hops
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From the interval's start, without vertical motion.
    fn level(a: f64, da: f64, lift: f64) -> Option<(f64, f64)> {
        uplift(0.0, (a, da), (1.0, 0.0), lift)
    }

    #[test]
    fn uplift_is_located_where_the_ground_acceleration_passes_the_limit() {
        assert_eq!(level(0.0, 0.4, 0.1), Some((0.25, -1.0)));
        assert_eq!(level(0.0, -0.4, 0.1), Some((0.25, 1.0)));
        assert_eq!(level(0.05, 0.05, 0.1), None);
        assert_eq!(level(0.3, -0.6, 0.1), Some((0.0, -1.0)));
    }

    /// 0.05 + 0.05 x against 0.25 (1 - 0.8 x), and a push of nothing against a ground that falls
    /// faster than the body.
    #[test]
    fn a_ground_that_moves_down_lifts_the_body_sooner() {
        let (at, side) = uplift(0.0, (0.05, 0.05), (1.0, -0.8), 0.25).unwrap();
        assert!((at - 0.8).abs() < 1e-15 && side == -1.0, "{at}");
        assert_eq!(uplift(0.0, (0.05, 0.05), (1.0, 0.2), 0.25), None);
        assert_eq!(uplift(0.0, (0.3, 0.0), (1.0, 0.5), 0.25), Some((0.0, -1.0)));
        // both sides at once: the earlier
        assert_eq!(uplift(0.0, (-0.125, 0.0), (1.0, -2.0), 0.25), Some((0.25, 1.0)));
        assert_eq!((release(0.0, 1.0, -2.0), release(0.75, 1.0, -2.0)), (Some(0.5), Some(0.75)));
        assert_eq!((release(0.0, 1.0, -0.5), release(0.0, 0.0, 1.0)), (None, Some(0.0)));
    }

    #[test]
    fn a_peak_one_ulp_above_the_limit_is_a_graze() {
        let limit = 0.1_f64;
        assert_eq!(level(limit.next_up(), -0.05, limit), None);
        assert_eq!(level(limit.next_up(), 0.0, limit), Some((0.0, -1.0)));
        assert_eq!(level(limit, 0.0, limit), None);
    }

    /// Level ground: hops of duration 2 v e^n/d, d = p^2 sin(alpha); their sum is 2 v/(d (1 - e)).
    #[test]
    fn on_level_ground_hops_die_out_within_the_closed_form_time() {
        let (v, e, alpha, p2) = (1e-5_f64, 0.9, 0.2_f64, 3.0);
        let time = 2.0 * v / (p2 * alpha.sin() * (1.0 - e));
        let hop = |left, gamma| Hop {
            rate: v,
            left,
            now: 0.0,
            then: 0.0,
            gamma: (gamma, gamma),
            e,
            alpha,
            ground: alpha.sin_cos(),
            p2,
        };
        // under half the weight they take twice as long
        for (gamma, time) in [(1.0, time), (0.5, 2.0 * time)] {
            assert_eq!(hop(1.0001 * time, gamma).fate(), AfterImpact::DiesOut);
            assert_eq!(hop(0.9999 * time, gamma).fate(), AfterImpact::Hops);
        }
        let falling = Hop { gamma: (1.0, -0.1), ..hop(1.0001 * time, 1.0) };
        assert_eq!(falling.fate(), AfterImpact::Hops);
    }
}
