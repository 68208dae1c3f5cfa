//! Frames painted in a second, and films written.
//!
//! `cargo bench --bench films` prints a table: the six obstacles, 100 agents, 600 frames of
//! 800×600 pixels. Ways are timed in turns, and figures are medians of the rounds.

mod common;

use std::convert::Infallible;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;

use common::{median, pool, seconds};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use volary::picture::{FileKind, Picture};
use volary::render::{Layer, Layers, Look, Moment, Past, RenderError, Scene, Size, Survey, film};
use volary::simulation::Simulation;
use volary::trace::record::Record;
use volary::world::{AnyWorld, Document, Override, World, shipped};

/// Rounds in which all ways take their turns.
const ROUNDS: usize = 5;

/// Frames of the film.
const FRAMES: usize = 600;

/// Frames that a trail shows.
const TRAIL: usize = 30;

fn main() {
    let world = six_obstacles();
    let records = run(world.clone());
    let survey = Survey::of(&world, &records).expect("the run can be surveyed");
    let usual = Layers::usual(&survey);
    let mut more = usual;
    for layer in [
        Layer::Trails,
        Layer::Velocities,
        Layer::Beta,
        Layer::Gamma,
        Layer::Grid,
    ] {
        more.show(layer);
    }
    let folder = tempfile::tempdir().expect("a folder can be made");
    println!("| layers | what | threads | frames/s | seconds for {FRAMES} |");
    println!("|---|---|---|---|---|");
    for (name, layers) in [
        ("usual", usual),
        ("with trails, velocities, β, γ, grid", more),
    ] {
        let look = Look {
            layers: Some(layers),
            size: Size::Exact([800.0, 600.0]),
            ..Look::default()
        };
        let scene = Scene::new(&world, &survey, look);
        let moments = moments(&records);
        type Way<'a> = (&'a str, usize, Box<dyn Fn() + Sync + 'a>);
        let ways: Vec<Way<'_>> = [1, 2]
            .into_iter()
            .flat_map(|threads| {
                let (scene, moments, folder) = (&scene, &moments, folder.path());
                let write = move |kind| move || write(scene, moments, folder, kind);
                [
                    ("raster", threads, Box::new(|| paint(scene, moments)) as _),
                    ("GIF", threads, Box::new(write(FileKind::Gif)) as _),
                    ("APNG", threads, Box::new(write(FileKind::Apng)) as _),
                ]
            })
            .collect();
        let mut times = vec![Vec::new(); ways.len()];
        for _ in 0..ROUNDS {
            for ((_, threads, work), times) in ways.iter().zip(&mut times) {
                times.push(pool(*threads).install(|| seconds(work)));
            }
        }
        for ((what, threads, _), times) in ways.iter().zip(times) {
            let time = median(times);
            let rate = FRAMES as f64 / time;
            println!("| {name} | {what} | {threads} | {rate:.0} | {time:.2} |");
        }
    }
}

fn six_obstacles() -> World<2> {
    let name = "olfati-saber-2003/six-obstacles";
    let text = shipped::get(name).expect("the world is shipped");
    let set = |text: &str| -> Override { text.parse().expect("the setting is sound") };
    let settings = [
        set("record.every=0.1"),
        set("record.edges=true"),
        set("record.beta_agents=true"),
    ];
    match Document::new(name, text).with(settings).world(name) {
        Ok(AnyWorld::Plane(world)) => world,
        _ => panic!("the world is sound, and flat"),
    }
}

fn run(world: World<2>) -> Vec<Record> {
    let mut records = Vec::new();
    let mut simulation = Simulation::new(world).expect("the world can start");
    let keep = |record| {
        records.push(record);
        Ok::<_, Infallible>(())
    };
    let done = simulation.run(keep, |_| ControlFlow::Continue(()));
    done.expect("nothing can fail");
    records
}

/// The frames, each with what trails show.
fn moments(records: &[Record]) -> Vec<Moment> {
    let frames = records.iter().filter_map(|record| match record {
        Record::Frame(frame) => Some(frame),
        _ => None,
    });
    let mut trail = Vec::new();
    let mut moments = Vec::new();
    for frame in frames.take(FRAMES) {
        let past = Past {
            time: frame.time,
            positions: frame.positions.clone(),
        };
        trail.push(past.into());
        let first = trail.len().saturating_sub(TRAIL);
        moments.push(Moment {
            trail: trail[first..].to_vec(),
            ..Moment::new(frame.clone())
        });
    }
    moments
}

fn paint(scene: &Scene<'_, 2>, moments: &[Moment]) {
    let still = scene.still();
    let base = still.paint().expect("it can be painted");
    moments.par_iter().for_each(|moment| {
        let mut picture = Picture::new(still.size, still.background, "");
        picture.marks = scene.moving(moment);
        black_box(picture.paint_over(&base).expect("it can be painted"));
    });
}

fn write(scene: &Scene<'_, 2>, moments: &[Moment], folder: &Path, kind: FileKind) {
    let path = folder.join(match kind {
        FileKind::Gif => "film.gif",
        _ => "film.apng",
    });
    let all = moments.iter().cloned().map(Ok::<_, RenderError>);
    let samples: Vec<Moment> = moments.iter().step_by(FRAMES / 5).cloned().collect();
    film(&path, scene, all, 25, &samples, true, || {}).expect("the film can be written");
}
