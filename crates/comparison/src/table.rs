//! Tables and times in words.

use comfy_table::{Table, presets};

/// A table for the terminal that is Markdown too.
pub(crate) fn table<const N: usize>(head: [&str; N], rows: Vec<[String; N]>) -> String {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header(head);
    table.add_rows(rows);
    table.to_string()
}

/// Three digits with a unit that suits.
pub(crate) fn time(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s >= 1.0 => (s, "s"),
        s if s >= 1e-3 => (s * 1e3, "ms"),
        s => (s * 1e6, "us"),
    };
    let decimals = 2_usize.saturating_sub(value.max(1.0).log10() as usize);
    format!("{value:.decimals$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_three_digits_and_a_unit_that_suits() {
        assert_eq!(time(91.4e-6), "91.4 us");
        assert_eq!(time(1.2345e-3), "1.23 ms");
        assert_eq!(time(12.3456), "12.3 s");
        assert_eq!(time(0.123), "123 ms");
    }
}
