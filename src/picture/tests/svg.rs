//! Pictures as SVG.

use super::*;

/// What stands in the document of a picture with these marks, without its frame.
fn body(marks: Vec<Mark>) -> String {
    let mut picture = page(20.0, 10.0);
    picture.marks = marks;
    let svg = picture.svg();
    let frame = "</title>";
    let start = svg.find(frame).unwrap() + frame.len();
    let body = svg[start..].strip_suffix("</svg>\n").unwrap();
    body.replace(r##"<rect width="20" height="10" fill="#ffffff"/>"##, "")
}

fn line(text: &str) -> Label {
    Label::new(text, [1.0, 2.0], 9.0, RED)
}

#[test]
fn the_frame_is_a_whole_document() {
    let mut picture = Picture::new([20.5, 10.0], WHITE.opacity(0.5), "a < b & \"c\"\u{1}");
    assert_eq!(
        picture.svg(),
        concat!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" role="img" width="20.5" height="10" "#,
            r#"viewBox="0 0 20.5 10" font-family="DejaVu Sans, Verdana, sans-serif" fill="none" "#,
            r#"stroke-linecap="round" stroke-linejoin="round">"#,
            "<title>a &lt; b &amp; \"c\"\u{fffd}</title>",
            r##"<rect width="20.5" height="10" fill="#ffffff" fill-opacity="0.5"/></svg>"##,
            "\n"
        )
    );
    picture.background = WHITE.opacity(0.0);
    assert!(!picture.svg().contains("<rect"));
}

#[test]
fn marks_are_elements() {
    let mut path = Path::polyline([[0.0, 1.0], [2.5, 3.126], [4.0, -0.001]]);
    path.cubic([1.0, 1.0], [2.0, 2.0], [3.0, 3.0]);
    path.close();
    path.begin([7.0, 7.0]);
    path.line([8.0, 8.0]);
    let disk = |fill, stroke| Mark::Disk {
        center: [5.0, 6.0],
        radius: 2.0,
        fill,
        stroke,
    };
    for (mark, expected) in [
        (
            Mark::Path {
                path,
                fill: Some(Paint::Flat(RED.opacity(0.25))),
                stroke: Some(Stroke::new(BLUE, 1.0)),
            },
            concat!(
                r##"<path d="M0 1L2.5 3.13 4 0C1 1 2 2 3 3ZM7 7L8 8" fill="#ff0000" "##,
                r##"fill-opacity="0.25" stroke="#0000ff"/>"##
            ),
        ),
        (
            disk(None, Some(Stroke::dashed(BLUE.opacity(0.5), 1.5, 4.0, 2.0))),
            concat!(
                r##"<circle cx="5" cy="6" r="2" stroke="#0000ff" stroke-opacity="0.5" "##,
                r##"stroke-width="1.5" stroke-dasharray="4 2"/>"##
            ),
        ),
        (
            disk(Some(Paint::Flat(RED)), None),
            r##"<circle cx="5" cy="6" r="2" fill="#ff0000"/>"##,
        ),
        (
            Mark::Label(line("1 < 2 & ε")),
            r##"<text x="1" y="2" font-size="9" fill="#ff0000">1 &lt; 2 &amp; ε</text>"##,
        ),
        (
            Mark::Label(line("up").anchor(Anchor::Middle).bold().upwards()),
            concat!(
                r##"<text x="1" y="2" font-size="9" fill="#ff0000" text-anchor="middle" "##,
                r##"font-weight="bold" transform="rotate(-90 1 2)">up</text>"##
            ),
        ),
        (
            Mark::Group {
                corner: [3.0, 4.0],
                size: [5.0, 6.0],
                background: Some(BLUE),
                marks: vec![Mark::Label(line("in").anchor(Anchor::End))],
            },
            concat!(
                r##"<svg x="3" y="4" width="5" height="6">"##,
                r##"<rect width="5" height="6" fill="#0000ff"/>"##,
                r##"<text x="1" y="2" font-size="9" fill="#ff0000" text-anchor="end">in</text>"##,
                "</svg>"
            ),
        ),
    ] {
        assert_eq!(body(vec![mark]), expected);
    }
}

