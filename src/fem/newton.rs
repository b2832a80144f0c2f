//! The Newton matrix of a Radau stage, M + s c + s^2 K with s = h lambda, condensed to the body.
//!
//! Each absorber touches only its own foot, so it is eliminated by one division; what is left of a chain is its dynamic
//! stiffness s^2 k1 (m2 + s c + s^2 k2) / (m2 + s c + s^2 (k1 + k2)), equation (5) with s^-1 for i omega. The body's
//! 3 x 3 matrix is an arrow (X and Z meet only in theta), so it too is solved without a general factorisation.

use std::ops::{Add, Neg, Sub};

use num_traits::{Num, Zero};

use super::model::{Contact, Foot, Model, N, State, TH, X, Z, ax, az};
use super::{coupled::Coupled, slipping::Slipping};
use crate::{scalar::Scalar, spring::Chain};

/// One chain's share of the condensed matrix.
#[derive(Clone, Copy)]
struct Condensed<T> {
    /// 1 / (m2 + s c + s^2 (k1 + k2)); k1 only when closed.
    pivot: T,
    /// s^2 k1; zero when open.
    coupling: T,
    /// coupling pivot: the share of a force on the absorber that reaches the body.
    share: T,
    /// The chain's dynamic stiffness times s^2; zero when open.
    stiffness: T,
}

impl<T: Num + Copy> Condensed<T> {
    fn new<S: Scalar>(chain: &Chain<S>, closed: bool, s: T, lift: &impl Fn(S) -> T) -> Self {
        let base = lift(chain.m2) + s * (lift(chain.c) + s * lift(chain.k2));
        if closed {
            let coupling = s * s * lift(chain.k1);
            let pivot = T::one() / (base + coupling);
            Self { pivot, coupling, share: coupling * pivot, stiffness: coupling * base * pivot }
        } else {
            Self { pivot: T::one() / base, coupling: T::zero(), share: T::zero(), stiffness: T::zero() }
        }
    }
}

/// Both feet's chains, horizontal and vertical. They depend on the step's size and on what holds, on nothing else.
#[derive(Clone, Copy)]
pub(super) struct Chains<T>([[Condensed<T>; 2]; 2]);

impl<T: Num + Copy> Chains<T> {
    pub fn new<S: Scalar>(model: &Model<S>, feet: &[Foot<S>; 2], s: T, lift: &impl Fn(S) -> T) -> Self {
        Self([0, 1].map(|i| {
            let h = Condensed::new(&model.springs.horizontal, feet[i].holds(), s, lift);
            let v = Condensed::new(&model.springs.vertical, feet[i].closed(), s, lift);
            [h, v]
        }))
    }
}

/// The matrix for one eigenvalue, ready to solve with.
pub(super) struct Newton<T> {
    chains: Chains<T>,
    matrix: Matrix<T>,
}

impl<T: Num + Copy + Neg<Output = T>> Newton<T> {
    /// Factor at `state` for s = h lambda.
    pub fn new<S: Scalar>(
        model: &Model<S>,
        state: &State<S>,
        feet: &[Foot<S>; 2],
        s: T,
        lift: impl Fn(S) -> T,
    ) -> Self {
        let chains = Chains::new(model, feet, s, &lift);
        let matrix = Matrix::new(&chains, model, state, feet, s, lift);
        Self { chains, matrix }
    }

    /// Solve for the accelerations' correction.
    pub fn solve(&self, r: &[T; N]) -> [T; N] {
        self.matrix.solve(&self.chains, r, |x, t| x * t)
    }
}

/// What is left of the matrix once the chains are condensed.
pub(super) struct Matrix<T> {
    /// Which feet are solved for: an open foot's absorbers move by themselves.
    closed: [bool; 2],
    /// dp_x/dtheta and dp_z/dtheta of each foot.
    lever: [[T; 2]; 2],
    x_inv: T,
    z_inv: T,
    th_inv: T,
    x_th: T,
    z_th: T,
    /// The matrix of a body with members, in place of all the rest.
    coupled: Option<Box<Coupled<T>>>,
    /// The same while a foot slips.
    slipping: Option<Box<Slipping<T>>>,
}

