//! The equations of motion of a structure, by finite differences of its energies and places: for
//! every kind of structure the same.

use frames::{Mechanics, Pier};
use nalgebra::{DMatrix, DVector};

use crate::piers::light;
use crate::portal::Portal;
use crate::random::Random;

/// Step of the central differences, and the share of a force that they may miss.
const STEP: f64 = 1e-5;
const SHARE: f64 = 2e-7;

fn difference<T: std::ops::Sub<Output = T> + std::ops::Mul<f64, Output = T>>(
    x: &DVector<f64>,
    direction: &DVector<f64>,
    f: impl Fn(&DVector<f64>) -> T,
) -> T {
    (f(&(x + direction * STEP)) - f(&(x - direction * STEP))) * (0.5 / STEP)
}

fn unit(n: usize, i: usize) -> DVector<f64> {
    DVector::from_fn(n, |k, _| if k == i { 1.0 } else { 0.0 })
}

/// Q without dampers is Lagrange's: -(dM/dt) q' + d(q' M q'/2)/dq - dV/dq; `free` is the structure
/// without its dampers.
fn lagrange(damped: &impl Mechanics, free: &impl Mechanics, q: &DVector<f64>, v: &DVector<f64>) {
    let n = free.size();
    let mass: DMatrix<f64> = difference(q, v, |q| free.mass(q));
    let mut expected = -(mass * v);
    for i in 0..n {
        expected[i] += difference(q, &unit(n, i), |q| free.kinetic(q, v) - free.potential(q));
    }
    let still = [0.0; 2];
    let force = free.force(q, v, still);
    assert!((&force - &expected).amax() < SHARE * expected.amax(), "{force} {expected}");
    // dampers take what they say, and nothing at rest
    let dampers = damped.force(q, v, still) - &force;
    let taken = damped.dissipation(q, v);
    assert!(
        (dampers.dot(v) + taken).abs() <= 1e-9 * taken.max(1e-9 * force.dot(v).abs()),
        "{taken}"
    );
    // the ground's share is its power
    let ground = [1.3, -0.7];
    let power = (free.force(q, v, ground) - force).dot(v);
    assert!((power - free.input_power(q, v, ground)).abs() < 1e-8 * power.abs());
}

/// Tangents, Jacobians of the corners and their accelerations by differences.
fn kinematics(structure: &impl Mechanics, q: &DVector<f64>, v: &DVector<f64>) {
    let (n, ground) = (structure.size(), [0.4, 0.9]);
    let [stiffness, damping] = structure.tangent(q, v, ground);
    for j in 0..n {
        let by_place = -difference(q, &unit(n, j), |q| structure.force(q, v, ground));
        let by_rate = -difference(v, &unit(n, j), |v| structure.force(q, v, ground));
        assert!((stiffness.column(j) - &by_place).amax() < SHARE * stiffness.amax());
        assert!((damping.column(j) - &by_rate).amax() < SHARE * damping.amax());
    }
    for i in 0..structure.footings().len() {
        let corner = structure.corner(i, q, v);
        for direction in 0..2 {
            let row = &corner.jacobian[direction];
            for j in 0..n {
                let column =
                    difference(q, &unit(n, j), |q| structure.corner(i, q, v).place[direction]);
                assert!(
                    (row[j] - column).abs() < 1e-8 * (1.0 + row.amax()),
                    "corner {i} {direction} {j}"
                );
            }
            let bias = difference(q, v, |q| structure.corner(i, q, v).jacobian[direction].dot(v));
            assert!((corner.bias[direction] - bias).abs() < 1e-8 * (1.0 + bias.abs()));
        }
    }
    let standing = structure.corner(0, &DVector::zeros(n), &DVector::zeros(n));
    assert_eq!((standing.place, structure.potential(&DVector::zeros(n))), ([0.0; 2], 0.0));
}

#[test]
fn piers_of_every_column_obey_lagrange() {
    let mut random = Random::new(7);
    let undamped = |pier: &Pier| {
        let axial = pier.axial.map(|axial| frames::Axial { damping: 0.0, ..axial });
        Pier { damping: 0.0, axial, ..*pier }
    };
    for pier in
        [light(), light().with_axial(4e8, 0.1), light().with_axial(4e8, 0.1).with_chord(11.0)]
    {
        for _ in 0..20 {
            let scales = [0.5, 0.5, 0.6, 0.5, 0.2];
            let q = DVector::from_fn(pier.size(), |i, _| random.within(-scales[i], scales[i]));
            let v = DVector::from_fn(pier.size(), |_, _| random.within(-1.0, 1.0));
            lagrange(&pier, &undamped(&pier), &q, &v);
            kinematics(&pier, &q, &v);
        }
    }
}

#[test]
fn the_portal_obeys_lagrange() {
    let mut random = Random::new(8);
    let (portal, free) = (Portal::default(), Portal { damping: 0.0, ..Portal::default() });
    for _ in 0..20 {
        let q = DVector::from_fn(6, |_, _| random.within(-0.3, 0.3));
        let v = DVector::from_fn(6, |_, _| random.within(-1.0, 1.0));
        lagrange(&portal, &free, &q, &v);
        kinematics(&portal, &q, &v);
    }
}

/// theory.md, section 9: T and V of the pier that turns about its corner s b, in theta and u.
#[test]
fn a_pier_on_one_corner_has_the_energies_of_theory() {
    let (pier, g) = (light(), 9.81);
    for s in [-1.0, 1.0] {
        let (theta, u, w, du) = (0.07 * s, 0.013, 0.31, -0.23);
        let (sin, cos) = f64::sin_cos(theta);
        let pivot = s * pier.half_width;
        let q = DVector::from_vec(vec![pivot * (1.0 - cos), pivot * sin, theta, u]);
        let v = DVector::from_vec(vec![pivot * sin * w, pivot * cos * w, w, du]);
        let arm = pivot - u;
        let (m, m_b, h, h_b) = (pier.mass, pier.footing_mass, pier.height, pier.footing_height);
        let about_corner = pier.footing_inertia + m_b * (pivot * pivot + h_b * h_b);
        let kinetic =
            0.5 * m * ((du + h * w).powi(2) + (arm * w).powi(2)) + 0.5 * about_corner * w * w;
        let potential = m * g * (arm * sin + h * (cos - 1.0))
            + m_b * g * (pivot * sin + h_b * (cos - 1.0))
            + 0.5 * pier.stiffness * u * u;
        assert!((pier.kinetic(&q, &v) / kinetic - 1.0).abs() < 1e-13);
        assert!((pier.potential(&q) / potential - 1.0).abs() < 1e-12);
    }
}
