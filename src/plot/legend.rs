//! Legends: what the items of a plot are, told where nothing is hidden.

use super::layout::{LABEL, LINE, PAD};
use super::words::wrap;
use super::{Form, Item};
use crate::picture::text;

/// Width of the sample before a name.
pub(super) const SAMPLE: f64 = 24.0;

/// Height of a line of a legend.
const ROW: f64 = LABEL * LINE;

/// A name, and the item that bears it, without its points.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) sample: Item,
}

/// A legend and its place.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Legend {
    entries: Vec<Entry>,
    /// The names, in lines, and where the middle of the first of them begins.
    pub(super) rows: Vec<Row>,
    /// The corner and the size of the box about it, where it stands between the axes.
    pub(super) card: Option<([f64; 2], [f64; 2])>,
    /// The room that it takes below the axes.
    pub(super) height: f64,
}

/// An entry in its place. `at` is where the sample begins, at half the height of its line:
/// from the corner of the box where there is one, or of the room below the axes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) at: [f64; 2],
    pub(super) lines: Vec<String>,
    pub(super) sample: Option<Item>,
}

impl Legend {
    /// What names there are in these items that were not told before.
    pub(super) fn of(items: &[Item], told: &[Entry]) -> Self {
        let mut entries: Vec<Entry> = Vec::new();
        for item in items {
            let Some(name) = &item.name else { continue };
            let entry = Entry {
                name: name.clone(),
                sample: sample(item),
            };
            if !told.contains(&entry) && !entries.iter().any(|it| it.name == entry.name) {
                entries.push(entry);
            }
        }
        Self {
            entries,
            ..Self::default()
        }
    }

    /// What it tells.
    pub(super) fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Takes a corner of an area of this size in which none of these lines runs. Whether there is
    /// one with room for it.
    pub(super) fn find_corner(&mut self, area: [f64; 2], lines: &[[[f64; 2]; 2]]) -> bool {
        if self.entries.is_empty() {
            return true;
        }
        let most = 0.5 * area[0] - SAMPLE - 3.0 * PAD;
        if most < 4.0 * LABEL {
            return false;
        }
        let (mut rows, mut wide, mut high) = (Vec::new(), 0.0_f64, 0.5 * PAD);
        for entry in &self.entries {
            let lines = wrap(&entry.name, most, LABEL, false);
            wide = lines.iter().map(|it| width(it)).fold(wide, f64::max);
            rows.push(Row {
                at: [PAD, high + 0.5 * ROW],
                sample: Some(entry.sample.clone()),
                lines,
            });
            high += ROW * rows.last().map_or(1, |it| it.lines.len()) as f64;
        }
        let size = [wide + SAMPLE + 2.5 * PAD, high + 0.5 * PAD];
        if size[1] > 0.6 * area[1] {
            return false;
        }
        let corners = [(true, false), (false, false), (true, true), (false, true)];
        let corners = corners.map(|(right, below)| {
            let end = |far: bool, axis: usize| match far {
                true => area[axis] - size[axis] - PAD,
                false => PAD,
            };
            [end(right, 0), end(below, 1)]
        });
        // Lines have a width, and are not to touch.
        let (around, room) = (size.map(|it| it + PAD), 0.5 * PAD);
        let free = |corner: &[f64; 2]| {
            let corner = corner.map(|it| it - room);
            !lines.iter().any(|line| crosses(*line, corner, around))
        };
        let Some(corner) = corners.into_iter().find(free) else {
            return false;
        };
        self.card = Some((corner, size));
        self.rows = rows;
        true
    }

    /// Puts the entries in rows of this length below the axes, as many as the height allows.
    pub(super) fn flow(&mut self, length: f64, most: f64) {
        let (mut x, mut y) = (0.0, 0.0);
        self.rows.clear();
        for (place, entry) in self.entries.iter().enumerate() {
            let lines = wrap(&entry.name, length - SAMPLE - PAD, LABEL, false);
            let wide = lines.iter().map(|it| width(it)).fold(0.0, f64::max);
            let wide = SAMPLE + PAD + wide;
            if x > 0.0 && (x + wide > length || lines.len() > 1) {
                (x, y) = (0.0, y + ROW);
            }
            let high = ROW * lines.len() as f64;
            let left = self.entries.len() - place;
            if y + high + ROW > most && left > 1 {
                if x > 0.0 {
                    y += ROW;
                }
                self.rows.push(Row {
                    at: [0.0, y + 0.5 * ROW],
                    lines: vec![format!("… and {left} more")],
                    sample: None,
                });
                self.height = y + ROW;
                return;
            }
            self.rows.push(Row {
                at: [x, y + 0.5 * ROW],
                sample: Some(entry.sample.clone()),
                lines,
            });
            x += wide + 2.0 * PAD;
            if high > ROW {
                (x, y) = (0.0, y + high);
            }
        }
        self.height = if x > 0.0 { y + ROW } else { y };
    }
}

