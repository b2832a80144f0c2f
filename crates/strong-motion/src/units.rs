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
    /// A thousandth of gravity.
    #[serde(rename = "mg")]
    MilliG,
    /// A hundredth of gravity.
    #[serde(rename = "%g")]
    PercentG,
    /// ft/s2, of the international foot, 0.3048 m.
    #[serde(rename = "ft/s2")]
    FootPerSecond2,
    /// in/s2, of the inch of 0.0254 m.
    #[serde(rename = "in/s2")]
    InchPerSecond2,
    /// A thousandth of a gal, 1e-5 m/s2.
    #[serde(rename = "mGal")]
    MilliGal,
}

/// All units, for messages.
pub(super) const KNOWN: &str = "g, m/s2, cm/s2 (gal), mm/s2, mg, %g, ft/s2, in/s2 or mGal";

/// A unit that is not known.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("unit '{text}' is not known; use {KNOWN}")]
pub struct UnitsError {
    text: String,
}

impl Units {
    const ALL: [Self; 9] = [
        Self::G,
        Self::MetrePerSecond2,
        Self::CentimetrePerSecond2,
        Self::MillimetrePerSecond2,
        Self::MilliG,
        Self::PercentG,
        Self::FootPerSecond2,
        Self::InchPerSecond2,
        Self::MilliGal,
    ];

    /// How many m/s2 one unit is.
    pub fn metres_per_second2(self) -> f64 {
        match self {
            Self::G => GRAVITY,
            Self::MetrePerSecond2 => 1.0,
            Self::CentimetrePerSecond2 => 0.01,
            Self::MillimetrePerSecond2 => 0.001,
            Self::MilliG => GRAVITY / 1000.0,
            Self::PercentG => GRAVITY / 100.0,
            Self::FootPerSecond2 => 0.3048,
            Self::InchPerSecond2 => 0.0254,
            Self::MilliGal => 1e-5,
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
            Self::MilliG => "mg",
            Self::PercentG => "%g",
            Self::FootPerSecond2 => "ft/s2",
            Self::InchPerSecond2 => "in/s2",
            Self::MilliGal => "mGal",
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
            "mg" => Ok(Self::MilliG),
            "%g" => Ok(Self::PercentG),
            "ft/s2" | "ft/s/s" => Ok(Self::FootPerSecond2),
            "in/s2" | "in/s/s" => Ok(Self::InchPerSecond2),
            "mgal" => Ok(Self::MilliGal),
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
        for units in Units::ALL {
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
    let of_g = |name| occurrences(line, name).any(|(before, after)| g_is_a_unit(before, after));
    let by_time = |of: &str| metric.iter().any(|name| is_unit(line, &name.replacen('m', of, 1)));
    match units {
        Units::G => of_g("g"),
        Units::MilliG => of_g("mg"),
        // a line that begins with it is a comment about g
        Units::PercentG => occurrences(line, "%g")
            .chain(occurrences(line, "% g"))
            .any(|(before, after)| !before.trim().is_empty() && g_is_a_unit(before, after)),
        Units::FootPerSecond2 => by_time("ft") || is_unit(line, "fps2"),
        Units::InchPerSecond2 => by_time("in") || is_unit(line, "ips2"),
        Units::MilliGal => is_unit(line, "mgal") || is_unit(line, "mgals"),
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
    use Units::{
        CentimetrePerSecond2 as Cm, FootPerSecond2, G, InchPerSecond2, MetrePerSecond2 as M,
        MilliG, MilliGal, MillimetrePerSecond2 as Mm, PercentG,
    };

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
            ("t [s],a [%g]", Some(PercentG)),
            ("time (s) acc (mg)", Some(MilliG)),
            ("time (s) acc (ft/s2)", Some(FootPerSecond2)),
            ("Time(s)\tAcc(in/s2)", Some(InchPerSecond2)),
            ("t [s],a [in/sec^2]", Some(InchPerSecond2)),
            ("time (s) acc (mGal)", Some(MilliGal)),
            ("t [s],a [furlong/s2]", None),
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
        assert_eq!(of_header("acceleration, peak 120 mg"), None);
        assert_eq!(of_header("% g of the acceleration"), None);
    }

    #[test]
    fn two_units_in_one_place_declare_none() {
        assert_eq!(of_header("units: cm/s2 or m/s2"), None);
        assert_eq!(declared(&[(1, "acceleration (g)"), (2, "units: cm/s2")], None), Some(Cm));
    }

    #[test]
    fn units_are_parsed_and_printed_alike() {
        for units in Units::ALL {
            assert_eq!(units.to_string().parse(), Ok(units));
            assert_eq!(serde_json::to_string(&units).unwrap(), format!("\"{units}\""));
        }
        // files take what the command line takes
        for (text, units) in [("m/s^2", M), ("gal", Cm), ("G", G)] {
            assert_eq!(serde_json::from_str::<Units>(&format!("\"{text}\"")).unwrap(), units);
        }
        assert_eq!("gal".parse(), Ok(Cm));
        assert_eq!("M/S^2".parse(), Ok(M));
        for text in ["ft/min2", "kg", "mm"] {
            let said = text.parse::<Units>().unwrap_err().to_string();
            assert!(
                said.starts_with(&format!("unit '{text}' is not known; use g, m/s2")),
                "{said}"
            );
        }
    }

    /// By the definitions: foot and inch of 1959, gal of 0.01 m/s2; g is the project's, 9.81 m/s2.
    #[test]
    fn units_are_as_large_as_their_definitions_say() {
        for (text, metres) in [
            ("g", 9.81),
            ("mg", 0.00981),
            ("%g", 0.0981),
            ("m/s2", 1.0),
            ("gal", 0.01),
            ("mGal", 1e-5),
            ("mm/s2", 1e-3),
            ("ft/s2", 0.3048),
            ("in/s2", 0.3048 / 12.0),
        ] {
            let found = text.parse::<Units>().unwrap().metres_per_second2();
            assert!((found / metres - 1.0).abs() < 1e-15, "{text}: {found}");
        }
    }
}
