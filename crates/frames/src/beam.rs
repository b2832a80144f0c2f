//! A plane beam that turns as far as it likes: corotational, Timoshenko's, with rigid arms and
//! hinges at its ends.
//!
//! ```text
//!   U = EA/(2 L) e^2 + EI/(2 L) sum_ij k_ij f_i f_j       D = eta_A/(2 L) e'^2 + eta_I/(2 L) sum_ij k_ij f_i' f_j'
//!
//!   e = l - L         elongation of the chord (m)        l n = p_b - p_a, from end a to end b
//!   f_i = th_i - beta turn of end i against the chord; beta, th clockwise, from the unstressed place
//!   k = [4 + Phi, 2 - Phi; 2 - Phi, 4 + Phi]/(1 + Phi)    both ends clamped
//!   k = [12/(4 + Phi), 0; 0, 0]    with a hinge at b, whose moment 0 is condensed; 0 with two hinges
//!   Phi = 12 EI/(GA_s L^2)         0 of a beam that is rigid in shear: Euler-Bernoulli's, k = [4 2; 2 4] and 3
//! ```
//!
//! (Przemieniecki, *Theory of Matrix Structural Analysis*, section 5.6: exact where forces act at
//! the ends alone.) The dashpots are those of a section with viscous stress eta times the strain
//! rate: a rigid motion meets none of them. y = (x_a, z_a, th_a, x_b, z_b, th_b): displacements of
//! the two nodes (m), clockwise rotations (rad). Crisfield, *Non-linear Finite Element Analysis of
//! Solids and Structures 1*, section 7.2, with shallow terms left out: OpenSees' elasticBeamColumn
//! under the Corotational transformation.

use rocking::scalar::sin_cos;

/// What a beam is made of; SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamSection {
    /// EA (N).
    pub axial: f64,
    /// EI (N m2).
    pub bending: f64,
    /// GA_s (N); infinite of a beam that is rigid in shear.
    pub shear: f64,
    /// eta_A, viscous EA (N s).
    pub axial_damping: f64,
    /// eta_I, viscous EI (N m2 s); that of GA_s is in the same ratio to it.
    pub bending_damping: f64,
    /// Mass of a length (kg/m).
    pub line_mass: f64,
}

impl BeamSection {
    /// Without damping or mass, rigid in shear.
    pub fn elastic(axial: f64, bending: f64) -> Self {
        Self {
            axial,
            bending,
            shear: f64::INFINITY,
            axial_damping: 0.0,
            bending_damping: 0.0,
            line_mass: 0.0,
        }
    }

    /// Phi = 12 EI/(GA_s L^2) of a beam of this length (m): what shear adds to its bending.
    pub fn shear_ratio(&self, length: f64) -> f64 {
        12.0 * self.bending / (self.shear * length * length)
    }
}

/// A beam between two nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    section: BeamSection,
    /// L (m).
    length: f64,
    /// Unit vector from end a to end b, unstressed.
    direction: [f64; 2],
    /// From each node to the end it carries, unstressed (m).
    arms: [[f64; 2]; 2],
    /// k.
    bending: [[f64; 2]; 2],
}

/// What a beam bears: positive in tension; moments clockwise, of the node on the end of the beam.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BeamForces {
    /// (N)
    pub axial: f64,
    /// (M_a + M_b)/l (N).
    pub shear: f64,
    /// At its ends (N m).
    pub moments: [f64; 2],
}

/// A beam's configuration: deformations and their slopes by y.
pub(super) struct Deformed {
    /// l (m).
    length: f64,
    /// e (m), f_a, f_b (rad).
    pub strain: [f64; 3],
    /// dl/dy, dbeta/dy.
    along: [f64; 6],
    turn: [f64; 6],
    /// Second derivatives of l and of beta by th_a and by th_b that the arms add.
    arm_along: [f64; 2],
    arm_turn: [f64; 2],
}

/// Index of an end's rotation in y.
const TURN: [usize; 2] = [2, 5];

