use super::*;
use crate::universal::universal;
use approx::assert_relative_eq;
use frames::{Pier, standing::Standing};
use nalgebra::DVector;

/// Units of the universal chain at K for what lands, horizontals `ratio` as stiff in frequency.
fn designed(corners: &CornerDynamics, k: f64, ratio: f64) -> Springs<Design<f64>> {
    let chain = universal(k);
    let [_, m] = corners.effective_mass();
    Springs {
        vertical: Design::from_kc(chain.mu * m, k, chain.c * m.sqrt(), 1.0),
        horizontal: Design::from_kc(0.3, 1.0, 2.0, ratio),
    }
}

/// Of any W: the same as by the closed forms of the rigid body.
#[test]
fn a_rigid_body_is_what_its_w_says() {
    for (alpha, share) in [(0.05_f64, 0.75), (0.2, 0.9), (0.5, 0.6), (0.9, 0.75), (1.2, 0.75)] {
        let body = CornerDynamics::rigid(alpha, share);
        let by_w = CornerDynamics::of(body.w, body.width);
        assert_relative_eq!(by_w.rate, body.rate, max_relative = 1e-10);
        assert_relative_eq!(by_w.momentum, body.momentum, max_relative = 1e-10);
        assert_relative_eq!(
            body.effective_mass()[1],
            1.0 - share * alpha.sin().powi(2),
            max_relative = 1e-12
        );
        // equation 2: where it is positive the old foot lifts, else both corners stop the body
        let restitution = 1.0 - 2.0 * share * alpha.sin().powi(2);
        assert_eq!(body.stops(), restitution < 0.0, "{alpha}");
    }
}

/// A wide footing of mass m, width 2b: both corners share its momentum m v/2, and its rotation
/// stops, J_new - J_old = I/(2b) v/2b over b.
#[test]
fn a_wide_footing_lands_on_both_corners() {
    let body = CornerDynamics::rigid(1.2, 0.75);
    let (b, h): (f64, f64) = (1.2_f64.sin(), 1.2_f64.cos());
    // about the middle of the sole; the body turns at 1/(2b), its centre moves at 1/2 downwards and
    // h/(2b) across
    let inertia = 1.0 / 3.0 + h * h;
    let sum = 0.5;
    let difference = inertia / (2.0 * b) / b;
    assert_relative_eq!(body.plastic[3], 0.5 * (sum + difference), max_relative = 1e-12);
    assert_relative_eq!(body.plastic[1], 0.5 * (sum - difference), max_relative = 1e-12);
    assert!(body.plastic[1] > 0.0);
}

/// One chain, scaled by the effective mass, serves what tips over its new corner and what stops on
/// both: what it adds to the plastic landing falls with K as the square of the chain's own rebound.
#[test]
fn the_universal_chain_lands_rigid_bodies_and_footings() {
    for alpha in [0.1_f64, 0.4, 0.785, 1.0, 1.2, 1.4] {
        let corners = CornerDynamics::rigid(alpha, 0.75);
        for k in [0.02, 0.1, 0.4] {
            let landing = land(&corners, &designed(&corners, k, 4.0));
            let rebound = universal(k).rebound;
            assert!(landing.complete, "{alpha} {k}");
            // stiffer horizontals would take the small constant away
            assert!(landing.deviation < 5.0 * rebound * rebound + 5e-3, "{alpha} {k}: {landing:?}");
        }
    }
}

/// Under an elastic column, whatever its mass: the footing's own block, in its own units.
#[test]
fn a_footing_under_a_column_lands_as_the_block_that_it_is() {
    for height in [0.75, 4.0] {
        let pier = Pier::new([6e5, 12.0, 2.0], [2.0, 0.02], [1.2e5, height]).with_axial(4e9, 0.02);
        let standing = Standing::new(&pier, &DVector::zeros(5)).unwrap();
        let w = &standing.footings[0].w;
        let radius = height.hypot(2.0);
        let block = CornerDynamics::rigid((2.0 / height).atan(), 0.75);
        let own = CornerDynamics::of(
            std::array::from_fn(|i| std::array::from_fn(|j| w[(i, j)] * 1.2e5)),
            4.0 / radius,
        );
        for (own, block) in own.w.iter().flatten().zip(block.w.iter().flatten()) {
            assert!((own - block).abs() < 1e-12, "{own} {block}");
        }
        let (own, block) =
            (land(&own, &designed(&own, 0.1, 4.0)), land(&block, &designed(&block, 0.1, 4.0)));
        assert!((own.deviation - block.deviation).abs() < 1e-9);
    }
}
