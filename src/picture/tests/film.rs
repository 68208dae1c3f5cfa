//! Films, read back from their files.

use std::fs::{self, File};
use std::path::Path as FilePath;

use proptest::prelude::*;

use super::*;

/// Colours that no palette confuses.
const COLORS: [u32; 6] = [0xffffff, 0x0072b2, 0xd55e00, 0x009e73, 0x000000, 0xf0e442];

/// A picture of 12 × 9 pixels with squares of these colours at these places.
fn frame(squares: &[(u32, u32, usize)]) -> Pixels {
    let mut picture = page(12.0, 9.0);
    for (x, y, color) in squares {
        let corner = [f64::from(*x), f64::from(*y)];
        let color = Color::hex(COLORS[color % COLORS.len()]);
        picture.fill(Path::rectangle(corner, [2.0, 2.0]), color);
    }
    picture.paint().unwrap()
}

/// Frames with a square that wanders, stands still, and is gone.
fn wandering() -> Vec<Pixels> {
    let mut frames: Vec<_> = (0..6).map(|k| frame(&[(k, k / 2, 1), (8, 3, 2)])).collect();
    frames.push(frames[5].clone());
    frames.push(frame(&[]));
    frames
}

fn reel(frames: &[Pixels], rate: f64) -> Reel {
    Reel {
        size: [12, 9],
        frames: frames.len() as u32,
        rate,
    }
}

fn shot(path: &FilePath, frames: &[Pixels], rate: f64) {
    let mut film = Film::create(path, reel(frames, rate), frames, false).unwrap();
    film.shoot(frames, |frame| Ok::<_, PictureError>(frame.clone()))
        .unwrap();
    assert!(!path.exists());
    film.finish().unwrap();
}

/// What is seen: how long, in ticks of the format, and red, green and blue of every pixel.
type Shown = Vec<(u64, Vec<[u8; 3]>)>;

fn rgb(frame: &Pixels) -> Vec<[u8; 3]> {
    let pixels = frame.premultiplied().chunks(4);
    pixels.map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}

/// Paints what a file says over what was there.
fn overlay(shown: &mut [[u8; 3]], [left, top, width]: [usize; 3], rgba: &[u8]) {
    for (k, pixel) in rgba.chunks(4).enumerate() {
        if pixel[3] == 255 {
            shown[(top + k / width) * 12 + left + k % width].copy_from_slice(&pixel[..3]);
        }
    }
}

fn read_gif(path: &FilePath) -> Shown {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(File::open(path).unwrap()).unwrap();
    let (mut canvas, mut shown) = (vec![[0; 3]; 12 * 9], Vec::new());
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let place = [frame.left, frame.top, frame.width].map(usize::from);
        overlay(&mut canvas, place, &frame.buffer);
        shown.push((u64::from(frame.delay), canvas.clone()));
    }
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    shown
}

fn read_apng(path: &FilePath) -> Shown {
    let file = std::io::BufReader::new(File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let control = *reader.info().animation_control().unwrap();
    assert_eq!(control.num_plays, 0);
    let (mut canvas, mut shown) = (vec![[0; 3]; 12 * 9], Vec::new());
    for _ in 0..control.num_frames {
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        let frame = reader.info().frame_control().unwrap();
        let place = [frame.x_offset, frame.y_offset, frame.width].map(|x| x as usize);
        overlay(&mut canvas, place, &data[..info.buffer_size()]);
        assert_eq!(frame.delay_den, 1000);
        shown.push((u64::from(frame.delay_num), canvas.clone()));
    }
    shown
}

fn read(path: &FilePath) -> Shown {
    match FileKind::of(path).unwrap() {
        FileKind::Gif => read_gif(path),
        _ => read_apng(path),
    }
}

#[test]
fn films_show_what_was_put_in() {
    let folder = tempfile::tempdir().unwrap();
    let frames = wandering();
    for name in ["a.gif", "a.apng"] {
        let path = folder.path().join(name);
        shot(&path, &frames, 12.0);
        let shown = read(&path);
        assert_eq!(shown.len(), frames.len());
        for ((_, shown), frame) in shown.iter().zip(&frames) {
            assert_eq!(*shown, rgb(frame), "{name}");
        }
    }
    let count = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(count, 2);
}

#[test]
fn what_does_not_change_costs_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.gif", "a.apng"] {
        let size = |many: usize| {
            let path = folder.path().join(format!("{many}{name}"));
            shot(&path, &vec![wandering()[0].clone(); many], 12.0);
            fs::metadata(path).unwrap().len()
        };
        let each = (size(21) - size(1)) / 20;
        assert!(each < 100, "{name}: {each} bytes");
    }
}

