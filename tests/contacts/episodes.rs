//! What an episode tells: when, how hard, how long, how often.

use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::shape::In;
use volary::trace::record::{Contact, Summary};

use crate::run;

/// The same vectors with zeros behind, in space.
fn vectors(dimension: usize, list: &[[f64; 2]]) -> Value {
    let pad = |v: &[f64; 2]| {
        let mut v = v.to_vec();
        v.resize(dimension, 0.0);
        v
    };
    json!(list.iter().map(pad).collect::<Vec<_>>())
}

/// Bodies of these radii and masses.
fn bodies<const D: usize>(
    step: f64,
    end: f64,
    restitution: f64,
    each: [(f64, f64, [f64; 2], [f64; 2]); 2],
) -> (Vec<Contact>, Summary)
where
    In<D>: Engine<D>,
{
    let groups: Vec<_> = each
        .iter()
        .map(|(radius, mass, position, velocity)| {
            json!({
                "radius": radius, "mass": mass,
                "positions": { "explicit": vectors(D, &[*position]) },
                "velocities": { "explicit": vectors(D, &[*velocity]) }
            })
        })
        .collect();
    let (contacts, summary, _) = run::<D>(json!({
        "dimension": D, "time": { "step": step, "end": end }, "record": { "every": end },
        "physics": { "restitution": restitution },
        "agents": groups
    }));
    (contacts, summary)
}

fn close(value: f64, right: f64) -> bool {
    (value - right).abs() < 1e-9
}

/// Masses 1 and 3 meet at speed 1 at time 0.50629, and stay together.
fn unequal<const D: usize>(step: f64, restitution: f64) -> (Vec<Contact>, Summary)
where
    In<D>: Engine<D>,
{
    let each = [
        (0.5, 1.0, [0.0, 0.0], [0.6, 0.0]),
        (0.5, 3.0, [1.50629, 0.0], [-0.4, 0.0]),
    ];
    bodies::<D>(step, 2.5, restitution, each)
}

fn inelastic<const D: usize>()
where
    In<D>: Engine<D>,
{
    for step in [0.01, 0.001] {
        let (contacts, summary) = unequal::<D>(step, 0.0);
        assert_eq!(contacts.len(), 1, "{contacts:?}");
        let contact = &contacts[0];
        assert!(close(contact.begin, 0.50629), "{contact:?}");
        assert!(close(contact.end, 2.5) && contact.open, "{contact:?}");
        assert!(close(contact.approach_speed, 1.0), "{contact:?}");
        assert!(close(contact.blow, 0.75), "{contact:?}");
        assert_eq!(contact.blows, 1, "{contact:?}");
        assert!(close(contact.impulse, 0.75), "{contact:?}");
        assert!(close(contact.friction, 0.0), "{contact:?}");
        let mean = contact.mean_force.expect("they stay together");
        assert!(close(mean, 0.75 / (2.5 - 0.50629)), "{contact:?}");
        let counted = &summary.agent_contacts;
        assert_eq!((counted.episodes, counted.pairs), (1, 1));
        assert!(close(counted.largest_blow, 0.75) && close(counted.impulse, 0.75));
        assert!(
            close(counted.longest_duration, 2.5 - 0.50629),
            "{counted:?}"
        );
    }
}

#[test]
fn an_inelastic_hit_is_one_episode_with_its_blow() {
    inelastic::<2>();
    inelastic::<3>();
}

fn bounce<const D: usize>()
where
    In<D>: Engine<D>,
{
    for step in [0.01, 0.001] {
        let (contacts, summary) = unequal::<D>(step, 1.0);
        assert_eq!(contacts.len(), 1, "{contacts:?}");
        let contact = &contacts[0];
        assert!(close(contact.begin, 0.50629), "{contact:?}");
        assert_eq!((contact.begin, contact.open), (contact.end, false));
        assert_eq!((contact.steps, contact.mean_force), (1, None));
        assert!(
            close(contact.blow, 1.5) && contact.blows == 1,
            "{contact:?}"
        );
        assert_eq!(contact.impulse, contact.blow);
        assert_eq!(summary.agent_contacts.longest_duration, 0.0);
    }
}

#[test]
fn a_bounce_takes_no_time() {
    bounce::<2>();
    bounce::<3>();
}

/// Rounding parts these by ±1e-16 from step to step, and presses them by 1e-17.
#[test]
fn what_stays_together_is_counted_once() {
    let each = [
        (
            0.5,
            1.0,
            [0.0, 0.0],
            [0.11633783280778306, -0.19107136264298433],
        ),
        (
            0.8,
            2.0,
            [0.7349964134385664, -1.2071461438124527],
            [-0.17450674921167456, 0.28660704396447645],
        ),
    ];
    for step in [0.01, 0.001] {
        let (contacts, summary) = bodies::<2>(step, 2.3, 0.0, each);
        assert_eq!(contacts.len(), 1, "{contacts:?}");
        assert_eq!(summary.agent_contacts.episodes, 1);
        assert!(contacts[0].open, "{contacts:?}");
    }
}

