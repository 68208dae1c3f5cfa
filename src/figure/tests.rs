use std::collections::BTreeSet;

use super::djokam_rathinam::{Differences, Start, slopes};
use super::olfati_saber_2003::{crossing, curve, pair_of};
use super::shi_wang_chu::Relations;
use super::*;
use crate::math::{Action, Bump, Fade};
use crate::picture::Mark;

/// What a picture says, in all of its labels.
fn words(marks: &[Mark]) -> String {
    let say = |mark: &Mark| match mark {
        Mark::Label(label) => label.text.clone() + "\n",
        Mark::Group { marks, .. } => words(marks),
        _ => String::new(),
    };
    marks.iter().map(say).collect()
}

fn entry(id: &str) -> Entry {
    let mut all = catalogue().into_iter();
    all.find(|entry| entry.id == id)
        .expect("the catalogue has it")
}

#[test]
fn the_catalogue_has_all_figures_once_and_their_worlds_are_sound() {
    let all = catalogue();
    let ids: BTreeSet<&str> = all.iter().map(|entry| entry.id).collect();
    assert_eq!(ids.len(), all.len());
    let mut named: BTreeSet<String> = BTreeSet::new();
    for (paper, numbers) in [
        ("djokam-rathinam", "3 4 5 6 7 8-printed 8-corrected"),
        ("song-2013", "1 2"),
        ("li-liu-wu", "1 2 3 4"),
        ("olfati-saber-2003", "2 4 5 7 8 9"),
        ("shi-wang-chu", "1 2 3 4 5 6 7"),
    ] {
        named.extend(numbers.split(' ').map(|number| format!("{paper}-{number}")));
    }
    assert!(ids.iter().copied().eq(named.iter().map(String::as_str)));
    for wanted in wanted(&all) {
        let world = wanted.load().expect("the world is sound");
        assert!(world.steps() > 0);
    }
    // Each figure of a paper is either made or said not to be.
    let sources: BTreeSet<&str> = all.iter().map(|entry| entry.source).collect();
    assert_eq!(sources.len(), all.len());
    let not_made = sketches(ids.iter().copied());
    assert_eq!(not_made.len(), 5);
    let is_made = |it: &Sketch| sources.contains(it.source) || ids.contains(it.id);
    assert!(!not_made.iter().any(is_made));
    let of = |id| sketches([id]).iter().map(|it| it.id).collect::<Vec<_>>();
    let of_djokam = ["djokam-rathinam-1", "djokam-rathinam-2"];
    assert_eq!(of("djokam-rathinam-8-printed"), of_djokam);
    assert_eq!(of("song-2013-1"), [""; 0]);
}

#[test]
fn runs_are_shared() {
    let of_ideal: Vec<Entry> = (1..=6)
        .map(|k| entry(&format!("shi-wang-chu-{k}")))
        .collect();
    assert_eq!(wanted(&of_ideal).len(), 1);
    assert_eq!(steps(&of_ideal), steps(&of_ideal[..1]));
}

#[test]
fn the_functions_are_those_of_the_paper_at_known_points() {
    // c = 2/√5 for a = 1, b = 5; ψ and φ as (29) has them.
    let c = 2.0 / 5f64.sqrt();
    let force = |z: f64| 3.0 * (z + c) / (1.0 + (z + c).powi(2)).sqrt() - 2.0;
    let potential =
        |z: f64| 3.0 * ((1.0 + (z + c).powi(2)).sqrt() - (1.0 + c * c).sqrt()) - 2.0 * z;
    let action = Action::new(1.0, 5.0);
    for [z, value] in curve([-10.0, 10.0], |z| action.force(z)) {
        assert!((value - force(z)).abs() < 1e-14, "at {z}");
    }
    let psi = curve([-10.0, 10.0], |z| action.potential(z));
    assert!(
        psi.iter()
            .all(|[z, value]| (value - potential(*z)).abs() < 1e-13)
    );
    assert_eq!(lowest(psi), [0.0, 0.0]);
    assert!(crossing(&curve([-3.0, 4.0], force), 0.0).abs() < 1e-5);

    let bump = Bump::new(5.0 / 6.0);
    let sharp = pair_of(Fade::Sharp);
    let smooth = pair_of(Fade::Smooth(bump));
    // η = −2, 0 and just below 2, where d = 8, 10 and 12.
    assert!((sharp.potential(8.0) - potential(-2.0)).abs() < 1e-14);
    assert!((smooth.potential(8.0) - potential(-2.0)).abs() < 1e-14);
    assert_eq!([sharp.potential(10.0), smooth.potential(10.0)], [0.0; 2]);
    assert!((sharp.potential(12.0) - potential(2.0)).abs() < 1e-14);
    assert!(smooth.potential(12.0 - 1e-9) < 1e-15);
}

#[test]
fn a_curve_is_crossed_between_its_points() {
    let line = [[0.0, 1.0], [1.0, 0.0], [2.0, -3.0]];
    assert_eq!(crossing(&line, 0.25), 0.75);
    assert_eq!(crossing(&line, -1.5), 1.5);
    assert!(crossing(&line, 2.0).is_nan());
}

