//! Natural frequencies.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::Frame;
use crate::elastic::mechanics::Mechanics;

impl Frame {
    /// Natural frequencies of small motions about q, undamped, from the lowest (Hz); of a frame that nothing holds some are zero, and of one
    /// that would fall over, negative.
    pub fn frequencies(&self, q: &DVector<f64>) -> Vec<f64> {
        let [k, _] = self.tangent(q, &DVector::zeros(self.size), [0.0; 2]);
        let lower = self.cholesky.l();
        let half = |m: &DMatrix<f64>| lower.solve_lower_triangular(m).unwrap_or_else(|| m.clone());
        // L^-1 K L^-T
        let scaled = half(&half(&k).transpose());
        let mut squares: Vec<f64> = SymmetricEigen::new(scaled).eigenvalues.iter().copied().collect();
        squares.sort_by(f64::total_cmp);
        squares.into_iter().map(|square| square.signum() * square.abs().sqrt() / TAU).collect()
    }
}
