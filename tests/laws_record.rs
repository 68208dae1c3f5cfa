//! What frames record of the laws, against plain loops over the shipped worlds' agents.

use std::ops::ControlFlow;

use volary::math::Vector;
use volary::simulation::Simulation;
use volary::trace::record::{Frame, LawRecord, LawsRecord, Record};
use volary::world::{AnyWorld, Document, Override, World, shipped};

/// The frames of a shipped world up to a time, with what its laws are about.
fn frames(name: &str, until: f64) -> (World<2>, Vec<Frame>) {
    let load = || {
        let text = shipped::get(name).expect("it is shipped");
        let sets = ["record.laws=true", "record.active_at=0.1"];
        let sets = sets.map(|set| set.parse::<Override>().expect("a path and a value"));
        match Document::new(name, text).with(sets).world(name) {
            Ok(AnyWorld::Plane(world)) => world,
            _ => panic!("{name} is a sound world in the plane"),
        }
    };
    let mut frames = Vec::new();
    let mut simulation = Simulation::new(load()).expect("a finite start");
    simulation
        .run(
            |record| {
                frames.extend(match record {
                    Record::Frame(frame) => Some(frame),
                    _ => None,
                });
                Ok::<_, std::convert::Infallible>(())
            },
            |state| match state.time < until {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            },
        )
        .expect("recording cannot fail");
    (load(), frames)
}

fn laws(frame: &Frame) -> &LawsRecord {
    frame.laws.as_deref().expect("it is recorded")
}

fn law<'a>(frame: &'a Frame, name: &str) -> &'a LawRecord {
    let mut all = laws(frame).laws.iter();
    all.find(|law| law.law == name).expect("the world has it")
}

fn points(list: &[Vec<f64>]) -> Vec<Vector<2>> {
    list.iter().map(|x| Vector::<2>::new(x[0], x[1])).collect()
}

fn close(found: f64, wanted: f64) {
    assert!(
        (found - wanted).abs() < 1e-9 * wanted.abs().max(1.0),
        "{found} {wanted}"
    );
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j)))
}

#[test]
fn energies_of_song_are_the_printed_ones_and_never_grow() {
    for (name, printed) in [
        ("song-2013/example-18", 131.5835),
        ("song-2013/example-19", 34.0842),
    ] {
        let (_, frames) = frames(name, 3.0);
        let energies: Vec<f64> = frames
            .iter()
            .map(|it| laws(it).energy.expect("finite"))
            .collect();
        assert!(
            (energies[0] - printed).abs() < 1e-9,
            "{name}: {}",
            energies[0]
        );
        assert!(
            energies.windows(2).all(|two| two[1] <= two[0]),
            "{name}: {energies:?}"
        );
        // The mean velocity is conserved.
        let first = &laws(&frames[0]).mean_velocity;
        let last = &laws(frames.last().expect("a frame")).mean_velocity;
        close(last[0], first[0]);
        close(last[1], first[1]);
    }
}

#[test]
fn the_energy_of_shi_wang_and_chu_is_that_of_plain_loops() {
    let (world, frames) = frames("shi-wang-chu/ideal", 2.0);
    let masses = &world.agents.mass;
    let mut before = f64::INFINITY;
    for frame in &frames {
        let (x, v) = (points(&frame.positions), points(&frame.velocities));
        let kinetic: f64 = (0..10).map(|i| 0.5 * masses[i] * v[i].norm_squared()).sum();
        let potential = |(i, j): (usize, usize)| {
            let squared = (x[i] - x[j]).norm_squared();
            0.5 * squared.ln() + 2.5 / squared
        };
        let potential: f64 = pairs(10).map(potential).sum();
        let record = laws(frame);
        close(record.potential.expect("finite"), potential);
        close(record.total_energy.expect("finite"), kinetic + potential);
        assert!(kinetic + potential < before, "J grows");
        before = kinetic + potential;
        let total: f64 = masses.iter().sum();
        let momentum: Vector<2> = masses.iter().zip(&v).map(|(m, v)| v * *m).sum();
        close(record.mass_velocity[0], momentum[0] / total);
        close(record.mass_velocity[1], momentum[1] / total);
        let influence = law(frame, "alignment")
            .influence
            .as_ref()
            .expect("it has some");
        assert!(influence.imbalance < 1e-12);
        assert!((influence.connectivity.expect("ten agents") - 0.414226).abs() < 1e-6);
    }
}

#[test]
fn influences_and_steering_of_djokam_and_rathinam_are_those_of_plain_loops() {
    let (_, frames) = frames("djokam-rathinam/fast-0.1", 1.0);
    for frame in &frames {
        let (x, v) = (points(&frame.positions), points(&frame.velocities));
        let kernel = |i: usize, j: usize| (1.0 + (x[i] - x[j]).norm_squared()).powf(-0.3);
        let influence =
            |i: usize, j: usize| kernel(i, j) / (0..7).map(|k| kernel(i, k)).sum::<f64>();
        let record = law(frame, "alignment")
            .influence
            .as_ref()
            .expect("it has some");
        let all = (0..7).flat_map(|i| (0..7).map(move |j| (i, j)));
        let least = all
            .map(|(i, j)| influence(i, j))
            .fold(f64::INFINITY, f64::min);
        close(record.least, least);
        let active = (0..7)
            .filter(|&j| (0..7).all(|p| influence(p, j) >= 0.1))
            .count();
        assert_eq!(record.active, Some(active));
        let (sin, cos) = (0.1 * frame.time).sin_cos();
        let (y, dy) = (
            Vector::<2>::new(100.0 + 10.0 * sin, 10.0 + 10.0 * cos),
            Vector::<2>::new(cos, -sin),
        );
        let steer = |i: usize| (dy - v[i]) * 2.0 + (y - x[i]) * 0.1;
        let apart = pairs(7).map(|(i, j)| (steer(i) - steer(j)).norm());
        close(laws(frame).steering_diameter, apart.fold(0.0, f64::max));
        let far = (0..7).map(|i| (x[i] - y).norm()).fold(0.0, f64::max);
        close(
            law(frame, "tracking")
                .position_error
                .expect("it has a target"),
            far,
        );
        let fast = v.iter().map(|v| 0.5 * v.norm_squared()).fold(0.0, f64::max);
        close(laws(frame).largest_kinetic_energy, fast);
    }
}

#[test]
fn residuals_of_li_liu_and_wu_are_those_of_plain_loops() {
    let (_, line) = frames("li-liu-wu/figure-1", 2.0);
    let (_, ball) = frames("li-liu-wu/figure-3", 2.0);
    for (frames, name) in [(line, "line_pattern"), (ball, "ball_pattern")] {
        for frame in &frames {
            let x = points(&frame.positions);
            let mean = x.iter().sum::<Vector<2>>() / x.len() as f64;
            let off = |x: &Vector<2>| {
                let arm = x - mean;
                match name {
                    // The diagonal, and the circle of radius 5.
                    "line_pattern" => (arm[0] - arm[1]).abs() / 2f64.sqrt(),
                    _ => (arm.norm() - 5.0).abs(),
                }
            };
            let wanted = x.iter().map(off).fold(0.0, f64::max);
            close(law(frame, name).residual.expect("it has a pattern"), wanted);
        }
    }
}
