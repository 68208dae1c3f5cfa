//! What is on the page of a plot, mark by mark.

use proptest::prelude::*;
use volary::picture::{Anchor, Label, Mark, Picture, Theme, text};
use volary::plot::{Axis, Item, Plot, Sheet};

/// The box of a line of text on the page: left, top, right, bottom.
fn extent(label: &Label, [dx, dy]: [f64; 2]) -> [f64; 4] {
    let width = text::width(&label.text, label.size, label.bold);
    let before = match label.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5 * width,
        Anchor::End => width,
    };
    let (up, down) = (0.74 * label.size, 0.2 * label.size);
    let [x, y] = [label.at[0] + dx, label.at[1] + dy];
    match label.upwards {
        false => [x - before, y - up, x - before + width, y + down],
        true => [x - up, y + before - width, x + down, y + before],
    }
}

fn labels(marks: &[Mark], at: [f64; 2], found: &mut Vec<(String, [f64; 4])>) {
    for mark in marks {
        match mark {
            Mark::Label(label) => found.push((label.text.clone(), extent(label, at))),
            Mark::Group { corner, marks, .. } => {
                labels(marks, [at[0] + corner[0], at[1] + corner[1]], found);
            }
            _ => {}
        }
    }
}

/// All lines of text, each with its box.
fn texts(picture: &Picture) -> Vec<(String, [f64; 4])> {
    let mut found = Vec::new();
    labels(&picture.marks, [0.0; 2], &mut found);
    found
}

fn overlap(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// Nothing is cut, and no words stand on others.
fn check(picture: &Picture) -> Result<(), TestCaseError> {
    let texts = texts(picture);
    let [width, height] = picture.size;
    for (k, (text, own)) in texts.iter().enumerate() {
        let inside = own[0] >= -0.01 && own[1] >= -0.01 && own[2] <= width && own[3] <= height;
        prop_assert!(inside, "{text:?} is cut: {own:?} on {width} x {height}");
        for (other, its) in &texts[..k] {
            prop_assert!(
                !overlap(own, its),
                "{text:?} and {other:?}: {own:?}, {its:?}"
            );
        }
    }
    Ok(())
}

#[test]
fn the_test_sees_what_overlaps() {
    let mut picture = Picture::new([100.0; 2], Theme::LIGHT.page, "");
    picture.label(Label::new("one", [10.0, 50.0], 12.0, Theme::LIGHT.ink));
    assert!(check(&picture).is_ok());
    picture.label(Label::new("two", [20.0, 52.0], 12.0, Theme::LIGHT.ink));
    assert!(check(&picture).is_err());
    let mut picture = Picture::new([100.0; 2], Theme::LIGHT.page, "");
    picture.label(Label::new(
        "over the edge",
        [60.0, 50.0],
        12.0,
        Theme::LIGHT.ink,
    ));
    assert!(check(&picture).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn words_are_whole_and_apart(
        size in (300.0..1200.0_f64, 240.0..900.0_f64),
        low in -1e3..1e3_f64,
        length in 1e-3..1e6_f64,
        power in -9..9_i32,
        words in prop::collection::vec("[a-z]{1,9}", 0..16),
        names in prop::collection::vec("[a-z ]{1,30}", 0..6),
        logarithmic in any::<bool>(),
        equal in any::<bool>(),
    ) {
        let theme = Theme::LIGHT;
        let scale = 10_f64.powi(power);
        let at = |share: f64| if logarithmic { share + 1e-5 } else { low + share };
        let line = |k: usize| {
            let rising = k.is_multiple_of(2);
            let points = (0..=20).map(move |it| it as f64 / 20.0).map(move |x| {
                [scale * at(x * length), scale * at(if rising { x } else { 1.0 - x } * length)]
            });
            Item::line(points, theme.of(k))
        };
        let axis = |label: &str| match logarithmic {
            true => Axis::new(label).logarithmic(),
            false => Axis::new(label),
        };
        let words = words.join(" ");
        let plot = Plot {
            title: words.clone(),
            x: axis(&words),
            y: axis(&words),
            items: names.iter().enumerate().map(|(k, name)| line(k).named(name)).collect(),
            equal,
        };
        check(&plot.draw(size.into(), &theme))?;
    }

    #[test]
    fn panels_are_in_line_and_apart(
        size in (700.0..1400.0_f64, 700.0..1200.0_f64),
        count in 1..7_usize,
        columns in 1..4_usize,
        powers in prop::collection::vec(-9..9_i32, 7),
    ) {
        let theme = Theme::DARK;
        let plots = (0..count).map(|k| {
            let scale = 10_f64.powi(powers[k]);
            Plot {
                title: format!("panel {k}"),
                x: Axis::new("time").range([0.0, 10.0]),
                y: Axis::new("value"),
                items: vec![Item::line([[0.0, 0.0], [10.0, scale]], theme.of(k)).named("run")],
                ..Plot::default()
            }
        });
        let sheet = Sheet {
            title: "all".to_owned(),
            plots: plots.collect(),
            columns,
            letters: true,
            shared_x: true,
        };
        let picture = sheet.draw(size.into(), &theme);
        check(&picture)?;
        let texts = texts(&picture);
        let told = texts.iter().filter(|(text, _)| text == "run").count();
        // Colours go round after seven, so no two panels have the same entry.
        prop_assert_eq!(told, count);
        let titles: Vec<f64> = (0..count)
            .filter(|k| k % columns == 0)
            .filter_map(|k| texts.iter().find(|it| it.0.ends_with(&format!("panel {k}"))))
            .map(|(_, own)| own[0])
            .collect();
        prop_assert!(titles.iter().all(|it| (it - titles[0]).abs() < 1e-9), "{titles:?}");
    }
}
