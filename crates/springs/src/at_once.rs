//! Springs from the geometry alone, before anything is searched: those that the ladder of Omega_n
//! begins with.

use super::stiffness_search;
use cases::Asked;
use dynamics::{
    compare::LEAST_LEAN,
    spring::{Design, Springs},
};
use landing::{
    design::{Geometry, springs_at_stiffness},
    weight,
};
use rocking::structure::Body;
use validation::PREDICTABLE;

/// Softest Omega_n/p whose gentlest landing error, times 150, stays within the target, no stiffer
/// than `stiffest`. 150 is the largest sensitivity of a predictable history.
pub(super) fn softest(body: &Body<f64>, asked: Asked, stiffest: f64) -> f64 {
    let error = stiffness_search::MARGIN * asked.error / PREDICTABLE;
    let by_weight = Geometry::of(body, stiffness_search::SOFTEST)
        .map(|body| weight::stiffness(body.alpha(), body.mass_share(), error, LEAST_LEAN));
    by_weight
        .unwrap_or(stiffness_search::SOFTEST)
        .clamp(stiffness_search::SOFTEST, stiffest.max(stiffness_search::SOFTEST))
}

/// Springs for a body within milliseconds: their landings hold the error asked for; the sway before
/// uplift is not looked at. None of a geometry that there are no springs for.
pub fn springs_at_once(body: &Body<f64>, asked: Asked) -> Option<Springs<Design<f64>>> {
    springs_at_stiffness(body, softest(body, asked, f64::INFINITY))
}

#[cfg(test)]
mod tests {
    use super::*;
    use landing::weight::restitution_error;
    use rocking::structure::Structure;

    #[test]
    fn the_gentlest_landing_holds_the_error_asked_for() {
        for (structure, error) in
            [(Structure::paper(), 0.002), (Structure::block(2.0, 0.5, 1e3).unwrap(), 0.01)]
        {
            let body = structure.body::<f64>();
            let springs = springs_at_once(&body, Asked::new(error, None)).unwrap();
            let stiffness = std::f64::consts::TAU * springs.vertical.omega_n_hz / body.p();
            let landing = restitution_error(body.alpha(), body.mass_share(), stiffness, LEAST_LEAN);
            assert!(landing * PREDICTABLE <= 0.7 * error * (1.0 + 1e-9), "{landing}");
        }
    }
}
