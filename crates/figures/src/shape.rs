//! What a sheet holds, for the SVG and for the PNG.

use plotters::style::RGBAColor;

use super::lettering::Lettering;

/// A point (pixel).
pub(crate) type PixelPoint = (f64, f64);

/// Units of plotters' surface in one pixel: its backends take whole numbers, which would make a
/// flat curve jump.
pub(crate) const FINE: f64 = 16.0;

/// A point in sixteenths of a pixel.
pub(crate) type FinePoint = (i32, i32);

/// One thing drawn (pixel).
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    Line { points: Vec<PixelPoint>, colour: RGBAColor, width: f64 },
    Fill { points: Vec<PixelPoint>, colour: RGBAColor },
    Disc { centre: PixelPoint, radius: f64, colour: RGBAColor },
    Text(TextLine),
}

/// A line of text at its point.
#[derive(Clone, Debug)]
pub(crate) struct TextLine {
    pub text: String,
    pub at: PixelPoint,
    pub how: Lettering,
}

/// A length in whole sixteenths of a pixel.
pub(crate) fn fine_length(length: f64) -> u32 {
    (length * FINE).round() as u32
}

/// The nearest sixteenth of a pixel.
pub(crate) fn fine((x, y): PixelPoint) -> FinePoint {
    // Casts saturate: a point far outside stays outside.
    ((x * FINE).round() as i32, (y * FINE).round() as i32)
}

/// The nearest sixteenths of a pixel.
pub(crate) fn all_fine(points: &[PixelPoint]) -> Vec<FinePoint> {
    points.iter().copied().map(fine).collect()
}

/// The same of a polyline, each point once.
pub(crate) fn polyline(points: &[PixelPoint]) -> Vec<FinePoint> {
    let mut points = all_fine(points);
    points.dedup();
    points
}
