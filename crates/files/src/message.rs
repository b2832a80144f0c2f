//! What messages are made of: words of a user's file in one line, names in letters that can be
//! seen, shares in percent, quantities with engineering prefixes.

use std::borrow::Cow;

/// Longest piece that is quoted.
const LONGEST: usize = 200;

/// Whether a character steers a terminal or the reading direction of a page instead of showing:
/// control characters, marks without width, marks of direction, ends of lines and paragraphs, tags.
pub fn is_unprintable(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// A name as it can be shown anywhere in one line: characters that steer a terminal or a page are
/// spelt out, as `\u{1b}`.
pub fn printable(name: &str) -> Cow<'_, str> {
    spelt_out(name, is_unprintable)
}

/// The same of a text of several lines: ends of lines and tabs stay.
pub fn printable_lines(text: &str) -> Cow<'_, str> {
    spelt_out(text, |c| is_unprintable(c) && c != '\n' && c != '\t')
}

fn spelt_out(text: &str, unprintable: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&unprintable) {
        return Cow::Borrowed(text);
    }
    let spell =
        |c: char| if unprintable(c) { c.escape_default().to_string() } else { c.to_string() };
    Cow::Owned(text.chars().map(spell).collect())
}

/// The text without what [`printable`] spells out, cut if it is long.
pub fn one_line(text: &str) -> String {
    let mut short: String =
        text.chars().map(|c| if is_unprintable(c) { '?' } else { c }).take(LONGEST).collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push_str("...");
    }
    short
}

/// A text with other words in the place of an option, where it stands as a word: what is part of a
/// file's name, `site--dt.txt`, stays.
pub fn with_words_for(text: &str, option: &str, words: &str) -> String {
    let of_a_name =
        |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.' | '/' | '\\' | '~');
    let mut said = String::with_capacity(text.len());
    let mut from = 0;
    for (at, _) in text.match_indices(option) {
        let end = at + option.len();
        let mut after = text[end..].chars();
        // a point or a dash may end what is said
        let goes_on = match after.next() {
            Some('.' | '-' | '/') => after.next().is_some_and(of_a_name),
            next => next.is_some_and(of_a_name) && option.ends_with(of_a_name),
        };
        let begins = !text[..at].ends_with(of_a_name) || !option.starts_with(of_a_name);
        if begins && !goes_on {
            said += &text[from..at];
            said += words;
            from = end;
        }
    }
    said + &text[from..]
}

/// A share in percent, three digits: 0.0123 %, 4.57 %, 96.0 %. Beyond a thousand percent a number
/// says no more than that it is large.
pub fn percent(share: f64) -> String {
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

/// The same of a difference, with a plus where it is a number above zero.
pub fn signed_percent(share: f64) -> String {
    let text = percent(share);
    let sign = if share > 0.0 && text.starts_with(|c: char| c.is_ascii_digit()) { "+" } else { "" };
    format!("{sign}{text}")
}

/// A text of at most so many letters: a longer one loses its middle.
pub fn shortened(text: &str, most: usize) -> String {
    let letters: Vec<char> = text.chars().collect();
    if letters.len() <= most || most < 8 {
        return text.to_string();
    }
    let (head, tail) = ((most - 3) / 2, most - 3 - (most - 3) / 2);
    letters[..head].iter().collect::<String>()
        + "..."
        + &letters[letters.len() - tail..].iter().collect::<String>()
}

/// 10 with a raised exponent.
pub fn power_of_ten(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised: String = exponent
        .to_string()
        .chars()
        .map(|c| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]))
        .collect();
    format!("10{raised}")
}

/// x to so many significant digits.
pub fn rounded(x: f64, digits: usize) -> f64 {
    // a number that was printed can be read
    format!("{:.*e}", digits.saturating_sub(1), x).parse().unwrap_or(x)
}

/// x with at most so many significant digits, without zeros at the end of a fraction: 401.2, 0.1,
/// 1.725e16.
pub fn significant(x: f64, digits: usize) -> String {
    if x == 0.0 || !x.is_finite() {
        return if x == 0.0 { "0".into() } else { "-".into() };
    }
    let scientific = format!("{:.*e}", digits.saturating_sub(1), x);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trim = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => text.to_string(),
    };
    if (-4..6).contains(&exponent) {
        // rounded to the digits first: 123456 to four is 123500
        let x = rounded(x, digits);
        trim(&format!("{x:.*}", (digits as i32 - 1 - exponent).max(0) as usize))
    } else {
        format!("{}e{exponent}", trim(mantissa))
    }
}

