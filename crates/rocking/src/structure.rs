//! The rocking structure: a rigid body on two feet.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::scalar::{GRAVITY, Scalar, real};

/// What the body is made of; it decides the default rotational inertia.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// All mass at the apex of two massless legs: I_cg = 0 unless given.
    AFrame,
    /// A solid rectangular block: I_cg = m R^2 / 3 unless given.
    Block,
}

/// A rigid body of mass m on two feet, 2b apart, its centre of mass at height h above them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Structure {
    /// A-frame or block.
    pub kind: Kind,
    /// Height h of the centre of mass above the feet (m). A solid block of height H has h = H/2.
    pub height_m: f64,
    /// Distance 2b between the feet (m).
    pub width_m: f64,
    /// Mass m (the paper's m1) (kg).
    pub mass_kg: f64,
    /// Rotational inertia I_cg about the centre of mass (kg m2).
    pub rotational_inertia_kgm2: f64,
}

/// I_cg of an A-frame with all mass at its apex, as a share of m R^2: OpenSees and its like need
/// some, and rocking does not feel so little (1e-5 of p^2).
pub const LEAST_INERTIA: f64 = 1e-5;

/// Lengths that a structure may have, a grain of sand to beyond any tower (m).
const LENGTH_M: (f64, f64) = (1e-4, 1e5);
/// Masses that it may have (kg).
const MASS_KG: (f64, f64) = (1e-9, 1e15);

/// What is wrong with a structure, and what to do.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum StructureError {
    #[error("structure: {name} is {value:?}; give a finite number greater than zero")]
    NotPositive { name: &'static str, value: f64 },
    #[error("structure: {name} is {value:?}; give one between {least:e} and {most:e} (in m, kg)")]
    Absurd { name: &'static str, value: f64, least: f64, most: f64 },
    #[error(
        "structure: rotational_inertia_kgm2 is {value:?}; give a finite number, zero or greater"
    )]
    Inertia { value: f64 },
    #[error(
        "structure: rotational_inertia_kgm2 is {value:?}; a block of this size has at most \
         {most:.4} kg m2, with all its mass at its corners: give it about the centre of mass and \
         in kg m2, or leave it out for a solid block ({solid:.4})",
        solid = .most / 3.0
    )]
    BeyondCorners { value: f64, most: f64 },
    #[error(
        "structure: slenderness alpha = atan(width/(2 height)) is {alpha:.4} rad; rocking needs a \
         body between 0.005 and 0.9 rad: check width_m and height_m (of the \
         centre of mass) or total_height_m"
    )]
    Slenderness { alpha: f64 },
    #[error(
        "structure: restitution by equation 2 is {restitution:.3}, not between 0 and 1: the body \
         is too stocky to rock; check height_m, width_m and rotational_inertia_kgm2"
    )]
    TooStocky { restitution: f64 },
}

impl Structure {
    /// A checked A-frame with its mass (kg) at the apex, `height_m` above its feet, which stand
    /// `width_m` apart. It has no rotational inertia.
    ///
    /// # Errors
    /// As [`Self::checked`].
    pub fn a_frame(height_m: f64, width_m: f64, mass_kg: f64) -> Result<Self, StructureError> {
        Self { kind: Kind::AFrame, height_m, width_m, mass_kg, rotational_inertia_kgm2: 0.0 }
            .checked()
    }

    /// A checked solid block, `height_m` its whole height H (so h = H/2), `width_m` its whole
    /// width.
    ///
    /// # Errors
    /// As [`Self::checked`].
    pub fn block(height_m: f64, width_m: f64, mass_kg: f64) -> Result<Self, StructureError> {
        Self {
            kind: Kind::Block,
            height_m: height_m / 2.0,
            width_m,
            mass_kg,
            rotational_inertia_kgm2: mass_kg * (height_m.powi(2) + width_m.powi(2)) / 12.0,
        }
        .checked()
    }

