//! Elastic structures as users give them: kinds, numbers in SI, and what no structure can be.
//!
//! ```text
//!   pier      m           aframe    m, I_cg        frame   m_b, beam EA EI
//!             |                    /\                     +-----------+
//!    EA, EI   |            EA, EI /  \ EA, EI     EA, EI  |           |  EA, EI
//!             |                  /    \                   |           |
//!          [=====] footing     m_f    m_f              [=====]     [=====]
//! ```
//!
//! | kind | what stands on the ground |
//! |---|---|
//! | `pier` | one rigid footing with two corners; a mass on an elastic column above it |
//! | `aframe` | two feet, a mass at each, under elastic legs that are clamped to the apex and hinged at the feet |
//! | `frame` | two rigid footings with two corners each, a column clamped to each, a beam clamped to both columns |

mod aframe;
mod layout;
mod members;
mod pier;
mod portal;

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use aframe::AFrameSpec;
pub use pier::PierSpec;
pub use portal::PortalSpec;
use rocking::{members::MembersError, structure::Body};

/// An elastic structure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum ElasticStructure {
    /// A mass on an elastic column on a rigid footing.
    Pier(PierSpec),
    /// A mass at the apex of two elastic legs, a mass at each foot.
    AFrame(AFrameSpec),
    /// Two columns on two footings under a beam.
    Frame(PortalSpec),
}

/// What is wrong with an elastic structure, and what to do.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum ElasticError {
    #[error("structure: {name} is {value:?}; give a finite number greater than zero")]
    NotPositive { name: &'static str, value: f64 },
    #[error("structure: {name} is {value:?}; give a finite number, zero or greater")]
    Negative { name: &'static str, value: f64 },
    #[error(
        "structure: {name} is {value:?}; give one between {least:e} and {most:e} (in m, kg, N, N \
         m2, Hz)"
    )]
    Absurd { name: &'static str, value: f64, least: f64, most: f64 },
    #[error(
        "structure: {name} is {value:?}; a ratio to critical damping lies between 0 and 0.5: 3 % \
            is 0.03"
    )]
    Damping { name: &'static str, value: f64 },
    #[error(
        "structure: {}",
        if *.both { "ei_nm2 and frequency_hz are both given; leave one out" }
        else { "give one of ei_nm2 and frequency_hz" }
    )]
    Bending { both: bool },
    #[error(
        "structure: footing_height_m is {footing:?} and height_m {height:?}; the column between \
         them must have a length"
    )]
    NoColumn { footing: f64, height: f64 },
    #[error(
        "structure: footing_width_m is {width:?} and span_m {span:?}; footings this wide would \
         overlap"
    )]
    Overlap { width: f64, span: f64 },
    #[error(
        "structure: slenderness atan(half the width/height of the centre of mass) is {alpha:.4} \
         rad; rocking needs 0.005 to 0.9 rad: check height_m, width_m and masses"
    )]
    Slenderness { alpha: f64 },
    #[error(
        "structure: the weight, and the tendon if there is one, shorten {member} by {share:.3} of \
         its length; give an ea_n in N of at least {least:.2e}"
    )]
    Shortens { member: &'static str, share: f64, least: f64 },
    #[error(
        "structure: {member} buckles under the weight, and the tendon if there is one, {load:.3e} \
         N over {critical:.3e} N; give it a larger EI (in N m2, not kN m2), or a pier a higher \
         frequency_hz"
    )]
    Buckles { member: &'static str, load: f64, critical: f64 },
    #[error(
        "structure: its column's shear stiffness, {ga:.3e} N, is too soft for the frequency asked \
         for; give a larger ga_n or ea_n (N), or a lower frequency_hz"
    )]
    Shear { ga: f64 },
    #[error(
        "structure: elements is {elements}; give 1 to 32 to a column, more than one only with \
         column_mass_kg"
    )]
    Elements { elements: usize },
    #[error(transparent)]
    Members(#[from] MembersError),
}

/// Ranges of what a structure may be made of: m, kg, N, N m2, Hz.
const LENGTH: (f64, f64) = (1e-3, 1e4);
const MASS: (f64, f64) = (1e-6, 1e12);
const AXIAL: (f64, f64) = (1e-3, 1e20);
const BENDING: (f64, f64) = (1e-9, 1e22);
const FREQUENCY: (f64, f64) = (1e-2, 1e4);
/// Largest share of its length by which the weight may shorten a member: beyond it no structure is.
const MOST_SHORTENING: f64 = 0.02;
/// GA_s over EA of a solid rectangular concrete section: kappa/(2 (1 + nu)) with kappa = 5/6 and nu
/// = 0.2.
pub(crate) const SHEAR_SHARE: f64 = SHEAR_FACTOR / (2.0 * (1.0 + POISSON));
/// Share of a rectangular section's area that shear acts on.
pub(crate) const SHEAR_FACTOR: f64 = 5.0 / 6.0;
/// Concrete's ratio of Poisson.
pub(crate) const POISSON: f64 = 0.2;
/// Elements to a column, and what it has unless said: one without a mass of its own, four with it.
const MOST_ELEMENTS: usize = 32;
const SOME_ELEMENTS: usize = 4;

