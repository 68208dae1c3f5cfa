//! Numbers that change with time: gains, steering, anything given from outside.

use std::f64::consts::TAU;
use std::fmt;
use std::sync::Arc;

use crate::math::sin_cos_of_turns;

/// A number as a function of time. Its values are the same on every platform, but for those
/// of a function of one's own.
#[derive(Clone)]
pub enum TimeFunction {
    /// The same at all times.
    Constant(f64),
    /// Values at some times, and what lies between them. Constant before the first and after
    /// the last.
    Table {
        /// The times, increasing; at least one.
        times: Vec<f64>,
        /// One value for each time.
        values: Vec<f64>,
        /// What lies between.
        interpolation: Interpolation,
    },
    /// mean + amplitude · sin(2πt/period + phase).
    Sine {
        /// What it swings about.
        mean: f64,
        /// How far it swings.
        amplitude: f64,
        /// Time of one oscillation, above 0.
        period: f64,
        /// Phase at time 0, in radians.
        phase: f64,
    },
    /// High from time 0 on for a share of each period, low for the rest of it.
    Square {
        /// The value in the rest of each period.
        low: f64,
        /// The value in the first part of each period.
        high: f64,
        /// Time from one rise to the next, above 0.
        period: f64,
        /// Share of each period in which it is high, 0 to 1.
        duty: f64,
    },
    /// end + (start − end) e^(−t/time).
    Exponential {
        /// The value at time 0.
        start: f64,
        /// The value that it tends to.
        end: f64,
        /// Time in which what is left to that falls to 1/e, above 0.
        time: f64,
    },
    /// The sum of some functions, 0 of none.
    Sum(Vec<TimeFunction>),
    /// The product of some functions, 1 of none.
    Product(Vec<TimeFunction>),
    /// A function of one's own. It must be a function of time indeed: the same value for the
    /// same time, whatever was asked before.
    Own(Arc<dyn Fn(f64) -> f64 + Send + Sync>),
}

/// What lies between the values of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// The straight line between the values on either side.
    Linear,
    /// The value of the last time so far.
    Step,
}

impl TimeFunction {
    /// A function of one's own.
    pub fn own(function: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::Own(Arc::new(function))
    }

    /// The value at a time.
    pub fn value(&self, time: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Table {
                times,
                values,
                interpolation,
            } => look_up(times, values, *interpolation, time),
            Self::Sine {
                mean,
                amplitude,
                period,
                phase,
            } => {
                // The remainder is exact, however long the time.
                let turns = (time % period) / period + phase / TAU;
                mean + amplitude * sin_cos_of_turns(turns).0
            }
            Self::Square {
                low,
                high,
                period,
                duty,
            } => match time.rem_euclid(*period) < duty * period {
                true => *high,
                false => *low,
            },
            Self::Exponential {
                start,
                end,
                time: scale,
            } => {
                let left = libm::exp(-time.max(0.0) / scale);
                start * left + end * (1.0 - left)
            }
            Self::Sum(terms) => terms.iter().fold(0.0, |sum, term| sum + term.value(time)),
            Self::Product(factors) => {
                let values = factors.iter().map(|factor| factor.value(time));
                values.fold(1.0, |product, value| product * value)
            }
            Self::Own(function) => function(time),
        }
    }

    /// Two numbers between which every value lies; infinite for a function of one's own. Of
    /// sums and products they are those of the parts, as if these took any of their values
    /// together, and may be wider than need be.
    pub fn bounds(&self) -> [f64; 2] {
        let around = |values: &[f64]| {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            [least, largest]
        };
        match self {
            Self::Constant(value) => [*value; 2],
            Self::Table { values, .. } => around(values),
            Self::Sine {
                mean, amplitude, ..
            } => [mean - amplitude.abs(), mean + amplitude.abs()],
            // A value that is never taken is no bound.
            Self::Square {
                low, high, duty, ..
            } => match *duty {
                0.0 => [*low; 2],
                1.0 => [*high; 2],
                _ => around(&[*low, *high]),
            },
            Self::Exponential { start, end, .. } => around(&[*start, *end]),
            Self::Sum(terms) => terms.iter().fold([0.0; 2], |[low, high], term| {
                let [least, largest] = term.bounds();
                [low + least, high + largest]
            }),
            Self::Product(factors) => factors.iter().fold([1.0; 2], |[low, high], factor| {
                let [least, largest] = factor.bounds();
                let ends = [low * least, low * largest, high * least, high * largest];
                // Nothing times a function without bounds is nothing.
                around(&ends.map(|end| if end.is_nan() { 0.0 } else { end }))
            }),
            Self::Own(_) => [f64::NEG_INFINITY, f64::INFINITY],
        }
    }
}

/// The value of a table at a time; 0 of an empty one.
fn look_up(times: &[f64], values: &[f64], interpolation: Interpolation, time: f64) -> f64 {
    let after = times.partition_point(|known| *known <= time);
    let (Some(last), Some(next)) = (after.checked_sub(1), values.get(after)) else {
        // Before the first time or after the last.
        let end = after.min(values.len().saturating_sub(1));
        return values.get(end).copied().unwrap_or(0.0);
    };
    match interpolation {
        Interpolation::Step => values[last],
        Interpolation::Linear => {
            let share = (time - times[last]) / (times[after] - times[last]);
            values[last] * (1.0 - share) + next * share
        }
    }
}

impl From<f64> for TimeFunction {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}