#[test]
fn disks_that_look_the_same_share_a_gradient() {
    let disk = |x: f64, radius: f64| Mark::Disk {
        center: [x, 5.0],
        radius,
        fill: Some(glow([x - radius / 2.0, 5.0], radius)),
        stroke: None,
    };
    let area = filled(
        Path::rectangle([0.0, 0.0], [9.0, 9.0]),
        glow([1.0, 2.0], 3.0),
    );
    let shade = "ff0000_1_0000ff_1";
    let stops = concat!(
        r##"<stop stop-color="#ff0000"/><stop offset="1" stop-color="#0000ff"/>"##,
        "</radialGradient>"
    );
    assert_eq!(
        body(vec![disk(5.0, 2.0), disk(9.0, 4.0), area]),
        [
            "<defs>".to_owned(),
            format!(
                r#"<radialGradient id="disk_0.25_0.5_0.5_{shade}" cx="0.25" cy="0.5" r="0.5">"#
            ),
            stops.to_owned(),
            format!(r#"<radialGradient id="page_1_2_3_{shade}" cx="1" cy="2" r="3" "#),
            r#"gradientUnits="userSpaceOnUse">"#.to_owned(),
            stops.to_owned(),
            "</defs>".to_owned(),
            format!(r#"<circle cx="5" cy="5" r="2" fill="url(#disk_0.25_0.5_0.5_{shade})"/>"#),
            format!(r#"<circle cx="9" cy="5" r="4" fill="url(#disk_0.25_0.5_0.5_{shade})"/>"#),
            format!(r#"<path d="M0 0L9 0 9 9 0 9Z" fill="url(#page_1_2_3_{shade})"/>"#),
        ]
        .concat()
    );
}

/// Marks that leave nothing to see, or are nowhere.
pub(super) fn unseen() -> Vec<Mark> {
    let none = |path| filled(path, Paint::Flat(RED));
    let disk = |center, radius, color| Mark::Disk {
        center,
        radius,
        fill: Some(Paint::Flat(color)),
        stroke: Some(Stroke::new(color, 0.0)),
    };
    vec![
        none(Path::new()),
        none(Path::polyline([[0.0, 0.0], [f64::NAN, 9.0], [9.0, 9.0]])),
        none(Path::polygon([
            [0.0, 0.0],
            [f64::INFINITY, 9.0],
            [0.0, 9.0],
        ])),
        filled(
            Path::rectangle([0.0; 2], [9.0; 2]),
            glow([f64::NAN, 0.0], 1.0),
        ),
        disk([5.0, 5.0], 2.0, RED.opacity(0.0)),
        disk([5.0, 5.0], 2.0, RED.opacity(f64::NAN)),
        disk([5.0, 5.0], 0.0, RED),
        disk([5.0, 5.0], -2.0, RED),
        disk([5.0, 5.0], f64::NAN, RED),
        disk([f64::NEG_INFINITY, 5.0], 2.0, RED),
        Mark::Label(line("  ")),
        Mark::Label(Label {
            size: f64::INFINITY,
            ..line("text")
        }),
        Mark::Group {
            corner: [f64::NAN, 0.0],
            size: [9.0, 9.0],
            background: Some(RED),
            marks: Vec::new(),
        },
    ]
}

#[test]
fn what_cannot_be_seen_is_left_out() {
    assert_eq!(body(unseen()), "");
}

#[test]
fn far_places_are_cut_off() {
    let far = body(vec![Mark::Path {
        path: Path::polyline([[0.0, 0.0], [1e300, -1e7]]),
        fill: None,
        stroke: Some(Stroke::new(RED, 1.0)),
    }]);
    assert_eq!(
        far,
        r##"<path d="M0 0L1000000 -1000000" stroke="#ff0000"/>"##
    );
}
