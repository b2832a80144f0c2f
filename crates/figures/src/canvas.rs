//! A white sheet: what is drawn on it is kept as shapes, and becomes an SVG when its height is
//! known.

use plotters::style::Color;
use plotters::style::text_anchor::HPos;

use super::FigureError;
use super::font::CAPITAL;
use super::lettering::Lettering;
use super::plot::Plot;
use super::shape::{PixelPoint, Shape, TextLine};
use super::sheet::Sheet;
use super::style::{Pen, WHITE, WIDTH};
use super::svg;

/// The sheet; coordinates are pixels from the top left corner, and may be fractions.
#[derive(Default)]
pub(crate) struct Canvas {
    shapes: Vec<Shape>,
    plots: Vec<Plot>,
}

impl Canvas {
    /// A polyline, full or dashed.
    pub(crate) fn line(&mut self, points: &[PixelPoint], pen: Pen) {
        let pieces = pen.dash.map_or_else(|| vec![points.to_vec()], |dash| dashes(points, dash));
        let shape = |points| Shape::Line { points, colour: pen.colour, width: pen.width };
        self.shapes.extend(pieces.into_iter().map(shape));
    }

    /// A filled polygon.
    pub(crate) fn fill<C: Color>(&mut self, points: &[PixelPoint], colour: C) {
        self.shapes.push(Shape::Fill { points: points.to_vec(), colour: colour.to_rgba() });
    }

    /// A filled rectangle from its left top to its right bottom corner.
    pub(crate) fn block<C: Color>(&mut self, a: PixelPoint, b: PixelPoint, colour: C) {
        self.fill(&[a, (b.0, a.1), b, (a.0, b.1)], colour);
    }

    /// A filled circle.
    pub(crate) fn disc<C: Color>(&mut self, centre: PixelPoint, radius: f64, colour: C) {
        self.shapes.push(Shape::Disc { centre, radius, colour: colour.to_rgba() });
    }

    /// A text at a point.
    pub(crate) fn text(&mut self, at: PixelPoint, text: &str, how: Lettering) {
        // a name may hold what XML may not
        let text: String =
            text.chars().map(|c| if c.is_control() || c >= '\u{fffe}' { ' ' } else { c }).collect();
        self.shapes.push(Shape::Text(TextLine { text, at, how }));
    }

    /// A text on a white ground, so that it can be read across lines.
    pub(crate) fn label(&mut self, at: PixelPoint, text: &str, how: Lettering) {
        let (length, pad) = (how.length(text), 0.22 * how.size);
        let left = match how.across {
            HPos::Left => at.0,
            HPos::Center => at.0 - length / 2.0,
            HPos::Right => at.0 - length,
        };
        let foot = at.1 + how.drop();
        let head = foot - how.size * CAPITAL;
        self.block((left - pad, head - pad), (left + length + pad, foot + pad), WHITE.mix(0.85));
        self.text(at, text, how);
    }

    /// Keep the numbers of a panel, for a page that zooms.
    pub(crate) fn keep(&mut self, plot: Plot) {
        self.plots.push(plot);
    }

    /// The picture, as high as is said (pixel).
    ///
    /// # Errors
    /// [`FigureError::Draw`] for what plotters refuses.
    pub(crate) fn finish(self, height: f64) -> Result<Sheet, FigureError> {
        let (width, height) = (WIDTH as u32, height.round() as u32);
        let Self { shapes, plots } = self;
        let svg = svg::document((width, height), &shapes)
            .map_err(|reason| FigureError::Draw { reason })?;
        Ok(Sheet {
            svg,
            width,
            height,
            #[cfg(feature = "png")]
            shapes,
            plots,
        })
    }
}

/// The drawn pieces of a polyline.
fn dashes(points: &[PixelPoint], (on, off): (f64, f64)) -> Vec<Vec<PixelPoint>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<PixelPoint> = points.first().copied().into_iter().collect();
    let (mut drawing, mut left) = (true, on);
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        let mut done = 0.0;
        while length - done >= left {
            done += left;
            let share = done / length;
            let here = (a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1));
            if drawing {
                piece.push(here);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![here];
            }
            drawing = !drawing;
            left = if drawing { on } else { off };
        }
        left -= length - done;
        if drawing {
            piece.push(b);
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_keep_their_rhythm_around_a_corner() {
        let pieces = dashes(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)], (4.0, 2.0));
        assert_eq!(
            pieces,
            [
                vec![(0.0, 0.0), (4.0, 0.0)],
                vec![(6.0, 0.0), (10.0, 0.0)],
                vec![(10.0, 2.0), (10.0, 6.0)],
                vec![(10.0, 8.0), (10.0, 10.0)],
            ]
        );
    }

    #[test]
    fn letters_that_xml_knows_or_refuses_do_no_harm() {
        let mut canvas = Canvas::default();
        canvas.text((10.0, 40.0), "a < b & \"c\" \u{1}\u{ffff}", Lettering::new(20.0));
        let sheet = canvas.finish(80.0).unwrap();
        assert!(sheet.svg.contains("a &lt; b &amp; &quot;c&quot;   \n"), "{}", sheet.svg);
        #[cfg(feature = "png")]
        assert!(super::super::pixels::file((sheet.width, sheet.height), &sheet.shapes).is_ok());
    }
}
