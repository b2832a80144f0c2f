//! One look for all figures. Colours: Okabe & Ito (2008), told apart by colour-blind readers too.

use plotters::style::{RGBAColor, RGBColor};

pub(crate) const BLACK: RGBColor = RGBColor(0, 0, 0);
pub(crate) const WHITE: RGBColor = RGBColor(255, 255, 255);
pub(crate) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(crate) const VERMILLION: RGBColor = RGBColor(213, 94, 0);
pub(crate) const GREEN: RGBColor = RGBColor(0, 158, 115);
pub(crate) const PURPLE: RGBColor = RGBColor(204, 121, 167);
pub(crate) const SKY: RGBColor = RGBColor(86, 180, 233);
pub(crate) const ORANGE: RGBColor = RGBColor(230, 159, 0);

/// Titles, labels, numbers.
pub(crate) const TEXT: RGBColor = RGBColor(34, 34, 34);
/// Secondary remarks, guides.
pub(crate) const GREY: RGBColor = RGBColor(120, 120, 120);
/// Abandoned, unimportant marks.
pub(crate) const PALE: RGBColor = RGBColor(165, 165, 165);
pub(crate) const AXIS: RGBColor = RGBColor(80, 80, 80);
pub(crate) const GRID: RGBColor = RGBColor(228, 228, 228);

/// Colours of series by number; the eighth and later ones start again.
const SERIES: [RGBColor; 7] = [VERMILLION, BLUE, GREEN, PURPLE, ORANGE, SKY, BLACK];

/// The colour of the i-th series.
pub(crate) fn series(i: usize) -> RGBColor {
    SERIES[i % SERIES.len()]
}

/// Width of every picture (pixel).
pub(crate) const WIDTH: usize = 1600;
/// Where panels begin and end across it (pixel).
pub(crate) const SIDES: (f64, f64) = (150.0, WIDTH as f64 - 40.0);
/// Size of titles, of labels and legends, of the numbers at the axes (pixel).
pub(crate) const TITLE: f64 = 32.0;
pub(crate) const LABEL: f64 = 27.0;
pub(crate) const NUMBER: f64 = 25.0;

/// A line's colour and width (pixel).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pen {
    pub colour: RGBAColor,
    pub width: f64,
    /// Lengths drawn and left out in turn (pixel); `None` is a full line.
    pub dash: Option<(f64, f64)>,
}

impl Pen {
    /// A full line.
    pub(crate) fn new(colour: RGBColor, width: f64) -> Self {
        Self { colour: colour.into(), width, dash: None }
    }

    /// That of the i-th series.
    pub(crate) fn series(i: usize, width: f64) -> Self {
        Self::new(series(i), width)
    }

    /// Its colour, without its opacity.
    pub(crate) fn rgb(self) -> RGBColor {
        RGBColor(self.colour.0, self.colour.1, self.colour.2)
    }

    /// Its colour as a page writes it.
    pub(crate) fn hex(self) -> String {
        format!("#{:02X}{:02X}{:02X}", self.colour.0, self.colour.1, self.colour.2)
    }

    /// The same line, full.
    pub(crate) fn full(self) -> Self {
        Self { dash: None, ..self }
    }

    /// The same line, dashed.
    pub(crate) fn dashed(self) -> Self {
        Self { dash: Some((5.0 * self.width, 3.5 * self.width)), ..self }
    }
}
