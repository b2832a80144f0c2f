//! K-NET and KiK-net, Japan (NIED): 17 lines of header, then whole numbers, eight to a line, one
//! component a file.
//!
//! ```text
//! Sampling Freq(Hz) 100Hz
//! Scale Factor      3920(gal)/6182761
//! Max. Acc. (gal)   48.060
//! Memo.
//!     8009     9006     7998     8001     8009     8007     8002     8005
//! ```
//!
//! The acceleration is the numbers times the scale factor, less their mean over the whole record;
//! the header's largest acceleration is that of the result, without its sign.

use super::fortran::Cursor;
use super::parsed::{Channel, Parsed, Samples, mean};
use super::peak::{Clock, Stated};
use super::text::{self, number, quote};
use super::{Direction, RecordError, RecordFormat, Units};

/// Words that lines of the header begin with.
const KEYS: [&str; 6] =
    ["Sampling Freq", "Scale Factor", "Max. Acc.", "Max Acc.", "Station Code", "Last Correction"];
/// Numbers to a line.
const PER_LINE: usize = 8;
/// How far down the header may reach.
const HEADER_LINES: usize = 30;

/// Whether the first lines are those of a K-NET file.
pub(super) fn is_it(head: &[&str]) -> bool {
    text::begin_with_two(head, &KEYS)
}

/// The one component.
pub(super) fn parse(file: &str, text: &str) -> Result<Parsed, RecordError> {
    let mut cursor = Cursor::new(file, RecordFormat::KNet, text);
    cursor.skip_blank();
    let header = KnetHeader::read(&mut cursor)?;
    let frequency = header.number("Sampling Freq", "'Sampling Freq(Hz)' and a number", &cursor)?;
    let scale = header.scale(&cursor)?;
    let counts = counts(&mut cursor)?;
    header.check_duration(&cursor, counts.len(), frequency)?;

    let dt = 1.0 / frequency;
    let offset = mean(&counts);
    let values: Vec<f64> = counts.iter().map(|count| (count - offset) * scale).collect();
    let pga = match header.value("Max. Acc.").or_else(|| header.value("Max Acc.")) {
        Some((line, printed)) if number(printed).is_some() => {
            let stated =
                Stated { line, of: "acceleration", value: printed, time: None, signed: false };
            Some(stated.check_values(file, Clock::from_first(dt), &values, |_| 0.0)?)
        }
        _ => return Err(cursor.not(header.end, "'Max. Acc. (gal)' above it")),
    };
    let (name, direction) = header.component();
    let station = header.value("Station Code").map(|(_, code)| code.to_owned());
    let samples = Samples {
        units: Some(Units::CentimetrePerSecond2),
        dt: Some(dt),
        values,
        ..Samples::default()
    };
    let channel = Channel { name, direction, samples, pga, pgv: None };
    Ok(Parsed { station, channels: vec![channel], ..Parsed::default() })
}

/// The lines above the numbers.
struct KnetHeader<'a> {
    lines: Vec<(usize, &'a str)>,
    /// The line of the memo, the last.
    end: usize,
}

impl<'a> KnetHeader<'a> {
    fn read(cursor: &mut Cursor<'a>) -> Result<Self, RecordError> {
        let mut lines = Vec::new();
        loop {
            let at = cursor.number();
            if lines.len() == HEADER_LINES {
                return Err(cursor.not(at, "'Memo.', the last line of the header,"));
            }
            let line = cursor.line("'Memo.', the last line of the header,")?;
            if line.starts_with(|c: char| c.is_whitespace() || c == '-' || c.is_ascii_digit()) {
                return Err(cursor.not(at, "'Memo.', the last line of the header,"));
            }
            lines.push((at, line));
            if line.starts_with("Memo") {
                return Ok(Self { lines, end: at });
            }
        }
    }

    /// What stands behind a key, from the 19th character on or after the key's words.
    fn value(&self, key: &str) -> Option<(usize, &'a str)> {
        let (at, line) = self.lines.iter().find(|(_, line)| line.starts_with(key))?;
        let value = match line.get(18..) {
            Some(value) if line.is_char_boundary(17) && line[17..18].trim().is_empty() => value,
            _ => line[key.len()..].split_once(' ').map_or("", |(_, value)| value),
        };
        Some((*at, value.trim()))
    }

