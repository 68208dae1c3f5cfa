//! Films as animated PNG.

use std::fs::File;
use std::io::BufWriter;

use super::change::Rectangle;
use super::clock::Clock;
use super::{Encode, Reel};
use crate::picture::PictureError;

/// Ticks a second: frames are timed to thousandths of it.
const TICKS: u16 = 1000;

/// Writes frames as animated PNG: of each only the rectangle that has changed, with what has not
/// changed in it left out.
pub(super) struct Apng {
    writer: png::Writer<BufWriter<File>>,
    clock: Clock,
    width: usize,
    /// The frame before.
    shown: Vec<[u8; 4]>,
}

impl Apng {
    pub(super) fn new(file: File, reel: &Reel) -> Result<Self, PictureError> {
        let [width, height] = reel.size;
        let mut encoder = png::Encoder::new(BufWriter::new(file), width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        // Most of a frame is nothing, which is best left as it is.
        encoder.set_filter(png::Filter::NoFilter);
        encoder.set_animated(reel.frames, 0)?;
        encoder.set_blend_op(png::BlendOp::Over)?;
        Ok(Self {
            writer: encoder.write_header()?,
            clock: reel.clock(f64::from(TICKS)),
            width: width as usize,
            shown: Vec::new(),
        })
    }
}

impl Encode for Apng {
    fn add(&mut self, number: u32, pixels: &[[u8; 4]]) -> Result<(), PictureError> {
        let delay = self.clock.delay(number);
        self.writer.set_frame_delay(delay, TICKS)?;
        if self.shown.is_empty() {
            self.writer.write_image_data(pixels.as_flattened())?;
        } else {
            let place = Rectangle::of_change(&self.shown, pixels, self.width);
            let rows = place.rows(&self.shown, self.width);
            let rows = rows.zip(place.rows(pixels, self.width));
            let mut changed = Vec::with_capacity(place.width * place.height);
            for (before, after) in rows {
                let pixels = before.iter().zip(after);
                changed.extend(pixels.map(|(a, b)| if a == b { [0; 4] } else { *b }));
            }
            // The place must lie within the frame at every moment.
            self.writer.reset_frame_position()?;
            let (width, height) = (place.width as u32, place.height as u32);
            self.writer.set_frame_dimension(width, height)?;
            let (left, top) = (place.left as u32, place.top as u32);
            self.writer.set_frame_position(left, top)?;
            self.writer.write_image_data(changed.as_flattened())?;
        }
        self.shown.clear();
        self.shown.extend_from_slice(pixels);
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), PictureError> {
        Ok(self.writer.finish()?)
    }
}
