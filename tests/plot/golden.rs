//! A small plot, as it looked when a person saw it last.

use std::path::PathBuf;

use volary::picture::Theme;
use volary::plot::{Axis, Item, Marker, Plot};

use crate::image::{assert_looks_like, difference};

/// A plot with a bit of everything; `end` is the value that its line ends at.
fn plot(theme: &Theme, end: f64) -> Plot {
    let time = |k: u32| f64::from(k) / 10.0;
    let falling = (0..=100).map(|k| [time(k), end + (2.0 - end) * (-time(k)).exp()]);
    let dashed = (0..=100).map(|k| [time(k), 1.0 + 0.5 * time(k).sin()]);
    Plot {
        title: "energies".to_owned(),
        x: Axis::new("time").linear().range([0.0, 10.0]),
        y: Axis::new("energy W"),
        items: vec![
            Item::line(falling, theme.of(0)).named("bodies"),
            Item::line(dashed, theme.of(1)).dashed().named("points"),
            Item::level(2.0, theme.ink).named("W(0)"),
            Item::markers([[5.0, 1.0]], Marker::Star, theme.of(3)).sized(6.0),
            Item::rug([2.0, 2.5, 7.0], theme.of(2)),
        ],
        equal: false,
    }
}

fn png(theme: &Theme, end: f64) -> Vec<u8> {
    let picture = plot(theme, end).draw([240.0, 180.0], theme);
    picture.paint().unwrap().png().unwrap()
}

fn golden(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("tests/plot/golden")
        .join(name)
}

/// What may differ where another processor rounds the edges of lines in another way.
const MEAN: f64 = 0.001;
const MOST: f64 = 0.2;

#[test]
fn plots_look_as_they_did() {
    assert_looks_like(&golden("light.png"), &png(&Theme::LIGHT, 0.1), MEAN, MOST);
    assert_looks_like(&golden("dark.png"), &png(&Theme::DARK, 0.1), MEAN, MOST);
}

#[test]
fn a_line_a_little_off_is_seen() {
    let (one, other) = (png(&Theme::LIGHT, 0.1), png(&Theme::LIGHT, 0.15));
    let found = difference(&one, &other).unwrap();
    assert!(found.mean > MEAN && found.most > MOST, "{found:?}");
    assert!(difference(&one, &one).unwrap().most == 0.0);
    let picture = plot(&Theme::LIGHT, 0.1).draw([241.0, 180.0], &Theme::LIGHT);
    assert_eq!(
        difference(&one, &picture.paint().unwrap().png().unwrap()),
        None
    );
}
