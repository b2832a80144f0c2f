//! Which design forces hold.

use super::{Finding, PeakChange, joined, listed};
use files::message::{percent, quantity, significant};

/// Forces that change, what verb and pronoun they take, and what they become.
fn told(changes: &[PeakChange]) -> [String; 4] {
    let all =
        |words: fn(&PeakChange) -> String| joined(&changes.iter().map(words).collect::<Vec<_>>());
    let [are, they] = if changes.len() == 1 { ["is", "it"] } else { ["are", "they"] };
    let values = all(|change| quantity(change.with, &change.unit));
    [all(|change| change.quantity.clone()), are.into(), they.into(), values]
}

impl Finding {
    /// Which design forces hold.
    pub(super) fn forces(&self) -> Option<String> {
        Some(match self {
            Self::ForceWithheld {
                force,
                springs_err: Some(err),
                housner: Some(housner),
                of_block,
                ..
            } => {
                let words = if *of_block { force.words_of_block() } else { force.words() };
                format!(
                    "{words} is withheld: peaks on these springs err by {}, so that they do not \
                        check Housner's {}",
                    percent(*err),
                    quantity(housner.abs(), force.unit())
                )
            }
            Self::ForceWithheld {
                force,
                change: Some(change),
                housner: Some(housner),
                of_block,
                ..
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
                let [names, are, they, values] = told(changes);
                format!(
                    "{names} {are} given for the first {} s only: over the whole record {they} \
                        would be {values} but change by 5 % or more with springs or mesh",
                    significant(*over_s, 3)
                )
            }
            Self::ForcesOfCutoff { below_hz, changes } => {
                let [names, are, they, values] = told(changes);
                format!(
                    "{names} {are} low-pass filtered at {} Hz; at twice that cutoff {they} {are} \
                        {values}",
                    significant(*below_hz, 3)
                )
            }
            Self::ForcesAtRest { forces, tied } => format!(
                "{} {} largest at rest: the frame's own weight{}, with a vertical motion more of \
                    it, half on each foot and no thrust between them; rocking adds nothing. The \
                    feet are assumed free to spread; where a tie or friction holds them they carry \
                    a thrust, and the legs have hardly any shear and moment at rest",
                listed(forces),
                if forces.len() == 1 { "is" } else { "are" },
                if *tied { " and its tendon's pretension" } else { "" }
            ),
            _ => return None,
        })
    }
}