impl Beam {
    /// Between two ends (x, z) (m), each carried by a node through a rigid arm (m).
    pub(crate) fn new(
        ends: [[f64; 2]; 2],
        arms: [[f64; 2]; 2],
        hinged: [bool; 2],
        section: BeamSection,
    ) -> Self {
        let [[xa, za], [xb, zb]] = ends;
        let length = (xb - xa).hypot(zb - za);
        let phi = section.shear_ratio(length);
        let (near, far, alone) =
            ((4.0 + phi) / (1.0 + phi), (2.0 - phi) / (1.0 + phi), 12.0 / (4.0 + phi));
        let bending = match hinged {
            [false, false] => [[near, far], [far, near]],
            [false, true] => [[alone, 0.0], [0.0, 0.0]],
            [true, false] => [[0.0, 0.0], [0.0, alone]],
            [true, true] => [[0.0; 2]; 2],
        };
        Self { section, length, direction: [(xb - xa) / length, (zb - za) / length], arms, bending }
    }

    /// L (m).
    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// Whether it has dashpots.
    pub(crate) fn is_damped(&self) -> bool {
        self.section.axial_damping != 0.0 || self.section.bending_damping != 0.0
    }

    /// Mass of a length (kg/m).
    pub(crate) fn line_mass(&self) -> f64 {
        self.section.line_mass
    }

    /// Unit vector from end a to end b, unstressed.
    pub(crate) fn axis(&self) -> [f64; 2] {
        self.direction
    }

    /// How it is deformed at y.
    pub(super) fn deformed(&self, y: &[f64; 6]) -> Deformed {
        let (a, b) = (turned(self.arms[0], y[2]), turned(self.arms[1], y[5]));
        let [x, z] = self.direction;
        // the chord's change, without its unstressed part: no cancellation
        let dx = y[3] - y[0] + b.moved[0] - a.moved[0];
        let dz = y[4] - y[1] + b.moved[1] - a.moved[1];
        // along the unstressed chord and across it, to the right of it
        let (s, c) = (dx * x + dz * z, dx * z - dz * x);
        let along = self.length + s;
        let length = (along * along + c * c).sqrt();
        let stretch = (s * (2.0 * self.length + s) + c * c) / (length + self.length);
        let beta = c.atan2(along);
        let n = [(self.length * x + dx) / length, (self.length * z + dz) / length];
        let m = [n[1] / length, -n[0] / length];
        let dot = |u: [f64; 2], w: [f64; 2]| u[0] * w[0] + u[1] * w[1];
        let slope = |u: [f64; 2]| [-u[0], -u[1], -dot(u, a.slope), u[0], u[1], dot(u, b.slope)];
        Deformed {
            length,
            strain: [stretch, y[2] - beta, y[5] - beta],
            along: slope(n),
            turn: slope(m),
            arm_along: [dot(n, a.arm), -dot(n, b.arm)],
            arm_turn: [dot(m, a.arm), -dot(m, b.arm)],
        }
    }

    /// Energy stored at y (J).
    pub(crate) fn energy(&self, y: &[f64; 6]) -> f64 {
        let d = self.deformed(y);
        let BeamSection { axial, bending, .. } = self.section;
        let [e, f @ ..] = d.strain;
        let [a, b] = self.bend(f);
        (axial * e * e + bending * (f[0] * a + f[1] * b)) / (2.0 * self.length)
    }

    /// Power that its dashpots take (W).
    pub(crate) fn dissipation(&self, y: &[f64; 6], rate: &[f64; 6]) -> f64 {
        if !self.is_damped() {
            return 0.0;
        }
        let BeamSection { axial_damping, bending_damping, .. } = self.section;
        let [e, f @ ..] = self.deformed(y).rates(rate);
        let [a, b] = self.bend(f);
        (axial_damping * e * e + bending_damping * (f[0] * a + f[1] * b)) / self.length
    }

    fn bend(&self, f: [f64; 2]) -> [f64; 2] {
        self.bending.map(|row| row[0] * f[0] + row[1] * f[1])
    }

