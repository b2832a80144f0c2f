//! Springs for a part of an elastic structure that lands: a footing, a foot.
//!
//! **Horizontal units.** Such a part comes in sideways, too, and lifts as soon as it has landed:
//! its horizontal units stop it by then. They are the unit on which a mass that it holds comes to
//! rest soonest, four equal poles, for the mass that the corner feels across:
//!
//! ```text
//!   mu s^4 + C s^3 + (1 + K + mu) s^2 + C s + K = mu (s + 1)^4:    K = 1/4, mu = 1/4, C = 1
//! ```
//!
//! **The vertical chain** is sought on the landing itself (`plane`), about the universal one for
//! the mass under the corner: that one knows neither the horizontal units nor the other corner, and
//! a footing whose landing stops both corners comes to rest as two masses, its heave and its
//! turning, on the same units. Sought are mu and C with the least energy left in other motions,
//! among the chains on which each corner lifts once and neither is touched again by its absorber. A
//! chain counts as the worse of itself and of one with a heavier absorber and dashpot: the least
//! energy lies where the absorber just misses the foot, and under the weight of the structure,
//! which presses the foot back, it then meets it again and again.

use argmin::{
    core::{CostFunction, Error, Executor},
    solver::neldermead::NelderMead,
};
use nalgebra::Vector2;

use super::{
    corners::CornerDynamics,
    plane::{PlaneLanding, land},
    universal::{Universal, universal},
};
use dynamics::spring::{Design, Springs};

/// K = mu and C of the horizontal units.
const DEAD_K: f64 = 0.25;
const DEAD_C: f64 = 1.0;
/// How much faster the horizontal units are: when the foot lifts, 2.3/Omega_n after its touch, they
/// have left 9e-4 of its speed. Twice as fast, they would cost more touches and follow no better.
const FASTER: f64 = 6.0;
/// By how much heavier the absorber and the dashpot may come out.
const HEAVIER: f64 = 1.2;
/// Touches and lifts of a landing that is over once both corners have lifted: the touch itself and
/// two lifts.
const FEWEST: usize = 3;
/// What one change of contact more costs, over the energy left.
const CHANGE: f64 = 10.0;
/// Where the search begins: ln of mu and C over those of the universal chain, a triangle of heavier
/// dashpots and lighter absorbers.
const STARTS: [[f64; 2]; 3] = [[-0.9, 0.1], [-0.6, 0.1], [-0.9, 0.25]];
/// Steps of the search, and the spread of the energies at which it ends.
const STEPS: u64 = 60;
const SPREAD: f64 = 1e-9;

/// Factors on mu and C.
struct Search<F>(F);

impl<F: Fn(Vector2<f64>) -> f64> CostFunction for Search<F> {
    type Param = Vector2<f64>;
    type Output = f64;

    fn cost(&self, x: &Vector2<f64>) -> Result<f64, Error> {
        Ok((self.0)(*x))
    }
}

/// Springs for a part of an elastic structure that lands on these corners, in units of its mass, at
/// K; frequencies relative to the vertical Omega_n.
pub fn for_part(corners: &CornerDynamics, k: f64) -> Springs<Design<f64>> {
    let m = corners.effective_mass()[1];
    // free to turn: the horizontal units are the faster ones
    let across = corners.w[2][2].recip();
    let Universal { k, c, mu, .. } = universal(k);
    let springs = Springs {
        vertical: Design::from_kc(mu * m, k, c * m.sqrt(), 1.0),
        horizontal: Design::from_kc(
            DEAD_K * across,
            DEAD_K,
            DEAD_C * across.sqrt(),
            FASTER * (across / m).sqrt(),
        ),
    };
    sought(corners, &springs)
}

/// These springs with mu and C of their vertical units as the landing wants them.
fn sought(corners: &CornerDynamics, springs: &Springs<Design<f64>>) -> Springs<Design<f64>> {
    let Design { mu, omega_n_hz, .. } = springs.vertical;
    let (k, c) = (springs.vertical.k(), springs.vertical.c());
    let at = |x: Vector2<f64>| Springs {
        vertical: Design::from_kc(mu * x[0].exp(), k, c * x[1].exp(), omega_n_hz),
        ..*springs
    };
    let left = |x: Vector2<f64>| {
        let PlaneLanding { deviation, changes, .. } = land(corners, &at(x));
        deviation * (1.0 + CHANGE * changes.iter().sum::<usize>().saturating_sub(FEWEST) as f64)
    };
    let cost = |x: Vector2<f64>| f64::max(left(x), left(x.add_scalar(HEAVIER.ln())));
    let simplex = STARTS.map(Vector2::from).to_vec();
    let found = NelderMead::new(simplex).with_sd_tolerance(SPREAD).and_then(|solver| {
        Executor::new(Search(cost), solver).configure(|state| state.max_iters(STEPS)).run()
    });
    found.ok().and_then(|result| result.state.best_param).map_or(*springs, at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::for_landing;

    /// W of a free block of half width b and half height h, over 1/m.
    fn block(b: f64, h: f64) -> CornerDynamics {
        let inertia = (b * b + h * h) / 3.0;
        let g = [[1.0, 0.0, -h], [0.0, 1.0, b], [1.0, 0.0, -h], [0.0, 1.0, -b]];
        let w = |i: usize, j: usize| {
            (0..2).map(|k| g[i][k] * g[j][k]).sum::<f64>() + g[i][2] * g[j][2] / inertia
        };
        CornerDynamics::of(std::array::from_fn(|i| std::array::from_fn(|j| w(i, j))), 2.0 * b)
    }

    /// Footings of any proportion, at any K: three changes of contact; where both corners stop,
    /// less energy left than on the universal chain. Where one stops, that chain may leave less,
    /// and is touched again.
    #[test]
    fn a_landing_is_over_once_both_corners_have_lifted() {
        for (b, h, stops) in [
            (2.0, 0.4, true),
            (2.0, 1.0, true),
            (5.0, 0.5, true),
            (2.0, 2.0, false),
            (2.0, 4.0, false),
            (1.0, 8.0, false),
        ] {
            for k in [0.01, 0.05, 0.2] {
                let corners = block(b, h);
                let universal =
                    land(&corners, &for_landing(&corners, corners.effective_mass()[1], k));
                let sought = land(&corners, &for_part(&corners, k));
                assert!(corners.stops() == stops && sought.complete);
                assert!(sought.changes.iter().sum::<usize>() <= FEWEST, "{b} {h} {k}: {sought:?}");
                if stops {
                    assert!(
                        sought.deviation < universal.deviation,
                        "{b} {h} {k}: {sought:?} {universal:?}"
                    );
                }
            }
        }
    }
}
