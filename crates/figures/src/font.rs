//! The figures' font: DejaVu Sans, cut down to the letters that figures use, and embedded. A size
//! is the font's em (pixel); capitals and digits stand 0.729 em tall.

use ttf_parser::Face;

/// Height of a capital, in em.
pub(crate) const CAPITAL: f64 = 0.729;
/// What an SVG asks for: the embedded font, which only the PNG is sure to get, and fonts of the
/// same width.
pub(crate) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

const FACES: [&[u8]; 2] =
    [include_bytes!("font/DejaVuSans.ttf"), include_bytes!("font/DejaVuSans-Bold.ttf")];

/// The plain face, or the bold one.
pub(crate) fn face(bold: bool) -> Option<Face<'static>> {
    Face::parse(FACES[usize::from(bold)], 0).ok()
}

/// Length of a line of text (pixel), kerning not counted.
pub(crate) fn length(text: &str, size: f64, bold: bool) -> f64 {
    let Some(face) = face(bold) else { return 0.0 };
    let advance =
        |c| face.glyph_hor_advance(face.glyph_index(c).unwrap_or_default()).unwrap_or_default();
    text.chars().map(|c| f64::from(advance(c))).sum::<f64>() * size / f64::from(face.units_per_em())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_faces_have_every_letter_that_the_figures_use() {
        let letters = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ\
                       .,:;()[]|/+−–±×·≤≥∝Δ%²³⁰¹⁴⁵⁶⁷⁸⁹⁻Ωₙαθξμωπ₁₂āōé";
        for bold in [false, true] {
            let face = face(bold).unwrap();
            let missing: String =
                letters.chars().filter(|&c| face.glyph_index(c).is_none()).collect();
            assert_eq!(missing, "");
        }
    }

    /// A digit of DejaVu Sans is 1303 units of 2048 wide.
    #[test]
    fn size_is_the_em() {
        assert!((length("0000000000", 100.0, false) - 1303.0 / 2.048).abs() < 0.5);
    }
}
