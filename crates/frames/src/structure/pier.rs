//! A mass on an elastic column on a rigid footing.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{
    AXIAL, BENDING, ElasticError, FREQUENCY, LENGTH, MASS, SHEAR_SHARE, block_inertia,
    cantilever_carries, check_elements, damping, elements, has_column, not_negative, positive,
    slender,
};
use rocking::{scalar::GRAVITY, structure::Body};

/// Young's modulus that a column is taken to have whose EA is not given: concrete's [N/m2].
pub(crate) const CONCRETE: f64 = 30e9;
/// Share of a cantilever's mass that moves with its tip (Rayleigh).
const RAYLEIGH: f64 = 33.0 / 140.0;

/// A pier. Its mass is at height `height_m` above the soles, on a column that stands on the
/// footing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PierSpec {
    /// Height of the mass above the soles (m).
    pub height_m: f64,
    /// Distance 2b between the footing's corners (m).
    pub width_m: f64,
    /// Mass at the top (kg).
    pub mass_kg: f64,
    /// Mass of the footing (kg).
    pub footing_mass_kg: f64,
    /// Height of the footing; its centre of mass is half way up (m).
    pub footing_height_m: f64,
    /// Rotational inertia of the footing about its centre of mass; of a solid block unless given
    /// (kg m2).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub footing_inertia_kgm2: Option<f64>,
    /// Axial stiffness times length, EA; that of a solid square concrete column (E = 30 GPa) of the
    /// same EI unless given (N).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ea_n: Option<f64>,
    /// Shear stiffness GA_s; of a column with a mass of its own that of a solid concrete section of
    /// this EA unless given, of others infinite (N).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ga_n: Option<f64>,
    /// Bending stiffness EI (N m2).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ei_nm2: Option<f64>,
    /// Instead of EI: frequency of the pier fixed to the ground, across, under its weight (Hz).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Ratio to critical damping of the pier fixed to the ground, across.
    pub damping_ratio: f64,
    /// The same along the column; as across unless given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial_damping_ratio: Option<f64>,
    /// Mass of the column, spread over it (kg).
    #[serde(default)]
    pub column_mass_kg: f64,
    /// Beam elements to the column: one without a mass of its own, four with it unless given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements: Option<usize>,
}

impl PierSpec {
    pub(super) fn check(&self) -> Result<(), ElasticError> {
        for (name, value, range) in [
            ("height_m", self.height_m, LENGTH),
            ("width_m", self.width_m, LENGTH),
            ("mass_kg", self.mass_kg, MASS),
            ("footing_mass_kg", self.footing_mass_kg, MASS),
            ("footing_height_m", self.footing_height_m, LENGTH),
        ] {
            positive(name, value, range)?;
        }
        for (name, value, range) in [
            ("footing_inertia_kgm2", self.footing_inertia_kgm2, (1e-15, 1e20)),
            ("ea_n", self.ea_n, AXIAL),
            ("ga_n", self.ga_n, AXIAL),
            ("ei_nm2", self.ei_nm2, BENDING),
            ("frequency_hz", self.frequency_hz, FREQUENCY),
        ] {
            value.map_or(Ok(()), |value| positive(name, value, range))?;
        }
        not_negative("column_mass_kg", self.column_mass_kg, MASS.1)?;
        damping("damping_ratio", self.damping_ratio)?;
        damping("axial_damping_ratio", self.axial_damping_ratio())?;
        if self.ei_nm2.is_some() == self.frequency_hz.is_some() {
            return Err(ElasticError::Bending { both: self.ei_nm2.is_some() });
        }
        has_column(self.footing_height_m, self.height_m)?;
        if !(self.ei() > 0.0 && self.ei() <= BENDING.1) {
            return Err(ElasticError::Shear { ga: self.ga() });
        }
        check_elements(self.elements(), self.column_mass_kg)?;
        slender(self.body().alpha())?;
        self.carries(0.0)
    }

    /// Whether the column carries the weight and a tendon's tension (N).
    pub(super) fn carries(&self, tension: f64) -> Result<(), ElasticError> {
        let column = [self.ei(), self.ea(), self.length()];
        cantilever_carries("the column", column, self.load(), tension)
    }

