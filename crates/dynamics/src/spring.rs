//! Ground springs: dimensionless (mu, f, xi, Omega_n) and dimensional (k1, k2, m2, c).
//!
//! ```text
//!  foot ─ gap, k1 ─ m2 ─┬─ k2 ─┬─ ground      mu = m2/m1        Omega_n^2 = k1/m1
//!                       └─ c  ─┘              f = omega_a/Omega_n,  omega_a^2 = k2/m2
//!                                             xi = c/c_c,     c_c = 2 m2 Omega_n
//! ```
//!
//! So k2 = mu f^2 k1 and c = 2 xi mu m1 Omega_n (theory after equations 5 to 7).

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use rocking::scalar::{Scalar, real};

mod table_1;

/// One chain without units, and its frequency: what the tuner searches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Design<S> {
    /// Mass ratio mu = m2/m1.
    pub mu: S,
    /// Frequency ratio f = omega_a/Omega_n.
    pub f: S,
    /// Damping ratio xi = c/c_c.
    pub xi: S,
    /// Omega_n / 2 pi (Hz).
    pub omega_n_hz: S,
}

impl<S: Scalar> Design<S> {
    /// From the stiffness ratio K = k2/k1 = mu f^2 and the damping number C = c/(m1 Omega_n) = 2 mu
    /// xi.
    pub fn from_kc(mu: S, k: S, c: S, omega_n_hz: S) -> Self {
        Self { mu, f: (k / mu).sqrt(), xi: c / (mu * real::<S>(2.0)), omega_n_hz }
    }

    /// K = k2/k1 = mu f^2.
    pub fn k(&self) -> S {
        self.mu * self.f * self.f
    }

    /// C = c/(m1 Omega_n) = 2 mu xi.
    pub fn c(&self) -> S {
        self.mu * self.xi * real::<S>(2.0)
    }
}

impl Design<f64> {
    /// The chain for a mass m1 (kg).
    pub fn chain(&self, m1: f64) -> Chain {
        let omega_n = self.omega_n_hz * TAU;
        let k1 = m1 * omega_n * omega_n;
        Chain { k1, k2: self.k() * k1, m2: self.mu * m1, c: self.c() * m1 * omega_n }
    }
}

/// One chain with units: foot - gap k1 - m2 - (k2 parallel c) - ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chain {
    /// Gap spring k1 (N/m).
    pub k1: f64,
    /// Ground spring k2 (N/m).
    pub k2: f64,
    /// Absorber mass m2 (kg).
    pub m2: f64,
    /// Dashpot c (N s/m).
    pub c: f64,
}

impl Chain {
    /// Stiffness of both springs, one after the other (N/m).
    pub fn in_series(&self) -> f64 {
        self.k1 * self.k2 / (self.k1 + self.k2)
    }

    /// The dimensionless design of this chain under a mass m1 (kg).
    pub fn design(&self, m1: f64) -> Design<f64> {
        let omega_n = (self.k1 / m1).sqrt();
        let mu = self.m2 / m1;
        Design {
            mu,
            f: (self.k2 / self.m2).sqrt() / omega_n,
            xi: self.c / (self.m2 * omega_n * 2.0),
            omega_n_hz: omega_n / TAU,
        }
    }
}

/// The springs under each of the two feet: a vertical and a horizontal chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Springs<T> {
    /// The vertical unit.
    pub vertical: T,
    /// The horizontal unit.
    pub horizontal: T,
}

impl Springs<Design<f64>> {
    /// Both chains for a mass m1 (kg).
    pub fn chains(&self, m1: f64) -> Springs<Chain> {
        Springs { vertical: self.vertical.chain(m1), horizontal: self.horizontal.chain(m1) }
    }

    /// Settlement of the body standing on both feet, each carrying m1 g/2 on k1 and k2 in series
    /// (m).
    pub fn settlement(&self, m1: f64) -> f64 {
        let chain = self.vertical.chain(m1);
        m1 * (0.5 * rocking::scalar::GRAVITY) * (chain.k1.recip() + chain.k2.recip())
    }
}

/// A chain as it stands in `parameters.json`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChainRow {
    /// Mass ratio m2/m1.
    pub mu: f64,
    /// Frequency ratio omega_a/Omega_n.
    pub f: f64,
    /// Damping ratio c/(2 m2 Omega_n).
    pub xi: f64,
    /// Omega_n / 2 pi (Hz).
    pub omega_n_hz: f64,
    /// Gap spring k1 (N/m).
    pub k1_n_per_m: f64,
    /// Spring k2 under the absorber (N/m).
    pub k2_n_per_m: f64,
    /// Absorber's mass m2 (kg).
    pub m2_kg: f64,
    /// Dashpot c beside k2 (N s/m).
    pub c_ns_per_m: f64,
}

impl ChainRow {
    /// The row of a design under a mass m1 (kg).
    pub fn new(design: &Design<f64>, m1: f64) -> Self {
        let chain = design.chain(m1);
        Self {
            mu: design.mu,
            f: design.f,
            xi: design.xi,
            omega_n_hz: design.omega_n_hz,
            k1_n_per_m: chain.k1,
            k2_n_per_m: chain.k2,
            m2_kg: chain.m2,
            c_ns_per_m: chain.c,
        }
    }

    /// The chain with units, from k1, k2, m2 and c; mu, f, xi and Omega_n are there to read and
    /// change nothing.
    pub fn chain(&self) -> Chain {
        Chain { k1: self.k1_n_per_m, k2: self.k2_n_per_m, m2: self.m2_kg, c: self.c_ns_per_m }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn designs_and_chains_convert_back_and_forth() {
        let design = Design { mu: 0.3, f: 0.7, xi: 1.3, omega_n_hz: 80.0 };
        let back = design.chain(1234.5).design(1234.5);
        assert_relative_eq!(back.mu, design.mu, max_relative = 1e-14);
        assert_relative_eq!(back.f, design.f, max_relative = 1e-14);
        assert_relative_eq!(back.xi, design.xi, max_relative = 1e-14);
        assert_relative_eq!(back.omega_n_hz, design.omega_n_hz, max_relative = 1e-14);
    }

    /// g (1 + 1/K)/(2 Omega_n^2), whatever the mass.
    #[test]
    fn a_settlement_is_that_of_both_springs() {
        let chain = Design::from_kc(10.0, 9.3, 4.0, 6.2);
        let settlement = Springs { vertical: chain, horizontal: chain }.settlement(680.1e3);
        let omega_n = std::f64::consts::TAU * 6.2;
        let expected = 0.5 * rocking::scalar::GRAVITY * (1.0 + 1.0 / 9.3) / omega_n.powi(2);
        assert_relative_eq!(settlement, expected, max_relative = 1e-14);
    }
}
