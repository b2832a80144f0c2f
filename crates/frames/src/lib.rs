//! Elastic structures that rock: what they are made of, how they move on rigid ground with plastic
//! landings, and on ground springs.
//!
//! | file | what |
//! |---|---|
//! | `structure` | what users give: pier, A-frame, frame |
//! | `mechanics` | equations of motion of any plane structure that stands on corners: M(q), forces, G(q) |
//! | `pier` | a mass on an elastic column on a rigid footing, in the footing's coordinates |
//! | `reference` | any of them on rigid ground, where landings are plastic: from event to event |
//! | `standing` | the standing structure as the ground feels it |
//! | `beam`, `frame` | finite elements: corotational beams between nodes and rigid footings |
//! | `fem` | a frame's history on ground springs |
//! | `assembled` | a structure and its finite elements: rotation and drift, rest, the reference and how far its motion can be predicted |
//! | `ensemble` | peaks over motions near a record, where no model foretells a history |
//! | `peaks` | the largest displacement, drift and uplift of a history, and their errors |
//! | `design_forces` | forces to design for, and whether they are the structure's own |
//! | `rigid`, `answer` | what the rigid body bears; all of them through one record |

#![warn(missing_docs)]

pub mod answer;
pub mod assembled;
pub mod beam;
pub mod design_forces;
pub mod ensemble;
pub mod fem;
pub mod frame;
mod mechanics;
pub mod peaks;
mod pier;
pub mod reference;
pub mod rigid;
pub mod standing;
pub mod structure;

pub use mechanics::{Corner, Mechanics};
pub use pier::{Axial, Pier};
