//! Colours.

use std::fmt;

/// A colour of the sRGB space, and how much it covers what is below it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Color {
    /// Red, green and blue, 0 to 255.
    pub rgb: [u8; 3],
    /// 0 lets everything through, 1 covers.
    pub opacity: f64,
}

impl Color {
    /// A colour that covers, from 0xRRGGBB.
    pub const fn hex(rgb: u32) -> Self {
        let [_, red, green, blue] = rgb.to_be_bytes();
        Self {
            rgb: [red, green, blue],
            opacity: 1.0,
        }
    }

    /// The same colour, covering as much as told, 0 to 1.
    pub const fn opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// This colour at `share` 0, the other at 1, in between a mixture.
    pub fn mix(self, other: Self, share: f64) -> Self {
        let share = share.clamp(0.0, 1.0);
        let mix = |a: f64, b: f64| a + (b - a) * share;
        let part = |k: usize| mix(f64::from(self.rgb[k]), f64::from(other.rgb[k])).round() as u8;
        Self {
            rgb: [part(0), part(1), part(2)],
            opacity: mix(self.opacity, other.opacity),
        }
    }
}

impl fmt::Display for Color {
    /// As #rrggbb, without the opacity.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [red, green, blue] = self.rgb;
        write!(f, "#{red:02x}{green:02x}{blue:02x}")
    }
}
