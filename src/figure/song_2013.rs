//! Q. Song, F. Liu, J. Cao and J. Qiu, "Cucker-Smale flocking with bounded cohesive and repulsive
//! forces", 2013, Figures 1 and 2.

use super::course::{Course, Of, Wanted};
use super::page::{against_time, at_agents, components, page, plane, tracks};
use super::{Entry, Trouble, lowest, number};
use crate::claim::{Exclusion, MovedBy, Run, claims, closer};
use crate::metric::diameter;
use crate::picture::{Picture, Theme};
use crate::plot::{Axis, Item, Marker};
use crate::trace::record::Frame;

// Each step, for the smallest distance is of them all.
const EXAMPLE_18: Wanted = Wanted::bodies(
    "song-2013/example-18",
    &[
        "record.laws=true",
        "record.metrics=false",
        "record.every=0.005",
    ],
);
const EXAMPLE_19: Wanted = Wanted::bodies(
    "song-2013/example-19",
    &[
        "record.laws=true",
        "record.metrics=false",
        "record.every=0.01",
    ],
);

pub(super) const ENTRIES: [Entry; 2] = [
    Entry {
        id: "song-2013-1",
        source: "Song et al. (2013), Figure 1",
        caption: "Ten agents of model (8), Example 18: (a) their velocities against time converge; \
                  (b) their trajectories, + at the start and o at the end, stay together; (c) the \
                  smallest distance between agents, d(t), stays above zero.",
        wanted: &[EXAMPLE_18],
        draw: |courses, theme| {
            let bound = "song-2013/theorem-10-distance-sharpened";
            draw(courses.get(&EXAMPLE_18)?, bound, 8.0, theme)
        },
    },
    Entry {
        id: "song-2013-2",
        source: "Song et al. (2013), Figure 2",
        caption: "Ten agents of model (17), Example 19: (a) their velocities against time converge; \
                  (b) their trajectories, + at the start and o at the end, stay together; (c) the \
                  smallest distance between agents, d(t), stays above zero.",
        wanted: &[EXAMPLE_19],
        draw: |courses, theme| {
            let bound = "song-2013/theorem-16-distance-sharpened";
            draw(courses.get(&EXAMPLE_19)?, bound, 60.0, theme)
        },
    },
];

/// The three parts, drawn to a time by which most has happened; the finding is of the whole run.
pub(super) fn draw(
    course: &Course,
    claim: &str,
    until: f64,
    theme: &Theme,
) -> Result<(String, Picture), Trouble> {
    let nearest = nearest(course);
    let shown = course.until(until);
    let end = &shown[shown.len() - 1];
    let kept = kept(course, claim)?;
    let velocities = |axis: usize| {
        let title = [
            "(a) First component of the velocities",
            "(a) Second component",
        ][axis];
        let label = ["v¹", "v²"][axis];
        let items = components(shown, Of::Velocities, axis, theme);
        against_time(title, Axis::new(label).linear(), items)
    };
    let mut ways = tracks(shown, Of::Positions, theme);
    ways.push(at_agents(&course.first().positions, Marker::Plus, theme.ink).named("start"));
    ways.push(at_agents(&end.positions, Marker::Ring, theme.ink).named("end"));
    let name = format!("kept by theory: {}", number(kept.distance));
    let distances = vec![
        Item::line(nearest.iter().copied().take(shown.len()), theme.of(0)).named("d(t)"),
        Item::level(kept.distance, theme.alarm).named(name),
    ];
    let most = nearest.iter().map(|it| it[1]).fold(0.0, f64::max);
    let plots = vec![
        velocities(0),
        velocities(1),
        plane("(b) Trajectories", ["x¹", "x²"], ways),
        against_time(
            "(c) Smallest distance of two agents",
            Axis::new("d").linear().range([0.0, 1.05 * most]),
            distances,
        ),
    ];
    let [when, least] = lowest(nearest.iter().copied());
    let laws = course.first().laws.as_ref();
    let energy = laws.and_then(|laws| laws.energy).unwrap_or(f64::NAN);
    let differ = |frame: &Frame| diameter(&Of::Velocities.vectors(frame));
    let width = |frame: &Frame| diameter(&Of::Positions.vectors(frame));
    let widest = course.series(width).into_iter().fold(0.0, f64::max);
    let finding = format!(
        "The largest difference of two velocities falls from {} to {} at t = {}. The flock is at \
         most {} across, and {} at the end. d(t) is {} at the start and never below {}, at t = {}; theory \
         keeps it above {}, since {}. Bodies of radius {} touch {}. The paper does not print its \
         initial state: ours has its d(0) and its W(0), {energy:.4}. Drawn to t = {} of {}; the paper does not say \
         how far it draws.",
        number(differ(course.first())),
        number(differ(course.last())),
        number(course.last().time),
        number(widest),
        number(width(course.last())),
        number(nearest[0][1]),
        number(least),
        number(when),
        number(kept.distance),
        kept.formula,
        number(course.world.agents.radius[0]),
        match course.summary.agent_contacts.episodes {
            0 => "nowhere".to_owned(),
            1 => "once".to_owned(),
            times => format!("{times} times"),
        },
        number(end.time),
        number(course.last().time),
    );
    Ok((finding, page(plots, 2, [520.0, 400.0], theme)))
}

/// d(t).
fn nearest(course: &Course) -> Vec<[f64; 2]> {
    let frames = course.frames.iter();
    let points = frames.map(|frame| {
        let positions = Of::Positions.vectors(frame);
        let distance = closer(None, frame.time, &positions).map_or(f64::NAN, |it| it.distance);
        [frame.time, distance]
    });
    points.collect()
}

/// The distance that a claim keeps between agents that start as these do.
fn kept(course: &Course, claim: &str) -> Result<Exclusion, Trouble> {
    let world = &course.world;
    let moved_by = MovedBy::Bodies {
        step: world.spec.time.step,
    };
    let start = [Of::Positions, Of::Velocities].map(|of| of.vectors(course.first()));
    let [positions, velocities] = start;
    let run = Run::of_states(world, moved_by, [(0.0, positions, velocities)]);
    let all = claims();
    let claim = all.iter().find(|it| it.about().name == claim);
    let kept = claim.and_then(|claim| claim.exclusion(&run));
    kept.ok_or_else(|| Trouble::new(&world.name, "theory keeps no distance between its agents"))
}
