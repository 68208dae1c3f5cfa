//! What colours things have: themes, palettes, ramps.

use super::Color;

/// Seven colours that colour-blind people can tell apart, and from the page: those of M. Okabe
/// and K. Ito, "Color universal design", 2008, moved until no two are near in any kind of sight
/// (the tests say how near), with a brown in the place of the yellow, which nobody sees on white.
const LIGHT: [Color; 7] = [
    Color::hex(0x005eab),
    Color::hex(0xed773c),
    Color::hex(0x4d9c6d),
    Color::hex(0xa45884),
    Color::hex(0xefa901),
    Color::hex(0x42bdfa),
    Color::hex(0x4e2507),
];

/// The same for a dark page.
const DARK: [Color; 7] = [
    Color::hex(0x5caffb),
    Color::hex(0xff8d22),
    Color::hex(0x54e5a2),
    Color::hex(0xd195bb),
    Color::hex(0xffe202),
    Color::hex(0x1e73ed),
    Color::hex(0xa56b19),
];

/// The colours of a page and of what is on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Theme {
    /// The page.
    pub page: Color,
    /// Text, axes, arrows.
    pub ink: Color,
    /// Text and lines that matter less.
    pub faint: Color,
    /// Lines of a grid.
    pub grid: Color,
    /// Obstacles.
    pub solid: Color,
    /// What must be seen: contacts.
    pub alarm: Color,
    /// Groups, runs, components, in their order; after the last it begins anew.
    pub palette: [Color; 7],
}

impl Theme {
    /// Dark on white.
    pub const LIGHT: Self = Self {
        page: Color::hex(0xffffff),
        ink: Color::hex(0x1b1f24),
        faint: Color::hex(0x6a737d),
        grid: Color::hex(0xe4e7eb),
        solid: Color::hex(0x9aa3ad),
        alarm: Color::hex(0xd0021b),
        palette: LIGHT,
    };

    /// Light on nearly black.
    pub const DARK: Self = Self {
        page: Color::hex(0x14181d),
        ink: Color::hex(0xe6e9ed),
        faint: Color::hex(0x929ba6),
        grid: Color::hex(0x2a3038),
        solid: Color::hex(0x5b6672),
        alarm: Color::hex(0xff4d5e),
        palette: DARK,
    };

    /// The colour of a group, run or component.
    pub fn of(&self, index: usize) -> Color {
        self.palette[index % self.palette.len()]
    }
}

/// Colours for the numbers from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ramp {
    /// From dark blue over green to yellow, evenly: for what has a least and a most.
    Viridis,
    /// Round and back to where it began: for angles.
    Cyclic,
}

/// Nine of the colours of viridis, evenly spaced; S. van der Walt and N. Smith, 2015.
const VIRIDIS: [Color; 9] = [
    Color::hex(0x440154),
    Color::hex(0x472d7b),
    Color::hex(0x3b528b),
    Color::hex(0x2c728e),
    Color::hex(0x21918c),
    Color::hex(0x28ae80),
    Color::hex(0x5ec962),
    Color::hex(0xaddc30),
    Color::hex(0xfde725),
];

/// A circle through blue, violet, orange and green of even lightness, the first again at the end.
const CYCLIC: [Color; 7] = [
    Color::hex(0x3b7dd8),
    Color::hex(0x8e5fd0),
    Color::hex(0xc9518f),
    Color::hex(0xd0722f),
    Color::hex(0x9a9a1c),
    Color::hex(0x2fa386),
    Color::hex(0x3b7dd8),
];

impl Ramp {
    /// The colour of a number from 0 to 1; what lies outside has the colour of the nearer end.
    pub fn at(self, share: f64) -> Color {
        let colors: &[Color] = match self {
            Self::Viridis => &VIRIDIS,
            Self::Cyclic => &CYCLIC,
        };
        let place = share.clamp(0.0, 1.0) * (colors.len() - 1) as f64;
        let first = (place as usize).min(colors.len() - 2);
        colors[first].mix(colors[first + 1], place - first as f64)
    }
}
