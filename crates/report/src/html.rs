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
    escape(&text)
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
    escape(&text)
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
}
