//! Words of a user's file, fit for a message of one line.

/// Longest piece that is quoted.
const LONGEST: usize = 200;

/// The text without control characters, cut if it is long.
pub(crate) fn one_line(text: &str) -> String {
    let mut short: String = text.chars().map(|c| if c.is_control() { '?' } else { c }).take(LONGEST).collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push_str("...");
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_has_one_line_of_bounded_length() {
        assert_eq!(one_line("a\r\nb\u{7f}\u{85}"), "a??b??");
        assert_eq!(one_line(&"x".repeat(1000)).len(), LONGEST + 3);
    }
}
