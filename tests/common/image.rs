//! Pictures compared with those that a person has looked at.

use std::path::Path;

/// How far two pictures of one size differ, in shares of the range from black to white.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// Mean over all pixels and their red, green, blue and opacity.
    pub mean: f64,
    /// The largest of any pixel.
    pub most: f64,
}

/// Width, height, and red, green, blue and opacity of the pixels of a PNG.
pub fn pixels(png: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(png));
    decoder.set_transformations(
        png::Transformations::normalize_to_color8() | png::Transformations::ALPHA,
    );
    let mut reader = decoder.read_info().expect("a PNG begins with its header");
    let size = reader
        .output_buffer_size()
        .expect("the picture fits in memory");
    let mut pixels = vec![0; size];
    let info = reader.next_frame(&mut pixels).expect("a PNG has a picture");
    pixels.truncate(info.buffer_size());
    assert_eq!(
        info.color_type,
        png::ColorType::Rgba,
        "pictures have colours"
    );
    (info.width, info.height, pixels)
}

/// How far two pictures differ; nothing where their sizes do.
pub fn difference(one: &[u8], other: &[u8]) -> Option<Difference> {
    let (one, other) = (pixels(one), pixels(other));
    if (one.0, one.1) != (other.0, other.1) {
        return None;
    }
    let pairs = one.2.iter().zip(&other.2);
    let parts: Vec<f64> = pairs
        .map(|(a, b)| f64::from(a.abs_diff(*b)) / 255.0)
        .collect();
    Some(Difference {
        mean: parts.iter().sum::<f64>() / parts.len() as f64,
        most: parts.iter().copied().fold(0.0, f64::max),
    })
}

/// Fails where a picture differs from the one at `path` by more than this: on the `mean`, or in
/// any pixel by more than `most`; both are shares of the range from black to white. With
/// `VOLARY_BLESS` set it writes the picture there instead: look at it before it is committed. What
/// failed is left in the folder for temporary files, so that it can be looked at too.
pub fn assert_looks_like(path: &Path, png: &[u8], mean: f64, most: f64) {
    if std::env::var_os("VOLARY_BLESS").is_some() {
        let folder = path.parent().expect("the picture lies in a folder");
        std::fs::create_dir_all(folder).expect("the folder can be made");
        std::fs::write(path, png).expect("the picture can be written");
        return;
    }
    let golden = std::fs::read(path)
        .unwrap_or_else(|error| panic!("{}: {error}; VOLARY_BLESS=1 writes it", path.display()));
    let found = difference(&golden, png);
    if found.is_some_and(|it| it.mean <= mean && it.most <= most) {
        return;
    }
    let name = path.file_name().expect("the picture has a name");
    let left = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&left, png).expect("the picture can be written");
    panic!(
        "{} does not look like {}: {found:?}, allowed are mean {mean} and most {most}; \
         VOLARY_BLESS=1 accepts it",
        left.display(),
        path.display()
    );
}
