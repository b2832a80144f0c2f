//! A frame's forces, their tangent, energies and powers.

use std::borrow::Cow;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::{Base, Frame, FrameTendon, NONE, PlaceOnNode, gather};
use crate::mechanics::{Corner, Mechanics};
use rocking::scalar::GRAVITY;

/// Where dashpots of beams take the rates of their strains from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StrainRates<'a> {
    /// The velocities.
    OfVelocities,
    /// The change of the strains since coordinates `from` (m, rad), in `over` (s): OpenSees'
    /// damping objects.
    OfChange {
        /// Coordinates then.
        from: &'a [f64],
        /// Time since then (s).
        over: f64,
    },
}

/// A tendon that pulls.
struct TendonPull {
    /// (N)
    tension: f64,
    /// Unit vector towards the anchor.
    towards: [f64; 2],
    /// (m)
    length: f64,
}

impl FrameTendon {
    fn length(&self, [x, z]: [f64; 2]) -> ([f64; 2], f64) {
        let [dx, dz] =
            [self.anchor[0] - self.at.place[0] - x, self.anchor[1] - self.at.place[1] - z];
        let length = dx.hypot(dz);
        ([dx / length, dz / length], length)
    }

    /// By how much it is longer than in the unstressed structure (m): from the difference of the
    /// squares of both lengths. That of the lengths is rounded as these are, which is more energy
    /// than a still structure may lose.
    fn lengthened(&self, displacement: [f64; 2]) -> f64 {
        let [x, z] = displacement;
        let [dx, dz] = [0, 1].map(|k| self.anchor[k] - self.at.place[k]);
        let lengths = self.length(displacement).1 + self.length([0.0; 2]).1;
        (x * (x - 2.0 * dx) + z * (z - 2.0 * dz)) / lengths
    }

    /// Elongation that makes its tension, from a slack length; below zero it is slack (m).
    fn elongation(&self, displacement: [f64; 2]) -> f64 {
        self.pretension / self.stiffness + self.lengthened(displacement)
    }

    fn pull(&self, displacement: [f64; 2]) -> Option<TendonPull> {
        let tension = self.stiffness * self.elongation(displacement);
        let (towards, length) = self.length(displacement);
        (tension > 0.0).then_some(TendonPull { tension, towards, length })
    }

    /// Above that in the unstressed structure (J).
    fn energy(&self, displacement: [f64; 2]) -> f64 {
        let [then, now] = [[0.0; 2], displacement].map(|u| self.elongation(u).max(0.0));
        // by how much it has changed is known better than both are
        let change = match then > 0.0 && now > 0.0 {
            true => self.lengthened(displacement),
            false => now - then,
        };
        0.5 * self.stiffness * change * (then + now)
    }
}

/// Adds to the upper and lower half of a matrix what a place on a node with a stiffness [xx, xz,
/// zz] adds.
fn add_block(place: &PlaceOnNode, slope: [f64; 2], block: [[f64; 2]; 2], out: &mut DMatrix<f64>) {
    place.rows(slope, |i, gi| {
        place.rows(slope, |j, gj| {
            let by = |k: usize| block[k][0] * gj[0] + block[k][1] * gj[1];
            out[(i, j)] += gi[0] * by(0) + gi[1] * by(1);
        });
    });
}

impl Frame {
    /// How many tendons and how many dampers.
    pub fn members(&self) -> (usize, usize) {
        (self.tendons.len(), self.dampers.len())
    }

    /// Tension of every tendon (N).
    pub fn tensions(&self, q: &[f64]) -> Vec<f64> {
        let tension = |(place, tendon): &(PlaceOnNode, FrameTendon)| {
            tendon.pull(place.reach(q).place).map_or(0.0, |p| p.tension)
        };
        self.tendons.iter().map(tension).collect()
    }

    /// Force of every damper on the structure, upwards (N).
    pub fn damper_forces(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        let force =
            |(place, c): &(PlaceOnNode, [f64; 2])| -c[1] * place.velocity(&place.reach(q), v)[1];
        self.dampers.iter().map(force).collect()
    }

    /// By how much every tendon is longer than in the unstressed structure (m).
    pub(crate) fn lengthened(&self, q: &[f64]) -> Vec<f64> {
        let by =
            |(place, tendon): &(PlaceOnNode, FrameTendon)| tendon.lengthened(place.reach(q).place);
        self.tendons.iter().map(by).collect()
    }

