//! The Newton matrix of a Radau stage, M + s c + s^2 K with s = h lambda, condensed to the body.
//!
//! Each absorber touches only its own foot, so it is eliminated by one division; what is left of a
//! chain is its dynamic stiffness s^2 k1 (m2 + s c + s^2 k2) / (m2 + s c + s^2 (k1 + k2)), equation
//! (5) with s^-1 for i omega. The body's 3 x 3 matrix is an arrow (X and Z meet only in theta), so
//! it too is solved without a general factorisation.

use std::ops::{Add, Neg, Sub};

use num_traits::{Num, Zero};

pub(super) use super::condensed::Condensed;
use super::model::{Contact, Foot, FootForce, Model, N, State, TH, Vector, X, Z, ax, az};
use super::{coupled::Coupled, slipping::Slipping};
use crate::spring::Springs;

/// Both feet's chains, horizontal and vertical. They depend on the step's size and on what holds,
/// on nothing else.
#[derive(Clone, Copy)]
pub(super) struct Chains<T>(pub [[Condensed<T>; 2]; 2]);

impl<T: Num + Copy> Chains<T> {
    #[inline(always)]
    pub(crate) fn new(model: &Model, feet: &[Foot; 2], s: T, lift: &impl Fn(f64) -> T) -> Self {
        let Springs { vertical: v, horizontal: h } = &model.springs;
        let left = [
            Condensed::new(h, feet[0].holds(), s, lift),
            Condensed::new(v, feet[0].closed(), s, lift),
        ];
        let right = [
            Condensed::new(h, feet[1].holds(), s, lift),
            Condensed::new(v, feet[1].closed(), s, lift),
        ];
        Self([left, right])
    }
}

/// The matrix for one eigenvalue with its chains, ready to solve with.
#[cfg(test)]
pub(super) struct Newton<T> {
    chains: Chains<T>,
    matrix: CondensedMatrix<T>,
}

#[cfg(test)]
impl<T: Num + Copy + Neg<Output = T>> Newton<T> {
    /// Factor at `state` for s = h lambda.
    pub(crate) fn new(
        model: &Model,
        state: &State,
        feet: &[Foot; 2],
        s: T,
        lift: impl Fn(f64) -> T,
    ) -> Self {
        let chains = Chains::new(model, feet, s, &lift);
        let matrix = CondensedMatrix::new(&chains, model, state, feet, s, lift);
        Self { chains, matrix }
    }

    /// Solve for the accelerations' correction.
    pub(crate) fn solve(&self, r: &[T; N]) -> [T; N] {
        self.matrix.solve(&self.chains, r, |x, t| x * t)
    }
}

/// What is left of the matrix once the chains are condensed.
pub(super) enum CondensedMatrix<T> {
    Rigid(Rigid<T>),
    /// Of a body with members.
    Coupled(Box<Coupled<T>>),
    /// While a foot slips.
    Slipping(Box<Slipping<T>>),
}

impl<T: Num + Copy + Neg<Output = T>> CondensedMatrix<T> {
    /// Factor at `state` for s = h lambda.
    #[inline(always)]
    pub(crate) fn new(
        chains: &Chains<T>,
        model: &Model,
        state: &State,
        feet: &[Foot; 2],
        s: T,
        lift: impl Fn(f64) -> T,
    ) -> Self {
        if !model.elements.is_empty() {
            return Self::Coupled(Box::new(Coupled::new(chains, model, state, feet, s, &lift)));
        }
        if feet.iter().any(|foot| matches!(foot.contact, Contact::Slip(_))) {
            return Self::Slipping(Box::new(Slipping::new(model, state, feet, s, &lift)));
        }
        Self::rigid(chains, model, &model.contact(&state.q, feet), feet, s, lift)
    }

    /// Factor for a body whose feet's forces are `contact`.
    #[inline(always)]
    pub(crate) fn rigid(
        chains: &Chains<T>,
        model: &Model,
        contact: &[FootForce; 2],
        feet: &[Foot; 2],
        s: T,
        lift: impl Fn(f64) -> T,
    ) -> Self {
        let closed = feet.map(|foot| foot.closed() || !model.skip_open);
        Self::Rigid(Rigid::new(chains, contact, &model.masses(feet), closed, s, lift))
    }

    /// Solve for the accelerations' correction; `times` multiplies an entry of the right side by
    /// one of the matrix.
    #[inline(always)]
    pub(crate) fn solve<V>(
        &self,
        chains: &Chains<T>,
        r: &[V; N],
        times: impl Fn(V, T) -> V + Copy,
    ) -> [V; N]
    where
        V: Copy + Add<Output = V> + Sub<Output = V> + Zero,
    {
        match self {
            Self::Rigid(rigid) => rigid.solve(chains, r, times),
            Self::Coupled(coupled) => coupled.solve(chains, r, times),
            Self::Slipping(slipping) => slipping.solve(r, times),
        }
    }
}

/// The matrix of the body alone.
#[derive(Clone, Copy)]
pub(super) struct Rigid<T> {
    /// Which feet are solved for: an open foot's absorbers move by themselves.
    pub closed: [bool; 2],
    /// dp_x/dtheta and dp_z/dtheta of each foot.
    pub lever: [[T; 2]; 2],
    pub x_inv: T,
    pub z_inv: T,
    pub th_inv: T,
    pub x_th: T,
    pub z_th: T,
}

