//! One Radau IIA step with the contact frozen: simplified Newton on the stage accelerations.

use num_complex::Complex;

pub(super) use super::iterate::{
    Convergence, EIGENVALUE, Ground, IterationVerdict, LARGEST, embedded, from_modes, modes, stage,
};
use super::{
    cubic,
    model::{Contact, Foot, Model, N, Pose, State, TH, Vector, X, Z},
    newton::{Chains, CondensedMatrix},
    radau::{A, C, GAMMA, position_weights},
    turning::{self, Turning},
};

/// The stages of a converged step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stages {
    pub h: f64,
    /// Accelerations.
    pub a: [Vector; 3],
    /// Positions; the last is the step's end.
    pub q: [Vector; 3],
    /// Velocities.
    pub v: [Vector; 3],
    pub iterations: usize,
    /// Factor by which an iteration reduced the error, measured if there were two.
    pub rate: f64,
}

impl Stages {
    /// Of no step yet.
    pub(crate) fn none() -> Self {
        let none = [[0.0; N]; 3];
        Self { h: 0.0, a: none, q: none, v: none, iterations: 0, rate: 1.0 }
    }

    /// State at the end of the step.
    pub(crate) fn end(&self) -> State {
        State { q: self.q[2], v: self.v[2] }
    }

    /// Work of the base excitation and dissipation in the dashpots over the step, by the step's own
    /// quadrature (J).
    pub(crate) fn work(&self, model: &Model, feet: &[Foot; 2], ground: &Ground) -> (f64, f64) {
        let (mut input, mut dissipated) = (0.0, 0.0);
        for j in 0..3 {
            let weight = self.h * A[2][j];
            input += model.input_power(&self.v[j], ground.after(self.h, C[j])) * weight;
            dissipated += model.dissipation(&self.q[j], &self.v[j], feet) * weight;
        }
        (input, dissipated)
    }

    /// What members take of it (J).
    #[inline(never)]
    pub(crate) fn taken_by_members(&self, model: &Model, feet: &[Foot; 2]) -> f64 {
        let elements = model.elements_under(feet);
        let power = |j: usize| elements.add_dissipation(0.0, &self.q[j], &self.v[j]);
        (0..3).map(|j| self.h * A[2][j] * power(j)).sum()
    }

    /// Velocity at tau in 0..1 of the step that began at `start`: the cubic through that and the
    /// stages, the integral of their accelerations. The slope of [`Stages::position`] leaves out
    /// the start: it is a parabola, and errs by h^3 v'''/60 there.
    pub(crate) fn velocity(&self, start: &State, tau: f64) -> Vector {
        let [w0, w1, w2] = cubic::weights(tau);
        let [v0, v1, v2] = &self.v;
        std::array::from_fn(|k| {
            let from = start.v[k];
            from + (v0[k] - from) * w0 + (v1[k] - from) * w1 + (v2[k] - from) * w2
        })
    }

    /// Position on the collocation polynomial at tau in 0..1 of the step that began at `start`.
    pub(crate) fn position(&self, start: &State, tau: f64) -> Vector {
        let [w0, w1, w2] = position_weights(tau);
        let [v0, v1, v2] = &self.v;
        std::array::from_fn(|k| start.q[k] + self.h * (v0[k] * w0 + v1[k] * w1 + v2[k] * w2))
    }
}

/// What a step is asked for: size, tolerance and where to begin the iteration.
pub(super) struct Request {
    pub h: f64,
    pub ground: Ground,
    /// First guess of the acceleration at every stage.
    pub guess: [Vector; 3],
    /// A displacement (m) below which an iteration's correction no longer matters.
    pub tolerance: f64,
    /// The factor by which an iteration is expected to reduce the error, from the step before; 1 if
    /// unknown.
    pub rate: f64,
    /// The foot that the body turns about, if that counts.
    pub turning: Option<Turning>,
}

/// Takes steps of a model.
pub(super) struct Stepper<'a> {
    model: &'a Model,
    /// Correction of an iteration that rounding alone may make (m): a gap rounded by some units in
    /// the last digit of R turns the body R/b times as far.
    pub rounding: f64,
    chains: Option<Shared>,
    /// The real matrix of the last step, for its error.
    matrix: Option<CondensedMatrix<f64>>,
}

/// What steps of one size under one contact share.
#[derive(Clone, Copy)]
struct Shared {
    h: f64,
    contact: [Contact; 2],
    real: Chains<f64>,
    pair: Chains<Complex<f64>>,
}

