//! Finds ground springs: the stiffness that an accuracy asks for, designs from the geometry or by
//! the paper's procedure, springs for fixed time steps and for elastic structures.
//!
//! | file | what |
//! |---|---|
//! | `job` | a whole case: body, record, springs |
//! | `suite`, `landing_simulation` | what springs are judged on: motions of a seed; single landings and uplifts |
//! | `stiffness_search` (`ladder`, `search`) | Omega_n by the accuracy |
//! | `paper_procedure` | Omega_n by the error of a history, after the paper's inner fit |
//! | `capped_springs` (`descent`) | springs below a cap on frequency |
//! | `fixed_steps` | springs for programs with steps of one size |
//! | `elastic` | springs of elastic structures |
//! | `at_once`, `assessment` | springs without a search; what was measured of springs |

pub mod assessment;
pub mod at_once;
pub mod capped_springs;
/// CMA-ES, which `search` walks by.
mod cma_es;
pub mod descent;
pub mod elastic;
pub mod fixed_steps;
pub mod job;
mod ladder;
pub mod landing_simulation;
pub mod paper_procedure;
mod search;
pub mod stiffness_search;
pub mod suite;

/// Ratio of typical errors up to which springs are alike on some twenty to fifty motions: something
/// else decides, or more motions do.
pub(crate) const ALIKE: f64 = 1.25;

/// Progress of a search: evaluations done, evaluations planned (0: unknown), least error so far.
pub type SearchProgress<'a> = &'a (dyn Fn(usize, usize, f64) + Sync);
