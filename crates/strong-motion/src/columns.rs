//! Columns of text: (time, acceleration), acceleration alone, bare values in several columns, read
//! row by row, or a table of which one column is asked for. They are separated by commas,
//! semicolons, tabs or blanks, below any number of header lines; lines that start with #, % or //
//! are comments.

mod line;

use self::line::{
    blank_fields, bracketed, damaged_first_line, fields, has_decimal_commas, pairs_are_decimals,
};
use super::column;
use super::header::{self, TimeUnit, is_comment, rate_in, step_in};
use super::parsed::{Channel, Parsed, Samples, mean};
use super::text::{lines, number, precision, quote};
use super::timing::Times;
use super::{Direction, ReadOptions, RecordError, Units, units};
use crate::largest_magnitude;

/// From so many rows on, values of one sign are no accelerogram.
const ONE_SIGN_ROWS: usize = 20;
/// Whole numbers beyond this are counts: in cm/s2 it is 5 g.
const LARGEST_WHOLE: f64 = 5000.0;

/// The samples, in the file's own unit; the time step comes from the time column, else from the
/// header.
pub(super) fn parse(file: &str, text: &str, options: &ReadOptions) -> Result<Parsed, RecordError> {
    let table = NumberTable::read(file, text)?;
    let names = table.names();
    let asked = options.component.as_deref().filter(|_| table.columns > 1);
    let Some(wanted) = asked else { return series(file, table, &names, options) };
    let all = &names;
    let index = table.index(file, wanted, all)?;
    let (chosen, names) = table.chosen(index, all);
    let mut parsed = series(file, chosen, &names, options)?;
    parsed.chosen = true;
    let direction =
        if column::is_vertical(index, all) { Direction::Vertical } else { Direction::of(wanted) };
    for channel in &mut parsed.channels {
        (channel.name, channel.direction) = (Some(wanted.trim().to_owned()), direction);
    }
    // what cannot be read is none to take with it; who asks for it hears why
    let others = (0..table.columns).filter(|i| *i != index && column::is_vertical(*i, all));
    for (i, name) in others.filter_map(|i| Some((i, *all.get(i)?))) {
        let (other, names) = table.chosen(i, all);
        match series(file, other, &names, options) {
            Ok(other) => parsed.channels.extend(other.channels.into_iter().map(|channel| {
                let (name, direction) = (Some(name.to_owned()), Direction::Vertical);
                Channel { name, direction, ..channel }
            })),
            Err(error) => parsed.vertical_refused = parsed.vertical_refused.or(Some(error)),
        }
    }
    Ok(parsed)
}

/// The series that a table of one column, of two, or of bare values holds; `names` of its columns.
fn series(
    file: &str,
    mut table: NumberTable,
    names: &[&str],
    options: &ReadOptions,
) -> Result<Parsed, RecordError> {
    let milliseconds = table.converts_milliseconds(file, names)?;
    let of_columns = || table.header.last().map(|(_, line)| *line);
    let units = units::declared(&table.header, table.column_name.or_else(of_columns))
        // a row of units below the names
        .or_else(|| names.last()?.parse().ok());
    let quantity = header::quantity(&table.header, names);
    if quantity == Some(header::COUNTS) || table.holds_counts(units.or(options.units)) {
        return Err(RecordError::Counts { file: file.to_owned() });
    }
    let said = || table.header.iter().find_map(|(_, line)| step_in(line));
    let said = || said().map_or((None, 0.0), |(dt, rounding)| (Some(dt), rounding));
    let (mut row_by_row, mut other_step) = (None, None);
    let ((dt, dt_rounding), values) = match table.columns {
        0 | 1 => (said(), table.values),
        _ if table.is_bare(file, options, names)? => {
            row_by_row = Some(table.columns);
            (said(), table.values)
        }
        _ => {
            table.check_times(file, options, quantity)?;
            let step = match table.lines {
                0 | 1 => said(),
                _ => {
                    let (dt, rounding) = table.times.step(file, options.dt)?;
                    other_step = table.other_step(dt, rounding);
                    (Some(dt), rounding)
                }
            };
            (step, table.values.chunks(2).filter_map(|row| row.get(1).copied()).collect())
        }
    };
    let parsed =
        Parsed::bare(Samples { units, quantity, dt, dt_rounding, values, ..Samples::default() });
    Ok(Parsed { row_by_row, milliseconds, other_step, ..parsed })
}

/// Whether a text holds columns of numbers, at least two rows of them.
pub(super) fn hold_numbers(text: &str) -> bool {
    NumberTable::read("", text).is_ok_and(|table| table.lines > 1)
}

