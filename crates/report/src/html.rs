//! Pieces of a page: escaped text, tables, the field's letters for names that files spell out.

use std::fmt::Write;

use super::Table;
use files::message::{power_of_ten, printable_lines};

/// Text that can stand in a page; characters that would turn it around are spelt out.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in printable_lines(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// The same with letters in place of what files and terminals spell out, and numbers with a true
/// exponent.
pub(crate) fn pretty(text: &str) -> String {
    const LETTERS: [(&str, &str); 14] = [
        ("Omega_n / 2 pi", "Ωₙ/2π"),
        ("Omega_n", "Ωₙ"),
        ("theta/alpha", "θ/α"),
        ("m R^2/I0", "mR²/I₀"),
        ("g tan alpha", "g tan α"),
        ("alpha", "α"),
        ("ratio mu = m2/m1", "ratio μ = m₂/m₁"),
        ("damping ratio xi", "damping ratio ξ"),
        ("k1 [", "k₁ ["),
        ("k2 [", "k₂ ["),
        ("m2 [", "m₂ ["),
        ("m2 is", "m₂ is"),
        ("N s/m", "N·s/m"),
        ("<=", "≤"),
    ];
    let text =
        LETTERS.iter().fold(text.to_string(), |text, (spelt, letter)| text.replace(spelt, letter));
    unbroken(&escape(&text))
}

/// Escaped text whose quantities no line's end parts: neither a number from its unit, nor a unit
/// at a blank or a slash.
pub(crate) fn unbroken(escaped: &str) -> String {
    let words: Vec<&str> = escaped.split(' ').collect();
    let (mut out, mut at): (Vec<String>, usize) = (Vec::new(), 0);
    while let Some(rest) = words.get(at..).filter(|rest| !rest.is_empty()) {
        let length = length_of_quantity(rest);
        let text = rest[..length.max(1)].join(" ");
        out.push(match length {
            0 => text,
            _ => format!("<span class=\"q\">{text}</span>"),
        });
        at += length.max(1);
    }
    out.join(" ")
}

/// Words of the quantity, or of the unit in brackets, that these begin with; 0 of none.
fn length_of_quantity(words: &[&str]) -> usize {
    let bare = |word: &str| word.trim_end_matches([',', '.', ';', ':', ')', '*']).to_string();
    match words {
        [head, ..] if head.starts_with('[') && bare(head).ends_with(']') => 1,
        // "MN m", "N s/m", "kg m2"; nothing goes on after a comma
        [head, unit, more, ..] if is_number(head) && is_unit(unit) && is_unit(&bare(more)) => 3,
        [head, unit, ..] if is_number(head) && is_unit(&bare(unit)) => 2,
        _ => 0,
    }
}

fn is_number(word: &str) -> bool {
    let digits = word.trim_start_matches(['(', '+', '-', '−']);
    let power = |c: char| "·⁻⁰¹²³⁴⁵⁶⁷⁸⁹".contains(c);
    digits.starts_with(|c: char| c.is_ascii_digit())
        && digits.chars().all(|c| c.is_ascii_digit() || ".e-+".contains(c) || power(c))
}

/// Whether a word is a unit, with a prefix or without: "MN/m", "m/s2", "%", "1/s".
fn is_unit(word: &str) -> bool {
    let part = |part: &str| {
        let base = part.trim_end_matches(['2', '²', '3', '³']);
        let of = |base: &str| ["m", "s", "N", "g", "Hz", "rad"].contains(&base);
        let prefixed = base.strip_prefix(['T', 'G', 'M', 'k', 'm', 'u', 'n']);
        of(base) || prefixed.is_some_and(of) || ["%", "°", "t", "cm"].contains(&base)
    };
    let above = word.strip_prefix("1/").unwrap_or(word);
    above.split(['/', '·']).all(part)
}

/// 2.7337e15 as 2.7337·10¹⁵; anything else as it is.
pub(crate) fn number(text: &str) -> String {
    let power = |(digits, exponent): (&str, &str)| -> Option<String> {
        let (digits, exponent) =
            (digits.parse::<f64>().ok().map(|_| digits)?, exponent.parse::<i32>().ok()?);
        Some(format!("{digits}·{}", power_of_ten(exponent)))
    };
    let text = text.split_once('e').and_then(power).unwrap_or_else(|| text.to_string());
    let text =
        if text.starts_with('-') && text.len() > 1 { text.replacen('-', "−", 1) } else { text };
    unbroken(&escape(&text))
}

/// A table; columns in `own` stand out.
pub(crate) fn table(of: &Table, own: std::ops::Range<usize>) -> String {
    let class = |i: usize| if own.contains(&i) { " class=\"own\"" } else { "" };
    let facts = of.head.iter().all(String::is_empty);
    let mut out =
        format!("<div class=\"scroll\"><table{}>", if facts { " class=\"facts\"" } else { "" });
    if !facts {
        out.push_str("<thead><tr>");
        for (i, cell) in of.head.iter().enumerate() {
            // writing to a String cannot fail
            let _ = write!(out, "<th{}>{}</th>", class(i), pretty(cell));
        }
        out.push_str("</tr></thead>");
    }
    out.push_str("<tbody>\n");
    for row in &of.rows {
        out.push_str("<tr>");
        for (i, cell) in row.iter().enumerate() {
            let text = if i == 0 { pretty(cell.trim_start()) } else { number(cell) };
            let _ = write!(out, "<td{}>{text}</td>", class(i));
        }
        out.push_str("</tr>\n");
    }
    out + "</tbody></table></div>\n"
}

/// A number beside what it is.
pub(crate) fn tile(value: &str, what: &str) -> String {
    format!("<div class=\"tile\"><b>{}</b><span>{}</span></div>\n", pretty(value), pretty(what))
}

/// JSON inside a page: no tag can begin in it.
pub(crate) fn in_html(json: &str) -> String {
    json.replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_others_cannot_be_markup() {
        assert_eq!(escape("<script>\"&\u{7}"), "&lt;script&gt;&quot;&amp;\\u{7}");
        assert_eq!(in_html("\"</script>\""), "\"\\u003c/script>\"");
        let rows = Table::new(["a<b"]).with([vec!["<i>".to_string()]]);
        assert!(!table(&rows, 0..0).contains("<i>"));
    }

    #[test]
    fn numbers_and_names_read_as_in_a_paper() {
        assert_eq!(number("2.7337e15"), "2.7337·10¹⁵");
        assert_eq!(number("-0.5"), "−0.5");
        assert_eq!(number("the"), "the");
        assert_eq!(pretty("peak theta/alpha 0.066 at Omega_n"), "peak θ/α 0.066 at Ωₙ");
    }

    #[test]
    fn no_line_ends_within_a_quantity() {
        let whole = |text: &str| format!("<span class=\"q\">{text}</span>");
        for text in [
            "27 MN m,",
            "85.42 MN/m",
            "49.94 1/s",
            "(1.5 %)",
            "7.93e8 N·s/m",
            "2.73·10¹⁵ N/m.",
            "14550 kg m2",
            "0.9922 g;",
            "[N·s/m]",
            "-0.529 %",
            "1835 t",
            "0.5 m/s2",
        ] {
            assert_eq!(unbroken(text), whole(text));
        }
        assert_eq!(unbroken("at 5.4 s, mu 2"), format!("at {} mu 2", whole("5.4 s,")));
        assert_eq!(unbroken("5.4 s m2"), whole("5.4 s m2"));
        for text in ["24 motions", "SAP2000 at once", "2 of 64", "HHT alpha -1/3", "", " a  b "] {
            assert_eq!(unbroken(text), text);
        }
    }
}
