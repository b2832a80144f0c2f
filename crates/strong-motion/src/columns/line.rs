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
    // separators at the end of the line open no columns
    while fields.len() > 1 && fields.last().is_some_and(|field| clean(field) == 0) {
        fields.pop();
    }
    fields
}

/// How many columns the separators at the end of a line would open.
pub(super) fn blank_fields(content: &str) -> usize {
    let separator = [';', ','].into_iter().find(|&c| content.contains(c));
    separator
        .map_or(0, |c| content.split(c).rev().take_while(|field| field.trim().is_empty()).count())
}

/// The names between blanks, each with what follows it in brackets: `time (s) acc (g)` are two.
pub(super) fn bracketed(line: &str) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    let mut from = 0;
    for word in line.split_whitespace() {
        // the words of a line stand in it in this order
        let at = line[from..].find(word).map_or(from, |at| from + at);
        let end = at + word.len();
        let open = |name: &str| name.contains(['(', '[']) && !name.ends_with([')', ']']);
        let last = names.last().copied();
        match last.filter(|last| word.starts_with(['(', '[']) || open(last)) {
            Some(last) => {
                let begin = from - last.len();
                names.pop();
                names.push(&line[begin..end]);
            }
            None => names.push(&line[at..end]),
        }
        from = end;
    }
    names
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

/// Whether a line of whole numbers between commas is one of decimals between commas, `0,0100,0,25`:
/// pairs, of which there are as many as names, or a second number that begins with a zero.
pub(super) fn pairs_are_decimals(content: &str, names: Option<&str>) -> bool {
    let parts: Vec<&str> = content.split(',').map(str::trim).collect();
    let names = names.map_or(0, |line| fields(line).len());
    let zero = |part: &&&str| part.len() > 1 && part.starts_with('0');
    parts.len().is_multiple_of(2)
        && parts.len() > 2
        && (2 * names == parts.len() || parts.iter().skip(1).step_by(2).any(|part| zero(&part)))
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
        assert_eq!(fields("0.01,0.5,,"), ["0.01", "0.5"]);
        assert_eq!(["0.01,0.5,,", "0.01;0.5", "1 2 "].map(blank_fields), [2, 0, 0]);
    }

    #[test]
    fn a_unit_in_brackets_belongs_to_the_name_before_it() {
        assert_eq!(bracketed("time (s) a (g)  v (m/s)"), ["time (s)", "a (g)", "v (m/s)"]);
        assert_eq!(bracketed("t\ta [in / s2] b"), ["t", "a [in / s2]", "b"]);
        assert_eq!(bracketed("time acc"), ["time", "acc"]);
        assert_eq!(bracketed("(s) (g)"), ["(s) (g)"]);
        assert_eq!(bracketed(""), Vec::<&str>::new());
    }

    #[test]
    fn decimal_commas_are_seen() {
        assert!(has_decimal_commas("0,01;0,002"));
        assert!(has_decimal_commas("0,01 -0,002e-3"));
        assert!(has_decimal_commas("0;0,002"));
        assert!(!has_decimal_commas("0.01, 0.002"));
        assert!(!has_decimal_commas("time, acc"));
        assert!(pairs_are_decimals("0,0100,-0,00000167", None));
        assert!(pairs_are_decimals("1,25,3,5", Some("time [s],acc [g]")));
        assert!(!pairs_are_decimals("1,25,3,5", Some("t,a,b,c")));
        assert!(!pairs_are_decimals("1,25,3", Some("t,a,b")));
    }
}
