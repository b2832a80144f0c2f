//! Warnings at the end of the screen, in the room that is left.

use std::cmp::Reverse;

use super::{LINES, lines::wrapped};
use crate::{Run, sentence};
use results::{FiledFinding, Finding, Weight};

/// What a warning begins with.
const WARNING: &str = "warning   ";
/// What changes a design the most is told first.
fn urgency(finding: &Finding) -> usize {
    match finding {
        // whether it stands, and where
        Finding::Sliding { .. } | Finding::SpringsForRestitution { .. } => 0,
        Finding::SinksOnSprings { .. } => 0,
        Finding::FeetMoved { .. } | Finding::WalksOnSprings { .. } => 1,
        Finding::SearchCut { .. } | Finding::IllConditioned { .. } => 1,
        Finding::VerticalLeftOut { .. } => 2,
        Finding::ForcesHeldInPart { .. }
        | Finding::ForcesOfCutoff { .. }
        | Finding::ForceWithheld { .. } => 4,
        _ => 5,
    }
}

/// A deck that ends early or is left out.
const DECK: usize = 3;

/// Whether it is about what was given, which is told at once.
pub(super) fn is_doubt(filed: &FiledFinding) -> bool {
    matches!(filed.finding, Finding::Doubt { .. })
}

/// Whether the line of the program says it already.
fn is_of_program(filed: &FiledFinding) -> bool {
    matches!(filed.finding, Finding::ProgramNotToBeUsed { .. } | Finding::ProgramStepTooLong { .. })
}

/// Whether it is about the program that the user asked for: this is told before what the screen
/// may have no room for.
fn is_of_asked(finding: &Finding) -> bool {
    matches!(
        finding,
        Finding::ProgramErrsOnEarthquakes { asked: true, .. }
            | Finding::ProgramSpread { asked: true, .. }
            | Finding::ProgramLoses { asked: true, .. }
    )
}

/// Whether the table of design forces says it already.
fn is_of_forces(run: &Run, filed: &FiledFinding) -> bool {
    run.design_forces.is_some() && matches!(filed.finding, Finding::ForceWithheld { .. })
}

/// A warning, and what to do. It is told in all its lines, or the report's line counts it.
pub(super) struct Warned {
    /// What its line begins with.
    name: &'static str,
    text: String,
}

impl Warned {
    /// A finding, its message and remedy as sentences.
    pub(super) fn of(name: &'static str, filed: &FiledFinding) -> Self {
        let remedy = filed.remedy.as_ref().map_or(String::new(), |r| format!(" {}", sentence(r)));
        Self { name, text: sentence(&filed.message) + &remedy }
    }

    /// Its lines.
    pub(super) fn lines(&self) -> Vec<String> {
        wrapped(self.name, &self.text)
    }
}

/// Warnings in words, the gravest first.
pub(super) fn warnings(run: &Run, of_decks: &[String]) -> Vec<Warned> {
    let told = |f: &FiledFinding| is_doubt(f) || is_of_program(f) || is_of_forces(run, f);
    let of_run = run.remarks().filter(|f| f.weight >= Weight::Warning && !told(f));
    let of_deck = |line: &String| {
        let (message, remedy) = line.split_once(": ").unwrap_or((line, ""));
        let remedy =
            if remedy.is_empty() { String::new() } else { format!(" {}", sentence(remedy)) };
        // a file's name stays as it is
        Warned { name: WARNING, text: format!("{message}.{remedy}") }
    };
    let grave = |filed: &FiledFinding| {
        let key = (Reverse(filed.weight), !is_of_asked(&filed.finding), urgency(&filed.finding));
        (key, Warned::of(WARNING, filed))
    };
    let decks = of_decks.iter().map(|line| ((Reverse(Weight::Warning), true, DECK), of_deck(line)));
    let mut all: Vec<_> = of_run.map(grave).chain(decks).collect();
    all.sort_by_key(|(key, _)| *key);
    all.into_iter().map(|(_, warned)| warned).collect()
}

/// Warnings in the room that is left, the last line for the report: those that fit as a whole.
/// Returns how many are left out.
pub(super) fn tell(warnings: &[Warned], lines: &mut Vec<String>) -> usize {
    let mut left_out = 0;
    for all in warnings.iter().map(Warned::lines) {
        if lines.len() + all.len() < LINES {
            lines.extend(all);
        } else {
            left_out += 1;
        }
    }
    left_out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Warnings of so many lines, below so many others: what is told of them, and how many are not.
    fn told(warnings: &[usize], taken: usize) -> (Vec<String>, usize) {
        let warned =
            |n: &usize| Warned { name: WARNING, text: "a word ".repeat(13 * n - 3).trim().into() };
        let all: Vec<Warned> = warnings.iter().map(warned).collect();
        assert!(all.iter().zip(warnings).all(|(warning, n)| warning.lines().len() == *n));
        let mut lines = vec![String::from("x"); taken];
        let left_out = tell(&all, &mut lines);
        (lines.split_off(taken), left_out)
    }

    #[test]
    fn what_a_structure_may_fail_by_is_told_first() {
        let sliding = Finding::Sliding {
            needed: 2.81,
            time_s: None,
            available: 0.5,
            press_over_weight: Some(0.209),
        };
        let feet = Finding::FeetMoved {
            aside_m: Some(0.85),
            apart_m: None,
            rocks_on_from_s: None,
            predictable: false,
        };
        let left_out = Finding::NearMotionsLeftOut { motions: 1, all: false };
        let force = Finding::ForcesAtRest { forces: Vec::new(), tied: false };
        let all = [sliding, feet, left_out, force].map(|finding| urgency(&finding));
        assert!(all[0] < all[1] && all[1] < all[2] && all[2] <= all[3], "{all:?}");
    }

    /// What is said of the program that was asked for stands before all that is as grave.
    #[test]
    fn what_the_program_asked_for_errs_is_told_first() {
        let errs = |asked| Finding::ProgramErrsOnEarthquakes {
            program: "SAP2000".into(),
            step_s: 0.002,
            median: Some(0.108),
            motions: 16,
            floor: 0.065,
            asked,
        };
        let sliding =
            Finding::Sliding { needed: 2.8, time_s: None, available: 0.5, press_over_weight: None };
        let all = [errs(true), errs(false), sliding].map(|finding| is_of_asked(&finding));
        assert_eq!(all, [true, false, false]);
        let key = |finding: &Finding| (!is_of_asked(finding), urgency(finding));
        let sliding =
            Finding::Sliding { needed: 2.8, time_s: None, available: 0.5, press_over_weight: None };
        assert!(key(&errs(true)) < key(&sliding) && key(&sliding) < key(&errs(false)));
    }

    #[test]
    fn a_warning_is_told_in_all_its_lines_or_counted() {
        let starts = |lines: &[String]| lines.iter().filter(|l| l.starts_with(WARNING)).count();
        for (room, lines, warnings) in [(9, 6, 3), (6, 6, 3), (5, 5, 2), (4, 4, 2), (3, 3, 1)] {
            let (some, left_out) = told(&[3, 2, 1], LINES - 1 - room);
            assert_eq!((some.len(), starts(&some), left_out), (lines, warnings, 3 - warnings));
            assert!(some.iter().all(|line| !line.ends_with("...")), "{some:?}");
        }
        // one that has no room leaves it to the next
        let (some, left_out) = told(&[3, 2, 1], LINES - 1 - 2);
        assert_eq!((some.len(), starts(&some), left_out), (2, 1, 2));
        assert_eq!(told(&[1], LINES), (Vec::new(), 1));
    }
}
