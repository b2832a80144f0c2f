//! Bytes to lines to numbers, as the programs that write records print them.

use std::borrow::Cow;

use super::RecordError;

/// A raised 2 in Latin-1 and in Windows' code page 1252.
const LATIN_1_SQUARED: u8 = 0xb2;

/// The file as text. Bytes that are not UTF-8 (station names in Latin-1) become replacement
/// characters, which no number survives, but for the power of m/s2; control characters mean that
/// this is no text at all.
pub(super) fn decode<'a>(file: &str, bytes: &'a [u8]) -> Result<Cow<'a, str>, RecordError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let bytes = bytes.strip_suffix(b"\x1a").unwrap_or(bytes); // DOS end-of-file mark
    let allowed =
        |b: u8| b >= 0x20 && b != 0x7f || matches!(b, b'\t' | b'\n' | b'\r' | 0x0b | 0x0c);
    match bytes.iter().position(|&b| !allowed(b)) {
        Some(byte) => Err(RecordError::Binary { file: file.to_owned(), byte, value: bytes[byte] }),
        None => Ok(match std::str::from_utf8(bytes) {
            Ok(text) => Cow::Borrowed(text),
            Err(_) => Cow::Owned(bytes.utf8_chunks().map(in_latin_1).collect()),
        }),
    }
}

/// A piece of a file that is not all UTF-8.
fn in_latin_1(chunk: std::str::Utf8Chunk) -> String {
    let other = match chunk.invalid() {
        [] => "",
        [LATIN_1_SQUARED] => "\u{b2}",
        _ => "\u{fffd}",
    };
    chunk.valid().to_owned() + other
}

/// Lines with their numbers from 1, without blanks around them; LF, CRLF or CR alone ends a line.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    raw_lines(text).enumerate().map(|(i, line)| (i + 1, line.trim()))
}

/// The first line that is not empty.
pub(super) fn first<'a>(head: &[&'a str]) -> &'a str {
    head.iter().copied().find(|line| !line.is_empty()).unwrap_or_default()
}

/// Whether at least two of some keys begin a line.
pub(super) fn begin_with_two(head: &[&str], keys: &[&str]) -> bool {
    keys.iter().filter(|key| head.iter().any(|line| line.starts_with(**key))).count() >= 2
}

/// Lines without blanks at their ends: where numbers stand in columns, blanks before them count.
pub(super) fn raw_lines(text: &str) -> impl Iterator<Item = &str> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    text.split(end).map(str::trim_end)
}

/// A number as C, Fortran (`.1E-02`, `1.0D-3`, `1.0-103`) or a spreadsheet prints it; NaN and
/// infinities pass.
pub(super) fn number(token: &str) -> Option<f64> {
    token.parse().ok().or_else(|| fortran(token))
}

fn fortran(token: &str) -> Option<f64> {
    if token.len() > 64 || !token.is_ascii() {
        return None;
    }
    if let Some(at) = token.find(['D', 'd', 'Q', 'q']) {
        return format!("{}e{}", &token[..at], &token[at + 1..]).parse().ok();
    }
    // An exponent of three digits pushes the letter E out of its field.
    let at = token.rfind(['+', '-'])?;
    let (mantissa, exponent) = token.split_at(at);
    let three_digits = exponent.len() == 4 && exponent[1..].bytes().all(|b| b.is_ascii_digit());
    (three_digits && mantissa.contains('.'))
        .then(|| format!("{mantissa}e{exponent}").parse().ok())?
}

/// The numbers of fixed-width fields that touch, `-.123-.456`: split before each sign that follows
/// a digit or a point, provided that every piece has a decimal point.
pub(super) fn touching(token: &str) -> Option<Vec<f64>> {
    let bytes = token.as_bytes();
    let cuts = (1..bytes.len()).filter(|&i| {
        matches!(bytes[i], b'+' | b'-') && (bytes[i - 1].is_ascii_digit() || bytes[i - 1] == b'.')
    });
    let mut numbers = Vec::new();
    let mut start = 0;
    for end in cuts.chain([bytes.len()]) {
        let piece = token.get(start..end)?;
        numbers.push(number(piece).filter(|_| piece.contains('.'))?);
        start = end;
    }
    Some(numbers)
}

/// How finely a number is printed: the power of ten of its last digit, and its significant digits.
pub(super) fn precision(token: &str) -> (i32, i32) {
    let (mantissa, exponent) = match token.find(['e', 'E', 'd', 'D']) {
        Some(at) => (&token[..at], token[at + 1..].parse().unwrap_or(0_i32).clamp(-400, 400)),
        None => (token, 0),
    };
    let decimals = mantissa.find('.').map_or(0, |at| mantissa.len() - at - 1);
    let significant =
        mantissa.bytes().filter(u8::is_ascii_digit).skip_while(|&b| b == b'0').count();
    (exponent - decimals.min(400) as i32, significant.min(400) as i32)
}

/// A piece of a file, fit for a message of one line.
pub(super) fn quote(text: &str) -> String {
    let mut short: String =
        text.chars().map(|c| if c.is_control() { '?' } else { c }).take(48).collect();
    if text.chars().nth(48).is_some() {
        short.push_str("...");
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fortran_numbers_are_read() {
        for (token, value) in [
            (".1E-02", 1e-3),
            ("-.1234567E-02", -1.234567e-3),
            ("1.0D-3", 1e-3),
            ("+1.", 1.0),
            ("0.1234567-102", 0.1234567e-102),
            ("1.5d+02", 150.0),
        ] {
            assert_eq!(number(token), Some(value), "{token}");
        }
        for token in ["", ".", "*******", "1,5", "1.0D", "1.0-10", "12-345", "--1", "1.0.0"] {
            assert_eq!(number(token), None, "{token}");
        }
    }

    #[test]
    fn touching_fields_are_cut_at_their_signs() {
        assert_eq!(touching("-.123-.456+1.5"), Some(vec![-0.123, -0.456, 1.5]));
        assert_eq!(touching("1.5E-03-2.5E-03"), Some(vec![1.5e-3, -2.5e-3]));
        assert_eq!(touching("1940-05-19"), None);
        assert_eq!(touching(""), None);
    }

    #[test]
    fn precision_is_that_of_the_printed_digits() {
        assert_eq!(precision("12.345"), (-3, 5));
        assert_eq!(precision("0.005"), (-3, 1));
        assert_eq!(precision("1.000E-02"), (-5, 4));
        assert_eq!(precision("7"), (0, 1));
    }

    #[test]
    fn lines_end_in_lf_crlf_or_cr() {
        for text in ["a\nb", "a\r\nb", "a\rb"] {
            assert_eq!(lines(text).collect::<Vec<_>>(), [(1, "a"), (2, "b")]);
        }
    }

    #[test]
    fn control_characters_mean_a_binary_file() {
        assert!(matches!(
            decode("x", b"ab\0c"),
            Err(RecordError::Binary { byte: 2, value: 0, .. })
        ));
        assert_eq!(decode("x", b"\xef\xbb\xbf1\x1a").unwrap(), "1");
        assert_eq!(decode("x", b"caf\xe9").unwrap(), "caf\u{fffd}");
        assert_eq!(decode("x", b"acc\xe9l\xe9ration (m/s\xb2)").unwrap().len(), 24);
        assert!(decode("x", b"acc\xe9l\xe9ration (m/s\xb2)").unwrap().ends_with(" (m/s\u{b2})"));
    }
}
