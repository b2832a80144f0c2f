//! The standing structure as the ground feels it: what lands at each footing, and how stiff springs
//! must be against the structure.
//!
//! ```text
//!   W = G M^-1 G'                 of a footing's corners: what a unit force at one does to the velocities of all
//!   K u = M r + G' R,  G u = 0    the structure fixed to the ground under a uniform acceleration r, sideways or upwards: reactions R
//!   compliance_ratio = sum R_i^2/k_i / u' K u
//!   uplift = least N_i of a corner at rest over |R_i| under 1 m/s2 sideways
//! ```
//!
//! The compliance ratio is the energy of ground springs k_i over that of the structure, to first
//! order the share by which they lower the square of the fixed structure's frequency: of a mass on
//! a column of lateral stiffness k and height h, k h^2/(2 b^2 k_v) + k/(2 k_h).

use nalgebra::{DMatrix, DVector, SVD};

use super::Mechanics;

/// Singular values of the constraints below this share of the largest count as redundant
/// constraints.
const REDUNDANT: f64 = 1e-9;

/// One footing, or a foot without a width.
#[derive(Clone, Debug)]
pub struct FootingInertia {
    /// Its corners, from the left.
    pub corners: Vec<usize>,
    /// W of these: rows and columns x, z of each corner (1/kg).
    pub w: DMatrix<f64>,
    /// Distance between its first and last corner (m).
    pub width: f64,
}

/// The fixed structure under a uniform acceleration.
#[derive(Clone, Debug)]
pub struct FixedResponse {
    /// Reactions (H, N) at each corner, at 1 m/s2 (N).
    pub reactions: Vec<[f64; 2]>,
    /// u' K u, twice the elastic energy at 1 m/s2 (J).
    pub work: f64,
    /// Rayleigh's estimate of the frequency of this deformation (rad/s).
    pub omega: f64,
}

impl FixedResponse {
    /// Give of springs of stiffness `k` = [horizontal, vertical] under every corner (N/m).
    pub fn compliance_ratio(&self, k: [f64; 2]) -> f64 {
        self.reactions.iter().map(|[h, n]| h * h / k[0] + n * n / k[1]).sum::<f64>() / self.work
    }
}

/// A structure in its standing configuration.
#[derive(Clone, Debug)]
pub struct Standing {
    /// Forces (H, N) of the ground at each corner, at rest (N).
    pub reactions: Vec<[f64; 2]>,
    /// What lands at each footing.
    pub footings: Vec<FootingInertia>,
    /// Sideways and upwards.
    pub responses: [FixedResponse; 2],
    /// All mass (kg).
    pub mass: f64,
}

impl Standing {
    /// Of a structure that stands at `q`; `None` if it does not: its stiffness, with the corners
    /// held, is not positive.
    pub fn new<T: Mechanics + ?Sized>(structure: &T, q: &DVector<f64>) -> Option<Self> {
        let rest = DVector::zeros(structure.size());
        let mass = structure.factored_mass(q)?;
        let corners = structure.footings().len();
        let rows: Vec<_> = (0..corners).map(|i| structure.corner(i, q, &rest)).collect();
        let mut g = DMatrix::zeros(2 * corners, structure.size());
        for (i, corner) in rows.iter().enumerate() {
            g.set_row(2 * i, &corner.jacobian[0].transpose());
            g.set_row(2 * i + 1, &corner.jacobian[1].transpose());
        }
        let w = product(&g, &mass.solve(&g.transpose()));
        let footings = footings(structure.footings(), &w, |corners| width(&g, corners));

        let [stiffness, _] = structure.tangent(q, &rest, [0.0; 2]);
        let held = HeldFrame::new(&g)?;
        let still = structure.force(q, &rest, [0.0; 2]);
        let of = |ground: [f64; 2]| {
            held.response(
                &stiffness,
                &structure.mass(q),
                &(structure.force(q, &rest, ground) - &still),
            )
        };
        let responses = [of([-1.0, 0.0])?, of([0.0, -1.0])?];
        Some(Self {
            reactions: held.reactions(&-still),
            footings,
            responses,
            mass: structure.whole_mass(q),
        })
    }

    /// Ground acceleration, slowly applied, at which the first corner lifts (m/s2): the vertical
    /// force at rest over what 1 m/s2 takes off it. `None` if a corner bears nothing at rest.
    pub fn uplift(&self) -> Option<f64> {
        let at_rest = self.reactions.iter().map(|[_, n]| *n);
        let lifted =
            at_rest.zip(&self.responses[0].reactions).map(|(n, [_, by])| (n, n / by.abs()));
        let first = lifted.map(|(n, lift)| if n > 0.0 { lift } else { f64::NAN }).reduce(|a, b| {
            // NaN: a corner without weight decides
            if a < b || a.is_nan() { a } else { b }
        });
        first.filter(|lift| lift.is_finite())
    }
}

