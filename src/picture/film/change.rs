//! What differs from one frame to the next.

/// A rectangle of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Rectangle {
    pub(super) left: usize,
    pub(super) top: usize,
    pub(super) width: usize,
    pub(super) height: usize,
}

impl Rectangle {
    /// The smallest one that holds all pixels which differ between two frames, whose rows have
    /// this width. Where none does, one pixel: formats know no frame without any.
    pub(super) fn of_change<T: PartialEq>(before: &[T], after: &[T], width: usize) -> Self {
        let rows = || before.chunks(width).zip(after.chunks(width));
        let differs = |(a, b): (&[T], &[T])| a != b;
        let Some(top) = rows().position(differs) else {
            return Self {
                left: 0,
                top: 0,
                width: 1,
                height: 1,
            };
        };
        let bottom = rows().rposition(differs).unwrap_or(top);
        let (mut left, mut right) = (width, 0);
        for (a, b) in rows().take(bottom + 1).skip(top) {
            // Only what lies outside of what is known already can widen it.
            let mut outside = a[..left].iter().zip(&b[..left]);
            left = outside.position(|(a, b)| a != b).unwrap_or(left);
            let outside = a[right..].iter().zip(&b[right..]);
            let mut outside = outside.rev();
            if let Some(place) = outside.position(|(a, b)| a != b) {
                right = width - place;
            }
        }
        Self {
            left,
            top,
            width: right - left,
            height: bottom + 1 - top,
        }
    }

    /// Its pixels in frames whose rows have this width, row by row.
    pub(super) fn rows<T>(self, frame: &[T], width: usize) -> impl Iterator<Item = &[T]> {
        frame
            .chunks(width)
            .skip(self.top)
            .take(self.height)
            .map(move |row| &row[self.left..self.left + self.width])
    }
}
