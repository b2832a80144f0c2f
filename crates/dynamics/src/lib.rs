//! Finite elements of a rigid body on ground springs: steps, events, energy account.

#![warn(missing_docs)]

pub mod compare;
pub mod effort;
pub mod fem;
pub mod spring;
