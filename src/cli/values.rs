//! What options of several commands may be.

use clap::ValueEnum;
use volary::picture::Theme;

/// The colours of a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Page {
    /// Dark on white
    Light,
    /// Light on nearly black
    Dark,
}

impl Page {
    pub(super) fn theme(self) -> Theme {
        match self {
            Self::Light => Theme::LIGHT,
            Self::Dark => Theme::DARK,
        }
    }
}

pub(super) fn number(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err("must be a number, and finite".to_owned()),
    }
}

pub(super) fn above_zero(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("must be a number above 0".to_owned()),
    }
}

/// Smallest and largest side of a picture in pixels.
const SIDES: [u32; 2] = [120, 8192];

pub(super) fn size(text: &str) -> Result<[f64; 2], String> {
    let [least, most] = SIDES;
    let side = |text: &str| {
        let side = text.parse::<u32>().ok()?;
        (least..=most).contains(&side).then_some(f64::from(side))
    };
    let sides = text.split_once(['x', 'X']);
    let sides = sides.and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| {
        format!("must be width x height in pixels, each from {least} to {most}, as in 800x600")
    })
}

/// This many numbers between commas.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(number).collect();
    numbers.ok()?.try_into().ok()
}

pub(super) fn window(text: &str) -> Result<[[f64; 2]; 2], String> {
    match numbers::<4>(text) {
        Some([left, bottom, right, top]) if left < right && bottom < top => {
            Ok([[left, bottom], [right, top]])
        }
        _ => {
            Err("must be four numbers xmin,ymin,xmax,ymax with xmin < xmax and ymin < ymax".into())
        }
    }
}

/// Degrees in a second.
pub(super) fn turn(text: &str) -> Result<f64, String> {
    let range = -3600.0..=3600.0;
    match number(text) {
        Ok(turn) if range.contains(&turn) => Ok(turn),
        _ => Err("must be a number from -3600 to 3600".to_owned()),
    }
}

pub(super) fn camera(text: &str) -> Result<[f64; 2], String> {
    match numbers::<2>(text) {
        Some([azimuth, elevation]) if elevation.abs() <= 90.0 => Ok([azimuth, elevation]),
        _ => Err(
            "must be two numbers, azimuth and elevation in degrees, the elevation from -90 \
                  to 90"
                .into(),
        ),
    }
}