impl ElasticStructure {
    /// The structure itself if its numbers can rock.
    ///
    /// # Errors
    /// A number that is not finite, of the wrong sign, or beyond any structure; a column that
    /// buckles under the weight.
    pub fn checked(self) -> Result<Self, ElasticError> {
        match &self {
            Self::Pier(pier) => pier.check()?,
            Self::AFrame(frame) => frame.check()?,
            Self::Frame(frame) => frame.check()?,
        }
        Ok(self)
    }

    /// The rigid body of the same masses: of a frame, one column's footing and its half of the
    /// beam, as they rock side by side.
    pub fn body(&self) -> Body<f64> {
        match self {
            Self::Pier(pier) => pier.body(),
            Self::AFrame(frame) => frame.body(),
            Self::Frame(frame) => frame.body(),
        }
    }

    /// All mass (kg).
    pub fn mass(&self) -> f64 {
        match self {
            Self::Frame(frame) => 2.0 * frame.body().mass,
            _ => self.body().mass,
        }
    }

    /// Frequency of the structure fixed to the ground, across, under its weight, in closed form
    /// (Hz).
    pub fn frequency_hz(&self) -> f64 {
        match self {
            Self::Pier(pier) => pier.frequency(),
            Self::AFrame(frame) => frame.frequency(),
            Self::Frame(frame) => frame.frequency(),
        }
    }

    /// Share of its length by which the weight shortens the column or leg.
    pub fn shortening(&self) -> f64 {
        match self {
            Self::Pier(pier) => pier.shortening(),
            Self::AFrame(frame) => frame.shortening(),
            Self::Frame(frame) => frame.shortening(),
        }
    }
}

/// A finite number above zero within a range.
fn positive(name: &'static str, value: f64, (least, most): (f64, f64)) -> Result<(), ElasticError> {
    if !(value.is_finite() && value > 0.0) {
        return Err(ElasticError::NotPositive { name, value });
    }
    if !(least..=most).contains(&value) {
        return Err(ElasticError::Absurd { name, value, least, most });
    }
    Ok(())
}

/// A finite number, zero or more, at most `most`.
fn not_negative(name: &'static str, value: f64, most: f64) -> Result<(), ElasticError> {
    if !(value.is_finite() && value >= 0.0) {
        return Err(ElasticError::Negative { name, value });
    }
    if value > most {
        return Err(ElasticError::Absurd { name, value, least: 0.0, most });
    }
    Ok(())
}

fn damping(name: &'static str, value: f64) -> Result<(), ElasticError> {
    if (0.0..=0.5).contains(&value) { Ok(()) } else { Err(ElasticError::Damping { name, value }) }
}

fn slender(alpha: f64) -> Result<(), ElasticError> {
    if (0.005..=0.9).contains(&alpha) { Ok(()) } else { Err(ElasticError::Slenderness { alpha }) }
}

/// How many elements a column has, as given or not.
fn elements(given: Option<usize>, column_mass: f64) -> usize {
    given.unwrap_or(if column_mass > 0.0 { SOME_ELEMENTS } else { 1 })
}

fn check_elements(elements: usize, column_mass: f64) -> Result<(), ElasticError> {
    // a node between elements needs a mass to move with
    let most = if column_mass > 0.0 { MOST_ELEMENTS } else { 1 };
    if (1..=most).contains(&elements) { Ok(()) } else { Err(ElasticError::Elements { elements }) }
}

fn shortens(member: &'static str, load: f64, ea: f64) -> Result<(), ElasticError> {
    let share = load / ea;
    if share <= MOST_SHORTENING {
        return Ok(());
    }
    Err(ElasticError::Shortens { member, share, least: load / MOST_SHORTENING })
}

/// A column that is free to sway, a cantilever, must carry its load (N) and a tendon's tension (N).
/// The tendon pulls towards the footing's middle, which takes four times as much of it as of a
/// weight to buckle.
fn cantilever_carries(
    member: &'static str,
    [ei, ea, length]: [f64; 3],
    load: f64,
    tension: f64,
) -> Result<(), ElasticError> {
    let critical = PI * PI * ei / (4.0 * length * length);
    stands(member, load + 0.25 * tension, critical)?;
    shortens(member, load + tension, ea)
}

/// There is a column between the footing and the top.
fn has_column(footing: f64, height: f64) -> Result<(), ElasticError> {
    if footing < 0.95 * height { Ok(()) } else { Err(ElasticError::NoColumn { footing, height }) }
}

/// Rotational inertia of a solid block about its centre (kg m2).
fn block_inertia(mass: f64, width: f64, height: f64) -> f64 {
    mass * (width.powi(2) + height.powi(2)) / 12.0
}

/// A column of this critical load (N) must carry this load.
fn stands(member: &'static str, load: f64, critical: f64) -> Result<(), ElasticError> {
    if load < critical { Ok(()) } else { Err(ElasticError::Buckles { member, load, critical }) }
}

#[cfg(test)]
mod tests;
