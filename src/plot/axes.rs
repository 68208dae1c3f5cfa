//! The axes of a plot: scales and ticks.

use super::layout::{LINE, PAD, TICK};
use super::{Axis, Form, Item, Kind, Plot, Scale};
use crate::picture::text;

/// Both axes of a plot, in pixels from the upper left corner of the area between them.
#[derive(Debug)]
pub(super) struct Axes {
    pub(super) x: Ruler,
    pub(super) y: Ruler,
}

/// A scale with its ticks.
#[derive(Debug)]
pub(super) struct Ruler {
    pub(super) scale: Scale,
    /// Where ticks stand, and what they say.
    pub(super) ticks: Vec<(f64, String)>,
    /// Where finer ticks stand.
    pub(super) minor: Vec<f64>,
}

impl Axes {
    /// The axes that show the items of a plot on an area of this size.
    pub(super) fn of(plot: &Plot, [width, height]: [f64; 2]) -> Self {
        let finite = |[x, y]: &[f64; 2]| x.is_finite() && y.is_finite();
        let points = || plot.items.iter().flat_map(Item::points).filter(finite);
        let moments = plot.items.iter().filter_map(|item| match item.form {
            Form::Moment(place) => Some(place),
            _ => None,
        });
        let levels = plot.items.iter().filter_map(|item| match item.form {
            Form::Level(height) => Some(height),
            _ => None,
        });
        let across = points().map(|[x, _]| x);
        let mut x = scale(&plot.x, plot.equal, across, moments.collect(), [0.0, width]);
        // Only what is seen matters for the height.
        let seen = |point: &[f64; 2]| x.holds(point[0]);
        let upward = points().filter(seen).map(|[_, y]| y);
        let mut y = scale(&plot.y, plot.equal, upward, levels.collect(), [height, 0.0]);
        if plot.equal {
            let unit = x.pixels_of_one().min(y.pixels_of_one());
            x = x.with_unit(unit);
            y = y.with_unit(unit);
        }
        let wide = |text: &str| text::width(text, TICK, false) + 1.5 * PAD;
        let high = |_: &str| TICK * LINE;
        Self {
            x: Ruler::new(x, (width / 70.0).clamp(2.0, 10.0), wide),
            y: Ruler::new(y, (height / 38.0).clamp(2.0, 8.0), high),
        }
    }

    /// Whether a point is between the ends of both axes.
    pub(super) fn holds(&self, [x, y]: [f64; 2]) -> bool {
        self.x.scale.holds(x) && self.y.scale.holds(y)
    }

    /// Where a point stands; nothing where it has no place on the axes.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        Some([self.x.scale.beyond(x)?, self.y.scale.beyond(y)?])
    }
}

/// The scale of an axis on these pixels, on which values and lines are to be seen.
fn scale(
    axis: &Axis,
    equal: bool,
    values: impl Iterator<Item = f64>,
    lines: Vec<f64>,
    pixels: [f64; 2],
) -> Scale {
    let kind = if equal { Kind::Linear } else { axis.kind };
    let lines: Vec<f64> = lines.into_iter().filter(|it| it.is_finite()).collect();
    let chosen = Scale::over(values, &lines, kind, pixels);
    let logarithmic = chosen.map_or(kind == Kind::Logarithmic, |it| it.is_logarithmic());
    let asked = axis.range.and_then(|ends| {
        let as_chosen = Scale::between(ends, logarithmic, pixels);
        as_chosen.or_else(|| Scale::between(ends, false, pixels).filter(|_| kind == Kind::Auto))
    });
    asked.or(chosen).unwrap_or(Scale::tight(0.0, 1.0, pixels))
}

impl Ruler {
    /// Ticks on a scale, about `count` of them or fewer, as many as stand clear of each other
    /// where a text takes the `room` along the axis.
    fn new(scale: Scale, count: f64, room: impl Fn(&str) -> f64) -> Self {
        let clear = |ticks: &[(f64, String)]| {
            ticks.windows(2).all(|two| {
                let [(a, one), (b, other)] = two else {
                    return true;
                };
                (b - a).abs() >= 0.5 * (room(one) + room(other))
            })
        };
        let counts = (2..=count as usize).rev().map(|count| count as f64);
        let fits = counts
            .map(|count| (count, scale.ticks_about(count)))
            .find(|(_, ticks)| clear(ticks));
        let (count, ticks) = fits.unwrap_or_else(|| {
            let mut ticks = scale.ticks_about(1.0);
            while !clear(&ticks) {
                ticks.pop();
            }
            (1.0, ticks)
        });
        let mut minor = scale.minor_ticks(count);
        let crowded = |two: &[f64]| (two[1] - two[0]).abs() < 2.5;
        if minor.windows(2).any(crowded) {
            minor.clear();
        }
        Self {
            scale,
            ticks,
            minor,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Whatever the ends of an axis, its ticks stand on it and clear of each other.
        #[test]
        fn ticks_stand_clear(
            middle in -1e3..1e3_f64,
            power in -12..12_i32,
            length in 1e-6..10.0_f64,
            pixels in 40.0..1600.0_f64,
            logarithmic in any::<bool>(),
        ) {
            let size = 10_f64.powi(power);
            let ends = match logarithmic {
                true => [size, size * (1.0 + 1e4 * length)],
                false => [middle * size, (middle + middle.abs().max(1.0) * length) * size],
            };
            let scale = Scale::between(ends, logarithmic, [0.0, pixels]).unwrap();
            let wide = |text: &str| text::width(text, TICK, false) + PAD;
            let ruler = Ruler::new(scale, (pixels / 70.0).clamp(2.0, 10.0), wide);
            let mut end = f64::NEG_INFINITY;
            for (at, text) in &ruler.ticks {
                let half = 0.5 * text::width(text, TICK, false);
                prop_assert!((0.0..=pixels).contains(at));
                prop_assert!(at - half > end, "{text} at {at} on {:?}", ruler);
                end = at + half;
            }
            let texts: std::collections::BTreeSet<_> = ruler.ticks.iter().map(|it| &it.1).collect();
            prop_assert_eq!(texts.len(), ruler.ticks.len(), "{:?}", ruler.ticks);
            prop_assert!(ruler.minor.iter().all(|at| (-1e-9..=pixels + 1e-9).contains(at)));
        }

        /// What an item holds is seen.
        #[test]
        fn axes_cover_their_items(
            points in prop::collection::vec(prop::array::uniform2(-1e9..1e9_f64), 1..9),
            equal in any::<bool>(),
        ) {
            let items = vec![Item::line(points.clone(), crate::picture::Theme::LIGHT.ink)];
            let plot = Plot { items, equal, ..Plot::default() };
            let axes = Axes::of(&plot, [300.0, 200.0]);
            for point in points {
                let [x, y] = axes.at(point).unwrap();
                prop_assert!((0.0..=300.0).contains(&x) && (0.0..=200.0).contains(&y));
            }
            let (x, y) = (axes.x.scale.pixels_of_one(), axes.y.scale.pixels_of_one());
            prop_assert!(!equal || (x / y - 1.0).abs() < 1e-9);
        }
    }
}
