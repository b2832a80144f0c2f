//! Text in lines of a screen.

use super::WIDTH;
use files::message::shortened;

/// Letters of the longest unit that is kept with its number.
const LONGEST_UNIT: usize = 2;

/// The same as [`wrapped`], in so many lines: what does not fit is left out, by whole parts if the
/// last line keeps half of its letters.
pub(super) fn at_most(most: usize, lines: &mut Vec<String>, name: &str, text: &str) {
    let mut all = wrapped(name, text);
    if all.len() > most {
        all.truncate(most);
        if let Some(last) = all.last_mut() {
            // whole words
            while last.chars().count() > WIDTH - 4 {
                let Some(space) = last.trim_end().rfind(' ') else { break };
                last.truncate(space);
            }
            let part = last.rfind("; ").filter(|end| *end > WIDTH / 2);
            match part {
                Some(end) => last.replace_range(end + 1.., " ..."),
                None => *last = format!("{} ...", last.trim_end_matches([' ', ',', ';', ':'])),
            }
        }
    }
    lines.extend(all);
}

/// Parts of a list, in so many lines; where some do not fit, `rest` tells of them.
pub(super) fn parts_at_most(
    most: usize,
    lines: &mut Vec<String>,
    name: &str,
    parts: &[String],
    rest: &str,
) {
    let told = |shown: usize| {
        let rest = (shown < parts.len()).then(|| rest.to_string());
        let told: Vec<String> = parts[..shown].iter().cloned().chain(rest).collect();
        wrapped(name, &told.join("; "))
    };
    let fits = (1..=parts.len()).rev().map(told).find(|some| some.len() <= most);
    lines.extend(fits.unwrap_or_else(|| told(1)));
}

/// Text behind a name, its further lines below the text; words that do not fit a line are shortened
/// in the middle. A number keeps its unit.
pub(super) fn wrapped(name: &str, text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let indent = name.chars().count();
    let mut line = name.to_string();
    let mut empty = true;
    for word in with_units(text) {
        let word = shortened(&word, WIDTH - indent);
        let room = line.chars().count() + usize::from(!empty) + word.chars().count() <= WIDTH;
        if !room {
            lines.push(std::mem::replace(&mut line, " ".repeat(indent)));
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(&word);
        empty = false;
    }
    lines.push(line);
    lines
}

/// Words; a number and its unit are one.
fn with_units(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for word in text.split(' ') {
        let bare = word.trim_end_matches([',', ';', ':', '.', ')', '*']);
        let unit = |last: &String| {
            let of_number = last.ends_with(|c: char| c.is_ascii_digit())
                && bare.chars().count() <= LONGEST_UNIT
                && bare.starts_with(|c: char| c.is_alphabetic() || c == '%');
            of_number || (bare == "m" && last.ends_with('N'))
        };
        match words.last_mut().filter(|last| unit(last)) {
            Some(last) => {
                last.push(' ');
                last.push_str(word);
            }
            None => words.push(word.to_string()),
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_keeps_its_unit() {
        let words = with_units("moment 20.35 MN m at 5.2 s; 3.1 % of 24 motions");
        assert_eq!(words, ["moment", "20.35 MN m", "at", "5.2 s;", "3.1 %", "of", "24", "motions"]);
        let mut lines = wrapped("name  ", &format!("{} 1.946 s", "x".repeat(WIDTH - 12)));
        assert_eq!(lines[1], "      1.946 s");
        at_most(1, &mut lines, "", &"words ".repeat(30));
        assert!(lines[2].ends_with("words ...") && lines[2].chars().count() <= WIDTH);
        // cut where a part ends
        at_most(1, &mut lines, "", &format!("{}; {}", "x".repeat(60), "words ".repeat(30)));
        assert_eq!(lines[3], format!("{}; ...", "x".repeat(60)));
    }
}