    /// A positive number at the head of a value.
    fn number(&self, key: &str, wanted: &'static str, cursor: &Cursor) -> Result<f64, RecordError> {
        let (line, value) = self.value(key).ok_or_else(|| cursor.not(self.end, wanted))?;
        positive(value.trim_end_matches(|c: char| c.is_ascii_alphabetic()))
            .ok_or_else(|| cursor.not(line, wanted))
    }

    /// `3920(gal)/6182761` in gal a count.
    fn scale(&self, cursor: &Cursor) -> Result<f64, RecordError> {
        let wanted = "'Scale Factor' as in 3920(gal)/6182761";
        let (line, value) =
            self.value("Scale Factor").ok_or_else(|| cursor.not(self.end, wanted))?;
        let parts = value.split_once("(gal)").and_then(|(gal, counts)| {
            Some(positive(gal)? / positive(counts.trim().strip_prefix('/')?)?)
        });
        parts.filter(|scale| scale.is_finite()).ok_or_else(|| cursor.not(line, wanted))
    }

    /// As many numbers as the duration in whole seconds asks for.
    fn check_duration(
        &self,
        cursor: &Cursor,
        found: usize,
        frequency: f64,
    ) -> Result<(), RecordError> {
        let Some((line, value)) = self.value("Duration Time") else { return Ok(()) };
        let seconds =
            positive(value).ok_or_else(|| cursor.not(line, "'Duration Time(s)' and a number"))?;
        let said = seconds * frequency;
        // whole seconds: there may be samples of one more, never fewer
        if (-0.5..frequency).contains(&(found as f64 - said)) {
            return Ok(());
        }
        let (file, what) = (cursor.file.to_owned(), "samples");
        let end = cursor.number().saturating_sub(1);
        Err(RecordError::Short {
            file,
            line: end,
            what,
            found,
            said: said as u64,
            header_line: line,
        })
    }

    /// `N-S`, or KiK-net's number of the channel: 1 to 3 in the borehole, 4 to 6 at the surface.
    fn component(&self) -> (Option<String>, Direction) {
        let Some((_, value)) = self.value("Dir.") else { return (None, Direction::Unknown) };
        let (name, direction) = match value {
            "1" => ("NS1", "N"),
            "2" => ("EW1", "E"),
            "3" => ("UD1", "Up"),
            "4" => ("NS2", "N"),
            "5" => ("EW2", "E"),
            "6" => ("UD2", "Up"),
            other => (other, other),
        };
        (Some(name.to_owned()).filter(|name| !name.is_empty()), Direction::of(direction))
    }
}

fn positive(text: &str) -> Option<f64> {
    number(text.trim()).filter(|x| x.is_finite() && *x > 0.0)
}

/// Every whole number to the end of the file.
fn counts(cursor: &mut Cursor) -> Result<Vec<f64>, RecordError> {
    let mut counts = Vec::new();
    // a line that is not full must be the last
    let mut short: Option<(usize, usize)> = None;
    while let Some(text) = cursor.peek() {
        let line = cursor.number();
        cursor.advance();
        let fields: Vec<&str> = text.split_whitespace().collect();
        if fields.is_empty() {
            continue;
        }
        let file = cursor.file.to_owned();
        if let Some((line, found)) = short {
            return Err(RecordError::Fields { file, line, found, expected: PER_LINE });
        }
        if fields.len() > PER_LINE {
            return Err(RecordError::Fields {
                file,
                line,
                found: fields.len(),
                expected: PER_LINE,
            });
        }
        short = (fields.len() < PER_LINE).then_some((line, fields.len()));
        for field in fields {
            let count = field.parse::<i64>().map_err(|_| RecordError::NotANumber {
                file: file.clone(),
                line,
                text: quote(field),
            })?;
            counts.push(count as f64);
        }
    }
    Ok(counts)
}
