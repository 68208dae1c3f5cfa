//! H. Shi, L. Wang and T. Chu, flocking with asymmetric interactions, Figures 1 to 7.

mod relations;

pub(super) use relations::Relations;

use relations::{AHEAD, configuration, moving};

use super::course::{Course, Courses, Of, Wanted};
use super::page::{against_time, at_agents, page, plane, tracks};
use super::{Entry, Trouble, lowest, number};
use crate::math::{Vector, direction};
use crate::metric::{center_of_mass, diameter};
use crate::picture::{Picture, Theme};
use crate::plot::{Axis, Item, Marker, Plot};
use crate::trace::record::Frame;
use crate::world::vector;

const IDEAL: Wanted = Wanted::bodies(
    "shi-wang-chu/ideal",
    &[
        "record.laws=true",
        "record.metrics=false",
        "record.every=0.02",
    ],
);
const ZERO: Wanted = Wanted::bodies("shi-wang-chu/zero-momentum", &["record.laws=true"]);

/// When the paper shows the configuration for the first time.
const EARLY: f64 = 60.0;

/// When the paper's run of Figures 1 to 6 ends.
const STEADY: f64 = 200.0;

/// When the paper finds all velocities to agree.
const AGREED: f64 = 128.92;

pub(super) const ENTRIES: [Entry; 7] = [
    Entry {
        id: "shi-wang-chu-1",
        source: "Shi, Wang & Chu, Figure 1",
        caption: "The initial state of ten agents: positions, velocities and velocity neighbouring \
                  relations, mutual ones as blue lines, the others as red arrows to who is sensed.",
        wanted: &[IDEAL],
        draw: figure_1,
    },
    Entry {
        id: "shi-wang-chu-2",
        source: "Shi, Wang & Chu, Figure 2",
        caption: "The trajectories, dotted, and the configuration with its direction of motion at \
                  t = 60: the agents adjust positions and velocities.",
        wanted: &[IDEAL],
        draw: figure_2,
    },
    Entry {
        id: "shi-wang-chu-3",
        source: "Shi, Wang & Chu, Figure 3",
        caption: "The trajectories, dotted, and the configuration later on: the velocities become \
                  the same.",
        wanted: &[IDEAL],
        draw: figure_3,
    },
    Entry {
        id: "shi-wang-chu-4",
        source: "Shi, Wang & Chu, Figure 4",
        caption: "The agents at t = 200 and the velocity that all have then, that of the centre of \
                  mass at the start; the paper finds all velocities alike from about t = 128.92 on.",
        wanted: &[IDEAL],
        draw: figure_4,
    },
    Entry {
        id: "shi-wang-chu-5",
        source: "Shi, Wang & Chu, Figure 5",
        caption: "The way of the centre of mass, a star at its initial position: its velocity is \
                  invariant.",
        wanted: &[IDEAL],
        draw: figure_5,
    },
    Entry {
        id: "shi-wang-chu-6",
        source: "Shi, Wang & Chu, Figure 6",
        caption: "The velocity curves: all velocities come to the same.",
        wanted: &[IDEAL],
        draw: figure_6,
    },
    Entry {
        id: "shi-wang-chu-7",
        source: "Shi, Wang & Chu, Figure 7",
        caption: "A run to t = 3000 whose centre of mass, a star, is at rest: it stays where it is, \
                  and the agents come to rest about it, their configuration with them.",
        wanted: &[ZERO],
        draw: figure_7,
    },
];

fn figure_1(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&IDEAL)?;
    let relations = Relations::of(&course.world)?;
    let frame = course.first();
    let speeds = Of::Velocities.vectors(frame).into_iter().map(|v| v.norm());
    let finding = format!(
        "{} mutual relations and {} of one side only, weights drawn from a seed and balanced; \
         speeds up to {}, velocities that differ by up to {}. The paper does not print what it \
         drew. An arrow of a velocity is as long as what the agent flies in {AHEAD} of the unit of time.",
        relations.mutual.len(),
        relations.one_way.len(),
        number(speeds.fold(0.0, f64::max)),
        number(velocity_diameter(frame)),
    );
    let items = moving(frame, &relations, theme);
    let plot = plane("t = 0", ["x¹", "x²"], items);
    Ok((finding, page(vec![plot], 1, [640.0, 600.0], theme)))
}

fn figure_2(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&IDEAL)?;
    let relations = Relations::of(&course.world)?;
    let frame = course.at(EARLY);
    let plots = vec![
        ways(course, EARLY, "(a) Trajectories to t = 60", theme),
        plane(
            "(b) Configuration at t = 60",
            ["x¹", "x²"],
            moving(frame, &relations, theme),
        ),
    ];
    let [start, now] = [course.first(), frame].map(potential);
    let finding = format!(
        "At t = {} velocities differ by at most {} and the flock is {} across; the potential of all \
         pairs has fallen from {} to {}.",
        number(frame.time),
        number(velocity_diameter(frame)),
        number(diameter(&Of::Positions.vectors(frame))),
        number(start),
        number(now),
    );
    Ok((finding, page(plots, 2, [520.0, 500.0], theme)))
}

