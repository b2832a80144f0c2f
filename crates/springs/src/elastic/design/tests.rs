use super::*;
use crate::elastic::stand;
use approx::assert_relative_eq;
use frames::{Pier, assembled::Assembled};
use nalgebra::DVector;

fn standing() -> Standing {
    let pier = Pier::new([6e5, 12.0, 2.0], [2.0, 0.02], [6e4, 0.75]).with_axial(4e9, 0.02);
    Standing::new(&pier, &DVector::zeros(5)).unwrap()
}

/// The units that a free block of half width b and half height h, (b^2 + h^2)/3 = I/m, would have,
/// its mass 1. Across, its corner feels 1/W_xx = m/(1 + h^2/(I/m)), and stops by four equal poles.
#[test]
fn units_are_those_of_the_footing_alone() {
    let pier = Pier::new([6e5, 12.0, 2.0], [2.0, 0.02], [6e4, 1.8]).with_axial(4e9, 0.02);
    let springs = with_k(&Standing::new(&pier, &DVector::zeros(5)).unwrap(), 1e-4, 0.1);
    let (b, h) = (4.0, 1.8 * 1.8);
    let inertia = (b + h) / 3.0;
    let g = [[1.0, 0.0, -1.8], [0.0, 1.0, 2.0], [1.0, 0.0, -1.8], [0.0, 1.0, -2.0]];
    let w =
        |i: usize, j: usize| g[i][0] * g[j][0] + g[i][1] * g[j][1] + g[i][2] * g[j][2] / inertia;
    let block = CornerDynamics::of(std::array::from_fn(|i| std::array::from_fn(|j| w(i, j))), 4.0);
    let vertical = for_part(&block, 0.1).vertical;
    let across = 6e4 / (1.0 + h / ((b + h) / 3.0));
    for corner in &springs.corners {
        let unit = corner.vertical;
        assert_relative_eq!(unit.k2, 0.1 * unit.k1, max_relative = 1e-12);
        // the search for both ends within rounding of each other, in its own tolerance
        assert_relative_eq!(unit.m2, vertical.mu * 6e4, max_relative = 1e-6);
        assert_relative_eq!(unit.c, vertical.c() * (unit.k1 * 6e4).sqrt(), max_relative = 1e-6);
        let unit = corner.horizontal;
        assert_relative_eq!(unit.k2, unit.k1 / 4.0, max_relative = 1e-9);
        assert_relative_eq!(unit.m2, across / 4.0, max_relative = 1e-9);
        assert_relative_eq!(unit.c, (unit.k1 * across).sqrt(), max_relative = 1e-9);
        // (s + w)^4 with w^2 = k1/m: the polynomial of the mass on its unit, term by term
        let (m, w) = (across, (unit.k1 / across).sqrt());
        let all = [
            m * unit.m2,
            m * unit.c,
            m * (unit.k1 + unit.k2) + unit.k1 * unit.m2,
            unit.k1 * unit.c,
            unit.k1 * unit.k2,
        ];
        for (i, (term, binomial)) in all.into_iter().zip([1.0, 4.0, 6.0, 4.0, 1.0]).enumerate() {
            assert_relative_eq!(term / all[0], binomial * w.powi(i as i32), max_relative = 1e-9);
        }
    }
}

/// Ten times as stiff, a tenth of the compliance ratio; and the springs' compliance is more than
/// k1's alone.
#[test]
fn the_compliance_asked_for_is_that_of_k1() {
    let standing = standing();
    let [soft, stiff] =
        [1e-3, 1e-4].map(|compliance_ratio| with_k(&standing, compliance_ratio, 0.1));
    assert_relative_eq!(soft.compliance_ratio / stiff.compliance_ratio, 10.0, max_relative = 1e-9);
    assert_relative_eq!(
        stiff.corners[0].vertical.k1 / soft.corners[0].vertical.k1,
        10.0,
        max_relative = 1e-9
    );
    // k1 and K k1 in series: 1 + 1/K, and the horizontals
    assert!(
        stiff.compliance_ratio > 11e-4 && stiff.compliance_ratio < 12e-4,
        "{}",
        stiff.compliance_ratio
    );
}

/// A foot without a width: what lands is the foot's own mass, under massless legs.
#[test]
fn units_under_a_point_foot_are_those_of_its_mass() {
    let frame = toml::from_str(
        "kind = 'aframe'\nheight_m = 61.0\nwidth_m = 12.2\nmass_kg = 680.1e3\nfoot_mass_kg = 5e3\n\
         ea_n = 6.7e9\nei_nm2 = 1e10\ndamping_ratio = 0.02\n",
    )
    .unwrap();
    let standing = stand(&Assembled::new(frame).unwrap()).unwrap();
    let springs = with_k(&standing, 1e-4, 0.1);
    let mut alone = [[0.0; 4]; 4];
    (alone[2][2], alone[3][3]) = (1.0, 1.0);
    let vertical = for_part(&CornerDynamics::of(alone, 1.0), 0.1).vertical;
    assert_eq!(springs.corners.len(), 2);
    for corner in &springs.corners {
        let unit = corner.vertical;
        assert_relative_eq!(unit.m2, vertical.mu * 5e3, max_relative = 1e-6);
        assert_relative_eq!(unit.c, vertical.c() * (unit.k1 * 5e3).sqrt(), max_relative = 1e-6);
        let Chain { k1, k2, m2, c } = corner.horizontal;
        assert!(
            [k1, k2, m2, c].iter().all(|x| x.is_finite() && *x > 0.0),
            "{:?}",
            corner.horizontal
        );
    }
}

#[test]
fn k_falls_with_the_give_and_with_what_lands() {
    let light = standing();
    let heavy = Pier::new([2e5, 12.0, 2.0], [2.0, 0.02], [6e5, 1.0]).with_axial(4e9, 0.02);
    let heavy = Standing::new(&heavy, &DVector::zeros(5)).unwrap();
    let k = |standing: &Standing, compliance_ratio: f64| {
        springs(standing, compliance_ratio, 0.6, 1.0).k
    };
    let side = |compliance_ratio: f64| {
        k(&light, compliance_ratio).powi(2) * (k(&light, compliance_ratio) + BALANCE.turn)
    };
    assert_relative_eq!(side(1e-3) / side(1e-4), 10.0, max_relative = 1e-9);
    assert_relative_eq!(side(1e-4) / side(1e-7), 1e3, max_relative = 1e-9);
    assert!(k(&heavy, 1e-4) < 0.5 * k(&light, 1e-4));
}
