//! Columns of text: (time, acceleration) or acceleration alone, separated by commas, semicolons, tabs or blanks, below
//! any number of header lines; lines that start with #, % or // are comments.

use super::text::{lines, number, precision, quote};
use super::timing::Times;
use super::{RecordError, Samples, units};

pub(super) fn is_comment(line: &str) -> bool {
    line.starts_with(['#', '%', '!']) || line.starts_with("//")
}

/// Velocity or displacement, when the header says that its numbers are that: no line names acceleration, or a line
/// about the time series or its unit names the other quantity and none of these names acceleration.
pub(super) fn other_quantity(header: &[(usize, &str)]) -> Option<&'static str> {
    let lower: Vec<String> = header.iter().map(|(_, line)| line.to_ascii_lowercase()).collect();
    let about: Vec<&String> =
        lower.iter().filter(|line| ["unit", "series", "history"].iter().any(|word| line.contains(word))).collect();
    ["velocity", "displacement"].into_iter().find(|word| {
        let only = lower.iter().any(|line| line.contains(word)) && !lower.iter().any(|line| line.contains("acc"));
        only || about.iter().any(|line| line.contains(word)) && !about.iter().any(|line| line.contains("acc"))
    })
}

/// The samples, in the file's own unit; the time step comes from the time column, else from the header.
pub(super) fn parse(file: &str, text: &str, given_dt: Option<f64>) -> Result<Samples, RecordError> {
    let file_name = || file.to_owned();
    let mut header: Vec<(usize, &str)> = Vec::new();
    let mut columns = 0;
    let mut times = Times::default();
    let mut values = Vec::new();
    // Where the first line with a comma and no point stands: evidence of decimal commas if no line ever has a point.
    let mut comma: Option<(usize, &str)> = None;
    let mut point = false;

    for (line, content) in lines(text).filter(|(_, content)| !content.is_empty()) {
        if is_comment(content) {
            if columns == 0 {
                header.push((line, content));
            }
            continue;
        }
        let fields = fields(content);
        let bad = fields.iter().find(|field| number(field).is_none());
        if let Some(bad) = bad {
            if has_decimal_commas(content) {
                return Err(RecordError::DecimalComma { file: file_name(), line, text: quote(content) });
            }
            if columns == 0 {
                header.push((line, content));
                continue;
            }
            return Err(RecordError::NotANumber { file: file_name(), line, text: quote(bad) });
        }
        if columns == 0 {
            damaged_first_line(file, header.last(), fields.len())?;
            if fields.len() > 2 {
                return Err(RecordError::TooManyColumns { file: file_name(), line, found: fields.len() });
            }
            columns = fields.len();
        }
        if fields.len() != columns {
            let (found, expected) = (fields.len(), columns);
            return Err(RecordError::Ragged { file: file_name(), line, found, expected });
        }
        for field in &fields {
            match number(field) {
                Some(value) if value.is_finite() => {}
                _ => return Err(RecordError::NotFinite { file: file_name(), line, text: quote(field) }),
            }
        }
        if let [time, _] = fields[..] {
            times.push(line, number(time).unwrap_or(f64::NAN), precision(time));
        }
        values.extend(fields.last().and_then(|field| number(field)));
        point |= content.contains(['.', 'e', 'E', ';']);
        if content.contains(',') && comma.is_none() {
            comma = Some((line, content));
        }
    }
    if let (Some((line, content)), false, 2) = (comma, point, columns) {
        return Err(RecordError::DecimalComma { file: file_name(), line, text: quote(content) });
    }

    let (dt, dt_rounding) = match (columns, values.len()) {
        (2, 2..) => times.step(file, given_dt).map(|(dt, rounding)| (Some(dt), rounding))?,
        _ => header.iter().find_map(|(_, line)| step_in(line)).map_or((None, 0.0), |(dt, r)| (Some(dt), r)),
    };
    let names = header.last().map(|(_, line)| *line);
    Ok(Samples { units: units::declared(&header, names), quantity: other_quantity(&header), dt, dt_rounding, values })
}