/// W of each footing, in the order of their corners.
fn footings(
    of_corner: &[usize],
    w: &DMatrix<f64>,
    width: impl Fn(&[usize]) -> f64,
) -> Vec<FootingInertia> {
    let count = of_corner.iter().map(|footing| footing + 1).max().unwrap_or(0);
    let footing = |index: usize| {
        let corners: Vec<usize> = (0..of_corner.len()).filter(|i| of_corner[*i] == index).collect();
        let at = |row: usize| 2 * corners[row / 2] + row % 2;
        let own = DMatrix::from_fn(2 * corners.len(), 2 * corners.len(), |i, j| w[(at(i), at(j))]);
        let width = width(&corners);
        FootingInertia { corners, w: own, width }
    };
    // nodes without corners are no footings
    (0..count).filter(|index| of_corner.contains(index)).map(footing).collect()
}

/// Distance of a footing's outer corners, from G: a unit rotation lowers one against the other by
/// it.
fn width(g: &DMatrix<f64>, corners: &[usize]) -> f64 {
    let (Some(first), Some(last)) = (corners.first(), corners.last()) else { return 0.0 };
    let difference = g.row(2 * first + 1) - g.row(2 * last + 1);
    difference.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// The matrix product a b, with the terms of every entry added one after another. nalgebra's
/// product of matrices above 5 x 5 uses fused multiply-adds where the processor has them: its last
/// digits differ between machines, and between the program and the page in a browser.
fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let entry = |i: usize, j: usize| (0..a.ncols()).map(|k| a[(i, k)] * b[(k, j)]).sum();
    DMatrix::from_fn(a.nrows(), b.ncols(), entry)
}

/// a^+, singular values up to `least` taken for zero.
fn pseudo_inverse(a: DMatrix<f64>, least: f64) -> Option<DMatrix<f64>> {
    let svd = SVD::new_unordered(a, true, true);
    let (mut u, v_t) = (svd.u?, svd.v_t?);
    for (mut column, &value) in u.column_iter_mut().zip(svd.singular_values.iter()) {
        column *= if value > least { 1.0 / value } else { 0.0 };
    }
    Some(product(&v_t.transpose(), &u.transpose()))
}

/// All corners held.
struct HeldFrame {
    /// Motions that leave them where they are, in columns.
    free: DMatrix<f64>,
    /// G'^+, from forces on the coordinates to reactions; redundant ones shared.
    reactions: DMatrix<f64>,
}

impl HeldFrame {
    fn new(g: &DMatrix<f64>) -> Option<Self> {
        let n = g.ncols();
        // of the square matrix, for all right singular vectors
        let svd = SVD::new_unordered(product(&g.transpose(), g), true, false);
        let u = svd.u?;
        let most = svd.singular_values.max();
        let idle: Vec<usize> =
            (0..n).filter(|i| svd.singular_values[*i] <= REDUNDANT * most).collect();
        let free = DMatrix::from_fn(n, idle.len(), |i, j| u[(i, idle[j])]);
        let reactions = pseudo_inverse(g.transpose(), REDUNDANT.sqrt() * most.sqrt())?;
        Some(Self { free, reactions })
    }

    /// (H, N) of each corner that hold these forces on the coordinates.
    fn reactions(&self, forces: &DVector<f64>) -> Vec<[f64; 2]> {
        let all = &self.reactions * forces;
        (0..all.len() / 2).map(|i| [all[2 * i], all[2 * i + 1]]).collect()
    }

    fn response(
        &self,
        stiffness: &DMatrix<f64>,
        mass: &DMatrix<f64>,
        load: &DVector<f64>,
    ) -> Option<FixedResponse> {
        let reduced = product(&product(&self.free.transpose(), stiffness), &self.free);
        let reduced = 0.5 * (&reduced + reduced.transpose());
        let u = &self.free * reduced.cholesky()?.solve(&(self.free.transpose() * load));
        let forces = stiffness * &u;
        let work = u.dot(&forces);
        let reactions = self.reactions(&(forces - load));
        let omega = (work / u.dot(&(mass * &u))).sqrt();
        Some(FixedResponse { reactions, work, omega })
    }
}

#[cfg(test)]
mod tests;
