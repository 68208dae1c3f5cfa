//! The analysis as frames carry it.

use std::ops::ControlFlow;

use serde_json::{Value, json};
use volary::law::{Flock, State, build};
use volary::math::{Vector, axis};
use volary::net::{neighborhood, votes};
use volary::simulation::Simulation;
use volary::trace::record::{Frame, Record};
use volary::world::World;

fn world(law: &Value, record: &Value) -> World<2> {
    let spec = json!({
        "dimension": 2,
        "time": { "step": 0.01, "end": 2 },
        "seed": 3,
        "record": record,
        "agents": [{
            "count": 25, "radius": 0.1,
            "positions": { "box": { "min": [0, 0], "max": [9, 9], "separation": 0.5 } },
            "velocities": { "uniform": { "min": [-2, -2], "max": [2, 2] } }
        }],
        "laws": [law]
    });
    let spec = serde_json::from_value(spec).expect("the world is well formed");
    World::new("test", spec).expect("the world is sound")
}

fn frames(world: World<2>) -> Vec<Frame> {
    let mut frames = Vec::new();
    Simulation::new(world)
        .expect("it starts")
        .run(
            |record| {
                if let Record::Frame(frame) = record {
                    frames.push(frame);
                }
                Ok::<_, std::convert::Infallible>(())
            },
            |_| ControlFlow::Continue(()),
        )
        .expect("nothing fails");
    frames
}

#[test]
fn frames_carry_the_analysis_where_it_is_asked_for() {
    for (protocol, smooth) in [
        ("nonsmooth", false),
        ("smooth", true),
        ("approximate", true),
    ] {
        let law = json!({ "alpha_interaction": {
            "protocol": protocol, "spacing": 2, "range": 2.6, "damping": 0.1
        } });
        assert!(
            frames(world(&law, &json!({})))
                .iter()
                .all(|frame| frame.net.is_none())
        );
        let record = json!({ "net": true, "edges": true, "every": 0.5 });
        let frames = frames(world(&law, &record));
        assert_eq!(frames.len(), 5);
        let mut before: Option<Vec<[usize; 2]>> = None;
        for frame in frames {
            let net = frame.net.expect("asked for");
            let edges = frame.edges.expect("asked for");
            let metrics = frame.metrics.expect("on by default");
            assert_eq!(net.edges, edges.len());
            assert_eq!(Some(net.components), metrics.components);
            assert_eq!(Some(net.density), metrics.density);
            assert_eq!(Some(net.largest), metrics.largest_component);
            assert_eq!(Some(net.smallest), metrics.smallest_component);
            let energy = if smooth {
                net.smooth_structural_energy
            } else {
                net.structural_energy
            };
            assert_eq!(energy, metrics.structural_energy);
            assert_eq!(net.positive_votes + net.negative_votes + net.zero_votes, 25);
            assert_eq!(
                net.algebraic_connectivity.map(|l| l > 0.0),
                Some(net.components == 1)
            );
            assert_eq!(
                net.connectivity,
                net.algebraic_connectivity.map(|l| l / 25.0)
            );
            assert!(net.balanced && net.smooth_potential <= net.potential);
            assert_eq!(net.rigid, net.freedoms == 0);
            assert!(net.planar || net.crossings > Some(0));
            let change = before.as_ref().map(|old| {
                let gone = old.iter().filter(|edge| !edges.contains(edge)).count();
                let new = edges.iter().filter(|edge| !old.contains(edge)).count();
                (new, gone)
            });
            assert_eq!(net.links_created.zip(net.links_lost), change);
            before = Some(edges);
        }
    }
}

#[test]
fn a_world_without_a_net_has_no_analysis() {
    let law = json!({ "navigation": { "velocity": [1, 0] } });
    for frame in frames(world(&law, &json!({ "net": true }))) {
        assert!(frame.net.is_none());
        let metrics = frame.metrics.expect("on by default");
        assert!(metrics.union.is_none() && metrics.cluster_correlation.is_none());
        assert!(metrics.order.is_some() && metrics.safety == Some(1.0));
        assert!(metrics.obstacle_safety.is_none());
    }
}

#[test]
fn the_vote_is_the_protocol_without_damping() {
    // Olfati-Saber (2003), (39) and (34) with c1 = 0.
    let law = json!({ "alpha_interaction": {
        "protocol": "nonsmooth", "spacing": 2, "range": 3, "damping": 0
    } });
    let world = world(&law, &json!({}));
    let (positions, velocities) = (&world.agents.positions, &world.agents.velocities);
    let mut acceleration = vec![Vector::zeros(); positions.len()];
    Flock::new(build(&world)).accelerations(
        &State {
            time: 0.0,
            positions,
            velocities,
            headings: &vec![axis(0); positions.len()],
            groups: &world.agents.group,
            masses: &world.agents.mass,
            rotations: &world.agents.rotations,
            obstacles: &world.obstacles,
        },
        &mut acceleration,
    );
    let pair = world.alpha_interaction().expect("it has one").pair();
    let votes = votes(
        positions,
        &neighborhood::uniform(positions, pair.range),
        &pair,
    );
    for (vote, asked) in votes.iter().zip(&acceleration) {
        assert!((vote.acceleration - asked).norm() < 1e-12);
    }
    assert!(acceleration.iter().any(|a| a.norm() > 0.1));
}
