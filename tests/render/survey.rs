//! What is found out about a trace, and which moments are read from it.

use std::path::Path;

use volary::math::Vector;
use volary::picture::FileKind;
use volary::render::{
    Coloring, Layer, Layers, Look, Moment, Moments, Panel, RenderError, Scene, Survey, film, open,
    overlay, strip,
};
use volary::trace::record::{Bodies, FORMAT, Frame, Header, Record, VERSION};
use volary::trace::{TraceReader, TraceWriter};
use volary::world::{AnyWorld, World};

use crate::stage::{balls, frame, plane};

fn header<const D: usize>(world: &World<D>) -> Record {
    Record::Header(Box::new(Header {
        format: FORMAT.into(),
        version: VERSION,
        program: "a test".into(),
        dynamics: "bodies".into(),
        solver: None,
        name: "a test".into(),
        world: world.spec.clone(),
        bodies: Bodies::default(),
    }))
}

/// A ball that goes to the right by one in each frame, for some frames.
fn walk(frames: usize) -> (World<2>, Vec<Frame>) {
    let world = balls(0.5, &[Vector::<2>::zeros()]);
    let at = |k: usize| Frame {
        positions: vec![vec![k as f64, 0.0]],
        ..frame(&world, 0.1 * k as f64, &[10.0, 0.0])
    };
    let frames = (0..frames).map(at).collect();
    (world, frames)
}

fn write(path: &Path, world: &World<2>, frames: &[Frame]) {
    let mut writer = TraceWriter::create(path, true).unwrap();
    writer.write(&header(world)).unwrap();
    for frame in frames {
        writer.write(&Record::Frame(frame.clone())).unwrap();
    }
    writer.finish().unwrap();
}

#[test]
fn a_survey_tells_how_far_and_how_fast() {
    let (world, records) = plane();
    let survey = Survey::of(&world, &records).unwrap();
    assert_eq!(survey.times, [0.0, 1.0]);
    // The disk at (0, 0) first, and the ends of rods about (5, 6) + 1.
    assert_eq!(survey.bodies.0, Vector::<2>::new(-1.4, -1.0));
    assert!((survey.bodies.1 - Vector::<2>::new(7.4, 7.4)).norm() < 1e-12);
    assert!((survey.speed - 1.25f64.sqrt()).abs() < 1e-12);
    assert_eq!((survey.touches.len(), survey.touches[0].agent), (1, 1));
    assert!(survey.recorded.blocked && !survey.recorded.edges && !survey.complete);
    // The box that drifts, turned by 0.4.
    let (low, high) = survey.movers.expect("one obstacle moves");
    let half = [
        0.4f64.cos() + 0.5 * 0.4f64.sin(),
        0.4f64.sin() + 0.5 * 0.4f64.cos(),
    ];
    let expected = Vector::<2>::new(9.0 - half[0], 4.0 - half[1]);
    assert!(
        (low - expected).norm() < 1e-12
            && (high + low - Vector::<2>::new(18.0, 8.0)).norm() < 1e-12
    );
    let early = survey.during(0, 0);
    assert!((early.bodies.1.x - 6.4).abs() < 1e-12);
}

#[test]
fn the_nearest_frame_is_found() {
    let (world, frames) = walk(5);
    let records: Vec<_> = frames.into_iter().map(Record::Frame).collect();
    let survey = Survey::of(&world, &records).unwrap();
    for (time, number) in [
        (-1.0, 0),
        (0.0, 0),
        (0.04, 0),
        (0.06, 1),
        (0.31, 3),
        (9.0, 4),
    ] {
        assert_eq!(survey.nearest(time), number, "{time}");
    }
}

/// What breaks a frame.
type Spoil = fn(&mut Frame);

