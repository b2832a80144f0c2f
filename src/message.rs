//! What messages are made of: words of a user's file in one line, names in letters that can be
//! seen, shares in percent.

use std::borrow::Cow;

/// Longest piece that is quoted.
const LONGEST: usize = 200;

/// Whether a character steers a terminal or the reading direction of a page instead of showing:
/// control characters, marks without width, marks of direction, ends of lines and paragraphs, tags.
pub(crate) fn is_unprintable(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// A name as it can be shown anywhere in one line: characters that steer a terminal or a page are
/// spelt out, as `\u{1b}`.
#[cfg_attr(not(feature = "cli"), allow(dead_code))]
pub(crate) fn printable(name: &str) -> Cow<'_, str> {
    spelt_out(name, is_unprintable)
}

/// The same of a text of several lines: ends of lines and tabs stay.
#[cfg_attr(not(feature = "cli"), allow(dead_code))]
pub(crate) fn printable_lines(text: &str) -> Cow<'_, str> {
    spelt_out(text, |c| is_unprintable(c) && c != '\n' && c != '\t')
}

fn spelt_out(text: &str, unprintable: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&unprintable) {
        return Cow::Borrowed(text);
    }
    let spell = |c: char| if unprintable(c) { c.escape_default().to_string() } else { c.to_string() };
    Cow::Owned(text.chars().map(spell).collect())
}

/// The text without what [`printable`] spells out, cut if it is long.
pub(crate) fn one_line(text: &str) -> String {
    let mut short: String = text.chars().map(|c| if is_unprintable(c) { '?' } else { c }).take(LONGEST).collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push_str("...");
    }
    short
}

/// A share in percent, three digits: 0.0123 %, 4.57 %, 96.0 %. Beyond a thousand percent a number
/// says no more than that it is large.
#[cfg(any(feature = "cli", test))]
pub(crate) fn percent(share: f64) -> String {
    let x = 100.0 * share;
    let size = x.abs();
    match size {
        _ if !x.is_finite() || size >= 1000.0 => "more than 1000 %".into(),
        _ if size >= 100.0 => format!("{x:.0} %"),
        _ if size >= 10.0 => format!("{x:.1} %"),
        _ if size >= 1.0 => format!("{x:.2} %"),
        _ if size >= 5e-4 => format!("{x:.3} %"),
        _ => "below 0.001 %".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_have_three_digits_or_words() {
        let all = [0.0, 4e-6, -2.34e-4, 0.0457, 0.96, 1.0, 12.0].map(percent);
        assert_eq!(
            all,
            ["below 0.001 %", "below 0.001 %", "-0.023 %", "4.57 %", "96.0 %", "100 %", "more than 1000 %"]
        );
    }

    #[test]
    fn a_name_shows_what_would_steer_a_terminal_or_turn_a_page_around() {
        assert_eq!(printable("motion.at2"), "motion.at2");
        assert_eq!(printable("Kōbe ü 山"), "Kōbe ü 山");
        let hostile = "a\u{1b}[2Jb\u{7}c\nd\u{202e}e\u{2066}f\u{200f}g\u{feff}h\u{9b}";
        assert_eq!(printable(hostile), "a\\u{1b}[2Jb\\u{7}c\\nd\\u{202e}e\\u{2066}f\\u{200f}g\\u{feff}h\\u{9b}");
        assert_eq!(printable_lines("a\n\tb\r"), "a\n\tb\\r");
        assert_eq!(one_line("a\u{202e}b"), "a?b");
    }

    #[test]
    fn a_message_has_one_line_of_bounded_length() {
        assert_eq!(one_line("a\r\nb\u{7f}\u{85}"), "a??b??");
        assert_eq!(one_line(&"x".repeat(1000)).len(), LONGEST + 3);
    }
}