fn figure_3(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&IDEAL)?;
    let relations = Relations::of(&course.world)?;
    let last = course.last();
    let seen = |frame: &Frame, i: usize| {
        vector::<2>(&frame.positions[i]) - center(course, Of::Positions, frame)
    };
    let way = |i: usize| {
        let frames = course.frames.iter();
        let way = frames.map(move |frame| point(seen(frame, i)));
        Item::line(way, theme.of(i)).dotted().sized(1.4)
    };
    let mut items: Vec<Item> = (0..course.agents()).map(way).collect();
    let agents: Vec<Vector<2>> = (0..course.agents()).map(|i| seen(last, i)).collect();
    items.extend(configuration(&agents, &relations, theme));
    let plots = vec![
        ways(course, last.time, "(a) Trajectories to the end", theme),
        plane(
            "(b) The same, seen from the centre of mass",
            ["x¹ − x*¹", "x² − x*²"],
            items,
        ),
    ];
    let widths = course.series(|frame| diameter(&Of::Positions.vectors(frame)));
    let finding = format!(
        "To t = {}, for the paper does not name the time. The flock is {} across at the start, {} at \
         most and {} at the end. Seen from the centre of mass, the agents settle.",
        number(last.time),
        number(widths[0]),
        number(widths.iter().copied().fold(0.0, f64::max)),
        number(widths[widths.len() - 1]),
    );
    Ok((finding, page(plots, 2, [520.0, 500.0], theme)))
}

fn figure_4(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&IDEAL)?;
    let relations = Relations::of(&course.world)?;
    let last = course.last();
    let spreads = course.frames.iter();
    let [when, least] = lowest(spreads.map(|frame| [frame.time, velocity_diameter(frame)]));
    let falls = potential(course.at(when)) - potential(last);
    let late = match velocity_diameter(last) > 2.0 * least {
        true => format!(
            "after that they differ more again, while the potential of all pairs falls by {}, as \
             where a formation leaves a saddle of the potential",
            number(falls)
        ),
        false => "after that they stay as small".to_owned(),
    };
    let kept = center(course, Of::Velocities, course.first());
    let off = Of::Velocities
        .vectors(last)
        .into_iter()
        .map(|v| (v - kept).norm());
    let finding = format!(
        "Velocities differ by at most {} at t = {AGREED}, and by {} at t = {}. They differ least, \
         by {}, at t = {}; {late}. At the end no velocity is more than {} from the initial one of the \
         centre of mass, ({:.5}, {:.5}).",
        number(velocity_diameter(course.at(AGREED))),
        number(velocity_diameter(last)),
        number(last.time),
        number(least),
        number(when),
        number(off.fold(0.0, f64::max)),
        kept.x,
        kept.y,
    );
    let items = moving(last, &relations, theme);
    let plot = plane(&format!("t = {}", number(last.time)), ["x¹", "x²"], items);
    Ok((finding, page(vec![plot], 1, [640.0, 600.0], theme)))
}

fn figure_5(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&IDEAL)?;
    let centers: Vec<[f64; 2]> = course
        .frames
        .iter()
        .map(|frame| point(center(course, Of::Positions, frame)))
        .collect();
    let velocities: Vec<Vector<2>> = course
        .frames
        .iter()
        .map(|frame| center(course, Of::Velocities, frame))
        .collect();
    let off = velocities.iter().map(|v| (v - velocities[0]).norm());
    let off = off.fold(0.0, f64::max);
    let half = centers.len() / 2;
    let way = vec![
        Item::line(centers.iter().copied(), theme.of(0)),
        Item::arrows([[centers[half], centers[half + half / 8]]], theme.ink).sized(2.0),
        Item::markers([centers[0]], Marker::Star, theme.alarm)
            .sized(8.0)
            .named("start"),
    ];
    let component = |axis: usize| {
        let pairs = course.times().into_iter().zip(&velocities);
        let points: Vec<[f64; 2]> = pairs.map(|(t, v)| [t, v[axis]]).collect();
        Item::line(points, theme.of(axis)).named(["v*¹", "v*²"][axis])
    };
    let largest = velocities[0].amax();
    let plots = vec![
        plane("(a) Way of the centre of mass", ["x*¹", "x*²"], way),
        against_time(
            "(b) Its velocity",
            Axis::new("v*")
                .linear()
                .range([-1.5 * largest, 1.5 * largest]),
            vec![component(0), component(1)],
        ),
    ];
    let finding = format!(
        "The velocity of the centre of mass is ({:.5}, {:.5}) at the start, and never more than {} \
         from that until t = {}.",
        velocities[0].x,
        velocities[0].y,
        number(off),
        number(course.last().time),
    );
    Ok((finding, page(plots, 2, [520.0, 460.0], theme)))
}

