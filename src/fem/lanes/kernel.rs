//! One Radau step of several histories side by side.
//!
//! Every loop over lanes is straight arithmetic on the functions that a history alone calls (`step`, `newton`, `model`), which the
//! compiler turns into vector operations. No operation is contracted or reordered, so that a lane's step is that of the history
//! alone, bit for bit, on any machine.

#![allow(clippy::needless_range_loop)] // one index over many arrays

use num_complex::Complex;

use crate::{
    fem::{
        model::{Contact, Foot, Model, N, Pose, State, TH, Vector},
        newton::{Chains, Condensed, Rigid},
        radau::{A, C, GAMMA},
        run::{Measures, OVERSHOOT, Scales},
        step::{
            Convergence, EIGENVALUE, Ground, LARGEST, Request, Stages, Verdict, complex, embedded, error_right,
            from_modes, modes, stage, times,
        },
    },
    scalar::{in_reach, small_sin_cos},
    spring::{Chain, Springs},
    structure::Body,
};

/// A block for each coordinate, written out: the compiler keeps a loop of many lines as a loop, and then leaves the lanes alone.
macro_rules! coordinates {
    ($k:ident => $block:block) => {
        coordinates!($k in 0 1 2 3 4 5 6 => $block)
    };
    ($k:ident in $($number:literal)+ => $block:block) => {
        $({
            const $k: usize = $number;
            $block
        })+
    };
}

/// Histories side by side.
pub(super) const WIDTH: usize = 8;

/// Iterations of a call: most steps need one or two, those after an event more.
const ROUNDS: usize = 2;

/// A number of each lane.
type Lanes = [f64; WIDTH];

/// Numbers that make up a factored matrix.
const ENTRIES: usize = 25;

/// What a history's model and scales are made of.
const FIXED: usize = 16;

/// The steps of all lanes: what is asked, and what comes out.
pub(super) struct Kernel {
    fixed: [Lanes; FIXED],
    scales: [Lanes; 4],
    q0: [Lanes; N],
    v0: [Lanes; N],
    anchor: [Lanes; 2],
    /// One where a foot is closed, or holds.
    closed: [Lanes; 2],
    holds: [Lanes; 2],
    h: Lanes,
    /// Ground acceleration along the step.
    start: [Lanes; 2],
    slope: [Lanes; 2],
    curve: [Lanes; 2],
    real: [Lanes; ENTRIES],
    pair: [[Lanes; ENTRIES]; 2],
    a: [[Lanes; N]; 3],
    q: [[Lanes; N]; 3],
    v: [[Lanes; N]; 3],
    residual: [[Lanes; N]; 3],
    /// Corrections in the eigenvectors of A: the real one, and both parts of the pair.
    w: [[Lanes; N]; 3],
    /// One where the iteration goes on.
    active: Lanes,
    /// One where the rotation left the reach of the polynomials for sine and cosine.
    steep: Lanes,
    /// The same where it was so at the step's start or half way.
    begins_steep: Lanes,
    change: Lanes,
    convergence: [Option<Convergence>; WIDTH],
    verdict: [Verdict; WIDTH],
    /// Whether a step has been asked for since the last call.
    fresh: bool,
    stored: Lanes,
    input: Lanes,
    dissipated: Lanes,
    missed: Lanes,
    /// One where no foot comes near a change of contact.
    clear: Lanes,
}

/// A lane's step, tried.
pub(super) enum Tried {
    /// Whether it converged, and what it did.
    Step(bool, Measures<f64>),
    /// It needs more iterations.
    GoesOn,
    /// It is to be tried by itself.
    Steep,
}

impl Kernel {
    pub fn new() -> Self {
        let none = [0.0; WIDTH];
        Self {
            // masses and lengths of one where there is no lane: no division by zero
            fixed: [[1.0; WIDTH]; FIXED],
            scales: [[1.0; WIDTH]; 4],
            q0: [none; N],
            v0: [none; N],
            anchor: [none; 2],
            closed: [none; 2],
            holds: [none; 2],
            h: [1.0; WIDTH],
            start: [none; 2],
            slope: [none; 2],
            curve: [none; 2],
            real: [none; ENTRIES],
            pair: [[none; ENTRIES]; 2],
            a: [[none; N]; 3],
            q: [[none; N]; 3],
            v: [[none; N]; 3],
            residual: [[none; N]; 3],
            w: [[none; N]; 3],
            active: none,
            steep: none,
            begins_steep: none,
            change: none,
            convergence: [None; WIDTH],
            verdict: [Verdict::Failed; WIDTH],
            fresh: false,
            stored: none,
            input: none,
            dissipated: none,
            missed: none,
            clear: none,
        }
    }

