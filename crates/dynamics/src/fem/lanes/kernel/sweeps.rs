//! The loops over lanes.

use num_complex::Complex;

use super::{
    Kernel, WIDTH,
    rows::{ENTRIES, both, column, pack, unpack},
};
use crate::{
    fem::{
        contact::ContactLaw,
        element::Elements,
        model::{Contact, Foot, FootForce, Model, N, Pose, State, TH, Vector, X, Z},
        newton::{Chains, Rigid},
        radau::{A, C, GAMMA},
        run::{Scales, stays_inside},
        step::{EIGENVALUE, Ground, LARGEST, embedded, error_right, from_modes, modes, stage},
        turning,
    },
    spring::{Chain, Springs},
};
use rocking::{
    scalar::{in_reach, small_sin_cos},
    structure::Body,
};

impl Kernel {
    #[inline(always)]
    fn model(&self, l: usize) -> Model {
        let f = |k: usize| self.fixed[k][l];
        let chain = |k: usize| Chain { k1: f(k), k2: f(k + 1), m2: f(k + 2), c: f(k + 3) };
        Model {
            body: Body { mass: f(0), half_width: f(1), height: f(2), inertia: f(3) },
            springs: Springs { vertical: chain(4), horizontal: chain(8) },
            translation: f(12),
            rotation: f(13),
            law: ContactLaw::Sticking,
            // written out: of a constant the compiler copies the bytes, and then does not see that
            // there are none
            elements: Elements { dampers: None, tendon: None },
            skip_open: true,
        }
    }

    #[inline(always)]
    fn feet(&self, l: usize) -> [Foot; 2] {
        [self.foot(0, l), self.foot(1, l)]
    }

    #[inline(always)]
    fn foot(&self, i: usize, l: usize) -> Foot {
        let (closed, holds) = (self.closed[i][l] != 0.0, self.holds[i][l] != 0.0);
        let pressing = if holds { Contact::Stick } else { Contact::Slide };
        Foot { contact: if closed { pressing } else { Contact::Open }, anchor: self.anchor[i][l] }
    }

    #[inline(always)]
    fn ground(&self, l: usize) -> Ground {
        Ground {
            start: column(&self.start, l),
            slope: column(&self.slope, l),
            curve: column(&self.curve, l),
        }
    }

    /// Where lane l is half way, at the velocity that it has.
    #[inline(always)]
    fn middle(&self, l: usize) -> Vector {
        let mut q = [0.0; N];
        for k in 0..N {
            q[k] = self.q0[k][l] + self.h[l] * self.v0[k][l] * 0.5;
        }
        q
    }

    /// The feet's forces and levers that lane l's matrices are taken with.
    #[inline(always)]
    fn contact(
        &self,
        l: usize,
        model: &Model,
        feet: &[Foot; 2],
        middle: &Vector,
    ) -> [FootForce; 2] {
        let start = column(&self.q0, l);
        let [at_start, half_way] = [
            model.contact_at(&pose(&start), &start, feet),
            model.contact_at(&pose(middle), middle, feet),
        ];
        let turns = turning::contact([at_start, half_way]);
        let turning = self.turning[l] != 0.0;
        let force = |i: usize| FootForce {
            horizontal: if turning { turns[i].horizontal } else { half_way[i].horizontal },
            vertical: if turning { turns[i].vertical } else { half_way[i].vertical },
            ..half_way[i]
        };
        [force(0), force(1)]
    }

