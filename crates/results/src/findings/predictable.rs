//! Up to when findings say that a motion can be foretold.

use super::{DeckEnd, Finding};

impl Finding {
    /// Up to when it says that the motion can be foretold (s), if not to its end.
    pub fn predictable_to(&self) -> Option<f64> {
        match *self {
            Self::ForetoldUpTo { time_s, .. } | Self::SlidesOn { time_s, .. } => Some(time_s),
            Self::IllConditioned { holds_to_s, .. } => holds_to_s,
            // nothing was asked beyond it
            Self::PivotLeavesGround { time_s } => Some(time_s),
            Self::DeckJudged { judged_s, end: DeckEnd::Foretold | DeckEnd::Slides, .. } => {
                Some(judged_s)
            }
            _ => None,
        }
    }
}
