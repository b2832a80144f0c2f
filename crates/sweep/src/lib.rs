//! Sweeps: thousands of histories over structures, ground motions, scales and restitutions, and
//! what they say together.
//!
//! ```text
//! SWEEP.toml -> spec -> plan: cell i = (motion, structure, restitution, level), in that order, the last one fastest
//!     parts: fixed ranges of cells --(history | overturning)--> rows -> table -> DIR/parts/part-00000-of-00025.parquet
//!     springs: tuned once a geometry before the first cell, kept in DIR/springs.json
//! gather: parts one after another -> fragility, ida, spectrum, compare -> CSV, figures, plain words
//! ```
//!
//! The cut into parts belongs to the plan and not to the machine: a part is a function of the sweep
//! alone, is written under a temporary name, synced and renamed, and is the same file whoever
//! computes it, in whatever order, on any number of threads. So a sweep that was killed goes on
//! with the parts that are missing, and `--shard I/N` takes every N-th of them.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | PGA, PGV | peak ground acceleration, velocity | m/s2, m/s |
//! | PGA/(g tan alpha) | 1 lifts a body at rest | - |
//! | p PGV/(g tan alpha) | the same of the velocity, p^2 = m g R/I0 | - |
//! | q = omega/p | circular frequency of a pulse over p | - |

#![warn(missing_docs)]

pub mod compare;
mod error;
pub mod fragility;
pub mod history;
pub mod ida;
pub mod levels;
pub mod lognormal;
pub mod manifest;
pub mod motion;
mod named;
pub mod overturning;
pub mod parts;
pub mod plan;
pub mod pulse;
pub mod reduce;
pub mod row;
pub mod seal;
pub mod spec;
pub mod springs;
pub mod summary;
pub mod values;

pub use error::SweepError;
