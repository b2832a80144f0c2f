//! A finished picture: its SVG, its PNG, and the files of both.

use std::path::Path;

use tiny_skia::Pixmap;

use super::FigureError;
use super::pixels;
use super::plot::Plot;
use super::shape::Shape;
use files::whole_file;

/// A picture, and the numbers of its panels over time.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// A whole SVG document, without a declaration: it can stand in a page.
    pub svg: String,
    /// Its size (pixel).
    pub width: u32,
    /// Height of the picture (pixels).
    pub height: u32,
    /// What is drawn, for the PNG.
    pub(crate) shapes: Vec<Shape>,
    /// Panels over time, for a page that zooms and tells values.
    pub plots: Vec<Plot>,
}

impl Sheet {
    /// The picture in pixels, as a PNG file; text in the embedded font.
    ///
    /// # Errors
    /// [`FigureError::Draw`] for a size that cannot be, and for what the encoder refuses.
    pub(crate) fn png(&self) -> Result<Vec<u8>, FigureError> {
        let draw = |reason: String| FigureError::Draw { reason };
        let pixels = pixels::drawn((self.width, self.height), &self.shapes)
            .ok_or_else(|| draw("no size".into()))?;
        self.encode(&pixels).map_err(|e| draw(e.to_string()))
    }

    /// Red, green and blue, quickly compressed: a run is waited for, and its figures are of lines
    /// and flat areas.
    fn encode(&self, pixels: &Pixmap) -> Result<Vec<u8>, png::EncodingError> {
        // on white nothing shines through
        let rgb: Vec<u8> = pixels
            .data()
            .chunks_exact(4)
            .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
            .collect();
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&rgb)?;
        writer.finish()?;
        Ok(file)
    }

    /// Write the PNG under its name and the SVG beside it; each whole or not at all.
    ///
    /// # Errors
    /// [`FigureError::Write`] when the folder is missing or may not be written to; nothing is left
    /// behind then.
    pub fn save(&self, png: &Path) -> Result<(), FigureError> {
        let pixels = self.png()?;
        let files = [
            (png.to_path_buf(), pixels.as_slice()),
            (png.with_extension("svg"), self.svg.as_bytes()),
        ];
        for (path, bytes) in files {
            whole_file::write(&path, bytes)
                .map_err(|source| FigureError::Write { path, source })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use plotters::style::RGBColor;

    use super::super::canvas::Canvas;
    use super::*;

    fn sheet() -> Sheet {
        let mut canvas = Canvas::default();
        canvas.block((10.0, 10.0), (20.0, 20.0), RGBColor(0, 114, 178));
        canvas.finish(48.0).unwrap()
    }

    #[test]
    fn a_saved_sheet_reads_back_as_it_was_drawn() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sheet.png");
        sheet().save(&path).unwrap();
        let picture = image::open(&path).unwrap().to_rgb8();
        assert_eq!(picture.dimensions(), (1600, 48));
        assert_eq!(picture.get_pixel(15, 15).0, [0, 114, 178]);
        assert_eq!(picture.get_pixel(25, 15).0, [255, 255, 255]);
        let svg = std::fs::read_to_string(folder.path().join("sheet.svg")).unwrap();
        assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"), "{svg}");
    }

    #[test]
    fn nothing_is_left_behind_when_the_file_cannot_be_written() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("missing").join("sheet.png");
        assert!(matches!(sheet().save(&missing), Err(FigureError::Write { .. })));
        // The name is taken by a folder: the rename fails after the bytes were written.
        let taken = folder.path().join("taken.png");
        std::fs::create_dir(&taken).unwrap();
        assert!(matches!(sheet().save(&taken), Err(FigureError::Write { .. })));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
