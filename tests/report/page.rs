//! The HTML page: well formed, whole, and with a plot for everything that was measured.

use std::collections::BTreeSet;

use volary::claim::{Side, Verdict};
use volary::validate::form::html;
use volary::validate::report::Report;

use crate::sample::{claim, curve, finding, full, judged, report, single, times};

/// An element as it was opened: its name, and its attributes.
#[derive(Debug)]
struct Opened {
    name: String,
    attributes: Vec<(String, String)>,
}

impl Opened {
    fn attribute(&self, name: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(own, _)| own == name);
        found.map(|(_, value)| value.as_str())
    }
}

/// The elements of a page, which must be balanced, with quoted attributes and known entities.
fn elements(page: &str) -> Vec<Opened> {
    let mut rest = page
        .strip_prefix("<!DOCTYPE html>")
        .expect("a document type");
    let (mut open, mut all): (Vec<String>, Vec<Opened>) = (Vec::new(), Vec::new());
    while let Some((text, behind)) = rest.split_once('<') {
        assert_entities(text);
        let (tag, behind) = behind.split_once('>').expect("every tag ends");
        rest = behind;
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name), "in {open:?}");
            continue;
        }
        let (tag, closed) = match tag.strip_suffix('/') {
            Some(tag) => (tag, true),
            None => (tag, false),
        };
        let (name, mut attributes) = tag.split_once(' ').unwrap_or((tag, ""));
        let mut found = Vec::new();
        while !attributes.is_empty() {
            let (key, value) = attributes.split_once("=\"").expect("a quoted value");
            let (value, behind) = value.split_once('"').expect("a quote that ends");
            assert_entities(value);
            found.push((key.to_owned(), value.to_owned()));
            attributes = behind.trim_start();
        }
        let plain = |text: &str| text.chars().all(|c| c.is_ascii_alphanumeric() || c == '-');
        assert!(
            plain(name) && found.iter().all(|(key, _)| plain(key)),
            "{tag}"
        );
        if !closed {
            open.push(name.to_owned());
        }
        all.push(Opened {
            name: name.to_owned(),
            attributes: found,
        });
    }
    assert!(
        open.is_empty() && rest.trim().is_empty(),
        "{open:?}, {rest}"
    );
    all
}

fn assert_entities(text: &str) {
    assert!(!text.contains('>'), "{text}");
    for part in text.split('&').skip(1) {
        let known = ["lt;", "gt;", "amp;", "quot;", "#39;"];
        assert!(known.iter().any(|it| part.starts_with(it)), "&{part}");
    }
    let control = |c: char| c.is_control() && c != '\n';
    assert!(!text.contains(control), "{text:?}");
}

fn count(page: &str, name: &str) -> usize {
    elements(page).iter().filter(|it| it.name == name).count()
}

#[test]
fn the_page_is_well_formed_and_needs_nothing_else() {
    for report in [full(), single(), report(Vec::new())] {
        let page = html(&report);
        let elements = elements(&page);
        let ids: Vec<&str> = elements
            .iter()
            .filter_map(|it| it.attribute("id"))
            .collect();
        let known: BTreeSet<&str> = ids.iter().copied().collect();
        assert_eq!(ids.len(), known.len(), "every id is there once");
        for element in &elements {
            assert!(!["script", "link", "img", "iframe"].contains(&element.name.as_str()));
            assert_eq!(element.attribute("src"), None);
            let link = element.attribute("href");
            assert!(link.is_none_or(|it| known.contains(it.trim_start_matches('#'))));
            let labels = element.attribute("aria-labelledby").unwrap_or_default();
            assert!(labels.split_whitespace().all(|it| known.contains(it)));
        }
        for word in ["http", "url(", "@import", "&\"it"] {
            assert!(!page.contains(word), "{word}");
        }
    }
}

#[test]
fn every_curve_is_plotted_and_described() {
    let page = html(&single());
    // Energy, distance, spread and envelope, and the departure.
    assert_eq!(count(&page, "figure"), 5);
    assert_eq!(count(&page, "desc"), 5);
    for says in [
        "As points: 13.5 at time 0",
        "It must be at most its bound, 13.6.",
        "It must be at least its bound, 0.31.",
        "For comparison, body diameter: 1.",
        "At time 21.5: first contact.",
        ">body diameter 1</text>",
        "W(0)",
        "infinite",
        "no other forces act",
    ] {
        assert!(page.contains(says), "{says}");
    }
    // Two bounds of the energy, which differ; one each of distance and envelope.
    let elements = elements(&page);
    let of_class = |class: &str| {
        let lines = elements.iter().filter(|it| it.name == "polyline");
        lines
            .filter(|it| it.attribute("class") == Some(class))
            .count()
    };
    assert_eq!([of_class("bound points"), of_class("bound bodies")], [1, 1]);
    assert_eq!(of_class("bound"), 2);
    assert_eq!([of_class("line points"), of_class("line bodies")], [4, 4]);
    let areas = elements.iter().filter(|it| it.name == "polygon");
    assert_eq!(areas.count(), 4);
}

#[test]
fn what_is_striking_is_open() {
    let page = html(&full());
    let elements = elements(&page);
    let details = elements.iter().filter(|it| it.name == "details");
    let open: Vec<bool> = details.map(|it| it.attribute("open").is_some()).collect();
    // The last two: claims that say nothing of the second world, and the one there is.
    assert_eq!(open, [true, false, false, false, true, true, false, false]);
}

/// A report of one claim with one curve.
fn of_curve(value: impl Fn(f64) -> f64, bound: impl Fn(f64) -> f64) -> Report {
    let mut found = finding(Verdict::Holds, 0.1, "f stays at most its bound");
    found.curves = vec![curve("f", &times(1.0), value, bound, Side::Below)];
    let run = judged(volary::world::spec::DynamicsName::Points, None, found);
    let mut report = single();
    let world = &mut report.worlds[0];
    world.contact = None;
    world.claims = vec![claim(
        "song-2013/lemma-9",
        volary::claim::Reading::Printed,
        vec![run],
    )];
    report
}

#[test]
fn plots_take_whatever_comes() {
    let none = |_: f64| f64::NAN;
    type Case = (&'static str, fn(f64) -> f64, usize);
    let values: [Case; 8] = [
        ("zero", |_| 0.0, 1),
        ("never a number", |_| f64::NAN, 0),
        (
            "once a number",
            |t| if t == 0.0 { 1.0 } else { f64::NAN },
            0,
        ),
        (
            "with a hole",
            |t| if t > 0.3 && t < 0.6 { f64::NAN } else { t },
            1,
        ),
        ("huge", |t| 1e308 * (t - 0.5), 1),
        ("tiny", |t| 1e-308 * (t - 0.5), 1),
        ("all but constant", |t| 1.0 + 1e-16 * t, 1),
        ("deep", |t| (-2000.0 * t).exp(), 1),
    ];
    for (what, value, figures) in values {
        let page = html(&of_curve(value, none));
        assert_eq!(count(&page, "figure"), figures, "{what}");
        let page = html(&of_curve(value, |t| t - 0.5));
        assert_eq!(count(&page, "figure"), figures, "{what}");
        for bad in ["NaN", "inf,", ",inf", "\"inf"] {
            assert!(!page.contains(bad), "{what}: {bad}");
        }
    }
    let mut empty = of_curve(none, none);
    let curve = &mut empty.worlds[0].claims[0].findings[0].finding.curves[0];
    (curve.times, curve.values) = (Vec::new(), Vec::new());
    assert_eq!(count(&html(&empty), "figure"), 0);
}