    /// Q at ground acceleration (a_g, a_v), in place of what is in `out`.
    pub fn forces(
        &self,
        (q, v): (&[f64], &[f64]),
        rates: StrainRates,
        [ground, up]: [f64; 2],
        out: &mut [f64],
    ) {
        let [mx, mz] = &self.pull;
        for (k, out) in out.iter_mut().enumerate() {
            *out = -(mx[k] * ground + mz[k] * (GRAVITY + up));
        }
        for element in &self.elements {
            let (beam, y) = (&element.beam, gather(&element.index, q));
            let force = match rates {
                StrainRates::OfVelocities => beam.resistance(&y, &gather(&element.index, v)),
                StrainRates::OfChange { from, over } => {
                    beam.resistance_since(&y, &gather(&element.index, from), over)
                }
            };
            for (k, f) in element.index.into_iter().zip(force) {
                if k != NONE {
                    out[k] -= f;
                }
            }
        }
        for (place, c) in &self.dampers {
            let reach = place.reach(q);
            let [x, z] = place.velocity(&reach, v);
            place.push(&reach, [-c[0] * x, -c[1] * z], out);
        }
        for (place, tendon) in &self.tendons {
            let reach = place.reach(q);
            if let Some(TendonPull { tension, towards, .. }) = tendon.pull(reach.place) {
                place.push(&reach, towards.map(|n| n * tension), out);
            }
        }
    }

    /// -dQ/dq and -dQ/dq', in place of what is in `k` and `c`.
    pub fn slopes(
        &self,
        (q, v): (&[f64], &[f64]),
        rates: StrainRates,
        k: &mut DMatrix<f64>,
        c: &mut DMatrix<f64>,
    ) {
        k.fill(0.0);
        c.fill(0.0);
        for element in &self.elements {
            let (beam, y) = (&element.beam, gather(&element.index, q));
            let [ke, ce] = match rates {
                StrainRates::OfVelocities => beam.tangent(&y, &gather(&element.index, v)),
                StrainRates::OfChange { from, over } => {
                    [beam.tangent_since(&y, &gather(&element.index, from), over), [[0.0; 6]; 6]]
                }
            };
            for (i, &row) in element.index.iter().enumerate().filter(|(_, row)| **row != NONE) {
                for (j, &column) in
                    element.index.iter().enumerate().filter(|(_, column)| **column != NONE)
                {
                    k[(row, column)] += ke[i][j];
                    c[(row, column)] += ce[i][j];
                }
            }
        }
        for (place, [cx, cz]) in &self.dampers {
            let reach = place.reach(q);
            add_block(place, reach.slope, [[*cx, 0.0], [0.0, *cz]], c);
            let Some(th) = place.rotation() else { continue };
            let ([x, z], rate) = (place.velocity(&reach, v), gather(&place.index, v)[2]);
            let (slope, arm) = (reach.slope, reach.arm);
            // G turns: the velocity changes by -arm th', the force's moment by force x -arm
            place
                .rows(slope, |i, g| k[(i, th)] -= (g[0] * cx * arm[0] + g[1] * cz * arm[1]) * rate);
            k[(th, th)] -= cx * x * arm[0] + cz * z * arm[1];
        }
        for (place, tendon) in &self.tendons {
            let reach = place.reach(q);
            let Some(TendonPull { tension, towards: [x, z], length }) = tendon.pull(reach.place)
            else {
                continue;
            };
            let across = tension / length;
            let along = tendon.stiffness - across;
            let block =
                [[across + along * x * x, along * x * z], [along * x * z, across + along * z * z]];
            add_block(place, reach.slope, block, k);
            if let Some(th) = place.rotation() {
                k[(th, th)] += tension * (x * reach.arm[0] + z * reach.arm[1]);
            }
        }
    }

    /// Energy above that of the unstressed structure (J).
    pub(crate) fn stored(&self, q: &[f64]) -> f64 {
        let weight: f64 = self.pull[1].iter().zip(q).map(|(m, z)| m * z).sum();
        let beams: f64 = self
            .elements
            .iter()
            .map(|element| element.beam.energy(&gather(&element.index, q)))
            .sum();
        let tendons: f64 =
            self.tendons.iter().map(|(place, tendon)| tendon.energy(place.reach(q).place)).sum();
        GRAVITY * weight + beams + tendons
    }

    /// Power that dashpots take (W).
    pub(crate) fn dissipated(&self, q: &[f64], v: &[f64]) -> f64 {
        let beam = |element: &super::BeamElement| {
            element.beam.dissipation(&gather(&element.index, q), &gather(&element.index, v))
        };
        let damper = |(place, c): &(PlaceOnNode, [f64; 2])| {
            let [x, z] = place.velocity(&place.reach(q), v);
            c[0] * x * x + c[1] * z * z
        };
        self.elements.iter().map(beam).sum::<f64>() + self.dampers.iter().map(damper).sum::<f64>()
    }

    /// Power of the ground's motion (W).
    pub(crate) fn fed(&self, v: &[f64], [ground, up]: [f64; 2]) -> f64 {
        let [mx, mz] = &self.pull;
        -(0..self.size).map(|k| (mx[k] * ground + mz[k] * up) * v[k]).sum::<f64>()
    }

