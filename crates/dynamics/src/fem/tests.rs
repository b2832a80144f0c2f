//! Tests of the finite element model against closed forms, limits, differences and dense linear
//! algebra.

mod forces;
mod friction;
mod integrator;
mod motions;
mod sliding;
mod statics;

use std::f64::consts::TAU;

use nalgebra::{ComplexField, SMatrix};

use super::{
    model::{Contact, Foot, Model, N, State, TH, Vector},
    newton::MatrixNumber,
};
use crate::spring::{Chain, Design, Springs};
use rocking::{
    members::{Damper, Members, Tendon},
    structure::{Body, Structure},
};

/// The paper's structure with I_cg as a share of m R^2.
fn body(share: f64) -> Body<f64> {
    let mut body = Structure::paper().body::<f64>();
    body.inertia = share * body.mass * body.radius().powi(2);
    body
}

/// Springs of different chains in the two directions.
fn springs() -> Springs<Chain> {
    let vertical = Design::from_kc(0.3, 0.1, 0.75, 20.0);
    let horizontal = Design::from_kc(1.7, 0.57, 1.86, 35.0);
    Springs { vertical, horizontal }.chains(Structure::paper().mass_kg)
}

/// Bodies of these shares, each without members and with every combination of them worth testing.
fn models(shares: &[f64]) -> Vec<(Members, Model)> {
    let damper = Some(Damper { c: 3e6 });
    let tendon = Some(Tendon { stiffness: 2e6, pretension: 1e6 });
    let all = [
        Members::default(),
        Members { damper, ..Members::default() },
        Members { tendon, ..Members::default() },
        Members { damper, tendon, friction: None },
    ];
    let of = |share| all.map(|m| (m, Model::with_members(&body(share), &springs(), &m)));
    shares.iter().flat_map(|&share| of(share)).collect()
}

/// All pairs of contacts, both feet anchored off centre.
fn contacts() -> Vec<[Foot; 2]> {
    let all = [Contact::Open, Contact::Slide, Contact::Stick];
    let foot = |contact, anchor| Foot { contact, anchor };
    all.iter().flat_map(|&l| all.map(|r| [foot(l, 0.013), foot(r, -0.007)])).collect()
}

/// A state far from any symmetry: leaning, pressed, moving.
fn state() -> State {
    State {
        q: [0.11, -0.02, 0.031, 0.004, -0.011, -0.003, -0.017],
        v: [0.3, -0.1, 0.02, 0.05, -0.2, 0.07, 0.13],
    }
}

/// Standing at rest on springs without damping.
fn undamped(share: f64) -> (Model, State, [Foot; 2]) {
    let mut springs = springs();
    springs.vertical.c = 0.0;
    springs.horizontal.c = 0.0;
    let model = Model::new(&body(share), &springs);
    let (state, feet) = model.settled();
    (model, state, feet)
}

/// Angular frequency (1/s) of f (Hz).
fn omega(hz: f64) -> f64 {
    TAU * hz
}

/// Slopes of a smooth function at zero, by central differences of the sixth order.
pub(super) fn slopes<const M: usize>(step: f64, f: impl Fn(f64) -> [f64; M]) -> [f64; M] {
    let pairs = [1.0, 2.0, 3.0].map(|k| (f(k * step), f(-k * step)));
    let weights = [45.0, -9.0, 1.0];
    std::array::from_fn(|i| {
        let sum: f64 = pairs.iter().zip(weights).map(|((up, down), w)| w * (up[i] - down[i])).sum();
        sum / (60.0 * step)
    })
}

/// A step for coordinate j (m, rad): energies are quadratic in all but the rotation.
pub(super) fn step(j: usize) -> f64 {
    if j == TH { 2e-3 } else { 0.1 }
}

/// A vector with one of its components moved.
pub(super) fn moved(x: &Vector, j: usize, by: f64) -> Vector {
    let mut x = *x;
    x[j] += by;
    x
}

/// M + s C + s^2 K of the model at `state()`, with C = -df/dv and K = -df/dq by differences.
fn dense<T: MatrixNumber + nalgebra::Scalar>(
    model: &Model,
    feet: &[Foot; 2],
    s: T,
) -> SMatrix<T, N, N> {
    let State { q, v } = state();
    let mut matrix = SMatrix::<T, N, N>::from_element(T::zero());
    let masses = model.masses(feet);
    for j in 0..N {
        let by_q = slopes(step(j), |t| model.forces(&moved(&q, j, t), &v, feet, [0.0; 2]));
        let by_v = slopes(step(j), |t| model.forces(&q, &moved(&v, j, t), feet, [0.0; 2]));
        for i in 0..N {
            matrix[(i, j)] = T::zero() - s * (T::from(by_v[i]) + s * T::from(by_q[i]));
        }
        matrix[(j, j)] = matrix[(j, j)] + T::from(masses[j]);
    }
    matrix
}

/// The largest part of `matrix` times `solution` less `right`, over the terms that make it.
fn largest_residual<T: ComplexField<RealField = f64> + Copy>(
    matrix: &SMatrix<T, N, N>,
    solution: &[T; N],
    right: &[T; N],
) -> f64 {
    let of_row = |i: usize| {
        let terms = (0..N).map(|j| matrix[(i, j)] * solution[j]);
        let scale: f64 = terms.clone().map(T::modulus).sum();
        assert!(scale > 0.0 && scale.is_finite(), "row {i}: {scale}");
        (terms.fold(T::zero(), |sum, t| sum + t) - right[i]).modulus() / scale
    };
    (0..N).map(of_row).fold(0.0, f64::max)
}
