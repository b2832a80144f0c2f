//! The Newton matrix of a Radau stage, M + s C + s^2 K, while a foot slips on the ground.
//!
//! A slipping foot's horizontal force follows its vertical one, H = -+ mu N, which makes the matrix
//! unsymmetric and ties each of the foot's absorbers to both of its motions. It is factored whole:
//! slipping is rare and short.

use super::model::{Contact, Foot, Model, N, State, TH, X, Z, ax, az};
use super::newton::MatrixNumber;

/// Absorbers first, the rotation last: each pivot then has a mass, or stands on what is left of
/// one.
const ORDER: [usize; N] = [ax(0), az(0), ax(1), az(1), X, Z, TH];

/// The matrix as L U in the order of elimination: multipliers below, U on and above the diagonal.
pub(super) struct Slipping<T>([[T; N]; N]);

impl<T: MatrixNumber> Slipping<T> {
    /// Factor at `state` for s = h lambda.
    pub(crate) fn new(model: &Model, state: &State, feet: &[Foot; 2], s: T) -> Self {
        let mut matrix = [[T::zero(); N]; N];
        for (k, mass) in model.masses(feet).into_iter().enumerate() {
            matrix[k][k] = T::from(mass);
        }
        let s2 = s * s;
        for (i, f) in model.contact(&state.q, feet).iter().enumerate() {
            for (k, chain) in [(ax(i), &model.springs.horizontal), (az(i), &model.springs.vertical)]
            {
                matrix[k][k] = matrix[k][k] + s * (T::from(chain.c) + s * T::from(chain.k2));
            }
            if !feet[i].closed() {
                continue;
            }
            // minus the slopes of H and N by the coordinates
            let (kh, kv) = (model.springs.horizontal.k1, model.springs.vertical.k1);
            let mut of_n = [0.0; N];
            (of_n[Z], of_n[TH], of_n[az(i)]) = (kv, kv * f.pz_th, -kv);
            let mut of_h = [0.0; N];
            match feet[i].contact {
                Contact::Stick => (of_h[X], of_h[TH], of_h[ax(i)]) = (kh, kh * f.px_th, -kh),
                Contact::Slip(side) => of_h = of_n.map(|n| model.law.slipping(n, side)),
                Contact::Open | Contact::Slide | Contact::Trail => {}
            }
            for k in 0..N {
                let turn = of_h[k] * f.px_th + of_n[k] * f.pz_th;
                let rows =
                    [(X, of_h[k]), (Z, of_n[k]), (TH, turn), (ax(i), -of_h[k]), (az(i), -of_n[k])];
                for (row, slope) in rows {
                    matrix[row][k] = matrix[row][k] + s2 * T::from(slope);
                }
            }
            matrix[TH][TH] =
                matrix[TH][TH] + s2 * T::from(f.vertical * f.px_th - f.horizontal * f.pz_th);
        }
        let mut lu: [[T; N]; N] =
            std::array::from_fn(|i| std::array::from_fn(|j| matrix[ORDER[i]][ORDER[j]]));
        for k in 0..N {
            let pivot = lu[k];
            for row in &mut lu[k + 1..] {
                let factor = row[k] / pivot[k];
                row[k] = factor;
                for (a, p) in row[k + 1..].iter_mut().zip(&pivot[k + 1..]) {
                    *a = *a - factor * *p;
                }
            }
        }
        Self(lu)
    }

    /// Solve for the accelerations' correction.
    pub(crate) fn solve(&self, r: &[T; N]) -> [T; N] {
        let lu = &self.0;
        let mut d = ORDER.map(|k| r[k]);
        for i in 0..N {
            for j in 0..i {
                d[i] = d[i] - d[j] * lu[i][j];
            }
        }
        for i in (0..N).rev() {
            for j in i + 1..N {
                d[i] = d[i] - d[j] * lu[i][j];
            }
            d[i] = d[i] * (T::one() / lu[i][i]);
        }
        let mut out = *r;
        for (k, d) in ORDER.into_iter().zip(d) {
            out[k] = d;
        }
        out
    }
}
