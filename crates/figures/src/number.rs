//! Numbers as a reader wants them: a true minus sign, no "-0.0", metric prefixes, powers of ten.

use files::message::power_of_ten;

/// `x` with so many decimals, a typographic minus, and no sign on a zero.
pub(crate) fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    let magnitude = text.trim_start_matches('-');
    if magnitude.len() == text.len() || magnitude.bytes().all(|b| b == b'0' || b == b'.') {
        magnitude.to_string()
    } else {
        format!("−{magnitude}")
    }
}

/// `x` with so many significant digits, as 0.034 or 2.5 or 120; very large or small as 3.4·10⁻⁷.
pub fn short(x: f64, digits: usize) -> String {
    if x == 0.0 {
        return "0".into();
    }
    // Rounding may carry: 0.0996 to two digits is 0.10.
    let scientific = format!("{:.*e}", digits.saturating_sub(1), x.abs());
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        fixed(x, decimals)
    } else {
        let sign = if x < 0.0 { "−" } else { "" };
        format!("{sign}{mantissa}·{}", power_of_ten(exponent))
    }
}

/// `x` as [`short`] has it, without zeros at the end of a fraction: a bound someone chose, as 0.1
/// or 4.541.
pub fn brief(x: f64, digits: usize) -> String {
    let text = short(x, digits);
    if text.contains('.') && !text.contains('·') {
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        text
    }
}

/// A power of a thousand and its prefix, so that the largest value reads as 1 to 1000 (1 and "" for
/// zero).
pub fn prefix(largest: f64) -> (f64, &'static str) {
    const PREFIXES: [(f64, &str); 7] =
        [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "μ"), (1e-9, "n")];
    if largest <= 0.0 {
        return (1.0, "");
    }
    PREFIXES.into_iter().find(|(unit, _)| largest >= *unit).unwrap_or((1e-9, "n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zero_has_no_sign() {
        assert_eq!(fixed(-0.0, 1), "0.0");
        assert_eq!(fixed(-0.04, 1), "0.0");
        assert_eq!(fixed(-0.06, 1), "−0.1");
        assert_eq!(fixed(120.0, 0), "120");
    }

    #[test]
    fn short_numbers_keep_their_digits() {
        assert_eq!(short(0.0341, 2), "0.034");
        assert_eq!(short(0.0996, 2), "0.10");
        assert_eq!(short(401.18, 4), "401.2");
        assert_eq!(short(-2.5e-7, 2), "−2.5·10⁻⁷");
        assert_eq!(short(0.0, 3), "0");
    }

    #[test]
    fn brief_numbers_have_no_idle_zeros() {
        assert_eq!(brief(0.1, 4), "0.1");
        assert_eq!(brief(4.541, 4), "4.541");
        assert_eq!(brief(100.0, 2), "100");
        assert_eq!(brief(3.0, 4), "3");
    }

    #[test]
    fn prefixes_follow_the_largest_value() {
        assert_eq!(prefix(6.7e6), (1e6, "M"));
        assert_eq!(prefix(999.0), (1.0, ""));
        assert_eq!(prefix(0.02), (1e-3, "m"));
        assert_eq!(prefix(0.0), (1.0, ""));
    }

    #[test]
    fn exponents_are_raised() {
        assert_eq!(power_of_ten(-12), "10⁻¹²");
        assert_eq!(power_of_ten(3), "10³");
    }
}
