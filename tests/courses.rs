//! The courses and mixtures do what their notes say, on their first seed.

use std::convert::Infallible;
use std::ops::ControlFlow;

use rayon::prelude::*;
use volary::dynamics::{Engine, Snapshot};
use volary::shape::In;
use volary::simulation::Simulation;
use volary::trace::record::{Outcome, Summary};
use volary::world::{AnyWorld, Document, World, shipped};

/// What a run of a course comes to.
#[derive(Debug)]
struct Run {
    /// Agents that got past the goal.
    reached: usize,
    agents: usize,
    summary: Summary,
}

fn load(name: &str) -> AnyWorld {
    let text = shipped::get(name).expect("it is shipped");
    Document::new(name, text).world(name).expect("it is sound")
}

fn to_the_end<const D: usize>(
    world: World<D>,
    mut passes: impl FnMut(&Snapshot<'_, D>, usize) -> bool,
) -> Run
where
    In<D>: Engine<D>,
{
    let agents = world.agents.len();
    let mut reached = vec![false; agents];
    let mut simulation = Simulation::new(world).expect("a finite start");
    let summary = simulation.run(
        |_| Ok::<_, Infallible>(()),
        |state| {
            for (i, reached) in reached.iter_mut().enumerate() {
                *reached |= passes(state, i);
            }
            ControlFlow::Continue(())
        },
    );
    Run {
        reached: reached.into_iter().filter(|it| *it).count(),
        agents,
        summary: summary.expect("recording cannot fail"),
    }
}

/// Runs a course; its goal is to get past a place along the first axis.
fn course(name: &str, goal: f64) -> Run {
    let run = match load(name) {
        AnyWorld::Plane(world) => to_the_end(world, |state, i| state.positions[i][0] > goal),
        AnyWorld::Space(world) => to_the_end(world, |state, i| state.positions[i][0] > goal),
    };
    assert_eq!(run.summary.outcome, Outcome::Completed, "{name}");
    run
}

#[test]
fn solved_courses_are_solved() {
    let courses = [
        ("courses/slalom", 290.0),
        ("courses/forest", 250.0),
        ("courses/corridor", 330.0),
        ("courses/funnel-and-door", 140.0),
        ("courses/moving-gates", 230.0),
        ("courses/rotating-door", 140.0),
        ("courses/shepherds-wall", 200.0),
        ("courses/rods", 140.0),
        ("courses/rings", 240.0),
        ("courses/pillars", 240.0),
        ("courses/drifting-spheres", 240.0),
        ("mixtures/masked-forest", 250.0),
        ("mixtures/tracking-through-gates", 190.0),
        ("mixtures/line-through-door", 92.0),
    ];
    courses.par_iter().for_each(|&(name, goal)| {
        let run = course(name, goal);
        assert_eq!(run.reached, run.agents, "{name}");
        assert_eq!(run.summary.obstacle_contacts.episodes, 0, "{name}");
    });
}

#[test]
fn a_wall_across_the_way_stops_the_flock() {
    let run = course("courses/maze", 200.0);
    assert_eq!(run.reached, 0);
    assert!(run.summary.last.velocity_mismatch > 9.0, "{run:?}");
}

#[test]
fn friction_jams_the_door() {
    let run = course("courses/escape-panic", 43.0);
    assert!((5..50).contains(&run.reached), "{}", run.reached);
    // The crowd stands, pressed together.
    assert!(run.summary.last.agent_gap < Some(0.0), "{run:?}");
    assert!(run.summary.force_cuts > 0);
}

#[test]
fn crossing_flocks_get_through_and_touch() {
    let AnyWorld::Plane(world) = load("courses/crossing-flocks") else {
        panic!("it is flat");
    };
    let group = world.agents.group.clone();
    let run = to_the_end(world, |state, i| state.positions[i][group[i]] > 80.0);
    assert_eq!(run.reached, run.agents);
    assert_eq!(run.summary.last.density, Some(0.5), "two flocks as before");
    assert!(run.summary.agent_contacts.episodes > 20, "{run:?}");
}
