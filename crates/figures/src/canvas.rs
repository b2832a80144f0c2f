//! A white sheet: what is drawn on it is kept as plotters' elements, and becomes an SVG when its
//! height is known.

use plotters::drawing::IntoDrawingArea as _;
use plotters::element::{Circle, PathElement, Polygon, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{
    Color, FontDesc, FontFamily, FontStyle, FontTransform, RGBColor, ShapeStyle, TextStyle,
};
use plotters_svg::SVGBackend;

use super::FigureError;
use super::font::{self, CAPITAL};
use super::lettering::LetteredLine;
use super::plot::Plot;
use super::sheet::Sheet;
use super::style::{Pen, TEXT, WHITE, WIDTH};

/// A point (pixel).
pub(crate) type PixelPoint = (f64, f64);

/// Units of plotters' surface in one pixel: its backends take whole numbers, which would make a
/// flat curve jump.
const FINE: f64 = 16.0;
/// plotters' SVG divides the sizes of fonts by this.
const EM: f64 = 1.24;
/// and sets the top of a text so far above its baseline, in em.
const ASCENT: f64 = 0.76;

type Fine = (i32, i32);

/// One thing drawn.
enum SvgElement {
    Line(PathElement<Fine>),
    Fill(Polygon<Fine>),
    Disc(Circle<Fine, u32>),
    Text(Text<'static, Fine, String>),
}

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

    /// A text so set at a point.
    fn line(self, (x, y): PixelPoint, text: &str) -> LetteredLine {
        let back = match self.across {
            HPos::Left => 0.0,
            HPos::Center => 0.5 * self.length(text),
            HPos::Right => self.length(text),
        };
        let start =
            if self.upwards { (x + self.drop(), y + back) } else { (x - back, y + self.drop()) };
        let RGBColor(red, green, blue) = self.colour;
        let (text, colour) = (text.to_owned(), [red, green, blue]);
        LetteredLine {
            text,
            start,
            size: self.size,
            bold: self.bold,
            upwards: self.upwards,
            colour,
        }
    }

    /// From the point to the baseline (pixel), across the direction of reading.
    fn drop(self) -> f64 {
        self.size
            * match self.along {
                VPos::Bottom => 0.0,
                VPos::Center => CAPITAL / 2.0,
                VPos::Top => CAPITAL,
            }
    }
}

/// The sheet; coordinates are pixels from the top left corner, and may be fractions.
#[derive(Default)]
pub(crate) struct Canvas {
    elements: Vec<SvgElement>,
    lines: Vec<LetteredLine>,
    plots: Vec<Plot>,
}

fn fine((x, y): PixelPoint) -> Fine {
    // Casts saturate: a point far outside stays outside.
    ((x * FINE).round() as i32, (y * FINE).round() as i32)
}

fn all_fine(points: &[PixelPoint]) -> Vec<Fine> {
    points.iter().copied().map(fine).collect()
}

impl Canvas {
    /// A polyline, full or dashed.
    pub(crate) fn line(&mut self, points: &[PixelPoint], pen: Pen) {
        let style = ShapeStyle {
            color: pen.colour,
            filled: false,
            stroke_width: (pen.width * FINE).round().max(1.0) as u32,
        };
        let pieces = pen.dash.map_or_else(|| vec![points.to_vec()], |dash| dashes(points, dash));
        for piece in pieces {
            let mut points = all_fine(&piece);
            points.dedup();
            self.elements.push(SvgElement::Line(PathElement::new(points, style)));
        }
    }

    /// A filled polygon.
    pub(crate) fn fill<C: Color>(&mut self, points: &[PixelPoint], colour: C) {
        self.elements.push(SvgElement::Fill(Polygon::new(all_fine(points), colour.filled())));
    }

    /// A filled rectangle from its left top to its right bottom corner.
    pub(crate) fn block<C: Color>(&mut self, a: PixelPoint, b: PixelPoint, colour: C) {
        self.fill(&[a, (b.0, a.1), b, (a.0, b.1)], colour);
    }

    /// A filled circle.
    pub(crate) fn disc<C: Color>(&mut self, centre: PixelPoint, radius: f64, colour: C) {
        self.elements.push(SvgElement::Disc(Circle::new(
            fine(centre),
            (radius * FINE).round() as u32,
            colour.filled(),
        )));
    }

    /// A text at a point.
    pub(crate) fn text(&mut self, (x, y): PixelPoint, text: &str, how: Lettering) {
        let face = if how.bold { FontStyle::Bold } else { FontStyle::Normal };
        let turn = if how.upwards { FontTransform::Rotate270 } else { FontTransform::None };
        let font = FontDesc::new(FontFamily::Name(font::FAMILY), how.size * EM * FINE, face)
            .transform(turn);
        let (color, pos) = (how.colour.to_backend_color(), Pos::new(how.across, VPos::Top));
        let style = TextStyle { font, color, pos };
        let drop = how.drop() - ASCENT * how.size;
        let at = if how.upwards { (x + drop, y) } else { (x, y + drop) };
        // a name may hold what XML may not
        let text: String =
            text.chars().map(|c| if c.is_control() || c >= '\u{fffe}' { ' ' } else { c }).collect();
        self.lines.push(how.line((x, y), &text));
        self.elements.push(SvgElement::Text(Text::new(text, fine(at), style)));
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
        let mut svg = String::new();
        write(&mut svg, (width, height), &self.elements)
            .map_err(|reason| FigureError::Draw { reason })?;
        // plotters' head says the size of its surface, and nothing of joins: an impact would be a
        // spike
        let body = svg.split_once('>').map_or("", |(_, body)| body);
        let head = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {} {}\" \
             stroke-linejoin=\"round\" stroke-linecap=\"round\">",
            width * FINE as u32,
            height * FINE as u32
        );
        Ok(Sheet { svg: head + body, width, height, lines: self.lines, plots: self.plots })
    }
}

/// Everything, on white, as plotters writes it.
fn write(
    svg: &mut String,
    (width, height): (u32, u32),
    elements: &[SvgElement],
) -> Result<(), String> {
    let size = (width * FINE as u32, height * FINE as u32);
    let area = SVGBackend::with_string(svg, size).into_drawing_area();
    let ground =
        all_fine(&[(0.0, 0.0), (f64::from(width), 0.0), (f64::from(width), f64::from(height))]);
    let ground =
        Polygon::new([ground, vec![fine((0.0, f64::from(height)))]].concat(), WHITE.filled());
    area.draw(&ground).map_err(|e| e.to_string())?;
    for element in elements {
        match element {
            SvgElement::Line(line) => area.draw(line),
            SvgElement::Fill(polygon) => area.draw(polygon),
            SvgElement::Disc(circle) => area.draw(circle),
            SvgElement::Text(text) => area.draw(text),
        }
        .map_err(|e| e.to_string())?;
    }
    area.present().map_err(|e| e.to_string())
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
        assert!(sheet.png().is_ok());
    }
}
