//! A bar of a round length.

use crate::picture::{Anchor, Label, Mark, Path, Stroke, Theme};

use super::view::stroked;

/// The largest of 1, 2 and 5 times a power of ten that is at most this; for lengths above 0.
pub(super) fn round_below(length: f64) -> f64 {
    let power = 10f64.powf(length.log10().floor());
    let share = length / power;
    // What is one of these but for rounding is one of these.
    let slack = 1.0 + 1e-9;
    let leading = [10.0, 5.0, 2.0].into_iter().find(|it| *it <= share * slack);
    leading.unwrap_or(1.0) * power
}

/// A number as a person would write it: as many digits as tell it from its neighbours on the
/// 1-2-5 series.
pub(super) fn round_number(length: f64) -> String {
    match (1e-4..1e6).contains(&length.abs()) || length == 0.0 {
        true => {
            let digits = (-length.abs().log10().floor()).clamp(0.0, 5.0) as usize;
            format!("{length:.digits$}")
        }
        false => format!("{length:.0e}"),
    }
}

/// A bar with its length above it: its right end at `at`, no longer than `longest`, in pixels.
/// Nothing where no length has a scale.
pub(super) fn draw(
    theme: &Theme,
    scale: f64,
    [right, y]: [f64; 2],
    longest: f64,
    size: f64,
    remark: &str,
) -> Vec<Mark> {
    if !(scale.is_finite() && scale > 0.0) {
        return Vec::new();
    }
    let length = round_below(longest / scale);
    let left = right - length * scale;
    let mut path = Path::polyline([[left, y], [right, y]]);
    for x in [left, right] {
        path.begin([x, y - 3.0]);
        path.line([x, y + 3.0]);
    }
    let text = format!("{}{remark}", round_number(length));
    let label = Label::new(text, [right, y - 6.0], size, theme.ink).anchor(Anchor::End);
    vec![
        stroked(path, Stroke::new(theme.ink, 1.5)),
        Mark::Label(label),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_round() {
        let cases = [
            (1.0, 1.0),
            (1.99, 1.0),
            (2.0, 2.0),
            (4.9, 2.0),
            (7.0, 5.0),
            (10.0, 10.0),
            (0.03, 0.02),
            (0.3, 0.2),
            (0.1 + 0.2, 0.2),
            (999.999_999_999_999, 1000.0),
            (6e7, 5e7),
        ];
        for (length, round) in cases {
            let found = round_below(length);
            assert!((found / round - 1.0).abs() < 1e-9, "{length}: {found}");
        }
        assert_eq!(round_number(0.2), "0.2");
        assert_eq!(round_number(50.0), "50");
        assert_eq!(round_number(0.002), "0.002");
        assert_eq!(round_number(5e7), "5e7");
    }
}