    /// Lane l follows this model from now on.
    pub fn seat(&mut self, l: usize, model: &Model<f64>, scales: &Scales) {
        let Springs { vertical: v, horizontal: h } = &model.springs;
        let Body { mass, half_width, height, inertia } = model.body;
        let chain = |c: &Chain<f64>| [c.k1, c.k2, c.m2, c.c];
        let ([a, b, c, d], [e, f, g, i]) = (chain(v), chain(h));
        let fixed = [
            mass,
            half_width,
            height,
            inertia,
            a,
            b,
            c,
            d,
            e,
            f,
            g,
            i,
            model.translation,
            model.rotation,
            scales.radius,
            0.0,
        ];
        for (to, from) in self.fixed.iter_mut().zip(fixed) {
            to[l] = from;
        }
        let &Scales { radius, share, moment, alpha } = scales;
        for (to, from) in self.scales.iter_mut().zip([radius, share, moment, alpha]) {
            to[l] = from;
        }
    }

    /// Lane l follows nothing any more.
    pub fn leave(&mut self, l: usize) {
        self.convergence[l] = None;
    }

    /// Ask lane l for a step.
    pub fn ask(&mut self, l: usize, state: &State<f64>, feet: &[Foot<f64>; 2], request: &Request<f64>, rounding: f64) {
        for k in 0..N {
            self.q0[k][l] = state.q[k];
            self.v0[k][l] = state.v[k];
            for i in 0..3 {
                self.a[i][k][l] = request.guess[i][k];
            }
        }
        for (i, foot) in feet.iter().enumerate() {
            self.anchor[i][l] = foot.anchor;
            self.closed[i][l] = f64::from(u8::from(foot.closed()));
            self.holds[i][l] = f64::from(u8::from(foot.holds()));
        }
        self.h[l] = request.h;
        for k in 0..2 {
            self.start[k][l] = request.ground.start[k];
            self.slope[k][l] = request.ground.slope[k];
            self.curve[k][l] = request.ground.curve[k];
        }
        self.convergence[l] = Some(Convergence::new(request, rounding));
        self.fresh = true;
    }

    /// What lane l's step came to; its stages, if it converged.
    pub fn tell(&self, l: usize, stages: &mut Stages<f64>) -> Tried {
        if self.steep[l] != 0.0 {
            return Tried::Steep;
        }
        stages.h = self.h[l];
        if let Some(convergence) = &self.convergence[l] {
            (stages.iterations, stages.rate) = (convergence.iterations, convergence.rate);
        }
        let converged = match self.verdict[l] {
            Verdict::GoesOn => return Tried::GoesOn,
            verdict => verdict == Verdict::Converged,
        };
        if converged {
            for i in 0..3 {
                for k in 0..N {
                    stages.a[i][k] = self.a[i][k][l];
                    stages.q[i][k] = self.q[i][k][l];
                    stages.v[i][k] = self.v[i][k][l];
                }
            }
        }
        let measures = Measures {
            stored: self.stored[l],
            input: self.input[l],
            dissipated: self.dissipated[l],
            missed: self.missed[l],
            clear: self.clear[l] != 0.0,
        };
        Tried::Step(converged, measures)
    }

    /// Go on with the steps of all lanes, a few iterations: those that need more go on with the next call, beside others' new steps.
    #[inline(always)]
    pub fn step(&mut self) {
        if self.fresh {
            self.factor();
            self.fresh = false;
        }
        self.steep = self.begins_steep;
        for round in 0..=ROUNDS {
            self.stages();
            let mut goes_on = false;
            for l in 0..WIDTH {
                let verdict = self.convergence[l].as_ref().map_or(Verdict::Failed, Convergence::verdict);
                self.verdict[l] = verdict;
                let runs = verdict == Verdict::GoesOn && self.steep[l] == 0.0;
                self.active[l] = f64::from(u8::from(runs));
                goes_on |= runs;
            }
            if !goes_on || round == ROUNDS {
                break;
            }
            for i in 0..3 {
                self.residuals(i);
            }
            self.correct();
            for l in 0..WIDTH {
                if let (Some(convergence), true) = (&mut self.convergence[l], self.active[l] != 0.0)
                    && !convergence.moved(self.change[l])
                {
                    convergence.give_up();
                }
            }
        }
        self.measure();
        self.account();
        self.clear();
    }