impl fmt::Debug for TimeFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(f, "{value}"),
            Self::Table {
                times,
                values,
                interpolation,
            } => (f.debug_struct("Table"))
                .field("times", times)
                .field("values", values)
                .field("interpolation", interpolation)
                .finish(),
            Self::Sine {
                mean,
                amplitude,
                period,
                phase,
            } => write!(f, "{mean} + {amplitude}·sin(2πt/{period} + {phase})"),
            Self::Square {
                low,
                high,
                period,
                duty,
            } => write!(f, "{high} for {duty} of every {period}, else {low}"),
            Self::Exponential { start, end, time } => {
                write!(f, "{end} + ({start} − {end})·exp(−t/{time})")
            }
            Self::Sum(terms) => f.debug_tuple("Sum").field(terms).finish(),
            Self::Product(factors) => f.debug_tuple("Product").field(factors).finish(),
            Self::Own(_) => f.write_str("Own(…)"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(interpolation: Interpolation) -> TimeFunction {
        TimeFunction::Table {
            times: vec![1.0, 2.0, 4.0],
            values: vec![3.0, 5.0, -1.0],
            interpolation,
        }
    }

    fn values(function: &TimeFunction, times: &[f64]) -> Vec<f64> {
        times.iter().map(|&time| function.value(time)).collect()
    }

    #[test]
    fn tables_are_constant_outside_and_pass_through_their_values() {
        let times = [-9.0, 0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 99.0];
        let linear = table(Interpolation::Linear);
        let expected = [3.0, 3.0, 3.0, 4.0, 5.0, 2.0, -1.0, -1.0];
        assert_eq!(values(&linear, &times), expected);
        let step = table(Interpolation::Step);
        let expected = [3.0, 3.0, 3.0, 3.0, 5.0, 5.0, -1.0, -1.0];
        assert_eq!(values(&step, &times), expected);
        let single = TimeFunction::Table {
            times: vec![1.0],
            values: vec![7.0],
            interpolation: Interpolation::Linear,
        };
        assert_eq!(values(&single, &[0.0, 1.0, 2.0]), [7.0; 3]);
    }

    #[test]
    fn waves_are_what_their_formulas_say_at_any_time() {
        let sine = TimeFunction::Sine {
            mean: 1.0,
            amplitude: -2.0,
            period: 0.75,
            phase: 0.3,
        };
        for k in 0..300 {
            let time = 0.0137 * f64::from(k);
            let expected = 1.0 - 2.0 * (TAU * time / 0.75 + 0.3).sin();
            assert!((sine.value(time) - expected).abs() < 1e-13, "{time}");
        }
        assert_eq!(sine.value(0.25 + 0.75 * 2f64.powi(40)), sine.value(0.25));
        let square = TimeFunction::Square {
            low: -1.0,
            high: 2.0,
            period: 4.0,
            duty: 0.25,
        };
        let times = [0.0, 0.99, 1.0, 3.99, 4.0, 5.0, -0.5];
        let expected = [2.0, 2.0, -1.0, -1.0, 2.0, -1.0, -1.0];
        assert_eq!(values(&square, &times), expected);
    }

    #[test]
    fn exponentials_go_from_their_start_to_their_end() {
        let falling = TimeFunction::Exponential {
            start: 5.0,
            end: 1.0,
            time: 2.0,
        };
        for time in [0.0, 0.3, 2.0, 11.0] {
            let expected = 1.0 + 4.0 * f64::exp(-0.5 * time);
            assert!(
                (falling.value(time) - expected).abs() < 1e-15 * 8.0,
                "{time}"
            );
        }
        assert_eq!(falling.value(1e9), 1.0);
        assert_eq!(falling.bounds(), [1.0, 5.0]);
    }

    #[test]
    fn sums_and_products_are_those_of_the_values() {
        let own = TimeFunction::own(|time| time * time);
        let linear = table(Interpolation::Linear);
        let sum = TimeFunction::Sum(vec![linear.clone(), own.clone(), 0.5.into()]);
        assert_eq!(sum.value(1.5), 4.0 + 2.25 + 0.5);
        let product = TimeFunction::Product(vec![linear, own, 2.0.into()]);
        assert_eq!(product.value(3.0), 2.0 * 9.0 * 2.0);
        assert_eq!(TimeFunction::Sum(Vec::new()).value(1.0), 0.0);
        assert_eq!(TimeFunction::Product(Vec::new()).value(1.0), 1.0);
    }

    #[test]
    fn bounds_hold_and_are_met_by_the_plain_functions() {
        let sine = TimeFunction::Sine {
            mean: 1.0,
            amplitude: -2.0,
            period: 0.75,
            phase: 0.0,
        };
        assert_eq!(sine.bounds(), [-1.0, 3.0]);
        assert_eq!(table(Interpolation::Step).bounds(), [-1.0, 5.0]);
        let never_low = TimeFunction::Square {
            low: -1.0,
            high: 2.0,
            period: 4.0,
            duty: 1.0,
        };
        assert_eq!(never_low.bounds(), [2.0, 2.0]);
        let product = TimeFunction::Product(vec![sine.clone(), (-2.0).into()]);
        assert_eq!(product.bounds(), [-6.0, 2.0]);
        let sum = TimeFunction::Sum(vec![sine, product]);
        assert_eq!(sum.bounds(), [-7.0, 5.0]);
        let nothing = TimeFunction::Product(vec![0.0.into(), TimeFunction::own(|t| t)]);
        assert_eq!(nothing.bounds(), [0.0, 0.0]);
    }
}
