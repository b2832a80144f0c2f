//! A pier: a mass on an elastic column on a rigid footing, in the footing's own coordinates.
//!
//! ```text
//!   q = (X, Z, theta, u[, a]):  X, Z of the middle of the sole, u across and a along the column in the footing's frame
//!   e1 = (cos theta, -sin theta), e2 = (sin theta, cos theta);   y = h + a
//!   mass m        at (X, Z) + u e1 + y e2        footing m_b, I_b   at (X, Z) + h_b e2        corners at (X, Z) -+ b e1
//!   column        linear:  V = k u^2/2 + k_a a^2/2
//!                 chord:   V = k_a (l - L)^2/2 + k_b psi^2/2,  l^2 = u^2 + (L + a)^2,  tan psi = u/(L + a)
//!   dampers       c u', c_a a'
//! ```
//!
//! M depends on q, unlike that of a `Frame`; in return the column may be axially rigid, which no
//! finite element is. The chord is one corotational element of length L without curvature of its
//! own: k_b = 3 E I/L.

use nalgebra::{DMatrix, DVector};
use num_dual::Dual64;

use super::{Corner, Mechanics};
use rocking::scalar::{GRAVITY, Scalar, real};

/// Most coordinates a pier has.
const SIZE: usize = 5;

/// The column along its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axial {
    /// k_a = E A/L (N/m).
    pub stiffness: f64,
    /// c_a (N s/m).
    pub damping: f64,
    /// Length L of the corotational element; a linear spring along the footing's axis without it
    /// (m).
    pub chord: Option<f64>,
}

/// A mass on an elastic column on a rigid footing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pier {
    /// m (kg).
    pub mass: f64,
    /// h of the mass above the soles (m).
    pub height: f64,
    /// b: half the distance of the corners (m).
    pub half_width: f64,
    /// k of the column across its axis, with what gravity takes from it if it is a chord (N/m).
    pub stiffness: f64,
    /// c (N s/m).
    pub damping: f64,
    /// The column along its axis; rigid there if none.
    pub axial: Option<Axial>,
    /// m_b (kg).
    pub footing_mass: f64,
    /// h_b of the footing's centre of mass above the soles (m).
    pub footing_height: f64,
    /// I_b about its centre of mass (kg m2).
    pub footing_inertia: f64,
}

impl Pier {
    /// A pier of mass m at height h, of half-width b, with the fixed-base frequency f (Hz) and
    /// damping ratio zeta of sqrt(k/m), on a block 2 b wide and 2 h_b high of mass m_b. Its column
    /// is axially rigid.
    pub fn new([m, h, b]: [f64; 3], [f, zeta]: [f64; 2], [m_b, h_b]: [f64; 2]) -> Self {
        let omega = 2.0 * std::f64::consts::PI * f;
        Self {
            mass: m,
            height: h,
            half_width: b,
            stiffness: m * omega * omega,
            damping: 2.0 * zeta * m * omega,
            axial: None,
            footing_mass: m_b,
            footing_height: h_b,
            footing_inertia: m_b * ((2.0 * b).powi(2) + (2.0 * h_b).powi(2)) / 12.0,
        }
    }

    /// The same pier with the axial stiffness k_a (N/m), damped by the share zeta_a of what is
    /// critical for its mass.
    #[must_use]
    pub fn with_axial(self, k_a: f64, zeta_a: f64) -> Self {
        let damping = 2.0 * zeta_a * (k_a * self.mass).sqrt();
        Self { axial: Some(Axial { stiffness: k_a, damping, chord: None }), ..self }
    }

    /// The same pier with its column as one corotational element of length L (m); needs axial
    /// stiffness, without which nothing changes.
    #[must_use]
    pub fn with_chord(self, length: f64) -> Self {
        Self { axial: self.axial.map(|axial| Axial { chord: Some(length), ..axial }), ..self }
    }

