//! A line of a table: its fields, and what is wrong with it.

use crate::RecordError;
use crate::header::is_comment;
use crate::text::{number, quote};

/// The fields of a line: between semicolons if it has any, else between commas, else between
/// blanks.
pub(super) fn fields(content: &str) -> Vec<&str> {
    let clean = |field: &'_ str| field.trim().trim_matches('"').trim().len();
    let separator = [';', ','].into_iter().find(|&c| content.contains(c));
    let mut fields: Vec<&str> = match separator {
        Some(separator) => {
            content.split(separator).map(|field| field.trim().trim_matches('"').trim()).collect()
        }
        None => content.split_whitespace().map(|field| field.trim_matches('"')).collect(),
    };
    // a separator at the end of the line opens no column
    if fields.len() > 1 && fields.last().is_some_and(|field| clean(field) == 0) {
        fields.pop();
    }
    fields
}

/// Several tokens (between semicolons or blanks), all of them like `0,01`.
pub(super) fn has_decimal_commas(content: &str) -> bool {
    let mut tokens =
        content.split(|c: char| c == ';' || c.is_whitespace()).filter(|token| !token.is_empty());
    let decimal =
        |token: &str| token.matches(',').count() == 1 && number(&token.replace(',', ".")).is_some();
    let plain = |token: &str| number(token).is_some();
    let mut commas = 0;
    tokens.all(|token| {
        commas += usize::from(decimal(token));
        decimal(token) && !token.starts_with(',') && !token.ends_with(',') || plain(token)
    }) && commas > 0
}

/// A line right above the data that begins with a number and has as many fields is data gone wrong,
/// not a header.
pub(super) fn damaged_first_line(
    file: &str,
    above: Option<&(usize, &str)>,
    columns: usize,
) -> Result<(), RecordError> {
    let Some((line, content)) = above.filter(|(_, content)| !is_comment(content)) else {
        return Ok(());
    };
    let fields = fields(content);
    match fields.iter().find(|field| number(field).is_none()) {
        Some(bad) if fields.len() == columns && number(fields[0]).is_some() => {
            Err(RecordError::NotANumber { file: file.to_owned(), line: *line, text: quote(bad) })
        }
        _ => Ok(()),
    }
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
}
