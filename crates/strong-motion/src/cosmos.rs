//! COSMOS strong-motion format, version 1.20 and alike: V1 (uncorrected) and V2c (corrected), one
//! or several channels a file.
//!
//! Each channel: lines of text (the first says how many), a block of integers and one of numbers,
//! comments, each below a line with its count and Fortran format, then the samples below a line
//! with their count, unit code and format, and a line that ends the data. Integer 54 is the azimuth
//! or a code for up; number 62 is the time step in ms (number 34 that of the raw record, which may
//! differ), 64 and 65 are the largest value and its time. Unknown values are written as line 13
//! says.

use super::fortran::{Cursor, FortranFormat, Promise, half_digit};
use super::parsed::{Channel, Parsed, Samples};
use super::peak::{Clock, Peak, Stated};
use super::text::{self, number, quote};
use super::{Direction, RecordError, RecordFormat, Units};

/// Whether the first lines are those of a COSMOS file.
pub(super) fn is_it(head: &[&str]) -> bool {
    text_lines(text::first(head)).is_some()
        || head.iter().any(|line| line.contains("Integer-header values follow"))
}

/// How many lines of text the first line announces: `(Format v01.20 with 13 text lines)`.
fn text_lines(line: &str) -> Option<usize> {
    let lower = line.to_ascii_lowercase();
    let after = &lower[lower.find("(format v")?..];
    let count = after.split_once(" with ")?.1.split_whitespace().next()?.parse().ok()?;
    (2..=200).contains(&count).then_some(count)
}

/// All channels of acceleration.
pub(super) fn parse(file: &str, text: &str) -> Result<Parsed, RecordError> {
    let mut cursor = Cursor::new(file, RecordFormat::Cosmos, text);
    let mut parsed = Parsed::default();
    let mut other = None;
    while cursor.skip_blank() {
        let header = CosmosHeader::read(&mut cursor)?;
        parsed.station = parsed.station.or_else(|| header.station());
        while let Some(series) = CosmosSeries::next(&mut cursor)? {
            match series.channel(&mut cursor, &header)? {
                Some(channel) => parsed.channels.push(channel),
                None => other = other.or(Some(series.quantity)),
            }
        }
        end_of_data(&mut cursor)?;
    }
    match other {
        Some(quantity) if parsed.channels.is_empty() => {
            Err(RecordError::NotAcceleration { file: file.to_owned(), quantity })
        }
        _ => Ok(parsed),
    }
}

/// `End-of-data for ...` or `/&`; nothing at the end of the file.
fn end_of_data(cursor: &mut Cursor) -> Result<(), RecordError> {
    let Some(line) = cursor.peek().map(str::trim_start).filter(|line| !line.is_empty()) else {
        return Ok(());
    };
    if line.to_ascii_lowercase().starts_with("end-of-data") || line.starts_with("/&") {
        cursor.advance();
        return Ok(());
    }
    Err(cursor.not(cursor.number(), "'End-of-data'"))
}

/// The header of a channel.
struct CosmosHeader<'a> {
    text: Vec<&'a str>,
    integers: Vec<&'a str>,
    integers_line: usize,
    numbers: Vec<&'a str>,
    numbers_line: usize,
    /// Channel code by the comments.
    code: Option<&'a str>,
    unknown: f64,
}

impl<'a> CosmosHeader<'a> {
    fn read(cursor: &mut Cursor<'a>) -> Result<Self, RecordError> {
        let first = cursor.number();
        let lines = cursor.peek().and_then(text_lines);
        let lines = lines.ok_or_else(|| {
            cursor.not(first, "a first line with '(Format v... with ... text lines)'")
        })?;
        let text = cursor.take(lines, "the lines of text that the first line announces")?;
        let integers_line = cursor.number();
        let promise = announced(cursor, "integers of the header", "Integer-header values follow")?;
        let integers = cursor.header(promise)?;
        let numbers_line = cursor.number();
        let promise = announced(cursor, "numbers of the header", "Real-header values follow")?;
        let numbers = cursor.header(promise)?;
        let comments_line = cursor.number();
        let wanted = "'... Comment line(s) follow'";
        let comments = cursor.line(wanted)?;
        let count = comments.split_whitespace().next().and_then(|n| n.parse().ok());
        let count = count
            .filter(|_| comments.contains("omment"))
            .ok_or_else(|| cursor.not(comments_line, wanted))?;
        let comments = cursor.take(count, "the comments that were announced")?;
        if let Some(i) = comments.iter().position(|line| !line.trim_start().starts_with('|')) {
            return Err(cursor.not(comments_line + 1 + i, "a comment, which begins with '|',"));
        }
        let code = comments.iter().find_map(|line| {
            let words = line.split_once("<SCNL>")?.1.split_whitespace().next()?;
            words.split('.').nth(1)
        });
        let unknown = text.iter().find(|line| line.contains("unknown/unspecified"));
        let unknown = unknown.and_then(|line| {
            number(line.split_once(':')?.1.split([' ', ',']).find(|w| !w.is_empty())?)
        });
        let unknown = unknown.unwrap_or(-999.0);
        Ok(Self { text, integers, integers_line, numbers, numbers_line, code, unknown })
    }

