//! The landing of a foot on springs in the stiff limit, as a small problem of its own, and the
//! springs that follow from the geometry.
//!
//! | file | what |
//! |---|---|
//! | `linear` | linear motion between two changes of contact, exactly |
//! | `chain` | one spring-absorber unit stops a mass |
//! | `corners`, `plane` | a structure as its two corners feel it; its landing on both |
//! | `universal` | the chain of least rebound, C_u(K) and mu_u(K) |
//! | `design`, `part` | springs of a rigid body from its geometry; of a footing or a foot |
//! | `weight` | what the body's weight does to a landing |

pub mod chain;
pub mod corners;
pub mod design;
mod linear;
pub mod part;
pub mod plane;
pub mod universal;
pub mod weight;
