//! Pictures as pixels.

use proptest::prelude::*;

use super::*;

fn painted(marks: Vec<Mark>) -> Pixels {
    let mut picture = page(20.0, 10.0);
    picture.marks = marks;
    picture.paint().unwrap()
}

fn color(pixels: &Pixels, x: u32, y: u32) -> [u8; 3] {
    let [red, green, blue, opacity] = pixels.at(x, y).unwrap();
    assert_eq!(opacity, 255);
    [red, green, blue]
}

/// How much of the page is covered, in pixels, when marks are black.
fn covered(marks: Vec<Mark>) -> f64 {
    let pixels = painted(marks);
    let dark = pixels.premultiplied().chunks(4);
    dark.map(|pixel| f64::from(255 - pixel[0]) / 255.0).sum()
}

const BLACK: Color = Color::hex(0);

fn line(points: &[[f64; 2]], width: f64) -> Mark {
    Mark::Path {
        path: Path::polyline(points.iter().copied()),
        fill: None,
        stroke: Some(Stroke::new(BLACK, width)),
    }
}

fn disk(center: [f64; 2], radius: f64, color: Color) -> Mark {
    Mark::Disk {
        center,
        radius,
        fill: Some(Paint::Flat(color)),
        stroke: None,
    }
}

#[test]
fn areas_have_their_colour_and_nothing_else() {
    let square = Path::rectangle([2.0, 3.0], [4.0, 5.0]);
    let pixels = painted(vec![filled(square, Paint::Flat(RED.opacity(0.5)))]);
    assert_eq!([pixels.width(), pixels.height()], [20, 10]);
    for x in 0..20 {
        for y in 0..10 {
            let inside = (2..6).contains(&x) && (3..8).contains(&y);
            let expected = if inside { [255, 127, 127] } else { [255; 3] };
            assert_eq!(color(&pixels, x, y), expected, "{x} {y}");
        }
    }
    assert_eq!(pixels.at(20, 0), None);
}

#[test]
fn disks_have_their_area_at_every_size() {
    for radius in [0.1, 0.4, 0.5, 0.6, 1.0, 2.3, 4.0] {
        for shift in [0.0, 0.25, 0.5, 0.8] {
            let area = covered(vec![disk([10.0 + shift, 5.0 - shift / 2.0], radius, BLACK)]);
            let exact = std::f64::consts::PI * radius * radius;
            let error = (area - exact).abs();
            // Where few pixels are touched, it matters which.
            let allowed = match radius {
                ..1.5 => 0.25 * exact,
                _ => 0.03 * exact,
            };
            assert!(error < allowed, "radius {radius}: {area}, not {exact}");
        }
    }
}

#[test]
fn a_circle_is_a_ring() {
    let mark = |width| Mark::Disk {
        center: [10.0, 5.0],
        radius: 4.0,
        fill: None,
        stroke: Some(Stroke::new(BLACK, width)),
    };
    for width in [0.5, 1.0, 2.0] {
        let area = covered(vec![mark(width)]);
        let exact = 2.0 * std::f64::consts::PI * 4.0 * width;
        assert!((area / exact - 1.0).abs() < 0.05, "{area}, not {exact}");
        assert_eq!(color(&painted(vec![mark(width)]), 10, 5), [255; 3]);
    }
    // Wider than its radius, it has no hole.
    assert_eq!(color(&painted(vec![mark(9.0)]), 9, 4), [0; 3]);
}

#[test]
fn lines_have_their_width_and_round_ends() {
    for (from, to) in [([4.0, 5.0], [16.0, 5.0]), ([5.0, 2.2], [15.0, 7.9])] {
        for width in [0.3, 1.0, 1.5, 3.0] {
            let (along, down): (f64, f64) = (to[0] - from[0], to[1] - from[1]);
            let half: f64 = width / 2.0;
            // A thin line has the ends of one that is one pixel wide.
            let ends = std::f64::consts::PI * half * half.max(0.5);
            let exact = along.hypot(down) * width + ends;
            let area = covered(vec![line(&[from, to], width)]);
            assert!((area / exact - 1.0).abs() < 0.06, "{area}, not {exact}");
        }
    }
}

