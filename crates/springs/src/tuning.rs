//! Finding springs: the inner design (mu, f, xi), by the paper's frequency response or from the
//! geometry; Omega_n; and what uses them.

pub mod paper_procedure;

pub mod assessment;

pub mod at_once;

pub mod descent;

pub mod elastic;

pub mod capped_springs;

pub mod fixed_steps;

pub mod job;

mod ladder;

pub mod stiffness_search;

/// CMA-ES, which that search walks by.
mod cma_es;
mod search;

pub mod suite;

pub mod landing_simulation;
