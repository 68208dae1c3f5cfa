//! G. A. Djokam and M. Rathinam, "A generalized model of flocking with steering", Figures 3 to 8.

mod leading_order;

#[cfg(test)]
pub(super) use leading_order::{Differences, Start, slopes};

use super::course::{Course, Courses, Of, Wanted};
use super::page::{against_time, at_agents, components, page, plane, tracks};
use super::{Entry, Trouble, lowest, number, numbers};
use crate::law::Targets;
use crate::math::{Moment, mean};
use crate::metric::{diameter, target_errors};
use crate::picture::{Color, Picture, Theme};
use crate::plot::{Axis, Item, Marker, Plot};
use crate::trace::record::Frame;
use crate::world::World;
use crate::world::spec::LawSpec;

/// ε = 0.1, 0.01 and 0.001.
pub(super) const FAST: [Wanted; 3] = [
    Wanted::points("djokam-rathinam/fast-0.1", &[]),
    Wanted::points("djokam-rathinam/fast-0.01", &[]),
    Wanted::points("djokam-rathinam/fast-0.001", &[]),
];

/// ε = 0.1 near t = 0, finely.
const NEAR: Wanted = Wanted::points(
    "djokam-rathinam/fast-0.1",
    &["time.step=0.0005", "time.end=0.1", "record.every=0.0005"],
);

/// The colour of initial values in the paper.
const MAGENTA: Color = Color::hex(0xd6219c);

pub(super) const ENTRIES: [Entry; 7] = [
    Entry {
        id: "djokam-rathinam-3",
        source: "Djokam & Rathinam, Figure 3",
        caption: "The trajectories of seven agents in position and velocity space for ε = 0.1, \
                  magenta circles at their start and red stars at their end: their velocities meet \
                  at once and from then on turn as one, to that of the target.",
        wanted: &[FAST[0], NEAR],
        draw: figure_3,
    },
    Entry {
        id: "djokam-rathinam-4",
        source: "Djokam & Rathinam, Figure 4",
        caption: "The components of the positions against time for ε = 0.1, the target dashed: \
                  after some time all follow it closely.",
        wanted: &[FAST[0]],
        draw: figure_4,
    },
    Entry {
        id: "djokam-rathinam-5",
        source: "Djokam & Rathinam, Figure 5",
        caption: "The components of the velocities against time for ε = 0.1, that of the target \
                  dashed: they agree, and track it closely.",
        wanted: &[FAST[0]],
        draw: figure_5,
    },
    Entry {
        id: "djokam-rathinam-6",
        source: "Djokam & Rathinam, Figure 6",
        caption: "The components of the velocities for ε = 0.1 and t close to zero: they come to \
                  a common velocity very fast.",
        wanted: &[NEAR],
        draw: figure_6,
    },
    Entry {
        id: "djokam-rathinam-7",
        source: "Djokam & Rathinam, Figure 7",
        caption: "The largest errors of positions and of velocities with respect to the target \
                  for ε = 0.1, 0.01 and 0.001: they are alike for the three.",
        wanted: &FAST,
        draw: figure_7,
    },
    Entry {
        id: "djokam-rathinam-8-printed",
        source: "Djokam & Rathinam, Figure 8, with v^f(0) as printed in (4.25)",
        caption: "The largest differences between the full model (4.1) and its leading order \
                  (4.19), started from (4.25), for ε = 0.1, 0.01 and 0.001, of velocities from t \
                  = 10 on: those of positions decrease with ε; those of velocities fall much \
                  from ε = 0.1 to 0.01 and hardly from 0.01 to 0.001, which the paper puts down to \
                  numerical errors.",
        wanted: &FAST,
        draw: leading_order::printed,
    },
    Entry {
        id: "djokam-rathinam-8-corrected",
        source: "Djokam & Rathinam, Figure 8, with v^f(0) as the limit of the layer (4.23)",
        caption: "The same, which the paper does not show with this start: it takes v^f(0) from \
                  (4.25).",
        wanted: &FAST,
        draw: leading_order::corrected,
    },
];

