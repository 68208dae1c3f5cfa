//! The claims of others that the paper quotes.

use serde_json::json;
use volary::claim::Verdict;
use volary::math::Vector;
use volary::world::World;

use super::{exclusion, from, quantity};
use crate::common::{spec, world};
use crate::runs::{doctored, finding, holds, plane, points, unmet, violated};

/// Cucker & Dong's world, in which d0 and its root are on either side of 1.
fn repelling(squared: f64, gap: f64, speed: f64, beta: f64) -> World<2> {
    world(spec(json!({
        "dimension": 2,
        "time": { "step": 0.01, "end": 30 },
        "record": { "every": 0.1 },
        "agents": [{
            "radius": 0.1,
            "positions": { "explicit": [[0, 0], [gap, 0.1], [2.0 * gap, -gap]] },
            "velocities": { "explicit": [[speed, 0], [-speed, 0], [0, 0.3]] }
        }],
        "laws": [
            { "alignment": { "kernel": { "cucker_smale": { "strength": 1, "exponent": beta } } } },
            { "cucker_dong": { "strength": 0.5, "exponent": 1.5, "squared_distance": squared } }
        ]
    })))
}

#[test]
fn repulsion_keeps_the_root_of_what_is_printed() {
    let world = repelling(4.0, 4.5, 3.0, 0.4);
    let run = points(&world);
    let finding = violated("song-2013/cucker-dong-distance-printed", &run);
    assert!(finding.closest.is_some_and(|time| time > 0.1 && time < 5.0));
    holds("song-2013/cucker-dong-distance-corrected", &run);
    let finding = holds("song-2013/cucker-dong-distance-sharpened", &run);
    assert!(quantity(&finding, "distance that theory keeps") > 2.0);
    assert_eq!(
        exclusion("song-2013/cucker-dong-distance-printed", &run),
        None
    );
    let root = exclusion("song-2013/cucker-dong-distance-corrected", &run);
    assert_eq!(root.map(|it| it.distance), Some(2.0));
    holds("song-2013/cucker-dong-velocity-consensus", &run);

    let near = doctored(&world, |k, (_, x, _)| {
        if k == 20 {
            x[0] = x[1] + Vector::<2>::new(2.0, 0.0);
        }
    });
    violated("song-2013/cucker-dong-distance-corrected", &near);
    violated("song-2013/cucker-dong-distance-sharpened", &near);
    let frozen = doctored(&world, |_, (_, _, v)| {
        v.clone_from(&world.agents.velocities);
    });
    violated("song-2013/cucker-dong-velocity-consensus", &frozen);

    // Below 1 the print promises less than there is.
    let world = plane("song-2013/cucker-dong", &["time.end=3"]);
    let run = points(&world);
    holds("song-2013/cucker-dong-distance-printed", &run);
    holds("song-2013/cucker-dong-distance-corrected", &run);

    // No β is too large for the distance.
    let world = repelling(0.5, 2.0, 5.0, 2.0);
    let run = points(&world);
    unmet("song-2013/cucker-dong-distance-corrected", &run);
    unmet("song-2013/cucker-dong-velocity-consensus", &run);
    holds("song-2013/cucker-dong-distance-sharpened", &run);
}

#[test]
fn bonds_with_damping_hold_a_flock_together() {
    let set = ["time.end=60", "record.every=0.25"];
    let world = plane("song-2013/park", &set);
    let run = points(&world);
    holds("song-2013/park-cohesion-sharpened", &run);
    let finding = finding("song-2013/park-cohesive-flocking", &run);
    assert_ne!(finding.verdict, Verdict::Violated);
    let end = "time.end=300";
    let longer = plane("song-2013/park", &[end, "record.every=1"]);
    holds("song-2013/park-cohesive-flocking", &points(&longer));

    let far = doctored(&world, from(1.0, |(t, x, _)| x[0] *= 1.0 + *t));
    violated("song-2013/park-cohesion-sharpened", &far);
    violated("song-2013/park-cohesive-flocking", &far);
    let cut = plane(
        "song-2013/park",
        &["time.end=1", "laws[1].park_bonding.range=4"],
    );
    unmet("song-2013/park-cohesive-flocking", &points(&cut));
}
