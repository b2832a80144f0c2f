//! The design of the springs as a function of the geometry: alpha, m R^2/I0 and, through K,
//! Omega_n/p.
//!
//! Horizontal units so stiff that they do not lag leave one vertical chain (`chain`), scaled by the
//! effective mass under the landing foot, the Schur complement of its vertical motion while the
//! body may turn about it:
//!
//! ```text
//!   M = 1 - (m R^2/I0) sin^2 alpha          mu = mu_u(K) M,   C = C_u(K) sqrt(M)
//!   mu_u, C_u: least rebound of the chain whose absorber does not come back to touch
//! ```
//!
//! **Omega_h/Omega_v** is 4, and more for A-frames beyond alpha 0.2: as much as keeps the momentum
//! about the new foot to 2e-6 in the landing of the plane body (`plane`). Neither K_h, C_h nor mu_h
//! matters much; OpenSees likes these.
//!
//! **K** trades the landing against the stance. A rebound of v_r costs a history about A alpha^3
//! (v_r/v_n)^2, with v_r/v_n about 0.8 K; the give of the stance costs B/(alpha^3 (Omega_n/p)^2 K),
//! since the standing body has leant by (p/Omega_n)^2 (1 + K)/(2 alpha^2 K) of alpha when it lifts.
//! The least sum of both has
//!
//! ```text
//!   K_0 = K_SCALE (alpha^3 Omega_n/p)^(-2/3),     K^2 = [K_0/(1 + K_0/K_LARGEST)]^2 + K_LEAST^2
//! ```
//!
//! the fraction for soft springs, where landings on a larger K bounce; K_LEAST below. `cargo bench
//! --bench stance` finds K_SCALE again: the error that Omega_n is chosen by hardly falls beyond it,
//! while landings on soft springs and of stocky bodies rebound more.

use std::f64::consts::TAU;

use thiserror::Error;

use super::{
    corners::CornerDynamics,
    plane::land,
    universal::{Universal, universal},
};
use dynamics::spring::{Design, Springs};
use rocking::structure::Body;

/// K_0 at alpha^3 Omega_n/p = 1: of the scales whose error is within a third of the least the one
/// that rebounds least (`benches/stance.rs`).
const K_SCALE: f64 = 1.3;
/// The K that ever softer springs tend to.
const K_LARGEST: f64 = 0.5;
/// The K that ever stiffer springs tend to: below it no damping lets the absorber come back within
/// the time that a landing is followed.
const K_LEAST: f64 = 0.003;
/// Omega_n v_n/g from which on the stiff limit holds.
const STIFF_LIMIT: f64 = 100.0;
/// Omega_n v_n/g from which on all landings, gentle ones too, keep the restitution to 0.2 %
/// (`tests/chart.rs`).
const LANDINGS_HOLD: f64 = 15.0;
/// Slenderness, mass share and relative stiffness: all that the design depends on, each rounded to
/// nine digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    alpha: f64,
    mass_share: f64,
    stiffness: f64,
}

/// What no design can be made for.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum GeometryError {
    #[error("design: alpha is {0:?}; give a slenderness between 0.005 and 0.9 rad")]
    Alpha(f64),
    #[error("design: m R^2/I0 is {0:?}; give a number above 0, at most 1")]
    MassShare(f64),
    #[error("design: Omega_n/p is {0:?}; give a number between 1 and 1e9")]
    Stiffness(f64),
}

impl Geometry {
    /// alpha (rad), m R^2/I0 and Omega_n/p.
    ///
    /// # Errors
    /// Numbers outside 0.005 to 0.9 rad, 0 to 1, 1 to 1e9.
    pub fn new(alpha: f64, mass_share: f64, stiffness: f64) -> Result<Self, GeometryError> {
        if !(0.005..=0.9).contains(&alpha) {
            return Err(GeometryError::Alpha(alpha));
        }
        if !(mass_share > 0.0 && mass_share <= 1.0) {
            return Err(GeometryError::MassShare(mass_share));
        }
        if !(1.0..=1e9).contains(&stiffness) {
            return Err(GeometryError::Stiffness(stiffness));
        }
        Ok(Self {
            alpha: nine_digits(alpha),
            mass_share: nine_digits(mass_share),
            stiffness: nine_digits(stiffness),
        })
    }

    /// Of a body, at this Omega_n/p.
    ///
    /// # Errors
    /// As [`Geometry::new`].
    pub fn of(body: &Body<f64>, stiffness: f64) -> Result<Self, GeometryError> {
        Self::new(body.alpha(), body.mass_share(), stiffness)
    }

