//! The error of a history while it is followed.

use std::ops::ControlFlow;

use dynamics::fem::{Observer, View};
use rocking::motion::Motion;

/// Sums J over the samples, and ends the history when its error exceeds a limit.
pub(super) struct RunningError<'a> {
    housner: &'a Motion,
    /// Sums of the squares of Housner's u and v.
    squares: [f64; 2],
    /// How far the body stood in the ground at rest (m).
    settled: f64,
    /// J so far, and its part of u times the squares of Housner's u (m2).
    sum: f64,
    sum_u: f64,
    /// Largest error.
    pub limit: f64,
}

impl<'a> RunningError<'a> {
    pub fn new(housner: &'a Motion, limit: f64) -> Self {
        let square = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().max(f64::MIN_POSITIVE);
        let squares = [square(&housner.u), square(&housner.v)];
        Self { housner, squares, settled: 0.0, sum: 0.0, sum_u: 0.0, limit }
    }

    /// sqrt(J/2), the mean NRMSE of u and v.
    pub fn mean(&self) -> f64 {
        (0.5 * self.sum).sqrt()
    }

    /// NRMSE of u.
    pub fn of_u(&self) -> f64 {
        (self.sum_u / self.squares[0]).sqrt()
    }
}

impl Observer for RunningError<'_> {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        if index == 0 {
            self.settled = view.z();
        }
        let (Some(&u), Some(&v)) = (self.housner.u.get(index), self.housner.v.get(index)) else {
            return ControlFlow::Break(());
        };
        let (du, dv) = (view.x() - u, view.z() - self.settled - v);
        self.sum += du * du / self.squares[0] + dv * dv / self.squares[1];
        self.sum_u += du * du;
        if self.sum > 2.0 * self.limit * self.limit {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}
