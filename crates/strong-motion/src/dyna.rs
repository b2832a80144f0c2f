//! ESM, ITACA and AFAD (DYNA 1.x): lines `KEY: value`, then one value to a line, one component a
//! file.
//!
//! ```text
//! SAMPLING_INTERVAL_S: 0.005000
//! NDATA: 19128
//! STREAM: HNN
//! UNITS: cm/s^2
//! PGA_CM/S^2: 0.359017
//! TIME_PGA_S: 22.655000
//! DATA_TYPE: ACCELERATION
//! 0.000000
//! ```

use super::fortran::{Cursor, FortranFormat, Promise, half_digit};
use super::parsed::{Channel, Parsed, Samples};
use super::peak::{Clock, Stated};
use super::text::{self, number, quote};
use super::{Direction, RecordError, RecordFormat, Units};

/// Keys that no other format has.
const KEYS: [&str; 7] = [
    "NDATA:",
    "STREAM:",
    "HEADER_FORMAT:",
    "STATION_CODE:",
    "EVENT_ID:",
    "DATABASE_VERSION:",
    "PGA_CM/S^2:",
];

/// Whether the first lines are those of such a file.
pub(super) fn is_it(head: &[&str]) -> bool {
    text::begin_with_two(head, &KEYS)
}

/// The one component.
pub(super) fn parse(file: &str, text: &str) -> Result<Parsed, RecordError> {
    let mut cursor = Cursor::new(file, RecordFormat::Dyna, text);
    cursor.skip_blank();
    let header = DynaHeader::read(&mut cursor);
    header.check_quantity(file)?;
    let (line, count) = header.need("NDATA", "'NDATA: ' and the number of samples", &cursor)?;
    let count = count.parse::<u64>().ok().filter(|n| *n > 0);
    let count = count.ok_or_else(|| cursor.not(line, "'NDATA: ' and the number of samples"))?;
    let wanted = "'SAMPLING_INTERVAL_S: ' and seconds";
    let (step_line, printed) = header.need("SAMPLING_INTERVAL_S", wanted, &cursor)?;
    let dt = number(printed).filter(|dt| dt.is_finite() && *dt > 0.0);
    let dt = dt.ok_or_else(|| cursor.not(step_line, wanted))?;
    let (units_line, units) = header.need("UNITS", "'UNITS: cm/s^2'", &cursor)?;
    let units: Units = units.parse().map_err(|_| RecordError::ForeignUnit {
        file: file.to_owned(),
        line: units_line,
        unit: quote(units),
    })?;

    let layout = FortranFormat { per_line: 1, width: 40 };
    let block = cursor.block(Promise { what: "acceleration samples", count, layout, line })?;
    let end = cursor.number();
    if cursor.skip_blank() {
        return Err(cursor.not(end, "the end of the file, after the samples that NDATA announces,"));
    }
    let pga = match header.value("PGA_CM/S^2") {
        Some((line, value)) => {
            let time = header.value("TIME_PGA_S");
            if let Some((line, _)) =
                [Some((line, value)), time].into_iter().flatten().find(|(_, x)| number(x).is_none())
            {
                return Err(cursor.not(line, "a number, or nothing"));
            }
            // some give the size alone; a minus is meant
            let signed = value.starts_with('-');
            let stated = Stated {
                line,
                of: "acceleration",
                value,
                time: time.map(|(_, time)| time),
                signed,
            };
            // whatever the samples are in, the header's peak is in cm/s2
            let factor =
                units.metres_per_second2() / Units::CentimetrePerSecond2.metres_per_second2();
            let values: Vec<f64> = block.values.iter().map(|a| a * factor).collect();
            Some(stated.check_values(file, Clock::from_first(dt), &values, |i| {
                block.half_digit(i) * factor
            })?)
        }
        None => None,
    };
    let component =
        header.value("STREAM").or_else(|| header.value("COMPONENT")).map_or("", |(_, name)| name);
    let samples = Samples {
        units: Some(units),
        dt: Some(dt),
        dt_rounding: half_digit(printed),
        values: block.values,
        ..Samples::default()
    };
    let channel = Channel {
        name: Some(component.to_owned()).filter(|name| !name.is_empty()),
        direction: Direction::of(component),
        samples,
        pga,
        pgv: None,
    };
    Ok(Parsed { station: header.station(), channels: vec![channel], ..Parsed::default() })
}

/// The lines with keys.
struct DynaHeader<'a> {
    /// Line, key, value.
    entries: Vec<(usize, &'a str, &'a str)>,
    /// The last of these lines.
    end: usize,
}

impl<'a> DynaHeader<'a> {
    /// Every line down to the first number.
    fn read(cursor: &mut Cursor<'a>) -> Self {
        let mut entries = Vec::new();
        while let Some(text) = cursor.peek() {
            let Some((key, value)) = text.split_once(':').filter(|_| number(text.trim()).is_none())
            else {
                break;
            };
            entries.push((cursor.number(), key.trim(), value.trim()));
            cursor.advance();
        }
        Self { end: cursor.number().saturating_sub(1).max(1), entries }
    }

    /// The value of a key, unless it is empty.
    fn value(&self, key: &str) -> Option<(usize, &'a str)> {
        let entry = self.entries.iter().find(|(_, name, value)| *name == key && !value.is_empty());
        entry.map(|(line, _, value)| (*line, *value))
    }

    fn need(
        &self,
        key: &str,
        wanted: &'static str,
        cursor: &Cursor,
    ) -> Result<(usize, &'a str), RecordError> {
        let (line, value) = self.value(key).ok_or_else(|| {
            let line = self
                .entries
                .iter()
                .find(|(_, name, _)| *name == key)
                .map_or(self.end, |(line, ..)| *line);
            cursor.not(line, wanted)
        })?;
        // said twice, it must be the same
        match self
            .entries
            .iter()
            .find(|(_, name, other)| *name == key && !other.is_empty() && *other != value)
        {
            Some((other, ..)) => {
                Err(cursor.not(*other, "nothing else than what an earlier line says"))
            }
            None => Ok((line, value)),
        }
    }

    fn check_quantity(&self, file: &str) -> Result<(), RecordError> {
        let words =
            self.value("DATA_TYPE").map_or(String::new(), |(_, words)| words.to_ascii_lowercase());
        let quantity = match () {
            () if words.contains("spectrum") => "a spectrum",
            () if words.contains("velocity") => "velocity",
            () if words.contains("displacement") => "displacement",
            () => return Ok(()),
        };
        Err(RecordError::NotAcceleration { file: file.to_owned(), quantity })
    }

    /// Network, code and name.
    fn station(&self) -> Option<String> {
        let words: Vec<&str> = ["NETWORK", "STATION_CODE", "STATION_NAME"]
            .into_iter()
            .filter_map(|key| self.value(key).map(|(_, value)| value))
            .collect();
        Some(words.join(" ")).filter(|words| !words.is_empty())
    }
}
