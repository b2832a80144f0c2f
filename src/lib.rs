//! Ground springs that let a finite element program follow Housner's theory of rocking.
//!
//! A structure that rocks on its feet loses energy in every impact by a rigid-body rule that finite element programs do not have. Springs,
//! absorbers and dashpots under its feet, the *ground springs*, make them follow it: a gap spring k1, an absorber mass m2, and a
//! spring k2 beside a dashpot c (a spring-absorber unit), one vertical and one horizontal at each foot. This library finds them.
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
//! Symbols are those of Ma, Butterworth & Davidson, "Modelling rocking structures using standard finite elements", NZSEE Conference
//! 2005; numbers in brackets, as (7), are its equations. Units are SI throughout; angles in radians; theta > 0 leans to the right, u > 0
//! is to the right. Formulas are generic in [`Scalar`]: `f64`, or dual numbers to differentiate with.
//!
//! # Features
//!
//! - `cli` (default): the program `tune`. `figures` (default): its figures. The library needs neither: `default-features = false`.
//! - `internals`: every module public, for this crate's own tests, benches and Python package. No promise of stability whatever.

// what is printed goes through commands/terminal
#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]
// under `internals` a module is public only to be tested
#![cfg_attr(not(feature = "internals"), warn(missing_docs))]

/// Every module, in the order in which data flows: each uses those above it alone (`.ci/circles.py` checks that).
#[path = "."]
mod house {
    pub mod message;

    pub mod effort;

    pub mod input;

    #[cfg(feature = "figures")]
    pub mod whole_file;

    pub mod scalar;

    pub mod record;

    pub mod synthetic;

    pub mod excitation;

    pub mod structure;

    #[cfg_attr(not(feature = "cli"), allow(unused_imports, dead_code))] // a run's findings are the program's
    pub mod results;

    pub mod spring;

    pub mod members;

    pub mod response;

    pub mod motion;

    pub mod housner;

    pub mod overturning;

    pub mod conditioning;

    pub mod regime;

    pub mod fem;

    pub mod compare;

    pub mod verdict;

    pub mod validate;

    #[cfg(any(feature = "cli", feature = "internals"))]
    #[cfg_attr(not(feature = "internals"), allow(unused_imports, dead_code))] // tests look at more than the program
    pub mod elastic;

    pub mod case;

    pub mod tuning;

    pub mod parameters;

    pub mod answers;

    #[cfg(any(feature = "cli", feature = "internals"))]
    pub mod rigid_forces;

    pub mod predictability;

    #[cfg(feature = "cli")]
    pub mod sweep;

    pub mod export;

    #[cfg(feature = "cli")]
    pub mod front;

    #[cfg(feature = "cli")]
    pub mod verify;

    #[cfg(feature = "figures")]
    pub mod figures;

    #[cfg(feature = "cli")]
    pub mod report;

    #[cfg(feature = "cli")]
    pub mod commands;
}

#[cfg(not(feature = "internals"))]
use house::*;
#[cfg(feature = "internals")]
pub use house::*;

pub use answers::{Both, WithMembers, compare, validate};
pub use case::{Case, CaseError, Objective, Tuning};
pub use compare::Match;
pub use conditioning::{Changes, Conditioning, Sensitivity};
pub use excitation::Excitation;
pub use export::{DeckFormat, ExportError, deck};
pub use fem::{Account, Demands, Forces, History, HistoryOutcome, Landing, QUANTITIES, Work};
pub use housner::{Impact, Rocking, RockingOptions, RockingOutcome, Uplift, solve as rock, solve_lanes as rock_many};
pub use members::{Damper, Friction, Members, MembersError, Tendon};
pub use motion::{Motion, nrmse};
pub use parameters::{Parameters, ParametersError, RememberedError};
pub use predictability::simulate;
pub use record::{Notice, ReadOptions, Record, RecordError, Source, Units, UnitsError, Vertical, VerticalFrom};
pub use response::Response;
pub use scalar::Scalar;
pub use spring::{Chain, ChainRow, Design, Springs};
pub use structure::{Body, Kind, Structure, StructureError};
pub use synthetic::{earthquake as earthquake_motion, record as synthetic_motion};
pub use tuning::{arr::inner::FitError, assessment::Assessment, job::JobError};
pub use validate::{Confusion, GeometricMean, Quantiles, RecordOutcome, Row, Suite, Summary, Validation};
pub use verdict::{Answer, Fate, Verdict};

/// The program `tune`: parses the arguments of the process and runs.
#[cfg(feature = "cli")]
pub use commands::main;

/// Tune the springs of a case: what `tune run` does, without its histories.
///
/// # Errors
/// No springs that settle as little as asked for; for the paper's procedure, a record that does not lift the structure.
pub fn tune(case: &Case) -> Result<Parameters, JobError> {
    Ok(Parameters::of(case, &tuning::job::Job::new(case, &|_, _, _| ())?))
}
