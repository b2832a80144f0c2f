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
//! | have springs for a program with fixed time steps | [`FixedStepProgram`] of a [`Case`]; [`tune`]: [`ProgramRow`]; [`stepped_deck`] |
//! | use them elsewhere | [`deck`]; [`Chain`] has k1, k2, m2, c, [`Design`] mu, f, xi, Omega_n; [`Response`] is their frequency response |
//!
//! Springs for a program that steps with one size, its deck, and what it errs:
//!
//! ```
//! use groundspring::{
//!     Case, DeckFormat, FixedStepProgram, ProgramName, Record, Stepping, Structure, stepped_deck,
//!     tune,
//! };
//!
//! let case = Case {
//!     program: Some(FixedStepProgram::of(ProgramName::Sap2000, 1e-3)),
//!     ..Case::of(Structure::block(2.0, 0.5, 1e3)?, Record::el_centro())?
//! };
//! let springs = tune(&case)?;
//! let row = springs.program.as_ref().ok_or("no springs for steps of one size")?;
//! println!("k1 = {:.3e} N/m, steps of {} s", row.units.vertical.k1_n_per_m, row.step_s);
//! if let Some(fault) = row.not_to_be_used() {
//!     println!("{fault}");
//! }
//! let deck = stepped_deck(&springs, &case.record, DeckFormat::Sap2000, Stepping::Even, None)?;
//! # assert!(row.units.vertical.k1_n_per_m < springs.vertical.k1_n_per_m);
//! # assert!(deck.text.contains("LINK PROPERTY DEFINITIONS"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Symbols are those of Ma, Butterworth & Davidson, "Modelling rocking structures using standard
//! finite elements", NZSEE Conference 2005; numbers in brackets, as (7), are its equations. Units
//! are SI throughout; angles in radians; theta > 0 leans to the right, u > 0 is to the right.
//! Formulas are generic in [`Scalar`]: `f64`, or dual numbers to differentiate with.

#![warn(missing_docs)]

#[doc(inline)]
pub use cases::{Case, CaseError, Objective, Tuning};
#[doc(inline)]
pub use decks::{DeckFormat, ExportError, SteppedDeck, Stepping, deck, stepped_deck};
#[doc(inline)]
pub use dynamics::compare::Match;
#[doc(inline)]
pub use dynamics::fem::{
    Account, Demands, Forces, History, HistoryOutcome, Landing, QUANTITIES, Work,
};
#[doc(inline)]
pub use dynamics::spring::{Chain, ChainRow, Design, Springs};
#[doc(inline)]
pub use fixed_steps::{FixedStepProgram, Integrator, ProgramName};
#[doc(inline)]
pub use frequency_response::Response;
#[doc(inline)]
pub use frequency_response::inner::FitError;
#[doc(inline)]
pub use parameters::answers::{MemberHistory, ModelComparison, compare, validate};
#[doc(inline)]
pub use parameters::predictability::simulate;
#[doc(inline)]
pub use parameters::program::{FootUnits, ProgramRow};
#[doc(inline)]
pub use parameters::{Parameters, ParametersError, RememberedError};
#[doc(inline)]
pub use rocking::conditioning::{Changes, Conditioning, Sensitivity};
/// Rock the rigid body by Housner's equation.
///
/// ```
/// use groundspring::{RockingOptions, Structure, rock};
/// let body = Structure::a_frame(61.0, 12.2, 680.1e3)?.body::<f64>();
/// // 0.5 s at 2 m/s2, above g tan(alpha) = 0.981 m/s2: it lifts, to the left
/// let accel: Vec<f64> = (0..1000).map(|i| if i < 50 { 2.0 } else { 0.0 }).collect();
/// let rocking = rock(&body, 0.01, &accel, &RockingOptions::default());
/// assert_eq!(rocking.uplifts[0].side, -1.0);
/// assert!(!rocking.impacts.is_empty());
/// # Ok::<(), groundspring::StructureError>(())
/// ```
#[doc(inline)]
pub use rocking::housner::solve as rock;
#[doc(inline)]
pub use rocking::housner::{
    Impact, Rocking, RockingOptions, RockingOutcome, Uplift, solve_lanes as rock_many,
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
/// - `TooShort`: the part of the record that is used has less than two samples.
/// - `OutOfReach`: it has more steps than a history may take.
/// - `Settlement`: no springs up to the stiffest allowed settle as little as asked for.
/// - `NoCandidate`: no springs follow the record to its end.
/// - `Fit`: the target, the bounds or a mass ratio of the paper's procedure cannot be.
/// - `NeverLifts`: the record does not lift the structure, and [`Objective::Arr`] tunes on it.
pub fn tune(case: &Case) -> Result<Parameters, JobError> {
    Ok(Parameters::of(case, &springs::job::Job::new(case, &|_, _, _| ())?))
}
