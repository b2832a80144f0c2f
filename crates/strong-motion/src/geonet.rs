//! GeoNet, New Zealand: V2A (corrected) and V1A (uncorrected), after the description of the formats
//! that GeoNet publishes.
//!
//! Each component, one after the other: 16 lines of text, 40 integers (10I8), 60 numbers (10F8),
//! then acceleration, velocity and displacement (10F8) in mm and s; in a V1A file acceleration
//! alone. Integers 34 to 36 count the samples, number 26 is their time step. The header's clock is
//! that of the uncorrected record, to which a corrected one has samples prepended: number 22 says
//! how many seconds, and the first sample is that long before zero. A number too long for its eight
//! characters loses its decimals.

use super::fortran::{Block, Cursor, FortranFormat, Promise, half_digit};
use super::parsed::{Channel, Parsed, Samples};
use super::peak::{Clock, Peak, Stated};
use super::text::{self, number};
use super::{Direction, RecordError, RecordFormat, Units};

const TEXT_LINES: usize = 16;
const INTEGERS: FortranFormat = FortranFormat { per_line: 10, width: 8 };
const NUMBERS: FortranFormat = FortranFormat { per_line: 10, width: 8 };
/// The three series of a component, what they are called in its text and the unit there in m.
const SERIES: [(&str, &str, &str); 3] = [
    ("acceleration samples", "acceleration", "Acceleration:"),
    ("velocity samples", "velocity", "Velocity:"),
    ("displacement samples", "displacement", "Displacement:"),
];

/// Whether the first lines are those of a GeoNet file.
pub(super) fn is_it(head: &[&str]) -> bool {
    let first = text::first(head).to_ascii_lowercase();
    first.contains("corrected accelerogram")
        && (first.contains("gns science")
            || head.iter().take(TEXT_LINES + 1).any(|line| {
                line.starts_with("Component ")
                    || line.starts_with("Site ")
                    || line.contains("mm/s/s")
            }))
}

/// All components.
pub(super) fn parse(file: &str, text: &str) -> Result<Parsed, RecordError> {
    let mut cursor = Cursor::new(file, RecordFormat::GeoNet, text);
    let mut parsed = Parsed::default();
    while cursor.skip_blank() {
        let header = GeonetHeader::read(&mut cursor)?;
        parsed.station = parsed.station.or_else(|| header.station());
        parsed.channels.push(header.channel(&mut cursor)?);
    }
    Ok(parsed)
}

/// The header of one component.
struct GeonetHeader<'a> {
    text: Vec<&'a str>,
    /// The line that the text begins on.
    line: usize,
    /// Samples of acceleration, velocity, displacement, and the line of these counts.
    counts: [u64; 3],
    counts_line: usize,
    clock: Clock,
    dt_rounding: f64,
}

impl<'a> GeonetHeader<'a> {
    fn read(cursor: &mut Cursor<'a>) -> Result<Self, RecordError> {
        let line = cursor.number();
        let text = cursor.take(
            TEXT_LINES,
            "16 lines of text, from 'Corrected accelerogram' to 'Displacement:',",
        )?;
        if !text[0].to_ascii_lowercase().contains("corrected accelerogram") {
            return Err(
                cursor.not(line, "'Corrected accelerogram', the first line of a component,")
            );
        }
        let unit = text.iter().position(|line| line.contains("mm/s/s"));
        if unit.is_none() {
            return Err(cursor.not(line + 13, "the unit mm/s/s"));
        }
        let integers_line = cursor.number();
        let promise = |what, count, line| Promise { what, count, layout: NUMBERS, line };
        let integers = cursor.header(Promise {
            layout: INTEGERS,
            ..promise("integers of the header", 40, integers_line)
        })?;
        let numbers_line = cursor.number();
        let numbers = cursor.header(promise("numbers of the header", 60, numbers_line))?;

        let counts_line = integers_line + 3;
        let count = |i: usize| integers[i].parse::<u64>().ok();
        let counts = match (count(33), count(34), count(35)) {
            (Some(acceleration @ 1..), Some(velocity), Some(displacement)) => {
                [acceleration, velocity, displacement]
            }
            _ => return Err(cursor.not(counts_line, "the counts of samples, integers 34 to 36,")),
        };
        let dt = number(numbers[25]).filter(|dt| dt.is_finite() && *dt > 0.0);
        let dt = dt.ok_or_else(|| cursor.not(numbers_line + 2, "the time step, number 26,"))?;
        let prepended = number(numbers[21]).filter(|s| (0.0..=1e4).contains(s));
        let prepended = prepended
            .ok_or_else(|| cursor.not(numbers_line + 2, "the seconds prepended, number 22,"))?;
        let clock = Clock { start: -prepended, dt };
        let header =
            Self { text, line, counts, counts_line, clock, dt_rounding: half_digit(numbers[25]) };
        header.agrees_with_its_text(cursor)?;
        Ok(header)
    }

