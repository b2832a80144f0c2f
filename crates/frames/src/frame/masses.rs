//! Masses: of nodes, and of beams, in halves or consistent with linear displacements.
//!
//! Half a beam of mass m, length L on a node adds m/2 at its end and the half's rotational inertia
//! about it, m L^2/24. Off the node's centre of mass it moves that. Consistent: m/6 [2 1; 1 2] of
//! the displacements, and the rotational inertia m L^2/105 of a beam whose end alone turns
//! (Przemieniecki, *Theory of Matrix Structural Analysis*, table 11.1).

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::{FrameBody, NONE, layout::FrameError, layout::FrameLayout};

/// A node with the halves of its beams.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lump {
    /// Centre of mass (m).
    pub centre: [f64; 2],
    mass: f64,
    /// About it (kg m2).
    inertia: f64,
}

impl Lump {
    fn add(&mut self, place: [f64; 2], mass: f64, inertia: f64) {
        let total = self.mass + mass;
        if mass == 0.0 {
            return;
        }
        let d = [place[0] - self.centre[0], place[1] - self.centre[1]];
        self.inertia += inertia + self.mass * mass / total * (d[0] * d[0] + d[1] * d[1]);
        self.centre = [0, 1].map(|k| self.centre[k] + d[k] * mass / total);
        self.mass = total;
    }
}

/// Masses of a layout.
pub(super) struct Masses {
    pub lumps: Vec<Lump>,
    /// Nodes and mass of beams that couple two nodes.
    coupled: Vec<([usize; 2], f64)>,
}

impl Masses {
    pub(crate) fn of(layout: &FrameLayout) -> Self {
        let node = |i: usize| &layout.nodes[i];
        let mut lumps: Vec<Lump> = layout
            .nodes
            .iter()
            .map(|node| Lump {
                centre: node.place,
                mass: node.mass,
                inertia: node.inertia.unwrap_or(0.0),
            })
            .collect();
        // a node met by beams at its centre alone
        let mut central = vec![true; layout.nodes.len()];
        for end in layout.members.iter().flat_map(|member| &member.ends) {
            central[end.node] &= end.place == node(end.node).place;
        }
        let mut coupled = Vec::new();
        for member in &layout.members {
            let [a, b] = member.ends;
            let length = (b.place[0] - a.place[0]).hypot(b.place[1] - a.place[1]);
            let mass = member.section.line_mass * length;
            let consistent = layout.consistent && central[a.node] && central[b.node];
            let inertia = mass * length * length / if consistent { 105.0 } else { 24.0 };
            for (end, hinged) in [a, b].into_iter().zip(member.hinged) {
                let inertia =
                    if hinged || node(end.node).inertia.is_none() { 0.0 } else { inertia };
                lumps[end.node].add(end.place, if consistent { 0.0 } else { 0.5 * mass }, inertia);
                if consistent {
                    lumps[end.node].inertia += inertia;
                }
            }
            if consistent {
                coupled.push(([a.node, b.node], mass));
            }
        }
        Self { lumps, coupled }
    }

    /// Whether M is diagonal.
    pub(crate) fn lumped(&self) -> bool {
        self.coupled.is_empty()
    }

    /// M, its factors, M 1_x and M 1_z, and the mass of all that moves.
    #[allow(clippy::type_complexity)]
    pub(crate) fn matrix(
        &self,
        bodies: &[FrameBody],
        size: usize,
    ) -> Result<(DMatrix<f64>, Cholesky<f64, Dyn>, [DVector<f64>; 2], f64), FrameError> {
        let mut mass = DMatrix::zeros(size, size);
        let mut add = |i: usize, j: usize, entry: f64| {
            if i != NONE && j != NONE {
                mass[(i, j)] += entry;
            }
        };
        for (body, lump) in bodies.iter().zip(&self.lumps) {
            let [x, z, th] = body.index;
            add(x, x, lump.mass);
            add(z, z, lump.mass);
            add(th, th, lump.inertia);
        }
        for ([a, b], m) in &self.coupled {
            for k in 0..2 {
                let (i, j) = (bodies[*a].index[k], bodies[*b].index[k]);
                add(i, i, m / 3.0);
                add(j, j, m / 3.0);
                add(i, j, m / 6.0);
                add(j, i, m / 6.0);
            }
        }
        for (node, body) in bodies.iter().enumerate() {
            let named = [(body.index[0], "mass"), (body.index[2], "rotational inertia")];
            if let Some((_, what)) =
                named.into_iter().find(|&(k, _)| k != NONE && mass[(k, k)] <= 0.0)
            {
                return Err(FrameError::Massless { node, what });
            }
        }
        // the ground carries along what is held: half of a beam between pulls at each end whatever
        // the other does
        let mut pull = [DVector::zeros(size), DVector::zeros(size)];
        let lumps = bodies.iter().zip(&self.lumps).map(|(body, lump)| (body, lump.mass));
        let halves =
            self.coupled.iter().flat_map(|(ends, m)| ends.map(|node| (&bodies[node], 0.5 * m)));
        for (body, m) in lumps.chain(halves) {
            for k in 0..2 {
                if body.index[k] != NONE {
                    pull[k][body.index[k]] += m;
                }
            }
        }
        let total = pull[0].sum();
        let cholesky =
            Cholesky::new(mass.clone()).ok_or(FrameError::Massless { node: 0, what: "mass" })?;
        Ok((mass, cholesky, pull, total))
    }
}
