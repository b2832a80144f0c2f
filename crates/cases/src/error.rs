//! What is wrong with a case file, and what to do.

use std::path::Path;

use thiserror::Error;

use super::{
    located::in_keys,
    missing,
    plain_words::{in_plain_words, unreadable},
    unknown_key::UnknownKey,
};
use files::message::one_line;
use rocking::{
    members::{MembersError, NO_LEGS, names_legs},
    structure::StructureError,
};
use strong_motion::{RecordError, RecordFormat};

/// What is wrong with a case file, and what to do.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum CaseError {
    #[error("{path}: cannot be read ({source}); check the name of the case file")]
    Read { path: String, source: std::io::Error },
    #[error("{path}, line {line}: {message}")]
    Parse { path: String, line: usize, message: String },
    #[error("{path}: {source}")]
    Structure { path: String, source: StructureError },
    #[error("{path}: {source}")]
    Elastic { path: String, source: frames::structure::ElasticError },
    #[error(
        "{path}: this is an elastic structure, of which tune run alone takes the case; give a \
            rigid body here: kind = \"aframe\" or \"block\""
    )]
    OfElastic { path: String },
    #[error("{path}: {source}")]
    Members { path: String, source: MembersError },
    #[error("{path}: {key} is {value}; {remedy}")]
    Value { path: String, key: &'static str, value: String, remedy: &'static str },
    #[error("{path}: program.{key} is {value}; {remedy}")]
    Program { path: String, key: &'static str, value: String, remedy: String },
    #[error(
        "{path}: {sections}: add what is missing; `tune init{shape}` writes a case with every key \
            explained"
    )]
    Missing { path: String, sections: String, shape: &'static str },
    #[error(
        "{path}: this is a ground motion ({format}), not a case file; give it with --record, or \
            name it in [record] of a case: file = \"{path}\""
    )]
    IsRecord { path: String, format: RecordFormat },
    #[error(
        "{path}: this is JSON, not a case file (TOML); give springs that were tuned with \
            --parameters {path}"
    )]
    IsJson { path: String },
    #[error(
        "{path}: tuning.peaks is {peaks} and tuning.accuracy is {accuracy}; springs are chosen by \
            one of them, leave the other out"
    )]
    TwoYardsticks { path: String, peaks: String, accuracy: String },
    #[error(transparent)]
    Record(#[from] RecordError),
    #[error("{path}: {}", in_keys(&.source.to_string()))]
    OfRecord { path: String, source: RecordError },
    #[error("{path}: not a text file; give a case file (TOML): `tune init` writes one")]
    NotText { path: String },
}

/// The text of a case file.
///
/// # Errors
/// It cannot be read, or is a ground motion.
pub fn text_of(path: &Path) -> Result<String, CaseError> {
    let name = path.display().to_string();
    let read = |source| CaseError::Read { path: name.clone(), source };
    String::from_utf8(files::input::bounded(path).map_err(read)?).map_err(|bytes| {
        let text = String::from_utf8_lossy(bytes.as_bytes());
        match RecordFormat::recognised(&text) {
            Some(format) => CaseError::IsRecord { path: name.clone(), format },
            None => CaseError::NotText { path: name.clone() },
        }
    })
}

/// What is wrong with a case file that TOML or serde refuses.
pub(super) fn case_error(path: &str, text: &str, error: &toml::de::Error) -> CaseError {
    let path = || path.to_owned();
    if let Some(format) = RecordFormat::recognised(text) {
        return CaseError::IsRecord { path: path(), format };
    }
    if text.trim_start().starts_with('{') {
        return CaseError::IsJson { path: path() };
    }
    let whole = error.message().lines().next().unwrap_or_default();
    let unknown = UnknownKey::of(whole).is_some();
    if let Some((line, key)) = misspelt_kind(text).filter(|_| unknown) {
        let message = format!("unknown key \"{}\"; did you mean \"kind\"?", one_line(key));
        return CaseError::Parse { path: path(), line, message };
    }
    let missing = match text.parse::<toml::Table>() {
        Ok(file) if missing::is_field(whole).is_some() => missing::sections(&file),
        // without a kind no key of [structure] can be judged
        Ok(file) if unknown && missing::no_kind(&file) => missing::sections(&file),
        _ => None,
    };
    match missing {
        Some((sections, shape)) => CaseError::Missing { path: path(), sections, shape },
        None => parse_error(&path(), text, error),
    }
}

