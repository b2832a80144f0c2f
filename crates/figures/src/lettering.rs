//! How text is set.

use std::fmt;

use plotters::style::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};

use super::font::{self, CAPITAL};
use super::style::TEXT;

/// How a text looks and where it stands against its point.
#[derive(Clone, Copy)]
pub(crate) struct Lettering {
    pub size: f64,
    pub bold: bool,
    pub upwards: bool,
    pub colour: RGBColor,
    pub across: HPos,
    /// Bottom is the baseline, top the head of the capitals, centre the middle between them.
    pub along: VPos,
}

// plotters' anchors have none
impl fmt::Debug for Lettering {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { size, bold, upwards, colour, .. } = self;
        write!(f, "{size} px, bold {bold}, upwards {upwards}, {colour:?}")
    }
}

impl Lettering {
    /// Plain text, its left end and the middle of its height at the point.
    pub(crate) fn new(size: f64) -> Self {
        Self {
            size,
            bold: false,
            upwards: false,
            colour: TEXT,
            across: HPos::Left,
            along: VPos::Center,
        }
    }

    pub(crate) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(crate) fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }

    pub(crate) fn colour(self, colour: RGBColor) -> Self {
        Self { colour, ..self }
    }

    pub(crate) fn at(self, across: HPos, along: VPos) -> Self {
        Self { across, along, ..self }
    }

    /// Length of a text so set (pixel).
    pub(crate) fn length(self, text: &str) -> f64 {
        font::length(text, self.size, self.bold)
    }

    /// From the point to the baseline (pixel), across the direction of reading.
    pub(crate) fn drop(self) -> f64 {
        self.size
            * match self.along {
                VPos::Bottom => 0.0,
                VPos::Center => CAPITAL / 2.0,
                VPos::Top => CAPITAL,
            }
    }
}
