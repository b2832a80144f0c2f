//! The Newton matrix of a Radau stage, M + s c + s^2 K with s = h lambda, condensed to the body.
//!
//! Each absorber touches only its own foot, so it is eliminated by one division; what is left of a
//! chain is its dynamic stiffness s^2 k1 (m2 + s c + s^2 k2) / (m2 + s c + s^2 (k1 + k2)), equation
//! (5) with s^-1 for i omega. The body's 3 x 3 matrix is an arrow (X and Z meet only in theta), so
//! it too is solved without a general factorisation.

pub(super) use super::condensed::{Condensed, MatrixNumber};
use super::model::{Contact, Foot, FootForce, Model, N, State, TH, Vector, X, Z, ax, az};
use super::{coupled::Coupled, slipping::Slipping};
use crate::spring::Springs;

/// Both feet's chains, horizontal and vertical. They depend on the step's size and on what holds,
/// on nothing else.
#[derive(Clone, Copy)]
pub(super) struct Chains<T>(pub [[Condensed<T>; 2]; 2]);

impl<T: MatrixNumber> Chains<T> {
    #[inline(always)]
    pub(crate) fn new(model: &Model, feet: &[Foot; 2], s: T) -> Self {
        let Springs { vertical: v, horizontal: h } = &model.springs;
        let left = [Condensed::new(h, feet[0].holds(), s), Condensed::new(v, feet[0].closed(), s)];
        let right = [Condensed::new(h, feet[1].holds(), s), Condensed::new(v, feet[1].closed(), s)];
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
impl<T: MatrixNumber> Newton<T> {
    /// Factor at `state` for s = h lambda.
    pub(crate) fn new(model: &Model, state: &State, feet: &[Foot; 2], s: T) -> Self {
        let chains = Chains::new(model, feet, s);
        let matrix = CondensedMatrix::new(&chains, model, state, feet, s);
        Self { chains, matrix }
    }

    /// Solve for the accelerations' correction.
    pub(crate) fn solve(&self, r: &[T; N]) -> [T; N] {
        self.matrix.solve(&self.chains, r)
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

impl<T: MatrixNumber> CondensedMatrix<T> {
    /// Factor at `state` for s = h lambda.
    #[inline(always)]
    pub(crate) fn new(
        chains: &Chains<T>,
        model: &Model,
        state: &State,
        feet: &[Foot; 2],
        s: T,
    ) -> Self {
        if !model.elements.is_empty() {
            return Self::Coupled(Box::new(Coupled::new(chains, model, state, feet, s)));
        }
        if feet.iter().any(|foot| matches!(foot.contact, Contact::Slip(_))) {
            return Self::Slipping(Box::new(Slipping::new(model, state, feet, s)));
        }
        Self::rigid(chains, model, &model.contact(&state.q, feet), feet, s)
    }

    /// Factor for a body whose feet's forces are `contact`.
    #[inline(always)]
    pub(crate) fn rigid(
        chains: &Chains<T>,
        model: &Model,
        contact: &[FootForce; 2],
        feet: &[Foot; 2],
        s: T,
    ) -> Self {
        let closed = feet.map(|foot| foot.closed() || !model.skip_open);
        Self::Rigid(Rigid::new(chains, contact, &model.masses(feet), closed, s))
    }

    /// Solve for the accelerations' correction.
    #[inline(always)]
    pub(crate) fn solve(&self, chains: &Chains<T>, r: &[T; N]) -> [T; N] {
        match self {
            Self::Rigid(rigid) => rigid.solve(chains, r),
            Self::Coupled(coupled) => coupled.solve(chains, r),
            Self::Slipping(slipping) => slipping.solve(r),
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

impl<T: MatrixNumber> Rigid<T> {
    /// Factor where the feet's forces are `contact`, for s = h lambda.
    #[inline(always)]
    pub(crate) fn new(
        chains: &Chains<T>,
        contact: &[FootForce; 2],
        masses: &Vector,
        closed: [bool; 2],
        s: T,
    ) -> Self {
        let mut shares = [[T::zero(); 5]; 2];
        let mut lever = [[T::zero(); 2]; 2];
        for i in 0..2 {
            if closed[i] {
                (shares[i], lever[i]) = share(&chains.0[i], &contact[i], s);
            }
        }
        let sum = |k: usize| shares[0][k] + shares[1][k];
        let (xx, zz, tt, x_th, z_th) = (sum(0), sum(1), sum(2), sum(3), sum(4));
        let x_inv = T::one() / (T::from(masses[X]) + xx);
        let z_inv = T::one() / (T::from(masses[Z]) + zz);
        let th_inv =
            T::one() / (T::from(masses[TH]) + tt - x_th * x_th * x_inv - z_th * z_th * z_inv);
        Self { closed, lever, x_inv, z_inv, th_inv, x_th, z_th }
    }

    /// Solve for the accelerations' correction.
    #[inline(always)]
    pub(crate) fn solve(&self, chains: &Chains<T>, r: &[T; N]) -> [T; N] {
        let (left, right) = (self.reach(chains, 0, r), self.reach(chains, 1, r));
        // one sum of both feet first, so that a mirrored case gives the mirrored history to the
        // last bit
        let [x, z, th] = [
            r[X] + (left[X] + right[X]),
            r[Z] + (left[Z] + right[Z]),
            r[TH] + (left[TH] + right[TH]),
        ];
        let turned = x * (self.x_th * self.x_inv) + z * (self.z_th * self.z_inv);
        let th = (th - turned) * self.th_inv;
        let x = (x - th * self.x_th) * self.x_inv;
        let z = (z - th * self.z_th) * self.z_inv;
        let [lx, lz] = self.absorbers(chains, 0, r, [x, z, th]);
        let [rx, rz] = self.absorbers(chains, 1, r, [x, z, th]);
        [x, z, th, lx, lz, rx, rz]
    }

    #[inline(always)]
    fn reach(&self, chains: &Chains<T>, i: usize, r: &[T; N]) -> [T; 3] {
        if !self.closed[i] {
            return [T::zero(), T::zero(), T::zero()];
        }
        reach(&chains.0[i], self.lever[i], [r[ax(i)], r[az(i)]])
    }

    #[inline(always)]
    fn absorbers(&self, chains: &Chains<T>, i: usize, r: &[T; N], body: [T; 3]) -> [T; 2] {
        if !self.closed[i] {
            let [h, v] = &chains.0[i];
            return [r[ax(i)] * h.pivot, r[az(i)] * v.pivot];
        }
        absorbers(&chains.0[i], self.lever[i], [r[ax(i)], r[az(i)]], body)
    }
}

/// A closed foot's share of the body's matrix, [xx, zz, tt, x_th, z_th], and its lever
/// [dp_x/dtheta, dp_z/dtheta].
#[inline(always)]
pub(super) fn share<T: MatrixNumber>(
    [h, v]: &[Condensed<T>; 2],
    foot: &FootForce,
    s: T,
) -> ([T; 5], [T; 2]) {
    let [px, pz] = [T::from(foot.px_th), T::from(foot.pz_th)];
    // the turning lever arms: d2p_x = dp_z, d2p_z = -dp_x
    let geometric = T::from(foot.vertical * foot.px_th - foot.horizontal * foot.pz_th);
    let tt = h.stiffness * px * px + v.stiffness * pz * pz + s * s * geometric;
    ([h.stiffness, v.stiffness, tt, h.stiffness * px, v.stiffness * pz], [px, pz])
}

/// What of the right side of a closed foot's absorbers, horizontal and vertical, reaches X, Z and
/// theta.
#[inline(always)]
pub(super) fn reach<T: MatrixNumber>(
    [h, v]: &[Condensed<T>; 2],
    [px, pz]: [T; 2],
    r: [T; 2],
) -> [T; 3] {
    let (from_x, from_z) = (r[0] * h.share, r[1] * v.share);
    [from_x, from_z, from_x * px + from_z * pz]
}

/// The correction of a closed foot's absorbers, that of the body known.
#[inline(always)]
pub(super) fn absorbers<T: MatrixNumber>(
    [h, v]: &[Condensed<T>; 2],
    [px, pz]: [T; 2],
    r: [T; 2],
    [x, z, th]: [T; 3],
) -> [T; 2] {
    let along = (r[0] + (x + th * px) * h.coupling) * h.pivot;
    [along, (r[1] + (z + th * pz) * v.coupling) * v.pivot]
}