/// A coordinate's correction at the stages, and what counts of it: of a body that turns about its
/// foot, from the foot's place.
#[inline(always)]
fn counted(
    k: usize,
    mut delta: [f64; 3],
    turn: [f64; 3],
    turning: Option<(Turning, [f64; 2])>,
    (turned, radius): (&[[f64; 2]; 3], f64),
) -> ([f64; 3], [f64; 3]) {
    let mut counts = delta;
    match turning {
        Some((_, lever)) if k == X || k == Z => {
            let carried = turning::carried(turn, [turned[0][k], turned[1][k], turned[2][k]]);
            for i in 0..3 {
                delta[i] -= carried[i];
                counts[i] += lever[k] * turn[i];
            }
        }
        Some((Turning { weight, .. }, _)) if k == TH => {
            counts = counts.map(|turn| turn * (radius * weight))
        }
        None if k == TH => counts = counts.map(|turn| turn * radius),
        _ => {}
    }
    (delta, counts)
}

/// The matrix of the real eigenvalue, and that of the pair.
type Matrices = (CondensedMatrix<f64>, CondensedMatrix<Complex<f64>>);

impl Shared {
    /// The matrices half way; of a body that turns about its foot with the forces at the start.
    #[inline(always)]
    fn matrices(
        &self,
        model: &Model,
        (start, middle): (&Vector, &State),
        feet: &[Foot; 2],
        turns: bool,
    ) -> Matrices {
        let (real, pair) = (self.h * GAMMA, self.h * EIGENVALUE);
        if turns {
            let contact = turning::contact([start, &middle.q].map(|q| model.contact(q, feet)));
            return (
                CondensedMatrix::rigid(&self.real, model, &contact, feet, real),
                CondensedMatrix::rigid(&self.pair, model, &contact, feet, pair),
            );
        }
        (
            CondensedMatrix::new(&self.real, model, middle, feet, real),
            CondensedMatrix::new(&self.pair, model, middle, feet, pair),
        )
    }
}

impl<'a> Stepper<'a> {
    pub(crate) fn new(model: &'a Model) -> Self {
        let radius = model.body.radius();
        let rounding = 8.0 * f64::EPSILON * radius * radius / model.body.half_width;
        Self { model, rounding, chains: None, matrix: None }
    }

    /// Condense the chains for this size and contact, unless the last step has.
    fn condense(&mut self, h: f64, feet: &[Foot; 2]) {
        let contact = feet.map(|foot| foot.contact);
        if !self.chains.as_ref().is_some_and(|shared| shared.h == h && shared.contact == contact) {
            let real = Chains::new(self.model, feet, h * GAMMA);
            let pair = Chains::new(self.model, feet, h * EIGENVALUE);
            self.chains = Some(Shared { h, contact, real, pair });
        }
    }

    /// Take the step into `s`; whether the iteration converges.
    pub(crate) fn step(
        &mut self,
        start: &State,
        feet: &[Foot; 2],
        request: &Request,
        s: &mut Stages,
    ) -> bool {
        let &Request { h, ground, guess, .. } = request;
        // The matrix is taken half way, where its error over the step is least.
        let mut middle = State { q: [0.0; N], v: [0.0; N] };
        for k in 0..N {
            middle.v[k] = start.v[k];
            middle.q[k] = start.q[k] + h * middle.v[k] * 0.5;
        }
        self.condense(h, feet);
        let Some(shared) = &self.chains else { return false };
        let model = self.model;
        let (real_matrix, pair_matrix) =
            shared.matrices(model, (&start.q, &middle), feet, request.turning.is_some());
        let real_matrix: &CondensedMatrix<f64> = self.matrix.insert(real_matrix);

        let masses = model.masses(feet);
        let radius = model.body.radius();
        let grounds = C.map(|c| ground.after(h, c));
        let mut convergence = Convergence::new(request.tolerance, self.rounding, request.rate);
        let turning = match real_matrix {
            CondensedMatrix::Rigid(rigid) => {
                request.turning.map(|turning| (turning, rigid.lever[turning.foot]))
            }
            _ => None,
        };
        (s.h, s.a) = (h, guess);
        loop {
            s.follow(start);
            (s.iterations, s.rate) = (convergence.iterations, convergence.rate);
            match convergence.verdict() {
                IterationVerdict::GoesOn => {}
                verdict => return verdict == IterationVerdict::Converged,
            }

            let (residual, turned) = s.residuals(model, feet, &masses, &grounds, turning);
            let mut r0 = [0.0; N];
            let mut r1 = [Complex::new(0.0, 0.0); N];
            for k in 0..N {
                (r0[k], r1[k]) = modes([residual[0][k], residual[1][k], residual[2][k]]);
            }
            let w0 = real_matrix.solve(&shared.real, &r0);
            let w1 = pair_matrix.solve(&shared.pair, &r1);

            let mut change: f64 = 0.0;
            let turn = from_modes(w0[TH], w1[TH]);
            for k in 0..N {
                let delta = from_modes(w0[k], w1[k]);
                let (delta, counts) = counted(k, delta, turn, turning, (&turned, radius));
                for i in 0..3 {
                    s.a[i][k] += delta[i];
                    change = change.max(counts[i].abs());
                }
            }
            if !convergence.moved(change * (LARGEST * (h * h))) {
                return false;
            }
        }
    }
}

