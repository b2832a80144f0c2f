//! A white sheet: draw on it through plotters, then write it as a PNG, whole or not at all.

use std::cell::RefCell;
use std::fmt::Display;
use std::io::Write as _;
use std::path::Path;
use std::rc::Rc;

use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea as _};
use plotters::element::{Circle, PathElement, Polygon, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, FontTransform, RGBColor, ShapeStyle, TextStyle};

use super::FigureError;
use super::glyph::{self, Setting};
use super::painter::{FINE, Painter};
use super::png;
use super::raster::{Point, Raster};
use super::style::{Pen, TEXT};

/// How a text looks and where it stands against its point.
#[derive(Clone, Copy)]
pub struct Lettering {
    pub size: f64,
    pub bold: bool,
    pub upwards: bool,
    pub colour: RGBColor,
    pub across: HPos,
    /// Bottom is the baseline.
    pub along: VPos,
}

impl Lettering {
    /// Plain text, its left end and the middle of its height at the point.
    pub fn new(size: f64) -> Self {
        Self { size, bold: false, upwards: false, colour: TEXT, across: HPos::Left, along: VPos::Center }
    }

    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }

    pub fn colour(self, colour: RGBColor) -> Self {
        Self { colour, ..self }
    }

    pub fn at(self, across: HPos, along: VPos) -> Self {
        Self { across, along, ..self }
    }

    /// Length of a text so set [pixel].
    pub fn length(self, text: &str) -> f64 {
        glyph::length(text, Setting { bold: self.bold, size: self.size, upwards: false })
    }
}

/// The sheet; coordinates are pixels from the top left corner, and may be fractions.
pub struct Canvas {
    raster: Rc<RefCell<Raster>>,
    area: DrawingArea<Painter, Shift>,
    /// The first thing that plotters refused; told when the picture is to be written.
    fault: Option<String>,
}

fn fine((x, y): Point) -> (i32, i32) {
    // Casts saturate: a point far outside stays outside.
    ((x * FINE).round() as i32, (y * FINE).round() as i32)
}

impl Canvas {
    /// A white sheet [pixel].
    pub fn new(width: usize, height: usize) -> Self {
        let raster = Rc::new(RefCell::new(Raster::new(width, height)));
        let area = Painter { raster: Rc::clone(&raster) }.into_drawing_area();
        Self { raster, area, fault: None }
    }

    fn note<E: Display>(&mut self, drawn: Result<(), E>) {
        if let Err(error) = drawn {
            self.fault.get_or_insert_with(|| error.to_string());
        }
    }

    /// A polyline, full or dashed.
    pub fn line(&mut self, points: &[Point], pen: Pen) {
        let style =
            ShapeStyle { color: pen.colour, filled: false, stroke_width: (pen.width * FINE).round().max(1.0) as u32 };
        let Some(dash) = pen.dash else {
            let points: Vec<_> = points.iter().copied().map(fine).collect();
            let drawn = self.area.draw(&PathElement::new(points, style));
            return self.note(drawn);
        };
        for piece in dashes(points, dash) {
            let points: Vec<_> = piece.into_iter().map(fine).collect();
            let drawn = self.area.draw(&PathElement::new(points, style));
            self.note(drawn);
        }
    }

    /// A filled polygon.
    pub fn fill<C: Color>(&mut self, points: &[Point], colour: C) {
        let points: Vec<_> = points.iter().copied().map(fine).collect();
        let drawn = self.area.draw(&Polygon::new(points, colour.filled()));
        self.note(drawn);
    }

    /// A filled rectangle from its left top to its right bottom corner.
    pub fn block<C: Color>(&mut self, a: Point, b: Point, colour: C) {
        self.fill(&[a, (b.0, a.1), b, (a.0, b.1)], colour);
    }

    /// A filled circle.
    pub fn disc<C: Color>(&mut self, centre: Point, radius: f64, colour: C) {
        let drawn = self.area.draw(&Circle::new(fine(centre), (radius * FINE).round() as u32, colour.filled()));
        self.note(drawn);
    }

    /// A text at a point.
    pub fn text(&mut self, at: Point, text: &str, how: Lettering) {
        let face = if how.bold { FontStyle::Bold } else { FontStyle::Normal };
        let turn = if how.upwards { FontTransform::Rotate270 } else { FontTransform::None };
        let font = FontDesc::new(FontFamily::SansSerif, how.size * FINE, face).transform(turn);
        let style = TextStyle::from(font).color(&how.colour).pos(Pos::new(how.across, how.along));
        let drawn = self.area.draw(&Text::new(text, fine(at), style));
        self.note(drawn);
    }

    /// A text on a white ground, so that it can be read across lines.
    pub fn label(&mut self, at: Point, text: &str, how: Lettering) {
        let (length, pad) = (how.length(text), 0.22 * how.size);
        let left = match how.across {
            HPos::Left => at.0,
            HPos::Center => at.0 - length / 2.0,
            HPos::Right => at.0 - length,
        };
        let foot = match how.along {
            VPos::Bottom => at.1,
            VPos::Center => at.1 + how.size * glyph::CAPITAL / 2.0,
            VPos::Top => at.1 + how.size * glyph::CAPITAL,
        };
        let head = foot - how.size * glyph::CAPITAL;
        self.block((left - pad, head - pad), (left + length + pad, foot + pad), super::style::WHITE.mix(0.85));
        self.text(at, text, how);
    }

    /// Write the PNG: into a temporary file beside `path` first, then under its name.
    ///
    /// # Errors
    /// [`FigureError::Write`] when the folder is missing or may not be written to; nothing is left behind then.
    pub fn save(self, path: &Path) -> Result<(), FigureError> {
        if let Some(reason) = self.fault {
            return Err(FigureError::Draw { path: path.into(), reason });
        }
        let raster = self.raster.borrow();
        let (width, height) = raster.size();
        let write = |bytes: Vec<u8>| write(path, &bytes);
        png::encode(raster.rgb(), width as u32, height as u32)
            .and_then(write)
            .map_err(|source| FigureError::Write { path: path.into(), source })
    }
}

/// Put the bytes under the name at once.
fn write(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".figure");
    // A temporary file is private by default; a picture is for everyone whom the user's mask admits.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

/// The drawn pieces of a polyline.
fn dashes(points: &[Point], (on, off): (f64, f64)) -> Vec<Vec<Point>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<Point> = points.first().copied().into_iter().collect();
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
    fn a_saved_sheet_reads_back_as_it_was_drawn() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sheet.png");
        let mut canvas = Canvas::new(64, 48);
        canvas.block((10.0, 10.0), (20.0, 20.0), RGBColor(0, 114, 178));
        canvas.save(&path).unwrap();
        let picture = image::open(&path).unwrap().to_rgb8();
        assert_eq!(picture.dimensions(), (64, 48));
        assert_eq!(picture.get_pixel(15, 15).0, [0, 114, 178]);
        assert_eq!(picture.get_pixel(25, 15).0, [255, 255, 255]);
    }

    #[test]
    fn nothing_is_left_behind_when_the_file_cannot_be_written() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("missing").join("sheet.png");
        assert!(matches!(Canvas::new(8, 8).save(&missing), Err(FigureError::Write { .. })));
        // The name is taken by a folder: the rename fails after the bytes were written.
        let taken = folder.path().join("taken.png");
        std::fs::create_dir(&taken).unwrap();
        assert!(matches!(Canvas::new(8, 8).save(&taken), Err(FigureError::Write { .. })));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
