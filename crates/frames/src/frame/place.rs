//! A place on a node, carried by a rigid arm from its centre of mass.

use nalgebra::DVector;

use super::{NONE, gather};
use crate::beam::{Turned, turned};

/// A place on a node.
#[derive(Clone, Copy, Debug)]
pub struct PlaceOnNode {
    /// Where it is in the unstressed structure (x, z) (m).
    pub unstressed: [f64; 2],
    /// From the centre of mass, unstressed (m).
    pub(super) arm: [f64; 2],
    pub(super) index: [usize; 3],
}

/// Where it has got to.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// Displacement (x, z) (m).
    pub place: [f64; 2],
    /// Its derivative by the node's rotation (m).
    pub slope: [f64; 2],
    /// The arm, turned: minus the second derivative (m).
    pub arm: [f64; 2],
}

impl PlaceOnNode {
    /// Whether it is on the same node as another place: on the same footing.
    pub fn shares_node(&self, other: &Self) -> bool {
        self.index == other.index
    }

    /// Where it is at q.
    #[inline(always)]
    pub fn reach(&self, q: &[f64]) -> Reach {
        let [x, z, th] = gather(&self.index, q);
        let Turned { arm, slope, moved } = turned(self.arm, th);
        Reach { place: [x + moved[0], z + moved[1]], slope, arm }
    }

    /// Its velocity (m/s).
    #[inline(always)]
    pub fn velocity(&self, reach: &Reach, v: &[f64]) -> [f64; 2] {
        let [x, z, th] = gather(&self.index, v);
        [x + reach.slope[0] * th, z + reach.slope[1] * th]
    }

    /// Add a force on it (N) to those on the coordinates.
    #[inline(always)]
    pub fn push(&self, reach: &Reach, force: [f64; 2], out: &mut [f64]) {
        let [x, z, th] = self.index;
        if x != NONE {
            out[x] += force[0];
            out[z] += force[1];
        }
        if th != NONE {
            out[th] += force[0] * reach.slope[0] + force[1] * reach.slope[1];
        }
    }

    /// G: its displacement's derivatives by the n coordinates.
    pub(crate) fn jacobian(&self, q: &[f64], n: usize) -> [DVector<f64>; 2] {
        let slope = self.reach(q).slope;
        [0, 1].map(|k| {
            let mut row = DVector::zeros(n);
            self.rows(slope, |at, entry| row[at] = entry[k]);
            row
        })
    }

    /// The nonzero columns of G: index, and entries of rows x and z.
    #[inline(always)]
    pub fn rows(&self, slope: [f64; 2], mut each: impl FnMut(usize, [f64; 2])) {
        let [x, z, th] = self.index;
        if x != NONE {
            each(x, [1.0, 0.0]);
            each(z, [0.0, 1.0]);
        }
        if th != NONE {
            each(th, slope);
        }
    }

    /// Index of its node's rotation.
    #[inline(always)]
    pub fn rotation(&self) -> Option<usize> {
        (self.index[2] != NONE).then_some(self.index[2])
    }
}
