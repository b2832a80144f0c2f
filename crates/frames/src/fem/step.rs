//! One Radau IIA step with the contact frozen: simplified Newton on the stage accelerations.

use num_complex::Complex;

use super::{
    model::{CornerState, ElasticModel},
    newton::{FactoredMatrix, Tangent},
};
use dynamics::fem::{
    iterate::{
        Convergence, EIGENVALUE, Ground, IterationVerdict, LARGEST, embedded, from_modes, modes,
        stage,
    },
    radau::{A, C, GAMMA},
};

/// The stages of a step.
#[derive(Clone, Debug)]
pub(super) struct ElasticStages {
    /// (s)
    pub h: f64,
    /// Accelerations, places, velocities; the last is the step's end.
    pub a: [Vec<f64>; 3],
    pub q: [Vec<f64>; 3],
    pub v: [Vec<f64>; 3],
    /// Acceleration of the ground (m/s2).
    pub ground: [[f64; 2]; 3],
    pub iterations: usize,
    /// Factor by which an iteration reduced the error.
    pub rate: f64,
}

impl ElasticStages {
    pub(crate) fn new(size: usize) -> Self {
        let room = || [(); 3].map(|()| vec![0.0; size]);
        Self {
            h: 0.0,
            a: room(),
            q: room(),
            v: room(),
            ground: [[0.0; 2]; 3],
            iterations: 0,
            rate: 1.0,
        }
    }
}

/// What a step is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct ElasticRequest {
    /// (s)
    pub h: f64,
    pub ground: Ground,
    /// A displacement (m) below which an iteration's correction no longer matters.
    pub tolerance: f64,
    /// The factor by which an iteration is expected to reduce the error; 1 if unknown.
    pub rate: f64,
}

/// Takes steps of a model.
pub(super) struct ElasticStepper<'a> {
    model: &'a ElasticModel<'a>,
    /// What each coordinate is multiplied with to be a displacement (m or 1).
    pub lengths: Vec<f64>,
    rounding: f64,
    tangent: Tangent,
    real: FactoredMatrix<f64>,
    pair: FactoredMatrix<Complex<f64>>,
    /// The size and the contacts that the chains are condensed for.
    condensed: (f64, Vec<CornerState>),
    middle: [Vec<f64>; 2],
    residual: [Vec<f64>; 3],
    r0: Vec<f64>,
    r1: Vec<Complex<f64>>,
}

impl<'a> ElasticStepper<'a> {
    /// `rounding`: correction of an iteration that rounding alone may make (m).
    pub(crate) fn new(model: &'a ElasticModel<'a>, lengths: Vec<f64>, rounding: f64) -> Self {
        let room = || vec![0.0; model.size];
        Self {
            model,
            lengths,
            rounding,
            tangent: Tangent::new(model),
            real: FactoredMatrix::new(model),
            pair: FactoredMatrix::new(model),
            condensed: (0.0, Vec::new()),
            middle: [room(), room()],
            residual: [room(), room(), room()],
            r0: room(),
            r1: vec![Complex::new(0.0, 0.0); model.size],
        }
    }

    /// Matrices for a step of size h from q, q'; false if they are singular.
    fn prepare(&mut self, [q, v]: [&[f64]; 2], feet: &[CornerState], h: f64) -> bool {
        let Self { model, tangent, real, pair, condensed, middle, .. } = self;
        // half way, where the matrix's error over the step is least
        let [mq, mv] = middle;
        for k in 0..model.size {
            (mq[k], mv[k]) = (q[k] + 0.5 * h * v[k], v[k]);
        }
        let (s, pair_s) = (h * GAMMA, EIGENVALUE * h);
        if condensed.0 != h || condensed.1 != feet {
            real.condense(model, feet, s);
            pair.condense(model, feet, pair_s);
            condensed.0 = h;
            condensed.1.clear();
            condensed.1.extend_from_slice(feet);
        }
        tangent.take(model, mq, mv, feet);
        real.factor(model, tangent, feet, s) && pair.factor(model, tangent, feet, pair_s)
    }