/// A quantity with an engineering prefix and at most four significant digits: 20.35 MN m, 401.2 mm,
/// 680.1 t.
pub fn quantity(x: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 7] =
        [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "u"), (1e-9, "n")];
    let (x, unit, least) = match unit {
        // a tonne is what engineers weigh with; no prefix makes a microradian of a rotation
        "kg" if x.abs() >= 1e3 => return format!("{} t", significant(x * 1e-3, 4)),
        "kg" | "rad" => return format!("{} {unit}", significant(x, 4)),
        _ => (x, unit, 1e-9),
    };
    if x == 0.0 || !x.is_finite() {
        return format!("{} {unit}", significant(x, 4));
    }
    // rounding may carry: 999.97 N is 1 kN
    let size = rounded(x, 4).abs();
    let (factor, prefix) =
        PREFIXES.into_iter().find(|(factor, _)| size >= *factor).unwrap_or((least, "n"));
    format!("{} {prefix}{unit}", significant(x / factor, 4))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_stands_before_numbers_alone() {
        let all = [0.0126, -0.00529, 21.0, 1e-7].map(signed_percent);
        assert_eq!(all, ["+1.26 %", "-0.529 %", "more than 1000 %", "below 0.001 %"]);
    }

    #[test]
    fn long_paths_lose_their_middle() {
        assert_eq!(shortened("out/decks/model.py", 40), "out/decks/model.py");
        assert_eq!(shortened("a/very/long/way/to/a/file.json", 20), "a/very/l...file.json");
    }

    #[test]
    fn numbers_have_few_digits_and_prefixes() {
        let all = [401.1816, 0.1, 123456.0, 1.7248e16, 2.5e-7, -0.0999960, 0.0];
        let all = all.map(|x| significant(x, 4));
        assert_eq!(all, ["401.2", "0.1", "123500", "1.725e16", "2.5e-7", "-0.1", "0"]);
        assert_eq!(quantity(20.349e6, "N m"), "20.35 MN m");
        assert_eq!(quantity(0.40118, "m"), "401.2 mm");
        assert_eq!(quantity(-6.8023e6, "N"), "-6.802 MN");
        assert_eq!(quantity(999.97, "N"), "1 kN");
        assert_eq!(quantity(680.1e3, "kg"), "680.1 t");
        assert_eq!(quantity(0.0, "N"), "0 N");
    }

    #[test]
    fn shares_have_three_digits_or_words() {
        let all = [0.0, 4e-6, -2.34e-4, 0.0457, 0.96, 1.0, 12.0].map(percent);
        assert_eq!(
            all,
            [
                "below 0.001 %",
                "below 0.001 %",
                "-0.023 %",
                "4.57 %",
                "96.0 %",
                "100 %",
                "more than 1000 %"
            ]
        );
    }

    #[test]
    fn a_name_shows_what_would_steer_a_terminal_or_turn_a_page_around() {
        assert_eq!(printable("motion.at2"), "motion.at2");
        assert_eq!(printable("Kōbe ü 山"), "Kōbe ü 山");
        let hostile = "a\u{1b}[2Jb\u{7}c\nd\u{202e}e\u{2066}f\u{200f}g\u{feff}h\u{9b}";
        assert_eq!(
            printable(hostile),
            "a\\u{1b}[2Jb\\u{7}c\\nd\\u{202e}e\\u{2066}f\\u{200f}g\\u{feff}h\\u{9b}"
        );
        assert_eq!(printable_lines("a\n\tb\r"), "a\n\tb\\r");
        assert_eq!(one_line("a\u{202e}b"), "a?b");
    }

    #[test]
    fn an_option_is_replaced_where_it_is_a_word() {
        let said = |text| with_words_for(text, "--dt", "dt_s");
        assert_eq!(said("pass --dt, or (--dt) --dt."), "pass dt_s, or (dt_s) dt_s.");
        assert_eq!(said("site--dt.txt: drop --dt"), "site--dt.txt: drop dt_s");
        for name in ["--dt.txt", "a/--dt/b", "--dt-2", "x--dt", "--dtx"] {
            assert_eq!(said(name), name);
        }
        assert_eq!(with_words_for("3 (a; in a case file)", "; in a case file)", ")"), "3 (a)");
    }

    #[test]
    fn a_message_has_one_line_of_bounded_length() {
        assert_eq!(one_line("a\r\nb\u{7f}\u{85}"), "a??b??");
        assert_eq!(one_line(&"x".repeat(1000)).len(), LONGEST + 3);
    }
}
