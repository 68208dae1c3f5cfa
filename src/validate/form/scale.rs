//! Axes: which kind the data ask for, where a value stands, and what the ticks say.

use crate::math::digits;

/// Above this ratio of the largest to the least of positive numbers an axis is logarithmic.
const WIDE: f64 = 1e3;

/// A logarithmic axis shows no less than this share of its largest number.
const DEEPEST: f64 = 1e-16;

/// How many ticks an axis has, about.
const TICKS: f64 = 5.0;

/// An axis: numbers from `low` to `high` on the pixels from `from` to `to`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
    from: f64,
    to: f64,
}

impl Scale {
    /// A linear axis without room at its ends.
    pub(super) fn tight(low: f64, high: f64, pixels: [f64; 2]) -> Self {
        Self {
            low,
            high,
            logarithmic: false,
            from: pixels[0],
            to: pixels[1],
        }
    }

    /// The axis on which these numbers are seen best. It is logarithmic where it must be, or
    /// where none of them is negative and the positive ones differ a lot; `lines` must be
    /// seen on it, so none of them may be 0 then. Nothing without numbers.
    pub(super) fn of(
        values: &[f64],
        lines: &[f64],
        must_be_logarithmic: bool,
        pixels: [f64; 2],
    ) -> Option<Self> {
        let all = || values.iter().chain(lines).copied();
        let low = all().reduce(f64::min)?;
        let high = all().reduce(f64::max)?;
        let least = all().filter(|it| *it > 0.0).reduce(f64::min);
        let wide = low >= 0.0 && least.is_some_and(|least| high / least > WIDE);
        let scale = match least {
            Some(least) if must_be_logarithmic || wide && lines.iter().all(|it| *it > 0.0) => {
                Self::logarithmic(least, high, pixels)
            }
            _ => Self::linear(low, high, pixels),
        };
        Some(scale)
    }

    fn logarithmic(least: f64, high: f64, pixels: [f64; 2]) -> Self {
        let low = least.max(high * DEEPEST);
        let decades = (high / low).log10();
        // At least one decade has a place, so that there are ticks.
        let room = 10_f64.powf((0.1 + 0.04 * decades).max(0.5 - 0.5 * decades));
        Self {
            logarithmic: true,
            ..Self::tight(low / room, high * room, pixels)
        }
    }

    fn linear(low: f64, high: f64, pixels: [f64; 2]) -> Self {
        let size = low.abs().max(high.abs());
        // What rounding alone can tell apart is all the same.
        if high - low <= 1e-12 * size || size == 0.0 {
            let room = if size == 0.0 { 1.0 } else { 0.5 * size };
            return Self::tight(low - room, high + room, pixels);
        }
        let room = 0.06 * (high - low);
        match low >= 0.0 && low < 0.4 * high {
            true => Self::tight(0.0, high + room, pixels),
            false => Self::tight(low - room, high + room, pixels),
        }
    }

    /// Whether the axis is logarithmic.
    pub(super) fn is_logarithmic(&self) -> bool {
        self.logarithmic
    }

    /// Where a number stands, in pixels; below its end, at it. Nothing where it has no place
    /// on the axis.
    pub(super) fn at(&self, value: f64) -> Option<f64> {
        let share = match self.logarithmic {
            true if value <= 0.0 => return None,
            true => (value / self.low).log10() / (self.high / self.low).log10(),
            false => (value - self.low) / (self.high - self.low),
        };
        let share = share.clamp(0.0, 1.0);
        share
            .is_finite()
            .then_some(self.from + share * (self.to - self.from))
    }

    /// The ticks: where they stand, and what they say.
    pub(super) fn ticks(&self) -> Vec<(f64, String)> {
        let ticks = match self.logarithmic {
            true => self.powers(),
            false => self.multiples(),
        };
        let ticks = ticks.into_iter();
        ticks
            .filter_map(|(value, text)| Some((self.at(value)?, text)))
            .collect()
    }

    /// Multiples of 1, 2 or 5 times a power of ten.
    fn multiples(&self) -> Vec<(f64, String)> {
        let step = round_step((self.high - self.low) / TICKS);
        let first = (self.low / step - 1e-9).ceil();
        let last = (self.high / step + 1e-9).floor();
        let count = (last - first).clamp(0.0, 2.0 * TICKS) as usize;
        let values: Vec<f64> = (0..=count).map(|k| (first + k as f64) * step).collect();
        let largest = values.iter().copied().map(f64::abs).fold(step, f64::max);
        let shown = largest.log10().floor() - step.log10().floor() + 1.0;
        // Zero is zero, not what rounding left of it.
        let settle = |value: f64| {
            if value.abs() < 1e-9 * step {
                0.0
            } else {
                value
            }
        };
        // All ticks have as many digits behind the point as the finest needs.
        let text = |value: f64| {
            let own = match value == 0.0 {
                true => 1.0,
                false => shown - (largest.log10().floor() - value.abs().log10().floor()),
            };
            digits(value, own.clamp(1.0, 15.0) as usize)
        };
        let values = values.into_iter().map(settle);
        values.map(|value| (value, text(value))).collect()
    }