/// The numbers of a file, as they stand.
#[derive(Clone, Default)]
struct NumberTable<'a> {
    header: Vec<(usize, &'a str)>,
    columns: usize,
    /// Lines with numbers, and the first of them.
    lines: usize,
    first_line: usize,
    /// Every number, row by row.
    values: Vec<f64>,
    /// The first of several columns.
    times: Times,
    /// The last row, where it has fewer columns: its line and how many.
    short: Option<(usize, usize)>,
    /// Columns without a number that separators at the ends of rows open.
    blank: usize,
    /// No number has a decimal point.
    whole: bool,
    /// The name of the column that was chosen.
    column_name: Option<&'a str>,
}

impl<'a> NumberTable<'a> {
    fn read(file: &str, text: &'a str) -> Result<Self, RecordError> {
        let file_name = || file.to_owned();
        let mut table = Self { whole: true, ..Self::default() };
        // Where the first line with a comma and no point stands: evidence of decimal commas if no
        // line ever has a point.
        let mut comma: Option<(usize, &str)> = None;
        for (line, content) in lines(text).filter(|(_, content)| !content.is_empty()) {
            if is_comment(content) {
                if table.columns == 0 {
                    table.header.push((line, content));
                }
                continue;
            }
            let fields = fields(content);
            if let Some(bad) = fields.iter().find(|field| number(field).is_none()) {
                if has_decimal_commas(content) {
                    return Err(RecordError::DecimalComma {
                        file: file_name(),
                        line,
                        text: quote(content),
                    });
                }
                if table.columns == 0 {
                    table.header.push((line, content));
                    continue;
                }
                return Err(RecordError::NotANumber { file: file_name(), line, text: quote(bad) });
            }
            if table.columns == 0 {
                damaged_first_line(file, table.header.last(), fields.len())?;
                (table.columns, table.first_line) = (fields.len(), line);
            }
            table.blank = table.blank.max(blank_fields(content));
            table.push(file, line, &fields)?;
            table.whole &= !content.contains(['.', 'e', 'E']);
            if content.contains(',') && comma.is_none() {
                comma = Some((line, content));
            }
        }
        let semicolons = || lines(text).any(|(_, content)| content.contains(';'));
        match comma {
            Some((line, content))
                if table.whole && !semicolons() && (table.columns == 2 || table.pairs(content)) =>
            {
                Err(RecordError::DecimalComma { file: file_name(), line, text: quote(content) })
            }
            _ => Ok(table),
        }
    }

    /// One row of numbers.
    fn push(&mut self, file: &str, line: usize, fields: &[&str]) -> Result<(), RecordError> {
        let file = || file.to_owned();
        let ragged =
            |line, found| RecordError::Ragged { file: file(), line, found, expected: self.columns };
        if let Some((line, found)) = self.short {
            return Err(ragged(line, found));
        }
        if fields.len() > self.columns {
            return Err(ragged(line, fields.len()));
        }
        self.short = (fields.len() < self.columns).then_some((line, fields.len()));
        for field in fields {
            match number(field).filter(|value| value.is_finite()) {
                Some(value) => self.values.push(value),
                None => {
                    return Err(RecordError::NotFinite { file: file(), line, text: quote(field) });
                }
            }
        }
        if let [time, _, ..] = fields {
            self.times.push(line, number(time).unwrap_or(f64::NAN), precision(time));
        }
        self.lines += 1;
        Ok(())
    }