#[test]
fn what_does_not_fit_the_world_is_refused() {
    let (world, records) = plane();
    let Record::Frame(sound) = &records[0] else {
        panic!("the first record is a frame");
    };
    let broken: [(&str, Spoil); 6] = [
        ("it has 4 positions of 5 agents", |frame| {
            drop(frame.positions.pop())
        }),
        ("it has 0 rotations of 5 agents", |frame| {
            frame.rotations = Some(Vec::new())
        }),
        ("has 3 numbers instead of 2", |frame| {
            frame.velocities[1].push(0.0)
        }),
        ("it names agent 5 of 5", |frame| {
            frame.edges = Some(vec![[0, 5]])
        }),
        ("it names agent 9 of 5", |frame| {
            frame.blocked = Some(vec![[9, 0]])
        }),
        ("it names obstacle 6 of 6", |frame| {
            frame
                .obstacles
                .iter_mut()
                .flatten()
                .for_each(|pose| pose.obstacle = 6);
        }),
    ];
    for (says, spoil) in broken {
        let mut frame = sound.clone();
        spoil(&mut frame);
        let error = Survey::of(&world, [&Record::Frame(frame)]).unwrap_err();
        assert!(error.to_string().contains(says), "{error}");
    }
    assert!(matches!(Survey::of(&world, []), Err(RenderError::Empty)));
}

#[test]
fn moments_have_the_trails_of_their_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("walk.jsonl");
    let (world, frames) = walk(3000);
    write(&path, &world, &frames);
    let read = |wanted: &[usize], trail: f64| -> Vec<Moment> {
        let reader = TraceReader::open(&path).unwrap();
        let moments = Moments::new(&world, reader, wanted.to_vec(), trail);
        moments.map(Result::unwrap).collect()
    };
    let moments = read(&[0, 7, 7, 20], 0.55);
    assert_eq!(
        moments.iter().map(|it| it.frame.time).collect::<Vec<_>>(),
        [0.0, 0.7, 0.7, 2.0].map(|time: f64| 0.1 * (time * 10.0).round())
    );
    assert_eq!(moments[0].trail.len(), 0);
    for moment in &moments[1..] {
        let x = moment.frame.positions[0][0];
        let trail: Vec<f64> = moment
            .trail
            .iter()
            .map(|past| past.positions[0][0])
            .collect();
        assert_eq!(trail, [5.0, 4.0, 3.0, 2.0, 1.0].map(|back| x - back));
    }
    // However long, a trail keeps a bounded number of points, evenly over its time.
    let long = &read(&[2999], 1e9)[0].trail;
    assert!((150..=450).contains(&long.len()), "{}", long.len());
    assert_eq!(long[0].time, 0.0);
    assert!(
        long.windows(2)
            .all(|pair| pair[1].time - pair[0].time < 2.0)
    );
    assert!(read(&[2999], 0.0)[0].trail.is_empty());
}

#[test]
fn a_trace_is_opened_with_its_world() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("walk.jsonl");
    let (world, frames) = walk(3);
    write(&path, &world, &frames);
    let (found, reader) = open(&path).unwrap();
    let AnyWorld::Plane(found) = found else {
        panic!("the world is flat");
    };
    let survey = Survey::read(&found, reader, |_| {}).unwrap();
    assert_eq!(survey.times.len(), 3);
    assert!(!survey.complete, "there is no summary");
    assert!(open(&folder.path().join("absent.jsonl")).is_err());
}

#[test]
fn notes_tell_what_is_missing() {
    let (world, frames) = walk(2);
    let records: Vec<_> = frames.into_iter().map(Record::Frame).collect();
    let survey = Survey::of(&world, &records).unwrap();
    let usual = Scene::new(&world, &survey, Look::default());
    assert!(usual.notes().is_empty());
    let look = Look {
        layers: Some(
            [Layer::Edges, Layer::Beta, Layer::Gamma]
                .into_iter()
                .collect(),
        ),
        coloring: Coloring::Component,
        ..Look::default()
    };
    let notes = Scene::new(&world, &survey, look).notes();
    for word in ["edges", "components", "β-agents", "γ-agents"] {
        assert!(notes.iter().any(|note| note.contains(word)), "{notes:?}");
    }
}

