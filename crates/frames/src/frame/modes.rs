//! Natural frequencies.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::{Frame, NONE};
use crate::mechanics::Mechanics;

impl Frame {
    /// Natural frequencies of small motions about q, undamped, from the lowest (Hz); of a frame
    /// that nothing holds some are zero, and of one that would fall over, negative.
    pub fn frequencies(&self, q: &DVector<f64>) -> Vec<f64> {
        let [k, _] = self.tangent(q, &DVector::zeros(self.size), [0.0; 2]);
        of(k, &self.cholesky.l())
    }

    /// Those of the unstressed frame whose nodes move sideways and turn, but neither rise nor sink
    /// (Hz): of a column, its bending modes.
    pub(crate) fn lateral_frequencies(&self) -> Vec<f64> {
        let kept: Vec<usize> = self
            .bodies
            .iter()
            .flat_map(|body| [body.index[0], body.index[2]])
            .filter(|&k| k != NONE)
            .collect();
        let [k, _] = self.tangent(&DVector::zeros(self.size), &DVector::zeros(self.size), [0.0; 2]);
        let part = |m: &DMatrix<f64>| m.select_rows(&kept).select_columns(&kept);
        nalgebra::Cholesky::new(part(&self.mass)).map_or(Vec::new(), |mass| of(part(&k), &mass.l()))
    }
}

/// Frequencies of K with M = L L' (Hz).
fn of(k: DMatrix<f64>, lower: &DMatrix<f64>) -> Vec<f64> {
    let half = |m: &DMatrix<f64>| lower.solve_lower_triangular(m).unwrap_or_else(|| m.clone());
    // L^-1 K L^-T
    let scaled = half(&half(&k).transpose());
    let mut squares: Vec<f64> = SymmetricEigen::new(scaled).eigenvalues.iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares.into_iter().map(|square| square.signum() * square.abs().sqrt() / TAU).collect()
}
