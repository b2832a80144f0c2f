//! Housner's rocking body: structure, history, overturning, conditioning, synthetic motions.

#![warn(missing_docs)]

// the same bits on every machine
use elementary as _;

pub mod conditioning;
pub mod housner;
pub mod json;
pub mod members;
pub mod motion;
pub mod overturning;
pub mod regime;
pub mod scalar;
pub mod statistics;
pub mod structure;
pub mod synthetic;