    /// The text says the number of samples and the time step once more.
    fn agrees_with_its_text(&self, cursor: &Cursor) -> Result<(), RecordError> {
        for (i, line) in self.text.iter().enumerate() {
            let after = |name: &str| {
                let words = line.to_ascii_lowercase();
                let rest = words[words.find(name)? + name.len()..].trim_start().to_owned();
                rest.split_whitespace().next().and_then(number)
            };
            if after("number of points").is_some_and(|n| n != self.counts[0] as f64) {
                return Err(cursor.not(
                    self.line + i,
                    "the number of samples that integer 34 of the header gives",
                ));
            }
            let step = after("data at").or_else(|| after("intervals of"));
            if step.is_some_and(|dt| (dt - self.clock.dt).abs() > 5e-4 + self.dt_rounding) {
                return Err(
                    cursor.not(self.line + i, "the time step that number 26 of the header gives")
                );
            }
        }
        Ok(())
    }

    /// Code and name of the site.
    fn station(&self) -> Option<String> {
        let code = self.text[1].strip_prefix("Site ")?.split_whitespace().next()?;
        Some(format!("{code} {}", self.text[2].trim()).trim_end().to_owned())
    }

    fn channel(&self, cursor: &mut Cursor<'a>) -> Result<Channel, RecordError> {
        let component =
            self.text.iter().find_map(|line| line.strip_prefix("Component")).map_or("", str::trim);
        let (acceleration, pga) = self.series(cursor, 0)?;
        let (_, pgv) = self.series(cursor, 1)?;
        self.series(cursor, 2)?;
        Ok(Channel {
            name: component.split_whitespace().next().map(str::to_owned),
            direction: Direction::of(component),
            samples: Samples {
                units: Some(Units::MillimetrePerSecond2),
                dt: Some(self.clock.dt),
                start: self.clock.start,
                dt_rounding: self.dt_rounding,
                values: acceleration.values,
                ..Samples::default()
            },
            pga,
            pgv: pgv.map(|peak| peak.times(1e-3)),
        })
    }

    /// One series, with the peak that the text gives.
    fn series(
        &self,
        cursor: &mut Cursor<'a>,
        i: usize,
    ) -> Result<(Block<'a>, Option<Peak>), RecordError> {
        let (what, of, name) = SERIES[i];
        let block = cursor.block(Promise {
            what,
            count: self.counts[i],
            layout: NUMBERS,
            line: self.counts_line,
        })?;
        let line = self.text.iter().position(|line| line.starts_with(name));
        let stated = line.and_then(|at| Stated::find(self.line + at, of, self.text[at], "peak"));
        match stated {
            Some(stated) if !block.values.is_empty() => {
                let peak = stated.check(cursor.file, self.clock, &block)?;
                Ok((block, Some(peak)))
            }
            None if i == 0 => {
                Err(cursor.not(self.line + 13, "'Acceleration: peak' with its value and time"))
            }
            _ => Ok((block, None)),
        }
    }
}
