//! One Radau IIA step with the contact frozen: simplified Newton on the stage accelerations.

use num_complex::Complex;

use super::{
    model::{Contact, Foot, Model, N, State, TH, Vector},
    newton::{Chains, Matrix},
    radau::{A, A2, ALPHA, BETA, C, E, GAMMA, T, T_INV, position_weights},
};
use crate::scalar::{Scalar, real};

/// Iterations before a step counts as diverged.
const MOST_ITERATIONS: usize = 12;

/// Ground acceleration along a step, horizontal and vertical: value at its start [m/s2] and slope [m/s3].
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground<S> {
    pub start: [S; 2],
    pub slope: [S; 2],
}

impl<S: Scalar> Ground<S> {
    /// At a share of a time h [s] after the start.
    #[inline(always)]
    pub fn after(&self, h: S, share: f64) -> [S; 2] {
        [0, 1].map(|k| self.start[k] + self.slope[k] * h * share)
    }

    /// The same from a later time on [s].
    pub fn from(&self, time: S) -> Self {
        Self { start: self.after(time, 1.0), slope: self.slope }
    }
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
    /// Of no step yet.
    pub fn none() -> Self {
        let none = [[S::zero(); N]; 3];
        Self { h: S::zero(), a: none, q: none, v: none, iterations: 0, rate: 1.0 }
    }

    /// State at the end of the step.
    pub fn end(&self) -> State<S> {
        State { q: self.q[2], v: self.v[2] }
    }