#[test]
fn rounding_does_not_change_how_long_a_film_is() {
    let folder = tempfile::tempdir().unwrap();
    let frames: Vec<_> = (0..30).map(|k| frame(&[(k % 10, 0, 1)])).collect();
    for rate in [7.0, 12.5, 24.0, 29.97, 30.0, 50.0, 60.0, 240.0] {
        for (name, ticks) in [("gif", 100.0), ("apng", 1000.0)] {
            let path = folder.path().join(format!("{rate}.{name}"));
            shot(&path, &frames, rate);
            let shown = read(&path);
            let whole: u64 = shown.iter().map(|(delay, _)| delay).sum();
            let exact = 30.0 / rate * ticks;
            let error = (whole as f64 - exact).abs();
            assert!(error <= 1.5, "{name} at {rate}: {whole}, not {exact}");
            let least = if name == "gif" { 2 } else { 4 };
            assert!(shown.iter().all(|(delay, _)| *delay >= least));
        }
    }
}

#[test]
fn many_colours_become_the_nearest_and_plain_areas_keep_theirs() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gif");
    let shades = |shift: f64| {
        let mut picture = page(12.0, 9.0);
        for k in 0..72 {
            let corner = [f64::from(k % 12), f64::from(k / 12)];
            let share = f64::from(k) / 72.0 + shift;
            picture.fill(Path::rectangle(corner, [1.0; 2]), Ramp::Viridis.at(share));
        }
        picture.paint().unwrap()
    };
    let frames: Vec<_> = (0..20).map(|k| shades(0.0005 * f64::from(k))).collect();
    shot(&path, &frames, 10.0);
    for ((_, shown), frame) in read(&path).iter().zip(&frames) {
        for (k, (shown, exact)) in shown.iter().zip(rgb(frame)).enumerate() {
            let error = (0..3).map(|part| shown[part].abs_diff(exact[part])).max();
            let allowed = if k < 72 { 9 } else { 0 };
            assert!(error.unwrap() <= allowed, "{shown:?} {exact:?}");
        }
    }
}

#[test]
fn without_samples_colours_are_not_far_off() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gif");
    let frames = wandering();
    let mut film = Film::create(&path, reel(&frames, 10.0), &[], false).unwrap();
    for frame in &frames {
        film.add(frame).unwrap();
    }
    film.finish().unwrap();
    for ((_, shown), frame) in read(&path).iter().zip(&frames) {
        let pairs = shown.iter().zip(rgb(frame));
        for (shown, exact) in pairs {
            assert!(
                (0..3).all(|k| shown[k].abs_diff(exact[k]) <= 26),
                "{shown:?} {exact:?}"
            );
        }
    }
}

#[test]
fn what_does_not_cover_is_seen_over_white() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.apng");
    let clear = Picture::new([12.0, 9.0], RED.opacity(0.5), "")
        .paint()
        .unwrap();
    shot(&path, &[clear], 10.0);
    assert_eq!(read(&path)[0].1[0], [255, 127, 127]);
}

