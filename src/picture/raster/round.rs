//! Disks and lines with round ends, painted by distance.
//!
//! A pixel is covered by half a pixel plus how far its middle lies within the edge, from 0 to 1:
//! for a straight edge this is the area to a few hundredths. Flocks are made of such marks, and
//! outlines and edges would take ten times as long.

use std::ops::Range;

/// The widest line painted here, in pixels. Wider ones cover the corners of a path so often that
/// an outline is the quicker way.
pub(super) const WIDEST: f32 = 6.0;

/// Red, green, blue and opacity, the colours multiplied by the opacity.
pub(super) type Ink = [u8; 4];

/// Pixels to paint on.
pub(super) struct Sheet<'a> {
    pub(super) pixels: &'a mut [Ink],
    pub(super) width: usize,
    /// Room for how far each pixel is covered by one line; all zero between lines.
    pub(super) room: &'a mut Vec<u8>,
}

impl Sheet<'_> {
    /// Paints what lies between two distances from `center`; `ink` tells the colour at a place.
    pub(super) fn ring(
        &mut self,
        [x, y]: [f32; 2],
        from: f32,
        to: f32,
        ink: impl Fn([f32; 2]) -> Ink,
    ) {
        // What is smaller than a pixel is painted as large as one, and paler.
        let pale = (3.0 * to * to).min(1.0);
        let (from, to) = (softened(from), softened(to).max(0.5));
        let reach = to + 0.5;
        let cover = |square: f32| {
            let distance = square.sqrt();
            let within = |edge: f32| (edge + 0.5 - distance).clamp(0.0, 1.0);
            within(to) - if from > 0.0 { within(from) } else { 0.0 }
        };
        for row in self.rows(y - reach, y + reach) {
            let above = row as f32 + 0.5 - y;
            let half = chord(reach, above);
            // Between these edges the middle of the row is covered, or left out, in one go.
            let plain = if from > 0.0 {
                chord(from - 0.5, above)
            } else {
                chord(to - 0.5, above)
            };
            let whole = self.columns(x - half, x + half);
            let middle = self.columns(x - plain, x + plain);
            let middle = match middle.is_empty() {
                true => whole.end..whole.end,
                false => middle,
            };
            let pixels = &mut self.pixels[row * self.width..][..self.width];
            let place = |column: usize| [column as f32 + 0.5, row as f32 + 0.5];
            for column in (whole.start..middle.start).chain(middle.end..whole.end) {
                let aside = column as f32 + 0.5 - x;
                let share = pale * cover(aside * aside + above * above);
                blend(&mut pixels[column], ink(place(column)), byte(share));
            }
            if from <= 0.0 {
                for column in middle {
                    blend(&mut pixels[column], ink(place(column)), byte(pale));
                }
            }
        }
    }

    /// Paints the line of this width from point to point, once where it covers a pixel more than
    /// once.
    pub(super) fn line(&mut self, points: &[[f32; 2]], width: f32, ink: Ink) {
        self.room.resize(self.pixels.len(), 0);
        // What is thinner than a pixel is painted as thick as one, and paler.
        let pale = width.min(1.0);
        let reach = width.max(1.0) / 2.0 + 0.5;
        let low = points.iter().fold(f32::INFINITY, |low, [_, y]| low.min(*y));
        let high = points
            .iter()
            .fold(f32::NEG_INFINITY, |high, [_, y]| high.max(*y));
        let rows = self.rows(low - reach, high + reach);
        // The columns of each row that the line has come to, from the first to behind the last.
        let mut touched = vec![(usize::MAX, 0); rows.len()];
        let alone = [points[0], points[0]];
        let pairs = points.windows(2).map(|pair| [pair[0], pair[1]]);
        for [a, b] in pairs.chain((points.len() == 1).then_some(alone)) {
            let bar = Bar::new(a, b, reach);
            for row in self.rows(a[1].min(b[1]) - reach, a[1].max(b[1]) + reach) {
                let height = row as f32 + 0.5 - a[1];
                let [left, right] = bar.strip(height);
                let columns = self.columns(left, right);
                if columns.is_empty() {
                    continue;
                }
                let (start, end) = &mut touched[row - rows.start];
                *start = columns.start.min(*start);
                *end = columns.end.max(*end);
                let room = &mut self.room[row * self.width..][..self.width];
                for (column, cover) in columns.clone().zip(&mut room[columns]) {
                    let distance = bar.distance(column as f32 + 0.5, height);
                    let share = pale * (reach - distance).clamp(0.0, 1.0);
                    *cover = byte(share).max(*cover);
                }
            }
        }
        for (row, (start, end)) in rows.zip(touched) {
            let row = row * self.width;
            let span = row + start.min(end)..row + end;
            let covers = self.room[span.clone()].iter_mut();
            for (pixel, cover) in self.pixels[span].iter_mut().zip(covers) {
                blend(pixel, ink, std::mem::take(cover));
            }
        }
    }

    /// The rows whose middles lie between these edges.
    fn rows(&self, top: f32, bottom: f32) -> Range<usize> {
        middles(top, bottom, self.pixels.len() / self.width)
    }

    /// The columns whose middles lie between these edges.
    fn columns(&self, left: f32, right: f32) -> Range<usize> {
        middles(left, right, self.width)
    }
}