fn figure_3(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let (course, near) = (courses.get(&FAST[0])?, courses.get(&NEAR)?);
    let ends = |of: Of| {
        [
            at_agents(of.all(course.first()), Marker::Ring, MAGENTA).named("start"),
            at_agents(of.all(course.last()), Marker::Star, theme.alarm).named("end"),
        ]
    };
    // The layer lasts for less than the time between two frames of the long run.
    let swift = |i: usize| {
        let late = course
            .frames
            .iter()
            .skip_while(|it| it.time <= near.last().time);
        let late = late.map(move |frame| plane_point(&frame.velocities[i]));
        let way = Of::Velocities.track(&near.frames, i).chain(late);
        Item::line(way, theme.of(i)).sized(1.2)
    };
    let mut positions = tracks(&course.frames, Of::Positions, theme);
    positions.extend(ends(Of::Positions));
    let mut velocities: Vec<Item> = (0..course.agents()).map(swift).collect();
    velocities.extend(ends(Of::Velocities));
    let plots = vec![
        plane("(a) Positions", ["x¹", "x²"], positions),
        plane("(b) Velocities", ["v¹", "v²"], velocities),
    ];
    let [first, last] = [course.first(), course.last()];
    let spread = |of: Of, frame| diameter(&of.vectors(frame));
    let finding = format!(
        "Velocities that differ by up to {} at the start differ by {} at t = {} and by {} at t = {}; \
         the flock, {} across at the start, is {} across at the end.",
        number(spread(Of::Velocities, first)),
        number(spread(Of::Velocities, near.last())),
        number(near.last().time),
        number(spread(Of::Velocities, last)),
        number(last.time),
        number(spread(Of::Positions, first)),
        number(spread(Of::Positions, last)),
    );
    Ok((finding, page(plots, 2, [520.0, 460.0], theme)))
}

fn figure_4(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&FAST[0])?;
    let target = target(&course.world)?;
    let [position, _] = late_errors(course, &target, 0.5);
    let last = course.last();
    let trailing = mean(&Of::Positions.vectors(last)) - target.at(last.time)[0].position;
    let gap = |frame: &Frame| {
        let there = target.at(frame.time)[0].position;
        let gaps = Of::Positions.vectors(frame).into_iter();
        gaps.map(move |x| (x - there).norm())
            .fold(f64::INFINITY, f64::min)
    };
    let late = in_later(course, 0.5).map(|frame| [frame.time, gap(frame)]);
    let [when, nearest] = lowest(late);
    let finding = format!(
        "In the second half no agent is more than {} from the target, whose circle has radius 10, and \
         at t = {} none more than {}, and the mean of the flock {}. The nearest that any agent comes \
         to it in that half is {}, at t = {}.",
        number(position),
        number(last.time),
        number(errors_at(last, &target)[0]),
        number(trailing.norm()),
        number(nearest),
        number(when),
    );
    Ok((finding, by_components(course, Of::Positions, theme)?))
}

fn figure_5(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&FAST[0])?;
    let [_, velocity] = late_errors(course, &target(&course.world)?, 0.5);
    let half = course.at(0.5 * course.last().time);
    let finding = format!(
        "In the second half no velocity is more than {} from that of the target, whose speed is 1; at \
         t = {} the velocities differ by {} from each other.",
        number(velocity),
        number(half.time),
        number(diameter(&Of::Velocities.vectors(half))),
    );
    Ok((finding, by_components(course, Of::Velocities, theme)?))
}

fn figure_6(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let course = courses.get(&NEAR)?;
    let spreads = course.series(|frame| diameter(&Of::Velocities.vectors(frame)));
    let agreed = spreads.iter().position(|it| *it <= 0.01 * spreads[0]);
    let when = match agreed {
        Some(k) => format!(
            "falls to a hundredth of that by t = {}",
            number(course.frames[k].time)
        ),
        None => "has not fallen to a hundredth of that by then".to_owned(),
    };
    let finding = format!(
        "Drawn to t = {}; the paper does not say how far it draws. The largest difference of two \
         velocities is {} at the start and {when}.",
        number(course.last().time),
        number(spreads[0]),
    );
    Ok((finding, by_components(course, Of::Velocities, theme)?))
}

