//! One chain for every landing: C_u(K) and mu_u(K), the least rebound of a mass on a
//! spring-absorber unit whose absorber does not come back to touch (`chain`).

use argmin::{
    core::{CostFunction, Error, Executor},
    solver::brent::BrentOpt,
};
use num_dual::Dual64;

use super::chain;

/// Least K for which mu_u is sought: below it the rebound hardly depends on mu along the line of
/// chains that graze, so that the least wanders, and mu_u stays what it is here.
const K_FLAT: f64 = 0.04;
/// Where mu_u and C_u may lie.
const MU: (f64, f64) = (0.45, 1.1);
const C: (f64, f64) = (0.1, 2.0);

/// The one-dimensional chain of a K.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Universal {
    pub k: f64,
    /// C_u.
    pub c: f64,
    /// mu_u.
    pub mu: f64,
    /// Speed with which the mass leaves, over the landing speed.
    pub rebound: f64,
}

/// C_u(K) and mu_u(K): least rebound among the chains whose absorber does not come back to touch.
pub fn universal(k: f64) -> Universal {
    struct Rebound(f64);
    impl CostFunction for Rebound {
        type Param = f64;
        type Output = f64;
        fn cost(&self, mu: &f64) -> Result<f64, Error> {
            Ok(grazing(self.0, *mu).rebound)
        }
    }
    let run =
        Executor::new(Rebound(k.max(K_FLAT)), BrentOpt::new(MU.0, MU.1).set_tolerance(1e-5, 1e-7))
            .configure(|state| state.max_iters(60))
            .run();
    let mu = run.ok().and_then(|result| result.state.best_param).unwrap_or(0.5 * (MU.0 + MU.1));
    grazing(k, mu)
}

/// The least damping with which the absorber of this K and mu does not come back: it just grazes
/// (Newton's method with the derivative of the least distance, within a bracket).
fn grazing(k: f64, mu: f64) -> Universal {
    let (mut low, mut high) = C;
    let mut c = 0.6;
    let mut rebound = 1.0;
    for _ in 0..60 {
        let landing =
            chain::land(Dual64::from_re(k), Dual64::from_re(c).derivative(), Dual64::from_re(mu));
        let Some(landing) = landing else {
            // it stays on the ground: too much of a dashpot it is not
            low = c;
            c = 0.5 * (low + high);
            continue;
        };
        rebound = landing.rebound.re;
        let clearance = landing.clearance;
        if clearance.re >= 0.0 {
            high = c;
        } else {
            low = c;
        }
        let newton = c - clearance.re / clearance.eps;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let arrived = (next - c).abs() < 1e-13;
        c = next;
        if arrived {
            break;
        }
    }
    Universal { k, c, mu, rebound }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Table of an independent prototype: C_u and mu_u at a flat optimum, and the rebound.
    #[test]
    fn the_universal_chain_is_that_of_the_prototype() {
        for (k, c, mu, rebound) in [
            (0.02, 0.55, 0.665, 0.018),
            (0.05, 0.60, 0.66, 0.043),
            (0.1, 0.643, 0.675, 0.080),
            (0.2, 0.647, 0.77, 0.140),
        ] {
            let found = universal(k);
            println!("{found:?}");
            // the optimum is flat along a valley of mu and C: C mu^(2/3) hardly changes there
            assert!(found.rebound <= rebound + 0.001, "{found:?}");
            assert!(
                (found.mu / mu - 1.0).abs() < 0.15 && (found.c / c - 1.0).abs() < 0.2,
                "{found:?}"
            );
        }
    }

    #[test]
    fn the_absorber_grazes_and_no_more() {
        for k in [0.003, 0.01, 0.04, 0.15, 0.4] {
            let Universal { c, mu, .. } = universal(k);
            let clearance = |c: f64| chain::land(k, c, mu).unwrap().clearance;
            println!("{k} {c} {mu} {}", clearance(c));
            assert!(
                clearance(c).abs() < 1e-9 && clearance(1.02 * c) > 0.0 && clearance(0.98 * c) < 0.0
            );
        }
    }
}