impl Stages {
    /// Displacements and velocities that go with the accelerations.
    #[inline(always)]
    fn follow(&mut self, start: &State) {
        for i in 0..3 {
            for k in 0..N {
                let a = [self.a[0][k], self.a[1][k], self.a[2][k]];
                (self.q[i][k], self.v[i][k]) = stage(i, (start.q[k], start.v[k]), a, self.h);
            }
        }
    }

    /// The force that each stage's accelerations leave unbalanced; of a body that turns about its
    /// foot, its moment about the foot, and by how much the foot's lever has turned.
    #[inline(always)]
    fn residuals(
        &self,
        model: &Model,
        feet: &[Foot; 2],
        masses: &Vector,
        grounds: &[[f64; 2]; 3],
        turning: Option<(Turning, [f64; 2])>,
    ) -> ([Vector; 3], [[f64; 2]; 3]) {
        let mut residual = [[0.0; N]; 3];
        let mut turned = [[0.0; 2]; 3];
        for i in 0..3 {
            let pose = Pose::of(&self.q[i]);
            residual[i] = model.forces_at(&pose, &self.q[i], &self.v[i], feet, grounds[i]);
            for k in 0..N {
                residual[i][k] -= masses[k] * self.a[i][k];
            }
            if let Some((Turning { foot, .. }, lever)) = turning {
                let (_, _, px_th, pz_th) = model.foot(foot, &self.q[i], pose.sin, pose.cos);
                turned[i] = [px_th - lever[0], pz_th - lever[1]];
                let forces = [residual[i][X], residual[i][Z], residual[i][TH]];
                residual[i][TH] = turning::moment(forces, turned[i]);
            }
        }
        (residual, turned)
    }
}

impl Stepper<'_> {
    /// What the step just taken from `start` misses, estimated: displacements, and the velocities
    /// that go with them.
    ///
    /// Hairer & Wanner, section IV.8, equations (8.17) to (8.19): a formula of order three on the
    /// same stages and the start, its stiff part filtered by the matrix of the real eigenvalue,
    /// here for M q'' = f(q, q', t) with s = h GAMMA,
    ///
    /// ```text
    ///   (M + s C + s^2 K) e_q = s^2 f(q_0, -d_q/s, t_0) + M (s q'_0 + d_q + s d_v)      e_v = (e_q - d_q)/s - q'_0
    ///   d_q = sum E_i (Q_i - q_0),  d_v = sum E_i (V_i - q'_0)
    /// ```
    ///
    /// where the velocity -d_q/s makes of f what s C would add. It needs no acceleration at the
    /// start, so that a rotation without inertia is no special case.
    pub(crate) fn local_error(
        &self,
        start: &State,
        feet: &[Foot; 2],
        ground: &Ground,
        s: &Stages,
    ) -> State {
        let none = State { q: [0.0; N], v: [0.0; N] };
        let (Some(shared), Some(matrix)) = (&self.chains, &self.matrix) else { return none };
        let root = s.h * GAMMA;
        let per = root.recip();
        let State { q, v } = start;
        let d_q = std::array::from_fn(|k| embedded([0, 1, 2].map(|i| s.q[i][k]), q[k]));
        let d_v = std::array::from_fn(|k| embedded([0, 1, 2].map(|i| s.v[i][k]), v[k]));
        let forces = self.model.forces(q, &d_q.map(|d: f64| -d * per), feet, ground.start);
        let right = error_right(root, &forces, &self.model.masses(feet), v, &d_q, &d_v);
        let e_q = matrix.solve(&shared.real, &right);
        State { q: e_q, v: std::array::from_fn(|k| (e_q[k] - d_q[k]) * per - v[k]) }
    }
}

/// The right side of the equation for e_q, with s = `root`.
#[inline(always)]
pub(super) fn error_right(
    root: f64,
    forces: &Vector,
    masses: &Vector,
    v: &Vector,
    d_q: &Vector,
    d_v: &Vector,
) -> Vector {
    let mut right = [0.0; N];
    for k in 0..N {
        right[k] = root * root * forces[k] + masses[k] * (root * v[k] + d_q[k] + root * d_v[k]);
    }
    right
}

/// The acceleration everywhere zero: the guess after an event, when the old accelerations tell
/// nothing.
pub(super) const NO_GUESS: Vector = [0.0; N];
