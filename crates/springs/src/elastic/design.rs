//! Springs for what lands of an elastic structure, from its standing configuration.
//!
//! ```text
//!   m_l      mass of what lands, with W = G M^-1 G' of its two corners as that of a body (`CornerDynamics`): the footing alone under an elastic column
//!   m_eff    [(W_new)^-1]_zz, under the landing corner
//!   units    the universal chain on m_eff: m2 = mu_u(K) m_eff, c = C_u(K) sqrt(k1 m_eff), k2 = K k1; horizontals that do not lag, on m_l
//!   k1       by the compliance ratio of the stance: the energy of springs k1 over the structure's own, under a uniform acceleration (`Standing`)
//! ```
//!
//! The structure's own springs have no part in the landing: they are softer than k1 by the
//! compliance ratio, which is small.
//!
//! **K** trades what a landing leaves against the stance, as for a rigid body. The footing comes
//! back by v_r, about 0.8 K v, and stays in the air for 2 v_r m_eff/(M g), since the column presses
//! it down with all of the weight: the sway meanwhile goes on by a phase of order omega K^2 v
//! m_eff/(M g). Where the column is about to pull it up, it is gone with v_r: an error of order K.
//! A stance softer by 1/K lowers the sway's frequency by compliance_ratio/(2 K). The least sum of
//! all three has
//!
//! ```text
//!   K^2 (K + turn) = scale compliance_ratio M g/(omega v m_eff),     v: speed at which a corner lands that fell from half of what overturns
//! ```
//!
//! with two numbers (`BALANCE`) that `cargo bench --bench elastic_stance` finds again, on piers of
//! light to heavy footings and a frame: the geometric mean of their errors is least about a turn of
//! 0.05 and three times the scale, and a tenth above that at this scale, which is taken: a record
//! that is followed far grows most what landings leave.

use std::f64::consts::TAU;

use nalgebra::DMatrix;

use dynamics::spring::{Chain, Springs};
use frames::standing::{FixedResponse, FootingInertia, Standing};
use landing::{corners::CornerDynamics, part::for_part};
use rocking::scalar::GRAVITY;

/// The numbers in the choice of K.
#[derive(Clone, Copy, Debug)]
pub struct KBalance {
    /// Factor on the right side.
    pub scale: f64,
    /// K below which errors of order K, not K^2, decide.
    pub turn: f64,
}

/// See above.
pub const BALANCE: KBalance = KBalance { scale: 0.12, turn: 0.05 };
/// The range of K: soft springs bounce on a larger one, and below the least no chain is sought.
const K: (f64, f64) = (5e-4, 0.5);

/// Steps of Newton's method: from (x)^(1/3) it halves K at most ten times, then doubles its digits.
const NEWTON: usize = 30;

/// By how much W of footings that are alike may differ: rounding.
const SAME: f64 = 1e-9;

/// Springs under every corner.
#[derive(Clone, Debug, PartialEq)]
pub struct CornerSprings {
    /// Under corner i.
    pub corners: Vec<Springs<Chain>>,
    /// K = k2/k1 of the vertical units.
    pub k: f64,
    /// Energy of all springs over the structure's, under its weight's worth sideways and upwards
    /// together.
    pub compliance_ratio: f64,
    /// sqrt(k1/M)/(2 pi), M all mass, of the vertical units (Hz).
    pub omega_n_hz: f64,
}

impl CornerSprings {
    /// With horizontal units whose k1 is so many times that of the vertical ones: they land as
    /// before, faster or slower.
    pub(super) fn with_horizontal(mut self, standing: &Standing, over_vertical: f64) -> Self {
        for Springs { vertical, horizontal } in &mut self.corners {
            let times = over_vertical * vertical.k1 / horizontal.k1;
            horizontal.k1 *= times;
            horizontal.k2 *= times;
            horizontal.c *= times.sqrt();
        }
        self.compliance_ratio = compliance_ratio_of(standing, &self.corners);
        self
    }
}

/// What lands at a footing, in units of its mass.
#[derive(Clone, Debug)]
struct Lands {
    corners: CornerDynamics,
    /// (kg)
    mass: f64,
    /// Effective mass under the landing corner, over that.
    effective: f64,
}

impl Lands {
    fn new(footing: &FootingInertia) -> Self {
        let FootingInertia { w, width, .. } = footing;
        let last = w.nrows() - 2;
        if last == 0 {
            // a foot without a width: the other corner is not there
            let mass = 1.0 / w[(1, 1)];
            let mut alone = [[0.0; 4]; 4];
            (0..2).for_each(|i| (0..2).for_each(|j| alone[2 + i][2 + j] = w[(i, j)] * mass));
            return Self { corners: CornerDynamics::of(alone, 1.0), mass, effective: 1.0 };
        }
        // a body's corners go up and down together by 1/m
        let mass = 2.0 / (w[(1, 1)] + w[(1, last + 1)]);
        let outer = outer(w, last);
        let corners = CornerDynamics::of(outer.map(|row| row.map(|x| x * mass)), *width);
        let effective = corners.effective_mass()[1];
        Self { corners, mass, effective }
    }