#[test]
fn layers_have_names() {
    for layer in Layer::ALL {
        assert_eq!(layer.name().parse::<Layer>().unwrap(), layer);
    }
    let error = "contcts".parse::<Layer>().unwrap_err().to_string();
    assert!(
        error.contains("there is no layer `contcts`; did you mean contacts?"),
        "{error}"
    );
    assert!(error.contains("headings, contacts, time"), "{error}");
    let mut layers: Layers = [Layer::Time].into_iter().collect();
    layers.show(Layer::Grid);
    layers.hide(Layer::Time);
    assert!(layers.has(Layer::Grid) && !layers.has(Layer::Time));
}

#[test]
fn several_moments_make_one_picture() {
    let (world, frames) = walk(6);
    let records: Vec<_> = frames.iter().cloned().map(Record::Frame).collect();
    let survey = Survey::of(&world, &records).unwrap();
    let scene = Scene::new(&world, &survey, Look::default());
    let moments: Vec<Moment> = [0, 3, 5].map(|k| Moment::new(frames[k].clone())).to_vec();
    let over = overlay(&scene, &moments).svg();
    let panels: Vec<Panel> = moments.into_iter().map(Panel::new).collect();
    let beside = strip(&scene, &panels).svg();
    for time in ["t = 0.0", "t = 0.3", "t = 0.5"] {
        assert!(over.contains(time) && beside.contains(time), "{time}");
    }
}

#[test]
fn films_have_their_frames() {
    let folder = tempfile::tempdir().unwrap();
    let (world, frames) = walk(6);
    let records: Vec<_> = frames.iter().cloned().map(Record::Frame).collect();
    let survey = Survey::of(&world, &records).unwrap();
    for follow in [false, true] {
        let scene = Scene::new(
            &world,
            &survey,
            Look {
                follow,
                ..Look::default()
            },
        );
        let moments: Vec<Moment> = frames.iter().cloned().map(Moment::new).collect();
        for name in ["film.gif", "film.apng"] {
            let path = folder.path().join(name);
            let mut seen = 0;
            let frames = moments.iter().cloned().map(Ok);
            film(&path, &scene, frames, 25, &moments[..2], true, || seen += 1).unwrap();
            assert_eq!(seen, 6);
            assert!(FileKind::of(&path).unwrap().is_film());
            assert!(std::fs::metadata(&path).unwrap().len() > 500);
        }
    }
    // One that cannot be read to its end leaves nothing.
    let scene = Scene::new(&world, &survey, Look::default());
    let path = folder.path().join("broken.gif");
    let broken = frames
        .iter()
        .enumerate()
        .map(|(number, frame)| match number {
            4 => Err(RenderError::Empty),
            _ => Ok(Moment::new(frame.clone())),
        });
    assert!(film(&path, &scene, broken, 25, &[], true, || ()).is_err());
    assert!(!path.exists());
}

#[test]
fn frames_come_one_after_the_other() {
    let (world, mut frames) = walk(3);
    frames.swap(0, 1);
    let records: Vec<Record> = frames.into_iter().map(Record::Frame).collect();
    let refused = Survey::of(&world, &records);
    assert!(
        matches!(&refused, Err(RenderError::Frame { problem, .. }) if problem.contains("after")),
        "{refused:?}"
    );
}

#[test]
fn distances_that_are_no_numbers_are_refused() {
    let (world, mut frames) = walk(2);
    frames[1].positions[0][0] = 1.7e308;
    let records: Vec<Record> = frames.into_iter().map(Record::Frame).collect();
    let refused = Survey::of(&world, &records);
    assert!(
        matches!(refused, Err(RenderError::Boundless)),
        "{refused:?}"
    );
}
