//! The ladder energy -> force -> Newton matrix, each rung the derivative of the one below.

use nalgebra::{SMatrix, SVector};
use num_complex::Complex;
use num_dual::Dual64;

use super::{body, contacts, springs, state};
use crate::{
    fem::{
        model::{Foot, Model, N, State, Vector},
        newton::Newton,
    },
    spring::{Chain, Springs},
};
use rocking::structure::Body;

fn dual_model(body: &Body<f64>, springs: &Springs<Chain<f64>>) -> Model<Dual64> {
    let d = Dual64::from_re;
    let Body { mass, half_width, height, inertia } = *body;
    let chain = |c: &Chain<f64>| Chain { k1: d(c.k1), k2: d(c.k2), m2: d(c.m2), c: d(c.c) };
    Model::new(
        &Body { mass: d(mass), half_width: d(half_width), height: d(height), inertia: d(inertia) },
        &Springs { vertical: chain(&springs.vertical), horizontal: chain(&springs.horizontal) },
    )
}

fn dual_feet(feet: &[Foot<f64>; 2]) -> [Foot<Dual64>; 2] {
    feet.map(|f| Foot { contact: f.contact, anchor: Dual64::from_re(f.anchor) })
}

/// A vector whose component j carries the derivative.
fn seeded(x: &Vector<f64>, j: usize) -> Vector<Dual64> {
    std::array::from_fn(|k| Dual64::new(x[k], if k == j { 1.0 } else { 0.0 }))
}

fn constant(x: &Vector<f64>) -> Vector<Dual64> {
    x.map(Dual64::from_re)
}

#[test]
fn forces_at_rest_are_the_slope_of_the_energy_in_every_contact() {
    for share in [0.0, 0.1] {
        let (model, dual) =
            (Model::new(&body(share), &springs()), dual_model(&body(share), &springs()));
        let at_rest = State { q: state().q, v: [0.0; N] };
        let weight = model.body.mass * 9.81;
        for feet in contacts() {
            let force = model.forces(&at_rest.q, &at_rest.v, &feet, [0.0; 2]);
            for (j, force) in force.iter().enumerate() {
                let seeded = State { q: seeded(&at_rest.q, j), v: constant(&at_rest.v) };
                let slope = dual.energy(&seeded, &dual_feet(&feet)).eps;
                // forces of some 1e2 weights, the moment with an arm of 60 m
                assert!((force + slope).abs() < 1e-9 * weight, "{feet:?} {j}: {force} {slope}");
            }
        }
    }
}

#[test]
fn forces_at_rest_are_the_slope_of_the_energy_by_finite_differences() {
    let model = Model::new(&body(0.1), &springs());
    let feet = contacts()[8];
    let force = model.forces(&state().q, &[0.0; N], &feet, [0.0; 2]);
    let energy = |j: usize, step: f64| {
        let mut s = State { q: state().q, v: [0.0; N] };
        s.q[j] += step;
        model.energy(&s, &feet)
    };
    for (j, force) in force.iter().enumerate() {
        let slope = (energy(j, 1e-5) - energy(j, -1e-5)) / 2e-5;
        assert!(
            (force + slope).abs() < 1e-6 * force.abs().max(model.body.mass),
            "{j}: {force} {slope}"
        );
    }
}

#[test]
fn power_of_ground_and_dashpots_is_the_power_of_the_forces() {
    let model = Model::new(&body(0.1), &springs());
    let State { q, v } = state();
    let ground = [3.3, -1.7];
    for feet in contacts() {
        let (all, without) =
            (model.forces(&q, &v, &feet, ground), model.forces(&q, &[0.0; N], &feet, [0.0; 2]));
        let power: f64 = (0..N).map(|k| (all[k] - without[k]) * v[k]).sum();
        let booked = model.input_power(&v, ground) - model.dissipation(&q, &v, &feet);
        assert!((power - booked).abs() < 1e-9 * booked.abs(), "{power} {booked}");
    }
}