#[test]
fn a_line_covers_no_pixel_twice() {
    let mark = |points: &[[f64; 2]]| Mark::Path {
        path: Path::polyline(points.iter().copied()),
        fill: None,
        stroke: Some(Stroke::new(BLACK.opacity(0.5), 2.0)),
    };
    let there = mark(&[[3.0, 5.0], [10.0, 5.0], [15.0, 5.0]]);
    let and_back = mark(&[[3.0, 5.0], [15.0, 5.0], [3.0, 5.0]]);
    assert_eq!(painted(vec![there.clone()]), painted(vec![and_back]));
    assert_eq!(color(&painted(vec![there]), 10, 4), [127; 3]);
}

#[test]
fn a_point_is_a_dot_and_a_closed_line_closes() {
    assert!(covered(vec![line(&[[9.5, 4.5]], 3.0)]) > 5.0);
    let path = Path::rectangle([3.5, 2.5], [10.0, 5.0]);
    let stroke = Some(Stroke::new(BLACK, 1.0));
    let pixels = painted(vec![Mark::Path {
        path,
        fill: Some(Paint::Flat(RED)),
        stroke,
    }]);
    for (x, y) in [(3, 5), (8, 2), (13, 5), (8, 7)] {
        assert_eq!(color(&pixels, x, y), [0; 3], "{x} {y}");
    }
    assert_eq!(color(&pixels, 8, 5), [255, 0, 0]);
}

#[test]
fn dashes_leave_gaps() {
    for radius in [None, Some(4.0)] {
        let (solid, dashed) = (
            Stroke::new(BLACK, 1.0),
            Stroke::dashed(BLACK, 1.0, 2.0, 4.0),
        );
        let mark = |stroke| match radius {
            Some(radius) => Mark::Disk {
                center: [10.0, 5.0],
                radius,
                fill: None,
                stroke: Some(stroke),
            },
            None => Mark::Path {
                path: Path::polyline([[1.0, 5.0], [19.0, 5.0]]),
                fill: None,
                stroke: Some(stroke),
            },
        };
        let share = covered(vec![mark(dashed)]) / covered(vec![mark(solid)]);
        assert!((0.3..0.6).contains(&share), "{share}");
    }
}

#[test]
fn gradients_go_from_the_inner_to_the_outer_colour() {
    let area = Path::rectangle([0.0, 0.0], [20.0, 10.0]);
    let shine = Mark::Disk {
        center: [10.5, 5.5],
        radius: 30.0,
        fill: Some(glow([10.5, 5.5], 8.0)),
        stroke: None,
    };
    for mark in [filled(area, glow([10.5, 5.5], 8.0)), shine] {
        let pixels = painted(vec![mark]);
        let [red, _, blue] = color(&pixels, 10, 5);
        assert!(red > 250 && blue < 5);
        let [red, _, blue] = color(&pixels, 14, 5);
        assert!(
            red.abs_diff(127) < 6 && blue.abs_diff(127) < 6,
            "{red} {blue}"
        );
        assert_eq!(color(&pixels, 0, 5), [0, 0, 255]);
    }
}

#[test]
fn text_is_as_wide_as_it_says_and_stands_where_it_should() {
    let ink = |label: Label| {
        let pixels = painted(vec![Mark::Label(label)]);
        let dark = |x: &u32| (0..10).any(|y| color(&pixels, *x, y)[0] < 200);
        let columns: Vec<u32> = (0..20).filter(dark).collect();
        (columns[0], columns[columns.len() - 1])
    };
    let label = Label::new("HH", [10.0, 9.0], 8.0, BLACK);
    let width = text::width("HH", 8.0, false);
    assert!((11.0..13.0).contains(&width), "{width}");
    assert_eq!(ink(label.clone().anchor(Anchor::Middle)), (4, 15));
    let (first, last) = ink(Label::new("HH", [1.0, 9.0], 8.0, BLACK));
    assert_eq!((first, last), (1, 12));
    let bold = covered(vec![Mark::Label(label.clone().bold())]);
    let thin = covered(vec![Mark::Label(label.clone())]);
    assert!(bold > 1.3 * thin && thin > 10.0, "{bold} {thin}");
    // Upwards, it is as narrow as its letters are high.
    let (first, last) = ink(label.upwards().anchor(Anchor::Start));
    assert!(first >= 3 && last < 10, "{first} {last}");
}

#[test]
fn groups_hide_what_is_outside_and_move_what_is_inside() {
    let group = |corner, marks| Mark::Group {
        corner,
        size: [6.0, 4.0],
        background: Some(BLUE.opacity(0.5)),
        marks,
    };
    let inner = group([3.0, 2.0], vec![disk([0.0, 0.0], 90.0, RED)]);
    let pixels = painted(vec![group([4.0, 3.0], vec![inner])]);
    for x in 0..20 {
        for y in 0..10 {
            let expected = if (7..10).contains(&x) && (5..7).contains(&y) {
                [255, 0, 0]
            } else if (4..10).contains(&x) && (3..7).contains(&y) {
                [127, 127, 255]
            } else {
                [255; 3]
            };
            assert_eq!(color(&pixels, x, y), expected, "{x} {y}");
        }
    }
}

