//! How much a finding weighs.

use serde::{Deserialize, Serialize};

/// How much a finding weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Weight {
    /// What the run was asked.
    Answer,
    /// Good to know.
    Note,
    /// Numbers need judgement.
    Warning,
    /// Numbers must not be used as they are.
    Fault,
}
