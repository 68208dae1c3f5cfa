//! Pictures as pixels.

mod brush;
mod letters;
mod round;

use tiny_skia as skia;

use super::{Picture, PictureError};
use brush::Brush;

/// A painted picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Pixels {
    map: skia::Pixmap,
}

impl Pixels {
    /// The most pixels that a side can have.
    pub const MOST: u32 = 16_384;

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.map.width()
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.map.height()
    }

    /// Red, green, blue and opacity of a pixel, counted from the upper left corner; nothing
    /// outside the picture.
    pub fn at(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        let inside = x < self.width() && y < self.height();
        let color = self.map.pixel(x, y).filter(|_| inside)?.demultiply();
        Some([color.red(), color.green(), color.blue(), color.alpha()])
    }

    /// Red, green, blue and opacity of all pixels, row by row, with the colours multiplied by
    /// the opacity; a page that covers leaves every opacity 255.
    pub fn premultiplied(&self) -> &[u8] {
        self.map.data()
    }

    /// The picture as a PNG file.
    ///
    /// # Errors
    /// Where the encoder fails, which no sound picture makes it do.
    pub fn png(&self) -> Result<Vec<u8>, PictureError> {
        let covers = self.map.pixels().iter().all(|pixel| pixel.is_opaque());
        let (color, data) = match covers {
            true => (png::ColorType::Rgb, rgb(self.map.data())),
            false => (png::ColorType::Rgba, self.map.clone().take_demultiplied()),
        };
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width(), self.height());
        encoder.set_color(color);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&data)?;
        writer.finish()?;
        Ok(file)
    }
}

/// Red, green and blue out of these and an opacity.
fn rgb(rgba: &[u8]) -> Vec<u8> {
    let (pixels, _) = rgba.as_chunks::<4>();
    pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect()
}

impl Picture {
    /// Paints the picture: with soft edges, text in DejaVu Sans, in sizes rounded to whole
    /// pixels. Groups are seen within whole pixels as well.
    ///
    /// Marks with a coordinate that is not finite are left out.
    ///
    /// # Errors
    /// [`PictureError::Size`] for a page without, or with too many, pixels.
    pub fn paint(&self) -> Result<Pixels, PictureError> {
        let [width, height] = self.pixels()?;
        let mut map = skia::Pixmap::new(width, height).ok_or_else(|| self.misfit())?;
        map.fill(brush::color(self.background));
        Brush::new(&mut map).marks(&self.marks);
        Ok(Pixels { map })
    }

    /// Paints the marks of the picture, not its page, on a copy of `base`: what stays the same
    /// from frame to frame of a film is painted once, and what moves over it.
    ///
    /// # Errors
    /// As [`Picture::paint`], and [`PictureError::OtherSize`] where the sizes differ.
    pub fn paint_over(&self, base: &Pixels) -> Result<Pixels, PictureError> {
        let (found, expected) = (self.pixels()?, [base.width(), base.height()]);
        if found != expected {
            return Err(PictureError::OtherSize { found, expected });
        }
        let mut map = base.map.clone();
        Brush::new(&mut map).marks(&self.marks);
        Ok(Pixels { map })
    }

    /// Width and height in whole pixels.
    fn pixels(&self) -> Result<[u32; 2], PictureError> {
        let [width, height] = self.size.map(f64::round);
        let allowed = 1.0..=f64::from(Pixels::MOST);
        if allowed.contains(&width) && allowed.contains(&height) {
            Ok([width as u32, height as u32])
        } else {
            Err(self.misfit())
        }
    }

    fn misfit(&self) -> PictureError {
        let [width, height] = self.size;
        PictureError::Size { width, height }
    }
}
