//! What a structure may have besides a rigid body on ground springs: dampers, a tendon, friction.
//!
//! ```text
//!            mass m, I_cg                 damper   a dashpot c (N s/m) between the ground and each lower corner of the
//!              /|\                                 body, vertical, acting both ways
//!             / | \                       tendon   from the mass to the ground midway between the feet: stiffness (N/m),
//!            /  |  \                               tension of the standing, settled structure (N); slack it carries nothing
//!           / tendon\
//!     [c]  /    |    \  [c]
//!   springs     |    springs
//! ```
//!
//! The springs under the feet stay those of the rigid body.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::{scalar::GRAVITY, structure::Body};

/// What to say of a file with `legs`, which springs of a rigid body cannot carry.
pub const NO_LEGS: &str = "legs on springs of a rigid body are no more; give [structure] kind \
                           = \"aframe\" elastic legs of its own: \
                                  ea_n, ei_nm2, foot_mass_kg, damping_ratio (docs/elastic.md)";

/// Whether serde's message is about that key.
pub fn names_legs(message: &str) -> bool {
    message.starts_with("unknown field `legs`")
}

/// Dashpots across the rocking interface, one at each foot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Damper {
    /// Force over velocity (N s/m).
    #[serde(rename = "c_ns_per_m")]
    pub c: f64,
}

/// A post-tensioned tendon from the mass to the ground midway between the feet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tendon {
    /// Force over elongation (N/m).
    #[serde(rename = "stiffness_n_per_m")]
    pub stiffness: f64,
    /// Tension in the standing, settled structure (N).
    #[serde(rename = "pretension_n")]
    pub pretension: f64,
}

/// Coulomb friction between feet and ground; without it a pressing foot holds at any force.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Friction {
    /// Horizontal over vertical force at which a foot slips.
    pub coefficient: f64,
}

/// Whether friction gives way before the body lifts: below b/h.
pub fn slides(friction: &Friction, body: &Body<f64>) -> bool {
    friction.coefficient * body.height < body.half_width
}

/// Everything besides the rigid body; by default nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Members {
    /// Dampers between feet and ground.
    pub damper: Option<Damper>,
    /// A tendon that holds the body down.
    pub tendon: Option<Tendon>,
    /// Of a body without other members.
    pub friction: Option<Friction>,
}

impl Members {
    /// Whether there is only the rigid body.
    pub fn is_none(&self) -> bool {
        !self.act() && self.friction.is_none()
    }

    /// Whether a tendon or dampers act on the body.
    pub fn act(&self) -> bool {
        self.damper.is_some() || self.tendon.is_some()
    }
}

/// What a member's stiffness, damping or friction may be, in units of the structure's own.
const RATIO: (f64, f64) = (1e-9, 1e15);

/// What is wrong with a member, and what to do.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum MembersError {
    #[error("{name} is {value}; give a finite number{bound}")]
    Value { name: &'static str, value: f64, bound: &'static str },
    #[error(
        "{name} is {value:?}, {times:.1e} times {unit}: no result would mean anything; \
         check the unit"
    )]
    Absurd { name: &'static str, value: f64, times: f64, unit: &'static str },
    #[error(
        "friction.coefficient is given together with damper or tendon; slipping is followed for a \
         body without them, leave one out"
    )]
    Slipping,
    #[error(
        "friction.coefficient is given for a body without rotational inertia, whose slipping feet \
         could spin it; give structure.rotational_inertia_kgm2"
    )]
    Spinning,
    #[error(
        "tendon.pretension_n is {pretension}, more than stiffness_n_per_m can hold in {height} m; \
         give less than {most:.4e} N"
    )]
    Elongation { pretension: f64, height: f64, most: f64 },
}

impl Members {
    /// The members themselves if their numbers make sense under a body.
    ///
    /// # Errors
    /// A number that is not finite, or not positive where it must be; a tendon stretched to more
    /// than twice its length.
    pub fn checked(self, body: &Body<f64>) -> Result<Self, MembersError> {
        let positive = |name, value: f64| (name, value, value > 0.0, " greater than zero");
        let not_negative = |name, value: f64| (name, value, value >= 0.0, ", zero or greater");
        let damper = self.damper.map(|d| not_negative("damper.c_ns_per_m", d.c));
        let tendon = self.tendon.map(|t| {
            [
                positive("tendon.stiffness_n_per_m", t.stiffness),
                not_negative("tendon.pretension_n", t.pretension),
            ]
        });
        let friction = self.friction.map(|f| positive("friction.coefficient", f.coefficient));
        if friction.is_some() && self.act() {
            return Err(MembersError::Slipping);
        }
        if friction.is_some() && body.inertia <= 0.0 {
            return Err(MembersError::Spinning);
        }
        let all = friction.into_iter().chain(damper).chain(tendon.into_iter().flatten());
        for (name, value, good, bound) in all {
            if !(good && value.is_finite()) {
                return Err(MembersError::Value { name, value, bound });
            }
        }
        self.meaningful(body)?;
        if let Some(t) = self.tendon {
            let most = 0.5 * t.stiffness * body.height;
            if t.pretension > most {
                return Err(MembersError::Elongation {
                    pretension: t.pretension,
                    height: body.height,
                    most,
                });
            }
        }
        Ok(self)
    }

    /// Members whose numbers, in units of the structure's own, are within what 16 digits can
    /// follow.
    fn meaningful(&self, body: &Body<f64>) -> Result<(), MembersError> {
        let (weight, length) = (body.mass * GRAVITY, body.radius());
        let damper = self.damper.filter(|d| d.c > 0.0).map(|d| {
            let unit = body.mass * (GRAVITY / length).sqrt();
            ("damper.c_ns_per_m", d.c, unit, "the mass times sqrt(g/leg's length)")
        });
        let tendon = self.tendon.map(|t| {
            (
                "tendon.stiffness_n_per_m",
                t.stiffness,
                weight / length,
                "the weight over the leg's length",
            )
        });
        let friction =
            self.friction.map(|f| ("friction.coefficient", f.coefficient, 1.0, "the weight"));
        for (name, value, unit, word) in damper.into_iter().chain(tendon).chain(friction) {
            let times = value / unit;
            if !(RATIO.0..=RATIO.1).contains(&times) {
                return Err(MembersError::Absurd { name, value, times, unit: word });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::Structure;

    fn message(members: Members) -> String {
        members.checked(&Structure::paper().body()).unwrap_err().to_string()
    }

    #[test]
    fn bad_members_are_named_with_what_to_do() {
        let damper = Members { damper: Some(Damper { c: f64::INFINITY }), ..Members::default() };
        assert_eq!(
            message(damper),
            "damper.c_ns_per_m is inf; give a finite number, zero or greater"
        );
        let tendon = |stiffness, pretension| Members {
            tendon: Some(Tendon { stiffness, pretension }),
            ..Members::default()
        };
        assert!(message(tendon(0.0, 1.0)).starts_with("tendon.stiffness_n_per_m is 0;"));
        assert!(message(tendon(f64::NAN, 1.0)).starts_with("tendon.stiffness_n_per_m is NaN;"));
        assert!(message(tendon(1e5, 1e7)).ends_with("give less than 3.0500e6 N"));
        assert!(tendon(1e6, 0.0).checked(&Structure::paper().body()).is_ok());
    }

    #[test]
    fn nothing_is_the_default() {
        assert!(Members::default().is_none());
        assert!(Members::default().checked(&Structure::paper().body()).is_ok());
    }
}
