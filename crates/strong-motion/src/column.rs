//! Which column of a table is the acceleration: by its number, counted from 1, or by its name in
//! the header.

use std::{convert::Infallible, str::FromStr};

use serde::{Deserialize, Serialize};

use super::Direction;
use super::text::quote;

/// A column of a table, as it is asked for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum TableColumn {
    /// Counted from 1; a column of times counts, too.
    Number(usize),
    /// What the header calls it.
    Name(String),
}

impl FromStr for TableColumn {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(text.trim().parse().map_or_else(|_| Self::Name(text.to_owned()), Self::Number))
    }
}

impl TableColumn {
    /// The same as `ReadOptions::component` takes it: a column is the component of a table.
    pub fn component(&self) -> String {
        match self {
            Self::Number(number) => format!("{WORD} {number}"),
            Self::Name(name) => name.clone(),
        }
    }
}

/// What a column is called beside its number.
const WORD: &str = "column";

/// Index of the column that is asked for: "column 3", or a name of the header, with its unit or
/// without.
pub(super) fn find(wanted: &str, columns: usize, names: &[&str]) -> Option<usize> {
    let wanted = wanted.trim();
    let number = wanted.strip_prefix(WORD).and_then(|number| number.trim().parse::<usize>().ok());
    if let Some(number) = number {
        return number.checked_sub(1).filter(|index| *index < columns);
    }
    let is =
        |name: &&str| name.eq_ignore_ascii_case(wanted) || bare(name).eq_ignore_ascii_case(wanted);
    let only = |test: &dyn Fn(usize) -> bool| {
        let mut found = (0..names.len()).filter(|i| test(*i));
        let first = found.next();
        // a name that two columns have says nothing
        (first.filter(|_| found.next().is_none()), first.is_some())
    };
    let (found, named) = only(&|i| is(&names[i]));
    match Direction::of(wanted) {
        Direction::Vertical if !named => only(&|i| is_vertical(i, names)).0,
        _ => found,
    }
}

/// A column's name without its unit: "acc_2 [g]" is "acc_2".
fn bare(name: &str) -> String {
    name.split(['[', '(']).next().unwrap_or(name).trim().to_owned()
}

/// Whether a column's name says that it is of the vertical motion: UP, UD, Z, V, vertical. V alone
/// may be a velocity; beside a column of another direction it is none.
pub(super) fn is_vertical(index: usize, names: &[&str]) -> bool {
    let direction = |i: usize| names.get(i).map(|name| Direction::of(&bare(name)));
    let across = |i| matches!(direction(i), Some(Direction::Azimuth(_) | Direction::Horizontal));
    direction(index) == Some(Direction::Vertical)
        && (!bare(names[index]).eq_ignore_ascii_case("v") || (0..names.len()).any(across))
}

/// The columns after the first `skipped`, for a message: "column 2 (acc1), column 3 (acc2)".
pub(super) fn list(skipped: usize, columns: usize, names: &[&str]) -> String {
    let shown = |i: usize| match names.get(i) {
        Some(name) => format!("{WORD} {} ({})", i + 1, quote(name)),
        None => format!("{WORD} {}", i + 1),
    };
    let first: Vec<String> = (skipped..columns).take(MOST_LISTED).map(shown).collect();
    let more = if columns - skipped > first.len() { ", ..." } else { "" };
    format!("{}{more}", first.join(", "))
}

/// Columns named in a message.
const MOST_LISTED: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_number_and_by_name() {
        let names = ["t [s]", "acc1 [g]", "acc2 [g]", "acc2 [m/s2]"];
        assert_eq!(find("column 3", 4, &[]), Some(2));
        assert_eq!(find("column 0", 4, &[]), None);
        assert_eq!(find("column 5", 4, &names), None);
        assert_eq!(find("ACC1", 4, &names), Some(1));
        assert_eq!(find("acc2", 4, &names), None);
        assert_eq!(find("acc2 [m/s2]", 4, &names), Some(3));
        assert_eq!(list(1, 3, &names[..3]), "column 2 (acc1 [g]), column 3 (acc2 [g])");
        assert_eq!(list(1, 9, &[]), "column 2, column 3, column 4, column 5, ...");
    }

    #[test]
    fn columns_of_the_vertical_motion_are_known_by_their_names() {
        for name in ["UP", "ud", "Z", "V [g]", "vertical (cm/s2)", "Vertical"] {
            assert!(is_vertical(2, &["time", "EW", name]), "{name}");
            assert_eq!(find("up", 3, &["time", "EW", name]), Some(2), "{name}");
        }
        assert!(!is_vertical(2, &["t", "a", "v"]) && !is_vertical(1, &["t", "EW", "UP"]));
        assert_eq!(find("up", 3, &["t", "UD", "Z"]), None);
    }

    #[test]
    fn a_column_is_a_component() {
        let column = |text: &str| text.parse::<TableColumn>().map(|column| column.component());
        assert_eq!(column("3"), Ok("column 3".into()));
        assert_eq!(column("acc2"), Ok("acc2".into()));
    }
}