    /// Length of the column, from the footing's top to the mass (m).
    pub fn length(&self) -> f64 {
        self.height_m - self.footing_height_m
    }

    /// Rotational inertia of the footing about its centre of mass (kg m2).
    pub fn footing_inertia(&self) -> f64 {
        let block = block_inertia(self.footing_mass_kg, self.width_m, self.footing_height_m);
        self.footing_inertia_kgm2.unwrap_or(block)
    }

    /// EI (N m2): by the frequency, that of one corotational element between footing and mass,
    /// whose weight takes P/L of its stiffness k = 1/(L^3/(3 EI) + L/GA_s).
    pub fn ei(&self) -> f64 {
        let (mass, length) = (self.moving_mass(), self.length());
        let by_frequency = |f: f64| {
            let needed = mass * (TAU * f).powi(2) + self.load() / length;
            let rigid_in_shear = needed * length.powi(3) / 3.0;
            // GA_s is a share of EA, which is in turn c sqrt(EI) of a square section unless given:
            // L^3/3 u^2 + L/c u = 1/k, u = EI^(-1/2)
            match (self.ga_n, self.ea_n) {
                (None, _) if self.column_mass_kg == 0.0 => rigid_in_shear,
                (None, None) => {
                    let c = SHEAR_SHARE * (12.0 * CONCRETE).sqrt();
                    let (a, b) = (length.powi(3) / 3.0, length / c);
                    ((b + (b * b + 4.0 * a / needed).sqrt()) * needed / 2.0).powi(2)
                }
                (Some(ga), _) => rigid_in_shear / (1.0 - needed * length / ga),
                (None, Some(ea)) => rigid_in_shear / (1.0 - needed * length / (SHEAR_SHARE * ea)),
            }
        };
        self.ei_nm2.or(self.frequency_hz.map(by_frequency)).unwrap_or(f64::NAN)
    }

    /// GA_s (N): as given; of a column with a mass of its own a share of EA; infinite otherwise, as
    /// before there are waves to bound.
    pub fn ga(&self) -> f64 {
        self.ga_n.unwrap_or_else(|| {
            if self.column_mass_kg > 0.0 { SHEAR_SHARE * self.ea() } else { f64::INFINITY }
        })
    }

    /// By how much shear makes the column softer across: 3 EI/(GA_s L^2).
    pub(super) fn shear_flexibility(&self) -> f64 {
        3.0 * self.ei() / (self.ga() * self.length().powi(2))
    }

    /// EA (N): as given, or that of a solid square section of side a with E = 30 GPa: EI = E
    /// a^4/12, EA = E a^2.
    pub fn ea(&self) -> f64 {
        self.ea_n.unwrap_or_else(|| (12.0 * CONCRETE * self.ei()).sqrt())
    }

    /// Ratio to critical damping along the column.
    pub fn axial_damping_ratio(&self) -> f64 {
        self.axial_damping_ratio.unwrap_or(self.damping_ratio)
    }

    /// Beam elements to the column.
    pub fn elements(&self) -> usize {
        elements(self.elements, self.column_mass_kg)
    }

    /// Mass that moves with the top (kg).
    pub(crate) fn moving_mass(&self) -> f64 {
        self.mass_kg + RAYLEIGH * self.column_mass_kg
    }

    /// Axial force at mid-height of the column under the weight (N).
    fn load(&self) -> f64 {
        (self.mass_kg + 0.5 * self.column_mass_kg) * GRAVITY
    }

    pub(super) fn frequency(&self) -> f64 {
        let length = self.length();
        let stiffness = 3.0 * self.ei() / length.powi(3) / (1.0 + self.shear_flexibility())
            - self.load() / length;
        (stiffness / self.moving_mass()).max(0.0).sqrt() / TAU
    }

    pub(super) fn shortening(&self) -> f64 {
        self.load() / self.ea()
    }

    pub(super) fn body(&self) -> Body<f64> {
        let parts = [
            (self.mass_kg, self.height_m, 0.0),
            (self.footing_mass_kg, 0.5 * self.footing_height_m, self.footing_inertia()),
            (
                self.column_mass_kg,
                self.height_m - 0.5 * self.length(),
                self.column_mass_kg * self.length().powi(2) / 12.0,
            ),
        ];
        super::aframe::together(&parts, 0.5 * self.width_m)
    }
}