fn figure_7(courses: &Courses, theme: &Theme) -> Result<(String, Picture), Trouble> {
    let mut plots = [
        ("(a) Positions", "max |xᵢ − y|"),
        ("(b) Velocities", "max |vᵢ − ẏ|"),
    ]
    .map(|(title, label)| against_time(title, Axis::new(label).logarithmic(), Vec::new()));
    let mut ends = [Vec::new(), Vec::new()];
    for (k, wanted) in FAST.iter().enumerate() {
        let course = courses.get(wanted)?;
        let target = target(&course.world)?;
        let name = format!("ε = {}", epsilon(&course.world));
        for (which, plot) in plots.iter_mut().enumerate() {
            let frames = course.frames.iter();
            let points = frames.map(|frame| [frame.time, errors_at(frame, &target)[which]]);
            let points: Vec<[f64; 2]> = points.collect();
            ends[which].extend(points.last().map(|point| point[1]));
            // The three lie on each other: dashes let those below be seen.
            let line = Item::line(points, theme.of(k)).named(&name);
            plot.items.push(match k {
                0 => line.sized(3.0),
                1 => line,
                _ => line.dashed(),
            });
        }
    }
    let last = courses.get(&FAST[0])?.last().time;
    let finding = format!(
        "At t = {} the errors for the three ε are {} in positions and {} in velocities.",
        number(last),
        numbers(&ends[0]),
        numbers(&ends[1]),
    );
    Ok((finding, page(plots.into(), 2, [520.0, 380.0], theme)))
}

/// Both components against time, the target dashed.
fn by_components(course: &Course, of: Of, theme: &Theme) -> Result<Picture, Trouble> {
    let target = target(&course.world)?;
    let plot = |axis: usize| -> Plot {
        let (state, goal) = match of {
            Of::Positions => ("x", "y"),
            Of::Velocities => ("v", "ẏ"),
        };
        let power = ["¹", "²"][axis];
        let letter = ["a", "b"][axis];
        let title = format!("({letter}) {state}ᵢ{power}(t) and {goal}{power}(t)");
        let dashed = course.times().into_iter().map(|t| {
            let moment = &target.at(t)[0];
            let there = match of {
                Of::Positions => moment.position,
                Of::Velocities => moment.velocity,
            };
            [t, there[axis]]
        });
        let mut items = components(&course.frames, of, axis, theme);
        items.push(Item::line(dashed, theme.ink).dashed().named("target"));
        against_time(&title, Axis::new(format!("{state}{power}")).linear(), items)
    };
    Ok(page(vec![plot(0), plot(1)], 2, [520.0, 380.0], theme))
}

/// What all agents follow.
fn target(world: &World<2>) -> Result<Targets<2>, Trouble> {
    let target = world.laws().find_map(|(scope, law)| match law {
        LawSpec::Tracking(law) => Some(Targets::of_tracking(law, scope, world)),
        _ => None,
    });
    target.ok_or_else(|| Trouble::new(&world.name, "no law follows a target"))
}

/// max |x_i − y| and max |v_i − ẏ|.
fn errors_at(frame: &Frame, target: &Targets<2>) -> [f64; 2] {
    let shared = target.at(frame.time)[0];
    let targets: Vec<Moment<2>> = vec![shared; frame.positions.len()];
    let states = [Of::Positions, Of::Velocities].map(|of| of.vectors(frame));
    target_errors(&states[0], &states[1], &targets)
}

/// The frames from a share of the run on.
fn in_later(course: &Course, share: f64) -> impl Iterator<Item = &Frame> {
    let begin = share * course.last().time;
    course
        .frames
        .iter()
        .filter(move |frame| frame.time >= begin)
}

/// The largest of these errors from a share of the run on.
fn late_errors(course: &Course, target: &Targets<2>, share: f64) -> [f64; 2] {
    let errors = in_later(course, share).map(|frame| errors_at(frame, target));
    errors.fold([0.0; 2], |most, now| {
        [0, 1].map(|k| f64::max(most[k], now[k]))
    })
}

/// ε of the world's alignment.
pub(super) fn epsilon(world: &World<2>) -> f64 {
    let epsilons = world.laws().filter_map(|(_, law)| match law {
        LawSpec::Alignment(law) => Some(law.epsilon),
        _ => None,
    });
    epsilons.fold(1.0, |_, epsilon| epsilon)
}

fn plane_point(numbers: &[f64]) -> [f64; 2] {
    numbers.try_into().unwrap_or([f64::NAN; 2])
}
