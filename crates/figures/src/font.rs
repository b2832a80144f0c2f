//! The figures' font: DejaVu Sans, cut down to the letters that figures use, and embedded. A size is the font's em (pixel);
//! capitals and digits stand 0.729 em tall.

use std::sync::{Arc, LazyLock};

use resvg::usvg::fontdb::Database;
use skrifa::{FontRef, MetadataProvider as _, instance::LocationRef, instance::Size};

/// Height of a capital, in em.
pub(crate) const CAPITAL: f64 = 0.729;
/// What an SVG asks for: the embedded font, which only the PNG is sure to get, and fonts of the same width.
pub(crate) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

const FACES: [&[u8]; 2] = [include_bytes!("font/DejaVuSans.ttf"), include_bytes!("font/DejaVuSans-Bold.ttf")];

static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    for face in FACES {
        fonts.load_font_data(face.to_vec());
    }
    Arc::new(fonts)
});

/// Both faces, and no font of the system.
pub(crate) fn database() -> Arc<Database> {
    Arc::clone(&FONTS)
}

/// Length of a line of text (pixel), kerning not counted.
pub(crate) fn length(text: &str, size: f64, bold: bool) -> f64 {
    let Ok(face) = FontRef::new(FACES[usize::from(bold)]) else { return 0.0 };
    let (letters, metrics) = (face.charmap(), face.glyph_metrics(Size::new(size as f32), LocationRef::default()));
    let advance = |c| metrics.advance_width(letters.map(c).unwrap_or_default()).unwrap_or_default();
    text.chars().map(|c| f64::from(advance(c))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_faces_have_every_letter_that_the_figures_use() {
        let letters = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.,:;()[]|/+−–±×·≤≥∝Δ%²³⁰¹⁴⁵⁶⁷⁸⁹⁻Ωₙαθξμωπ₁₂āōé";
        for face in FACES {
            let letters_of = FontRef::new(face).unwrap().charmap();
            let missing: String = letters.chars().filter(|&c| letters_of.map(c).is_none()).collect();
            assert_eq!(missing, "");
        }
    }

    /// A digit of DejaVu Sans is 1303 units of 2048 wide.
    #[test]
    fn size_is_the_em() {
        assert!((length("0000000000", 100.0, false) - 1303.0 / 2.048).abs() < 0.5);
    }
}
