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

/// Whether the first lines of a file, without blanks around them, are those of a format.
type Test = fn(&[&str]) -> bool;

/// How far down a file says what it is.
const HEAD_LINES: usize = 100;

impl RecordFormat {
    /// The format that the first lines speak; columns if none.
    pub(super) fn of(text: &str) -> Self {
        let head: Vec<&str> = lines(text).take(HEAD_LINES).map(|(_, line)| line).collect();
        let is: [(Self, Test); 5] = [
            (Self::Cosmos, cosmos::is_it),
            (Self::GeoNet, geonet::is_it),
            (Self::Csmip, csmip::is_it),
            (Self::KNet, knet::is_it),
            (Self::Dyna, dyna::is_it),
        ];
        match is.into_iter().find(|(_, is_it)| is_it(&head)) {
            Some((format, _)) => format,
            None if at2::header_line(text).is_some() => Self::Peer,
            None => Self::Columns,
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
