//! Colours, as people with and without colour blindness see them.

use super::*;

/// What becomes of linear red, green and blue in full protanopia, deuteranopia and tritanopia;
/// G. Machado, M. Oliveira and L. Fernandes, "A physiologically-based model for simulation of
/// color vision deficiency", 2009, table 1, and in full sight.
const SIGHTS: [[[f64; 3]; 3]; 4] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ],
];

fn linear(color: Color) -> [f64; 3] {
    color.rgb.map(|level| {
        let level = f64::from(level) / 255.0;
        match level <= 0.04045 {
            true => level / 12.92,
            false => ((level + 0.055) / 1.055).powf(2.4),
        }
    })
}

fn times(matrix: &[[f64; 3]; 3], vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| (0..3).map(|k| row[k] * vector[k]).sum())
}

/// Lightness and hue as CIE L*a*b* has them, under daylight (D65).
fn lab(color: Color, sight: &[[f64; 3]; 3]) -> [f64; 3] {
    const TO_XYZ: [[f64; 3]; 3] = [
        [0.4124, 0.3576, 0.1805],
        [0.2126, 0.7152, 0.0722],
        [0.0193, 0.1192, 0.9505],
    ];
    const WHITE: [f64; 3] = [0.95047, 1.0, 1.08883];
    let seen = times(sight, linear(color)).map(|level| level.clamp(0.0, 1.0));
    let xyz = times(&TO_XYZ, seen);
    let f = |k: usize| {
        let (t, edge) = (xyz[k] / WHITE[k], 6.0 / 29.0_f64);
        match t > edge.powi(3) {
            true => t.cbrt(),
            false => t / (3.0 * edge * edge) + 4.0 / 29.0,
        }
    };
    let [x, y, z] = [f(0), f(1), f(2)];
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// How different two colours look, to those who see the least of it (CIE 1976; 2.3 is what one
/// just notices).
fn difference(a: Color, b: Color) -> f64 {
    let apart = SIGHTS.iter().map(|sight| {
        let (a, b) = (lab(a, sight), lab(b, sight));
        (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
    });
    apart.fold(f64::INFINITY, f64::min)
}

/// The contrast of the rules for accessible pages (WCAG 2), 1 to 21.
fn contrast(a: Color, b: Color) -> f64 {
    let bright = |color| times(&[[0.2126, 0.7152, 0.0722]; 3], linear(color))[0] + 0.05;
    let (a, b) = (bright(a), bright(b));
    a.max(b) / a.min(b)
}

#[test]
fn black_and_white_are_as_far_apart_as_can_be() {
    let (black, white) = (Color::hex(0), Color::hex(0xffffff));
    assert!((difference(black, white) - 100.0).abs() < 0.1);
    assert!((contrast(black, white) - 21.0).abs() < 1e-9);
    // Many confuse a red and a green that are of one lightness.
    assert!(difference(Color::hex(0xc08000), Color::hex(0x80a000)) < 25.0);
}

#[test]
fn nobody_confuses_the_colours_of_a_theme() {
    for theme in [Theme::LIGHT, Theme::DARK] {
        for (k, color) in theme.palette.into_iter().enumerate() {
            for other in &theme.palette[..k] {
                let apart = difference(color, *other);
                assert!(apart > 19.5, "{color} and {other}: {apart}");
            }
            for (other, least) in [(theme.page, 40.0), (theme.alarm, 17.0), (theme.solid, 16.0)] {
                let apart = difference(color, other);
                assert!(apart > least, "{color} and {other}: {apart}");
            }
            assert!(contrast(color, theme.page) > 2.0, "{color}");
        }
    }
}

#[test]
fn what_is_written_can_be_read() {
    for theme in [Theme::LIGHT, Theme::DARK] {
        assert!(contrast(theme.ink, theme.page) > 12.0);
        assert!(contrast(theme.faint, theme.page) > 4.5);
        assert!(contrast(theme.alarm, theme.page) > 4.5);
    }
}

#[test]
fn ramps_go_evenly_and_the_cyclic_one_closes() {
    assert_eq!(Ramp::Cyclic.at(0.0), Ramp::Cyclic.at(1.0));
    assert_eq!(Ramp::Viridis.at(-1.0), Color::hex(0x440154));
    assert_eq!(Ramp::Viridis.at(2.0), Color::hex(0xfde725));
    let lightness = |k: u32| lab(Ramp::Viridis.at(f64::from(k) / 20.0), &SIGHTS[0])[0];
    assert!((0..20).all(|k| lightness(k + 1) > lightness(k) + 2.0));
}
