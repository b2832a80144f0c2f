//! Names of design forces.

use serde::{Deserialize, Serialize};

/// A design force, by its key in parameters.json.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ForceName {
    /// Across a column's axis, where along the column it is largest, or a leg's (N).
    ColumnShear,
    /// At a column's base (N m).
    ColumnBaseMoment,
    /// At a column's top, where it meets a beam (N m).
    ColumnTopMoment,
    /// In a column at its base, or in a leg; tension positive (N).
    Axial,
    /// The largest tension, where along the column it is largest (N).
    AxialTension,
    /// Where legs meet (N m).
    ApexMoment,
    /// Horizontal force of the ground on all corners: footings' inertia is in it, a rigid body's
    /// tendon at its anchor is not (N).
    SoleShear,
    /// Vertical force of the ground on all corners, upwards (N).
    SoleVertical,
    /// Vertical force of the ground on one corner of a rigid body, upwards (N).
    CornerVertical,
    /// Horizontal force of the ground on one corner of a rigid body (N).
    CornerHorizontal,
    /// Horizontal force of a rigid body's tendon at its anchor, on the body (N).
    AnchorHorizontal,
    /// Of the tendon that pulls most (N).
    Tendon,
    /// Of the damper with the largest force on the structure, upwards (N).
    Damper,
}

impl ForceName {
    /// Those that are taken from histories, in the order in which they are told.
    pub(crate) const MEASURED: [Self; 9] = [
        Self::ColumnShear,
        Self::ColumnBaseMoment,
        Self::ColumnTopMoment,
        Self::Axial,
        Self::AxialTension,
        Self::SoleShear,
        Self::SoleVertical,
        Self::Tendon,
        Self::Damper,
    ];

    /// As an engineer says it.
    pub fn words(self) -> &'static str {
        match self {
            Self::ColumnShear => "column shear",
            Self::ColumnBaseMoment => "moment at column base",
            Self::ColumnTopMoment => "moment at column top",
            Self::Axial => "axial force",
            Self::AxialTension => "tension",
            Self::ApexMoment => "moment at the apex",
            Self::SoleShear => "shear at all soles together, footings included",
            Self::SoleVertical => "vertical force at all soles together, footings included",
            Self::CornerVertical => "vertical force at one corner",
            Self::CornerHorizontal => "horizontal force at one corner",
            Self::AnchorHorizontal => "horizontal pull at the tendon's anchor",
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
