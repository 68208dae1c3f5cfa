//! Scales: which kind the data ask for, and where a number stands.

/// Above this ratio of the largest to the least of positive numbers an axis is logarithmic.
const WIDE: f64 = 1e3;

/// A logarithmic axis shows no less than this share of its largest number.
const DEEPEST: f64 = 1e-16;

/// How numbers stand on an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kind {
    /// Logarithmic where none of the numbers is negative and the positive ones differ by more
    /// than three powers of ten, linear elsewhere.
    #[default]
    Auto,
    /// Equal differences are equally far apart.
    Linear,
    /// Equal ratios are equally far apart; what is not above 0 has no place. Linear where no
    /// number is above 0.
    Logarithmic,
}

/// An axis: numbers from `low` to `high` on the pixels from `from` to `to`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) logarithmic: bool,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Scale {
    /// A linear axis without room at its ends.
    pub fn tight(low: f64, high: f64, pixels: [f64; 2]) -> Self {
        Self {
            low,
            high,
            logarithmic: false,
            from: pixels[0],
            to: pixels[1],
        }
    }

    /// The axis between two ends, where there can be one: they are finite, the first is below the
    /// second, and it is above 0 where the axis is logarithmic.
    pub(super) fn between(
        [low, high]: [f64; 2],
        logarithmic: bool,
        pixels: [f64; 2],
    ) -> Option<Self> {
        let apart = (high - low).is_finite() && high > low && (!logarithmic || low > 0.0);
        apart.then_some(Self {
            logarithmic,
            ..Self::tight(low, high, pixels)
        })
    }

    /// The axis on which these numbers are seen best, all of them finite; `lines` must be seen
    /// on it, so none of them may be 0 where it chooses to be logarithmic. Nothing without
    /// numbers.
    pub fn of(values: &[f64], lines: &[f64], kind: Kind, pixels: [f64; 2]) -> Option<Self> {
        Self::over(values.iter().copied(), lines, kind, pixels)
    }

    /// The same of numbers that come one after the other, and are not kept.
    pub(super) fn over(
        values: impl Iterator<Item = f64>,
        lines: &[f64],
        kind: Kind,
        pixels: [f64; 2],
    ) -> Option<Self> {
        // Sizes whose differences are numbers; the least above 0 means "above 0", and is 0 here.
        let within = |value: f64| match value.abs() > f64::MIN_POSITIVE {
            true => value.clamp(-1e300, 1e300),
            false => 0.0,
        };
        let all = values.chain(lines.iter().copied()).map(within);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut least: Option<f64> = None;
        for value in all {
            (low, high) = (low.min(value), high.max(value));
            if value > 0.0 {
                least = Some(least.map_or(value, |it| it.min(value)));
            }
        }
        if low > high {
            return None;
        }
        let wide = low >= 0.0 && least.is_some_and(|least| high / least > WIDE);
        let logarithmic = match kind {
            Kind::Auto => wide && lines.iter().all(|it| *it > 0.0),
            Kind::Linear => false,
            Kind::Logarithmic => true,
        };
        let scale = match least {
            Some(least) if logarithmic => Self::logarithmic(least, high, pixels),
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
    pub fn is_logarithmic(&self) -> bool {
        self.logarithmic
    }

    /// Whether a number is between the ends of the axis.
    pub fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// How many pixels a unit takes on a linear axis.
    pub(super) fn pixels_of_one(&self) -> f64 {
        ((self.to - self.from) / (self.high - self.low)).abs()
    }

    /// The linear axis with the same middle on which a unit takes so many pixels.
    pub(super) fn with_unit(self, pixels: f64) -> Self {
        let middle = 0.5 * (self.low + self.high);
        let half = 0.5 * ((self.to - self.from) / pixels).abs();
        Self {
            low: middle - half,
            high: middle + half,
            ..self
        }
    }

    /// Where a number stands, in pixels; below its end, at it. Nothing where it has no place
    /// on the axis.
    pub fn at(&self, value: f64) -> Option<f64> {
        Some(self.pixel(self.share(value)?.clamp(0.0, 1.0)))
    }

    /// Where a number stands, in pixels, also beyond the ends of the axis; there at most a hundred
    /// times its length away, which is too far to be seen. Nothing where it has no place.
    pub fn beyond(&self, value: f64) -> Option<f64> {
        Some(self.pixel(self.share(value)?.clamp(-100.0, 100.0)))
    }

    /// How far along the axis a number stands: 0 at its beginning, 1 at its end.
    fn share(&self, value: f64) -> Option<f64> {
        let share = match self.logarithmic {
            true if value <= 0.0 => return None,
            true => (value / self.low).log10() / (self.high / self.low).log10(),
            false => (value - self.low) / (self.high - self.low),
        };
        (!share.is_nan()).then_some(share)
    }

    fn pixel(&self, share: f64) -> f64 {
        self.from + share * (self.to - self.from)
    }
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
        // All with as many digits.
        let halves = Scale::tight(0.4, 2.1, PIXELS);
        assert_eq!(labels(halves), ["0.5", "1.0", "1.5", "2.0"]);
        let fine = Scale::tight(14.31779, 14.31791, PIXELS);
        assert!(labels(fine).iter().all(|it| it.len() == 8), "{fine:?}");
        let around = Scale::tight(-0.3, 0.3, PIXELS);
        assert_eq!(labels(around), ["-0.2", "0", "0.2"]);
        let far = Scale::of(&[1e-12, 1.0], &[], Kind::Auto, PIXELS).unwrap();
        assert!(labels(far).contains(&"10⁻⁹".to_owned()), "{far:?}");
        let close = Scale::of(&[0.3, 2.5], &[], Kind::Logarithmic, PIXELS).unwrap();
        assert_eq!(labels(close), ["0.5", "1", "2"]);
    }

    #[test]
    fn data_choose_the_axis() {
        let logarithmic = |values: &[f64], lines: &[f64]| {
            Scale::of(values, lines, Kind::Auto, PIXELS)
                .unwrap()
                .is_logarithmic()
        };
        assert!(logarithmic(&[0.0, 1e-4, 1.0], &[]));
        assert!(logarithmic(&[1.0, 2.0], &[1e-5]));
        assert!(!logarithmic(&[1.0, 2.0], &[]));
        assert!(!logarithmic(&[-1e-9, 1.0], &[]));
        // A bound of 0 must be seen.
        assert!(!logarithmic(&[1e-4, 1.0], &[0.0]));
        assert!(Scale::of(&[], &[], Kind::Auto, PIXELS).is_none());
    }

    #[test]
    fn what_is_below_a_logarithmic_axis_stands_at_its_end() {
        let scale = Scale::of(&[1e-300, 1.0], &[], Kind::Auto, PIXELS).unwrap();
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
            let kind = if logarithmic { Kind::Logarithmic } else { Kind::Auto };
            let scale = Scale::of(&values, &[], kind, PIXELS).unwrap();
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