/// The fields of a line: between semicolons if it has any, else between commas, else between blanks.
fn fields(content: &str) -> Vec<&str> {
    let clean = |field: &'_ str| field.trim().trim_matches('"').trim().len();
    let separator = [';', ','].into_iter().find(|&c| content.contains(c));
    let mut fields: Vec<&str> = match separator {
        Some(separator) => content.split(separator).map(|field| field.trim().trim_matches('"').trim()).collect(),
        None => content.split_whitespace().map(|field| field.trim_matches('"')).collect(),
    };
    // a separator at the end of the line opens no column
    if fields.len() > 1 && fields.last().is_some_and(|field| clean(field) == 0) {
        fields.pop();
    }
    fields
}

/// Several tokens (between semicolons or blanks), all of them like `0,01`.
fn has_decimal_commas(content: &str) -> bool {
    let mut tokens = content.split(|c: char| c == ';' || c.is_whitespace()).filter(|token| !token.is_empty());
    let decimal = |token: &str| token.matches(',').count() == 1 && number(&token.replace(',', ".")).is_some();
    let plain = |token: &str| number(token).is_some();
    let mut commas = 0;
    tokens.all(|token| {
        commas += usize::from(decimal(token));
        decimal(token) && !token.starts_with(',') && !token.ends_with(',') || plain(token)
    }) && commas > 0
}

/// A line right above the data that begins with a number and has as many fields is data gone wrong, not a header.
fn damaged_first_line(file: &str, above: Option<&(usize, &str)>, columns: usize) -> Result<(), RecordError> {
    let Some((line, content)) = above.filter(|(_, content)| !is_comment(content)) else { return Ok(()) };
    let fields = fields(content);
    match fields.iter().find(|field| number(field).is_none()) {
        Some(bad) if fields.len() == columns && number(fields[0]).is_some() => {
            Err(RecordError::NotANumber { file: file.to_owned(), line: *line, text: quote(bad) })
        }
        _ => Ok(()),
    }
}

/// The time step in a header line such as `# dt = 0.01 s`, `SAMPLING_INTERVAL_S: 0.005`, and half its last digit.
fn step_in(line: &str) -> Option<(f64, f64)> {
    let lower = line.to_ascii_lowercase();
    let is_word = |at: usize, name: &str| {
        !lower[..at].ends_with(|c: char| c.is_alphanumeric())
            && !lower[at + name.len()..].starts_with(|c: char| c.is_alphanumeric())
    };
    let after = ["dt", "delta_t", "sampling_interval_s", "sampling interval", "time step", "timestep"]
        .into_iter()
        .find_map(|name| {
            lower.match_indices(name).find(|&(at, _)| is_word(at, name)).map(|(at, _)| &lower[at + name.len()..])
        })?;
    let token = after
        .split(|c: char| c.is_whitespace() || matches!(c, '=' | ':' | ',' | ';' | '(' | ')' | '[' | ']'))
        .map(|token| token.trim_end_matches("sec").trim_end_matches('s'))
        .find(|token| !token.is_empty())?;
    let dt = number(token).filter(|dt| dt.is_finite() && *dt > 0.0)?;
    Some((dt, 0.5 * 10_f64.powi(precision(token).0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_may_be_mixed_with_blanks_and_trail() {
        assert_eq!(fields("0.01, 0.5"), ["0.01", "0.5"]);
        assert_eq!(fields("0.01;0.5;"), ["0.01", "0.5"]);
        assert_eq!(fields("0.01\t 0.5"), ["0.01", "0.5"]);
        assert_eq!(fields("\"0.01\",\"0.5\""), ["0.01", "0.5"]);
        assert_eq!(fields("0.01,,0.5"), ["0.01", "", "0.5"]);
    }

    #[test]
    fn decimal_commas_are_seen() {
        assert!(has_decimal_commas("0,01;0,002"));
        assert!(has_decimal_commas("0,01 -0,002e-3"));
        assert!(has_decimal_commas("0;0,002"));
        assert!(!has_decimal_commas("0.01, 0.002"));
        assert!(!has_decimal_commas("time, acc"));
    }

    #[test]
    fn time_steps_are_found_in_header_lines() {
        assert_eq!(step_in("# dt = 0.01 s"), Some((0.01, 0.005)));
        assert_eq!(step_in("SAMPLING_INTERVAL_S: 0.005000"), Some((0.005, 0.5e-6)));
        assert_eq!(step_in("# width 3, dt=.02sec"), Some((0.02, 0.005)));
        assert_eq!(step_in("# t, a"), None);
        assert_eq!(step_in("# dt unknown"), None);
    }
}
