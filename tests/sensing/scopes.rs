//! Laws for some groups only.

use serde_json::{Value, json};
use volary::law::Flock;
use volary::math::Vector;
use volary::metric::measure;
use volary::world::World;

use crate::common::{headings, state};
use crate::scene::{Dice, Watch, pairs, who, world};

fn accelerations<const D: usize>(
    world: &World<D>,
    at: &[Vector<D>],
    v: &[Vector<D>],
) -> Vec<Vector<D>> {
    let mut out = vec![Vector::zeros(); at.len()];
    let mut flock = Flock::of_world(world, Vec::new());
    flock.accelerations(&state(world, 0.0, at, v, &headings(v)), &mut out);
    out
}

/// All laws, with numbers that differ from group to group.
fn laws(of: usize) -> Vec<Value> {
    let k = of as f64;
    vec![
        json!({ "alpha_interaction": { "spacing": 2.0 + k, "range": 3.0 + k } }),
        json!({ "heading_consensus": { "gain": 1.0 + k, "range": 4.0 - k, "smooth": true } }),
        json!({ "navigation": { "velocity": [k, 1, 0], "steer": "mean" } }),
        json!({ "navigation": { "destination": [9, k, 1], "feedback": "linear" } }),
        json!({ "obstacle_avoidance": {
            "range": 3, "standoff": 2.0 + 0.5 * k, "gain": 5, "gamma": { "spacing": 1 }
        } }),
    ]
}

#[test]
fn disjoint_scopes_are_worlds_of_their_own() {
    // The two groups interleave in space, and yet each moves as if the other were not there.
    let scope = |of: usize| {
        let name = format!("group {of}");
        json!({ "scope": { "agents": [&name], "neighbours": [&name], "laws": laws(of) } })
    };
    let obstacle = json!([{ "shape": { "ball": { "radius": 1 } }, "position": [4, 4, 4] }]);
    let (sensing, none) = (json!({ "field_of_view": { "angle": 2 } }), Value::Null);
    let (first, second) = (300, 350);
    for (a, b) in [(&none, &none), (&sensing, &none)] {
        let both = world::<3>(
            &[(first, a.clone()), (second, b.clone())],
            json!({ "laws": [scope(0), scope(1)], "obstacles": obstacle }),
        );
        let mut dice = Dice(9);
        let at = dice.vectors::<3>(first + second, 0.0, 14.0);
        let v = dice.vectors::<3>(first + second, -1.0, 1.0);
        let found = accelerations(&both, &at, &v);
        let mut expected = Vec::new();
        for (of, sensing, range) in [(0, a, 0..first), (1, b, first..first + second)] {
            let alone = world::<3>(
                &[(range.len(), sensing.clone())],
                json!({ "laws": laws(of), "obstacles": obstacle }),
            );
            expected.extend(accelerations(&alone, &at[range.clone()], &v[range]));
        }
        for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
            let error = (found - expected).norm();
            assert!(
                error < 1e-12 * expected.norm().max(1.0),
                "agent {i}: {error}"
            );
        }
    }
}

