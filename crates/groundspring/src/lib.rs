//! Ground springs that let a finite element program follow Housner's theory of rocking.
//!
//! A structure that rocks on its feet loses energy in every impact by a rigid-body rule that finite
//! element programs do not have. Springs, absorbers and dashpots under its feet, the *ground
//! springs*, make them follow it: a gap spring k1, an absorber mass m2, and a spring k2 beside a
//! dashpot c (a spring-absorber unit), one vertical and one horizontal at each foot. This library
//! finds them.
//!
//! ```
//! use groundspring::{Case, DeckFormat, Record, Structure, deck, simulate, tune};
//!
//! let case = Case::of(Structure::a_frame(12.0, 2.4, 350e3)?, Record::el_centro())?;
//! let springs = tune(&case)?;
//! println!("k1 = {:.3e} N/m, m2 = {:.0} kg", springs.vertical.k1_n_per_m, springs.vertical.m2_kg);
//! let history = simulate(&springs, &case.record);
//! let model = deck(&springs, &case.record, DeckFormat::OpenSeesPy)?;
//! # assert!(history.impacts() > 10 && model.contains("zeroLength"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | to | take |
//! |---|---|
//! | describe a body and its record | [`Structure`], [`Record`], [`Case`]; [`Members`] that the body has besides |
//! | rock the rigid body by Housner's equation | [`rock`], [`rock_many`]: [`Rocking`]; how sensitive the answer is: [`Conditioning`] |
//! | find springs | [`tune`]: [`Parameters`], which are `parameters.json` |
//! | rock the finite elements on them | [`simulate`]: [`History`] |
//! | see whether they follow Housner | [`compare`] on one record: [`Match`], [`Verdict`]; [`validate`] on many: [`Validation`] |
//! | use them elsewhere | [`deck`]; [`Chain`] has k1, k2, m2, c, [`Design`] mu, f, xi, Omega_n; [`Response`] is their frequency response |
//!
//! Symbols are those of Ma, Butterworth & Davidson, "Modelling rocking structures using standard
//! finite elements", NZSEE Conference 2005; numbers in brackets, as (7), are its equations. Units
//! are SI throughout; angles in radians; theta > 0 leans to the right, u > 0 is to the right.
//! Formulas are generic in [`Scalar`]: `f64`, or dual numbers to differentiate with.

#![warn(missing_docs)]

#[doc(inline)]
pub use cases::{Case, CaseError, Objective, Tuning};
#[doc(inline)]
pub use decks::{DeckFormat, ExportError, deck};
#[doc(inline)]
pub use dynamics::compare::Match;
#[doc(inline)]
pub use dynamics::fem::{
    Account, Demands, Forces, History, HistoryOutcome, Landing, QUANTITIES, Work,
};
#[doc(inline)]
pub use dynamics::spring::{Chain, ChainRow, Design, Springs};
#[doc(inline)]
pub use frequency_response::Response;
#[doc(inline)]
pub use frequency_response::inner::FitError;
#[doc(inline)]
pub use parameters::answers::{MemberHistory, ModelComparison, compare, validate};
#[doc(inline)]
pub use parameters::predictability::simulate;
#[doc(inline)]
pub use parameters::{Parameters, ParametersError, RememberedError};
#[doc(inline)]
pub use rocking::conditioning::{Changes, Conditioning, Sensitivity};
#[doc(inline)]
pub use rocking::housner::{
    Impact, Rocking, RockingOptions, RockingOutcome, Uplift, solve as rock,
    solve_lanes as rock_many,
};
#[doc(inline)]
pub use rocking::members::{Damper, Friction, Members, MembersError, Tendon};
#[doc(inline)]
pub use rocking::motion::{Motion, nrmse};
#[doc(inline)]
pub use rocking::scalar::Scalar;
#[doc(inline)]
pub use rocking::structure::{Body, Kind, Structure, StructureError};
#[doc(inline)]
pub use rocking::synthetic::{earthquake as earthquake_motion, record as synthetic_motion};
#[doc(inline)]
pub use springs::{assessment::Assessment, job::JobError};
#[doc(inline)]
pub use strong_motion::excitation::Excitation;
#[doc(inline)]
pub use strong_motion::{
    Notice, ReadOptions, Record, RecordError, Source, Units, UnitsError, Vertical, VerticalFrom,
};
#[doc(inline)]
pub use validation::verdict::{Answer, Fate, Verdict};
#[doc(inline)]
pub use validation::{
    Confusion, GeometricMean, Quantiles, RecordOutcome, Row, Suite, Summary, Validation,
};

/// Tune the springs of a case: what `tune run` does, without its histories.
///
/// # Errors
/// No springs that settle as little as asked for; for the paper's procedure, a record that does not
/// lift the structure.
pub fn tune(case: &Case) -> Result<Parameters, JobError> {
    Ok(Parameters::of(case, &springs::job::Job::new(case, &|_, _, _| ())?))
}
