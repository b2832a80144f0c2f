//! Text: the embedded DejaVu Sans, set with its own side bearings and kerning.
//!
//! plotters places the glyphs of an ab_glyph font without their left bearing, which spaces text unevenly; so the
//! figures set their text here. A size is the font's em [pixel]; capitals and digits stand 0.729 em tall.

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, InvalidFont, PxScale, ScaleFont, point};

use super::raster::{Ink, Point, Raster};

type Face = Result<FontRef<'static>, InvalidFont>;

static REGULAR: LazyLock<Face> = LazyLock::new(|| FontRef::try_from_slice(include_bytes!("font/DejaVuSans.ttf")));
static BOLD: LazyLock<Face> = LazyLock::new(|| FontRef::try_from_slice(include_bytes!("font/DejaVuSans-Bold.ttf")));

/// Height of a capital, in em.
pub const CAPITAL: f64 = 0.729;

/// Which text: its face, its size and how it turns.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    pub bold: bool,
    /// Em [pixel].
    pub size: f64,
    /// Reads upwards, along the y axis.
    pub upwards: bool,
}

impl Setting {
    fn face(&self) -> Option<&'static FontRef<'static>> {
        if self.bold { BOLD.as_ref().ok() } else { REGULAR.as_ref().ok() }
    }

    /// The font's own measure of its size: ascent less descent, not the em.
    fn scale(&self, face: &FontRef<'static>) -> PxScale {
        let em = f64::from(face.units_per_em().unwrap_or(1000.0));
        PxScale::from((self.size * f64::from(face.height_unscaled()) / em) as f32)
    }
}

/// Length of a line of text [pixel].
pub fn length(text: &str, setting: Setting) -> f64 {
    let Some(face) = setting.face() else { return 0.0 };
    let face = face.as_scaled(setting.scale(face));
    let mut pen = 0.0;
    let mut last = None;
    for c in text.chars() {
        let id = face.glyph_id(c);
        pen += last.map_or(0.0, |last| face.kern(last, id)) + face.h_advance(id);
        last = Some(id);
    }
    f64::from(pen)
}

/// Set a line of text whose baseline starts at `start`, to the right or upwards.
pub fn set(raster: &mut Raster, text: &str, setting: Setting, start: Point, ink: Ink) {
    let Some(face) = setting.face() else { return };
    let scale = setting.scale(face);
    let face = face.as_scaled(scale);
    // The baseline on whole pixels keeps the feet of the letters sharp.
    let (start_x, start_y) = (start.0.round() as i64, start.1.round() as i64);
    let mut pen = 0.0;
    let mut last = None;
    for c in text.chars() {
        let id = face.glyph_id(c);
        pen += last.map_or(0.0, |last| face.kern(last, id));
        if let Some(outline) = face.outline_glyph(id.with_scale_and_position(scale, point(pen, 0.0))) {
            let corner = outline.px_bounds().min;
            outline.draw(|x, y, coverage| {
                let (x, y) = (corner.x as i64 + i64::from(x), corner.y as i64 + i64::from(y));
                let (x, y) = if setting.upwards { (y, -x - 1) } else { (x, y) };
                raster.blend(start_x + x, start_y + y, ink, f64::from(coverage).clamp(0.0, 1.0));
            });
        }
        pen += face.h_advance(id);
        last = Some(id);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: Setting = Setting { bold: false, size: 100.0, upwards: false };

    #[test]
    fn both_faces_have_every_letter_that_the_figures_use() {
        let letters =
            "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.,:;()[]|/+−–±×·≤≥∝Δ%²³⁰¹⁴⁵⁶⁷⁸⁹⁻Ωₙαθξμω₁₂";
        for face in [&*REGULAR, &*BOLD] {
            let face = face.as_ref().unwrap();
            let missing: String = letters.chars().filter(|&c| face.glyph_id(c).0 == 0).collect();
            assert_eq!(missing, "");
        }
    }

    /// A digit of DejaVu Sans is 1303 units of 2048 wide and its capitals 1493 tall.
    #[test]
    fn size_is_the_em() {
        assert!((length("0000000000", TEXT) - 1303.0 / 2.048 * 1.0).abs() < 0.5);
        let mut raster = Raster::new(100, 200);
        set(&mut raster, "H", TEXT, (10.0, 150.0), Ink { rgb: (0, 0, 0), alpha: 1.0 });
        let rows: Vec<usize> =
            (0..200).filter(|y| raster.rgb()[y * 300..(y + 1) * 300].iter().any(|&b| b < 128)).collect();
        assert_eq!((rows[0], rows[rows.len() - 1]), (77, 149));
    }

    #[test]
    fn upward_text_is_the_text_turned_by_a_quarter() {
        let ink = Ink { rgb: (0, 0, 0), alpha: 1.0 };
        let (mut level, mut upward) = (Raster::new(200, 200), Raster::new(200, 200));
        set(&mut level, "kg", TEXT, (50.0, 100.0), ink);
        set(&mut upward, "kg", Setting { upwards: true, ..TEXT }, (100.0, 150.0), ink);
        for y in 0..200 {
            for x in 0..200 {
                assert_eq!(level.rgb()[(y * 200 + x) * 3], upward.rgb()[((199 - x) * 200 + y) * 3]);
            }
        }
    }
}
