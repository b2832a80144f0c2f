//! Why an elastic structure has no springs.

use thiserror::Error;

/// Why an elastic structure cannot be tuned, and what to do.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum ElasticTuneError {
    #[error("structure: it does not stand under its weight; give stiffer members")]
    Falls,
    #[error("{key} is {value}; {remedy}")]
    Accuracy { key: &'static str, value: String, remedy: &'static str },
    #[error(
        "max_omega_hz (--max-hz) is {most_hz:?}, but the softest springs tried for this structure \
         have {least_hz:.1} Hz: softer springs deform by more than a tenth of the structure's own \
         deformation; allow at least {least_hz:.1} Hz, or leave it out",
        least_hz = (.softest_hz * 10.0).ceil() / 10.0
    )]
    TooSoft { most_hz: f64, softest_hz: f64 },
}