    /// A number of the header, counted from 1 as in the description of the format, unless it is
    /// unknown.
    fn real(&self, i: usize) -> Option<(f64, &'a str)> {
        let printed = self.numbers.get(i - 1)?;
        Some((number(printed).filter(|x| x.is_finite() && *x != self.unknown)?, printed))
    }

    fn integer(&self, i: usize) -> Option<i64> {
        let value = self.integers.get(i - 1)?.parse().ok()?;
        (value as f64 != self.unknown).then_some(value)
    }

    /// The time step of the samples (s) and half of its last printed digit.
    fn step(&self, cursor: &Cursor, data: &CosmosSeries) -> Result<(f64, f64), RecordError> {
        let (dt, half) = match (self.real(62), self.real(34)) {
            (Some((ms, printed)), _) if ms > 0.0 => (ms * 1e-3, half_digit(printed) * 1e-3),
            (_, Some((s, printed))) if s > 0.0 => (s, half_digit(printed)),
            _ => {
                return Err(cursor
                    .not(self.numbers_line, "numbers of the header with a time step (number 62)"));
            }
        };
        // whole seconds are printed, rounded in one way or another
        let length = data.promise.count as f64 * dt;
        match data.seconds {
            Some(seconds) if (length - seconds).abs() > 1.5 + 0.01 * seconds + dt => Err(cursor
                .not(
                    data.promise.line,
                    "the length in seconds that number 62 of the header makes",
                )),
            _ => Ok((dt, half)),
        }
    }

    /// `Statn No: 37-000011 Code:AK-BMR  UAF  Bremner River`.
    fn station(&self) -> Option<String> {
        let words = self.text.iter().find_map(|line| line.split_once("Code:"))?.1;
        let words: Vec<&str> = words.split_whitespace().collect();
        Some(words.join(" ")).filter(|words| !words.is_empty())
    }

    /// Name and direction: the azimuth or the code of integer 54, else the words of the text, else
    /// the channel code.
    fn component(&self) -> (Option<String>, Direction) {
        // `Sta Chan   1: 340 deg (Rcrdr Chan  1) Location:`; some write `Sta Cha:  1: 340 deg`
        let words = self.text.iter().find_map(|line| line.trim_start().strip_prefix("Sta Cha"));
        let words = words.map_or("", |words| words.trim_start_matches(['n', ':']));
        let (channel, words) = words.split_once(':').unwrap_or(("", ""));
        let by_code = self.code.map_or(Direction::Unknown, Direction::of);
        let direction = match self.integer(54) {
            Some(degrees @ 1..=360) => Direction::azimuth(degrees as f64),
            Some(400..=402) => Direction::Vertical,
            Some(500..=701) => Direction::Horizontal,
            _ => match Direction::of(words) {
                Direction::Unknown => by_code,
                said => said,
            },
        };
        let number = Some(channel.trim()).filter(|n| n.parse::<u32>().is_ok());
        let name = self.code.map(str::to_owned).or_else(|| number.map(|n| format!("Chan {n}")));
        (name, direction)
    }
}

/// A line such as ` 100 Integer-header values follow on  10 lines, Format= (10I8)`.
fn announced(
    cursor: &mut Cursor,
    what: &'static str,
    words: &'static str,
) -> Result<Promise, RecordError> {
    let line = cursor.number();
    let text = cursor.line(words)?;
    let count = text
        .split_whitespace()
        .next()
        .and_then(|n| n.parse().ok())
        .filter(|_| text.contains(words));
    match (count, FortranFormat::parse(text)) {
        (Some(count), Some(layout)) => Ok(Promise { what, count, layout, line }),
        _ => Err(cursor.not(line, words)),
    }
}