fn figure_6(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&IDEAL)?;
    let mut curves = tracks(&course.frames, Of::Velocities, theme);
    let common = Of::Velocities.vectors(course.last())[0];
    curves.push(at_agents(&course.first().velocities, Marker::Ring, theme.ink).named("start"));
    let end = Item::markers([point(common)], Marker::Star, theme.alarm);
    curves.push(end.sized(8.0).named("end"));
    // Heads of one size, along a chord so short that it lies on the curve.
    let head = 0.025 * velocity_diameter(course.first());
    let soon = [0.3, 0.36].map(|time| Of::Velocities.vectors(course.at(time)));
    let heads = soon[0].iter().zip(&soon[1]).map(|(here, next)| {
        let half = direction(&(next - here)) * (0.5 * head);
        [here - half, here + half].map(point)
    });
    curves.push(Item::arrows(heads, theme.ink));
    let spread = course
        .frames
        .iter()
        .map(|it| [it.time, velocity_diameter(it)]);
    let plots = vec![
        plane("(a) Velocities", ["v¹", "v²"], curves),
        against_time(
            "(b) Largest difference of two velocities",
            Axis::new("max |vᵢ − vⱼ|").logarithmic(),
            vec![Item::line(spread, theme.of(0))],
        ),
    ];
    let finding = format!(
        "The largest difference of two velocities falls from {} at the start to {} at t = 10 and {} \
         at t = 60, and is {} at t = {}.",
        number(velocity_diameter(course.first())),
        number(velocity_diameter(course.at(10.0))),
        number(velocity_diameter(course.at(EARLY))),
        number(velocity_diameter(course.last())),
        number(course.last().time),
    );
    Ok((finding, page(plots, 2, [520.0, 460.0], theme)))
}

fn figure_7(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&ZERO)?;
    let relations = Relations::of(&course.world)?;
    let last = course.last();
    let star = || {
        let star = Item::markers(
            [point(center(course, Of::Positions, last))],
            Marker::Star,
            theme.alarm,
        );
        star.sized(8.0).named("centre of mass")
    };
    let dotted = tracks(&course.frames, Of::Positions, theme).into_iter();
    let mut way: Vec<Item> = dotted.map(|item| item.dotted().sized(1.4)).collect();
    way.push(at_agents(&last.positions, Marker::Disk, theme.ink));
    way.push(star());
    let mut end = configuration(&Of::Positions.vectors(last), &relations, theme);
    end.push(star());
    let plots = vec![
        plane("(a) Trajectories", ["x¹", "x²"], way),
        plane("(b) Final configuration", ["x¹", "x²"], end),
    ];
    let home = center(course, Of::Positions, course.first());
    let moved = course.series(|frame| (center(course, Of::Positions, frame) - home).norm());
    let fastest = Of::Velocities.vectors(last).into_iter().map(|v| v.norm());
    let before = course.at(STEADY);
    let width = |frame: &Frame| number(diameter(&Of::Positions.vectors(frame)));
    let finding = format!(
        "To t = {} the centre of mass moves by at most {}. At the end the fastest agent has the \
         speed {}. From t = {}, where Figures 1 to 6 end, to the end the potential of all pairs still \
         falls by {}, and the width of the flock from {} to {}.",
        number(last.time),
        number(moved.into_iter().fold(0.0, f64::max)),
        number(fastest.fold(0.0, f64::max)),
        number(before.time),
        number(potential(before) - potential(last)),
        width(before),
        width(last),
    );
    Ok((finding, page(plots, 2, [520.0, 500.0], theme)))
}

/// Dotted trajectories up to a time, the agents there, and where the flock goes.
fn ways(course: &Course, until: f64, title: &str, theme: &Theme) -> Plot {
    let frame = course.at(until);
    let lines = tracks(course.until(until), Of::Positions, theme).into_iter();
    let mut items: Vec<Item> = lines.map(|it| it.dotted().sized(1.4)).collect();
    items.push(at_agents(&frame.positions, Marker::Disk, theme.ink).sized(2.5));
    let [here, along] = [Of::Positions, Of::Velocities].map(|of| center(course, of, frame));
    let ahead = here + along * (0.12 * until);
    items.push(Item::arrows([[point(here), point(ahead)]], theme.ink).sized(1.8));
    plane(title, ["x¹", "x²"], items)
}

fn velocity_diameter(frame: &Frame) -> f64 {
    diameter(&Of::Velocities.vectors(frame))
}

/// Position or velocity of the centre of mass.
fn center(course: &Course, of: Of, frame: &Frame) -> Vector<2> {
    center_of_mass(&course.world.agents.mass, &of.vectors(frame))
}

/// The potential of all pairs, which the run is asked to record.
fn potential(frame: &Frame) -> f64 {
    let laws = frame.laws.as_ref();
    laws.and_then(|laws| laws.potential).unwrap_or(f64::NAN)
}

fn point(vector: Vector<2>) -> [f64; 2] {
    [vector.x, vector.y]
}