#[test]
fn errors_leave_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let frames = wandering();
    let at = |name: &str| folder.path().join(name);
    let create = |name: &str, reel| Film::create(&at(name), reel, &[], false);
    let sound = reel(&frames, 10.0);
    for (name, reel, expected) in [
        (
            "a",
            sound,
            "a: the name of a still ends in .svg or .png, that of a film in .gif",
        ),
        (
            "a.png",
            sound,
            "the name of a film ends in .gif, .apng, .mp4 or .webm",
        ),
        (
            "a.gif",
            Reel { rate: 0.0, ..sound },
            "0 frames a second are out of range",
        ),
        (
            "a.gif",
            Reel {
                rate: f64::NAN,
                ..sound
            },
            "NaN frames a second",
        ),
        ("a.gif", Reel { frames: 0, ..sound }, "at least one frame"),
        (
            "a.gif",
            Reel {
                size: [12, 0],
                ..sound
            },
            "12 × 0 pixels cannot be painted",
        ),
        ("no/a.gif", sound, "no does not exist"),
    ] {
        let message = create(name, reel).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
    for name in ["a.gif", "a.apng"] {
        // Too few, too many, another size, an error on the way, or dropped.
        let mut film = create(name, sound).unwrap();
        film.add(&frames[0]).unwrap();
        let other = page(9.0, 12.0).paint().unwrap();
        let message = film.add(&other).unwrap_err().to_string();
        assert!(message.contains("9 × 12"), "{message}");
        let message = film.finish().unwrap_err().to_string();
        assert!(message.contains("8 frames cannot have 1"), "{message}");
        let mut film = create(name, Reel { frames: 1, ..sound }).unwrap();
        film.add(&frames[0]).unwrap();
        let message = film.add(&frames[0]).unwrap_err().to_string();
        assert!(message.contains("1 frames cannot have 2"), "{message}");
        drop(film);
        let mut film = create(name, sound).unwrap();
        let broken = film.shoot(0..8, |k| match k {
            3 | 5 => Err(PictureError::Rate { rate: f64::from(k) }),
            _ => Ok(frames[0].clone()),
        });
        assert!(broken.unwrap_err().to_string().starts_with('3'));
        drop(film);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    fs::write(at("a.gif"), "there").unwrap();
    let message = create("a.gif", sound).unwrap_err().to_string();
    assert!(message.ends_with("a.gif exists already"), "{message}");
    assert_eq!(fs::read(at("a.gif")).unwrap(), b"there");
}

#[test]
fn stills_are_written_whole_and_only_stills() {
    let folder = tempfile::tempdir().unwrap();
    let picture = page(12.0, 9.0);
    for (name, expected) in [
        ("a.svg", picture.svg().into_bytes()),
        ("a.PNG", picture.paint().unwrap().png().unwrap()),
    ] {
        let path = folder.path().join(name);
        picture.write(&path, false).unwrap();
        assert_eq!(fs::read(&path).unwrap(), expected);
        let message = picture.write(&path, false).unwrap_err().to_string();
        assert!(message.ends_with("exists already"), "{message}");
        picture.write(&path, true).unwrap();
    }
    let film = picture.write(&folder.path().join("a.gif"), false);
    let message = film.unwrap_err().to_string();
    assert!(
        message.ends_with("the name of a still ends in .svg or .png"),
        "{message}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Whatever changes from frame to frame, films show every frame as it was.
    #[test]
    fn every_frame_comes_back(
        scenes in prop::collection::vec(
            prop::collection::vec((0u32..12, 0u32..9, 0usize..6), 0..5),
            1..8,
        ),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let frames: Vec<_> = scenes.iter().map(|squares| frame(squares)).collect();
        for name in ["a.gif", "a.apng"] {
            let path = folder.path().join(name);
            shot(&path, &frames, 20.0);
            let shown: Vec<_> = read(&path).into_iter().map(|(_, shown)| shown).collect();
            let expected: Vec<_> = frames.iter().map(rgb).collect();
            prop_assert_eq!(shown, expected);
        }
    }
}
