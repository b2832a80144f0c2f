//! A structure with four corners on two footings, for tests: two rigid legs, a spring and a damper
//! between their heads, and a mass halfway between the heads on a massless link, which couples the
//! legs in M.
//!
//! ```text
//!   q = (X1, Z1, theta1, X2, Z2, theta2), at the middle of each sole;  heads P_i = (X_i, Z_i) + h e2_i
//!   a mass m_h at each head, m_l at (P1 + P2)/2, m_b and I_b at h_b on each leg;  spring k, damper c along x between the heads
//! ```

use frames::{Corner, Mechanics};
use nalgebra::{DMatrix, DVector};

/// The structure; SI units.
#[derive(Clone, Copy, Debug)]
pub struct Portal {
    pub head: f64,
    pub link: f64,
    pub footings: [f64; 2],
    pub inertia: f64,
    pub height: f64,
    pub footing_height: f64,
    pub half_width: f64,
    pub stiffness: f64,
    pub damping: f64,
}

impl Default for Portal {
    fn default() -> Self {
        Self {
            head: 4e4,
            link: 9e4,
            footings: [6e4, 6e4],
            inertia: 5e4,
            height: 6.0,
            footing_height: 0.5,
            half_width: 1.2,
            stiffness: 3e7,
            damping: 3e5,
        }
    }
}

/// Rows (x, z) of a Jacobian, and what accelerates without q''.
type Place = ([DVector<f64>; 2], [f64; 2]);

impl Portal {
    /// A place on leg i at (xi, eta) in its frame.
    fn on_leg(i: usize, [xi, eta]: [f64; 2], q: &DVector<f64>, v: &DVector<f64>) -> Place {
        let ((sin, cos), w) = (q[3 * i + 2].sin_cos(), v[3 * i + 2]);
        let row = |k: usize, turn: f64| {
            let mut row = DVector::zeros(6);
            (row[3 * i + k], row[3 * i + 2]) = (1.0, turn);
            row
        };
        let jacobian = [row(0, -xi * sin + eta * cos), row(1, -xi * cos - eta * sin)];
        (jacobian, [(-xi * cos - eta * sin) * w * w, (xi * sin - eta * cos) * w * w])
    }

    /// (mass, place) of every point mass.
    fn masses(&self, q: &DVector<f64>, v: &DVector<f64>) -> Vec<(f64, Place)> {
        let head = |i| Self::on_leg(i, [0.0, self.height], q, v);
        let footing = |i| (self.footings[i], Self::on_leg(i, [0.0, self.footing_height], q, v));
        vec![
            (self.head, head(0)),
            (self.head, head(1)),
            (self.link, mean(head(0), head(1))),
            footing(0),
            footing(1),
        ]
    }

    /// Stretch between the heads and its gradient.
    fn stretch(&self, q: &DVector<f64>) -> (f64, DVector<f64>) {
        let still = DVector::zeros(6);
        let [left, right] = [0, 1].map(|i| Self::on_leg(i, [0.0, self.height], q, &still).0);
        let x = q[3] + self.height * q[5].sin() - q[0] - self.height * q[2].sin();
        (x, &right[0] - &left[0])
    }
}

/// Half the sum of two places.
fn mean((a, c): Place, (b, d): Place) -> Place {
    ([0, 1].map(|k| (&a[k] + &b[k]) * 0.5), [0, 1].map(|k| 0.5 * (c[k] + d[k])))
}

impl Mechanics for Portal {
    fn size(&self) -> usize {
        6
    }

    fn mass(&self, q: &DVector<f64>) -> DMatrix<f64> {
        let mut mass = DMatrix::zeros(6, 6);
        for (m, (rows, _)) in self.masses(q, &DVector::zeros(6)) {
            for row in rows {
                mass += m * &row * row.transpose();
            }
        }
        for i in [2, 5] {
            mass[(i, i)] += self.inertia;
        }
        mass
    }

    fn force(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> DVector<f64> {
        let mut force = DVector::zeros(6);
        for (m, (rows, bias)) in self.masses(q, v) {
            force +=
                m * ((-ground[0] - bias[0]) * &rows[0] + (-ground[1] - 9.81 - bias[1]) * &rows[1]);
        }
        let (stretch, gradient) = self.stretch(q);
        let tension = self.stiffness * stretch + self.damping * gradient.dot(v);
        force - gradient * tension
    }

    fn tangent(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> [DMatrix<f64>; 2] {
        let step = 1e-6;
        let by = |f: &dyn Fn(f64, usize) -> DVector<f64>| {
            let columns: Vec<_> =
                (0..6).map(|j| (f(-step, j) - f(step, j)) * (0.5 / step)).collect();
            DMatrix::from_columns(&columns)
        };
        let moved = |x: &DVector<f64>, by: f64, j: usize| {
            let mut x = x.clone();
            x[j] += by;
            x
        };
        [
            by(&|s, j| self.force(&moved(q, s, j), v, ground)),
            by(&|s, j| self.force(q, &moved(v, s, j), ground)),
        ]
    }

    fn footings(&self) -> &[usize] {
        &[0, 0, 1, 1]
    }

    fn rotation(&self, footing: usize, q: &DVector<f64>) -> f64 {
        q[3 * footing + 2]
    }

    fn corner(&self, i: usize, q: &DVector<f64>, v: &DVector<f64>) -> Corner {
        let (leg, xi) =
            (i / 2, if i.is_multiple_of(2) { -self.half_width } else { self.half_width });
        let (jacobian, bias) = Self::on_leg(leg, [xi, 0.0], q, v);
        let (sin, cos) = q[3 * leg + 2].sin_cos();
        Corner { place: [q[3 * leg] + xi * (cos - 1.0), q[3 * leg + 1] - xi * sin], jacobian, bias }
    }

    fn potential(&self, q: &DVector<f64>) -> f64 {
        let height = |i: usize, eta: f64| q[3 * i + 1] + eta * (q[3 * i + 2].cos() - 1.0);
        let heads = height(0, self.height) + height(1, self.height);
        let footings: f64 = (0..2).map(|i| self.footings[i] * height(i, self.footing_height)).sum();
        let weights = (self.head + 0.5 * self.link) * heads + footings;
        9.81 * weights + 0.5 * self.stiffness * self.stretch(q).0.powi(2)
    }

    fn dissipation(&self, q: &DVector<f64>, v: &DVector<f64>) -> f64 {
        self.damping * self.stretch(q).1.dot(v).powi(2)
    }

    fn input_power(&self, q: &DVector<f64>, v: &DVector<f64>, ground: [f64; 2]) -> f64 {
        let along =
            |rows: &[DVector<f64>; 2]| ground[0] * rows[0].dot(v) + ground[1] * rows[1].dot(v);
        -self.masses(q, v).iter().map(|(m, (rows, _))| m * along(rows)).sum::<f64>()
    }
}
