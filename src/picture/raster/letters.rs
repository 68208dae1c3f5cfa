//! The outlines of letters.

use std::sync::{LazyLock, OnceLock};

use tiny_skia as skia;
use ttf_parser::{GlyphId, OutlineBuilder};

use crate::picture::text;

/// Outlines in units of the font, y upwards, each made when it is first needed.
type Outlines = Vec<OnceLock<Option<skia::Path>>>;

static REGULAR: LazyLock<Outlines> = LazyLock::new(|| places(false));
static BOLD: LazyLock<Outlines> = LazyLock::new(|| places(true));

fn places(bold: bool) -> Outlines {
    let count = text::face(bold).map_or(0, |face| face.number_of_glyphs());
    (0..count).map(|_| OnceLock::new()).collect()
}

/// The outline of a line of text whose base line begins at the origin, in pixels, y downwards;
/// nothing where there is nothing to see.
pub(super) fn outline(line: &str, size: f64, bold: bool) -> Option<skia::Path> {
    let units = f64::from(text::face(bold)?.units_per_em());
    let scale = (size / units) as f32;
    let (mut whole, mut pen) = (skia::PathBuilder::new(), 0.0);
    for (glyph, advance) in text::glyphs(line, bold) {
        if let Some(letter) = letter(glyph, bold) {
            let place =
                skia::Transform::from_row(scale, 0.0, 0.0, -scale, (pen * size) as f32, 0.0);
            if let Some(letter) = letter.clone().transform(place) {
                whole.push_path(&letter);
            }
        }
        pen += advance;
    }
    whole.finish()
}

fn letter(glyph: GlyphId, bold: bool) -> Option<&'static skia::Path> {
    let outlines = if bold { &*BOLD } else { &*REGULAR };
    let place = outlines.get(usize::from(glyph.0))?;
    let outline = place.get_or_init(|| {
        let mut pen = Pen(skia::PathBuilder::new());
        text::face(bold)?.outline_glyph(glyph, &mut pen)?;
        pen.0.finish()
    });
    outline.as_ref()
}

/// Takes an outline over from the font.
struct Pen(skia::PathBuilder);

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.0.close();
    }
}