    /// out = M a.
    #[inline]
    pub fn momentum(&self, a: &[f64], out: &mut [f64]) {
        if let Some(diagonal) = &self.diagonal {
            for ((out, m), a) in out.iter_mut().zip(diagonal).zip(a) {
                *out = m * a;
            }
            return;
        }
        out.fill(0.0);
        for (column, a) in self.mass.column_iter().zip(a) {
            for (out, m) in out.iter_mut().zip(column.iter()) {
                *out += m * a;
            }
        }
    }

    /// Kinetic energy (J).
    pub(crate) fn kinetic_energy(&self, v: &[f64]) -> f64 {
        let twice: f64 = match &self.diagonal {
            Some(diagonal) => diagonal.iter().zip(v).map(|(m, v)| m * v * v).sum(),
            None => {
                let along = |column: nalgebra::DVectorView<f64>| {
                    column.iter().zip(v).map(|(m, v)| m * v).sum::<f64>()
                };
                self.mass.column_iter().zip(v).map(|(column, v)| v * along(column)).sum()
            }
        };
        0.5 * twice
    }
}

impl Mechanics for Frame {
    fn size(&self) -> usize {
        self.size
    }

    fn mass(&self, _: &DVector<f64>) -> DMatrix<f64> {
        self.mass.clone()
    }

    fn factored_mass(&self, _: &DVector<f64>) -> Option<Cow<'_, Cholesky<f64, Dyn>>> {
        Some(Cow::Borrowed(&self.cholesky))
    }

    fn whole_mass(&self, _: &DVector<f64>) -> f64 {
        self.total
    }

    fn force(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> DVector<f64> {
        let mut out = DVector::zeros(self.size);
        let state = (q.as_slice(), v.as_slice());
        self.forces(state, StrainRates::OfVelocities, ground, out.as_mut_slice());
        out
    }

    fn tangent(&self, q: &DVector<f64>, v: &DVector<f64>, _: [f64; 2]) -> [DMatrix<f64>; 2] {
        let mut both = [DMatrix::zeros(self.size, self.size), DMatrix::zeros(self.size, self.size)];
        let [k, c] = &mut both;
        self.slopes((q.as_slice(), v.as_slice()), StrainRates::OfVelocities, k, c);
        both
    }

    fn footings(&self) -> &[usize] {
        &self.footings
    }

    fn rotation(&self, footing: usize, q: &DVector<f64>) -> f64 {
        let base =
            if self.bodies[footing].index[2] == NONE { Base::Feet } else { Base::Footing(footing) };
        base.rotation(self, q.as_slice())
    }

    fn corner(&self, i: usize, q: &DVector<f64>, v: &DVector<f64>) -> Corner {
        let corner = &self.corners[i];
        let reach = corner.reach(q.as_slice());
        let rate = gather(&corner.index, v.as_slice())[2];
        Corner {
            place: reach.place,
            jacobian: corner.jacobian(q.as_slice(), self.size),
            bias: reach.arm.map(|r| -r * rate * rate),
        }
    }

    fn potential(&self, q: &DVector<f64>) -> f64 {
        self.stored(q.as_slice())
    }

    fn dissipation(&self, q: &DVector<f64>, v: &DVector<f64>) -> f64 {
        self.dissipated(q.as_slice(), v.as_slice())
    }

    fn input_power(&self, _: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> f64 {
        self.fed(v.as_slice(), ground)
    }

    fn kinetic(&self, _: &DVector<f64>, v: &DVector<f64>) -> f64 {
        self.kinetic_energy(v.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::NodePoint;

    /// A tendon upright over its anchor, 28 m long: lifted by a nanometre it is longer by that,
    /// and has taken its pretension times that; a move across lengthens it by the square alone.
    #[test]
    fn a_tendon_that_hardly_moves_is_longer_by_what_it_moved() {
        let at = NodePoint { node: 0, place: [0.3, 28.0] };
        let tendon = FrameTendon { at, anchor: [0.3, 0.0], stiffness: 2e7, pretension: 2e6 };
        let (up, across) = (1e-9, 1e-4);
        assert!((tendon.lengthened([0.0, up]) / up - 1.0).abs() < 1e-12);
        assert!((tendon.energy([0.0, up]) / (2e6 * up) - 1.0).abs() < 1e-8);
        assert!((tendon.lengthened([across, 0.0]) / (across * across / 56.0) - 1.0).abs() < 1e-10);
        // slackened by more than its elongation of 0.1 m it has lost all of its energy
        assert!((tendon.energy([0.0, -0.2]) / -1e5 - 1.0).abs() < 1e-12);
    }
}
