//! Marks at single points.

use plotters::style::RGBColor;

use super::canvas::Canvas;
use super::shape::PixelPoint;
use super::style::{self, WHITE};

/// A mark's shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MarkShape {
    Disc,
    Square,
    Diamond,
    /// Its tip up.
    Triangle,
    /// Its tip down.
    Pennant,
}

/// A mark: its shape, half its size (pixel), its colour, and whether it is filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mark {
    pub shape: MarkShape,
    pub radius: f64,
    pub colour: RGBColor,
    pub hollow: bool,
}

/// Shapes of series by number; the sixth and later ones start again.
const SERIES: [MarkShape; 5] = [
    MarkShape::Disc,
    MarkShape::Square,
    MarkShape::Diamond,
    MarkShape::Triangle,
    MarkShape::Pennant,
];

impl Mark {
    /// A filled mark.
    pub(crate) fn new(shape: MarkShape, radius: f64, colour: RGBColor) -> Self {
        Self { shape, radius, colour, hollow: false }
    }

    /// That of the i-th series.
    pub(crate) fn series(i: usize) -> Self {
        Self::new(SERIES[i % SERIES.len()], 9.0, style::series(i))
    }

    /// The same mark, only its rim drawn.
    pub(crate) fn hollow(self) -> Self {
        Self { hollow: true, ..self }
    }

    /// Draw it; a thin white seam keeps crowded marks apart.
    pub(crate) fn draw(self, canvas: &mut Canvas, at: PixelPoint) {
        self.paint(canvas, at, self.radius + 1.5, WHITE);
        self.paint(canvas, at, self.radius, self.colour);
        if self.hollow {
            self.paint(canvas, at, self.radius - 2.6, WHITE);
        }
    }

    fn paint(self, canvas: &mut Canvas, (x, y): PixelPoint, radius: f64, colour: RGBColor) {
        let corners = |scaled: f64, corners: &[PixelPoint]| -> Vec<PixelPoint> {
            corners.iter().map(|(dx, dy)| (x + dx * scaled, y + dy * scaled)).collect()
        };
        match self.shape {
            MarkShape::Disc => canvas.disc((x, y), radius, colour),
            MarkShape::Square => {
                canvas.fill(
                    &corners(0.88 * radius, &[(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]),
                    colour,
                );
            }
            MarkShape::Diamond => {
                canvas.fill(
                    &corners(1.22 * radius, &[(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]),
                    colour,
                );
            }
            MarkShape::Triangle => canvas
                .fill(&corners(1.3 * radius, &[(0.0, -1.0), (0.87, 0.5), (-0.87, 0.5)]), colour),
            MarkShape::Pennant => canvas
                .fill(&corners(1.3 * radius, &[(0.0, 1.0), (0.87, -0.5), (-0.87, -0.5)]), colour),
        }
    }
}
