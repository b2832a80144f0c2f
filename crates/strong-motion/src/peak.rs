//! What a header says of its own peak, and whether the samples have it: the test that a file was
//! read as it was meant.

use serde::Serialize;

use super::RecordError;
use super::fortran::{Block, half_digit};
use super::text::number;

/// A header's number in single precision is off by this much of itself.
const SINGLE: f64 = 1.2e-7;

/// A peak and its time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Peak {
    /// In the unit that its owner names; with its sign where the file gives one.
    pub value: f64,
    /// Its time (s), if the file says it.
    #[serde(rename = "time_s")]
    pub time: Option<f64>,
}

impl Peak {
    /// The largest |a_i| of even samples, with its sign.
    pub(super) fn of(values: &[f64], dt: f64) -> Self {
        let mut at = 0;
        for (i, value) in values.iter().enumerate() {
            if value.abs() > values[at].abs() {
                at = i;
            }
        }
        Self { value: values.get(at).copied().unwrap_or(0.0), time: Some(at as f64 * dt) }
    }

    pub(super) fn times(self, factor: f64) -> Self {
        Self { value: self.value * factor, ..self }
    }
}

/// When the samples are, on the clock of their header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clock {
    /// Time of the first sample (s).
    pub start: f64,
    pub dt: f64,
}

impl Clock {
    /// The clock starts with the first sample.
    pub(super) fn from_first(dt: f64) -> Self {
        Self { start: 0.0, dt }
    }
}

/// A peak as a header prints it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stated<'a> {
    /// The line it stands on.
    pub line: usize,
    /// What it is the peak of: acceleration, velocity, displacement.
    pub of: &'static str,
    pub value: &'a str,
    pub time: Option<&'a str>,
    /// Whether the sign counts: some networks print the absolute value.
    pub signed: bool,
}

impl<'a> Stated<'a> {
    /// From the words of a line: the number after `name`, the number after "at".
    pub(super) fn find(line: usize, of: &'static str, words: &'a str, name: &str) -> Option<Self> {
        let mut tokens = words
            .split(|c: char| c.is_whitespace() || c == '=' || c == ',')
            .filter(|token| !token.is_empty());
        tokens.by_ref().find(|token| token.eq_ignore_ascii_case(name))?;
        let value = tokens.by_ref().find(|token| number(token).is_some())?;
        let time = tokens
            .by_ref()
            .find(|token| token.eq_ignore_ascii_case("at"))
            .and_then(|_| tokens.find(|token| number(token).is_some()));
        Some(Self { line, of, value, time, signed: true })
    }

    /// The peak, if the samples have it: its value to half of the last digit printed here and
    /// there, its time to one sample.
    pub(super) fn check(
        &self,
        file: &str,
        clock: Clock,
        block: &Block,
    ) -> Result<Peak, RecordError> {
        self.check_values(file, clock, &block.values, |i| block.half_digit(i))
    }

    /// The same for values that are known to `half_digit(i)`.
    pub(super) fn check_values(
        &self,
        file: &str,
        Clock { start, dt }: Clock,
        values: &[f64],
        half_digit_of: impl Fn(usize) -> f64,
    ) -> Result<Peak, RecordError> {
        let value = number(self.value).unwrap_or(f64::NAN);
        let time = self.time.and_then(number);
        let tolerance = |i: usize| {
            half_digit(significant(self.value)) + half_digit_of(i) + SINGLE * value.abs()
        };
        let same_size = |i: usize| (values[i].abs() - value.abs()).abs() <= tolerance(i);
        let same = |i: usize| same_size(i) && (!self.signed || values[i] * value >= 0.0);
        let found = Peak::of(values, dt);
        let largest = (found.time.unwrap_or(0.0) / dt).round() as usize;
        // the peak may be reached more than once; the header names one of these
        let near = |i: usize| {
            time.is_none_or(|t| (start + i as f64 * dt - t).abs() <= self.time_tolerance(dt))
        };
        if value.is_finite()
            && largest < values.len()
            && same_size(largest)
            && (0..values.len()).any(|i| near(i) && same(i))
        {
            return Ok(Peak { value, time });
        }
        // a number of a broken file may have three hundred digits
        let long = |x: f64, digits: usize| {
            if x.abs() < 1e9 { format!("{x:.digits$}") } else { format!("{x:.digits$e}") }
        };
        let at =
            |time: Option<f64>| time.map_or(String::new(), |t| format!(" at {} s", long(t, 4)));
        Err(RecordError::Peak {
            file: file.to_owned(),
            line: self.line,
            of: self.of,
            said: format!("{}{}", self.value, at(time)),
            found: format!("{}{}", long(found.value, 7), at(found.time.map(|t| start + t))),
        })
    }