    /// N, M_a, M_b at these strains and strain rates.
    fn forces(&self, d: &Deformed, [de, df @ ..]: [f64; 3]) -> [f64; 3] {
        let BeamSection { axial, bending, axial_damping, bending_damping, .. } = self.section;
        let [e, f @ ..] = d.strain;
        let bent = [0, 1].map(|i| bending * f[i] + bending_damping * df[i]);
        let [a, b] = self.bend(bent);
        [(axial * e + axial_damping * de) / self.length, a / self.length, b / self.length]
    }

    /// Unit vector along its chord at y, from end a to end b.
    pub(crate) fn direction(&self, y: &[f64; 6]) -> [f64; 2] {
        let d = self.deformed(y);
        [d.along[3], d.along[4]]
    }

    /// What it bears at y, y'.
    pub(crate) fn bearing(&self, y: &[f64; 6], rate: &[f64; 6]) -> BeamForces {
        let d = self.deformed(y);
        let [axial, a, b] = self.forces(&d, d.rates(rate));
        BeamForces { axial, shear: (a + b) / d.length, moments: [a, b] }
    }

    /// Half of its mass times the acceleration of one of its ends, across its chord (N): what the
    /// middle's shear lacks of that of the end, if the half moves as the end does.
    ///
    /// `accel`: y''; `ground`: acceleration of the ground and minus that of gravity (m/s2).
    pub(crate) fn half_inertia(
        &self,
        end: usize,
        [y, rate, accel]: [&[f64; 6]; 3],
        ground: [f64; 2],
    ) -> f64 {
        let [x, z] = self.direction(y);
        let Turned { arm, slope, .. } = turned(self.arms[end], y[TURN[end]]);
        let (turn, turning) = (rate[TURN[end]], accel[TURN[end]]);
        let at =
            |k: usize| ground[k] + accel[3 * end + k] + slope[k] * turning - arm[k] * turn * turn;
        let across = 0.5 * self.section.line_mass * self.length * (at(0) * z - at(1) * x);
        if end == 0 { across } else { -across }
    }

    /// The force that its two nodes need to hold it so: the slope of its energy, and what its
    /// dashpots resist [N, N m].
    pub(crate) fn resistance(&self, y: &[f64; 6], rate: &[f64; 6]) -> [f64; 6] {
        let d = self.deformed(y);
        self.resisted(&d, d.rates(rate))
    }

    /// The same if the dashpots resist the change of strain since the configuration `from`, in
    /// `over` (s).
    pub(crate) fn resistance_since(&self, y: &[f64; 6], from: &[f64; 6], over: f64) -> [f64; 6] {
        let d = self.deformed(y);
        self.resisted(&d, self.rates_since(&d, from, over))
    }

    fn resisted(&self, d: &Deformed, strain_rates: [f64; 3]) -> [f64; 6] {
        let [n, a, b] = self.forces(d, strain_rates);
        let mut force = [0.0; 6];
        for (k, force) in force.iter_mut().enumerate() {
            *force = n * d.along[k] - (a + b) * d.turn[k];
        }
        force[2] += a;
        force[5] += b;
        force
    }

    /// Change of the strains from another configuration, over a time (s).
    fn rates_since(&self, d: &Deformed, from: &[f64; 6], over: f64) -> [f64; 3] {
        if !self.is_damped() {
            return [0.0; 3];
        }
        let before = self.deformed(from).strain;
        [0, 1, 2].map(|k| (d.strain[k] - before[k]) / over)
    }

    /// The resistance's derivatives by y and by y'.
    pub(crate) fn tangent(&self, y: &[f64; 6], rate: &[f64; 6]) -> [[[f64; 6]; 6]; 2] {
        let d = self.deformed(y);
        self.slopes(&d, d.rates(rate), rate)
    }

    /// Derivative by y of [`Self::resistance_since`].
    pub(crate) fn tangent_since(&self, y: &[f64; 6], from: &[f64; 6], over: f64) -> [[f64; 6]; 6] {
        let d = self.deformed(y);
        let [k, c] = self.slopes(&d, self.rates_since(&d, from, over), &[0.0; 6]);
        std::array::from_fn(|i| std::array::from_fn(|j| k[i][j] + c[i][j] / over))
    }