    /// q of the pier that leans by theta (rad) on one corner, its mass where the column's linear
    /// springs hold it; standing at theta = 0.
    pub fn leaning(&self, theta: f64) -> DVector<f64> {
        let (sin, cos) = theta.sin_cos();
        let pivot = self.half_width * theta.signum();
        let mut q = vec![
            pivot * (1.0 - cos),
            pivot * sin,
            theta,
            self.mass * GRAVITY * sin / self.stiffness,
        ];
        q.extend(self.axial.map(|axial| -self.mass * GRAVITY * cos / axial.stiffness));
        q.into()
    }

    /// Effective k_b = 3 E I/L of a chord of length L: its lateral stiffness and what gravity takes
    /// from it (N m).
    fn bending(&self, length: f64) -> f64 {
        (self.stiffness + self.mass * GRAVITY / length) * length * length
    }

    /// Energy of the column and its forces (along u, along a).
    fn column<S: Scalar>(&self, u: S, a: S) -> (S, [S; 2]) {
        let k_a = self.axial.map_or(0.0, |axial| axial.stiffness);
        let Some(length) = self.axial.and_then(|axial| axial.chord) else {
            return (
                u * u * (0.5 * self.stiffness) + a * a * (0.5 * k_a),
                [u * self.stiffness, a * k_a],
            );
        };
        let k_b = self.bending(length);
        let y = a + length;
        let l = (u * u + y * y).sqrt();
        // l - L without cancellation
        let stretch = (u * u + a * (a + 2.0 * length)) / (l + length);
        let psi = (u / y).atan();
        let (force, moment) = (stretch * k_a / l, psi * k_b / (l * l));
        let energy = stretch * stretch * (0.5 * k_a) + psi * psi * (0.5 * k_b);
        (energy, [force * u + moment * y, force * y - moment * u])
    }

    /// Q, in all five coordinates.
    fn generalised_force<S: Scalar>(
        &self,
        q: &[S; SIZE],
        v: &[S; SIZE],
        ground: [f64; 2],
    ) -> [S; SIZE] {
        let (sin, cos) = q[2].sin_cos();
        let (u, y, w) = (q[3], q[4] + self.height, v[2]);
        // inertial acceleration of a body that does not move, in (e1, e2)
        let pull = [-ground[0], -ground[1] - GRAVITY];
        let rest = [cos * pull[0] - sin * pull[1], sin * pull[0] + cos * pull[1]];
        let on_mass = [
            (rest[0] - v[4] * w * 2.0 + u * w * w) * self.mass,
            (rest[1] + v[3] * w * 2.0 + y * w * w) * self.mass,
        ];
        let on_footing = [
            rest[0] * self.footing_mass,
            (rest[1] + w * w * self.footing_height) * self.footing_mass,
        ];
        let sum = [on_mass[0] + on_footing[0], on_mass[1] + on_footing[1]];
        let (_, column) = self.column(u, q[4]);
        let axial_damping = self.axial.map_or(0.0, |axial| axial.damping);
        [
            cos * sum[0] + sin * sum[1],
            cos * sum[1] - sin * sum[0],
            y * on_mass[0] - u * on_mass[1] + on_footing[0] * self.footing_height,
            on_mass[0] - column[0] - v[3] * self.damping,
            on_mass[1] - column[1] - v[4] * axial_damping,
        ]
    }

    /// Columns of the Jacobians of the mass and of the footing's centre, in (e1, e2).
    fn jacobians(&self, q: &[f64; SIZE]) -> [[[f64; 2]; SIZE]; 2] {
        let (sin, cos) = q[2].sin_cos();
        let [x, z] = [[cos, sin], [-sin, cos]];
        let mass = [x, z, [q[4] + self.height, -q[3]], [1.0, 0.0], [0.0, 1.0]];
        [mass, [x, z, [self.footing_height, 0.0], [0.0; 2], [0.0; 2]]]
    }

