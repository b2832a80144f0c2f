//! Shapes as an SVG, which plotters writes.

use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea as _};
use plotters::element::{Circle, PathElement, Polygon, Text};
use plotters::style::text_anchor::{Pos, VPos};
use plotters::style::{
    Color, FontDesc, FontFamily, FontStyle, FontTransform, ShapeStyle, TextStyle,
};
use plotters_svg::SVGBackend;

use super::font;
use super::shape::{FINE, Shape, TextLine, all_fine, fine, fine_length, polyline};
use super::style::WHITE;

/// plotters' SVG divides the sizes of fonts by this.
const EM: f64 = 1.24;
/// and sets the top of a text so far above its baseline, in em.
const ASCENT: f64 = 0.76;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A whole document on white, of this width and height (pixel).
pub(crate) fn document((width, height): (u32, u32), shapes: &[Shape]) -> Result<String, String> {
    let mut svg = String::new();
    let size = (width * FINE as u32, height * FINE as u32);
    let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
    let (w, h) = (f64::from(width), f64::from(height));
    let corners = vec![(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)];
    let ground = Shape::Fill { points: corners, colour: WHITE.to_rgba() };
    for shape in std::iter::once(&ground).chain(shapes) {
        draw(&area, shape)?;
    }
    area.present().map_err(|e| e.to_string())?;
    drop(area);
    // plotters' head says the size of its surface, and nothing of joins: an impact would be a
    // spike
    let body = svg.split_once('>').map_or("", |(_, body)| body);
    let head = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {} {}\" \
         stroke-linejoin=\"round\" stroke-linecap=\"round\">",
        size.0, size.1
    );
    Ok(head + body)
}

/// One shape.
fn draw(area: &Area<'_>, shape: &Shape) -> Result<(), String> {
    match shape {
        Shape::Line { points, colour, width } => {
            let style = ShapeStyle {
                color: *colour,
                filled: false,
                stroke_width: fine_length(*width).max(1),
            };
            area.draw(&PathElement::new(polyline(points), style))
        }
        Shape::Fill { points, colour } => {
            area.draw(&Polygon::new(all_fine(points), colour.filled()))
        }
        Shape::Disc { centre, radius, colour } => {
            area.draw(&Circle::new(fine(*centre), fine_length(*radius), colour.filled()))
        }
        Shape::Text(line) => area.draw(&text(line)),
    }
    .map_err(|e| e.to_string())
}

/// A line of text, set as plotters does it.
fn text(TextLine { text, at: (x, y), how }: &TextLine) -> Text<'static, (i32, i32), String> {
    let face = if how.bold { FontStyle::Bold } else { FontStyle::Normal };
    let turn = if how.upwards { FontTransform::Rotate270 } else { FontTransform::None };
    let font =
        FontDesc::new(FontFamily::Name(font::FAMILY), how.size * EM * FINE, face).transform(turn);
    let (color, pos) = (how.colour.to_backend_color(), Pos::new(how.across, VPos::Top));
    let drop = how.drop() - ASCENT * how.size;
    let at = if how.upwards { (x + drop, *y) } else { (*x, y + drop) };
    Text::new(text.clone(), fine(at), TextStyle { font, color, pos })
}