    /// The derivatives at these strain rates, which change with y as y' has it.
    fn slopes(&self, d: &Deformed, strain_rates: [f64; 3], rate: &[f64; 6]) -> [[[f64; 6]; 6]; 2] {
        let BeamSection { axial, bending, axial_damping, bending_damping, .. } = self.section;
        let [n, a, b] = self.forces(d, strain_rates);
        let ends = [0, 1].map(|i| {
            let mut slope = d.turn.map(|x| -x);
            slope[TURN[i]] += 1.0;
            slope
        });
        let [along, turning] = d.curvatures();
        // rates of strain change with y as the slopes do
        let by_rate =
            |h: &[[f64; 6]; 6]| h.map(|row| (0..6).map(|k| row[k] * rate[k]).sum::<f64>());
        let (swing, swerve) = (by_rate(&along), by_rate(&turning));
        let (mut k, mut c) = ([[0.0; 6]; 6], [[0.0; 6]; 6]);
        for i in 0..6 {
            for j in 0..6 {
                let stretch = d.along[i] * d.along[j];
                let mut bend = 0.0;
                let mut turned = 0.0;
                for (p, row) in self.bending.iter().enumerate() {
                    bend += ends[p][i] * (row[0] * ends[0][j] + row[1] * ends[1][j]);
                    turned -= ends[p][i] * (row[0] + row[1]) * swerve[j];
                }
                c[i][j] = (axial_damping * stretch + bending_damping * bend) / self.length;
                k[i][j] = (axial * stretch + bending * bend) / self.length
                    + (axial_damping * d.along[i] * swing[j] + bending_damping * turned)
                        / self.length
                    + n * along[i][j]
                    - (a + b) * turning[i][j];
            }
        }
        [k, c]
    }
}

impl Deformed {
    /// Rates of the strains.
    fn rates(&self, rate: &[f64; 6]) -> [f64; 3] {
        let dot = |u: &[f64; 6]| (0..6).map(|k| u[k] * rate[k]).sum::<f64>();
        let turn = dot(&self.turn);
        [dot(&self.along), rate[2] - turn, rate[5] - turn]
    }

    /// Second derivatives of l and of beta by y.
    fn curvatures(&self) -> [[[f64; 6]; 6]; 2] {
        let Self { length, along, turn, .. } = self;
        let (mut l, mut beta) = ([[0.0; 6]; 6], [[0.0; 6]; 6]);
        for i in 0..6 {
            for j in 0..6 {
                l[i][j] = length * turn[i] * turn[j];
                beta[i][j] = -(along[i] * turn[j] + turn[i] * along[j]) / length;
            }
        }
        for (p, k) in TURN.into_iter().enumerate() {
            l[k][k] += self.arm_along[p];
            beta[k][k] += self.arm_turn[p];
        }
        [l, beta]
    }
}

/// A rigid arm, turned.
#[derive(Clone, Copy)]
pub(super) struct Turned {
    /// As it is now; minus the second derivative by the angle.
    pub arm: [f64; 2],
    /// Derivative by the angle.
    pub slope: [f64; 2],
    /// What its end has moved by.
    pub moved: [f64; 2],
}

/// A rigid arm (x, z) turned clockwise by an angle.
#[inline(always)]
pub(super) fn turned([x, z]: [f64; 2], angle: f64) -> Turned {
    if x == 0.0 && z == 0.0 {
        return Turned { arm: [0.0; 2], slope: [0.0; 2], moved: [0.0; 2] };
    }
    let (sin, cos) = sin_cos(angle);
    // 1 - cos without cancellation
    let versine = sin * sin / (1.0 + cos);
    let moved = [z * sin - x * versine, -x * sin - z * versine];
    let arm = [x + moved[0], z + moved[1]];
    Turned { arm, slope: [arm[1], -arm[0]], moved }
}

#[cfg(test)]
mod tests;
