//! The words of findings on what was taken of a record, and what was not.

use crate::findings::{DeckEnd, Finding, ForceName, PeakChange};
use files::message::{percent, quantity, significant};

/// Quantities that a vertical motion left out changes the most, said in its message beside the
/// displacement, the axial force and the largest moment; all are in parameters.json.
const CHANGES_SAID: usize = 1;
/// Share below which a quantity is said not to change.
const LEAST_CHANGE: f64 = 0.01;

impl Finding {
    /// What was taken, and what was not.
    pub(super) fn taken(&self) -> Option<String> {
        Some(match self {
            Self::VerticalLeftOut { .. } => return self.vertical_left_out(),
            Self::Doubt { message, .. } => message.clone(),
            Self::DeckJudged { judged_s, record_s, end } => {
                let why = match end {
                    DeckEnd::Record => "",
                    DeckEnd::History => ": then it falls over, or the history ends",
                    DeckEnd::Foretold => {
                        ": beyond that, differences of 1e-5, as between two programs, become \
                            visible"
                    }
                    DeckEnd::IllConditioned => {
                        ": beyond that, a change of 0.1 % moves the motion too much"
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

            _ => return None,
        })
    }

    /// What a vertical motion that is left out would change.
    fn vertical_left_out(&self) -> Option<String> {
        Some(match self {
            Self::VerticalLeftOut {
                vertical_g, overturns_s: Some(time), predictable_to_s, ..
            } => {
                let doubt = predictable_to_s.filter(|until| until < time).map(|until| {
                    format!(", which is not predictable beyond {} s", significant(until, 4))
                });
                format!(
                    "with the vertical motion that is left out ({} g) it overturns at t = {} s{}",
                    significant(*vertical_g, 3),
                    significant(*time, 4),
                    doubt.unwrap_or_default()
                )
            }
            Self::VerticalLeftOut {
                vertical_g,
                horizontal_g,
                changes,
                predictable_to_s,
                checked,
                ..
            } => {
                let until = predictable_to_s.map(|until| {
                    format!(
                        "; with it the motion is predictable only to {} s; later peaks are not \
                            given",
                        significant(until, 4)
                    )
                });
                let until = until.unwrap_or_default();
                // what grows the most first; the displacement, and the axial force, which a
                // section is designed by, in any case
                let ratio = |c: &PeakChange| c.with / c.without;
                let told = |c: &&PeakChange| c.quantity != ForceName::SoleVertical.words();
                let mut all: Vec<&PeakChange> = changes.iter().filter(told).collect();
                all.sort_by(|a, b| ratio(b).total_cmp(&ratio(a)));
                let always =
                    |c: &PeakChange| c.unit == "m" || c.quantity == ForceName::Axial.words();
                let most = |c: &PeakChange| match c.unit.as_str() {
                    "" => significant(c.with, 3),
                    unit => quantity(c.with, unit),
                };
                // the largest moment, too
                let moments = all.iter().filter(|c| c.unit == "N m");
                let moment = moments.max_by(|a, b| a.with.total_cmp(&b.with)).copied();
                let always = |c: &PeakChange| always(c) || Some(c) == moment;
                let most_of_all: Vec<&PeakChange> =
                    all.iter().filter(|c| !always(c)).take(CHANGES_SAID).copied().collect();
                let said = all.iter().filter(|c| always(c) || most_of_all.contains(c));
                let changes_it = |c: &PeakChange| (ratio(c) - 1.0).abs() > LEAST_CHANGE;
                let said = said.filter(|c| changes_it(c));
                let short = |name: &str| name.replace("top displacement", "top");
                let name = |c: &PeakChange| c.quantity.split(',').next().map(short);
                let words = |c: &&PeakChange| Some(format!("{} {}", name(c)?, most(c)));
                let changed: Vec<String> = said.filter_map(words).collect();
                let [vertical, across] = [vertical_g, horizontal_g].map(|g| significant(*g, 3));
                let left_out =
                    format!("vertical motion ({vertical} g beside {across} g) is left out");
                match changed.is_empty() {
                    true if !until.is_empty() => left_out + &until,
                    true if changes.is_empty() || changes.iter().any(changes_it) => left_out,
                    true => format!(
                        "{left_out}: no displacement or force that is given changes by more \
                            than {}",
                        percent(LEAST_CHANGE)
                    ),
                    false => format!(
                        "vertical motion ({vertical} g) left out; with it{}: {}{until}",
                        if *checked { "" } else { " (unchecked)" },
                        changed.join(", ")
                    ),
                }
            }
            _ => return None,
        })
    }
}
