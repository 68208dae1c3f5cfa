//! Films as GIF.

use std::borrow::Cow;
use std::fs::File;
use std::io::{BufWriter, Write};

use super::change::Rectangle;
use super::clock::Clock;
use super::palette::{self, Palette};
use super::{Encode, Reel};
use crate::picture::PictureError;

/// The number that stands for the colour of the frame before.
const AS_BEFORE: u8 = palette::MOST as u8;

/// Below this delay, in hundredths of a second, viewers choose one of their own.
const LEAST: u64 = 2;

/// Writes frames as GIF: one palette for all, and of each frame only the rectangle that has
/// changed, with what has not changed in it left out.
pub(super) struct Gif {
    encoder: gif::Encoder<BufWriter<File>>,
    palette: Palette,
    clock: Clock,
    width: usize,
    /// The frame shown last, in numbers of the palette.
    shown: Vec<u8>,
    /// Room for the next.
    next: Vec<u8>,
    /// When the next frame may be shown, in ticks.
    free: u64,
}

impl Gif {
    pub(super) fn new(file: File, reel: &Reel, palette: Palette) -> Result<Self, PictureError> {
        let [width, height] = reel.size;
        let mut colors = palette.bytes().to_vec();
        // The place of the number that is no colour.
        colors.resize(3 * (palette::MOST + 1), 0);
        let file = BufWriter::new(file);
        let mut encoder = gif::Encoder::new(file, width as u16, height as u16, &colors)?;
        encoder.set_repeat(gif::Repeat::Infinite)?;
        Ok(Self {
            encoder,
            palette,
            clock: reel.clock(100.0),
            width: width as usize,
            shown: Vec::new(),
            next: Vec::new(),
            free: 0,
        })
    }

    /// The tick at which the frame after this one is shown: the first that comes late enough,
    /// or the end.
    fn next_begin(&self, frame: u32) -> u64 {
        let free = self.clock.begin(frame) + LEAST;
        let later = (frame + 1..self.clock.frames).map(|k| self.clock.begin(k));
        let end = self.clock.begin(self.clock.frames).max(free);
        later.into_iter().find(|tick| *tick >= free).unwrap_or(end)
    }
}

impl Encode for Gif {
    fn add(&mut self, number: u32, pixels: &[[u8; 4]]) -> Result<(), PictureError> {
        let begin = self.clock.begin(number);
        if begin < self.free {
            return Ok(());
        }
        self.free = self.next_begin(number);
        self.palette.numbers(pixels, &mut self.next);
        let (next, shown) = (&self.next, &self.shown);
        let (place, buffer, transparent) = if shown.is_empty() {
            let height = next.len() / self.width;
            let whole = Rectangle {
                left: 0,
                top: 0,
                width: self.width,
                height,
            };
            (whole, Cow::Borrowed(next.as_slice()), None)
        } else {
            let place = Rectangle::of_change(shown, next, self.width);
            let rows = place
                .rows(shown, self.width)
                .zip(place.rows(next, self.width));
            let mut buffer = Vec::with_capacity(place.width * place.height);
            for (before, after) in rows {
                let pixels = before.iter().zip(after);
                buffer.extend(pixels.map(|(a, b)| if a == b { AS_BEFORE } else { *b }));
            }
            (place, Cow::Owned(buffer), Some(AS_BEFORE))
        };
        self.encoder.write_frame(&gif::Frame {
            delay: u16::try_from(self.free - begin).unwrap_or(u16::MAX),
            dispose: gif::DisposalMethod::Keep,
            transparent,
            left: place.left as u16,
            top: place.top as u16,
            width: place.width as u16,
            height: place.height as u16,
            buffer,
            ..gif::Frame::default()
        })?;
        std::mem::swap(&mut self.shown, &mut self.next);
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), PictureError> {
        let mut file = self.encoder.into_inner()?;
        file.flush().map_err(gif::EncodingError::from)?;
        Ok(())
    }
}
