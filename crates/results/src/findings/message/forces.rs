//! Which design forces hold.

use super::{Finding, PeakChange, joined, listed};
use files::message::{percent, quantity, significant};

impl Finding {
    /// Which design forces hold.
    pub(super) fn forces(&self) -> String {
        match self {
            Self::ForceWithheld {
                force,
                change: Some(change),
                housner: Some(housner),
                of_block,
            } => {
                let words = if *of_block { force.words_of_block() } else { force.words() };
                format!(
                    "{words} is withheld: between impacts it differs by {} on the springs from \
                        Housner's {}",
                    percent(*change),
                    quantity(housner.abs(), force.unit())
                )
            }
            Self::ForceWithheld { force, change, of_block, .. } => {
                let words = if *of_block { force.words_of_block() } else { force.words() };
                let by = change.map_or("could not be checked".into(), |change| {
                    format!("varies {}", percent(change))
                });
                format!("{words} is withheld: {by} with springs or mesh")
            }
            Self::ForcesHeldInPart { over_s, changes } => {
                let all = |words: fn(&PeakChange) -> String| {
                    joined(&changes.iter().map(words).collect::<Vec<_>>())
                };
                format!(
                    "{} {} of the first {} s alone: over the whole record {} would be {}, and \
                        change by 5 % or more with springs or mesh",
                    all(|change| change.quantity.clone()),
                    if changes.len() == 1 { "is" } else { "are" },
                    significant(*over_s, 3),
                    if changes.len() == 1 { "it" } else { "they" },
                    all(|change| quantity(change.with, &change.unit))
                )
            }
            Self::ForcesAtRest { forces } => format!(
                "{} {} largest at rest: the frame's own weight, with a vertical motion more of it, \
                    half on each foot and no thrust between them; rocking adds nothing",
                listed(forces),
                if forces.len() == 1 { "is" } else { "are" }
            ),
            _ => String::new(),
        }
    }
}
