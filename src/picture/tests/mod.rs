//! Tests of what pictures become.

mod film;
mod raster;
mod sight;
mod svg;

use super::*;

const RED: Color = Color::hex(0xff0000);
const BLUE: Color = Color::hex(0x0000ff);
const WHITE: Color = Color::hex(0xffffff);

/// An empty white page.
fn page(width: f64, height: f64) -> Picture {
    Picture::new([width, height], WHITE, "a page")
}

/// A mark of this path alone.
fn filled(path: Path, paint: Paint) -> Mark {
    Mark::Path {
        path,
        fill: Some(paint),
        stroke: None,
    }
}

/// From red in the middle to blue at this distance.
fn glow(center: [f64; 2], radius: f64) -> Paint {
    Paint::Radial {
        center,
        radius,
        inner: RED,
        outer: BLUE,
    }
}