    /// The paper's model structure: 61 m A-frame, feet 12.2 m apart, 680.1 t at the apex.
    pub fn paper() -> Self {
        Self {
            kind: Kind::AFrame,
            height_m: 61.0,
            width_m: 12.2,
            mass_kg: 680.1e3,
            rotational_inertia_kgm2: 0.0,
        }
    }

    /// The structure itself if its numbers can rock.
    ///
    /// # Errors
    /// A height, width or mass that is not above zero, or is beyond any structure's; an inertia
    /// below zero, or above what a block can have; a slenderness alpha that is not within 0.005 to
    /// 0.9 rad; a restitution by equation 2 that is not between 0 and 1.
    pub fn checked(self) -> Result<Self, StructureError> {
        for (name, value, (least, most)) in [
            ("height_m", self.height_m, LENGTH_M),
            ("width_m", self.width_m, LENGTH_M),
            ("mass_kg", self.mass_kg, MASS_KG),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(StructureError::NotPositive { name, value });
            }
            if !(least..=most).contains(&value) {
                return Err(StructureError::Absurd { name, value, least, most });
            }
        }
        let value = self.rotational_inertia_kgm2;
        if !(value.is_finite() && value >= 0.0) {
            return Err(StructureError::Inertia { value });
        }
        let body = self.body::<f64>();
        // m R^2: within the outline of a block, 2h by 2b, that of all mass at its corners
        let most = body.mass * (body.half_width.powi(2) + body.height.powi(2));
        if self.kind == Kind::Block && value > most * (1.0 + 1e-9) {
            return Err(StructureError::BeyondCorners { value, most });
        }
        let alpha = body.alpha();
        if !(0.005..=0.9).contains(&alpha) {
            return Err(StructureError::Slenderness { alpha });
        }
        let restitution = body.restitution();
        if !(restitution > 0.0 && restitution < 1.0) {
            return Err(StructureError::TooStocky { restitution });
        }
        Ok(self)
    }

    /// The body's numbers as scalars, to compute or to differentiate with.
    pub fn body<S: Scalar>(&self) -> Body<S> {
        Body {
            mass: real(self.mass_kg),
            half_width: real(self.width_m / 2.0),
            height: real(self.height_m),
            inertia: real(self.rotational_inertia_kgm2),
        }
    }
}

/// The body in the paper's letters: m, b, h, I_cg, and what follows from them.
#[derive(Clone, Copy, Debug)]
pub struct Body<S> {
    /// m (kg).
    pub mass: S,
    /// b, half the distance between the feet (m).
    pub half_width: S,
    /// h, height of the centre of mass (m).
    pub height: S,
    /// I_cg, about the centre of mass (kg m2).
    pub inertia: S,
}

impl<S: Scalar> Body<S> {
    /// R = hypot(b, h), from a foot to the centre of mass (m).
    pub fn radius(&self) -> S {
        (self.half_width * self.half_width + self.height * self.height).sqrt()
    }

    /// alpha = atan(b/h), the lean at which the body stands in balance on one foot (rad).
    pub fn alpha(&self) -> S {
        self.half_width.atan2(self.height)
    }

    /// Horizontal force on the mass that lifts the body, m g tan(alpha) (N).
    pub fn lifting_force(&self) -> S {
        self.mass * real::<S>(GRAVITY) * self.half_width / self.height
    }

    /// m R^2 / I0, with I0 = I_cg + m R^2: 1 for an A-frame, 3/4 for a solid block.
    pub fn mass_share(&self) -> S {
        let r = self.radius();
        let m_r2 = self.mass * r * r;
        m_r2 / (self.inertia + m_r2)
    }

    /// Frequency parameter p (1/s).
    pub fn p(&self) -> S {
        self.p_squared().sqrt()
    }

    /// p^2 = m g R / I0 [1/s2].
    pub fn p_squared(&self) -> S {
        self.mass_share() * real::<S>(GRAVITY) / self.radius()
    }

    /// Velocity restitution e = sqrt(r) = 1 - (m R^2/I0)(1 - cos 2 alpha), equations (2) and (4).
    pub fn restitution(&self) -> S {
        let sin = self.half_width / self.radius();
        S::one() - self.mass_share() * real::<S>(2.0) * sin * sin
    }

