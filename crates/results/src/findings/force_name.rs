//! Names of design forces.

use serde::{Deserialize, Serialize};

/// A design force, by its key in parameters.json.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ForceName {
    ColumnShear,
    ColumnBaseMoment,
    ColumnTopMoment,
    Axial,
    AxialTension,
    ApexMoment,
    SoleShear,
    SoleVertical,
    Tendon,
    Damper,
}

impl ForceName {
    /// As an engineer says it.
    pub fn words(self) -> &'static str {
        match self {
            Self::ColumnShear => "column shear",
            Self::ColumnBaseMoment => "moment at column base",
            Self::ColumnTopMoment => "moment at column top",
            Self::Axial => "axial force",
            Self::AxialTension => "tension",
            Self::ApexMoment => "moment at the apex",
            Self::SoleShear => "shear at the sole, footing included",
            Self::SoleVertical => "vertical force at the sole, footing included",
            Self::Tendon => "tendon force",
            Self::Damper => "damper force",
        }
    }

    /// The same of a block, which has no column.
    pub fn words_of_block(self) -> &'static str {
        match self {
            Self::ColumnShear => "base shear",
            Self::ColumnBaseMoment => "moment at the base",
            Self::SoleShear => "shear at the base",
            Self::SoleVertical => "vertical force at the base",
            other => other.words(),
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::ColumnBaseMoment | Self::ColumnTopMoment | Self::ApexMoment => "N m",
            _ => "N",
        }
    }
}