/// Which of the first `most` numbers and a half lie between these two.
fn middles(from: f32, to: f32, most: usize) -> Range<usize> {
    // Conversion cuts off what is behind the point, and makes numbers out of range fit.
    let (from, to) = ((from - 0.5).max(0.0), (to + 0.5).max(0.0));
    let (start, end) = (from as usize, to as usize);
    let start = start + usize::from((start as f32) < from);
    start.min(most)..end.min(most)
}

/// The radius at which a soft disk covers as much as a sharp one of this radius: softness, from
/// half a pixel within the edge to half a pixel beyond, adds π/12 to the area.
fn softened(radius: f32) -> f32 {
    (radius * radius.abs() - 1.0 / 12.0).max(0.0).sqrt()
}

/// Half the length of the chord at this height in a circle; negative where there is none.
fn chord(radius: f32, height: f32) -> f32 {
    match radius > height.abs() {
        true => (radius * radius - height * height).sqrt(),
        false => -1.0,
    }
}

/// All that is near to the line between two points.
struct Bar {
    /// The x of the first point.
    start: f32,
    /// To the second point.
    along: f32,
    down: f32,
    /// 1 over the square of the length; 0 for a point.
    scale: f32,
    /// The least and the greatest x.
    ends: [f32; 2],
    /// Columns for each row downwards, and half the width in a row; none for a level line.
    slope: Option<[f32; 2]>,
}

impl Bar {
    fn new(a: [f32; 2], b: [f32; 2], reach: f32) -> Self {
        let [along, down] = [b[0] - a[0], b[1] - a[1]];
        let square = along * along + down * down;
        let half = reach * square.sqrt() / down.abs();
        Self {
            start: a[0],
            along,
            down,
            scale: if square > 0.0 { 1.0 / square } else { 0.0 },
            ends: [a[0].min(b[0]) - reach, a[0].max(b[0]) + reach],
            slope: half.is_finite().then(|| [along / down, half]),
        }
    }

    /// Between which x its points can lie, this far below the first point.
    fn strip(&self, height: f32) -> [f32; 2] {
        let [left, right] = self.ends;
        let Some([slope, half]) = self.slope else {
            return self.ends;
        };
        let middle = self.start + height * slope;
        [left.max(middle - half), right.min(middle + half)]
    }

    /// How far a point is from the line, at this x and this far below the first point.
    fn distance(&self, x: f32, height: f32) -> f32 {
        let x = x - self.start;
        let share = (x * self.along + height * self.down) * self.scale;
        let share = share.clamp(0.0, 1.0);
        let (aside, above) = (x - share * self.along, height - share * self.down);
        (aside * aside + above * above).sqrt()
    }
}

fn byte(share: f32) -> u8 {
    (share * 255.0 + 0.5) as u8
}

/// Paints over a pixel, as far as it is covered.
fn blend(pixel: &mut Ink, ink: Ink, cover: u8) {
    let cover = u32::from(cover);
    let left = 255 - over_255(u32::from(ink[3]) * cover);
    for (below, above) in pixel.iter_mut().zip(ink) {
        *below = over_255(u32::from(above) * cover + u32::from(*below) * left) as u8;
    }
}

/// The nearest whole number to a 255th, for numbers up to 255².
fn over_255(number: u32) -> u32 {
    let number = number + 128;
    (number + (number >> 8)) >> 8
}
