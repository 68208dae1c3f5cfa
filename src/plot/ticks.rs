//! Ticks: round numbers along an axis, and what they say.

use super::Scale;
use crate::math::digits;

/// How many ticks an axis has, about, where nothing else asks for more or fewer.
const TICKS: f64 = 5.0;

impl Scale {
    /// About five ticks: where they stand, in pixels, and what they say.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        self.ticks_about(TICKS)
    }

    /// About so many ticks: where they stand, in pixels, and what they say. There may be up to
    /// three times as many, or few or none where the axis is short of round numbers.
    pub fn ticks_about(&self, count: f64) -> Vec<(f64, String)> {
        let ticks = match self.logarithmic {
            true => self.powers(count),
            false => self.multiples(count),
        };
        let ticks = ticks.into_iter();
        ticks
            .filter_map(|(value, text)| Some((self.at(value)?, text)))
            .collect()
    }

    /// Where the finer ticks between about so many ticks stand, in pixels.
    pub fn minor_ticks(&self, count: f64) -> Vec<f64> {
        let values: Vec<f64> = match self.logarithmic {
            true => {
                let (first, last, stride) = self.decades(count);
                let multiples = if stride == 1 { 1..=9 } else { 1..=1 };
                let decade = |power| multiples.clone().map(move |it| (power, it));
                let all = (first..=last).flat_map(decade);
                all.map(|(power, it)| f64::from(it) * 10_f64.powi(power))
                    .collect()
            }
            false => {
                let (multiple, power) = round_step((self.high - self.low) / count);
                let parts = if multiple == 2.0 { 4.0 } else { 5.0 };
                let step = multiple * 10_f64.powi(power) / parts;
                let (first, last) = self.within(step, parts * count);
                (0..=(last - first) as usize)
                    .map(|k| (first + k as f64) * step)
                    .collect()
            }
        };
        let seen = values.into_iter();
        seen.filter(|it| (self.low..=self.high).contains(it))
            .filter_map(|it| self.at(it))
            .collect()
    }

    /// The first and the last multiple of a step on the axis, as whole numbers, about `count` of
    /// them at most twice as many.
    fn within(&self, step: f64, count: f64) -> (f64, f64) {
        let first = (self.low / step - 1e-9).ceil();
        let last = (self.high / step + 1e-9).floor();
        (
            first,
            first + (last - first).clamp(0.0, 2.0 * count.max(1.0)),
        )
    }

    /// Multiples of 1, 2 or 5 times a power of ten.
    fn multiples(&self, count: f64) -> Vec<(f64, String)> {
        let (multiple, power) = round_step((self.high - self.low) / count);
        let step = multiple * 10_f64.powi(power);
        let (first, last) = self.within(step, count);
        let numbers: Vec<f64> = (0..=(last - first) as usize)
            .map(|k| first + k as f64)
            .collect();
        // Zero is zero, not what rounding left of it.
        let settle = |value: f64| match value.abs() < 1e-9 * step {
            true => 0.0,
            false => value,
        };
        let value = |number: f64| settle(number * step);
        let values = numbers.iter().map(|it| value(*it));
        let largest = values.map(f64::abs).fold(step, f64::max);
        let head = largest.log10().floor() as i32;
        // All ticks but zero have as many digits behind the point as the step needs.
        let text = |number: f64| match value(number) {
            0.0 => "0".to_owned(),
            value if (-3..=5).contains(&head) => {
                let decimals = (-power).clamp(0, 15) as usize;
                format!("{value:.decimals$}")
            }
            _ => {
                let decimals = (head - power).clamp(0, 15) as usize;
                let share = number * multiple * 10_f64.powi(power - head);
                scientific(&format!("{share:.decimals$}"), head)
            }
        };
        numbers.iter().map(|it| (value(*it), text(*it))).collect()
    }

    /// The first and the last power of ten about the axis, and how many of them stand between two
    /// ticks.
    fn decades(&self, count: f64) -> (i32, i32, i32) {
        let first = self.low.log10().floor() as i32;
        let last = self.high.log10().ceil() as i32;
        let stride = (f64::from(last - first) / (count + 1.0)).ceil().max(1.0);
        (first, last, stride as i32)
    }

    /// Powers of ten, and numbers between them where there are few.
    fn powers(&self, count: f64) -> Vec<(f64, String)> {
        let (first, last, stride) = self.decades(count);
        let plain = first >= -3 && last <= 5;
        let within = |value: &f64| (self.low..=self.high).contains(value);
        let multiples: &[f64] = match (self.high / self.low).log10() {
            span if span < 1.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let mut ticks = Vec::new();
        for power in (first..=last).filter(|power| power.rem_euclid(stride) == 0) {
            for multiple in multiples {
                let value = multiple * 10_f64.powi(power);
                let text = match plain {
                    true => digits(value, 3),
                    false => scientific(&multiple.to_string(), power),
                };
                ticks.extend(within(&value).then_some((value, text)));
            }
        }
        match ticks.len() {
            // Less than a decade: round numbers as on any axis.
            0 | 1 => self.multiples(count),
            _ => ticks,
        }
    }
}

/// The step of at least this size that is 1, 2 or 5 times a power of ten: the number, and the
/// power.
fn round_step(size: f64) -> (f64, i32) {
    let power = size.log10().floor() as i32;
    let share = size / 10_f64.powi(power);
    let fits = [1.0, 2.0, 5.0].into_iter();
    let mut fits = fits.filter(|step| *step >= share * (1.0 - 1e-9));
    fits.next().map_or((1.0, power + 1), |step| (step, power))
}

/// A number times a power of ten, the number left away where it is 1.
fn scientific(number: &str, power: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    let raised: String = power.to_string().chars().map(raise).collect();
    match number {
        "1" => format!("10{raised}"),
        "-1" => format!("-10{raised}"),
        _ => format!("{number}·10{raised}"),
    }
}
