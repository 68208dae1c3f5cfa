//! Quantities over time.

use super::components::at_place;
use super::reference::{Reference, of};
use super::{Quantity, Run, SeriesError, apart};
use crate::picture::{Color, Theme};
use crate::plot::{Axis, Item, Kind, Plot};

/// How quantities are plotted over time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OverTime {
    /// Whether all stand on the same axes, instead of on their own.
    pub together: bool,
    /// How time stands on its axis.
    pub time: Kind,
    /// How the quantities stand on theirs.
    pub values: Kind,
    /// Levels to compare with, each with what it is called.
    pub levels: Vec<(f64, Option<String>)>,
    /// The last time to show, also where all runs end before it; as far as the runs go where
    /// absent.
    pub to: Option<f64>,
}

/// Plots of quantities over time, for runs whose courses are those of the quantities, in their
/// order: one plot for each quantity, or one for all.
///
/// # Errors
/// Where a logarithmic axis has nothing to show, or no place for a level.
pub fn over_time(
    runs: &[Run],
    quantities: &[Quantity],
    how: &OverTime,
    theme: &Theme,
) -> Result<Vec<Plot>, SeriesError> {
    let placed = |value: f64| how.values != Kind::Logarithmic || value > 0.0;
    if let Some(&(value, _)) = how.levels.iter().find(|it| !placed(it.0)) {
        return Err(SeriesError::NoPlace { value });
    }
    let names = apart(runs);
    let several = how.together && quantities.len() > 1;
    let mut plots: Vec<Plot> = Vec::new();
    for (k, (quantity, label)) in quantities.iter().zip(labels(quantities)).enumerate() {
        if plots.is_empty() || !how.together {
            plots.push(empty(runs, how, label.clone())?);
        }
        let Some(plot) = plots.last_mut() else {
            continue;
        };
        if several {
            plot.y.label = String::new();
        }
        let mut references = Vec::new();
        for (n, (run, name)) in runs.iter().zip(&names).enumerate() {
            let course = &run.courses[k];
            if course.is_empty() {
                continue;
            }
            if how.values == Kind::Logarithmic && !course.known().any(|[_, y]| y > 0.0) {
                let what = format!("{}: {}", run.name, quantity.name());
                return Err(SeriesError::NotPositive { what });
            }
            let place = if several { k * runs.len() + n } else { n };
            let color = theme.of(place);
            let line = Item::parted(course.points().iter().copied(), color);
            let line = at_place(line, place, theme);
            plot.items.push(match (several, name) {
                (false, None) => line,
                (false, Some(name)) => line.named(name),
                (true, None) => line.named(&label),
                (true, Some(name)) => line.named(format!("{label}, {name}")),
            });
            references.extend(reference(
                run,
                k,
                quantity,
                several || runs.len() > 1,
                color,
                theme,
            ));
            let contacts = match quantity.stem() {
                "agent_gap" | "smallest_agent_gap" => run.agent_contacts.as_slice(),
                "obstacle_gap" | "smallest_obstacle_gap" => run.obstacle_contacts.as_slice(),
                _ => &[],
            };
            if !contacts.is_empty() {
                let rug = Item::rug(contacts.iter().copied(), color);
                plot.items.push(rug.named("contacts begin"));
            }
        }
        for (value, item) in references {
            if placed(value) && !plot.items.contains(&item) {
                plot.items.push(item);
            }
        }
    }
    for plot in &mut plots {
        let levels = how.levels.iter().map(|(value, name)| {
            let level = Item::level(*value, theme.ink);
            match name {
                Some(name) => level.named(name),
                None => level,
            }
        });
        plot.items.extend(levels);
    }
    Ok(plots)
}

/// What the quantities are called: their full names where others were called the same.
fn labels(quantities: &[Quantity]) -> Vec<String> {
    let short: Vec<String> = quantities.iter().map(Quantity::label).collect();
    let label = |(k, quantity): (usize, &Quantity)| {
        let shared = short.iter().filter(|it| **it == short[k]).count() > 1;
        match shared {
            true => quantity.name().to_owned(),
            false => short[k].clone(),
        }
    };
    quantities.iter().enumerate().map(label).collect()
}

/// A plot without items.
fn empty(runs: &[Run], how: &OverTime, label: String) -> Result<Plot, SeriesError> {
    let least = |times: &mut dyn Iterator<Item = f64>| times.reduce(f64::min);
    let first = match how.time {
        // The start, time 0, has no place there.
        Kind::Logarithmic => {
            let all = runs.iter().flat_map(|run| &run.courses);
            least(
                &mut all
                    .flat_map(|it| it.known())
                    .map(|it| it[0])
                    .filter(|it| *it > 0.0),
            )
        }
        _ => least(&mut runs.iter().map(|run| run.times[0])),
    };
    let last = runs.iter().map(|run| run.times[1]).reduce(f64::max);
    let range = match (first, last) {
        (Some(first), Some(last)) => Some([first, how.to.map_or(last, |to| to.max(last))]),
        _ => None,
    };
    if how.time == Kind::Logarithmic && range.is_none_or(|[first, last]| first >= last) {
        let what = "time".to_owned();
        return Err(SeriesError::NotPositive { what });
    }
    Ok(Plot {
        x: Axis {
            label: "time".to_owned(),
            // Time runs evenly unless asked otherwise.
            kind: if how.time == Kind::Auto {
                Kind::Linear
            } else {
                how.time
            },
            range,
        },
        y: Axis {
            label,
            kind: how.values,
            range: None,
        },
        ..Plot::default()
    })
}

/// The level that a quantity of a run is compared with. Those of several lines have the colours
/// of the lines, where they differ.
fn reference(
    run: &Run,
    course: usize,
    quantity: &Quantity,
    several: bool,
    color: Color,
    theme: &Theme,
) -> Option<(f64, Item)> {
    let (value, color, what) = match of(quantity.stem())? {
        Reference::Value(value, what) => (value, theme.ink, what),
        Reference::Start(what) => {
            let own = if several { color } else { theme.ink };
            (run.starts[course]?, own, what)
        }
    };
    Some((value, Item::level(value, color).named(what)))
}