    #[inline(always)]
    fn model(&self, l: usize) -> Model<f64> {
        let f = |k: usize| self.fixed[k][l];
        let chain = |k: usize| Chain { k1: f(k), k2: f(k + 1), m2: f(k + 2), c: f(k + 3) };
        Model {
            body: Body { mass: f(0), half_width: f(1), height: f(2), inertia: f(3) },
            springs: Springs { vertical: chain(4), horizontal: chain(8) },
            translation: f(12),
            rotation: f(13),
            frame: None,
            friction: None,
            skip_open: true,
        }
    }

    #[inline(always)]
    fn feet(&self, l: usize) -> [Foot<f64>; 2] {
        [self.foot(0, l), self.foot(1, l)]
    }

    #[inline(always)]
    fn foot(&self, i: usize, l: usize) -> Foot<f64> {
        let (closed, holds) = (self.closed[i][l] != 0.0, self.holds[i][l] != 0.0);
        let pressing = if holds { Contact::Stick } else { Contact::Slide };
        Foot { contact: if closed { pressing } else { Contact::Open }, anchor: self.anchor[i][l] }
    }

    #[inline(always)]
    fn ground(&self, l: usize) -> Ground<f64> {
        Ground { start: column(&self.start, l), slope: column(&self.slope, l), curve: column(&self.curve, l) }
    }

    /// Where lane l is half way, at the velocity that it has.
    #[inline(always)]
    fn middle(&self, l: usize) -> Vector<f64> {
        let mut q = [0.0; N];
        for k in 0..N {
            q[k] = self.q0[k][l] + self.h[l] * self.v0[k][l] * 0.5;
        }
        q
    }

    /// Factor the matrices half way.
    #[inline(always)]
    fn factor(&mut self) {
        for l in 0..WIDTH {
            let (model, feet, h) = (self.model(l), self.feet(l), self.h[l]);
            let middle: Vector<f64> = self.middle(l);
            let contact = model.contact_at(&pose(&middle), &middle, &feet);
            let (masses, closed) = (model.masses(&feet), [feet[0].closed(), feet[1].closed()]);
            let chains = Chains::new(&model, &feet, h * GAMMA, &|x| x);
            let rigid = Rigid::new(&chains, &contact, &masses, closed, h * GAMMA, |x| x);
            let entries = pack(&chains, &rigid);
            for e in 0..ENTRIES {
                self.real[e][l] = entries[e];
            }
        }
        for l in 0..WIDTH {
            let (model, feet, h) = (self.model(l), self.feet(l), self.h[l]);
            let middle: Vector<f64> = self.middle(l);
            let contact = model.contact_at(&pose(&middle), &middle, &feet);
            let (masses, closed) = (model.masses(&feet), [feet[0].closed(), feet[1].closed()]);
            let chains = Chains::new(&model, &feet, h * EIGENVALUE, &complex);
            let rigid = Rigid::new(&chains, &contact, &masses, closed, h * EIGENVALUE, complex);
            let entries = pack(&chains, &rigid);
            for e in 0..ENTRIES {
                self.pair[0][e][l] = entries[e].re;
                self.pair[1][e][l] = entries[e].im;
            }
            let reached = in_reach(middle[TH]) & in_reach(self.q0[TH][l]);
            self.begins_steep[l] = if reached { 0.0 } else { 1.0 };
        }
    }

    /// Places and velocities at the stages.
    #[inline(always)]
    fn stages(&mut self) {
        for i in 0..3 {
            for l in 0..WIDTH {
                for k in 0..N {
                    let a = [self.a[0][k][l], self.a[1][k][l], self.a[2][k][l]];
                    let (q, v) = stage(i, (self.q0[k][l], self.v0[k][l]), a, self.h[l]);
                    self.q[i][k][l] = q;
                    self.v[i][k][l] = v;
                }
                self.steep[l] = if in_reach(self.q[i][TH][l]) { self.steep[l] } else { 1.0 };
            }
        }
    }

