//! The spring-absorber units under a corner of an elastic structure, as they stand in the file.

use dynamics::spring::{Chain, Springs};
use serde::{Deserialize, Serialize};

/// A spring-absorber unit as it stands in the file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnitRow {
    /// Gap spring k1 (N/m).
    pub k1_n_per_m: f64,
    /// Spring k2 under the absorber (N/m).
    pub k2_n_per_m: f64,
    /// Absorber's mass m2 (kg).
    pub m2_kg: f64,
    /// Dashpot c beside k2 (N s/m).
    pub c_ns_per_m: f64,
}

impl From<&Chain> for UnitRow {
    fn from(chain: &Chain) -> Self {
        Self { k1_n_per_m: chain.k1, k2_n_per_m: chain.k2, m2_kg: chain.m2, c_ns_per_m: chain.c }
    }
}

impl UnitRow {
    /// k1, k2, m2, c.
    pub fn numbers(&self) -> [f64; 4] {
        [self.k1_n_per_m, self.k2_n_per_m, self.m2_kg, self.c_ns_per_m]
    }

    fn chain(&self) -> Chain {
        Chain { k1: self.k1_n_per_m, k2: self.k2_n_per_m, m2: self.m2_kg, c: self.c_ns_per_m }
    }

    pub(crate) fn good(&self) -> bool {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        positive(self.k1_n_per_m)
            && positive(self.k2_n_per_m)
            && positive(self.m2_kg)
            && self.c_ns_per_m.is_finite()
            && self.c_ns_per_m >= 0.0
    }
}

/// The units under a corner.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CornerRow {
    /// Where it stands, from the structure's middle (m).
    pub x_m: f64,
    /// The vertical unit.
    pub vertical: UnitRow,
    /// The horizontal unit.
    pub horizontal: UnitRow,
}

impl CornerRow {
    /// The units with their numbers.
    pub fn chains(&self) -> Springs<Chain> {
        Springs { vertical: self.vertical.chain(), horizontal: self.horizontal.chain() }
    }
}
