//! Two columns on two footings under a beam.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{
    AXIAL, BENDING, ElasticError, LENGTH, MASS, SHEAR_SHARE, aframe::together, block_inertia,
    cantilever_carries, check_elements, damping, elements, has_column, not_negative, positive,
    slender,
};
use rocking::{scalar::GRAVITY, structure::Body};

/// A plane portal frame, symmetric.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PortalSpec {
    /// Height of the beam's axis above the soles (m).
    pub height_m: f64,
    /// Distance between the columns' axes (m).
    pub span_m: f64,
    /// Distance 2b between the corners of each footing (m).
    pub footing_width_m: f64,
    /// Height of each footing; its centre of mass is half way up (m).
    pub footing_height_m: f64,
    /// Mass of each footing, a solid block (kg).
    pub footing_mass_kg: f64,
    /// Mass of the beam and what it carries, half of it at each column's top (kg).
    pub beam_mass_kg: f64,
    /// Axial stiffness times length of a column, EA (N).
    pub column_ea_n: f64,
    /// Bending stiffness of a column, EI (N m2).
    pub column_ei_nm2: f64,
    /// Shear stiffness GA_s of a column; of columns with a mass of their own that of a solid
    /// concrete section of this EA unless given, of others infinite (N).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column_ga_n: Option<f64>,
    /// Axial stiffness times length of the beam (N).
    pub beam_ea_n: f64,
    /// Bending stiffness of the beam (N m2).
    pub beam_ei_nm2: f64,
    /// Ratio to critical damping of the frame fixed to the ground, across.
    pub damping_ratio: f64,
    /// Mass of each column, spread over it (kg).
    #[serde(default)]
    pub column_mass_kg: f64,
    /// Beam elements to each column: one without a mass of its own, four with it unless given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements: Option<usize>,
}

impl PortalSpec {
    pub(super) fn check(&self) -> Result<(), ElasticError> {
        for (name, value, range) in [
            ("height_m", self.height_m, LENGTH),
            ("span_m", self.span_m, LENGTH),
            ("footing_width_m", self.footing_width_m, LENGTH),
            ("footing_height_m", self.footing_height_m, LENGTH),
            ("footing_mass_kg", self.footing_mass_kg, MASS),
            ("beam_mass_kg", self.beam_mass_kg, MASS),
            ("column_ea_n", self.column_ea_n, AXIAL),
            ("column_ei_nm2", self.column_ei_nm2, BENDING),
            ("column_ga_n", self.column_ga_n.unwrap_or(1.0), AXIAL),
            ("beam_ea_n", self.beam_ea_n, AXIAL),
            ("beam_ei_nm2", self.beam_ei_nm2, BENDING),
        ] {
            positive(name, value, range)?;
        }
        not_negative("column_mass_kg", self.column_mass_kg, MASS.1)?;
        damping("damping_ratio", self.damping_ratio)?;
        has_column(self.footing_height_m, self.height_m)?;
        if self.footing_width_m > self.span_m {
            return Err(ElasticError::Overlap { width: self.footing_width_m, span: self.span_m });
        }
        check_elements(self.elements(), self.column_mass_kg)?;
        slender(self.body().alpha())?;
        self.carries(0.0)
    }

    /// Whether each column carries its weight and its tendon's tension (N).
    pub(super) fn carries(&self, tension: f64) -> Result<(), ElasticError> {
        // free to sway, as in flight: on the safe side of the portal's critical load
        let column = [self.column_ei_nm2, self.column_ea_n, self.length()];
        cantilever_carries("a column", column, self.load(), tension)
    }

    /// Length of a column, from the footing's top to the beam's axis (m).
    pub(crate) fn length(&self) -> f64 {
        self.height_m - self.footing_height_m
    }

    /// Rotational inertia of a footing about its centre of mass (kg m2).
    pub(crate) fn footing_inertia(&self) -> f64 {
        block_inertia(self.footing_mass_kg, self.footing_width_m, self.footing_height_m)
    }

    /// GA_s of a column (N): as given; of columns with a mass of their own a share of EA; infinite
    /// otherwise.
    pub fn column_ga(&self) -> f64 {
        let unless_given =
            if self.column_mass_kg > 0.0 { SHEAR_SHARE * self.column_ea_n } else { f64::INFINITY };
        self.column_ga_n.unwrap_or(unless_given)
    }

    /// Mass at a column's top (kg), and its rotational inertia (kg m2): m span^2/420 of the beam's
    /// mass m, the share of either end where a beam bends in an S, as one does when a frame sways
    /// (Przemieniecki, *Theory of Matrix Structural Analysis*, table 11.1: both ends turn alike).
    pub(crate) fn top(&self) -> (f64, f64) {
        (0.5 * self.beam_mass_kg, self.beam_mass_kg * self.span_m.powi(2) / 420.0)
    }

    /// Beam elements to a column.
    pub fn elements(&self) -> usize {
        elements(self.elements, self.column_mass_kg)
    }

    /// Axial force at mid-height of a column under the weight (N).
    fn load(&self) -> f64 {
        0.5 * (self.beam_mass_kg + self.column_mass_kg) * GRAVITY
    }

    /// Clamped columns under an elastic beam: 24 EI/L^3 (1 + 6 g)/(4 + 6 g), g =
    /// (EI_b/span)/(EI/L), in series with their shear, 2 GA_s/L, less the weight's P/L of both.
    pub(super) fn frequency(&self) -> f64 {
        let length = self.length();
        let g = self.beam_ei_nm2 / self.span_m / (self.column_ei_nm2 / length);
        let stiffness =
            24.0 * self.column_ei_nm2 / length.powi(3) * (1.0 + 6.0 * g) / (4.0 + 6.0 * g);
        let stiffness = stiffness / (1.0 + stiffness * length / (2.0 * self.column_ga()));
        // 13/35 of a column that is clamped at both ends moves with its top
        let mass = self.beam_mass_kg + 2.0 * 13.0 / 35.0 * self.column_mass_kg;
        ((stiffness - 2.0 * self.load() / length) / mass).max(0.0).sqrt() / TAU
    }

    pub(super) fn shortening(&self) -> f64 {
        self.load() / self.column_ea_n
    }

    /// One column's share: its footing, itself, half of the beam, which does not turn with it.
    pub(super) fn body(&self) -> Body<f64> {
        let parts = [
            (0.5 * self.beam_mass_kg, self.height_m, 0.0),
            (self.footing_mass_kg, 0.5 * self.footing_height_m, self.footing_inertia()),
            (
                self.column_mass_kg,
                self.height_m - 0.5 * self.length(),
                self.column_mass_kg * self.length().powi(2) / 12.0,
            ),
        ];
        together(&parts, 0.5 * self.footing_width_m)
    }
}
