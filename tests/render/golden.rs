//! Pictures against ones that were looked at once. `VOLARY_BLESS=1` writes them anew.

use std::path::PathBuf;

use volary::picture::{Pixels, Theme};
use volary::render::{Coloring, Eye, Layer, Look, Moment, Past, Scene, Size, Survey};
use volary::shape::In;
use volary::trace::record::Record;
use volary::world::World;

use crate::image::{assert_looks_like, difference};
use crate::stage::{plane, space};

/// The largest mean difference of all pixels' channels, as a share of their range.
const MEAN: f64 = 0.001;

/// The largest difference of a channel of any pixel.
const MOST: f64 = 0.16;

/// The last frame, with a trail from the first.
fn draw<const D: usize>(world: &World<D>, records: &[Record], look: Look) -> Pixels
where
    In<D>: Eye<D>,
{
    let survey = Survey::of(world, records).expect("the frames fit the world");
    let frames: Vec<_> = records
        .iter()
        .filter_map(|record| match record {
            Record::Frame(frame) => Some(frame),
            _ => None,
        })
        .collect();
    let (first, last) = (frames[0], frames[frames.len() - 1]);
    let mut moment = Moment::new(last.clone());
    if frames.len() > 1 {
        let past = Past {
            time: first.time,
            positions: first.positions.clone(),
        };
        moment.trail = vec![past.into()];
    }
    let picture = Scene::new(world, &survey, look).picture(&moment);
    picture.paint().expect("the picture can be painted")
}

fn flat() -> Pixels {
    let (world, records) = plane();
    let look = Look {
        layers: Some(Layer::ALL.into_iter().collect()),
        size: Size::Exact([320.0, 300.0]),
        ..Look::default()
    };
    draw(&world, &records, look)
}

fn deep() -> Pixels {
    let (world, records) = space();
    let look = Look {
        theme: Theme::DARK,
        coloring: Coloring::Speed,
        size: Size::Exact([320.0, 220.0]),
        ..Look::default()
    };
    draw(&world, &records, look)
}

fn check(name: &str, found: &Pixels) {
    assert_looks_like(&path(name), &found.png().unwrap(), MEAN, MOST);
}

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("tests/render/golden")
        .join(name)
}

#[test]
fn the_plane_looks_as_it_did() {
    check("plane.png", &flat());
}

#[test]
fn space_looks_as_it_did() {
    check("space.png", &deep());
}

#[test]
fn another_scene_is_told_apart() {
    let (world, mut records) = plane();
    let Record::Frame(last) = &mut records[1] else {
        panic!("the second record is a frame");
    };
    last.positions[2][1] += 0.5;
    let look = Look {
        layers: Some(Layer::ALL.into_iter().collect()),
        size: Size::Exact([320.0, 300.0]),
        ..Look::default()
    };
    let moved = draw(&world, &records, look);
    let golden = std::fs::read(path("plane.png")).expect("the golden picture is there");
    let apart = difference(&golden, &moved.png().unwrap()).expect("the sizes are the same");
    assert!(apart.mean > MEAN || apart.most > MOST, "{apart:?}");
}
