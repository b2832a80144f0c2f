//! What a search that was cut left undone.

use serde::{Deserialize, Serialize};

/// What a search that was cut has not done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NotDone {
    /// Other springs.
    Stiffnesses,
    /// The paper's procedure to the end, beside them.
    PaperProcedure,
    /// The error over the stiffness.
    Front,
    /// Springs that follow the record further.
    Further,
    /// Peaks over motions near the record.
    NearMotions,
    /// Whether forces change with the mesh and the springs.
    ForceChecks,
}

impl NotDone {
    /// In words.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Stiffnesses => "other springs",
            Self::PaperProcedure => "the paper's procedure to its end",
            Self::Front => "the error over the stiffness",
            Self::Further => "springs that follow the record further",
            Self::NearMotions => "motions near the record",
            Self::ForceChecks => "the check of forces",
        }
    }
}
