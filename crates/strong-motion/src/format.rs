//! Which format a file is in, by what it says and not by its name.

use std::fmt;

use serde::{Serialize, Serializer};

use super::parsed::Parsed;
use super::text::lines;
use super::{ReadOptions, RecordError, at2, columns, cosmos, csmip, dyna, geonet, knet};

/// Format of a record file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordFormat {
    /// PEER AT2, both forms of its header.
    Peer,
    /// GeoNet, New Zealand: V1A (uncorrected) and V2A (corrected), three components a file.
    GeoNet,
    /// COSMOS, format 1.20 and alike: V1 and V2c, one or several channels a file.
    Cosmos,
    /// CSMIP .V2 of the Californian network and CESMD, several channels a file.
    Csmip,
    /// K-NET and KiK-net, Japan: one component a file.
    KNet,
    /// ESM, ITACA, AFAD (DYNA 1.x): one component a file.
    Dyna,
    /// Columns of text: time and acceleration, acceleration alone, or bare values read row by row.
    /// The last of them, for it is what a text is of no other format.
    Columns,
}

impl fmt::Display for RecordFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Peer => "PEER AT2",
            Self::GeoNet => "GeoNet",
            Self::Cosmos => "COSMOS",
            Self::Csmip => "CSMIP",
            Self::KNet => "K-NET",
            Self::Dyna => "ESM/ITACA/AFAD",
            Self::Columns => "columns",
        })
    }
}

impl Serialize for RecordFormat {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// How far down a file says what it is.
const HEAD_LINES: usize = 100;

impl RecordFormat {
    /// Every format, in the order in which a file is asked whether it is of it.
    pub const ALL: [Self; Self::Columns as usize + 1] = [
        Self::Cosmos,
        Self::GeoNet,
        Self::Csmip,
        Self::KNet,
        Self::Dyna,
        Self::Peer,
        Self::Columns,
    ];

    /// The format that the first lines speak; columns if none.
    pub(super) fn of(text: &str) -> Self {
        let head: Vec<&str> = lines(text).take(HEAD_LINES).map(|(_, line)| line).collect();
        Self::ALL.into_iter().find(|format| format.is_of(text, &head)).unwrap_or(Self::Columns)
    }

    /// Whether a text is of this format; `head` are its first lines without blanks around them.
    fn is_of(self, text: &str, head: &[&str]) -> bool {
        match self {
            Self::Peer => at2::header_line(text).is_some(),
            Self::GeoNet => geonet::is_it(head),
            Self::Cosmos => cosmos::is_it(head),
            Self::Csmip => csmip::is_it(head),
            Self::KNet => knet::is_it(head),
            Self::Dyna => dyna::is_it(head),
            Self::Columns => true,
        }
    }

    /// Endings of its files, in small letters: those that are taken for records in a folder. Of
    /// K-NET's and KiK-net's, which have one component each, the horizontal ones at the surface.
    pub(super) fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Peer => &["at2"],
            Self::GeoNet => &["v1a", "v2a"],
            Self::Cosmos => &["v1", "v2", "v1c", "v2c"],
            Self::Csmip => &["v2"],
            Self::KNet => &["ns", "ew", "ns2", "ew2"],
            Self::Dyna => &["asc"],
            Self::Columns => &["txt", "csv", "dat", "acc"],
        }
    }

    /// The format of a text that is a ground motion, by its first lines or by its columns of
    /// numbers.
    pub fn recognised(text: &str) -> Option<Self> {
        let format = Self::of(text);
        (format != Self::Columns || columns::hold_numbers(text)).then_some(format)
    }

    /// What a file of this format holds.
    pub(super) fn parse(
        self,
        file: &str,
        text: &str,
        options: &ReadOptions,
    ) -> Result<Parsed, RecordError> {
        match self {
            Self::Peer => at2::parse(file, text),
            Self::GeoNet => geonet::parse(file, text),
            Self::Cosmos => cosmos::parse(file, text),
            Self::Csmip => csmip::parse(file, text),
            Self::KNet => knet::parse(file, text),
            Self::Dyna => dyna::parse(file, text),
            Self::Columns => columns::parse(file, text, options),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The compiler counts them; each of them is another one, and any text is of the last.
    #[test]
    fn all_formats_are_listed_once_columns_last() {
        let places: Vec<usize> = RecordFormat::ALL.map(|format| format as usize).to_vec();
        let mut sorted = places.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..places.len()).collect::<Vec<_>>());
        assert_eq!(RecordFormat::ALL.last(), Some(&RecordFormat::Columns));
        for format in RecordFormat::ALL {
            assert!(!format.endings().is_empty(), "{format}");
        }
    }
}
