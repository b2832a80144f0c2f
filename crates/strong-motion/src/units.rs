//! The unit of acceleration: given by the user, or read from a header.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::GRAVITY;

/// Unit of acceleration of a record's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String")]
pub enum Units {
    /// Gravity, 9.81 m/s2.
    #[serde(rename = "g")]
    G,
    /// m/s2.
    #[serde(rename = "m/s2")]
    MetrePerSecond2,
    /// cm/s2, the gal.
    #[serde(rename = "cm/s2")]
    CentimetrePerSecond2,
    /// mm/s2.
    #[serde(rename = "mm/s2")]
    MillimetrePerSecond2,
}

/// A unit that is not known.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("unit '{text}' is not known; use g, m/s2, cm/s2 (gal) or mm/s2")]
pub struct UnitsError {
    text: String,
}

impl Units {
    /// How many m/s2 one unit is.
    pub fn metres_per_second2(self) -> f64 {
        match self {
            Self::G => GRAVITY,
            Self::MetrePerSecond2 => 1.0,
            Self::CentimetrePerSecond2 => 0.01,
            Self::MillimetrePerSecond2 => 0.001,
        }
    }
}

impl fmt::Display for Units {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::G => "g",
            Self::MetrePerSecond2 => "m/s2",
            Self::CentimetrePerSecond2 => "cm/s2",
            Self::MillimetrePerSecond2 => "mm/s2",
        })
    }
}

impl TryFrom<String> for Units {
    type Error = UnitsError;

    fn try_from(text: String) -> Result<Self, UnitsError> {
        text.parse()
    }
}

impl FromStr for Units {
    type Err = UnitsError;

    fn from_str(text: &str) -> Result<Self, UnitsError> {
        match normalised(text.trim()).as_str() {
            "g" => Ok(Self::G),
            "m/s2" | "m/s/s" => Ok(Self::MetrePerSecond2),
            "cm/s2" | "cm/s/s" | "gal" => Ok(Self::CentimetrePerSecond2),
            "mm/s2" | "mm/s/s" => Ok(Self::MillimetrePerSecond2),
            _ => Err(UnitsError { text: super::text::quote(text) }),
        }
    }
}

/// The unit that a file's header declares. Lines that say "unit" speak first, then the line of
/// column names, then any line that says "accel"; a header that names two units in the same place
/// has declared none.
pub(super) fn declared(header: &[(usize, &str)], column_names: Option<&str>) -> Option<Units> {
    let after_unit = header.iter().filter_map(|(_, line)| {
        let line = normalised(line);
        let at = line.find("unit")?;
        Some(
            line[at + 4..]
                .trim_start_matches('s')
                .trim_start_matches([' ', ':', '=', '/'])
                .to_owned(),
        )
    });
    let named = column_names.into_iter().map(normalised);
    let accelerations =
        header.iter().map(|(_, line)| normalised(line)).filter(|line| line.contains("accel"));
    [mentioned(after_unit), mentioned(named), mentioned(accelerations)]
        .into_iter()
        .find(|units| !units.is_empty())
        .and_then(|units| if let [only] = units[..] { Some(only) } else { None })
}

/// The different units that the lines mention.
fn mentioned(lines: impl Iterator<Item = String>) -> Vec<Units> {
    let mut found = Vec::new();
    for line in lines {
        for units in [
            Units::G,
            Units::MetrePerSecond2,
            Units::CentimetrePerSecond2,
            Units::MillimetrePerSecond2,
        ] {
            if mentions(&line, units) && !found.contains(&units) {
                found.push(units);
            }
        }
    }
    found
}

/// One spelling for all: lower case, "sec" as "s", no power signs, "_" as "/" (as in accel_m_s2).
pub(super) fn normalised(text: &str) -> String {
    text.to_lowercase()
        .replace("sec", "s")
        .replace("**", "")
        .replace('^', "")
        .replace('²', "2")
        .replace('_', "/")
}

fn mentions(line: &str, units: Units) -> bool {
    let metric = ["m/s2", "m/s/s", "m s-2", "m.s-2", "ms-2", "ms2", "mps2", "m/per/s2"];
    match units {
        Units::G => occurrences(line, "g").any(|(before, after)| g_is_a_unit(before, after)),
        Units::MetrePerSecond2 => metric.iter().any(|name| is_unit(line, name)),
        Units::CentimetrePerSecond2 => {
            is_unit(line, "gal")
                || is_unit(line, "gals")
                || metric.iter().any(|name| is_unit(line, &format!("c{name}")))
        }
        Units::MillimetrePerSecond2 => metric.iter().any(|name| is_unit(line, &format!("m{name}"))),
    }
}

