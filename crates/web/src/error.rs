//! What is wrong, in the program's own line.

use cases::CaseError;
use fixed_steps::recipe::FixedStepSpringsError;
use frames::{answer::AnswerError, assembled::AssemblyError};
use run_folder::FolderError;
use springs::{
    elastic::{ElasticTuneError, referred::ReferredError},
    job::JobError,
};
use strong_motion::RecordError;
use thiserror::Error;

/// Why there is no answer.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum WebError {
    #[error(transparent)]
    Case(#[from] CaseError),
    #[error(transparent)]
    Record(#[from] RecordError),
    #[error(transparent)]
    Job(#[from] JobError),
    #[error(transparent)]
    Assembly(#[from] AssemblyError),
    #[error(transparent)]
    Referred(#[from] ReferredError),
    #[error(transparent)]
    Answer(#[from] AnswerError),
    #[error(transparent)]
    ElasticTune(#[from] ElasticTuneError),
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error(transparent)]
    FixedStep(#[from] FixedStepSpringsError),
    #[error("list of variations: {0}")]
    Variations(#[from] serde_json::Error),
    #[error(
        "case.toml: {key} works only in the program: the page runs no search that long; leave it \
            out"
    )]
    ForTheProgram { key: &'static str },
    #[error("pulse: {name} is {value:?}; give {least} to {most} {unit}")]
    Pulse { name: &'static str, value: f64, least: f64, most: f64, unit: &'static str },
    #[error(
        "an elastic structure's springs for a program with steps of one size come with the whole \
            run"
    )]
    FixedStepElastic,
    #[error(
        "there are no springs for this geometry; the slenderness alpha must lie between 0.005 and \
            0.9 rad"
    )]
    NoSprings,
}
