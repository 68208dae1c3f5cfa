//! The letters of pictures: DejaVu Sans, which the binary carries.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId};

/// Name of the family, for those who look for it on their own machine.
pub const FAMILY: &str = "DejaVu Sans";

static REGULAR: LazyLock<Option<Face<'static>>> =
    LazyLock::new(|| Face::parse(dejavu::sans::regular(), 0).ok());
static BOLD: LazyLock<Option<Face<'static>>> =
    LazyLock::new(|| Face::parse(dejavu::sans::bold(), 0).ok());

/// The face of the letters; nothing only if the binary's own copy were broken.
pub fn face(bold: bool) -> Option<&'static Face<'static>> {
    match bold {
        true => BOLD.as_ref(),
        false => REGULAR.as_ref(),
    }
}

/// The letters of a text, each with how far it moves the pen, in units of the size.
pub fn glyphs(text: &str, bold: bool) -> impl Iterator<Item = (GlyphId, f64)> {
    let face = face(bold);
    text.chars().filter_map(move |letter| {
        let face = face?;
        let glyph = face.glyph_index(letter).unwrap_or_default();
        let advance = f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
        Some((glyph, advance / f64::from(face.units_per_em())))
    })
}

/// Width of a line of text in pixels, for letters of this size.
pub fn width(text: &str, size: f64, bold: bool) -> f64 {
    glyphs(text, bold).map(|(_, advance)| advance).sum::<f64>() * size
}