fn width(text: &str) -> f64 {
    text::width(text, LABEL, false)
}

/// An item without its points: what tells its entry from others.
fn sample(item: &Item) -> Item {
    let mut item = item.clone();
    match &mut item.form {
        Form::Line { points, .. } => points.clear(),
        Form::Markers { points, .. } => points.clear(),
        Form::Segments { ends, .. } | Form::Arrows { ends, .. } => ends.clear(),
        Form::Disks { disks, .. } => disks.clear(),
        Form::Area { corners } => corners.clear(),
        Form::Rug(places) => places.clear(),
        Form::Level(value) | Form::Moment(value) => *value = 0.0,
        Form::Text { text, at, .. } => {
            text.clear();
            *at = [0.0; 2];
        }
    }
    item
}

/// Whether a straight line runs through a rectangle.
fn crosses([from, to]: [[f64; 2]; 2], corner: [f64; 2], size: [f64; 2]) -> bool {
    // The part of the line within the rectangle's width, then of that within its height.
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (start, way) = (from[axis], to[axis] - from[axis]);
        let (low, high) = (corner[axis], corner[axis] + size[axis]);
        if way == 0.0 {
            if !(low..=high).contains(&start) {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - start) / way, (high - start) / way);
        first = first.max(a.min(b));
        last = last.min(a.max(b));
    }
    first <= last
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Theme;

    const AREA: [f64; 2] = [400.0, 300.0];

    fn corner(lines: &[[[f64; 2]; 2]]) -> Option<[f64; 2]> {
        let item = Item::line([], Theme::LIGHT.ink).named("bodies");
        let mut legend = Legend::of(&[item], &[]);
        legend
            .find_corner(AREA, lines)
            .then(|| legend.card.unwrap().0)
    }

    #[test]
    fn the_legend_hides_nothing() {
        // A line falls from the upper left corner to the lower right one.
        let falling = [[0.0, 0.0], AREA];
        let [x, y] = corner(&[falling]).unwrap();
        assert!(x > 200.0 && y < 150.0);
        let rising = [[0.0, 300.0], [400.0, 0.0]];
        let [x, y] = corner(&[rising]).unwrap();
        assert!(x < 200.0 && y < 150.0);
        let top = [[0.0, 15.0], [400.0, 15.0]];
        let [x, y] = corner(&[falling, top]).unwrap();
        assert!(x < 200.0 && y > 150.0);
        assert_eq!(corner(&[falling, rising]), None);
    }

    #[test]
    fn what_was_told_is_not_told_again() {
        let ink = Theme::LIGHT.ink;
        let items = [
            Item::line([[0.0, 0.0]], ink).named("a"),
            Item::line([[1.0, 2.0]], ink).named("a"),
            Item::level(3.0, ink).named("b"),
        ];
        let legend = Legend::of(&items, &[]);
        assert_eq!(legend.entries().len(), 2);
        let next = Legend::of(&items, &legend.entries()[..1]);
        assert_eq!(next.entries(), &legend.entries()[1..]);
    }

    #[test]
    fn a_long_legend_ends_with_a_number() {
        let ink = Theme::LIGHT.ink;
        let items: Vec<_> = (0..60)
            .map(|k| Item::line([], ink).named(format!("agent {k}")))
            .collect();
        let mut legend = Legend::of(&items, &[]);
        assert!(!legend.find_corner(AREA, &[]));
        legend.flow(400.0, 100.0);
        assert!(legend.height <= 100.0);
        let last = legend.rows.last().unwrap();
        let told = legend.rows.len() - 1;
        assert_eq!(last.lines, [format!("… and {} more", 60 - told)]);
    }
}