    /// Take the step from q, q' into `s`, whose accelerations are the first guess; whether the
    /// iteration converges.
    pub(crate) fn step(
        &mut self,
        [q, v]: [&[f64]; 2],
        feet: &[CornerState],
        request: &ElasticRequest,
        s: &mut ElasticStages,
    ) -> bool {
        let &ElasticRequest { h, ground, tolerance, rate } = request;
        let size = self.model.size;
        if !self.prepare([q, v], feet, h) {
            return false;
        }
        let model = self.model;
        let mut convergence = Convergence::new(tolerance, self.rounding, rate);
        (s.h, s.ground) = (h, C.map(|c| ground.after(h, c)));
        loop {
            for i in 0..3 {
                for k in 0..size {
                    (s.q[i][k], s.v[i][k]) =
                        stage(i, (q[k], v[k]), [s.a[0][k], s.a[1][k], s.a[2][k]], h);
                }
            }
            (s.iterations, s.rate) = (convergence.iterations, convergence.rate);
            match convergence.verdict() {
                IterationVerdict::GoesOn => {}
                verdict => return verdict == IterationVerdict::Converged,
            }
            for (i, (residual, ground)) in self.residual.iter_mut().zip(s.ground).enumerate() {
                model.forces(&s.q[i], &s.v[i], feet, ground, residual);
                model.momentum(&s.a[i], &mut self.r0);
                for (r, m) in residual.iter_mut().zip(&self.r0) {
                    *r -= m;
                }
            }
            let [ra, rb, rc] = &self.residual;
            for k in 0..size {
                (self.r0[k], self.r1[k]) = modes([ra[k], rb[k], rc[k]]);
            }
            self.real.solve(model, &self.tangent, feet, &mut self.r0);
            self.pair.solve(model, &self.tangent, feet, &mut self.r1);
            let mut change: f64 = 0.0;
            for k in 0..size {
                for (a, delta) in s.a.iter_mut().zip(from_modes(self.r0[k], self.r1[k])) {
                    a[k] += delta;
                    change = change.max((delta * self.lengths[k]).abs());
                }
            }
            if !convergence.moved(change * (LARGEST * h * h)) {
                return false;
            }
        }
    }

    /// What the step just taken from q, q' misses, estimated as `dynamics::fem` does: the frame's
    /// largest displacement (m), and the largest momentum that goes with one (kg m/s).
    pub(crate) fn local_error(
        &mut self,
        [q, v]: [&[f64]; 2],
        feet: &[CornerState],
        ground: &Ground,
        s: &ElasticStages,
    ) -> [f64; 2] {
        let model = self.model;
        let root = s.h * GAMMA;
        let [d_q, d_v] = &mut self.middle;
        let [right, other, speed] = &mut self.residual;
        for k in 0..model.size {
            d_q[k] = embedded([s.q[0][k], s.q[1][k], s.q[2][k]], q[k]);
            d_v[k] = embedded([s.v[0][k], s.v[1][k], s.v[2][k]], v[k]);
            speed[k] = -d_q[k] / root;
            other[k] = root * v[k] + d_q[k] + root * d_v[k];
        }
        model.forces(q, speed, feet, ground.start, right);
        model.momentum(other, &mut self.r0);
        for (right, m) in right.iter_mut().zip(&self.r0) {
            *right = root * root * *right + m;
        }
        self.real.solve(model, &self.tangent, feet, right);
        for k in 0..model.size {
            speed[k] = (right[k] - d_q[k]) / root - v[k];
        }
        model.momentum(speed, other);
        let (mut place, mut momentum) = (0.0_f64, 0.0_f64);
        for (k, length) in self.lengths.iter().enumerate().take(model.n) {
            place = place.max((right[k] * length).abs());
            momentum = momentum.max((other[k] / length).abs());
        }
        [place, momentum]
    }

    /// Work of the ground and of the dashpots over the step, and impulse of every corner, by the
    /// step's own quadrature [J, N s].
    pub(crate) fn work(
        &self,
        feet: &[CornerState],
        ground: &Ground,
        s: &ElasticStages,
        impulses: &mut [[f64; 2]],
    ) -> [f64; 2] {
        let (mut input, mut dissipated) = (0.0, 0.0);
        impulses.fill([0.0; 2]);
        for j in 0..3 {
            let weight = s.h * A[2][j];
            input += weight * self.model.input_power(&s.v[j], ground.after(s.h, C[j]));
            dissipated += weight * self.model.dissipation(&s.q[j], &s.v[j], feet);
            for (i, (foot, impulse)) in feet.iter().zip(impulses.iter_mut()).enumerate() {
                let [h, p] = self.model.contact(i, foot, &s.q[j], &s.v[j]);
                (impulse[0], impulse[1]) = (impulse[0] + weight * h, impulse[1] + weight * p);
            }
        }
        [input, dissipated]
    }
}
