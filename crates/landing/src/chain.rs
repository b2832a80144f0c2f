//! One spring-absorber unit stops a mass: the landing along the foot, in units in which nothing but
//! the design is left.
//!
//! ```text
//!   mass 1, speed 1 ─ gap, k1 = 1 ─ mu ─┬─ K ─┬─ ground        x'' = N,   mu a'' = -N - K a - C a'
//!                                       └─ C ─┘                N = a - x while the two press, else 0
//! ```
//!
//! No gravity, time in 1/Omega_n (theory of the landing in the stiff limit: where Omega_n v_n >> g
//! a landing is over before gravity or the rotation matter). The mass leaves when N falls to zero,
//! with the speed `rebound`; the absorber swings back and must not meet it again: `clearance`, the
//! least later distance of the two, must not be negative.

use super::linear::{SquareMatrix, exponential, times};
use rocking::scalar::{Scalar, real};

/// How long a landing is followed [1/Omega_n]: first lifts come near 2.4, late touches between 8
/// and 28.
pub const FOLLOWED: f64 = 30.0;
/// Steps in which signs are looked for [1/Omega_n]: the unit's own periods are a few units long.
const STEP: f64 = 0.05;
/// Newton steps at an event or a least distance: quadratic, and one more for derivatives.
const NEWTON: usize = 8;

/// What the landing of the mass does.
#[derive(Clone, Copy, Debug)]
pub struct ChainLanding<S> {
    /// Time at which the mass leaves [1/Omega_n].
    pub lift: S,
    /// Speed with which it leaves the ground, positive upwards (v_n).
    pub rebound: S,
    /// Least distance of mass and absorber after that, until [`FOLLOWED`] [v_n/Omega_n]; negative
    /// if the absorber comes back and would touch.
    pub clearance: S,
}

/// Land on K = k2/k1, C = c/(m Omega_n), mu = m2/m; `None` if the mass does not leave.
pub fn land<S: Scalar>(k: S, c: S, mu: S) -> Option<ChainLanding<S>> {
    let (zero, one) = (S::zero(), S::one());
    // y = x, a, x', a'
    let pressing: SquareMatrix<S, 4> = [
        [zero, zero, one, zero],
        [zero, zero, zero, one],
        [-one, one, zero, zero],
        [mu.recip(), -(k + 1.0) / mu, zero, -c / mu],
    ];
    let step = exponential(&pressing, real(STEP));
    let force = |y: &[S; 4]| y[1] - y[0];
    let mut y = [zero, zero, -one, zero];
    let mut t = 0.0;
    loop {
        let next = times(&step, &y);
        if t > 0.0 && force(&next).re() < 0.0 {
            break;
        }
        y = next;
        t += STEP;
        if t > FOLLOWED {
            return None;
        }
    }
    let (mut tau, mut end): (S, _) = (real(0.5 * STEP), y);
    for _ in 0..NEWTON {
        end = times(&exponential(&pressing, tau), &y);
        tau -= force(&end) / (end[3] - end[2]);
    }
    let lift = tau + t;
    Some(ChainLanding { lift, rebound: end[2], clearance: clearance(&end, k, c, mu, lift) })
}

/// Least distance of the free mass from the absorber that swings by itself.
fn clearance<S: Scalar>(start: &[S; 4], k: S, c: S, mu: S, lift: S) -> S {
    let (zero, one) = (S::zero(), S::one());
    let free: SquareMatrix<S, 2> = [[zero, one], [-k / mu, -c / mu]];
    let step = exponential(&free, real(STEP));
    let [x, _, speed, _] = *start;
    let gap = |s: S, a: &[S; 2]| x + speed * s - a[0];
    let rate = |a: &[S; 2]| speed - a[1];
    let (mut absorber, mut s) = ([start[1], start[3]], 0.0);
    let mut least: Option<S> = None;
    while s + lift.re() < FOLLOWED {
        let next = times(&step, &absorber);
        if rate(&absorber).re() < 0.0 && rate(&next).re() >= 0.0 {
            let mut tau: S = real(0.5 * STEP);
            let mut at = absorber;
            for _ in 0..NEWTON {
                at = times(&exponential(&free, tau), &absorber);
                let acceleration = -(at[0] * k + at[1] * c) / mu;
                tau += rate(&at) / acceleration;
            }
            least = smaller(least, gap(tau + s, &at));
        }
        (absorber, s) = (next, s + STEP);
    }
    // at the end it may still be coming nearer
    smaller(least, gap(real(s), &absorber)).unwrap_or(zero)
}