/// What the line above the samples says.
struct CosmosSeries<'a> {
    promise: Promise,
    quantity: &'static str,
    /// Length, in whole seconds.
    seconds: Option<f64>,
    unit: &'a str,
}

impl<'a> CosmosSeries<'a> {
    /// The next series, if one comes: `7000 acceleration pts, approx 70 secs,
    /// units=cm/sec2(04),Format=(8F10.5)`.
    fn next(cursor: &mut Cursor<'a>) -> Result<Option<Self>, RecordError> {
        let line = cursor.number();
        let Some(text) = cursor.peek() else { return Ok(None) };
        let lower = text.to_ascii_lowercase();
        let Some(count) = text.split_whitespace().next().and_then(|n| n.parse().ok()) else {
            return Ok(None);
        };
        let wanted = "'... acceleration pts, ..., units=..., Format=...'";
        let quantity = match () {
            () if lower.contains("veloc") => "velocity",
            () if lower.contains("displ") => "displacement",
            () if lower.contains("accel") => "acceleration",
            () => return Err(cursor.not(line, wanted)),
        };
        let what = match quantity {
            "acceleration" => "acceleration samples",
            "velocity" => "velocity samples",
            _ => "displacement samples",
        };
        let unit = lower
            .find("units=")
            .map(|at| &text[at + 6..])
            .and_then(|rest| rest.split([',', ' ']).next());
        let (Some(unit), Some(layout), 1..) = (unit, FortranFormat::parse(text), count) else {
            return Err(cursor.not(line, wanted));
        };
        let seconds = lower
            .split_once("approx")
            .and_then(|(_, rest)| number(rest.split_whitespace().next()?));
        cursor.advance();
        Ok(Some(Self { promise: Promise { what, count, layout, line }, quantity, seconds, unit }))
    }

    /// The channel, unless the series is not of acceleration.
    fn channel(
        &self,
        cursor: &mut Cursor<'a>,
        header: &CosmosHeader<'a>,
    ) -> Result<Option<Channel>, RecordError> {
        let (dt, half) = header.step(cursor, self)?;
        let block = cursor.block(self.promise)?;
        if self.quantity != "acceleration" {
            return Ok(None);
        }
        let units = self.units(cursor)?;
        let pga = header.real(64).map(|(_, value)| {
            let line = header.numbers_line;
            let time = header.real(65).map(|(_, time)| time);
            Stated { line, of: "acceleration", value, time, signed: true }
        });
        let pga: Option<Peak> = pga
            .map(|stated| stated.check(cursor.file, Clock::from_first(dt), &block))
            .transpose()?;
        if header.integer(54).is_some_and(|code| !(0..=3000).contains(&code)) {
            return Err(cursor
                .not(header.integers_line + 6, "an azimuth or a code of direction as integer 54"));
        }
        let (name, direction) = header.component();
        let samples = Samples {
            units: Some(units),
            dt: Some(dt),
            dt_rounding: half,
            values: block.values,
            ..Samples::default()
        };
        Ok(Some(Channel { name, direction, samples, pga, pgv: None }))
    }

    /// The unit by its code, `cm/sec2(04)`, else by its name.
    fn units(&self, cursor: &Cursor) -> Result<Units, RecordError> {
        let (name, code) = self.unit.split_once('(').unwrap_or((self.unit, ""));
        let code = code.trim_end_matches(')').trim().parse::<u32>().ok();
        match (code, name.parse()) {
            (Some(2), _) => Ok(Units::G),
            (Some(4 | 10), _) => Ok(Units::CentimetrePerSecond2),
            (Some(50), _) => Err(RecordError::Counts { file: cursor.file.to_owned() }),
            (None, Ok(units)) => Ok(units),
            (None, Err(_)) if name.to_ascii_lowercase().contains("count") => {
                Err(RecordError::Counts { file: cursor.file.to_owned() })
            }
            _ => {
                let (file, line) = (cursor.file.to_owned(), self.promise.line);
                Err(RecordError::ForeignUnit { file, line, unit: quote(self.unit) })
            }
        }
    }
}