/// The line of the error, and for an unknown key the nearest known one.
pub fn parse_error(path: &str, text: &str, error: &toml::de::Error) -> CaseError {
    let line =
        error.span().map_or(1, |span| text[..span.start.min(text.len())].matches('\n').count() + 1);
    let whole = error.message().lines().next().unwrap_or_default();
    // of an unknown key where it stands: TOML may name the section's first line
    let named = |key: &str| {
        text.lines().position(|line| line.split_once('=').is_some_and(|(k, _)| k.trim() == key))
    };
    let unknown = UnknownKey::of(whole);
    let mistaken = unknown.as_ref().and_then(|unknown| named(&unknown.key));
    let line = mistaken.or_else(|| of_another_type(whole, text)).map_or(line, |i| i + 1);
    // serde's names of numbers are not a user's
    let message = ["usize", "u64", "u32"]
        .iter()
        .fold(one_line(whole).replace("expected f64", "expected a number"), |message, rust| {
            message.replace(&format!("expected {rust}"), "expected a whole number")
        });
    if let Some(message) = text.lines().nth(line - 1).and_then(decimal_comma) {
        return CaseError::Parse { path: path.into(), line, message };
    }
    if message.starts_with("unknown variant `impact`") {
        let message =
            "objective \"impact\" is now landing; write objective = \"landing\"".to_string();
        return CaseError::Parse { path: path.into(), line, message };
    }
    if message.starts_with("unknown variant `pier`")
        || message.starts_with("unknown variant `frame`")
    {
        let message = "this kind is an elastic structure, whose case files tune run takes; give \
            \"aframe\" or \"block\" here";
        return CaseError::Parse { path: path.into(), line, message: message.into() };
    }
    if names_legs(&message) {
        return CaseError::Parse { path: path.into(), line, message: NO_LEGS.into() };
    }
    let kinds = "expected `aframe`, `block`, `pier` or `frame`";
    let message = ["expected `aframe` or `block`", "expected one of `pier`, `aframe`, `frame`"]
        .iter()
        .fold(message, |message, short| message.replace(short, kinds));
    // of the whole message: all known keys, the nearest one among them
    let given = text.lines().nth(line - 1).unwrap_or_default();
    let plain = match unknown {
        Some(_) => None,
        None if text.parse::<toml::Table>().is_err() => unreadable(&message, given),
        None => in_plain_words(&message, given),
    };
    if let Some(message) = plain {
        return CaseError::Parse { path: path.into(), line, message };
    }
    let message = match unknown {
        Some(unknown) => {
            format!("unknown key \"{}\"; {}", one_line(&unknown.key), unknown.advice())
        }
        None if message.contains(';') => message,
        None => format!("{message}; mend this line"),
    };
    CaseError::Parse { path: path.into(), line, message }
}

/// Where a value of another type stands, by serde's message: TOML may name the section's first
/// line.
fn of_another_type(message: &str, text: &str) -> Option<usize> {
    let given = message.strip_prefix("invalid type: ")?.split_once(", expected")?.0;
    let values = || text.lines().map(|line| line.split_once('=').map(|(_, value)| value.trim()));
    if let Some(value) = given.strip_prefix("string ") {
        return values().position(|given| given.is_some_and(|given| given.starts_with(value)));
    }
    let number: f64 = given.strip_prefix("floating point ")?.trim_matches('`').parse().ok()?;
    let is_it = |value: &str| {
        value.split('#').next().is_some_and(|value| {
            value.contains(['.', 'e', 'E']) && value.trim().parse() == Ok(number)
        })
    };
    // one of several that are alike may be meant
    let mut those = values().enumerate().filter(|(_, given)| given.is_some_and(is_it));
    those.next().filter(|_| those.next().is_none()).map(|(i, _)| i)
}

/// The line and the name of a key that stands for `kind`, where there is none: all other keys hang
/// on it.
fn misspelt_kind(text: &str) -> Option<(usize, &str)> {
    let keys = || {
        text.lines()
            .enumerate()
            .filter_map(|(i, line)| Some((i + 1, line.split_once('=')?.0.trim())))
    };
    let near = |(_, key): &(usize, &str)| strsim::damerau_levenshtein(key, "kind") <= 2;
    keys().find(near).filter(|_| keys().all(|(_, key)| key != "kind"))
}

/// What to say of a line like `height_m = 1,9`.
fn decimal_comma(line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let value = value.split('#').next()?.trim();
    let (whole, decimals) =
        value.split_once(',').filter(|(_, decimals)| !decimals.contains(','))?;
    let point = format!("{whole}.{decimals}");
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let is_number = digits(whole.trim_start_matches(['+', '-']))
        && decimals.starts_with(|c: char| c.is_ascii_digit());
    point.parse::<f64>().ok().filter(|_| is_number)?;
    // three digits may be thousands
    let or = if digits(decimals) && decimals.len() == 3 {
        format!(", or {whole}{decimals}")
    } else {
        String::new()
    };
    let (key, value) = (one_line(key.trim()), one_line(value));
    Some(format!(
        "{key} is {value}, a number with a comma; write it with a point: {}{or}",
        one_line(&point)
    ))
}

#[cfg(test)]
mod tests {
    use super::decimal_comma;

    #[test]
    fn numbers_with_commas_are_seen() {
        let said = decimal_comma("height_m = 1,9  # m").unwrap();
        assert_eq!(said, "height_m is 1,9, a number with a comma; write it with a point: 1.9");
        assert!(decimal_comma("mass_kg=-1,5e3").unwrap().ends_with(": -1.5e3"));
        assert!(decimal_comma("mass_kg = 680,100").unwrap().ends_with(": 680.100, or 680100"));
        for fine in [
            "x = [1, 9]",
            "x = [1,9]",
            "x = 1,2,3",
            "x = \"1,9\"",
            "x = 1, 9",
            "x 1,9",
            "x = ,9",
            "x = 1,",
        ] {
            assert_eq!(decimal_comma(fine), None, "{fine}");
        }
    }
}