    /// Work of the base excitation and dissipation in the dashpots over the step, by the step's own quadrature [J].
    pub fn work(&self, model: &Model<S>, feet: &[Foot<S>; 2], ground: &Ground<S>) -> (S, S) {
        let (mut input, mut dissipated) = (S::zero(), S::zero());
        for j in 0..3 {
            let weight = self.h * A[2][j];
            input += model.input_power(&self.v[j], ground.after(self.h, C[j])) * weight;
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

/// Takes steps of a model.
///
/// The Newton matrix is one of real numbers whatever the scalar is: the iteration makes derivatives converge as it does values,
/// by the same factor, and a matrix times a dual number is cheap where two dual numbers are not.
pub(super) struct Stepper<'a, S> {
    model: &'a Model<S>,
    real: Model<f64>,
    chains: Option<Shared>,
    /// The real matrix of the last step, for its error.
    matrix: Option<Matrix<f64>>,
}

/// What steps of one size under one contact share.
#[derive(Clone, Copy)]
struct Shared {
    h: f64,
    contact: [Contact; 2],
    real: Chains<f64>,
    pair: Chains<Complex<f64>>,
}

impl<'a, S: Scalar> Stepper<'a, S> {
    pub fn new(model: &'a Model<S>) -> Self {
        Self { model, real: model.real(), chains: None, matrix: None }
    }

    /// Condense the chains for this size and contact, unless the last step has.
    fn condense(&mut self, h: f64, feet: &[Foot<f64>; 2]) {
        let contact = feet.map(|foot| foot.contact);
        if !self.chains.as_ref().is_some_and(|shared| shared.h == h && shared.contact == contact) {
            let real = Chains::new(&self.real, feet, h * GAMMA, &|x| x);
            let pair = Chains::new(&self.real, feet, h * EIGENVALUE, &complex);
            self.chains = Some(Shared { h, contact, real, pair });
        }
    }

    /// Take the step into `s`; whether the iteration converges.
    pub fn step(&mut self, start: &State<S>, feet: &[Foot<S>; 2], request: &Request<S>, s: &mut Stages<S>) -> bool {
        let &Request { h, ground, guess, tolerance, extra, .. } = request;
        // The matrix is taken half way, where its error over the step is least.
        let hr = h.re();
        let mut middle = State { q: [0.0; N], v: [0.0; N] };
        for k in 0..N {
            middle.v[k] = start.v[k].re();
            middle.q[k] = start.q[k].re() + hr * middle.v[k] * 0.5;
        }
        let real_feet = feet.map(|foot| Foot { contact: foot.contact, anchor: foot.anchor.re() });
        self.condense(hr, &real_feet);
        let Some(shared) = &self.chains else { return false };
        let real_matrix: &Matrix<f64> =
            self.matrix.insert(Matrix::new(&shared.real, &self.real, &middle, &real_feet, hr * GAMMA, |x| x));
        let pair_matrix = Matrix::new(&shared.pair, &self.real, &middle, &real_feet, hr * EIGENVALUE, complex);

        let model = self.model;
        let masses = model.masses(feet);
        let radius = self.real.body.radius();
        // a gap rounded by some units in the last digit of R turns the body R/b times as far
        let rounding = 8.0 * f64::EPSILON * radius * radius / self.real.body.half_width;
        let grounds = C.map(|c| ground.after(h, c));
        let h2 = h * h;
        (s.h, s.a, s.iterations, s.rate) = (h, *guess, 0, request.rate);
        let (mut last, mut left) = (f64::INFINITY, None);
        loop {
            for i in 0..3 {
                let ([b0, b1, b2], [d0, d1, d2]) = (A2[i], A[i]);
                let hc = h * C[i];
                for k in 0..N {
                    let (a0, a1, a2) = (s.a[0][k], s.a[1][k], s.a[2][k]);
                    s.q[i][k] = start.q[k] + (start.v[k] * hc + (a0 * b0 + a1 * b1 + a2 * b2) * h2);
                    s.v[i][k] = start.v[k] + (a0 * d0 + a1 * d1 + a2 * d2) * h;
                }
            }
            if left == Some(0) {
                return true;
            }
            if s.iterations == MOST_ITERATIONS {
                return false;
            }
            s.iterations += 1;

            let mut residual = [[S::zero(); N]; 3];
            for i in 0..3 {
                residual[i] = model.forces(&s.q[i], &s.v[i], feet, grounds[i]);
                for k in 0..N {
                    residual[i][k] -= masses[k] * s.a[i][k];
                }
            }
            let mut r0 = [S::zero(); N];
            let mut r1 = [Complex::new(S::zero(), S::zero()); N];
            for k in 0..N {
                let (a, b, c) = (residual[0][k], residual[1][k], residual[2][k]);
                let mode = |row: usize| a * T_INV[row][0] + b * T_INV[row][1] + c * T_INV[row][2];
                r0[k] = mode(0);
                r1[k] = Complex::new(mode(1), -mode(2));
            }
            let w0 = real_matrix.solve(&shared.real, &r0, |x, t| x * t);
            let w1 = pair_matrix.solve(&shared.pair, &r1, times);

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
            // once converged, or as far as rounding lets it, what is left may well grow
            let rounded = s.iterations > 5 && change <= rounding;
            if !change.is_finite() || (left.is_none() && !rounded && s.iterations > 3 && change > 2.0 * last) {
                return false;
            }
            // geometric convergence: what is still missing is change * rate / (1 - rate)
            if last.is_finite() {
                s.rate = (change / last).min(1.0);
            }
            let missing = if s.rate < 1.0 { change * s.rate / (1.0 - s.rate) } else { f64::INFINITY };
            last = change;
            left = match left {
                Some(n) => Some(n - 1),
                None if rounded || change <= tolerance || missing <= tolerance => Some(extra),
                None => None,
            };
        }
    }
}

impl<S: Scalar> Stepper<'_, S> {
    /// What the step just taken from `start` misses, estimated: displacements, and the velocities that go with them.
    ///
    /// Hairer & Wanner, section IV.8, equations (8.17) to (8.19): a formula of order three on the same stages and the start, its
    /// stiff part filtered by the matrix of the real eigenvalue, here for M q'' = f(q, q', t) with s = h GAMMA,
    ///
    /// ```text
    ///   (M + s C + s^2 K) e_q = s^2 f(q_0, -d_q/s, t_0) + M (s q'_0 + d_q + s d_v)      e_v = (e_q - d_q)/s - q'_0
    ///   d_q = sum E_i (Q_i - q_0),  d_v = sum E_i (V_i - q'_0)
    /// ```
    ///
    /// where the velocity -d_q/s makes of f what s C would add. It needs no acceleration at the start, so that a rotation
    /// without inertia is no special case.
    pub fn local_error(&self, start: &State<S>, feet: &[Foot<S>; 2], ground: &Ground<S>, s: &Stages<S>) -> State<f64> {
        let none = State { q: [0.0; N], v: [0.0; N] };
        let (Some(shared), Some(matrix)) = (&self.chains, &self.matrix) else { return none };
        let root = s.h.re() * GAMMA;
        let (q, v) = (start.q.map(|x| x.re()), start.v.map(|x| x.re()));
        let change = |k: usize, stages: &[Vector<S>; 3], from: f64| -> f64 {
            (0..3).map(|i| E[i] * (stages[i][k].re() - from)).sum()
        };
        let d_q: Vector<f64> = std::array::from_fn(|k| change(k, &s.q, q[k]));
        let feet = feet.map(|foot| Foot { contact: foot.contact, anchor: foot.anchor.re() });
        let (forces, masses) = (
            self.real.forces(&q, &d_q.map(|d| -d / root), &feet, ground.start.map(|a| a.re())),
            self.real.masses(&feet),
        );
        let right = std::array::from_fn(|k| {
            root * root * forces[k] + masses[k] * (root * v[k] + d_q[k] + root * change(k, &s.v, v[k]))
        });
        let e_q = matrix.solve(&shared.real, &right, |x, t| x * t);
        State { q: e_q, v: std::array::from_fn(|k| (e_q[k] - d_q[k]) / root - v[k]) }
    }
}

/// ALPHA + i BETA.
const EIGENVALUE: Complex<f64> = Complex::new(ALPHA, BETA);

fn complex(x: f64) -> Complex<f64> {
    Complex::new(x, 0.0)
}

/// A complex number of any scalar times a real one's.
#[inline(always)]
fn times<S: Scalar>(x: Complex<S>, t: Complex<f64>) -> Complex<S> {
    Complex::new(x.re * t.re - x.im * t.im, x.re * t.im + x.im * t.re)
}

/// The acceleration everywhere zero: the guess after an event, when the old accelerations tell nothing.
pub(super) fn no_guess<S: Scalar>() -> [Vector<S>; 3] {
    [[real(0.0); N]; 3]
}
