//! Shapes as pixels of a PNG, which tiny-skia draws, text as outlines of the embedded font: what a
//! viewer of the SVG draws from the fonts of its system.

use plotters::style::RGBAColor;
use plotters::style::text_anchor::HPos;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform,
};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::FigureError;
use super::font;
use super::shape::{FINE, FinePoint, Shape, TextLine, all_fine, fine, fine_length, polyline};

/// The picture of this width and height (pixel) as a PNG file.
///
/// # Errors
/// [`FigureError::Draw`] for a size that cannot be, and for what the encoder refuses.
pub(crate) fn file(size: (u32, u32), shapes: &[Shape]) -> Result<Vec<u8>, FigureError> {
    let draw = |reason: String| FigureError::Draw { reason };
    let pixels = drawn(size, shapes).ok_or_else(|| draw("no size".into()))?;
    encode(&pixels).map_err(|e| draw(e.to_string()))
}

/// Red, green and blue, quickly compressed: a run is waited for, and its figures are of lines and
/// flat areas.
fn encode(pixels: &Pixmap) -> Result<Vec<u8>, png::EncodingError> {
    // on white nothing shines through
    let rgb: Vec<u8> =
        pixels.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, pixels.width(), pixels.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rgb)?;
    writer.finish()?;
    Ok(file)
}

/// A picture that was written: its width and height, and its pixels row by row.
#[cfg(test)]
pub(crate) fn read(path: &std::path::Path) -> ((u32, u32), Vec<[u8; 3]>) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut bytes).unwrap();
    assert_eq!(frame.color_type, png::ColorType::Rgb);
    ((frame.width, frame.height), bytes.as_chunks::<3>().0.to_vec())
}

/// All shapes on white, of this width and height (pixel); none of a size that cannot be.
pub(crate) fn drawn((width, height): (u32, u32), shapes: &[Shape]) -> Option<Pixmap> {
    let mut pixels = Pixmap::new(width, height)?;
    pixels.fill(Color::WHITE);
    shapes.iter().for_each(|shape| draw(&mut pixels, shape));
    Some(pixels)
}

/// One shape.
fn draw(pixels: &mut Pixmap, shape: &Shape) {
    let place = Transform::from_scale(1.0 / FINE as f32, 1.0 / FINE as f32);
    match shape {
        Shape::Line { points, colour, width } => {
            let stroke = Stroke {
                width: fine_length(*width).max(1) as f32,
                line_cap: LineCap::Round,
                line_join: LineJoin::Round,
                ..Stroke::default()
            };
            if let Some(path) = path(&polyline(points), false) {
                pixels.stroke_path(&path, &paint(*colour), &stroke, place, None);
            }
        }
        Shape::Fill { points, colour } => {
            if let Some(path) = path(&all_fine(points), true) {
                pixels.fill_path(&path, &paint(*colour), FillRule::Winding, place, None);
            }
        }
        Shape::Disc { centre, radius, colour } => {
            let (x, y) = fine(*centre);
            let circle = PathBuilder::from_circle(x as f32, y as f32, fine_length(*radius) as f32);
            if let Some(path) = circle {
                pixels.fill_path(&path, &paint(*colour), FillRule::Winding, place, None);
            }
        }
        Shape::Text(line) => text(pixels, line),
    }
}

