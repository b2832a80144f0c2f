//! CSMIP .V2 (California's network, CESMD): text lines, 100 integers (16I5), 100 numbers (8F10),
//! then acceleration, velocity and displacement, each below a line that gives count, time step,
//! unit and format; `/&` ends a channel.
//!
//! The time step in these lines has three decimals; number 53 of the header gives more. Uncorrected
//! files (.V1) are not read.

use super::fortran::{Block, Cursor, FortranFormat, Promise, half_digit};
use super::parsed::{Channel, Parsed, Samples};
use super::peak::{Clock, Peak, Stated};
use super::text::{self, number, quote};
use super::{Direction, RecordError, RecordFormat, Units};

/// How many lines a channel's header may have.
const HEADER_LINES: usize = 80;
const NUMBERS: FortranFormat = FortranFormat { per_line: 8, width: 10 };
const NUMBER_LINES: usize = 13;

/// Whether the first lines are those of a CSMIP file.
pub(super) fn is_it(head: &[&str]) -> bool {
    let first = text::first(head).to_ascii_lowercase();
    first.contains("corrected accelerogram") || head.iter().any(|line| is_data_line(line, "accel"))
}

/// `15050 points of accel data equally spaced at .020 sec, in cm/sec2. (8f10.6)`
fn is_data_line(line: &str, quantity: &str) -> bool {
    let line = line.to_ascii_lowercase();
    line.contains("points of") && line.contains("data equally spaced") && line.contains(quantity)
}

/// All channels.
pub(super) fn parse(file: &str, text: &str) -> Result<Parsed, RecordError> {
    let mut cursor = Cursor::new(file, RecordFormat::Csmip, text);
    let mut parsed = Parsed::default();
    while cursor.skip_blank() {
        let (station, channel) = read_channel(&mut cursor)?;
        parsed.station = parsed.station.or(station);
        parsed.channels.push(channel);
    }
    Ok(parsed)
}

/// The lines above the acceleration, and the number of the first.
struct CsmipHeader<'a> {
    lines: Vec<&'a str>,
    line: usize,
}

fn read_channel(cursor: &mut Cursor) -> Result<(Option<String>, Channel), RecordError> {
    let header = CsmipHeader::read(cursor)?;
    let announced = CsmipSeries::announced(
        cursor,
        "accel",
        "'... points of accel data equally spaced at ...'",
    )?;
    let step = header.step(announced.step, announced.step_rounding);
    let (values, pga) = announced.read(cursor, step.0, header.peak("acceleration"))?;
    let mut pgv = None;
    for (quantity, of) in [("veloc", "velocity"), ("displ", "displacement")] {
        if cursor.peek().is_some_and(|line| is_data_line(line, quantity)) {
            let announced = CsmipSeries::announced(
                cursor,
                quantity,
                "'... points of ... data equally spaced at ...'",
            )?;
            let cm = announced.unit.to_ascii_lowercase().contains("cm");
            let (_, peak) = announced.read(cursor, step.0, header.peak(of))?;
            if of == "velocity" && cm {
                pgv = peak.map(|peak| peak.times(0.01));
            }
        }
    }
    match cursor.peek() {
        Some(line) if line.trim_start().starts_with("/&") => cursor.advance(),
        None => {}
        Some(line) if line.trim().is_empty() => {}
        Some(_) => return Err(cursor.not(cursor.number(), "'/&', the end of the channel,")),
    }
    let (name, direction) = header.component();
    let samples = Samples {
        units: Some(Units::CentimetrePerSecond2),
        dt: Some(step.0),
        dt_rounding: step.1,
        values,
        ..Samples::default()
    };
    Ok((header.station(), Channel { name, direction, samples, pga, pgv }))
}

impl<'a> CsmipHeader<'a> {
    /// Everything above the line that announces the acceleration.
    fn read(cursor: &mut Cursor<'a>) -> Result<Self, RecordError> {
        let line = cursor.number();
        let mut lines = Vec::new();
        while let Some(text) = cursor.peek().filter(|text| !is_data_line(text, "accel")) {
            let lower = text.to_ascii_lowercase();
            if lower.contains("points") && lower.contains("units of g") {
                return Err(RecordError::Uncorrected {
                    file: cursor.file.to_owned(),
                    line: cursor.number(),
                });
            }
            if lines.len() == HEADER_LINES {
                break;
            }
            lines.push(text);
            cursor.advance();
        }
        Ok(Self { lines, line })
    }