    /// What the equations of motion leave at stage i.
    #[inline(always)]
    fn residuals(&mut self, i: usize) {
        for l in 0..WIDTH {
            let (model, feet, h) = (self.model(l), self.feet(l), self.h[l]);
            let (q, v) = (column(&self.q[i], l), column(&self.v[i], l));
            let forces = model.forces_at(&pose(&q), &q, &v, &feet, self.ground(l).after(h, C[i]));
            let masses = model.masses(&feet);
            for k in 0..N {
                self.residual[i][k][l] = forces[k] - masses[k] * self.a[i][k][l];
            }
        }
    }

    /// Solve for the correction of the accelerations, and add it where the iteration goes on.
    #[inline(always)]
    fn correct(&mut self) {
        for l in 0..WIDTH {
            let (chains, rigid) = unpack(&column(&self.real, l), self.shut(l));
            let mut r = [0.0; N];
            coordinates!(K => {
                r[K] = modes(self.left(K, l)).0;
            });
            let w = rigid.solve(&chains, &r, |x, t| x * t);
            coordinates!(K => {
                self.w[0][K][l] = w[K];
            });
        }
        for l in 0..WIDTH {
            let (re, im) = (column(&self.pair[0], l), column(&self.pair[1], l));
            let (chains, rigid) = unpack(&both(&re, &im), self.shut(l));
            let mut r = [Complex::new(0.0, 0.0); N];
            coordinates!(K => {
                r[K] = modes(self.left(K, l)).1;
            });
            let w = rigid.solve(&chains, &r, times);
            coordinates!(K => {
                self.w[1][K][l] = w[K].re;
                self.w[2][K][l] = w[K].im;
            });
        }
        for l in 0..WIDTH {
            let (mut change, h, active): (f64, f64, bool) = (0.0, self.h[l], self.active[l] != 0.0);
            let radius = self.scales[0][l];
            coordinates!(K => {
                let length = if K == TH { radius } else { 1.0 };
                let delta = from_modes(self.w[0][K][l], Complex::new(self.w[1][K][l], self.w[2][K][l]));
                coordinates!(I in 0 1 2 => {
                    let a = self.a[I][K][l];
                    self.a[I][K][l] = if active { a + delta[I] } else { a };
                    change = change.max((delta[I] * length).abs());
                });
            });
            self.change[l] = change * (LARGEST * (h * h));
        }
    }

    /// Lane l's residuals of a coordinate at the stages.
    #[inline(always)]
    fn left(&self, k: usize, l: usize) -> [f64; 3] {
        [self.residual[0][k][l], self.residual[1][k][l], self.residual[2][k][l]]
    }

    /// Which feet of lane l are closed.
    #[inline(always)]
    fn shut(&self, l: usize) -> [bool; 2] {
        [self.closed[0][l] != 0.0, self.closed[1][l] != 0.0]
    }

    /// The steps' local errors.
    #[inline(always)]
    fn measure(&mut self) {
        for l in 0..WIDTH {
            let (model, feet, root) = (self.model(l), self.feet(l), self.h[l] * GAMMA);
            let (q, v) = (column(&self.q0, l), column(&self.v0, l));
            let (mut d_q, mut d_v, mut rate) = ([0.0; N], [0.0; N], [0.0; N]);
            coordinates!(K => {
                d_q[K] = embedded([self.q[0][K][l], self.q[1][K][l], self.q[2][K][l]], q[K]);
                d_v[K] = embedded([self.v[0][K][l], self.v[1][K][l], self.v[2][K][l]], v[K]);
                rate[K] = -d_q[K] / root;
            });
            let forces = model.forces_at(&pose(&q), &q, &rate, &feet, column(&self.start, l));
            let right = error_right(root, &forces, &model.masses(&feet), &v, &d_q, &d_v);
            let (chains, rigid) = unpack(&column(&self.real, l), self.shut(l));
            let e_q = rigid.solve(&chains, &right, |x, t| x * t);
            let mut e_v = [0.0; N];
            coordinates!(K => {
                e_v[K] = (e_q[K] - d_q[K]) / root - v[K];
            });
            let error = State { q: e_q, v: e_v };
            let [radius, share, moment, alpha] = column(&self.scales, l);
            self.missed[l] = Scales { radius, share, moment, alpha }.missed(&error);
        }
    }

    /// Energy at the steps' ends, work and dissipation over them.
    #[inline(always)]
    fn account(&mut self) {
        for l in 0..WIDTH {
            let (model, feet) = (self.model(l), self.feet(l));
            let end = State { q: column(&self.q[2], l), v: column(&self.v[2], l) };
            self.stored[l] = model.energy_at(&pose(&end.q), &end, &feet);
            let (first, second, third) = (self.work(&model, l, 0), self.work(&model, l, 1), self.work(&model, l, 2));
            let (input, dissipated) = (first.0 + second.0 + third.0, first.1 + second.1 + third.1);
            (self.input[l], self.dissipated[l]) = (input, dissipated);
        }
    }