/// A polyline or a polygon; none of a single point.
fn path(points: &[FinePoint], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (i, &(x, y)) in points.iter().enumerate() {
        if i == 0 { path.move_to(x as f32, y as f32) } else { path.line_to(x as f32, y as f32) }
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn paint(RGBAColor(red, green, blue, opacity): RGBAColor) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(Color::from_rgba8(red, green, blue, (opacity * 255.0).round() as u8));
    paint
}

/// A line of text.
fn text(pixels: &mut Pixmap, TextLine { text, at: (x, y), how }: &TextLine) {
    let Some(path) = font::face(how.bold).and_then(|face| outline(&face, text)) else {
        return;
    };
    let back = match how.across {
        HPos::Left => 0.0,
        HPos::Center => 0.5 * how.length(text),
        HPos::Right => how.length(text),
    };
    let scale = how.size as f32;
    // outlines have y upwards
    let place = if how.upwards {
        let start = (x + how.drop(), y + back);
        Transform::from_row(0.0, -scale, -scale, 0.0, start.0 as f32, start.1 as f32)
    } else {
        let start = (x - back, y + how.drop());
        Transform::from_row(scale, 0.0, 0.0, -scale, start.0 as f32, start.1 as f32)
    };
    pixels.fill_path(&path, &paint(how.colour.into()), FillRule::Winding, place, None);
}

/// The outlines of a text from its left end, in em; none of spaces alone.
fn outline(face: &Face<'_>, text: &str) -> Option<Path> {
    let em = f32::from(face.units_per_em());
    let mut pen = Pencil { path: PathBuilder::new(), at: 0.0, em };
    for letter in text.chars() {
        let glyph = face.glyph_index(letter).unwrap_or(GlyphId(0));
        face.outline_glyph(glyph, &mut pen);
        pen.at += f32::from(face.glyph_hor_advance(glyph).unwrap_or_default()) / em;
    }
    pen.path.finish()
}

/// Takes outlines in the font's units.
struct Pencil {
    path: PathBuilder,
    /// Left end of the letter (em).
    at: f32,
    em: f32,
}

impl Pencil {
    fn point(&self, x: f32, y: f32) -> (f32, f32) {
        (self.at + x / self.em, y / self.em)
    }
}

impl OutlineBuilder for Pencil {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.point(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.point(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.point(x1, y1), self.point(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) =
            (self.point(x1, y1), self.point(x2, y2), self.point(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::super::canvas::Canvas;
    use super::super::lettering::Lettering;
    use super::super::style::{BLACK, Pen, VERMILLION, WHITE};
    use super::*;
    use plotters::style::Color as _;
    use plotters::style::text_anchor::VPos;

    /// Places of the pixels that are dark.
    fn dark(shape: Shape) -> Vec<(u32, u32)> {
        let pixels = drawn((200, 200), &[shape]).unwrap();
        let place = |(i, pixel): (usize, &tiny_skia::PremultipliedColorU8)| {
            (pixel.red() < 128).then_some((i as u32 % 200, i as u32 / 200))
        };
        pixels.pixels().iter().enumerate().filter_map(place).collect()
    }

    fn range(values: impl Iterator<Item = u32> + Clone) -> (u32, u32) {
        (values.clone().min().unwrap(), values.max().unwrap())
    }

    /// An l stands on its baseline, from which it rises by 0.76 em; upwards, it is turned to the
    /// left.
    #[test]
    fn a_letter_stands_on_its_baseline_and_is_turned_to_the_left_upwards() {
        let how = Lettering::new(100.0).colour(BLACK).at(HPos::Left, VPos::Bottom);
        let letter = |how| Shape::Text(TextLine { text: "l".into(), at: (100.0, 150.0), how });
        let points = dark(letter(how));
        assert_eq!(range(points.iter().map(|p| p.1)), (74, 149));
        let turned = dark(letter(how.upwards()));
        assert_eq!(range(turned.iter().map(|p| p.0)), (24, 99));
        // as far from its start along the direction of reading, to the pixel that is half covered
        let (left, right) = range(points.iter().map(|p| p.0));
        let (top, foot) = range(turned.iter().map(|p| p.1));
        assert!(
            top.abs_diff(249 - right) <= 1 && foot.abs_diff(249 - left) <= 1,
            "{left} {right} {top} {foot}"
        );
    }

    /// A corner is rounded: a sharp one of 11 degrees would reach ten half widths beyond its point.
    #[test]
    fn a_line_is_as_wide_as_its_pen_and_its_corners_are_round() {
        let points = vec![(20.0, 90.0), (150.0, 100.0), (20.0, 110.0)];
        let line = Shape::Line { points, colour: BLACK.to_rgba(), width: 6.0 };
        assert_eq!(range(dark(line).iter().map(|p| p.0)).1, 152);
        let level = Shape::Line {
            points: vec![(20.0, 100.0), (150.0, 100.0)],
            colour: BLACK.to_rgba(),
            width: 6.0,
        };
        assert_eq!(range(dark(level).iter().map(|p| p.1)), (97, 102));
    }

    /// A colour of 85 % opacity over white and over black; a later shape covers an earlier text.
    #[test]
    fn shapes_cover_what_was_drawn_before_as_far_as_they_are_opaque() {
        let mut canvas = Canvas::default();
        canvas.block((0.0, 0.0), (20.0, 40.0), BLACK);
        canvas.text((30.0, 20.0), "lll", Lettering::new(30.0));
        canvas.block((0.0, 0.0), (100.0, 40.0), WHITE.mix(0.85));
        canvas.disc((200.0, 20.0), 10.0, VERMILLION);
        canvas.line(&[(300.0, 20.0), (300.0, 20.0)], Pen::new(BLACK, 4.0));
        let sheet = canvas.finish(40.0).unwrap();
        let pixels = drawn((sheet.width, sheet.height), &sheet.shapes).unwrap();
        let at = |x: u32, y: u32| {
            let pixel = pixels.pixel(x, y).unwrap();
            [pixel.red(), pixel.green(), pixel.blue()]
        };
        assert_eq!((at(10, 10), at(90, 10)), ([217; 3], [255; 3]));
        assert!((30..60).all(|x| at(x, 20)[0] >= 217));
        assert_eq!((at(200, 20), at(212, 20)), ([213, 94, 0], [255; 3]));
    }
}