fn smaller<S: Scalar>(least: Option<S>, gap: S) -> Option<S> {
    match least {
        Some(least) if least.re() <= gap.re() => Some(least),
        _ => Some(gap),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::Dual64;

    /// An absorber without mass on the dashpot alone: the mass on spring 1 and dashpot C in series,
    /// a' = -N/C, so that N'' + N'/C + N = 0: with C = 1/(2 zeta), N lasts pi/sqrt(1 - zeta^2) and
    /// the mass leaves with exp(-zeta pi/sqrt(1 - zeta^2)) of its speed.
    #[test]
    fn a_maxwell_unit_rebounds_as_in_closed_form() {
        for zeta in [0.1_f64, 0.3, 0.6] {
            let root = (1.0 - zeta * zeta).sqrt();
            let landing = land(1e-9, 0.5 / zeta, 1e-7).unwrap();
            let (lift, rebound) =
                (std::f64::consts::PI / root, (-zeta * std::f64::consts::PI / root).exp());
            // both are missed by the order of the absorber's mass, over C
            assert!(
                (landing.lift / lift - 1.0).abs() < 1e-5
                    && (landing.rebound / rebound - 1.0).abs() < 1e-5,
                "{zeta}"
            );
        }
    }

    /// Rigid absorber: half a period, and all of the speed comes back.
    #[test]
    fn a_fixed_absorber_gives_all_back() {
        let landing = land(1e9, 1.0, 1.0).unwrap();
        assert!(
            (landing.rebound - 1.0).abs() < 1e-6
                && (landing.lift - std::f64::consts::PI).abs() < 1e-6
        );
    }

    /// Measured by an independent program (matrix exponentials in Python): first lift and its
    /// speed.
    #[test]
    fn rebounds_are_those_of_an_independent_program() {
        for (k, c, mu, lift, rebound) in [
            (0.02, 0.55, 0.665, 2.44, 0.0183),
            (0.05, 0.6, 0.66, 2.50, 0.0437),
            (0.1, 0.643, 0.675, 2.57, 0.0800),
        ] {
            let landing = land(k, c, mu).unwrap();
            assert!(
                (landing.lift - lift).abs() < 0.01 && (landing.rebound - rebound).abs() < 1e-4,
                "{landing:?}"
            );
        }
    }

    #[test]
    fn derivatives_through_the_lift_agree_with_finite_differences() {
        let at = |k: f64, c: f64, mu: f64| land(k, c, mu).unwrap();
        let dual = |x: f64, on: bool| {
            if on { Dual64::from_re(x).derivative() } else { Dual64::from_re(x) }
        };
        let z = [0.05, 0.62, 0.66];
        for i in 0..3 {
            let d = land(dual(z[0], i == 0), dual(z[1], i == 1), dual(z[2], i == 2)).unwrap();
            let shifted = |h: f64| {
                let mut z = z;
                z[i] += h;
                at(z[0], z[1], z[2])
            };
            let (up, down) = (shifted(1e-5), shifted(-1e-5));
            for (exact, slope) in [
                (d.rebound.eps, (up.rebound - down.rebound) / 2e-5),
                (d.clearance.eps, (up.clearance - down.clearance) / 2e-5),
                (d.lift.eps, (up.lift - down.lift) / 2e-5),
            ] {
                assert!(
                    (exact - slope).abs() < 1e-6 * exact.abs().max(1.0),
                    "{i}: {exact} {slope}"
                );
            }
            assert!((d.rebound.re - at(z[0], z[1], z[2]).rebound).abs() < 1e-12);
        }
    }
}
