//! Where a frame stands still under its weight, on corners that rest on springs.
//!
//! ```text
//!   Q(q, 0) + sum G_i' (-K_i p_i) + sum_j h_j lambda_j = 0,   h_j q = r_j
//! ```
//!
//! by Newton's method; K_i: springs under a corner that is on the ground; h_j: what is held while
//! it leans.

use nalgebra::{DMatrix, DVector};
use thiserror::Error;

use super::Frame;
use crate::mechanics::Mechanics;

/// Newton steps before it is given up.
const STEPS: usize = 60;
/// A step this small has arrived, over the frame's span.
const SMALL: f64 = 1e-13;
/// Steps on the way to a lean, of this many radians each.
const LEAN: f64 = 0.02;

/// What a corner stands on: stiffness, horizontally and vertically (N/m); `None` in the air.
pub type Support = Option<[f64; 2]>;

/// No place of rest was found, or a history cannot begin.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum EquilibriumError {
    /// Newton's method did not arrive.
    #[error(
        "frame: no equilibrium under its weight at a lean of {lean} rad: it falls over or its \
         columns buckle; lean it less or stiffen the columns"
    )]
    NoRest {
        /// How far it was to lean (rad).
        lean: f64,
    },
    /// What a history begins with does not fit the frame.
    #[error("frame: {given} {what} given, but it has {needed}")]
    Mismatch {
        /// Springs, coordinates, velocities or feet.
        what: &'static str,
        /// How many there are.
        given: usize,
        /// How many there should be.
        needed: usize,
    },
}

impl Frame {
    /// Where it rests under its weight, upright: on all of its corners with these springs under
    /// each of them; or held, without corners.
    ///
    /// # Errors
    /// There is no such place.
    pub fn standing(&self, supports: &[Support]) -> Result<DVector<f64>, EquilibriumError> {
        let q = DVector::zeros(self.size);
        self.balance(q, supports, &[]).ok_or(EquilibriumError::NoRest { lean: 0.0 })
    }

    /// Where it rests leaning to the right by `lean` on its last corner alone, held so: the
    /// rotation of that corner's footing is the lean; on a foot that is a point, the first corner
    /// is up by the lean's sine times their distance. To the left, on its first corner, if `lean`
    /// is negative.
    ///
    /// # Errors
    /// There is no such place.
    pub(crate) fn leaning(
        &self,
        lean: f64,
        supports: &[Support],
    ) -> Result<DVector<f64>, EquilibriumError> {
        let mut lone = vec![None; supports.len()];
        let pivot = if lean > 0.0 { supports.len().saturating_sub(1) } else { 0 };
        if let Some(support) = supports.get(pivot) {
            lone[pivot] = *support;
        }
        let steps = (lean.abs() / LEAN).ceil().max(1.0);
        let mut q = DVector::zeros(self.size);
        for step in 0..=(steps as usize) {
            let lean = lean * step as f64 / steps;
            q = self
                .balance(q, &lone, &[self.hold(pivot, lean)])
                .ok_or(EquilibriumError::NoRest { lean })?;
        }
        Ok(q)
    }

    /// What holds it leaning on this corner: row h and value r.
    fn hold(&self, pivot: usize, lean: f64) -> (DVector<f64>, f64) {
        let mut row = DVector::zeros(self.size);
        let Some(corner) = self.corners.get(pivot) else { return (row, 0.0) };
        if let Some(th) = corner.rotation() {
            row[th] = 1.0;
            return (row, lean);
        }
        let other = &self.corners[self.corners.len() - 1 - pivot];
        row[other.index[1]] += 1.0;
        row[corner.index[1]] -= 1.0;
        let apart = (corner.unstressed[0] - other.unstressed[0]).abs();
        (row, apart * lean.sin().abs())
    }

    /// Newton's method from q.
    fn balance(
        &self,
        mut q: DVector<f64>,
        supports: &[Support],
        holds: &[(DVector<f64>, f64)],
    ) -> Option<DVector<f64>> {
        let (n, m) = (self.size, holds.len());
        let still = DVector::zeros(n);
        let span = self.span();
        let mut multipliers = DVector::zeros(m);
        for _ in 0..STEPS {
            let [k, _] = self.tangent(&q, &still, [0.0; 2]);
            let mut matrix = DMatrix::zeros(n + m, n + m);
            matrix.view_mut((0, 0), (n, n)).copy_from(&k);
            let mut right = DVector::zeros(n + m);
            right.rows_mut(0, n).copy_from(&self.force(&q, &still, [0.0; 2]));
            for (corner, support) in self.corners.iter().zip(supports) {
                let Some([kx, kz]) = support else { continue };
                let reach = corner.reach(q.as_slice());
                let force = [-kx * reach.place[0], -kz * reach.place[1]];
                corner.push(&reach, force, &mut right.as_mut_slice()[..n]);
                corner.rows(reach.slope, |i, gi| {
                    corner.rows(reach.slope, |j, gj| {
                        matrix[(i, j)] += kx * gi[0] * gj[0] + kz * gi[1] * gj[1]
                    });
                });
                if let Some(th) = corner.rotation() {
                    matrix[(th, th)] += force[0] * reach.arm[0] + force[1] * reach.arm[1];
                }
            }
            for (j, (row, value)) in holds.iter().enumerate() {
                for i in 0..n {
                    right[i] += row[i] * multipliers[j];
                    matrix[(i, n + j)] = -row[i];
                    matrix[(n + j, i)] = row[i];
                }
                right[n + j] = value - row.dot(&q);
            }
            let step = matrix.lu().solve(&right)?;
            q += step.rows(0, n);
            multipliers += step.rows(n, m);
            let moved = step.rows(0, n).amax();
            if !moved.is_finite() {
                return None;
            }
            if moved <= SMALL * span {
                return Some(q);
            }
        }
        None
    }
}
