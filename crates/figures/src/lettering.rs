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

    /// The same in a size in which the text is no longer than `width` (pixel), at least `smallest`.
    pub(crate) fn fitted(self, text: &str, width: f64, smallest: f64) -> Self {
        let mut size = self.size;
        while (Self { size, ..self }).length(text) > width && size > smallest {
            size -= 1.0;
        }
        Self { size, ..self }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_is_set_as_large_as_it_fits_and_a_short_one_as_it_is() {
        let plain = Lettering::new(28.0);
        assert_eq!(plain.fitted("short", 600.0, 14.0).size, 28.0);
        let long = "mavroeidis-papageorgiou, block R 0.5056 m, alpha 0.1489: ω/p";
        let fitted = plain.fitted(long, 600.0, 14.0);
        let larger = Lettering { size: fitted.size + 1.0, ..fitted };
        assert!(fitted.length(long) <= 600.0 && larger.length(long) > 600.0, "{fitted:?}");
        assert_eq!(plain.fitted(long, 10.0, 14.0).size, 14.0);
    }
}
