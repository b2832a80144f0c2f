//! PEER AT2: title lines, a line with NPTS and DT in one of two forms, then the samples, any number
//! to a line.
//!
//! ```text
//! ACCELERATION TIME HISTORY IN UNITS OF G
//! NPTS=  3995, DT= .01000 SEC                  or:   4164  0.0100  NPTS, DT
//!  -6.4031800E-03 -6.0287100E-03  5.3042000E-04
//! ```

use super::parsed::{Parsed, Samples};
use super::text::{lines, number, precision, quote, touching};
use super::{RecordError, header, units};

/// How far down the line with NPTS may stand.
const HEADER_LINES: usize = 50;

/// The line with NPTS, unless a comment mark says that the file is a table with a header of its
/// own.
pub(super) fn header_line(text: &str) -> Option<(usize, &str)> {
    lines(text)
        .take(HEADER_LINES)
        .find(|(_, line)| {
            line.split(|c: char| !c.is_alphanumeric()).any(|word| word.eq_ignore_ascii_case("NPTS"))
        })
        .filter(|(_, line)| !header::is_comment(line))
}

/// The samples below the header line, in the file's own unit.
pub(super) fn parse(file: &str, text: &str) -> Result<Parsed, RecordError> {
    let file = || file.to_owned();
    let (at, header) = header_line(text).ok_or_else(|| RecordError::NoHeader { file: file() })?;
    let bad_header = || RecordError::BadHeader { file: file(), line: at, text: quote(header) };
    let (npts, dt) = npts_and_dt(header).ok_or_else(bad_header)?;
    let step = number(dt).filter(|dt| *dt > 0.0 && dt.is_finite()).ok_or_else(bad_header)?;
    let titles: Vec<_> = lines(text).take(at).collect();

    let mut values = Vec::new();
    let mut last = at;
    for (line, content) in lines(text).skip(at) {
        for token in
            content.split(|c: char| c.is_whitespace() || c == ',').filter(|token| !token.is_empty())
        {
            let before = values.len();
            match number(token) {
                Some(value) => values.push(value),
                None => values.extend(touching(token).ok_or_else(|| RecordError::NotANumber {
                    file: file(),
                    line,
                    text: quote(token),
                })?),
            }
            if values[before..].iter().any(|value| !value.is_finite()) {
                return Err(RecordError::NotFinite { file: file(), line, text: quote(token) });
            }
            last = line;
        }
    }
    if values.len() as u64 != npts {
        return Err(RecordError::Count {
            file: file(),
            line: last,
            found: values.len(),
            header_line: at,
            npts,
        });
    }
    let samples = Samples {
        units: units::declared(&titles, None),
        quantity: header::quantity(&titles, &[]),
        dt: Some(step),
        dt_rounding: 0.5 * 10_f64.powi(precision(dt).0),
        values,
        ..Samples::default()
    };
    Ok(Parsed::bare(samples))
}

/// NPTS and the printed DT: each number after its name, or else the first two numbers of the line.
fn npts_and_dt(line: &str) -> Option<(u64, &str)> {
    let tokens: Vec<&str> = line
        .split(|c: char| c.is_whitespace() || matches!(c, ',' | '=' | ':' | ';' | '(' | ')'))
        .filter(|token| !token.is_empty())
        .collect();
    let numeric = |token: &'_ str| number(token).is_some();
    let after = |name: &str| {
        let at = tokens.iter().position(|token| token.eq_ignore_ascii_case(name))?;
        tokens
            .get(at + 1)
            .map(|token| token.trim_end_matches(|c: char| c.is_ascii_alphabetic()))
            .filter(|t| numeric(t))
    };
    let (npts, dt) = match (after("NPTS"), after("DT")) {
        (Some(npts), Some(dt)) => (npts, dt),
        _ => {
            let mut numbers = tokens.iter().copied().filter(|token| numeric(token));
            (numbers.next()?, numbers.next()?)
        }
    };
    let npts = number(npts).filter(|n| n.fract() == 0.0 && (1.0..=1e12).contains(n))?;
    Some((npts as u64, dt))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_of_the_header_line_is_read() {
        for (line, npts, dt) in [
            ("NPTS= 4000, DT= .01000 SEC", 4000, ".01000"),
            ("NPTS=  7990, DT=   .0050 SEC, ", 7990, ".0050"),
            ("4164 0.0100 NPTS, DT", 4164, "0.0100"),
            ("   5437    .0050000   NPTS, DT (SEC)", 5437, ".0050000"),
            ("NPTS=4000, DT=.01 SEC,", 4000, ".01"),
            ("NPTS=4000,DT=.01SEC", 4000, ".01"),
            ("npts: 4000 dt: 1.0E-02", 4000, "1.0E-02"),
            ("NPTS, DT = 4000, 0.01", 4000, "0.01"),
        ] {
            assert_eq!(npts_and_dt(line), Some((npts, dt)), "{line}");
        }
        for line in [
            "NPTS, DT",
            "NPTS= 4000",
            "NPTS= 0, DT= .01",
            "NPTS= 3.5, DT= .01",
            "NPTS= -4, DT= .01",
        ] {
            assert_eq!(npts_and_dt(line), None, "{line}");
        }
    }
}
