//! How much a finding weighs.

use super::Finding;
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

impl Finding {
    /// How much it weighs.
    pub(crate) fn weight(&self) -> Weight {
        match self {
            Self::NeverLifts { .. }
            | Self::Slides { .. }
            | Self::Stands { .. }
            | Self::Overturns { .. } => Weight::Answer,
            Self::ModelsDisagree { .. }
            | Self::NoAnswer { .. }
            | Self::AccuracyMissed { .. }
            | Self::PeaksMissed { .. }
            | Self::HistoryEndsEarly { .. } => Weight::Fault,
            Self::ForetoldUpTo { later_forces, .. } if later_forces.is_empty() => Weight::Note,
            Self::ProgramStepTooLong { asked: false, .. }
            | Self::ProgramLoses { asked: false, .. }
            | Self::ProgramErrsOnEarthquakes { asked: false, .. }
            | Self::ProgramSpread { asked: false, .. }
            | Self::ProgramSpread { earthquakes: true, .. }
            | Self::ProgramNotToBeUsed { asked: false, .. }
            | Self::ProgramRestitution { asked: false }
            | Self::ProgramStepForAccuracy { .. } => Weight::Note,
            Self::NearMotions { .. }
            | Self::ForcesAtRest { .. }
            | Self::MembersBeside { .. }
            | Self::LeftAside { .. }
            | Self::DeckJudged { .. }
            | Self::WithoutVertical { .. } => Weight::Note,
            _ => Weight::Warning,
        }
    }
}
