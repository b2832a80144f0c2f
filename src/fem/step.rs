//! One Radau IIA step with the contact frozen: simplified Newton on the stage accelerations.

use num_complex::Complex;

use super::{
    model::{Foot, Model, N, State, TH, Vector},
    newton::Newton,
    radau::{A, A2, ALPHA, BETA, C, GAMMA, T, T_INV, position_weights},
};
use crate::scalar::{Scalar, real};

/// Iterations before a step counts as diverged.
const MOST_ITERATIONS: usize = 12;

/// Ground acceleration along a step: value at its start [m/s2] and slope [m/s3].
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground<S> {
    pub start: S,
    pub slope: S,
}

/// The stages of a converged step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stages<S> {
    pub h: S,
    /// Accelerations.
    pub a: [Vector<S>; 3],
    /// Positions; the last is the step's end.
    pub q: [Vector<S>; 3],
    /// Velocities.
    pub v: [Vector<S>; 3],
    pub iterations: usize,
    /// Factor by which an iteration reduced the error, measured if there were two.
    pub rate: f64,
}

impl<S: Scalar> Stages<S> {
    /// State at the end of the step.
    pub fn end(&self) -> State<S> {
        State { q: self.q[2], v: self.v[2] }
    }

    /// Work of the base excitation and dissipation in the dashpots over the step, by the step's own quadrature [J].
    pub fn work(&self, model: &Model<S>, feet: &[Foot<S>; 2], ground: &Ground<S>) -> (S, S) {
        let (mut input, mut dissipated) = (S::zero(), S::zero());
        for j in 0..3 {
            let weight = self.h * A[2][j];
            let acceleration = ground.start + ground.slope * self.h * C[j];
            input += model.input_power(&self.v[j], acceleration) * weight;
            dissipated += model.dissipation(&self.q[j], &self.v[j], feet) * weight;
        }
        (input, dissipated)
    }

    /// Position on the collocation polynomial at tau in 0..1 of the step that began at `start`.
    pub fn position(&self, start: &State<S>, tau: f64) -> Vector<S> {
        let [w0, w1, w2] = position_weights(tau);
        let [v0, v1, v2] = &self.v;
        std::array::from_fn(|k| start.q[k] + self.h * (v0[k] * w0 + v1[k] * w1 + v2[k] * w2))
    }
}

/// What a step is asked for: size, tolerance and where to begin the iteration.
pub(super) struct Request<'a, S> {
    pub h: S,
    pub ground: Ground<S>,
    /// First guess of the acceleration at every stage.
    pub guess: &'a [Vector<S>; 3],
    /// A displacement [m] below which an iteration's correction no longer matters.
    pub tolerance: f64,
    /// Iterations to add after convergence, so that derivatives converge too.
    pub extra: usize,
    /// The factor by which an iteration is expected to reduce the error, from the step before; 1 if unknown.
    pub rate: f64,
}

/// Take the step; `None` when the iteration does not converge.
pub(super) fn step<S: Scalar>(
    model: &Model<S>,
    start: &State<S>,
    feet: &[Foot<S>; 2],
    request: &Request<S>,
) -> Option<Stages<S>> {
    let &Request { h, ground, guess, tolerance, extra, .. } = request;
    // The matrix is taken half way, where its error over the step is least.
    let mut middle = *start;
    for k in 0..N {
        middle.q[k] += h * start.v[k] * 0.5;
    }
    let real_newton = Newton::new(model, &middle, feet, h * GAMMA, |x: S| x);
    let pair = Complex::new(h * ALPHA, h * BETA);
    let pair_newton = Newton::new(model, &middle, feet, pair, |x: S| Complex::new(x, S::zero()));

    let masses = model.masses(feet);
    let radius = model.body.radius().re();
    let grounds = C.map(|c| ground.start + ground.slope * h * c);
    let h2 = h * h;
    let base: [Vector<S>; 3] = C.map(|c| std::array::from_fn(|k| start.q[k] + h * start.v[k] * c));
    let mut s = Stages { h, a: *guess, q: base, v: [start.v; 3], iterations: 0, rate: request.rate };
    let (mut last, mut left) = (f64::INFINITY, None);
    loop {
        for i in 0..3 {
            let [a0, a1, a2] = &s.a;
            let ([b0, b1, b2], [d0, d1, d2]) = (A2[i], A[i]);
            s.q[i] = std::array::from_fn(|k| base[i][k] + h2 * (a0[k] * b0 + a1[k] * b1 + a2[k] * b2));
            s.v[i] = std::array::from_fn(|k| start.v[k] + h * (a0[k] * d0 + a1[k] * d1 + a2[k] * d2));
        }
        if left == Some(0) {
            return Some(s);
        }
        if s.iterations == MOST_ITERATIONS {
            return None;
        }
        s.iterations += 1;

        let mut residual = [[S::zero(); N]; 3];
        for i in 0..3 {
            residual[i] = model.forces(&s.q[i], &s.v[i], feet, grounds[i]);
            for k in 0..N {
                residual[i][k] -= masses[k] * s.a[i][k];
            }
        }
        let mode = |row: usize, k: usize| {
            residual[0][k] * T_INV[row][0] + residual[1][k] * T_INV[row][1] + residual[2][k] * T_INV[row][2]
        };
        let r0: Vector<S> = std::array::from_fn(|k| mode(0, k));
        let r1: [Complex<S>; N] = std::array::from_fn(|k| Complex::new(mode(1, k), -mode(2, k)));
        let (w0, w1) = (real_newton.solve(&r0), pair_newton.solve(&r1));

        let mut change: f64 = 0.0;
        for k in 0..N {
            let length = if k == TH { radius } else { 1.0 };
            for (a, [t0, t1, t2]) in s.a.iter_mut().zip(T) {
                let delta = w0[k] * t0 + w1[k].re * t1 - w1[k].im * t2;
                a[k] += delta;
                change = change.max((delta.re() * length).abs());
            }
        }
        // the largest coefficient of A^2 is 0.32
        change *= 0.32 * h2.re();
        // once converged, what is left is rounding and may well grow
        if !change.is_finite() || (left.is_none() && s.iterations > 3 && change > 2.0 * last) {
            return None;
        }
        // geometric convergence: what is still missing is change * rate / (1 - rate)
        if last.is_finite() {
            s.rate = (change / last).min(1.0);
        }
        let missing = if s.rate < 1.0 { change * s.rate / (1.0 - s.rate) } else { f64::INFINITY };
        last = change;
        left = match left {
            Some(n) => Some(n - 1),
            None if change <= tolerance || missing <= tolerance => Some(extra),
            None => None,
        };
    }
}

/// The acceleration everywhere zero: the guess after an event, when the old accelerations tell nothing.
pub(super) fn no_guess<S: Scalar>() -> [Vector<S>; 3] {
    [[real(0.0); N]; 3]
}