    /// The names of the columns, if the last header line has as many fields.
    fn names(&self) -> Vec<&'a str> {
        let Some((_, line)) = self.header.last() else { return Vec::new() };
        let line = line.trim_start_matches(['#', '%', '!', '/']).trim();
        let mut names = fields(line);
        if !line.contains([',', ';']) && names.len() > self.columns {
            names = bracketed(line);
        } else if names.len() <= self.columns + self.blank {
            names.truncate(self.columns);
        }
        if names.len() == self.columns { names } else { Vec::new() }
    }

    /// Whether the columns are halves of decimals.
    fn pairs(&self, content: &str) -> bool {
        pairs_are_decimals(content, self.header.last().map(|(_, line)| *line))
    }

    /// The time step that the header says, if the times have another.
    fn other_step(&self, dt: f64, rounding: f64) -> Option<f64> {
        let said = |line: &str| step_in(line).or_else(|| rate_in(line));
        let (said, digit) = self.header.iter().find_map(|(_, line)| said(line))?;
        let apart = (said - dt).abs();
        (apart > digit + rounding && apart > 0.02 * dt).then_some(said)
    }

    /// Whether the numbers of several columns are one series, row by row: a time step is given, and
    /// the first column is no time.
    fn is_bare(
        &self,
        file: &str,
        options: &ReadOptions,
        names: &[&str],
    ) -> Result<bool, RecordError> {
        let bare = options.dt.is_some() && names.is_empty() && !self.times.run_upwards();
        if self.columns == 2 && !(bare && self.times.run_to_and_fro()) {
            return match self.short {
                Some((line, found)) => Err(RecordError::Ragged {
                    file: file.to_owned(),
                    line,
                    found,
                    expected: self.columns,
                }),
                None => Ok(false),
            };
        }
        if bare {
            return Ok(true);
        }
        let columns = column::list(1, self.columns, names);
        Err(RecordError::TooManyColumns {
            file: file.to_owned(),
            line: self.first_line,
            found: self.columns,
            columns,
        })
    }

    /// Index of the column that is asked for; not that of the times.
    fn index(&self, file: &str, wanted: &str, names: &[&str]) -> Result<usize, RecordError> {
        let file = || file.to_owned();
        if let Some((line, found)) = self.short {
            return Err(RecordError::Ragged { file: file(), line, found, expected: self.columns });
        }
        let times = usize::from(self.is_timed(names));
        column::find(wanted, self.columns, names).filter(|index| *index >= times).ok_or_else(|| {
            let available = column::list(times, self.columns, names);
            let (wanted, several) = (quote(wanted), false);
            RecordError::NoComponent { file: file(), wanted, several, available }
        })
    }

    /// Whether the first column holds times.
    fn is_timed(&self, names: &[&str]) -> bool {
        self.times.run_upwards() || names.first().is_some_and(|name| header::is_time(name))
    }

    /// The table of the times, if there are any, and of one other column, and the names of both.
    fn chosen(&self, index: usize, names: &[&'a str]) -> (Self, Vec<&'a str>) {
        let timed = self.is_timed(names);
        let row = |row: &[f64]| [0, index].map(|i| row.get(i).copied().unwrap_or(f64::NAN));
        let rows = self.values.chunks(self.columns).map(row);
        let values =
            if timed { rows.flatten().collect() } else { rows.map(|[_, value]| value).collect() };
        let kept = if timed { vec![0, index] } else { vec![index] };
        let vertical = column::is_vertical(index, names);
        let mut names: Vec<&str> = kept.iter().filter_map(|i| names.get(*i).copied()).collect();
        let column_name = names.last().copied();
        if let Some(last) = names.last_mut().filter(|_| vertical) {
            // V beside other directions is no velocity
            *last = if last.eq_ignore_ascii_case("v") { "up" } else { last };
        }
        (Self { columns: kept.len(), values, column_name, ..self.clone() }, names)
    }

    /// Whether a first column of times is in ms by its name, and so was converted to s.
    ///
    /// # Errors
    /// It is in another unit.
    fn converts_milliseconds(&mut self, file: &str, names: &[&str]) -> Result<bool, RecordError> {
        let Some((line, last)) = self.header.last().filter(|_| self.columns > 1) else {
            return Ok(false);
        };
        // names with blanks in them are more fields than columns
        let unit = match names.first() {
            Some(name) => TimeUnit::of(name),
            None => TimeUnit::of(last).filter(|_| fields(last).len() > self.columns),
        };
        match unit {
            Some(TimeUnit::Milliseconds) => self.times.take_as_milliseconds(),
            Some(TimeUnit::Other(unit)) => {
                let (file, unit) = (file.to_owned(), quote(unit));
                return Err(RecordError::TimeUnit { file, line: *line, unit });
            }
            Some(TimeUnit::Seconds) | None => return Ok(false),
        }
        Ok(true)
    }

    /// What the column beside the times is called, for a message.
    fn values_column(&self) -> String {
        self.column_name
            .map_or("the second column".into(), |name| format!("column {}", quote(name)))
    }

    /// Refuse a first column of two that is no time.
    fn check_times(
        &self,
        file: &str,
        options: &ReadOptions,
        quantity: Option<&'static str>,
    ) -> Result<(), RecordError> {
        let file = || file.to_owned();
        if let Some(quantity) = quantity {
            return Err(RecordError::NotAcceleration { file: file(), quantity });
        }
        if self.times.count_rows() {
            return Err(RecordError::RowIndex { file: file(), line: self.first_line });
        }
        let mut second = self.values.chunks(2).filter_map(|row| row.get(1));
        let positive = second.clone().all(|value| *value > 0.0);
        let negative = second.all(|value| *value < 0.0);
        let named = self.header.iter().any(|(_, line)| line.to_ascii_lowercase().contains("acc"));
        if (positive || negative) && self.lines >= ONE_SIGN_ROWS && !named && !options.baseline {
            return Err(RecordError::OneSign { file: file(), column: self.values_column() });
        }
        Ok(())
    }

    /// Whole numbers that are too large for an acceleration, or far off zero.
    fn holds_counts(&self, units: Option<Units>) -> bool {
        if !self.whole
            || self.columns == 2
            || self.values.len() < 3
            || units.is_some_and(|units| units.metres_per_second2() <= 1e-3)
        {
            return false;
        }
        let peak = largest_magnitude(&self.values);
        peak > LARGEST_WHOLE
            || self.values.len() >= ONE_SIGN_ROWS && mean(&self.values).abs() > 0.5 * peak
    }
}