#[test]
fn a_picture_over_a_base_is_both_at_once() {
    let (mut below, mut above, mut both) = (page(20.0, 10.0), page(20.0, 10.0), page(20.0, 10.0));
    let (first, second) = (
        disk([8.0, 5.0], 4.0, RED),
        line(&[[1.0, 1.0], [19.0, 8.0]], 1.5),
    );
    below.add(first.clone());
    above.add(second.clone());
    both.marks = vec![first, second];
    let base = below.paint().unwrap();
    assert_eq!(above.paint_over(&base).unwrap(), both.paint().unwrap());
    let message = page(20.0, 11.0).paint_over(&base).unwrap_err().to_string();
    assert!(
        message.contains("20 × 11") && message.contains("20 × 10"),
        "{message}"
    );
}

#[test]
fn sizes_that_cannot_be_are_refused() {
    for size in [
        [0.4, 9.0],
        [9.0, -1.0],
        [f64::NAN, 9.0],
        [9.0, 16_385.0],
        [f64::INFINITY; 2],
    ] {
        let picture = Picture::new(size, WHITE, "");
        let message = picture.paint().unwrap_err().to_string();
        assert!(message.contains("1 to 16384 pixels"), "{message}");
        // SVG has no pixels to run out of.
        picture.svg();
    }
}

#[test]
fn what_cannot_be_seen_is_not_painted() {
    assert_eq!(
        painted(super::svg::unseen()),
        page(20.0, 10.0).paint().unwrap()
    );
}

#[test]
fn png_holds_the_pixels() {
    for background in [WHITE, WHITE.opacity(0.0)] {
        let mut picture = page(20.0, 10.0);
        picture.background = background;
        picture.add(disk([8.0, 5.0], 3.0, RED));
        let pixels = picture.paint().unwrap();
        let file = pixels.png().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(file))
            .read_info()
            .unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        let bytes = info.color_type.samples();
        assert_eq!(bytes, if background == WHITE { 3 } else { 4 });
        for (k, pixel) in data.chunks(bytes).enumerate() {
            let expected = pixels.at(k as u32 % 20, k as u32 / 20).unwrap();
            assert_eq!(pixel, &expected[..bytes]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever numbers come, pictures are made of them, and the same twice.
    #[test]
    fn no_number_makes_it_panic(
        numbers in prop::collection::vec(
            prop_oneof![
                any::<f64>(),
                -30.0..30.0,
                (-9.0..9.0f64).prop_map(|x| 10f64.powf(x)),
                (-9.0..9.0f64).prop_map(|x| -(10f64.powf(x))),
            ],
            16,
        ),
    ) {
        let n = |k: usize| numbers[k];
        let mut path = Path::polyline([[n(0), n(1)], [n(2), n(3)], [n(4), n(5)]]);
        let mut picture = page(20.0, 10.0);
        let stroke = Stroke { color: RED.opacity(n(6)), width: n(7), dashes: vec![] };
        picture.stroke(path.clone(), stroke.clone());
        let dashes = vec![n(8).max(0.01), n(9).max(0.01)];
        picture.stroke(path.clone(), Stroke { dashes, ..stroke.clone() });
        path.cubic([n(6), n(7)], [n(8), n(9)], [n(10), n(11)]);
        path.close();
        picture.add(Mark::Path {
            path,
            fill: Some(glow([n(12), n(13)], n(14))),
            stroke: Some(stroke.clone()),
        });
        picture.add(Mark::Disk {
            center: [n(12), n(13)],
            radius: n(14),
            fill: Some(glow([n(1), n(2)], n(3))),
            stroke: Some(stroke),
        });
        picture.label(Label::new("text", [n(0), n(15)], n(1), RED));
        let marks = picture.marks.clone();
        picture.add(Mark::Group {
            corner: [n(4), n(15)],
            size: [n(3), n(5)],
            background: Some(BLUE.opacity(n(11))),
            marks,
        });
        prop_assert_eq!(picture.paint().unwrap(), picture.paint().unwrap());
        prop_assert!(!picture.svg().contains("NaN"));
    }
}
