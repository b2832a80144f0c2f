//! A structure at rest under its weight: Q(q, 0) + G' F = 0 with corners, and maybe coordinates,
//! held.

use nalgebra::{DMatrix, DVector};
use thiserror::Error;

use super::CornerSet;
use crate::Mechanics;

/// Newton steps, and the size of the last one that is rounding (m, rad).
const STEPS: usize = 50;
const ROUNDING: f64 = 1e-13;

/// No place of rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum RestError {
    /// A coordinate that nothing holds.
    #[error(
        "the structure cannot stand: a coordinate has no stiffness; hold more corners, or give its \
         members stiffness"
    )]
    Loose,
    /// Too soft under its weight.
    #[error(
        "the structure does not come to rest under its weight in {STEPS} steps of Newton's method; \
         make its members stiffer"
    )]
    NotFound,
}

/// Coordinates of rest near q, with the corners of a set held on the ground where they stand
/// unstressed and the coordinates `fixed` kept as they are. With one corner held and a footing's
/// rotation fixed, the structure leans.
///
/// # Errors
/// The structure is loose, or too soft for its weight.
pub fn at_rest(
    mechanics: &impl Mechanics,
    q: &DVector<f64>,
    held: CornerSet,
    fixed: &[usize],
) -> Result<DVector<f64>, RestError> {
    let (n, still) = (mechanics.size(), DVector::zeros(mechanics.size()));
    let footings = mechanics.footings();
    let mut q = q.clone();
    for _ in 0..STEPS {
        let (mut rows, mut gaps) = (Vec::new(), Vec::new());
        for i in held.iter() {
            let corner = mechanics.corner(i, &q, &still);
            let first = !held.iter().take_while(|&k| k < i).any(|k| footings[k] == footings[i]);
            for direction in if first { 0..2 } else { 1..2 } {
                rows.push(corner.jacobian[direction].clone());
                gaps.push(corner.place[direction]);
            }
        }
        for &i in fixed {
            rows.push(DVector::from_fn(n, |k, _| if k == i { 1.0 } else { 0.0 }));
            gaps.push(0.0);
        }
        let r = rows.len();
        let force = mechanics.force(&q, &still, [0.0; 2]);
        let stiffness = &mechanics.tangent(&q, &still, [0.0; 2])[0];
        // rows of G in units of the stiffness, so that the matrix is of one size
        let unit = stiffness.amax();
        let matrix = DMatrix::from_fn(n + r, n + r, |i, j| match (i < n, j < n) {
            (true, true) => stiffness[(i, j)] / unit,
            (true, false) => -rows[j - n][i],
            (false, true) => rows[i - n][j],
            (false, false) => 0.0,
        });
        let right =
            DVector::from_fn(n + r, |i, _| if i < n { force[i] / unit } else { -gaps[i - n] });
        let solution = matrix
            .lu()
            .solve(&right)
            .filter(|x| x.iter().all(|x| x.is_finite()))
            .ok_or(RestError::Loose)?;
        let step = solution.rows(0, n);
        q += step;

        if step.amax() <= ROUNDING * (1.0 + q.amax()) {
            return Ok(q);
        }
    }
    Err(RestError::NotFound)
}