    /// Stage j's share of the work of the base excitation and of what is dissipated.
    #[inline(always)]
    fn work(&self, model: &Model<f64>, l: usize, j: usize) -> (f64, f64) {
        let (h, q, v) = (self.h[l], column(&self.q[j], l), column(&self.v[j], l));
        let weight = h * A[2][j];
        let input = model.input_power(&v, self.ground(l).after(h, C[j])) * weight;
        (input, model.dissipation(&q, &v, &self.feet(l)) * weight)
    }

    /// Whether the gaps' compressions at the nodes leave no room for a change of contact (`run/met`).
    #[inline(always)]
    fn clear(&mut self) {
        for l in 0..WIDTH {
            let (model, feet) = (self.model(l), self.feet(l));
            let nodes = [column(&self.q0, l), column(&self.q[0], l), column(&self.q[1], l), column(&self.q[2], l)];
            let mut clear = true;
            let poses = [pose(&nodes[0]), pose(&nodes[1]), pose(&nodes[2]), pose(&nodes[3])];
            coordinates!(I in 0 1 => {
                let sign = if feet[I].closed() { 1.0 } else { -1.0 };
                let mut inside = [0.0; 4];
                coordinates!(M in 0 1 2 3 => {
                    inside[M] = sign * model.compression_at(&poses[M], I, &nodes[M], &feet[I]);
                });
                let low = inside[0].min(inside[1]).min(inside[2].min(inside[3]));
                let high = inside[0].max(inside[1]).max(inside[2].max(inside[3])).max(0.0);
                // a sliding foot has a level of its own
                clear &= (low > OVERSHOOT * (high - low)) & (feet[I].closed() == feet[I].holds());
            });
            self.clear[l] = if clear { 1.0 } else { 0.0 };
        }
    }
}

/// Lane l's numbers.
#[inline(always)]
fn column<const M: usize>(rows: &[Lanes; M], l: usize) -> [f64; M] {
    let mut column = [0.0; M];
    for k in 0..M {
        column[k] = rows[k][l];
    }
    column
}

/// Complex numbers from their parts.
#[inline(always)]
fn both(re: &[f64; ENTRIES], im: &[f64; ENTRIES]) -> [Complex<f64>; ENTRIES] {
    let mut both = [Complex::new(0.0, 0.0); ENTRIES];
    coordinates!(E in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 => {
        both[E] = Complex::new(re[E], im[E]);
    });
    both
}

/// Sine and cosine within their polynomials' reach.
#[inline(always)]
fn pose(q: &Vector<f64>) -> Pose<f64> {
    let (sin, cos) = small_sin_cos(q[TH]);
    Pose { sin, cos }
}

/// A factored matrix as numbers in a row.
#[inline(always)]
fn pack<T: Copy>(chains: &Chains<T>, rigid: &Rigid<T>) -> [T; ENTRIES] {
    let ([[a, b], [c, d]], [[e, f], [g, h]]) = (&chains.0, &rigid.lever);
    #[rustfmt::skip]
    let entries = [
        a.pivot, a.coupling, a.share, a.stiffness,
        b.pivot, b.coupling, b.share, b.stiffness,
        c.pivot, c.coupling, c.share, c.stiffness,
        d.pivot, d.coupling, d.share, d.stiffness,
        *e, *f, *g, *h,
        rigid.x_inv, rigid.z_inv, rigid.th_inv, rigid.x_th, rigid.z_th,
    ];
    entries
}

#[inline(always)]
fn unpack<T: Copy>(e: &[T; ENTRIES], closed: [bool; 2]) -> (Chains<T>, Rigid<T>) {
    let condensed = |k: usize| Condensed { pivot: e[k], coupling: e[k + 1], share: e[k + 2], stiffness: e[k + 3] };
    let chains = Chains([[condensed(0), condensed(4)], [condensed(8), condensed(12)]]);
    let lever = [[e[16], e[17]], [e[18], e[19]]];
    (chains, Rigid { closed, lever, x_inv: e[20], z_inv: e[21], th_inv: e[22], x_th: e[23], z_th: e[24] })
}