    /// Horizontal displacement u of the centre of mass when the rigid body leans by theta (m).
    pub fn u(&self, theta: S) -> S {
        // R sin(alpha) s - R sin(alpha s - theta), written without cancellation near theta = 0
        let s: S = real(if theta.re() < 0.0 { -1.0 } else { 1.0 });
        let half = theta * real::<S>(0.5);
        self.half_width * s * real::<S>(2.0) * half.sin() * half.sin() + self.height * theta.sin()
    }

    /// Vertical displacement v of the centre of mass when the rigid body leans by theta (m).
    pub fn v(&self, theta: S) -> S {
        // R cos(alpha s - theta) - R cos(alpha)
        let s: S = real(if theta.re() < 0.0 { -1.0 } else { 1.0 });
        let half = theta * real::<S>(0.5);
        self.half_width * s * theta.sin() - self.height * real::<S>(2.0) * half.sin() * half.sin()
    }

    /// Kinetic energy with which the body lands that fell from rest at theta, m g v (J).
    pub fn fall(&self, theta: S) -> S {
        self.mass * self.v(theta) * real::<S>(GRAVITY)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn restitution_of_the_a_frame_is_cos_two_alpha() {
        let body = Structure::paper().body::<f64>();
        assert_relative_eq!(body.restitution(), (2.0 * body.alpha()).cos(), epsilon = 1e-15);
        assert_relative_eq!(body.p_squared(), GRAVITY / body.radius(), epsilon = 1e-15);
    }

    #[test]
    fn a_solid_block_has_four_thirds_of_m_r_squared() {
        let body = Structure::block(2.0, 0.5, 100.0).unwrap().body::<f64>();
        assert_relative_eq!(body.mass_share(), 0.75, epsilon = 1e-15);
    }

    /// Four masses of m/4 at the corners of a block: I_cg = m (b^2 + h^2), by Steiner.
    #[test]
    fn no_block_has_more_inertia_than_with_its_mass_at_its_corners() {
        let (b, h, quarter) = (0.25, 1.0, 25.0);
        let corners = [(-b, -h), (b, -h), (b, h), (-b, h)];
        let most: f64 = corners.map(|(x, y): (f64, f64)| quarter * (x * x + y * y)).iter().sum();
        let block = Structure::block(2.0 * h, 2.0 * b, 4.0 * quarter).unwrap();
        let with = |inertia| Structure { rotational_inertia_kgm2: inertia, ..block }.checked();
        assert!(with(most).is_ok());
        let refused = with(1.001 * most).unwrap_err();
        assert_eq!(refused, StructureError::BeyondCorners { value: 1.001 * most, most });
        assert!(refused.to_string().contains("at most 106.2500 kg m2"), "{refused}");
        // masses on legs reach beyond their feet
        let kind = Kind::AFrame;
        assert!(Structure { kind, rotational_inertia_kgm2: 2.0 * most, ..block }.checked().is_ok());
    }

    #[test]
    fn displacements_are_those_of_a_rotation_about_the_foot() {
        let body = Structure::paper().body::<f64>();
        let (r, a) = (body.radius(), body.alpha());
        for theta in [-0.05_f64, -1e-3, 0.0, 0.02, 0.3] {
            let s = if theta < 0.0 { -1.0 } else { 1.0 };
            assert_relative_eq!(
                body.u(theta),
                r * (a.sin() * s - (a * s - theta).sin()),
                epsilon = 1e-12
            );
            assert_relative_eq!(
                body.v(theta),
                r * ((a * s - theta).cos() - a.cos()),
                epsilon = 1e-12
            );
            // E = m g R (cos(alpha - |theta|) - cos(alpha)): what equation 1's free motion keeps
            let energy = body.mass * GRAVITY * r * ((a - theta.abs()).cos() - a.cos());
            assert_relative_eq!(body.fall(theta), energy, max_relative = 1e-9, epsilon = 1e-3);
        }
    }
}
