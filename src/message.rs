//! What messages are made of: words of a user's file in one line, shares in percent.

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

/// A share in percent, three digits: 0.0123 %, 4.57 %, 96.0 %. Beyond a thousand percent a number says no more than that it is large.
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
    fn a_message_has_one_line_of_bounded_length() {
        assert_eq!(one_line("a\r\nb\u{7f}\u{85}"), "a??b??");
        assert_eq!(one_line(&"x".repeat(1000)).len(), LONGEST + 3);
    }
}
