//! The vertical chain of a footing whose landing stops both corners.
//!
//! Such a footing comes to rest as two masses in one: that of its heave and that of its turning, both on the same units. No chain suits both as
//! `universal` suits one, so that mu and C are sought on the landing itself (`plane`): the least energy that is left in other motions, among
//! the chains on which each corner lifts once and neither is touched again by its absorber.

use argmin::{
    core::{CostFunction, Error, Executor},
    solver::neldermead::NelderMead,
};

use super::{
    corners::Corners,
    plane::{PlaneLanding, land},
};
use crate::spring::{Design, Springs};

/// Touches and lifts of a landing that is over once both corners have lifted: the touch itself and two lifts.
const FEWEST: usize = 3;
/// What one change of contact more costs, over the energy left.
const CHANGE: f64 = 10.0;
/// Where the search begins: ln of mu and C over those of a single mass, in triangles about heavier dashpots and lighter absorbers.
const STARTS: [[f64; 2]; 3] = [[-0.5, 0.4], [-0.2, 0.4], [-0.5, 0.2]];
/// Steps of the search, and the spread of the energies at which it ends.
const STEPS: u64 = 60;
const SPREAD: f64 = 1e-9;

/// Factors on mu and C.
struct Search<F>(F);

impl<F: Fn(&[f64]) -> f64> CostFunction for Search<F> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        Ok((self.0)(x))
    }
}

/// These springs with mu and C of their vertical units as the landing wants them.
pub fn for_stopping(corners: &Corners<f64>, springs: &Springs<Design<f64>>) -> Springs<Design<f64>> {
    let Design { mu, omega_n_hz, .. } = springs.vertical;
    let (k, c) = (springs.vertical.k(), springs.vertical.c());
    let at =
        |x: &[f64]| Springs { vertical: Design::from_kc(mu * x[0].exp(), k, c * x[1].exp(), omega_n_hz), ..*springs };
    let cost = |x: &[f64]| {
        let PlaneLanding { deviation, changes, .. } = land(corners, &at(x));
        deviation * (1.0 + CHANGE * changes.iter().sum::<usize>().saturating_sub(FEWEST) as f64)
    };
    let simplex = STARTS.map(|x| x.to_vec()).to_vec();
    let found = NelderMead::new(simplex)
        .with_sd_tolerance(SPREAD)
        .and_then(|solver| Executor::new(Search(cost), solver).configure(|state| state.max_iters(STEPS)).run());
    found.ok().and_then(|result| result.state.best_param).map_or(*springs, |x| at(&x))
}