    /// One sample and half of the last digit of the printed time (s); the last term is rounding.
    fn time_tolerance(&self, dt: f64) -> f64 {
        dt + self.time.map_or(0.0, half_digit) + 1e-9
    }
}

/// A printed number without the zeros that fill its field: `-161.962000` was written where three
/// decimals were known.
fn significant(printed: &str) -> &str {
    match printed.find('.') {
        Some(point) if printed[point + 1..].bytes().all(|b| b.is_ascii_digit()) => {
            let least = (point + 4).min(printed.len());
            &printed[..printed.trim_end_matches('0').len().max(least)]
        }
        _ => printed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_that_fill_a_field_are_no_digits() {
        for (printed, digits) in [
            ("-161.962000", "-161.962"),
            ("-6.851512", "-6.851512"),
            ("82.500", "82.500"),
            ("7.000000", "7.000"),
            ("1.5", "1.5"),
            ("-11026", "-11026"),
            ("1.50000E+00", "1.50000E+00"),
        ] {
            assert_eq!(significant(printed), digits);
        }
    }

    fn check(stated: &Stated, values: &[f64]) -> Result<Peak, RecordError> {
        stated.check_values("x", Clock::from_first(0.02), values, |_| 0.0)
    }

    #[test]
    fn peaks_are_found_in_the_lines_of_headers() {
        for (line, name, value, time) in [
            (
                "Acceleration:  peak  -9733.1 mm/s/s at  44.88 sec     rms    719.0 mm/s/s",
                "peak",
                "-9733.1",
                "44.88",
            ),
            (
                "Peak acceleration =    82.584    cm/sec/sec  at   14.840   sec.",
                "acceleration",
                "82.584",
                "14.840",
            ),
            (
                "Peak displacement =     -.836        cm      at   17.580   sec.",
                "displacement",
                "-.836",
                "17.580",
            ),
        ] {
            let stated = Stated::find(1, "acceleration", line, name).unwrap();
            assert_eq!((stated.value, stated.time), (value, Some(time)), "{line}");
        }
        assert!(Stated::find(1, "velocity", "Velocity record unevaluated", "peak").is_none());
    }

    #[test]
    fn value_time_and_sign_must_be_the_header_s() {
        let values = [0.0, 1.0, -2.04, 2.04, 0.5];
        let stated =
            |value, time, signed| Stated { line: 3, of: "acceleration", value, time, signed };
        assert_eq!(
            check(&stated("-2.0", Some("0.04"), true), &values),
            Ok(Peak { value: -2.0, time: Some(0.04) })
        );
        assert!(check(&stated("2.0", Some("0.06"), true), &values).is_ok());
        assert!(check(&stated("2.0", None, false), &values).is_ok());
        // one sample off, as headers that count from dt are
        assert!(check(&stated("-2.04", Some("0.060"), true), &values).is_ok());
        for (value, time) in
            [("2.1", None), ("-2.0", Some("0.10")), ("2.0", Some("0.02")), ("-2.046", None)]
        {
            assert!(check(&stated(value, time, true), &values).is_err(), "{value} {time:?}");
        }
        let message =
            check(&stated("3.5", Some("0.04"), true), &[0.0, 8e300]).unwrap_err().to_string();
        assert!(message.contains("8.0000000e300") && message.len() < 400, "{message}");
        let message = check(&stated("3.5", Some("0.04"), true), &values).unwrap_err().to_string();
        assert!(
            message.contains("line 3")
                && message.contains("3.5 at 0.0400 s")
                && message.contains("-2.04"),
            "{message}"
        );
    }
}
