//! One step of the Radau IIA method of order 5 (`fem::radau`), for where stiffness, not accuracy,
//! would limit the steps of the explicit method: a light node on a stiff, damped member.
//!
//! ```text
//!   q_i = q + c_i h v + h^2 sum (A^2)_ij a_j,   v_i = v + h sum A_ij a_j,   a_i = a(q_i, v_i, t + c_i h)
//! ```
//!
//! by simplified Newton iterations, J = da/dq and da/dv at the start with the corners on the ground
//! held.

use nalgebra::{DMatrix, DVector, Dyn, LU};
use num_complex::Complex;

use super::state::{Rates, ReferenceState, ReferenceStep, StepTolerance};
use dynamics::fem::{
    iterate::{Convergence, EIGENVALUE, IterationVerdict, embedded, from_modes, modes, stage},
    radau::{A, C, GAMMA},
};

/// The order of the error estimate in h.
const ORDER: f64 = 4.0;
/// A correction that matters no more, as a share of the error allowed.
const CONVERGED: f64 = 0.1;

/// I - z J_v - z^2 J_q, factored.
fn factored<S: nalgebra::ComplexField<RealField = f64>>(
    [by_q, by_v]: &[DMatrix<f64>; 2],
    z: S,
) -> LU<S, Dyn, Dyn> {
    let n = by_q.nrows();
    let entry = |i: usize, j: usize| {
        let unit = if i == j { S::one() } else { S::zero() };
        unit - z.clone() * (z.clone().scale(by_q[(i, j)]) + S::from_real(by_v[(i, j)]))
    };
    DMatrix::from_fn(n, n, entry).lu()
}

/// The state after a step of length h, with the embedded estimate of order 3. `jacobian`: da/dq and
/// da/dv. None if the iteration does not converge or the rates are not defined.
pub(crate) fn step(
    mut rates: impl FnMut(f64, &ReferenceState) -> Option<Rates>,
    jacobian: &[DMatrix<f64>; 2],
    (start, first): (&ReferenceState, &Rates),
    h: f64,
    rtol: f64,
) -> Option<ReferenceStep> {
    let n = start.q.len();
    let real = factored(jacobian, h * GAMMA);
    let pair = factored(jacobian, EIGENVALUE * h);
    let scale = StepTolerance(rtol);
    let mut a: [DVector<f64>; 3] = std::array::from_fn(|_| first.a.clone());
    let mut stages: [ReferenceState; 3] = std::array::from_fn(|_| start.clone());
    let mut convergence = Convergence::new(CONVERGED, 0.0, 1.0);
    loop {
        let mut powers = [[0.0; 3]; 3];
        let mut residual = [(); 3].map(|()| DVector::zeros(n));
        for (i, at) in stages.iter_mut().enumerate() {
            for k in 0..n {
                (at.q[k], at.v[k]) =
                    stage(i, (start.q[k], start.v[k]), a.each_ref().map(|a| a[k]), h);
            }
            let should = rates(C[i] * h, at)?;
            (residual[i], powers[i]) = (should.a - &a[i], should.power);
        }
        match convergence.verdict() {
            IterationVerdict::GoesOn => {}
            IterationVerdict::Failed => return None,
            IterationVerdict::Converged => {
                let error = estimate(&stages, (start, first), jacobian, &real, h, rtol)?;
                let [_, _, mut end] = stages;
                for (weight, power) in A[2].iter().zip(powers) {
                    end.work
                        .iter_mut()
                        .zip(power)
                        .for_each(|(work, power)| *work += h * weight * power);
                }
                return Some(ReferenceStep { state: end, error, order: ORDER, last: None });
            }
        }
        let mut r0 = DVector::zeros(n);
        let mut r1 = DVector::from_element(n, Complex::new(0.0, 0.0));
        for k in 0..n {
            (r0[k], r1[k]) = modes(residual.each_ref().map(|r| r[k]));
        }
        if !(real.solve_mut(&mut r0) && pair.solve_mut(&mut r1)) {
            return None;
        }
        let mut change: f64 = 0.0;
        for k in 0..n {
            let (q, v) =
                (scale.place(start.q[k], start.q[k]), scale.velocity(start.v[k], start.v[k]));
            for (a, delta) in a.iter_mut().zip(from_modes(r0[k], r1[k])) {
                a[k] += delta;
                change = change.max((h * delta / v).abs()).max((h * h * delta / q).abs());
            }
        }
        if !convergence.moved(change) {
            return None;
        }
    }
}

