//! Text as outlines, for the PNG: what a viewer of the SVG draws from the fonts of its system.

use resvg::tiny_skia::{Color, FillRule, Paint, Path, PathBuilder, Pixmap, Transform};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::font;

/// A line of text in place (pixel).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LetteredLine {
    pub text: String,
    /// The left end of its baseline, in the direction of reading.
    pub start: (f64, f64),
    /// The font's em (pixel).
    pub size: f64,
    pub bold: bool,
    /// Whether it reads upwards.
    pub upwards: bool,
    /// Red, green, blue.
    pub colour: [u8; 3],
}

impl LetteredLine {
    /// Draw it.
    pub(crate) fn draw(&self, pixels: &mut Pixmap) {
        let Some(path) = font::face(self.bold).and_then(|face| outline(&face, &self.text)) else {
            return;
        };
        let [red, green, blue] = self.colour;
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color(Color::from_rgba8(red, green, blue, 255));
        let (x, y) = (self.start.0 as f32, self.start.1 as f32);
        let scale = self.size as f32;
        // outlines have y upwards
        let place = if self.upwards {
            Transform::from_row(0.0, -scale, -scale, 0.0, x, y)
        } else {
            Transform::from_row(scale, 0.0, 0.0, -scale, x, y)
        };
        pixels.fill_path(&path, &paint, FillRule::Winding, place, None);
    }
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
    use super::*;

    fn dark(line: &LetteredLine) -> Vec<(u32, u32)> {
        let mut pixels = Pixmap::new(200, 200).unwrap();
        pixels.fill(Color::WHITE);
        line.draw(&mut pixels);
        let place = |(i, pixel): (usize, &resvg::tiny_skia::PremultipliedColorU8)| {
            (pixel.red() < 128).then_some((i as u32 % 200, i as u32 / 200))
        };
        pixels.pixels().iter().enumerate().filter_map(place).collect()
    }

    /// An l stands on its baseline, from which it rises by 0.76 em; upwards, it is turned to the
    /// left.
    #[test]
    fn a_letter_stands_on_its_baseline_and_is_turned_to_the_left_upwards() {
        let line = LetteredLine {
            text: "l".into(),
            start: (100.0, 150.0),
            size: 100.0,
            bold: false,
            upwards: false,
            colour: [0, 0, 0],
        };
        let range =
            |values: Vec<u32>| (*values.iter().min().unwrap(), *values.iter().max().unwrap());
        let points = dark(&line);
        assert_eq!(range(points.iter().map(|p| p.1).collect()), (74, 149));
        let turned = dark(&LetteredLine { upwards: true, ..line });
        assert_eq!(range(turned.iter().map(|p| p.0).collect()), (24, 99));
        // as far from its start along the direction of reading, to the pixel that is half covered
        let (left, right) = range(points.iter().map(|p| p.0).collect());
        let (top, foot) = range(turned.iter().map(|p| p.1).collect());
        assert!(
            top.abs_diff(249 - right) <= 1 && foot.abs_diff(249 - left) <= 1,
            "{left} {right} {top} {foot}"
        );
    }
}
