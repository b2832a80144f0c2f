//! A mass at the apex of two elastic legs, a mass at each foot.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use super::{
    AXIAL, BENDING, ElasticError, LENGTH, MASS, damping, not_negative, positive, shortens, slender,
    stands,
};
use rocking::{
    scalar::GRAVITY,
    structure::{Body, LEAST_INERTIA},
};

/// An A-frame with elastic legs, clamped to the apex and hinged at the feet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AFrameSpec {
    /// Height of the apex above the feet (m).
    pub height_m: f64,
    /// Distance 2b between the feet (m).
    pub width_m: f64,
    /// Mass at the apex (kg).
    pub mass_kg: f64,
    /// Rotational inertia of that mass; 1e-5 m R^2 unless given (kg m2).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotational_inertia_kgm2: Option<f64>,
    /// Axial stiffness times length of a leg, EA (N).
    pub ea_n: f64,
    /// Bending stiffness of a leg, EI (N m2).
    pub ei_nm2: f64,
    /// Mass at each foot (kg).
    pub foot_mass_kg: f64,
    /// Ratio to critical damping of the frame fixed to the ground, across.
    pub damping_ratio: f64,
}

impl AFrameSpec {
    pub(super) fn check(&self) -> Result<(), ElasticError> {
        for (name, value, range) in [
            ("height_m", self.height_m, LENGTH),
            ("width_m", self.width_m, LENGTH),
            ("mass_kg", self.mass_kg, MASS),
            ("ea_n", self.ea_n, AXIAL),
            ("ei_nm2", self.ei_nm2, BENDING),
            ("foot_mass_kg", self.foot_mass_kg, MASS),
        ] {
            positive(name, value, range)?;
        }
        not_negative("rotational_inertia_kgm2", self.inertia(), 1e20)?;
        damping("damping_ratio", self.damping_ratio)?;
        slender(self.body().alpha())?;
        self.carries(0.0)
    }

    /// Whether the legs carry the weight and a tendon's tension (N).
    pub(super) fn carries(&self, tension: f64) -> Result<(), ElasticError> {
        let critical = PI * PI * self.ei_nm2 / self.leg_length().powi(2);
        // leaning, the frame stands on one foot: a leg carries all
        stands("a leg", self.mass_kg * GRAVITY + tension, critical)?;
        shortens(
            "a leg",
            self.leg_load() + 0.5 * tension * self.leg_length() / self.height_m,
            self.ea_n,
        )
    }

    /// Length of a leg (m).
    pub fn leg_length(&self) -> f64 {
        self.height_m.hypot(0.5 * self.width_m)
    }

    /// Axial force in a leg under the weight (N).
    fn leg_load(&self) -> f64 {
        0.5 * self.mass_kg * GRAVITY * self.leg_length() / self.height_m
    }

    /// Rotational inertia of the mass at the apex (kg m2).
    pub fn inertia(&self) -> f64 {
        let least = LEAST_INERTIA * self.mass_kg * self.leg_length().powi(2);
        self.rotational_inertia_kgm2.unwrap_or(least)
    }

    /// Fixed to the ground the legs' axial stiffness holds the apex across, 2 EA/L (b/L)^2, less m
    /// g h/L^2 by the weight.
    pub(super) fn frequency(&self) -> f64 {
        let length = self.leg_length();
        let legs = 2.0 * self.ea_n / length * (0.5 * self.width_m / length).powi(2);
        let weight = self.mass_kg * GRAVITY * self.height_m / length.powi(2);
        ((legs - weight) / self.mass_kg).max(0.0).sqrt() / TAU
    }

    pub(super) fn shortening(&self) -> f64 {
        self.leg_load() / self.ea_n
    }

    pub(super) fn body(&self) -> Body<f64> {
        let b = 0.5 * self.width_m;
        // feet at the soles' height, b to both sides
        let feet = 2.0 * self.foot_mass_kg;
        together(&[(self.mass_kg, self.height_m, self.inertia()), (feet, 0.0, feet * b * b)], b)
    }
}

/// Rigid parts (kg, height of the centre in m, inertia about it in kg m2) as one body on feet
/// `half_width` from its middle.
pub(super) fn together(parts: &[(f64, f64, f64)], half_width: f64) -> Body<f64> {
    let mass: f64 = parts.iter().map(|part| part.0).sum();
    let height = parts.iter().map(|part| part.0 * part.1).sum::<f64>() / mass;
    let inertia = parts.iter().map(|(m, z, i)| i + m * (z - height).powi(2)).sum();
    Body { mass, half_width, height, inertia }
}
