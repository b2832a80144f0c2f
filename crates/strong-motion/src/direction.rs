//! Where a component points: an azimuth, up, or unsaid.

use std::fmt;

use serde::Serialize;

/// Direction of positive acceleration of a component, as its file says it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// Horizontal, degrees clockwise from north, from 0 to below 360.
    Azimuth(f64),
    /// Horizontal, no azimuth given.
    Horizontal,
    /// Up or down.
    Vertical,
    /// The file does not say.
    Unknown,
}

impl Direction {
    /// From degrees clockwise from north, any turn.
    pub(super) fn azimuth(degrees: f64) -> Self {
        if degrees.is_finite() { Self::Azimuth(degrees.rem_euclid(360.0)) } else { Self::Unknown }
    }

    /// From the words of a header: `N28W`, `90 Deg`, `Up`, `E-W`, `HNZ`, `Radial`.
    pub(super) fn of(words: &str) -> Self {
        let words = words.trim().to_ascii_uppercase();
        let first = words.split(|c: char| c.is_whitespace() || c == ',').next().unwrap_or("");
        match first {
            "UP" | "DOWN" | "VERT" | "VERT." | "VERTICAL" | "UD" | "U-D" | "UPDO" | "UPDOWN"
            | "Z" | "V" => {
                return Self::Vertical;
            }
            "N" | "NS" | "N-S" | "NORTH" => return Self::azimuth(0.0),
            "E" | "EW" | "E-W" | "WE" | "EAST" => return Self::azimuth(90.0),
            "S" | "SOUTH" => return Self::azimuth(180.0),
            "W" | "WEST" => return Self::azimuth(270.0),
            "H1" | "H2" | "RADIAL" | "RADL" | "TRANSVERSE" | "TRAN" | "LONG" | "LONGITUDINAL"
            | "TANG" => {
                return Self::Horizontal;
            }
            _ => {}
        }
        bearing(first)
            .or_else(|| {
                let degrees = words[first.len()..].trim_start().starts_with("DEG");
                first.parse().ok().filter(|_| degrees)
            })
            .map_or_else(|| Self::of_seed(first), Self::azimuth)
    }

    /// Whether two directions are known and agree, azimuths to half a degree.
    pub(super) fn same(self, other: Self) -> bool {
        match (self, other) {
            (Self::Azimuth(a), Self::Azimuth(b)) => {
                ((a - b + 180.0).rem_euclid(360.0) - 180.0).abs() <= 0.5
            }
            (Self::Vertical, Self::Vertical) => true,
            _ => false,
        }
    }

    /// From a SEED channel code: its last letter is Z, N, E, or 1, 2, 3.
    fn of_seed(code: &str) -> Self {
        let is_code = code.len() == 3 && matches!(code.as_bytes()[1], b'N' | b'L' | b'G');
        match code.bytes().last().filter(|_| is_code) {
            Some(b'Z') => Self::Vertical,
            Some(b'N') => Self::azimuth(0.0),
            Some(b'E') => Self::azimuth(90.0),
            Some(b'1' | b'2') => Self::Horizontal,
            _ => Self::Unknown,
        }
    }
}

/// Degrees of a bearing from north or south towards east or west: N28W is 332.
fn bearing(text: &str) -> Option<f64> {
    let from_south = match text.chars().next()? {
        'N' => false,
        'S' => true,
        _ => return None,
    };
    let to_west = match text.chars().last()? {
        'E' => false,
        'W' => true,
        _ => return None,
    };
    let angle: f64 =
        text.get(1..text.len() - 1)?.trim().parse().ok().filter(|a| (0.0..=90.0).contains(a))?;
    Some(match (from_south, to_west) {
        (false, false) => angle,
        (true, false) => 180.0 - angle,
        (true, true) => 180.0 + angle,
        (false, true) => 360.0 - angle,
    })
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Azimuth(degrees) => write!(f, "azimuth {degrees}"),
            Self::Horizontal => f.write_str("horizontal"),
            Self::Vertical => f.write_str("vertical"),
            Self::Unknown => f.write_str("direction not given"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bearings of GeoNet's files beside the degrees of their integer headers (332, 242, 196,
    /// 106, 90).
    #[test]
    fn bearings_and_degrees_are_read() {
        for (words, degrees) in [
            ("N28W  Longitudinal Accelerometer Axis", 332.0),
            ("S62W", 242.0),
            ("S16W", 196.0),
            ("S74E", 106.0),
            ("S90E", 90.0),
            ("N00E", 0.0),
            ("90 Deg", 90.0),
            (" 360 Deg  - 2nd floor", 0.0),
            ("E-W", 90.0),
            ("HNN", 0.0),
            ("hne", 90.0),
        ] {
            assert_eq!(Direction::of(words), Direction::Azimuth(degrees), "{words}");
        }
    }

    #[test]
    fn up_is_vertical_and_what_is_not_said_is_unknown() {
        for words in ["Up", "Up    Vertical Accelerometer Axis", "U-D", "HNZ", "BNZ", "Down"] {
            assert_eq!(Direction::of(words), Direction::Vertical, "{words}");
        }
        assert_eq!(Direction::of("HN1"), Direction::Horizontal);
        for words in ["", "?:Other", "12", "N95W", "SN", "S\u{e9}W", "abc"] {
            assert_eq!(Direction::of(words), Direction::Unknown, "{words}");
        }
    }
}
