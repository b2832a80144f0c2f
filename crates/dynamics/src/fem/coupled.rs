//! The Newton matrix of a Radau stage, M + s C + s^2 K, of a body with members.
//!
//! As `newton`: absorbers condense into their chains. The members touch the body only: a tendon
//! ties X to Z, and the dampers' turning levers make the body's 3 x 3 matrix unsymmetric, so that
//! it is factored whole.

use super::{
    model::{Foot, Model, N, State, TH, X, Z, ax, az},
    newton::{Chains, MatrixNumber, absorbers, reach, share},
};

/// The condensed matrix for one eigenvalue, ready to solve with.
pub(super) struct Coupled<T> {
    /// dp_x/dtheta and dp_z/dtheta of each foot; an open one's chains do not couple.
    lever: [[T; 2]; 2],
    /// The body's matrix as L U: multipliers below, U on and above the diagonal.
    body: [[T; 3]; 3],
}

impl<T: MatrixNumber> Coupled<T> {
    /// Factor at `state` for s = h lambda.
    pub(crate) fn new(
        chains: &Chains<T>,
        model: &Model,
        state: &State,
        feet: &[Foot; 2],
        s: T,
    ) -> Self {
        let (contact, masses) = (model.contact(&state.q, feet), model.masses(feet));
        let [left, right] = [0, 1].map(|i| share(&chains.0[i], &contact[i], s));
        let [xx, zz, tt, x_th, z_th] = std::array::from_fn(|k| left.0[k] + right.0[k]);
        let mut body = [[xx, T::zero(), x_th], [T::zero(), zz, z_th], [x_th, z_th, tt]];
        for k in [X, Z, TH] {
            body[k][k] = body[k][k] + T::from(masses[k]);
        }
        for element in model.elements_under(feet).each() {
            let tangent = element.tangent(&state.q, &state.v);
            for (row, (k, c)) in body.iter_mut().zip(tangent.stiffness.iter().zip(&tangent.damping))
            {
                for j in 0..3 {
                    row[j] = row[j] + (s * s * T::from(k[j]) + s * T::from(c[j]));
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
        Self { lever: [left.1, right.1], body }
    }

    /// Solve for the accelerations' correction.
    pub(crate) fn solve(&self, chains: &Chains<T>, r: &[T; N]) -> [T; N] {
        let of_foot = |i: usize| [r[ax(i)], r[az(i)]];
        let [left, right] = [0, 1].map(|i| reach(&chains.0[i], self.lever[i], of_foot(i)));
        let [x, z, th] = [X, Z, TH].map(|k| r[k] + (left[k] + right[k]));
        let u = &self.body;
        let over = |x: T, pivot: T| x * (T::one() / pivot);
        let z = z - x * u[Z][X];
        let th = th - x * u[TH][X] - z * u[TH][Z];
        let th = over(th, u[TH][TH]);
        let z = over(z - th * u[Z][TH], u[Z][Z]);
        let x = over(x - z * u[X][Z] - th * u[X][TH], u[X][X]);
        let [[lx, lz], [rx, rz]] =
            [0, 1].map(|i| absorbers(&chains.0[i], self.lever[i], of_foot(i), [x, z, th]));
        [x, z, th, lx, lz, rx, rz]
    }
}