    /// `Peak acceleration = 82.584 cm/sec/sec at 14.840 sec.`
    fn peak(&self, of: &'static str) -> Option<Stated<'a>> {
        self.lines.iter().enumerate().find_map(|(i, line)| {
            let is_peak = line.trim_start().to_ascii_lowercase().starts_with("peak ");
            is_peak.then(|| Stated::find(self.line + i, of, line, of))?
        })
    }

    /// The time step: the header's number 53 where that rounds to what the text says.
    fn step(&self, announced: f64, rounding: f64) -> (f64, f64) {
        let numbers = &self.lines[self.lines.len().saturating_sub(NUMBER_LINES)..];
        let (row, column) = (52 / NUMBERS.per_line, 52 % NUMBERS.per_line * NUMBERS.width);
        let field = numbers
            .get(row)
            .and_then(|line| line.get(column..column + NUMBERS.width))
            .map(str::trim);
        match field.and_then(|field| Some((number(field)?, half_digit(field)))) {
            Some((dt, half)) if (dt - announced).abs() <= rounding + 1e-9 => (dt, half),
            _ => (announced, rounding),
        }
    }

    /// `Chan  1:  90 Deg`: name and direction.
    fn component(&self) -> (Option<String>, Direction) {
        let channel = self.lines.iter().find_map(|line| {
            let words = &line[line.to_ascii_lowercase().find("chan ")? + 5..];
            let (number, direction) = words.split_once(':')?;
            Some((number.trim(), direction))
        });
        channel.map_or((None, Direction::Unknown), |(number, direction)| {
            (Some(format!("Chan {number}")), Direction::of(direction))
        })
    }

    /// The words after `Station No.` or `Station Id.`, and the line below them.
    fn station(&self) -> Option<String> {
        let is_station =
            |line: &str| line.trim_start().to_ascii_lowercase().starts_with("station ");
        let at = self.lines.iter().position(|line| is_station(line))?;
        let code = self.lines[at].split_whitespace().nth(2)?;
        let name = self.lines.get(at + 1).map_or("", |line| line.get(..40).unwrap_or(line).trim());
        Some(format!("{code} {name}").trim_end().to_owned())
    }
}

/// What the line above a series says.
struct CsmipSeries<'a> {
    promise: Promise,
    step: f64,
    step_rounding: f64,
    unit: &'a str,
}

impl<'a> CsmipSeries<'a> {
    fn announced(
        cursor: &mut Cursor<'a>,
        quantity: &str,
        wanted: &'static str,
    ) -> Result<Self, RecordError> {
        let line = cursor.number();
        let text = cursor.line(wanted)?;
        let bad = || cursor.not(line, wanted);
        if !is_data_line(text, quantity) {
            return Err(bad());
        }
        let what = match quantity {
            "accel" => "acceleration samples",
            "veloc" => "velocity samples",
            _ => "displacement samples",
        };
        let count = text
            .split_whitespace()
            .next()
            .and_then(|n| n.parse().ok())
            .filter(|n| *n > 0)
            .ok_or_else(bad)?;
        let layout = FortranFormat::parse(text).ok_or_else(bad)?;
        // older files write in capitals
        let at = text.to_ascii_lowercase().find(" at ").ok_or_else(bad)?;
        let after = &text[at + 4..];
        let printed = after.split_whitespace().next().unwrap_or("");
        let step = number(printed).filter(|dt| dt.is_finite() && *dt > 0.0).ok_or_else(bad)?;
        let unit = after.to_ascii_lowercase().find(" in ").map_or("", |at| &after[at + 4..]);
        let unit = unit.split_whitespace().next().unwrap_or("");
        let unit = unit.trim_end_matches(['.', ',']);
        if quantity == "accel" && unit.parse() != Ok(Units::CentimetrePerSecond2) {
            return Err(RecordError::ForeignUnit {
                file: cursor.file.to_owned(),
                line,
                unit: quote(unit),
            });
        }
        Ok(Self {
            promise: Promise { what, count, layout, line },
            step,
            step_rounding: half_digit(printed),
            unit,
        })
    }

    fn read(
        &self,
        cursor: &mut Cursor<'a>,
        dt: f64,
        stated: Option<Stated>,
    ) -> Result<(Vec<f64>, Option<Peak>), RecordError> {
        let block: Block = cursor.block(self.promise)?;
        let peak = stated
            .map(|stated| stated.check(cursor.file, Clock::from_first(dt), &block))
            .transpose()?;
        Ok((block.values, peak))
    }
}
