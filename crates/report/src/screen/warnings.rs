//! Warnings at the end of the screen, in the room that is left.

use super::{
    LINES,
    lines::{at_most, wrap},
};
use crate::{Run, sentence};
use results::{FiledFinding, Finding, Weight};

/// What a warning begins with.
const WARNING: &str = "warning   ";
/// Lines that one warning may take.
const LONGEST_WARNING: usize = 3;
/// Letters of a message that a remedy leaves of it at least.
const LEAST_MESSAGE: usize = 34;

/// What changes a design the most is told first.
fn urgency(finding: &Finding) -> usize {
    match finding {
        Finding::SearchCut { .. } | Finding::IllConditioned { .. } => 0,
        Finding::Sliding { .. } => 1,
        Finding::VerticalLeftOut { .. } => 2,
        Finding::ForcesHeldInPart { .. }
        | Finding::ForcesOfCutoff { .. }
        | Finding::ForceWithheld { .. } => 4,
        Finding::FeetApart { .. } => DECK,
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

/// Whether the table of design forces says it already.
fn is_of_forces(run: &Run, filed: &FiledFinding) -> bool {
    run.design_forces.is_some() && matches!(filed.finding, Finding::ForceWithheld { .. })
}

/// A warning, and what to do.
pub(super) struct Warned {
    /// What its line begins with.
    name: &'static str,
    message: String,
    remedy: String,
    /// Whether it is not to be cut: it is told in all its lines, or the report's line counts it.
    whole: bool,
}

impl Warned {
    /// A finding, its message and remedy as sentences.
    pub(super) fn of(name: &'static str, filed: &FiledFinding) -> Self {
        Self {
            name,
            message: sentence(&filed.message),
            remedy: filed.remedy.as_ref().map_or(String::new(), |r| format!(" {}", sentence(r))),
            whole: true,
        }
    }

    /// Lines that it may take.
    pub(super) fn most(&self) -> usize {
        if self.whole { LINES } else { LONGEST_WARNING }
    }

    /// Lines that it needs.
    pub(super) fn least_lines(&self) -> usize {
        if self.whole { warning_lines(self) } else { 1 }
    }

    /// In so many lines: what does not fit is left out of the message, so that the remedy stays,
    /// unless that takes most of them.
    pub(super) fn in_lines(&self, most: usize) -> Vec<String> {
        let mut all = Vec::new();
        wrap(&mut all, self.name, &format!("{}{}", self.message, self.remedy));
        if all.len() <= most {
            return all;
        }
        // words are wrapped at spaces, so that a line may stay shorter than it could be
        let short = (1..self.message.split(' ').count()).rev().find_map(|words| {
            let kept: Vec<&str> = self.message.split(' ').take(words).collect();
            let whole = kept.last().is_none_or(|last| ends_a_part(last));
            let kept = kept.join(" ");
            let kept = kept.trim_end_matches([',', ';', ':']);
            let enough = kept.chars().count() >= self.remedy.chars().count().min(LEAST_MESSAGE);
            let mut some = Vec::new();
            wrap(&mut some, self.name, &format!("{kept} ...{}", self.remedy));
            (whole && enough && some.len() <= most).then_some(some)
        });
        short.unwrap_or_else(|| {
            let mut some = Vec::new();
            at_most(most, &mut some, self.name, &format!("{}{}", self.message, self.remedy));
            some
        })
    }
}

/// Whether a message may be cut behind a word: not behind a number without its unit, nor a word
/// that wants another.
fn ends_a_part(word: &str) -> bool {
    const WANTS: [&str; 22] = [
        "a", "an", "and", "are", "at", "by", "far", "from", "how", "in", "is", "it", "more", "not",
        "of", "on", "so", "than", "the", "to", "with", "within",
    ];
    !word.ends_with(|c: char| c.is_ascii_digit()) && !WANTS.contains(&word)
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
        Warned { name: WARNING, message: format!("{message}."), remedy, whole: true }
    };
    let grave = |filed: &FiledFinding| {
        let key = (std::cmp::Reverse(filed.weight), urgency(&filed.finding));
        (key, Warned::of(WARNING, filed))
    };
    let decks =
        of_decks.iter().map(|line| ((std::cmp::Reverse(Weight::Warning), DECK), of_deck(line)));
    let mut all: Vec<_> = of_run.map(grave).chain(decks).collect();
    all.sort_by_key(|(key, _)| *key);
    all.into_iter().map(|(_, warned)| warned).collect()
}

/// Lines that a warning wants.
pub(super) fn warning_lines(warning: &Warned) -> usize {
    warning.in_lines(warning.most()).len()
}

/// Warnings in the room that is left, the last line for the report: each has one line before any
/// has a second. Returns how many are left out.
pub(super) fn tell(warnings: &[Warned], lines: &mut Vec<String>) -> usize {
    let room = (LINES - 1).saturating_sub(lines.len());
    let mut left = room;
    // what each needs, as far as there is room: those that are not to be cut need all
    let needs = |warning: &Warned| {
        let least = match warning.least_lines() {
            all if warning.whole && all > left => 0,
            some => some.min(left),
        };
        left -= least;
        least
    };
    let mut given: Vec<usize> = warnings.iter().map(needs).collect();
    let told = given.iter().filter(|lines| **lines > 0).count();
    left = room - given.iter().sum::<usize>();
    for most in 2..=LONGEST_WARNING {
        for (given, warning) in given.iter_mut().zip(warnings) {
            if left > 0 && (1..most).contains(given) && warning_lines(warning) >= most {
                *given += 1;
                left -= 1;
            }
        }
    }
    for (most, warning) in given.into_iter().zip(warnings).filter(|(most, _)| *most > 0) {
        lines.extend(warning.in_lines(most));
    }
    warnings.len() - told
}

#[cfg(test)]
mod tests {
    use super::{super::WIDTH, *};

    fn told(warnings: &[usize], taken: usize) -> (Vec<String>, usize) {
        let warned = |n: &usize| Warned {
            whole: false,
            name: WARNING,
            message: "a word ".repeat(13 * n - 3),
            remedy: String::new(),
        };
        let all: Vec<Warned> = warnings.iter().map(warned).collect();
        let mut lines = vec![String::from("x"); taken];
        let left_out = tell(&all, &mut lines);
        (lines.split_off(taken), left_out)
    }

    #[test]
    fn a_message_gives_way_to_its_remedy() {
        let warned = Warned {
            whole: false,
            name: WARNING,
            message: "a word ".repeat(30),
            remedy: " Do this: --that.".into(),
        };
        assert_eq!(warned.in_lines(3).len(), 3);
        for lines in [1, 2] {
            let some = warned.in_lines(lines);
            assert!(some.len() == lines && some[lines - 1].ends_with("... Do this: --that."));
            assert!(some.iter().all(|line| line.chars().count() <= WIDTH));
        }
        // a remedy that leaves no room for what it is for is cut like the message
        let long = Warned {
            whole: false,
            name: WARNING,
            message: "a word ".repeat(30),
            remedy: " many words".repeat(8),
        };
        assert!(long.in_lines(1)[0].starts_with("warning   a word a word"));
        assert!(long.in_lines(1)[0].ends_with(" ..."));
    }

    #[test]
    fn each_warning_has_one_line_before_any_has_a_second() {
        let starts = |lines: &[String]| lines.iter().filter(|l| l.starts_with(WARNING)).count();
        let (all, left_out) = told(&[3, 2, 1], 20);
        assert_eq!((all.len(), starts(&all), left_out), (6, 3, 0));
        let (some, _) = told(&[3, 2, 1], LINES - 5);
        assert_eq!((some.len(), starts(&some)), (4, 3));
        assert!(some[1].starts_with(' ') && some[1].ends_with("...") && some[2].ends_with("..."));
        let (few, left_out) = told(&[3, 2, 1], LINES - 2);
        assert_eq!((few.len(), left_out), (1, 2));
        assert_eq!(told(&[1], LINES), (Vec::new(), 1));
    }
}
