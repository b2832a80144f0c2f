//! The Newton matrix of a Radau stage, M + s C + s^2 K with s = h lambda, absorbers condensed to
//! the frame's n coordinates.

use nalgebra::DMatrix;

use super::{
    lu::{Lu, MatrixEntry},
    model::{CornerState, ElasticModel, absorber},
};
use crate::frame::StrainRates;
use dynamics::{fem::condensed::Condensed, spring::Springs};

/// The frame's share of the matrix at one state: -dF/dq with the corners' turning levers, -dF/dq',
/// and the levers.
pub(super) struct Tangent {
    pub k: DMatrix<f64>,
    pub c: DMatrix<f64>,
    /// Derivative of every corner's place by its footing's rotation (m).
    pub slopes: Vec<[f64; 2]>,
}

impl Tangent {
    pub(crate) fn new(model: &ElasticModel) -> Self {
        let n = model.n;
        Self {
            k: DMatrix::zeros(n, n),
            c: DMatrix::zeros(n, n),
            slopes: vec![[0.0; 2]; model.units.len()],
        }
    }

    /// Take it at q, q'.
    pub(crate) fn take(
        &mut self,
        model: &ElasticModel,
        q: &[f64],
        v: &[f64],
        feet: &[CornerState],
    ) {
        let n = model.n;
        let state = (&q[..n], &v[..n]);
        model.frame.slopes(state, StrainRates::OfVelocities, &mut self.k, &mut self.c);
        for (i, (foot, corner)) in feet.iter().zip(model.frame.places()).enumerate() {
            let reach = corner.reach(q);
            self.slopes[i] = reach.slope;
            if let (true, Some(th)) = (foot.closed, corner.rotation()) {
                let [h, p] = model.contact(i, foot, q, v);
                self.k[(th, th)] += h * reach.arm[0] + p * reach.arm[1];
            }
        }
    }
}

/// The matrix for one eigenvalue, ready to solve with.
pub(super) struct FactoredMatrix<T> {
    chains: Vec<[Condensed<T>; 2]>,
    /// Of every corner that slides, its horizontal force over the vertical one.
    drags: Vec<T>,
    lu: Lu<T>,
    /// The frame's part before it is factored.
    entries: Vec<T>,
}

impl<T: MatrixEntry> FactoredMatrix<T> {
    pub(crate) fn new(model: &ElasticModel) -> Self {
        let n = model.n;
        Self {
            chains: Vec::with_capacity(model.units.len()),
            drags: Vec::new(),
            lu: Lu::new(n),
            entries: vec![T::zero(); n * n],
        }
    }

    /// Condense the chains for s = h lambda.
    pub(crate) fn condense(&mut self, model: &ElasticModel, feet: &[CornerState], s: T) {
        self.chains.clear();
        self.chains.extend(feet.iter().zip(model.units).map(
            |(foot, Springs { vertical, horizontal })| {
                [
                    Condensed::new(horizontal, foot.closed && foot.holds, s),
                    Condensed::new(vertical, foot.closed, s),
                ]
            },
        ));
        self.drags.clear();
        self.drags.extend(feet.iter().enumerate().map(|(i, foot)| {
            let [of_force, of_rate] = model.dragged(i, foot);
            T::from(of_force) + T::from(of_rate) / s
        }));
    }

    /// Factor; false if it is singular.
    #[must_use]
    pub(crate) fn factor(
        &mut self,
        model: &ElasticModel,
        tangent: &Tangent,
        feet: &[CornerState],
        s: T,
    ) -> bool {
        let n = model.n;
        let mass = model.frame.mass_matrix();
        let s2 = s * s;
        for i in 0..n {
            for j in 0..n {
                let at = (i, j);
                self.entries[i * n + j] =
                    T::from(mass[at]) + s * T::from(tangent.c[at]) + s2 * T::from(tangent.k[at]);
            }
        }
        let entries = &mut self.entries;
        for (i, corner) in model.frame.places().iter().enumerate() {
            if !feet[i].closed {
                continue;
            }
            let ([h, v], drag) = (&self.chains[i], self.drags[i]);
            corner.rows(tangent.slopes[i], |row, gi| {
                let pushed = T::from(gi[1]) + drag * T::from(gi[0]);
                corner.rows(tangent.slopes[i], |column, gj| {
                    let at = row * n + column;
                    entries[at] = entries[at]
                        + h.stiffness * T::from(gi[0] * gj[0])
                        + v.stiffness * pushed * T::from(gj[1]);
                });
            });
        }
        self.lu.factor(|i, j| entries[i * n + j])
    }

    /// Solve for the accelerations' correction, in place.
    pub(crate) fn solve(
        &mut self,
        model: &ElasticModel,
        tangent: &Tangent,
        feet: &[CornerState],
        r: &mut [T],
    ) {
        let n = model.n;
        for (i, corner) in model.frame.places().iter().enumerate() {
            if feet[i].closed {
                let (at, [h, v]) = (absorber(n, i), &self.chains[i]);
                let from_z = r[at + 1] * v.share;
                let from_x = r[at] * h.share + from_z * self.drags[i];
                corner.rows(tangent.slopes[i], |row, g| {
                    r[row] = r[row] + from_x * T::from(g[0]) + from_z * T::from(g[1])
                });
            }
        }
        self.lu.solve(r);
        for (i, corner) in model.frame.places().iter().enumerate() {
            let (at, [h, v]) = (absorber(n, i), &self.chains[i]);
            let mut moved = [T::zero(); 2];
            if feet[i].closed {
                corner.rows(tangent.slopes[i], |row, g| {
                    moved = [moved[0] + r[row] * T::from(g[0]), moved[1] + r[row] * T::from(g[1])];
                });
            }
            r[at + 1] = (r[at + 1] + v.coupling * moved[1]) * v.pivot;
            let pushed = v.coupling * (r[at + 1] - moved[1]);
            r[at] = (r[at] + h.coupling * moved[0] - self.drags[i] * pushed) * h.pivot;
        }
    }
}
