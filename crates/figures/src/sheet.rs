//! A finished picture: its SVG, and its files.

use std::path::{Path, PathBuf};

use super::FigureError;
#[cfg(feature = "png")]
use super::pixels;
use super::plot::Plot;
#[cfg(feature = "png")]
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
    #[cfg(feature = "png")]
    pub(crate) shapes: Vec<Shape>,
    /// Panels over time, for a page that zooms and tells values.
    pub plots: Vec<Plot>,
}

impl Sheet {
    /// Write the SVG beside the name of the PNG, and with the feature `png` the PNG, too; each
    /// whole or not at all.
    ///
    /// # Errors
    /// [`FigureError::Write`] when the folder is missing or may not be written to; nothing is left
    /// behind then.
    pub fn save(&self, png: &Path) -> Result<(), FigureError> {
        #[cfg(feature = "png")]
        write(png.to_path_buf(), &pixels::file((self.width, self.height), &self.shapes)?)?;
        write(png.with_extension("svg"), self.svg.as_bytes())
    }
}

fn write(path: PathBuf, bytes: &[u8]) -> Result<(), FigureError> {
    whole_file::write(&path, bytes).map_err(|source| FigureError::Write { path, source })
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
        #[cfg(feature = "png")]
        {
            let (size, pixels) = crate::pixels::read(&path);
            assert_eq!(size, (1600, 48));
            assert_eq!(pixels[15 * 1600 + 15], [0, 114, 178]);
            assert_eq!(pixels[15 * 1600 + 25], [255, 255, 255]);
        }
        let svg = std::fs::read_to_string(folder.path().join("sheet.svg")).unwrap();
        assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"), "{svg}");
    }

    #[test]
    fn nothing_is_left_behind_when_the_file_cannot_be_written() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("missing").join("sheet.png");
        assert!(matches!(sheet().save(&missing), Err(FigureError::Write { .. })));
        // The name is taken by a folder: the rename fails after the bytes were written.
        std::fs::create_dir(folder.path().join("taken.svg")).unwrap();
        let taken = folder.path().join("taken.png");
        std::fs::create_dir(&taken).unwrap();
        assert!(matches!(sheet().save(&taken), Err(FigureError::Write { .. })));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
