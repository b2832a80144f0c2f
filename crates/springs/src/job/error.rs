//! Why a case has no springs.

use thiserror::Error;

use frequency_response::inner::FitError;

/// Why there are no springs.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum JobError {
    #[error(transparent)]
    Fit(#[from] FitError),
    #[error(
        "{record}: PGA {pga_g:.4} g never lifts the structure (it takes {limit_g:.4} g), and the \
         paper's procedure tunes on a record; raise --scale, give another record, or leave \
         objective = \"arr\" out"
    )]
    NeverLifts { record: String, pga_g: f64, limit_g: f64 },
    #[error(
        "{record} holds {samples} sample; a history needs at least two: give another record, or \
         raise --duration"
    )]
    TooShort { record: String, samples: usize },
    #[error(
        "tuning.max_settlement_m is {asked_m:?}, but on springs of {max_hz} Hz the body settles by \
         {least_m:.3e} m at least; allow that, or raise --max-hz"
    )]
    Settlement { asked_m: f64, max_hz: f64, least_m: f64 },
    #[error(
        "{record}: {steps} steps at least, one to a sample of moving ground, are out of reach: a \
         history may take {most}; shorten it (--duration), or give a record with fewer samples"
    )]
    OutOfReach { record: String, steps: usize, most: usize },
    #[error("no candidate followed the record to its end; raise --max-hz or shorten --duration")]
    NoCandidate,
}
