//! The words of findings on what was taken of a record, and what was not.

use crate::results::findings::{DeckEnd, Finding, ForceName, PeakChange};
use files::message::{quantity, significant};

/// Quantities that a vertical motion left out changes the most, said in its message; all are in
/// parameters.json.
const CHANGES_SAID: usize = 2;
/// Share below which a quantity is said not to change.
const LEAST_CHANGE: f64 = 0.01;

impl Finding {
    /// What was taken, and what was not.
    pub(super) fn taken(&self) -> String {
        match self {
            Self::VerticalLeftOut { vertical_g, horizontal_g, changes } => {
                let mut changes = changes.clone();
                // what grows the most first, and the axial force, which a section is designed by
                let ratio = |c: &PeakChange| c.with / c.without;
                changes.sort_by(|a, b| ratio(b).total_cmp(&ratio(a)));
                let axial = |c: &PeakChange| c.quantity == ForceName::Axial.words();
                let said = changes.iter().enumerate();
                let changes = |c: &PeakChange| (ratio(c) - 1.0).abs() > LEAST_CHANGE;
                let said = said.filter(|(i, c)| *i < CHANGES_SAID || axial(c));
                let said = said.map(|(_, c)| c).filter(|c| changes(c));
                let changed = said.map(|c| format!("{} {}", c.quantity, quantity(c.with, &c.unit)));
                let changed: Vec<String> = changed.collect();
                let [vertical, across] = [vertical_g, horizontal_g].map(|g| significant(*g, 3));
                match changed.is_empty() {
                    true => format!("vertical motion ({vertical} g beside {across} g) is left out"),
                    false => format!(
                        "with the vertical motion that is left out ({vertical} g): {}",
                        changed.join(", ")
                    ),
                }
            }
            Self::Doubt { message, .. } => message.clone(),
            Self::DeckJudged { judged_s, record_s, end } => {
                let why = match end {
                    DeckEnd::Record => "",
                    DeckEnd::History => ": then it falls over, or the history ends",
                    DeckEnd::Foretold => {
                        ": from then on changes of 1e-5 decide, and no two programs agree"
                    }
                    DeckEnd::Flight => ": then the ground falls faster than the body",
                    DeckEnd::Slides => ": then a corner slides on, and friction decides",
                };
                format!(
                    "tune verify judges the deck over the first {} s of {} s{why}",
                    significant(*judged_s, 4),
                    significant(*record_s, 4)
                )
            }

            _ => String::new(),
        }
    }
}