impl<T: Num + Copy + Neg<Output = T>> Rigid<T> {
    /// Factor where the feet's forces are `contact`, for s = h lambda.
    #[inline(always)]
    pub(crate) fn new(
        chains: &Chains<T>,
        contact: &[FootForce; 2],
        masses: &Vector,
        closed: [bool; 2],
        s: T,
        lift: impl Fn(f64) -> T,
    ) -> Self {
        let mut shares = [[T::zero(); 5]; 2];
        let mut lever = [[T::zero(); 2]; 2];
        for i in 0..2 {
            if closed[i] {
                (shares[i], lever[i]) = share(&chains.0[i], &contact[i], s, &lift);
            }
        }
        let sum = |k: usize| shares[0][k] + shares[1][k];
        let (xx, zz, tt, x_th, z_th) = (sum(0), sum(1), sum(2), sum(3), sum(4));
        let x_inv = T::one() / (lift(masses[X]) + xx);
        let z_inv = T::one() / (lift(masses[Z]) + zz);
        let th_inv = T::one() / (lift(masses[TH]) + tt - x_th * x_th * x_inv - z_th * z_th * z_inv);
        Self { closed, lever, x_inv, z_inv, th_inv, x_th, z_th }
    }

    /// Solve for the accelerations' correction.
    #[inline(always)]
    pub(crate) fn solve<V>(
        &self,
        chains: &Chains<T>,
        r: &[V; N],
        times: impl Fn(V, T) -> V + Copy,
    ) -> [V; N]
    where
        V: Copy + Add<Output = V> + Sub<Output = V> + Zero,
    {
        let (left, right) = (self.reach(chains, 0, r, times), self.reach(chains, 1, r, times));
        // one sum of both feet first, so that a mirrored case gives the mirrored history to the
        // last bit
        let [x, z, th] = [
            r[X] + (left[X] + right[X]),
            r[Z] + (left[Z] + right[Z]),
            r[TH] + (left[TH] + right[TH]),
        ];
        let turned = times(x, self.x_th * self.x_inv) + times(z, self.z_th * self.z_inv);
        let th = times(th - turned, self.th_inv);
        let x = times(x - times(th, self.x_th), self.x_inv);
        let z = times(z - times(th, self.z_th), self.z_inv);
        let [lx, lz] = self.absorbers(chains, 0, r, [x, z, th], times);
        let [rx, rz] = self.absorbers(chains, 1, r, [x, z, th], times);
        [x, z, th, lx, lz, rx, rz]
    }

    #[inline(always)]
    fn reach<V>(
        &self,
        chains: &Chains<T>,
        i: usize,
        r: &[V; N],
        times: impl Fn(V, T) -> V + Copy,
    ) -> [V; 3]
    where
        V: Copy + Add<Output = V> + Sub<Output = V> + Zero,
    {
        if !self.closed[i] {
            return [V::zero(), V::zero(), V::zero()];
        }
        reach(&chains.0[i], self.lever[i], [r[ax(i)], r[az(i)]], times)
    }

    #[inline(always)]
    fn absorbers<V>(
        &self,
        chains: &Chains<T>,
        i: usize,
        r: &[V; N],
        body: [V; 3],
        times: impl Fn(V, T) -> V + Copy,
    ) -> [V; 2]
    where
        V: Copy + Add<Output = V> + Sub<Output = V> + Zero,
    {
        if !self.closed[i] {
            let [h, v] = &chains.0[i];
            return [times(r[ax(i)], h.pivot), times(r[az(i)], v.pivot)];
        }
        absorbers(&chains.0[i], self.lever[i], [r[ax(i)], r[az(i)]], body, times)
    }
}

/// A closed foot's share of the body's matrix, [xx, zz, tt, x_th, z_th], and its lever
/// [dp_x/dtheta, dp_z/dtheta].
#[inline(always)]
pub(super) fn share<T: Num + Copy>(
    [h, v]: &[Condensed<T>; 2],
    foot: &FootForce,
    s: T,
    lift: &impl Fn(f64) -> T,
) -> ([T; 5], [T; 2]) {
    let [px, pz] = [lift(foot.px_th), lift(foot.pz_th)];
    // the turning lever arms: d2p_x = dp_z, d2p_z = -dp_x
    let geometric = lift(foot.vertical * foot.px_th - foot.horizontal * foot.pz_th);
    let tt = h.stiffness * px * px + v.stiffness * pz * pz + s * s * geometric;
    ([h.stiffness, v.stiffness, tt, h.stiffness * px, v.stiffness * pz], [px, pz])
}

/// What of the right side of a closed foot's absorbers, horizontal and vertical, reaches X, Z and
/// theta.
#[inline(always)]
pub(super) fn reach<T: Num + Copy, V: Copy + Add<Output = V>>(
    [h, v]: &[Condensed<T>; 2],
    [px, pz]: [T; 2],
    r: [V; 2],
    times: impl Fn(V, T) -> V,
) -> [V; 3] {
    let (from_x, from_z) = (times(r[0], h.share), times(r[1], v.share));
    [from_x, from_z, times(from_x, px) + times(from_z, pz)]
}

/// The correction of a closed foot's absorbers, that of the body known.
#[inline(always)]
pub(super) fn absorbers<T: Num + Copy, V: Copy + Add<Output = V>>(
    [h, v]: &[Condensed<T>; 2],
    [px, pz]: [T; 2],
    r: [V; 2],
    [x, z, th]: [V; 3],
    times: impl Fn(V, T) -> V,
) -> [V; 2] {
    let along = times(r[0] + times(x + times(th, px), h.coupling), h.pivot);
    [along, times(r[1] + times(z + times(th, pz), v.coupling), v.pivot)]
}
