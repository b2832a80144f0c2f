//! The Newton matrix of a Radau stage, M + s C + s^2 K, of a body with members.
//!
//! As `newton`, but a foot on an elastic leg couples its two directions: its contact is a symmetric 2 x 2 stiffness B, and
//! its absorbers are eliminated by a 2 x 2 block, with D = m2 + s c + s^2 k2 of both directions,
//!
//! ```text
//!   P = (D + s^2 B)^-1      condensed contact  D P s^2 B      condensed lever  D P s^2 g,  g = B J + c  (`frame`)
//! ```
//!
//! written so that nothing cancels where springs are stiff. Elements touch the body only; the dampers' turning levers make its
//! 3 x 3 matrix unsymmetric.

use std::ops::{Add, Neg, Sub};

use num_traits::Num;

use super::model::{Foot, Model, N, State, TH, X, Z, ax, az};
use crate::scalar::Scalar;

type Matrix2<T> = [[T; 2]; 2];

/// One foot's absorbers, eliminated.
#[derive(Clone, Copy)]
struct Absorbers<T> {
    /// P.
    pivot: Matrix2<T>,
    /// s^2 [B | g]: columns X, Z, theta.
    coupling: [[T; 3]; 2],
}

/// The condensed matrix for one eigenvalue, ready to solve with.
pub(super) struct Coupled<T> {
    feet: [Absorbers<T>; 2],
    /// The body's matrix as L U: multipliers below, U on and above the diagonal.
    body: [[T; 3]; 3],
}

fn product<T: Num + Copy>(a: &Matrix2<T>, b: &Matrix2<T>) -> Matrix2<T> {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

fn dot<T: Num + Copy>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[0] + a[1] * b[1]
}

impl<T: Num + Copy + Neg<Output = T>> Coupled<T> {
    /// Factor at `state` for s = h lambda.
    pub fn new<S: Scalar>(
        model: &Model<S>,
        state: &State<S>,
        feet: &[Foot<S>; 2],
        s: T,
        lift: &impl Fn(S) -> T,
    ) -> Self {
        let s2 = s * s;
        let both = std::array::from_fn(|i| foot(model, state, (i, &feet[i]), s, lift));
        let [(left, of_left), (right, of_right)]: [(Absorbers<T>, [[T; 3]; 3]); 2] = both;
        let mut body: [[T; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| of_left[i][j] + of_right[i][j]));
        let masses = model.masses(feet);
        for k in [X, Z, TH] {
            body[k][k] = body[k][k] + lift(masses[k]);
        }

        for element in model.elements.each() {
            let tangent = element.tangent(&state.q, &state.v);
            for (row, (k, c)) in body.iter_mut().zip(tangent.stiffness.iter().zip(&tangent.damping)) {
                for j in 0..3 {
                    row[j] = row[j] + (s2 * lift(k[j]) + s * lift(c[j]));
                }
            }
        }

        // masses keep the pivots of X and Z away from zero
        for k in 0..2 {
            let pivot_row = body[k];
            for row in &mut body[k + 1..] {
                let factor = row[k] / pivot_row[k];
                row[k] = factor;
                for (x, p) in row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]) {
                    *x = *x - factor * *p;
                }
            }
        }
        Self { feet: [left, right], body }
    }

    /// Solve for the accelerations' correction; `times` multiplies an entry of the right side by one of the matrix.
    pub fn solve<V>(&self, r: &[V; N], times: impl Fn(V, T) -> V) -> [V; N]
    where
        V: Copy + Add<Output = V> + Sub<Output = V>,
    {
        let mut d = *r;
        let dot = |row: [T; 2], x: [V; 2]| times(x[0], row[0]) + times(x[1], row[1]);
        let [left, right] = [0, 1].map(|i| {
            let Absorbers { pivot, coupling } = &self.feet[i];
            let a = pivot.map(|row| dot(row, [r[ax(i)], r[az(i)]]));
            [0, 1, 2].map(|k| times(a[0], coupling[0][k]) + times(a[1], coupling[1][k]))
        });
        for k in [X, Z, TH] {
            d[k] = d[k] + (left[k] + right[k]);
        }
        let u = &self.body;
        let over = |x: V, pivot: T| times(x, T::one() / pivot);
        d[Z] = d[Z] - times(d[X], u[Z][X]);
        d[TH] = d[TH] - times(d[X], u[TH][X]) - times(d[Z], u[TH][Z]);
        d[TH] = over(d[TH], u[TH][TH]);
        d[Z] = over(d[Z] - times(d[TH], u[Z][TH]), u[Z][Z]);
        d[X] = over(d[X] - times(d[Z], u[X][Z]) - times(d[TH], u[X][TH]), u[X][X]);
        for i in 0..2 {
            let Absorbers { pivot, coupling } = &self.feet[i];
            let pull = coupling.map(|row| times(d[X], row[X]) + times(d[Z], row[Z]) + times(d[TH], row[TH]));
            let right_side = [r[ax(i)] + pull[0], r[az(i)] + pull[1]];
            [d[ax(i)], d[az(i)]] = pivot.map(|row| dot(row, right_side));
        }
        d
    }
}

/// One foot's absorbers, and its share of the body's matrix.
fn foot<S: Scalar, T: Num + Copy + Neg<Output = T>>(
    model: &Model<S>,
    state: &State<S>,
    (i, foot): (usize, &Foot<S>),
    s: T,
    lift: &impl Fn(S) -> T,
) -> (Absorbers<T>, [[T; 3]; 3]) {
    let (zero, s2) = (T::zero(), s * s);
    let base = [&model.springs.horizontal, &model.springs.vertical]
        .map(|chain| lift(chain.m2) + s * (lift(chain.c) + s * lift(chain.k2)));
    if !foot.closed() {
        let pivot = [[T::one() / base[0], zero], [zero, T::one() / base[1]]];
        return (Absorbers { pivot, coupling: [[zero; 3]; 2] }, [[zero; 3]; 3]);
    }
    let poised = model.poised(model.elements.leg.as_ref(), i, &state.q, foot);
    let tangent = poised.tangent();
    let [xx, xz, zz] = tangent.b.map(|b| s2 * lift(b));
    let b = [[xx, xz], [xz, zz]];
    let c = tangent.c.map(|c| s2 * lift(c));
    let lever = [lift(poised.force.px_th), lift(poised.force.pz_th)];
    let g = [0, 1].map(|k| dot(b[k], lever) + c[k]);

    let (p00, p11) = (base[0] + xx, base[1] + zz);
    let det = p00 * p11 - xz * xz;
    let pivot = [[p11 / det, -xz / det], [-xz / det, p00 / det]];
    let coupling = [[b[0][0], b[0][1], g[0]], [b[1][0], b[1][1], g[1]]];

    // D P s^2 B and D P s^2 g
    let weighted: Matrix2<T> = std::array::from_fn(|k| pivot[k].map(|p| base[k] * p));
    let q = product(&weighted, &b);
    let by_theta = weighted.map(|row| dot(row, g));
    // J Q J + 2 c P D J - c P c - turning
    let pc = pivot.map(|row| dot(row, c));
    let j_q_j = dot(lever, q.map(|row| dot(row, lever)));
    let c_p_d_j = pc[0] * base[0] * lever[0] + pc[1] * base[1] * lever[1];
    let th_th = j_q_j + c_p_d_j + c_p_d_j - dot(c, pc) - s2 * lift(tangent.turning);
    let share = [[q[0][0], q[0][1], by_theta[0]], [q[1][0], q[1][1], by_theta[1]], [by_theta[0], by_theta[1], th_th]];
    (Absorbers { pivot, coupling }, share)
}