    /// m_eff (kg).
    fn effective_mass(&self) -> f64 {
        self.mass * self.effective
    }

    /// Units at K, at this k1 of the vertical ones (N/m).
    fn springs(&self, k: f64, k1: f64) -> Springs<Chain> {
        let mut design = for_part(&self.corners, k);
        let hz = (k1 / self.mass).sqrt() / TAU;
        design.vertical.omega_n_hz *= hz;
        design.horizontal.omega_n_hz *= hz;
        design.chains(self.mass)
    }
}

/// W of a footing's outer corners.
fn outer(w: &DMatrix<f64>, last: usize) -> [[f64; 4]; 4] {
    let at = |i: usize| if i < 2 { i } else { last + i - 2 };
    std::array::from_fn(|i| std::array::from_fn(|j| w[(at(i), at(j))]))
}

/// Springs of a structure at a compliance ratio of its vertical k1 alone: the smaller, the stiffer.
/// `landing`: v of the choice of K (m/s); `share` of that K.
pub fn springs(
    standing: &Standing,
    compliance_ratio: f64,
    landing: f64,
    share: f64,
) -> CornerSprings {
    with_k(standing, compliance_ratio, share * BALANCE.k(standing, compliance_ratio, landing))
}

impl KBalance {
    /// K of a structure at a compliance ratio of its vertical k1 alone. `landing`: v (m/s).
    pub fn k(&self, standing: &Standing, compliance_ratio: f64, landing: f64) -> f64 {
        let lightest = standing
            .footings
            .iter()
            .map(|f| Lands::new(f).effective_mass())
            .fold(f64::INFINITY, f64::min);
        let share = standing.responses[0].omega * landing * lightest / (standing.mass * GRAVITY);
        self.solve(self.scale * compliance_ratio / share).clamp(K.0, K.1)
    }

    /// K of K^2 (K + turn) = x, by Newton's method from above: the left side is convex.
    fn solve(&self, x: f64) -> f64 {
        let mut k = x.cbrt();
        for _ in 0..NEWTON {
            k -= (k * k * (k + self.turn) - x) / (k * (3.0 * k + 2.0 * self.turn));
        }
        k
    }
}

/// k1 of the vertical units at a compliance ratio of these alone (N/m).
fn k1(standing: &Standing, compliance_ratio: f64) -> f64 {
    let unit: f64 =
        standing.responses.iter().map(|sway| sway.compliance_ratio([f64::INFINITY, 1.0])).sum();
    unit / compliance_ratio
}

/// sqrt(k1/M)/(2 pi) of the springs at a compliance ratio (Hz).
pub(crate) fn omega_n_hz(standing: &Standing, compliance_ratio: f64) -> f64 {
    (k1(standing, compliance_ratio) / standing.mass).sqrt() / TAU
}

/// The same at any K.
pub fn with_k(standing: &Standing, compliance_ratio: f64, k: f64) -> CornerSprings {
    with_vertical(standing, k1(standing, compliance_ratio), k)
}

/// Springs of this k1 of the vertical units (N/m), at K.
pub(super) fn with_vertical(standing: &Standing, k1: f64, k: f64) -> CornerSprings {
    let mut of_footing: Vec<Springs<Chain>> = Vec::new();
    for (i, footing) in standing.footings.iter().enumerate() {
        // a search each: footings that are alike share one
        let same = standing.footings[..i].iter().position(|other| alike(other, footing));
        of_footing.push(same.map_or_else(|| Lands::new(footing).springs(k, k1), |j| of_footing[j]));
    }
    let count = standing.responses[0].reactions.len();
    let footing = |corner: usize| {
        standing.footings.iter().position(|f| f.corners.contains(&corner)).unwrap_or(0)
    };
    let corners: Vec<_> = (0..count).map(|corner| of_footing[footing(corner)]).collect();
    let compliance_ratio = compliance_ratio_of(standing, &corners);
    let omega_n_hz = (k1 / standing.mass).sqrt() / TAU;
    CornerSprings { corners, k, compliance_ratio, omega_n_hz }
}

/// Whether two footings land alike, to rounding.
fn alike(a: &FootingInertia, b: &FootingInertia) -> bool {
    a.w.shape() == b.w.shape() && a.width == b.width && (&a.w - &b.w).amax() <= SAME * b.w.amax()
}

/// Energy of the springs over that of the structure, over all sways.
fn compliance_ratio_of(standing: &Standing, corners: &[Springs<Chain>]) -> f64 {
    standing.responses.iter().map(|sway| total_compliance(sway, corners)).sum()
}

/// The same in one of them.
fn total_compliance(sway: &FixedResponse, corners: &[Springs<Chain>]) -> f64 {
    let each = sway.reactions.iter().zip(corners);
    let energy: f64 = each
        .map(|([h, n], s)| h * h / s.horizontal.in_series() + n * n / s.vertical.in_series())
        .sum();
    energy / sway.work
}

#[cfg(test)]
mod tests;