/// Gaps as they are when bodies pass, not at the frames or steps next to it.
#[test]
fn bodies_that_pass_tell_how_near_they_came() {
    let each = [
        (0.1, 1.0, [-2.54, 0.0], [10.0, 0.0]),
        (0.1, 1.0, [2.54, 0.23], [-10.0, 0.0]),
    ];
    for step in [0.1, 0.01] {
        let (contacts, summary) = bodies::<2>(step, 1.0, 0.0, each);
        assert!(contacts.is_empty(), "{contacts:?}");
        let gap = summary.smallest_agent_gap.expect("there are two");
        assert!(close(gap, 0.03), "{gap}");
        let who = summary.closest_agents.expect("they are known");
        assert_eq!((who.agent, who.other), (0, 1));
        assert!((who.time - 0.254).abs() < 1e-6, "{who:?}");
        // Each goes 10 steps' lengths of its radius.
        let travel = 10.0 * step / 0.1;
        assert!(close(summary.strain.travel, travel), "{:?}", summary.strain);
    }
}

/// A ball lands with its blow, and its weight is the mean force from then on.
#[test]
fn who_rests_presses_with_its_weight() {
    let (contacts, summary, _) = run::<2>(json!({
        "dimension": 2, "time": { "step": 0.001, "end": 9 }, "record": { "every": 9 },
        "physics": { "gravity": [0, -2] },
        "agents": [{ "radius": 0.5, "mass": 3, "positions": { "explicit": [[0, 1.5]] } }],
        "obstacles": [{ "shape": { "half_space": { "normal": [0, 1] } } }]
    }));
    assert_eq!(contacts.len(), 1, "{contacts:?}");
    let contact = &contacts[0];
    // A fall of 1 at 2 takes 1, and ends at speed 2.
    assert!((contact.begin - 1.0).abs() < 1e-6, "{contact:?}");
    assert!((contact.blow - 6.0).abs() < 0.01, "{contact:?}");
    assert!(
        (contact.impulse - (6.0 + 8.0 * 6.0)).abs() < 0.05,
        "{contact:?}"
    );
    assert!(contact.open && (contact.end - 9.0).abs() < 1e-9);
    assert_eq!(contact.friction, 0.0);
    assert_eq!(summary.obstacle_contacts.episodes, 1);
}

/// A ball slides on a floor until friction has set it rolling: the friction is what it lost.
#[test]
fn friction_is_what_slows() {
    let (contacts, _, _) = run::<2>(json!({
        "dimension": 2, "time": { "step": 0.001, "end": 5 }, "record": { "every": 5 },
        "physics": { "gravity": [0, -2], "friction": 0.25 },
        "agents": [{
            "radius": 0.5, "mass": 3, "positions": { "explicit": [[0, 0.5]] },
            "velocities": { "explicit": [[1.5, 0]] }
        }],
        "obstacles": [{ "shape": { "half_space": { "normal": [0, 1] } } }]
    }));
    assert_eq!(contacts.len(), 1, "{contacts:?}");
    let contact = &contacts[0];
    // A disk rolls at two thirds of the speed that it slid with.
    assert!((contact.friction - 3.0 * 0.5).abs() < 0.02, "{contact:?}");
    assert!(
        (contact.impulse - 3.0 * 2.0 * 5.0).abs() < 0.05,
        "{contact:?}"
    );
}

/// Boxes that turn about the corners of a funnel, stopped there again and again, are followed to the
/// end of each step.
#[test]
fn who_turns_at_a_corner_is_followed_to_the_end_of_the_step() {
    let (contacts, summary, _) = run::<2>(json!({
        "dimension": 2, "seed": 3, "time": { "step": 0.01, "end": 8 }, "record": { "every": 8 },
        "physics": { "friction": 0.3, "restitution": 0 },
        "agents": [{
            "count": 24, "shape": { "cuboid": { "half_extents": [0.4, 0.25] } },
            "positions": { "box": { "min": [0, -4], "max": [10, 4], "separation": 0.3 } }
        }],
        "obstacles": [
            { "shape": { "polyline": { "points": [[14, -8], [16, -2], [18, -1.2]] } } },
            { "shape": { "polyline": { "points": [[14, 8], [16, 2], [18, 1.2]] } } }
        ],
        "laws": [{ "navigation": { "velocity": [2, 0], "velocity_gain": 2 } }]
    }));
    assert!(contacts.len() > 20, "{}", contacts.len());
    assert_eq!(summary.strain.unordered, 0);
}