    /// Factor the matrices half way.
    #[inline(always)]
    pub(super) fn factor(&mut self) {
        for l in 0..WIDTH {
            let (model, feet, h) = (self.model(l), self.feet(l), self.h[l]);
            let middle: Vector = self.middle(l);
            let contact = self.contact(l, &model, &feet, &middle);
            let (masses, closed) = (model.masses(&feet), [feet[0].closed(), feet[1].closed()]);
            let chains = Chains::new(&model, &feet, h * GAMMA);
            let rigid = Rigid::new(&chains, &contact, &masses, closed, h * GAMMA);
            let entries = pack(&chains, &rigid);
            for e in 0..ENTRIES {
                self.real[e][l] = entries[e];
            }
            let [left, right] = rigid.lever;
            self.lever[0][l] = if closed[0] { left[0] } else { right[0] };
            self.lever[1][l] = if closed[0] { left[1] } else { right[1] };
        }
        for l in 0..WIDTH {
            let (model, feet, h) = (self.model(l), self.feet(l), self.h[l]);
            let middle: Vector = self.middle(l);
            let contact = self.contact(l, &model, &feet, &middle);
            let (masses, closed) = (model.masses(&feet), [feet[0].closed(), feet[1].closed()]);
            let chains = Chains::new(&model, &feet, h * EIGENVALUE);
            let rigid = Rigid::new(&chains, &contact, &masses, closed, h * EIGENVALUE);
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
    pub(super) fn stages(&mut self) {
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
    pub(super) fn residuals(&mut self, i: usize) {
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

    /// How the levers differ at stage i, and what that leaves of the moment.
    #[inline(always)]
    pub(super) fn turn(&mut self, i: usize) {
        for l in 0..WIDTH {
            let model = self.model(l);
            let q = column(&self.q[i], l);
            let Pose { sin, cos } = pose(&q);
            let ((_, _, left_x, left_z), (_, _, right_x, right_z)) =
                (model.foot(0, &q, sin, cos), model.foot(1, &q, sin, cos));
            let on_left = self.closed[0][l] != 0.0;
            let (lever_x, lever_z) = (self.lever[0][l], self.lever[1][l]);
            let turned = [
                if on_left { left_x } else { right_x } - lever_x,
                if on_left { left_z } else { right_z } - lever_z,
            ];
            let [x, z, th] =
                [self.residual[i][X][l], self.residual[i][Z][l], self.residual[i][TH][l]];
            let moment = turning::moment([x, z, th], turned);
            self.residual[i][TH][l] = if self.turning[l] != 0.0 { moment } else { th };
            self.turned[i][0][l] = turned[0];
            self.turned[i][1][l] = turned[1];
        }
    }

    /// Solve for the correction of the accelerations, and add it where the iteration goes on.
    #[inline(always)]
    pub(super) fn correct(&mut self) {
        for l in 0..WIDTH {
            let (chains, rigid) = unpack(&column(&self.real, l), self.shut(l));
            let mut r = [0.0; N];
            coordinates!(K => {
                r[K] = modes(self.left(K, l)).0;
            });
            let w = rigid.solve(&chains, &r);
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
            let w = rigid.solve(&chains, &r);
            coordinates!(K => {
                self.w[1][K][l] = w[K].re;
                self.w[2][K][l] = w[K].im;
            });
        }
        for l in 0..WIDTH {
            let (mut change, h, active): (f64, f64, bool) = (0.0, self.h[l], self.active[l] != 0.0);
            let turning = self.turning[l] != 0.0;
            let length = self.scales[0][l] * self.weight[l];
            let turn = self.delta(TH, l);
            coordinates!(K => {
                let delta = self.delta(K, l);
                let (delta, counts) = if K == X || K == Z {
                    // their rows; the remainder only bounds the index where K is neither
                    let [t0, t1, t2] = &self.turned;
                    let turned = [t0[K % 2][l], t1[K % 2][l], t2[K % 2][l]];
                    let (carried, lever) = (turning::carried(turn, turned), self.lever[K % 2][l]);
                    let free = [
                        delta[0] - carried[0],
                        delta[1] - carried[1],
                        delta[2] - carried[2],
                    ];
                    let foot = [
                        delta[0] + turn[0] * lever,
                        delta[1] + turn[1] * lever,
                        delta[2] + turn[2] * lever,
                    ];
                    (pick(turning, free, delta), pick(turning, foot, delta))
                } else if K == TH {
                    (delta, [delta[0] * length, delta[1] * length, delta[2] * length])
                } else {
                    (delta, delta)
                };
                coordinates!(I in 0 1 2 => {
                    let a = self.a[I][K][l];
                    self.a[I][K][l] = if active { a + delta[I] } else { a };
                    change = change.max(counts[I].abs());
                });
            });
            self.change[l] = change * (LARGEST * (h * h));
        }
    }

    /// Lane l's corrections of a coordinate at the stages, as the matrices have them.
    #[inline(always)]
    fn delta(&self, k: usize, l: usize) -> [f64; 3] {
        from_modes(self.w[0][k][l], Complex::new(self.w[1][k][l], self.w[2][k][l]))
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
    pub(super) fn measure(&mut self) {
        for l in 0..WIDTH {
            let (model, feet, root) = (self.model(l), self.feet(l), self.h[l] * GAMMA);
            let per = root.recip();
            let (q, v) = (column(&self.q0, l), column(&self.v0, l));
            let (mut d_q, mut d_v, mut rate) = ([0.0; N], [0.0; N], [0.0; N]);
            coordinates!(K => {
                d_q[K] = embedded([self.q[0][K][l], self.q[1][K][l], self.q[2][K][l]], q[K]);
                d_v[K] = embedded([self.v[0][K][l], self.v[1][K][l], self.v[2][K][l]], v[K]);
                rate[K] = -d_q[K] * per;
            });
            let forces = model.forces_at(&pose(&q), &q, &rate, &feet, column(&self.start, l));
            let right = error_right(root, &forces, &model.masses(&feet), &v, &d_q, &d_v);
            let (chains, rigid) = unpack(&column(&self.real, l), self.shut(l));
            let e_q = rigid.solve(&chains, &right);
            let mut e_v = [0.0; N];
            coordinates!(K => {
                e_v[K] = (e_q[K] - d_q[K]) * per - v[K];
            });
            let error = State { q: e_q, v: e_v };
            let [radius, share, moment, alpha] = column(&self.scales, l);
            self.missed[l] = Scales { radius, share, moment, alpha }.missed(&error);
        }
    }

    /// Energy at the steps' ends, work and dissipation over them.
    #[inline(always)]
    pub(super) fn account(&mut self) {
        for l in 0..WIDTH {
            let (model, feet) = (self.model(l), self.feet(l));
            let end = State { q: column(&self.q[2], l), v: column(&self.v[2], l) };
            self.stored[l] = model.energy_at(&pose(&end.q), &end, &feet);
            let (first, second, third) =
                (self.work(&model, l, 0), self.work(&model, l, 1), self.work(&model, l, 2));
            let (input, dissipated) = (first.0 + second.0 + third.0, first.1 + second.1 + third.1);
            (self.input[l], self.dissipated[l]) = (input, dissipated);
        }
    }

    /// Stage j's share of the work of the base excitation and of what is dissipated.
    #[inline(always)]
    fn work(&self, model: &Model, l: usize, j: usize) -> (f64, f64) {
        let (h, q, v) = (self.h[l], column(&self.q[j], l), column(&self.v[j], l));
        let weight = h * A[2][j];
        let input = model.input_power(&v, self.ground(l).after(h, C[j])) * weight;
        (input, model.dissipation(&q, &v, &self.feet(l)) * weight)
    }

    /// The gaps' compressions at the nodes, and whether they leave every contact what it is
    /// (`run/met`).
    #[inline(always)]
    pub(super) fn contacts(&mut self) {
        for l in 0..WIDTH {
            let (model, feet) = (self.model(l), self.feet(l));
            let nodes = [
                column(&self.q0, l),
                column(&self.q[0], l),
                column(&self.q[1], l),
                column(&self.q[2], l),
            ];
            let mut unchanged = true;
            let poses = [pose(&nodes[0]), pose(&nodes[1]), pose(&nodes[2]), pose(&nodes[3])];
            coordinates!(I in 0 1 => {
                let sign = if feet[I].closed() { 1.0 } else { -1.0 };
                let mut inside = [0.0; 4];
                coordinates!(M in 0 1 2 3 => {
                    let gap = model.compression_at(&poses[M], I, &nodes[M]);
                    self.gaps[I][M][l] = gap;
                    inside[M] = sign * gap;
                });
                // a sliding foot has a level of its own
                unchanged &= stays_inside(&inside, self.gap_tolerance[l])
                    & (feet[I].closed() == feet[I].holds());
            });
            self.unchanged[l] = if unchanged { 1.0 } else { 0.0 };
        }
    }
}

/// Sine and cosine within their polynomials' reach.
#[inline(always)]
fn pose(q: &Vector) -> Pose {
    let (sin, cos) = small_sin_cos(q[TH]);
    Pose { sin, cos }
}

/// One or the other, without a branch.
#[inline(always)]
fn pick(first: bool, [a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 3] {
    [if first { a } else { d }, if first { b } else { e }, if first { c } else { f }]
}
