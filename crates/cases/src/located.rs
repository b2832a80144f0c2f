//! Where in a case file an error stands: the line of the key that it names; and errors of its
//! record in the words of case files.

use super::CaseError;
use files::message::with_words_for;
use strong_motion::{ReadOptions, RecordError};

/// What options are called in a case file, as messages name them; the first that fits.
const KEYS: [(&str, &str); 8] = [
    ("pass --dt SECONDS", "give dt_s"),
    ("pass another --component (name, azimuth), of a table --column", "give another component"),
    ("pass --units", "give units"),
    ("pass --dt", "give dt_s"),
    ("pass --baseline", "give baseline = true"),
    ("--column, a number or a name (", "column, a number or a name ("),
    ("; in a case file column in [record])", ")"),
    ("--units", "units"),
];

impl CaseError {
    /// The same with the line of what it names; `path` and `text` are the case file's. What was
    /// asked for besides is named as it was given.
    pub(super) fn located(self, path: &str, text: &str, asked: &ReadOptions) -> Self {
        let at = |line: Option<usize>| match line {
            Some(line) => format!("{path}, line {line}"),
            None => path.to_owned(),
        };
        match self {
            Self::Value { key, value, remedy, .. } => {
                Self::Value { path: at(line_of(text, key)), key, value, remedy }
            }
            Self::Program { key, value, remedy, .. } => {
                let line = line_of(text, &format!("program.{key}"));
                Self::Program { path: at(line), key, value, remedy }
            }
            Self::Structure { source, .. } => {
                Self::Structure { path: at(line_named(text, &source.to_string())), source }
            }
            Self::Elastic { source, .. } => {
                Self::Elastic { path: at(line_named(text, &source.to_string())), source }
            }
            Self::Record(source) if *asked == ReadOptions::default() => {
                let key = key_of(&source, text);
                Self::OfRecord { path: at(key.and_then(|key| line_of(text, key))), source }
            }
            other => other,
        }
    }
}

/// The key whose value a record's error is about; the file's, unless it is about another.
fn key_of(error: &RecordError, text: &str) -> Option<&'static str> {
    let given = |key: &'static str| line_of(text, key).map(|_| key);
    let special = match error {
        RecordError::NoComponent { .. } => given("record.component").or(given("record.column")),
        RecordError::StepDiffers { .. } => given("record.dt_s"),
        RecordError::UnitsDiffer { .. } => given("record.units"),
        RecordError::NoVertical { .. } | RecordError::VerticalDiffers { .. } => {
            given("record.vertical")
        }
        // the path of the vertical component's file
        RecordError::Unreadable { file, .. } => {
            let line = line_of(text, "record.vertical").and_then(|n| text.lines().nth(n - 1));
            let value = line.and_then(|line| line.split(['"', '\'']).nth(1));
            value.filter(|value| file.ends_with(value)).map(|_| "record.vertical")
        }
        _ => None,
    };
    special.or(Some("record.file"))
}

/// A message of a record that names options, in the keys of files.
pub fn in_keys(message: &str) -> String {
    let keys = KEYS.iter().chain(&[("--dt", "dt_s")]);
    keys.fold(message.to_owned(), |message, (option, key)| with_words_for(&message, option, key))
}

/// The line of a key, from 1: "record.scale", or a key of any section.
fn line_of(text: &str, key: &str) -> Option<usize> {
    let (of, key) = key.split_once('.').map_or((None, key), |(of, key)| (Some(of), key));
    let mut section = String::new();
    text.lines().enumerate().find_map(|(i, line)| {
        let line = line.trim();
        if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.split(']').next()) {
            section = name.trim().to_owned();
        }
        let here = of.is_none_or(|of| of == section);
        // a section by its name
        if of.is_none() && line.starts_with('[') && section == key {
            return Some(i + 1);
        }
        let named = line.split_once('=').is_some_and(|(given, _)| given.trim() == key);
        (here && named).then_some(i + 1)
    })
}

/// The line of the first key of `[structure]` that a message is about: "key is ...", "key and
/// other ...".
fn line_named(text: &str, message: &str) -> Option<usize> {
    let words: Vec<&str> = message.split([' ', ',', ';', ':']).filter(|w| !w.is_empty()).collect();
    let about = |pair: &[&str]| {
        let key = pair[0].contains('_').then(|| format!("structure.{}", pair[0]))?;
        ["is", "and"].contains(&pair[1]).then(|| line_of(text, &key))?
    };
    words.windows(2).find_map(about)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Case;

    const BLOCK: &str =
        "[structure]\nkind = 'block'\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 1200.0\n[record]\n";

    fn said(record: &str) -> String {
        Case::parse("a/case.toml", &format!("{BLOCK}{record}")).unwrap_err().to_string()
    }

    #[test]
    fn an_error_names_the_line_of_its_key() {
        assert!(said("scale = 0.0\n").starts_with("a/case.toml, line 7: record.scale is 0.0"));
        assert_eq!(line_of("[a]\nx = 1\n[b]\nx = 2\n", "b.x"), Some(4));
        assert_eq!(line_of("[a]\nx = 1\n", "b.x"), None);
        assert_eq!(line_of("[a]\nx = 1\n\n[friction]\n", "friction"), Some(4));
        let text = "[structure]\nheight_m = 1.0\nfooting_height_m = 3.0\n";
        let message = "structure: footing_height_m is 3.0 and height_m 1.0";
        assert_eq!(line_named(text, message), Some(3));
        assert_eq!(line_named(text, "structure: check height_m, width_m and masses"), None);
    }

    #[test]
    fn a_record_s_error_speaks_of_keys() {
        let missing = said("file = 'none.AT2'\n");
        assert!(
            missing.starts_with("a/case.toml, line 7: a/none.AT2: cannot be read"),
            "{missing}"
        );
        let file =
            concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/records/20161113_110259_WTMC_20.V2A");
        let none = said(&format!("file = '{file}'\ncomponent = 'N99W'\n"));
        assert!(
            none.starts_with("a/case.toml, line 8: ") && none.ends_with("give another component")
        );
        // what is asked besides is named as it was given
        let asked = ReadOptions { component: Some("N99W".into()), ..ReadOptions::default() };
        let text = format!("{BLOCK}file = '{file}'\n");
        let none = Case::parse_asking("a/case.toml", &text, &asked).unwrap_err().to_string();
        assert!(none.contains("pass another --component"), "{none}");
        for (option, key) in [
            ("pass --dt SECONDS", "give dt_s"),
            ("drop --dt or correct", "drop dt_s or correct"),
            (
                "is cm/s2 but --units is g; drop --units or",
                "is cm/s2 but units is g; drop units or",
            ),
        ] {
            assert_eq!(in_keys(option), key);
        }
    }
}