/// The error over what is allowed: the defect of the formula of order 3, passed through the step's
/// own matrix so that stiff components do not decide it. It is two orders below the step's own
/// error, and is allowed as much more.
fn estimate(
    stages: &[ReferenceState; 3],
    (start, first): (&ReferenceState, &Rates),
    [by_q, _]: &[DMatrix<f64>; 2],
    real: &LU<f64, Dyn, Dyn>,
    h: f64,
    rtol: f64,
) -> Option<f64> {
    let n = start.q.len();
    let allowed = StepTolerance(0.1 * rtol.powf(2.0 / 3.0));
    let defect = |of: &dyn Fn(&ReferenceState) -> f64, rate: f64| {
        h * GAMMA * rate + embedded(stages.each_ref().map(of), of(start))
    };
    let of_q = DVector::from_fn(n, |k, _| defect(&|s| s.q[k], start.v[k]));
    let mut of_v = DVector::from_fn(n, |k, _| defect(&|s| s.v[k], first.a[k]));
    of_v.gemv(h * GAMMA, by_q, &of_q, 1.0);
    let of_v = real.solve(&of_v)?;
    let of_q = of_q + &of_v * (h * GAMMA);
    let end = &stages[2];
    let share = |k: usize| {
        let of_q = of_q[k] / allowed.place(start.q[k], end.q[k]);
        let of_v = of_v[k] / allowed.velocity(start.v[k], end.v[k]);
        of_q * of_q + of_v * of_v
    };
    let squares: f64 = (0..n).map(share).sum();
    let error = (squares / (2 * n) as f64).sqrt();
    error.is_finite().then_some(error)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// q'' = -k (q - cos t) - c q' + cos'', and its Jacobian: q = cos t if it starts there and k or
    /// c is large.
    fn towards_a_cosine(
        k: f64,
        c: f64,
    ) -> (impl Fn(f64, &ReferenceState) -> Option<Rates>, [DMatrix<f64>; 2]) {
        let rates = move |t: f64, y: &ReferenceState| {
            let a = -k * (y.q[0] - t.cos()) - c * (y.v[0] + t.sin()) - t.cos();
            Some(Rates {
                a: DVector::from_element(1, a),
                power: [y.v[0] * y.v[0], 0.0, 0.0],
                forces: vec![],
            })
        };
        (rates, [-k, -c].map(|x| DMatrix::from_element(1, 1, x)))
    }

    fn one(h: f64, k: f64, c: f64) -> ReferenceStep {
        let (rates, jacobian) = towards_a_cosine(k, c);
        let start = ReferenceState {
            q: DVector::from_element(1, 1.0),
            v: DVector::zeros(1),
            work: [0.0; 3],
        };
        let first = rates(0.0, &start).unwrap();
        step(rates, &jacobian, (&start, &first), h, 1e-9).unwrap()
    }

    #[test]
    fn the_order_is_five_and_the_estimate_is_above_the_error() {
        let error = |h: f64| (one(h, 1.0, 0.1).state.q[0] - h.cos()).abs();
        let order = (error(0.4) / error(0.2)).log2();
        assert!((5.7..6.5).contains(&order), "{order}");
        let taken = one(0.05, 1.0, 0.1);
        assert!(
            taken.error < 1.0 && error(0.05) < 1e-9 * 0.01,
            "{} {:e}",
            taken.error,
            error(0.05)
        );
        // work: the integral of sin^2
        let work = 0.5 * 0.05 - 0.25 * (0.1_f64).sin();
        assert!((taken.state.work[0] - work).abs() < 1e-9, "{:e}", taken.state.work[0] - work);
    }

    /// A thousand times the step at which the explicit method becomes unstable.
    #[test]
    fn stiffness_does_not_limit_the_step() {
        let taken = one(0.01, 1e8, 1e6);
        assert!(taken.error < 1.0, "{}", taken.error);
        assert!(
            (taken.state.q[0] - 0.01_f64.cos()).abs() < 1e-9
                && (taken.state.v[0] + 0.01_f64.sin()).abs() < 1e-9
        );
    }
}
