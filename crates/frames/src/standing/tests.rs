use super::*;
use crate::Pier;
use approx::assert_relative_eq;

fn pier() -> Pier {
    Pier::new([6e5, 12.0, 2.0], [2.0, 0.02], [1.2e5, 0.75])
}

fn standing(pier: &Pier) -> Standing {
    Standing::new(pier, &DVector::zeros(pier.size())).unwrap()
}

/// With an elastic column what lands is the footing alone, a rigid block: W of one, whatever stands
/// on it.
#[test]
fn under_an_elastic_column_the_footing_lands_alone() {
    let pier = pier().with_axial(4e9, 0.02);
    let standing = standing(&pier);
    let [b, h, i] = [pier.half_width, pier.footing_height, pier.footing_inertia];
    let g = [[1.0, 0.0, -h], [0.0, 1.0, b], [1.0, 0.0, -h], [0.0, 1.0, -b]];
    for row in 0..4 {
        for column in 0..4 {
            let by_hand = (g[row][0] * g[column][0] + g[row][1] * g[column][1]) / pier.footing_mass
                + g[row][2] * g[column][2] / i;
            assert!(
                (standing.footings[0].w[(row, column)] - by_hand).abs() < 1e-12 * 1e-3,
                "{row} {column}"
            );
        }
    }
    assert_relative_eq!(standing.footings[0].width, 4.0, max_relative = 1e-12);
    assert_relative_eq!(standing.mass, 720e3, max_relative = 1e-12);
}

/// Of a light footing, k h^2/(2 b^2 k_v) + k/(2 k_h); the weight, displaced by u, adds m g u to the
/// moment k u h.
#[test]
fn the_compliance_ratio_of_a_pier_is_that_of_the_formula() {
    let pier = Pier { footing_mass: 1e-3, footing_inertia: 1e-3, ..pier() };
    let [sideways, _] = standing(&pier).responses;
    let (k_h, k_v) = (3e12, 1e12);
    let arm = 12.0 + pier.mass * rocking::scalar::GRAVITY / pier.stiffness;
    let formula = pier.stiffness * (arm * arm / (2.0 * 4.0 * k_v) + 0.5 / k_h);
    assert_relative_eq!(sideways.compliance_ratio([k_h, k_v]), formula, max_relative = 1e-8);
    assert_relative_eq!(sideways.omega, std::f64::consts::TAU * 2.0, max_relative = 1e-8);
}

/// Upwards the column's k_a against two springs.
#[test]
fn the_give_along_the_column_is_that_of_springs_in_series() {
    let pier = Pier { footing_mass: 1e-3, footing_inertia: 1e-3, ..pier() }.with_axial(4e9, 0.02);
    let [_, upwards] = standing(&pier).responses;
    assert_relative_eq!(upwards.compliance_ratio([3e12, 1e12]), 4e9 / 2e12, max_relative = 1e-6);
    assert_relative_eq!(upwards.omega, (4e9_f64 / 6e5).sqrt(), max_relative = 1e-6);
}

/// About the edge: (m + m_f) g b = a (m h + m_f h_f) + m g u, where the column gives u = m a/k.
#[test]
fn a_pier_lifts_where_statics_say() {
    let pier = pier();
    let lift = standing(&pier).uplift().unwrap();
    let g = rocking::scalar::GRAVITY;
    let holds = (pier.mass + pier.footing_mass) * g * pier.half_width;
    let by = pier.mass * pier.height
        + pier.footing_mass * pier.footing_height
        + pier.mass.powi(2) * g / pier.stiffness;
    assert_relative_eq!(lift, holds / by, max_relative = 1e-8);
}

/// A portal of stiff columns L between footings w wide and t thick, S apart, under a stiff beam of
/// weight W: under F at the beam each sole bears F L/4 + F t/2 and F L/(2 S) up or down, and its
/// outer corner bore W/4.
#[test]
fn a_portal_lifts_where_statics_say() {
    let (l, t, w, s, mass) = (8.0, 1.0, 2.5, 9.0, 4e5);
    let text = format!(
        "kind = 'frame'\nheight_m = {}\nspan_m = {s}\nfooting_width_m = {w}\n\
         footing_height_m = {t}\n\
         footing_mass_kg = 100.0\nbeam_mass_kg = {mass}\ncolumn_ea_n = 1e13\ncolumn_ei_nm2 = 1e12\n\
         beam_ea_n = 1e15\n\
         beam_ei_nm2 = 1e15\ndamping_ratio = 0.02\n",
        l + t
    );
    let structure: crate::structure::ElasticStructure = toml::from_str(&text).unwrap();
    let portal = crate::assembled::Assembled::new(structure.checked().unwrap()).unwrap();
    let weight = mass * rocking::scalar::GRAVITY;
    let a_unit = (l / 4.0 + t / 2.0) / w + l / (4.0 * s);
    assert_relative_eq!(
        portal.uplift_g().unwrap(),
        weight / 4.0 / a_unit / weight,
        max_relative = 2e-3
    );
}

/// (1 + e)^2 - (1 + 2 e) is 0 where each product is rounded, and e^2 where one is fused into the
/// sum, as the operator's product of matrices of this size is on processors that can.
#[test]
fn products_are_the_same_on_every_machine() {
    let e = 2.0_f64.powi(-30);
    let n = 8;
    let a = DMatrix::from_fn(n, n, |_, k| [-1.0, 1.0 + e].get(k).copied().unwrap_or(0.0));
    let b = DMatrix::from_fn(n, n, |k, _| [1.0 + 2.0 * e, 1.0 + e].get(k).copied().unwrap_or(0.0));
    assert!(product(&a, &b).iter().all(|entry| *entry == 0.0));
    let shifted = product(&DMatrix::identity(n, n).scale(3.0), &b);
    assert!(shifted.iter().zip(b.iter()).all(|(x, b)| *x == 3.0 * b));
}

/// Of a matrix of full rank a^+ a = 1; of columns alike each bears a half.
#[test]
fn a_pseudo_inverse_shares_what_is_redundant() {
    let a = DMatrix::from_row_slice(3, 2, &[1.0, 2.0, 0.0, 1.0, -1.0, 3.0]);
    let one = product(&pseudo_inverse(a.clone(), 1e-9).unwrap(), &a);
    assert_relative_eq!(one, DMatrix::identity(2, 2), epsilon = 1e-14);
    let alike = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 2.0, 2.0]);
    let expected = DMatrix::from_row_slice(2, 2, &[0.1, 0.2, 0.1, 0.2]);
    assert_relative_eq!(pseudo_inverse(alike, 1e-9).unwrap(), expected, epsilon = 1e-14);
}
