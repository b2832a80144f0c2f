//! Members: the ladder energy -> force -> Newton matrix again.

use nalgebra::SMatrix;
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
use rocking::{
    members::{Damper, Members, Tendon},
    scalar::{GRAVITY, Scalar, real},
    structure::Body,
};

/// Every combination worth testing.
fn all_members() -> Vec<Members<f64>> {
    let damper = Some(Damper { c: 3e6 });
    let tendon = Some(Tendon { stiffness: 2e6, pretension: 1e6 });
    vec![
        Members { damper, ..Members::default() },
        Members { tendon, ..Members::default() },
        Members { damper, tendon, friction: None },
    ]
}

fn model<S: Scalar>(share: f64, members: &Members<f64>) -> Model<S> {
    let Body { mass, half_width, height, inertia } = body(share);
    let chain =
        |c: &Chain<f64>| Chain { k1: real(c.k1), k2: real(c.k2), m2: real(c.m2), c: real(c.c) };
    let Springs { vertical, horizontal } = springs();
    Model::with_members(
        &Body {
            mass: real(mass),
            half_width: real(half_width),
            height: real(height),
            inertia: real(inertia),
        },
        &Springs { vertical: chain(&vertical), horizontal: chain(&horizontal) },
        &members.lift::<S>(),
    )
}

fn lift_feet(feet: &[Foot<f64>; 2]) -> [Foot<Dual64>; 2] {
    feet.map(|f| Foot { contact: f.contact, anchor: Dual64::from_re(f.anchor) })
}

fn seeded(x: &Vector<f64>, j: usize) -> Vector<Dual64> {
    std::array::from_fn(|k| Dual64::new(x[k], if k == j { 1.0 } else { 0.0 }))
}

fn constant(x: &Vector<f64>) -> Vector<Dual64> {
    x.map(Dual64::from_re)
}

#[test]
fn forces_at_rest_are_the_slope_of_the_energy() {
    for members in all_members() {
        let (model, dual) = (model::<f64>(0.1, &members), model::<Dual64>(0.1, &members));
        let q = state().q;
        for feet in contacts() {
            let force = model.forces(&q, &[0.0; N], &feet, [0.0; 2]);
            for (j, force) in force.iter().enumerate() {
                let seeded = State { q: seeded(&q, j), v: constant(&[0.0; N]) };
                let slope = dual.energy(&seeded, &lift_feet(&feet)).eps;
                let scale = 1e2 * model.body.mass * GRAVITY;
                assert!(
                    (force + slope).abs() < 1e-11 * scale,
                    "{members:?} {feet:?} {j}: {force} {slope}"
                );
            }
        }
    }
}

#[test]
fn power_of_ground_and_dashpots_is_the_power_of_the_forces() {
    let State { q, v } = state();
    let ground = [3.3, -1.7];
    for members in all_members() {
        let model = model::<f64>(0.1, &members);
        for feet in contacts() {
            let (all, without) =
                (model.forces(&q, &v, &feet, ground), model.forces(&q, &[0.0; N], &feet, [0.0; 2]));
            let power: f64 = (0..N).map(|k| (all[k] - without[k]) * v[k]).sum();
            let booked = model.input_power(&v, ground) - model.dissipation(&q, &v, &feet);
            assert!((power - booked).abs() < 1e-9 * booked.abs(), "{power} {booked}");
        }
    }
}

/// M + s C + s^2 K by dual numbers.
fn dense(
    share: f64,
    members: &Members<f64>,
    feet: &[Foot<f64>; 2],
    s: Complex<f64>,
) -> SMatrix<Complex<f64>, N, N> {
    let (model, dual) = (model::<f64>(share, members), model::<Dual64>(share, members));
    let State { q, v } = state();
    let mut matrix = SMatrix::<Complex<f64>, N, N>::zeros();
    let masses = model.masses(feet);
    for j in 0..N {
        let zero = Dual64::from_re(0.0);
        let by_q = dual.forces(&seeded(&q, j), &constant(&v), &lift_feet(feet), [zero; 2]);
        let by_v = dual.forces(&constant(&q), &seeded(&v, j), &lift_feet(feet), [zero; 2]);
        for i in 0..N {
            matrix[(i, j)] = -s * (by_v[i].eps + s * by_q[i].eps);
        }
        matrix[(j, j)] += masses[j];
    }
    matrix
}

#[test]
fn newton_solves_with_the_dense_matrix() {
    let lift = |x: f64| Complex::new(x, 0.0);
    let right = [1e6, -2e6, 3e7, 4e5, -5e5, 6e5, 7e5].map(|x| Complex::new(x, -0.3 * x + 1e5));
    for members in all_members() {
        for share in [0.0, 0.1] {
            let model = model::<f64>(share, &members);
            for feet in contacts() {
                for h in [1e-4, 3e-3, 0.05] {
                    let s = Complex::new(0.16 * h, 0.18 * h);
                    let solution = Newton::new(&model, &state(), &feet, s, lift).solve(&right);
                    let matrix = dense(share, &members, &feet, s);
                    for i in 0..N {
                        let terms = (0..N).map(|j| matrix[(i, j)] * solution[j]);
                        let scale: f64 = terms.clone().map(|t| t.norm()).sum();
                        let left: Complex<f64> = terms.sum();
                        let error = (left - right[i]).norm();
                        assert!(
                            error < 1e-9 * scale,
                            "{members:?} {share} {feet:?} {h} {i}: {}",
                            error / scale
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn rates_of_compression_are_its_slope_in_time() {
    for members in all_members() {
        let (model, dual) = (model::<f64>(0.1, &members), model::<Dual64>(0.1, &members));
        let State { q, v } = state();
        let moving = std::array::from_fn(|k| Dual64::new(q[k], v[k]));
        for feet in contacts() {
            for i in 0..2 {
                let slope = dual.compression(i, &moving).eps;
                let rate = model.compression_rate(i, &State { q, v });
                assert!(
                    (rate - slope).abs() < 1e-9 * slope.abs().max(0.1),
                    "{feet:?} {i}: {rate} {slope}"
                );
            }
        }
    }
}