/// M + s C + s^2 K with C = -df/dv, K = -df/dq by dual numbers.
fn dense<T: num_traits::Num + Copy + nalgebra::Scalar>(
    share: f64,
    feet: &[Foot<f64>; 2],
    s: T,
    lift: impl Fn(f64) -> T,
) -> SMatrix<T, N, N> {
    let (model, dual) =
        (Model::new(&body(share), &springs()), dual_model(&body(share), &springs()));
    let State { q, v } = state();
    let mut matrix = SMatrix::<T, N, N>::from_element(T::zero());
    let masses = model.masses(feet);
    for j in 0..N {
        let zero = Dual64::from_re(0.0);
        let by_q = dual.forces(&seeded(&q, j), &constant(&v), &dual_feet(feet), [zero; 2]);
        let by_v = dual.forces(&constant(&q), &seeded(&v, j), &dual_feet(feet), [zero; 2]);
        for i in 0..N {
            matrix[(i, j)] = T::zero() - s * (lift(by_v[i].eps) + s * lift(by_q[i].eps));
        }
        matrix[(j, j)] = matrix[(j, j)] + lift(masses[j]);
    }
    matrix
}

const RIGHT_SIDE: Vector<f64> = [1e6, -2e6, 3e7, 4e5, -5e5, 6e5, 7e5];

#[test]
fn newton_solves_with_the_dense_matrix_for_a_real_eigenvalue() {
    for share in [0.0, 0.1] {
        let model = Model::new(&body(share), &springs());
        for feet in contacts() {
            for s in [1e-4, 3e-3, 0.05] {
                let solution = Newton::new(&model, &state(), &feet, s, |x| x).solve(&RIGHT_SIDE);
                let matrix = dense(share, &feet, s, |x| x);
                let exact = matrix.lu().solve(&SVector::from(RIGHT_SIDE)).unwrap();
                let backward = matrix * SVector::from(solution) - SVector::from(RIGHT_SIDE);
                let scale = matrix.abs() * SVector::from(solution).abs();
                for k in 0..N {
                    assert!(
                        backward[k].abs() < 1e-11 * scale[k],
                        "{feet:?} {s} {k}: {solution:?} {exact}"
                    );
                }
            }
        }
    }
}

#[test]
fn newton_solves_with_the_dense_matrix_for_a_complex_eigenvalue() {
    let lift = |x: f64| Complex::new(x, 0.0);
    let right = RIGHT_SIDE.map(|x| Complex::new(x, -0.3 * x + 1e5));
    for share in [0.0, 0.1] {
        let model = Model::new(&body(share), &springs());
        for feet in contacts() {
            for h in [1e-4, 3e-3, 0.05] {
                let s = Complex::new(0.16 * h, 0.18 * h);
                let solution = Newton::new(&model, &state(), &feet, s, lift).solve(&right);
                let matrix = dense(share, &feet, s, lift);
                for i in 0..N {
                    let terms = (0..N).map(|j| matrix[(i, j)] * solution[j]);
                    let scale: f64 = terms.clone().map(|t| t.norm()).sum();
                    let left: Complex<f64> = terms.sum();
                    assert!((left - right[i]).norm() < 1e-11 * scale, "{feet:?} {h} {i}");
                }
            }
        }
    }
}

#[test]
fn a_massless_rotation_turns_to_where_no_moment_acts() {
    let model = Model::new(&body(0.0), &springs());
    for feet in contacts().into_iter().filter(|f| f[0].closed() || f[1].closed()) {
        let (mut settled, _) = model.settled();
        settled.q[0] += 1e-4;
        assert!(model.turn_to_balance(&mut settled, &feet));
        let moment = model.forces(&settled.q, &[0.0; N], &feet, [0.0; 2])[2];
        let scale = model.body.mass * 9.81 * model.body.half_width;
        assert!(moment.abs() < 1e-9 * scale, "{feet:?} {moment}");
    }
}