/// Whether the line names the unit on its own; after a number it is a quantity ("PGA 0.3 g"), not a
/// declaration.
fn is_unit(line: &str, name: &str) -> bool {
    occurrences(line, name)
        .any(|(before, _)| !before.trim_end().ends_with(|c: char| c.is_ascii_digit()))
}

/// A lone letter g is a unit where units stand: alone, in brackets, after a separator, after "of"
/// or "in".
fn g_is_a_unit(before: &str, after: &str) -> bool {
    let before = before.trim_end();
    let placed = before.is_empty()
        || before.ends_with(['[', '(', '/', ','])
        || before.ends_with(" of")
        || before.ends_with(" in")
        || before == "of"
        || before == "in";
    placed && !after.trim_start().starts_with('=')
}

/// Every place where the name stands between characters that are no letters or digits: the text
/// before and after it.
pub(super) fn occurrences<'a>(
    line: &'a str,
    name: &'a str,
) -> impl Iterator<Item = (&'a str, &'a str)> {
    line.match_indices(name).map(move |(at, _)| (&line[..at], &line[at + name.len()..])).filter(
        |(before, after)| {
            !before.ends_with(char::is_alphanumeric) && !after.starts_with(char::is_alphanumeric)
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use Units::{CentimetrePerSecond2 as Cm, G, MetrePerSecond2 as M, MillimetrePerSecond2 as Mm};

    fn of_header(line: &str) -> Option<Units> {
        declared(&[(1, line)], None)
    }

    #[test]
    fn headers_of_real_files_name_their_unit() {
        assert_eq!(of_header("ACCELERATION TIME HISTORY IN UNITS OF G"), Some(G));
        assert_eq!(of_header("ACCELERATION TIME SERIES IN UNITS OF G"), Some(G));
        assert_eq!(
            of_header(
                "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.2 Hz LP=15.0 Hz"
            ),
            Some(G)
        );
        assert_eq!(of_header("ACCELERATION IN UNITS OF CM/S/S"), Some(Cm));
        assert_eq!(of_header("ACCELERATION IN UNITS OF CM/SEC**2"), Some(Cm));
        assert_eq!(of_header("ACCELERATION IN UNITS OF M/S/S"), Some(M));
        assert_eq!(of_header("UNITS: cm/s^2"), Some(Cm));
        assert_eq!(of_header("# units = g"), Some(G));
        assert_eq!(of_header("# Corrected acceleration (Gal)"), Some(Cm));
    }

    #[test]
    fn column_names_carry_units() {
        for (names, units) in [
            ("t [s],a [g]", Some(G)),
            ("time_s,accel_m_s2", Some(M)),
            ("Time (s); Acceleration (cm/s²)", Some(Cm)),
            ("t,acc_g", Some(G)),
            ("t\tacc [m/s^2]", Some(M)),
            ("time,acceleration", None),
            ("t [s],a [%g]", None),
            ("t [s],a [mm/s2]", Some(Mm)),
            ("t [s],v [m/s]", None),
        ] {
            assert_eq!(declared(&[], Some(names)), units, "{names}");
        }
    }

    #[test]
    fn a_quantity_with_a_unit_is_no_declaration() {
        assert_eq!(of_header("peak acceleration 341.7 cm/s2, station G"), None);
        assert_eq!(of_header("acceleration, g = 9.81 m/s2"), None);
    }

    #[test]
    fn two_units_in_one_place_declare_none() {
        assert_eq!(of_header("units: cm/s2 or m/s2"), None);
        assert_eq!(declared(&[(1, "acceleration (g)"), (2, "units: cm/s2")], None), Some(Cm));
    }

    #[test]
    fn units_are_parsed_and_printed_alike() {
        for units in [G, M, Cm, Mm] {
            assert_eq!(units.to_string().parse(), Ok(units));
            assert_eq!(serde_json::to_string(&units).unwrap(), format!("\"{units}\""));
        }
        // files take what the command line takes
        for (text, units) in [("m/s^2", M), ("gal", Cm), ("G", G)] {
            assert_eq!(serde_json::from_str::<Units>(&format!("\"{text}\"")).unwrap(), units);
        }
        assert_eq!("gal".parse(), Ok(Cm));
        assert_eq!("M/S^2".parse(), Ok(M));
        assert!("ft/s2".parse::<Units>().unwrap_err().to_string().contains("ft/s2"));
    }
}
