//! What pictures have in common with the worlds they show.

use proptest::prelude::*;
use volary::math::Vector;
use volary::picture::Pixels;
use volary::render::{Camera, Layer, Look, Moment, Scene, Survey};
use volary::trace::record::Record;

use crate::stage::{balls, bare, disks, frame};

/// Bodies alone.
fn bodies() -> Look {
    Look {
        layers: Some([Layer::Bodies].into_iter().collect()),
        ..Look::default()
    }
}

/// Places too far apart to touch.
fn places<const D: usize>() -> impl Strategy<Value = Vec<Vector<D>>> {
    prop::collection::vec(prop::array::uniform3(-40.0..40.0f64), 1..12).prop_map(|points| {
        let mut apart: Vec<Vector<D>> = Vec::new();
        for point in points {
            let place = Vector::from_fn(|k, _| point[k]);
            if apart.iter().all(|other| (other - place).norm() > 3.0) {
                apart.push(place);
            }
        }
        apart
    })
}

/// Mean difference of the pixels, of which the second picture has each where `from` says.
fn difference(one: &Pixels, other: &Pixels, from: impl Fn(u32, u32) -> (u32, u32)) -> f64 {
    let mut sum = 0.0;
    for y in 0..one.height() {
        for x in 0..one.width() {
            let (there_x, there_y) = from(x, y);
            let (a, b) = (one.at(x, y).unwrap(), other.at(there_x, there_y).unwrap());
            sum += (0..4).map(|k| f64::from(a[k].abs_diff(b[k]))).sum::<f64>();
        }
    }
    sum / f64::from(4 * one.width() * one.height())
}

/// Whether a disk lies within a page.
fn inside((center, radius): ([f64; 2], f64), size: [f64; 2]) -> bool {
    let fits = |(at, side): (&f64, &f64)| at - radius >= 0.0 && at + radius <= *side;
    center.iter().zip(&size).all(fits)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_world_elsewhere_looks_the_same(
        places in places::<2>(),
        shift in prop::array::uniform2(-1000.0..1000.0f64),
    ) {
        let shift = Vector::<2>::from(shift);
        let there: Vec<_> = places.iter().map(|place| place + shift).collect();
        let picture = |places: &[Vector<2>]| {
            let world = balls(1.0, places);
            bare(&world, &frame(&world, 0.0, &[0.0, 0.0]), bodies(), [120.0, 90.0])
        };
        let off = difference(&picture(&places), &picture(&there), |x, y| (x, y));
        prop_assert!(off < 0.05, "{}", off);
    }

    #[test]
    fn a_turned_world_is_the_turned_picture(places in places::<2>()) {
        // A quarter of a turn to the left.
        let turned: Vec<_> = places.iter().map(|at| Vector::<2>::new(-at.y, at.x)).collect();
        let picture = |places: &[Vector<2>]| {
            let world = balls(1.0, places);
            bare(&world, &frame(&world, 0.0, &[0.0, 0.0]), bodies(), [120.0, 120.0])
        };
        let off = difference(&picture(&places), &picture(&turned), |x, y| (y, 119 - x));
        prop_assert!(off < 0.5, "{}", off);
    }

    #[test]
    fn every_body_of_the_plane_is_on_the_page(places in places::<2>()) {
        let world = balls(1.0, &places);
        let frame = frame(&world, 0.0, &[1.0, 0.0]);
        let survey = Survey::of(&world, [&Record::Frame(frame.clone())]).unwrap();
        let picture = Scene::new(&world, &survey, bodies()).picture(&Moment::new(frame));
        let found = disks(&picture.marks);
        prop_assert_eq!(found.len(), places.len());
        for disk in found {
            prop_assert!(inside(disk, picture.size), "{:?} of {:?}", disk, picture.size);
        }
    }

    #[test]
    fn every_body_of_space_is_on_the_page_wherever_the_camera_goes(
        places in places::<3>(),
        azimuth in -180.0..180.0f64,
        elevation in -80.0..80.0f64,
        turn in 0.0..360.0f64,
        orbits in any::<bool>(),
    ) {
        let world = balls(1.0, &places);
        let frame = frame(&world, 0.0, &[1.0, 0.0, 0.0]);
        let survey = Survey::of(&world, [&Record::Frame(frame.clone())]).unwrap();
        let look = Look { camera: Camera { azimuth, elevation, orbits }, ..bodies() };
        let mut moment = Moment::new(frame);
        moment.turn = if orbits { turn } else { 0.0 };
        let picture = Scene::new(&world, &survey, look).picture(&moment);
        let found = disks(&picture.marks);
        prop_assert_eq!(found.len(), places.len());
        for disk in found {
            prop_assert!(inside(disk, picture.size), "{:?} of {:?}", disk, picture.size);
        }
    }
}

#[test]
fn nearer_bodies_cover_farther_ones() {
    // One behind the other, seen along the first axis.
    let places = [-4.0, 4.0].map(|x| Vector::<3>::new(x, 0.0, 0.0));
    let world = balls(1.0, &places);
    let frame = frame(&world, 0.0, &[0.0; 3]);
    let survey = Survey::of(&world, [&Record::Frame(frame.clone())]).unwrap();
    let seen = |azimuth: f64| {
        let camera = Camera {
            azimuth,
            elevation: 0.0,
            orbits: false,
        };
        let look = Look { camera, ..bodies() };
        let picture =
            Scene::new(&world, &survey, look).bare(&Moment::new(frame.clone()), [200.0; 2]);
        disks(&picture.marks)
    };
    for azimuth in [0.0, 180.0] {
        let [(_, far), (_, near)] = seen(azimuth)[..] else {
            panic!("there are two balls");
        };
        assert!(near > far, "the one painted last is the nearer, larger one");
    }
}