#[test]
fn figures_of_functions_say_what_is_measured() {
    let ids = [
        "olfati-saber-2003-2",
        "olfati-saber-2003-4",
        "olfati-saber-2003-5",
    ];
    let entries = ids.map(entry);
    let made = make(&entries, &Theme::LIGHT, &|| panic!("nothing runs")).expect("they are made");
    // ρ′ is least, −π/(2(1 − k₀)r) = −π/4; ψ(2) as above.
    for (figure, says) in made.iter().zip([
        ["z = 10", "½ at 11", "-0.785"],
        ["z = 0", "-4.98", "0.987"],
        ["η = 2", "h₀ = 1.16", "0.201"],
    ]) {
        for says in says {
            assert!(figure.finding.contains(says), "{says}: {}", figure.finding);
        }
        let words = words(&figure.picture.marks);
        assert!(words.contains("(a)") && words.contains("(b)"), "{words}");
    }
    let dark = make(&entries, &Theme::DARK, &|| ()).expect("they are made");
    assert_eq!(dark[0].finding, made[0].finding);
    assert_eq!(dark[0].picture.background, Theme::DARK.page);
}

/// The three of the family, for a short time.
fn short(world: &'static str) -> Course {
    let settings = &["time.end=3", "record.every=0.5"];
    Wanted::points(world, settings)
        .run(&|| ())
        .expect("it runs")
}

#[test]
fn the_corrected_start_leaves_errors_of_order_epsilon_and_the_printed_one_does_not() {
    let courses = ["0.1", "0.01", "0.001"].map(|epsilon| match epsilon {
        "0.1" => short("djokam-rathinam/fast-0.1"),
        "0.01" => short("djokam-rathinam/fast-0.01"),
        _ => short("djokam-rathinam/fast-0.001"),
    });
    let family = |start| {
        let members = courses.iter().map(|course| Differences::of(course, start));
        members
            .collect::<Result<Vec<_>, _>>()
            .expect("there is a leading order")
    };
    let (printed, corrected) = (family(Start::Printed), family(Start::Limit));
    for which in [1, 2] {
        for slope in slopes(&corrected, which, 1.0) {
            assert!((slope - 1.0).abs() < 0.05, "{slope}");
        }
        let last = slopes(&printed, which, 1.0)[1];
        assert!(last < 0.1, "{last}");
        assert!(printed[2].largest(which, 1.0) > 20.0 * corrected[2].largest(which, 1.0));
    }
    assert_eq!(courses[0].times(), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]);
}

#[test]
fn frames_are_found_by_time() {
    let course = short("djokam-rathinam/fast-0.1");
    for (time, found) in [(-1.0, 0.0), (0.7, 0.5), (1.5, 1.5), (1e9, 3.0)] {
        assert_eq!(course.at(time).time, found);
        assert_eq!(course.until(time).last().map(|it| it.time), Some(found));
    }
    assert_eq!((course.first().time, course.last().time), (0.0, 3.0));
}

#[test]
fn a_figure_of_a_run_says_what_the_run_did() {
    let wanted = Wanted::bodies(
        "song-2013/example-18",
        &["time.end=0.5", "record.every=0.02", "record.laws=true"],
    );
    let course = wanted.run(&|| ()).expect("it runs");
    let claim = "song-2013/theorem-10-distance-sharpened";
    let (finding, picture) =
        song_2013::draw(&course, claim, 0.3, &Theme::LIGHT).expect("it is drawn");
    // d(0) and √(ln(Q/W(0))/μ), as the world and the paper have them.
    for says in [
        "d(t) is 1.66 at the start",
        "W(0), 131.5835.",
        "above 0.144",
        "t = 0.3 of 0.5",
        "nowhere",
    ] {
        assert!(finding.contains(says), "{says}: {finding}");
    }
    let words = words(&picture.marks);
    assert!(words.contains("kept by theory: 0.144"), "{words}");
    assert!(song_2013::draw(&course, "no such claim", 0.3, &Theme::LIGHT).is_err());
}

#[test]
fn relations_are_the_arcs_of_the_world() {
    let wanted = entry("shi-wang-chu-1").wanted[0];
    let world = wanted.load().expect("the world is sound");
    let relations = Relations::of(&world).expect("it has a graph");
    // The world draws 24 arcs.
    assert_eq!(2 * relations.mutual.len() + relations.one_way.len(), 24);
    let back = |[i, j]: [usize; 2]| relations.one_way.contains(&[j, i]);
    assert!(!relations.one_way.iter().any(|pair| back(*pair)));
}

#[test]
fn pages_show_each_figure_with_its_two_lines() {
    let figure = Figure {
        id: "paper-1",
        source: "A & B, Figure 1",
        caption: "x < y",
        finding: "x is 0.5, y is *1*".to_owned(),
        picture: Picture::new([1.0, 1.0], Theme::LIGHT.page, "one"),
    };
    let shown = [(&figure, "paper-1.svg".to_owned())];
    let page = html(&shown, &sketches(["djokam-rathinam-3"]), &Theme::DARK);
    for says in [
        "<img src=\"paper-1.svg\" alt=\"A &amp; B, Figure 1\"",
        "background: #14181d; color: #e6e9ed",
        "A &amp; B, Figure 1",
        "<b>Paper:</b> x &lt; y",
        "<b>Ours:</b> x is 0.5, y is *1*",
        "Djokam &amp; Rathinam, Figure 2",
    ] {
        assert!(page.contains(says), "{says}: {page}");
    }
    let page = markdown(&shown, &[]);
    for says in [
        "## A & B, Figure 1\n\n![A & B, Figure 1](paper-1.svg)",
        "- Paper: x &lt; y",
        "- Ours: x is 0.5, y is \\*1\\*",
    ] {
        assert!(page.contains(says), "{says}: {page}");
    }
    assert!(!page.contains("Sketches"));
}