impl<T: Num + Copy + Neg<Output = T>> Matrix<T> {
    /// Factor at `state` for s = h lambda.
    #[inline(always)]
    pub fn new<S: Scalar>(
        chains: &Chains<T>,
        model: &Model<S>,
        state: &State<S>,
        feet: &[Foot<S>; 2],
        s: T,
        lift: impl Fn(S) -> T,
    ) -> Self {
        if let Some(frame) = &model.frame {
            let coupled = Some(Box::new(Coupled::new(model, frame, state, feet, s, &lift)));
            return Self { coupled, ..Self::none() };
        }
        if feet.iter().any(|foot| matches!(foot.contact, Contact::Slip(_))) {
            let slipping = Some(Box::new(Slipping::new(model, state, feet, s, &lift)));
            return Self { slipping, ..Self::none() };
        }
        let contact = model.contact(&state.q, feet);
        let masses = model.masses(feet);
        // [xx, zz, tt, x_th, z_th] of both feet
        let mut shares = [[T::zero(); 5]; 2];
        let mut lever = [[T::zero(); 2]; 2];
        let closed = feet.map(|foot| foot.closed() || !model.skip_open);
        for i in 0..2 {
            let ([h, v], foot) = (&chains.0[i], &contact[i]);
            if closed[i] {
                lever[i] = [lift(foot.px_th), lift(foot.pz_th)];
                let [px, pz] = lever[i];
                // the turning lever arms: d2p_x = dp_z, d2p_z = -dp_x
                let geometric = lift(foot.vertical * foot.px_th - foot.horizontal * foot.pz_th);
                let tt = h.stiffness * px * px + v.stiffness * pz * pz + s * s * geometric;
                shares[i] = [h.stiffness, v.stiffness, tt, h.stiffness * px, v.stiffness * pz];
            }
        }
        let sum = |k: usize| shares[0][k] + shares[1][k];
        let (xx, zz, tt, x_th, z_th) = (sum(0), sum(1), sum(2), sum(3), sum(4));
        let x_inv = T::one() / (lift(masses[X]) + xx);
        let z_inv = T::one() / (lift(masses[Z]) + zz);
        let th_inv = T::one() / (lift(masses[TH]) + tt - x_th * x_th * x_inv - z_th * z_th * z_inv);
        Self { closed, lever, x_inv, z_inv, th_inv, x_th, z_th, coupled: None, slipping: None }
    }

    fn none() -> Self {
        let zero = T::zero();
        Self {
            closed: [false; 2],
            lever: [[zero; 2]; 2],
            x_inv: zero,
            z_inv: zero,
            th_inv: zero,
            x_th: zero,
            z_th: zero,
            coupled: None,
            slipping: None,
        }
    }

    /// Solve for the accelerations' correction; `times` multiplies an entry of the right side by one of the matrix.
    #[inline(always)]
    pub fn solve<V>(&self, chains: &Chains<T>, r: &[V; N], times: impl Fn(V, T) -> V + Copy) -> [V; N]
    where
        V: Copy + Add<Output = V> + Sub<Output = V> + Zero,
    {
        if let Some(coupled) = &self.coupled {
            return coupled.solve(r, times);
        }
        if let Some(slipping) = &self.slipping {
            return slipping.solve(r, times);
        }
        let chains = &chains.0;
        let mut d = *r;
        let mut reaching = [[V::zero(); 3]; 2];
        for i in 0..2 {
            if self.closed[i] {
                let ([h, v], [px, pz]) = (&chains[i], self.lever[i]);
                let (from_x, from_z) = (times(r[ax(i)], h.share), times(r[az(i)], v.share));
                reaching[i] = [from_x, from_z, times(from_x, px) + times(from_z, pz)];
            }
        }
        // one sum of both feet first, so that a mirrored case gives the mirrored history to the last bit
        for k in [X, Z, TH] {
            d[k] = d[k] + (reaching[0][k] + reaching[1][k]);
        }
        let turned = times(d[X], self.x_th * self.x_inv) + times(d[Z], self.z_th * self.z_inv);
        d[TH] = times(d[TH] - turned, self.th_inv);
        d[X] = times(d[X] - times(d[TH], self.x_th), self.x_inv);
        d[Z] = times(d[Z] - times(d[TH], self.z_th), self.z_inv);
        for i in 0..2 {
            let [h, v] = &chains[i];
            let [px, pz] = self.lever[i];
            if self.closed[i] {
                d[ax(i)] = times(r[ax(i)] + times(d[X] + times(d[TH], px), h.coupling), h.pivot);
                d[az(i)] = times(r[az(i)] + times(d[Z] + times(d[TH], pz), v.coupling), v.pivot);
            } else {
                (d[ax(i)], d[az(i)]) = (times(r[ax(i)], h.pivot), times(r[az(i)], v.pivot));
            }
        }
        d
    }
}