#[test]
fn a_scope_says_who_acts_on_whom() {
    // Group 0 flees from, or follows, group 1, which does not care.
    let world = world::<2>(
        &[(10, Value::Null), (5, Value::Null), (10, Value::Null)],
        json!({ "laws": [
            { "scope": { "agents": ["group 0", "group 2"], "neighbours": ["group 1"], "laws": [
                { "alpha_interaction": { "protocol": "nonsmooth", "spacing": 4, "range": 6, "damping": 0 } }
            ] } },
            { "scope": { "agents": ["group 1"], "laws": [{ "navigation": { "velocity": [1, 2] } }] } },
            { "scope": { "neighbours": ["group 2"], "laws": [
                { "heading_consensus": { "range": 5 } }
            ] } },
            { "navigation": { "velocity": [0, 3] } }
        ] }),
    );
    let mut dice = Dice(21);
    let (at, v) = (
        dice.vectors::<2>(25, 0.0, 9.0),
        dice.vectors::<2>(25, -1.0, 1.0),
    );
    let u = headings(&v);
    let by_law = Flock::of_world(&world, Vec::new()).by_law(&state(&world, 0.0, &at, &v, &u));
    let names: Vec<_> = by_law.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        [
            "alpha_interaction(group 0+group 2<-group 1)",
            "navigation(group 1<-*)",
            "heading_consensus(*<-group 2)",
            "navigation"
        ]
    );
    let pair = world
        .alpha_interaction()
        .expect("the first, in its scope")
        .pair();
    let mut pushed = 0;
    for i in 0..25 {
        let mut expected = Vector::<2>::zeros();
        for j in (10..15).filter(|_| i / 5 != 2) {
            let way = at[j] - at[i];
            if way.norm() <= 6.0 {
                expected += way.normalize() * pair.force(way.norm());
            }
        }
        assert!((by_law[0].1[i] - expected).norm() < 1e-12);
        pushed += usize::from(expected.norm() > 0.0);
        let steered = by_law[1].1[i].norm() > 0.0;
        assert_eq!(steered, (10..15).contains(&i));
        assert!(by_law[3].1[i].norm() > 0.0);
        // Turned by group 2 alone.
        let angle = |u: &Vector<2>| u[1].atan2(u[0]);
        let mut rate = 0.0;
        for j in (15..25).filter(|&j| j != i && (at[j] - at[i]).norm() <= 5.0) {
            let by = angle(&u[j]) - angle(&u[i]);
            rate += by.sin().atan2(by.cos());
        }
        let left = Vector::<2>::new(-u[i][1], u[i][0]) * v[i].norm();
        assert!((by_law[2].1[i] - left * rate).norm() < 1e-12);
    }
    assert!(pushed > 10);
    // Perception does not depend on scopes.
    let links = pairs(25, |i, j| (at[j] - at[i]).norm() <= 7.0);
    let told = Watch::new(&world, 7.0).look(&state(&world, 0.0, &at, &v, &u));
    assert_eq!(who(&told), links);
}

#[test]
fn each_group_is_measured_by_its_own_target() {
    let scope = |name: &str, velocity: [f64; 2]| json!({ "scope": { "agents": [name], "laws": [{ "navigation": { "velocity": velocity } }] } });
    let targets = [[1.0, 2.0], [-3.0, 0.0]].map(Vector::<2>::from);
    let world = world::<2>(
        &[(3, Value::Null), (2, Value::Null)],
        json!({ "laws": [scope("group 0", [1.0, 2.0]), scope("group 1", [-3.0, 0.0])] }),
    );
    assert_eq!(world.navigation_velocities()[0], Some(targets[0]));
    assert_eq!(world.navigation_velocities()[1], Some(targets[1]));
    let mut v: Vec<_> = world
        .agents
        .group
        .iter()
        .map(|&group| targets[group])
        .collect();
    let mismatch = |v: &[Vector<2>]| {
        let snapshot = volary::dynamics::Snapshot {
            step: 0,
            time: 0.0,
            positions: &world.agents.positions,
            velocities: v,
            headings: &headings(v),
            obstacles: &world.obstacles,
            rotations: None,
            spins: None,
        };
        measure(&world, &snapshot).velocity_mismatch
    };
    assert_eq!(mismatch(&v), 0.0);
    v[4][1] = 5.0;
    assert!((mismatch(&v) - 5f64.sqrt()).abs() < 1e-15);
}

#[test]
fn guidance_follows_the_navigation_of_its_own_agents() {
    let avoid = json!({ "obstacle_avoidance": {
        "range": 3, "standoff": 2, "gain": 5, "gamma": { "spacing": 1 }
    } });
    let scope = |names: &[&str], laws: Value| json!({ "scope": { "agents": names, "laws": laws } });
    let steer = |x: f64| json!({ "navigation": { "velocity": [x, 1] } });
    let world = world::<2>(
        &[(1, Value::Null), (1, Value::Null)],
        json!({ "laws": [
            scope(&["group 1"], json!([avoid])),
            scope(&["group 0"], json!([avoid, steer(7.0)])),
            scope(&["group 1", "group 0"], json!([steer(8.0)])),
            avoid
        ] }),
    );
    let directions: Vec<_> = (world.laws())
        .filter_map(|(_, law)| match law {
            volary::world::spec::LawSpec::ObstacleAvoidance(law) => law.gamma.clone()?.direction,
            _ => None,
        })
        .collect();
    assert_eq!(directions, [[8.0, 1.0], [7.0, 1.0], [8.0, 1.0]]);
}