    /// Powers of ten, and numbers between them where there are few.
    fn powers(&self) -> Vec<(f64, String)> {
        let (low, high) = (self.low.log10(), self.high.log10());
        let (first, last) = (low.floor() as i32, high.ceil() as i32);
        let plain = first >= -3 && last <= 5;
        let within = |value: &f64| (self.low..=self.high).contains(value);
        let multiples: &[f64] = match high - low {
            span if span < 1.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let stride = ((last - first) as f64 / (TICKS + 1.0)).ceil().max(1.0) as i32;
        let mut ticks = Vec::new();
        for power in (first..=last).filter(|power| power.rem_euclid(stride) == 0) {
            for multiple in multiples {
                let value = multiple * 10_f64.powi(power);
                let text = match (plain, *multiple == 1.0) {
                    (false, true) => format!("10{}", superscript(power)),
                    _ => digits(value, 3),
                };
                ticks.extend(within(&value).then_some((value, text)));
            }
        }
        ticks
    }
}

/// The step of at least this size that is 1, 2 or 5 times a power of ten.
fn round_step(size: f64) -> f64 {
    let power = 10_f64.powf(size.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|it| it * power);
    let fits = steps.into_iter().find(|step| *step >= size * (1.0 - 1e-9));
    fits.unwrap_or(10.0 * power)
}

fn superscript(power: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = power.to_string();
    let raise = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    digits.chars().map(raise).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const PIXELS: [f64; 2] = [200.0, 10.0];

    fn labels(scale: Scale) -> Vec<String> {
        scale.ticks().into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(
            labels(Scale::tight(0.0, 60.0, PIXELS)),
            ["0", "20", "40", "60"]
        );
        let near = Scale::tight(1000.0, 1000.01, PIXELS);
        assert_eq!(labels(near)[1], "1000.002");
        let around = Scale::tight(-0.3, 0.3, PIXELS);
        assert_eq!(labels(around), ["-0.2", "0", "0.2"]);
        let far = Scale::of(&[1e-12, 1.0], &[], false, PIXELS).unwrap();
        assert!(labels(far).contains(&"10⁻⁹".to_owned()), "{far:?}");
        let close = Scale::of(&[0.3, 2.5], &[], true, PIXELS).unwrap();
        assert_eq!(labels(close), ["0.5", "1", "2"]);
    }

    #[test]
    fn data_choose_the_axis() {
        let logarithmic = |values: &[f64], lines: &[f64]| {
            Scale::of(values, lines, false, PIXELS)
                .unwrap()
                .is_logarithmic()
        };
        assert!(logarithmic(&[0.0, 1e-4, 1.0], &[]));
        assert!(logarithmic(&[1.0, 2.0], &[1e-5]));
        assert!(!logarithmic(&[1.0, 2.0], &[]));
        assert!(!logarithmic(&[-1e-9, 1.0], &[]));
        // A bound of 0 must be seen.
        assert!(!logarithmic(&[1e-4, 1.0], &[0.0]));
        assert!(Scale::of(&[], &[], false, PIXELS).is_none());
    }

    #[test]
    fn what_is_below_a_logarithmic_axis_stands_at_its_end() {
        let scale = Scale::of(&[1e-300, 1.0], &[], false, PIXELS).unwrap();
        assert_eq!(scale.at(1e-300), Some(PIXELS[0]));
        assert_eq!(scale.at(0.0), None);
    }

    proptest! {
        /// Whatever the numbers, an axis shows them all, with a few ticks in order.
        #[test]
        fn every_number_has_its_place(
            values in prop::collection::vec(-1e300..1e300_f64, 1..6),
            power in -300..0_i32,
            logarithmic in any::<bool>(),
        ) {
            let values: Vec<f64> = values.iter().map(|it| it * 10_f64.powi(power)).collect();
            let scale = Scale::of(&values, &[], logarithmic, PIXELS).unwrap();
            for value in &values {
                let place = scale.at(*value);
                prop_assert!(place.is_some() || scale.is_logarithmic() && *value <= 0.0);
                prop_assert!(place.is_none_or(|it| (10.0..=200.0).contains(&it)));
            }
            let ticks = scale.ticks();
            prop_assert!((1..=12).contains(&ticks.len()), "{scale:?}: {ticks:?}");
            prop_assert!(ticks.windows(2).all(|two| two[1].0 < two[0].0 && two[0].1 != two[1].1));
        }
    }
}