    fn padded<S: Scalar>(x: &DVector<f64>) -> [S; SIZE] {
        std::array::from_fn(|i| real(x.get(i).copied().unwrap_or(0.0)))
    }
}

impl Mechanics for Pier {
    fn size(&self) -> usize {
        if self.axial.is_some() { 5 } else { 4 }
    }

    fn mass(&self, q: &DVector<f64>) -> DMatrix<f64> {
        let [on_mass, on_footing] = self.jacobians(&Self::padded(q));
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let n = self.size();
        let mut mass = DMatrix::from_fn(n, n, |i, j| {
            self.mass * dot(on_mass[i], on_mass[j])
                + self.footing_mass * dot(on_footing[i], on_footing[j])
        });
        mass[(2, 2)] += self.footing_inertia;
        mass
    }

    fn force(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> DVector<f64> {
        let force = self.generalised_force::<f64>(&Self::padded(q), &Self::padded(v), ground);
        DVector::from_column_slice(&force[..self.size()])
    }

    fn tangent(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> [DMatrix<f64>; 2] {
        let n = self.size();
        let mut tangent = [DMatrix::zeros(n, n), DMatrix::zeros(n, n)];
        for column in 0..2 * n {
            let (mut q, mut v) = (Self::padded::<Dual64>(q), Self::padded::<Dual64>(v));
            let seeded = if column < n { &mut q[column] } else { &mut v[column - n] };
            *seeded = seeded.derivative();
            let force = self.generalised_force(&q, &v, ground);
            for row in 0..n {
                tangent[column / n][(row, column % n)] = -force[row].eps;
            }
        }
        tangent
    }

    fn footings(&self) -> &[usize] {
        &[0, 0]
    }

    fn rotation(&self, _footing: usize, q: &DVector<f64>) -> f64 {
        q[2]
    }

    fn corner(&self, i: usize, q: &DVector<f64>, v: &DVector<f64>) -> Corner {
        let x = if i == 0 { -self.half_width } else { self.half_width };
        let ((sin, cos), w2) = (q[2].sin_cos(), v[2] * v[2]);
        let mut jacobian = [DVector::zeros(self.size()), DVector::zeros(self.size())];
        (jacobian[0][0], jacobian[0][2]) = (1.0, -x * sin);
        (jacobian[1][1], jacobian[1][2]) = (1.0, -x * cos);
        let half = (0.5 * q[2]).sin();
        Corner {
            place: [q[0] - 2.0 * x * half * half, q[1] - x * sin],
            jacobian,
            bias: [-x * cos * w2, x * sin * w2],
        }
    }

    fn potential(&self, q: &DVector<f64>) -> f64 {
        let q = Self::padded::<f64>(q);
        let (sin, cos) = q[2].sin_cos();
        let sunk = 2.0 * (0.5 * q[2]).sin().powi(2);
        let mass = q[1] - q[3] * sin + q[4] * cos - self.height * sunk;
        let footing = q[1] - self.footing_height * sunk;
        GRAVITY * (self.mass * mass + self.footing_mass * footing) + self.column(q[3], q[4]).0
    }

    fn dissipation(&self, _q: &DVector<f64>, v: &DVector<f64>) -> f64 {
        self.damping * v[3] * v[3] + self.axial.map_or(0.0, |axial| axial.damping * v[4] * v[4])
    }

    fn input_power(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> f64 {
        let (q, v) = (Self::padded::<f64>(q), Self::padded::<f64>(v));
        let (sin, cos) = q[2].sin_cos();
        let [mut along, mut across] = [0.0; 2];
        for (jacobian, mass) in self.jacobians(&q).iter().zip([self.mass, self.footing_mass]) {
            for (column, v) in jacobian.iter().zip(v) {
                across += mass * column[0] * v;
                along += mass * column[1] * v;
            }
        }
        -ground[0] * (cos * across + sin * along) - ground[1] * (cos * along - sin * across)
    }
}