    /// Slenderness (rad).
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// m R^2/I0.
    pub fn mass_share(&self) -> f64 {
        self.mass_share
    }

    /// Omega_n/p.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Effective mass under the landing foot, over m.
    pub fn effective_mass(&self) -> f64 {
        1.0 - self.mass_share * self.alpha.sin().powi(2)
    }

    /// Omega_n v_n/g for a fall from alpha: (m R^2/I0) 2 alpha^2 Omega_n/p.
    pub(crate) fn hardness(&self) -> f64 {
        2.0 * self.mass_share * self.alpha.powi(2) * self.stiffness
    }

    /// Whether gravity has no part in a landing to speak of: the hardness is at least 100.
    pub fn in_stiff_limit(&self) -> bool {
        self.hardness() >= STIFF_LIMIT
    }

    /// Whether all landings keep the restitution to 0.2 %: the hardness is at least 15.
    pub fn landings_hold(&self) -> bool {
        self.hardness() >= LANDINGS_HOLD
    }

    /// Stiffness ratio K = k2/k1 of the vertical units.
    pub fn k(&self) -> f64 {
        self.k_of(K_SCALE)
    }

    /// The same with another K_0 at alpha^3 Omega_n/p = 1.
    pub fn k_of(&self, scale: f64) -> f64 {
        let k = scale * (self.alpha.powi(3) * self.stiffness).powf(-2.0 / 3.0);
        (k / (1.0 + k / K_LARGEST)).hypot(K_LEAST)
    }

    /// The springs, their frequencies relative to the vertical Omega_n.
    pub fn springs(&self) -> Springs<Design<f64>> {
        for_landing(
            &CornerDynamics::rigid(self.alpha, self.mass_share),
            self.effective_mass(),
            self.k(),
        )
    }
}

/// Springs for what lands on these corners, of effective mass `m` vertically in units of its mass,
/// at K; frequencies relative to the vertical Omega_n.
pub fn for_landing(corners: &CornerDynamics, m: f64, k: f64) -> Springs<Design<f64>> {
    let Universal { k, c, mu, .. } = universal(k);
    let mut springs = Springs {
        vertical: Design::from_kc(mu * m, k, c * m.sqrt(), 1.0),
        horizontal: Design::from_kc(HORIZONTAL.mu, HORIZONTAL.k, HORIZONTAL.c, HORIZONTAL.ratio),
    };
    // what the old foot takes falls with the fourth power of the ratio
    let error = land(corners, &springs).momentum - 1.0;
    springs.horizontal.omega_n_hz *= (error / MOMENTUM).max(1.0).powf(0.25);
    springs
}

/// The horizontal units: what they are hardly matters for the landing, as long as they do not lag.
struct Horizontal {
    k: f64,
    c: f64,
    mu: f64,
    ratio: f64,
}

/// The largest error of the momentum about the new foot that the horizontal units may cause; an
/// A-frame's old foot is pressed while they lag, a block's lifts at once. A share of 1e-3 of e is
/// worth 1 to 2 % of a history.
const MOMENTUM: f64 = 2e-6;

const HORIZONTAL: Horizontal = Horizontal { k: 1.0, c: 2.0, mu: 0.3, ratio: 4.0 };

/// x to nine significant digits: structures that share them have the same springs to the last bit.
fn nine_digits(x: f64) -> f64 {
    // a number that was printed can be read
    format!("{x:.8e}").parse().unwrap_or(x)
}

/// The springs that the geometry of a body gives at an Omega_n/p.
pub fn springs_at_stiffness(body: &Body<f64>, stiffness: f64) -> Option<Springs<Design<f64>>> {
    let mut springs = Geometry::of(body, stiffness).ok()?.springs();
    let hz = stiffness * body.p() / TAU;
    springs.vertical.omega_n_hz *= hz;
    springs.horizontal.omega_n_hz *= hz;
    Some(springs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_geometries_have_equal_springs_and_bad_ones_are_refused() {
        let at = |alpha| Geometry::new(alpha, 0.75, 2e4).unwrap().springs();
        assert_eq!(at(0.2), at(0.2 + 1e-11));
        assert_ne!(at(0.2), at(0.2 + 1e-8));
        assert_eq!(Geometry::new(1.0, 0.75, 2e4), Err(GeometryError::Alpha(1.0)));
        assert!(
            Geometry::new(0.2, 0.0, 2e4).is_err() && Geometry::new(0.2, 0.75, f64::NAN).is_err()
        );
    }
}
