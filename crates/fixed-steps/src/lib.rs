//! Histories as programs with fixed time steps make them, and springs for them.
//!
//! Most engineers step a structure with one size of step, in a program that decides what touches
//! the ground within the iteration at the end of a step (OpenSees, SAP2000, ETABS). This crate
//! steps the same models as such a program does, in milliseconds, and gives springs that suit it.
//!
//! ```text
//!   let springs = FixedStepSprings::of(&body, 1e-3, Integrator::Trbdf2)?;
//!   let model = FixedStepBody::new(&springs.body, &springs.chains());
//!   let history = FixedStepAnalysis::new(&model, springs.settings(), record_dt, &accel).history();
//! ```
//!
//! | file | what |
//! |---|---|
//! | `integrator`, `kinematics` | the integrators and one step of each: predictor, where forces count |
//! | `contact` | a foot of such a program: open or closed by the trial, its anchor |
//! | `model` | what is stepped; in `rigid` the rigid body, in `elastic` a frame |
//! | `iteration`, `analysis` | the iteration at a step's end; the time loop, substeps, what gives up |
//! | `events` | event-to-event stepping: steps cut where a gap opens or closes |
//! | `recipe`, `expected`, `rebound` | springs in closed form for a step and an integrator; the error they leave |
//! | `measured` | the error of springs over many motions |
//! | `program` | programs as users name them, and what they are set to |

// what is printed goes through the program's `commands/terminal`
#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]
#![warn(missing_docs)]

pub mod analysis;
pub mod contact;
pub mod elastic;
pub mod events;
pub mod expected;
pub mod integrator;
mod integrator_name;
pub mod iteration;
pub mod kinematics;
pub mod measured;
pub mod model;
pub mod program;
pub mod rebound;
pub mod recipe;
pub mod rigid;

/// Rotation at which a history ends as overturned, over alpha of a body or the rotation at which a
/// base topples: beyond 1 a pulse may still right it; 2 is a convention.
pub(crate) const FALLING: f64 = 2.0;

pub use analysis::{FixedStepAnalysis, FixedStepHistory, FixedStepOutcome, GaveUp, StepSettings};
pub use elastic::{FixedStepFrame, FixedStepFrameHistory};
pub use events::EventStepping;
pub use expected::ExpectedError;
pub use integrator::Integrator;
pub use integrator_name::IntegratorNameError;
pub use iteration::{ConvergenceTest, Iteration};
pub use kinematics::MemberDamping;
pub use model::FixedStepModel;
pub use program::{FixedStepProgram, ProgramName};
pub use recipe::{FixedStepDesign, FixedStepSprings};
pub use rigid::FixedStepBody;
