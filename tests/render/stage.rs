//! Small worlds with frames made by hand, so that pictures depend on nothing else.

use serde_json::{Value, json};
use volary::math::Vector;
use volary::picture::{Mark, Pixels};
use volary::render::{Eye, Look, Moment, Scene, Survey};
use volary::shape::{Geometry, In};
use volary::trace::record::{Contact, Frame, ObstaclePose, Partner, Record};
use volary::world::World;
use volary::world::spec::Rotation;

use crate::common::{spec, world};

/// A world of some agents and obstacles.
pub fn world_of<const D: usize>(agents: Value, obstacles: Value) -> World<D>
where
    In<D>: Geometry<D>,
{
    world(spec(json!({
        "dimension": D,
        "time": { "end": 1 },
        "agents": agents,
        "obstacles": obstacles,
    })))
}

/// Balls of one radius at these places.
pub fn balls<const D: usize>(radius: f64, places: &[Vector<D>]) -> World<D>
where
    In<D>: Geometry<D>,
{
    let places: Vec<Vec<f64>> = places.iter().map(|it| it.as_slice().to_vec()).collect();
    let agents = json!([{ "radius": radius, "positions": { "explicit": places } }]);
    world_of(agents, json!([]))
}

/// A frame with the agents of a world where they start, all of this velocity.
pub fn frame<const D: usize>(world: &World<D>, time: f64, velocity: &[f64]) -> Frame {
    Frame {
        time,
        positions: world
            .agents
            .positions
            .iter()
            .map(|it| it.as_slice().to_vec())
            .collect(),
        velocities: vec![velocity.to_vec(); world.agents.len()],
        ..Frame::default()
    }
}

/// A moment of a world whose only frame it is, painted on a page of this size.
pub fn bare<const D: usize>(world: &World<D>, frame: &Frame, look: Look, size: [f64; 2]) -> Pixels
where
    In<D>: Eye<D>,
{
    let survey = Survey::of(world, [&Record::Frame(frame.clone())]).expect("the frame fits");
    let scene = Scene::new(world, &survey, look);
    let picture = scene.bare(&Moment::new(frame.clone()), size);
    picture.paint().expect("the picture can be painted")
}

/// Centres and radii of all disks of some marks, as they stand on the page.
pub fn disks(marks: &[Mark]) -> Vec<([f64; 2], f64)> {
    let mut found = Vec::new();
    for mark in marks {
        match mark {
            Mark::Disk { center, radius, .. } => found.push((*center, *radius)),
            Mark::Group { corner, marks, .. } => {
                let inner = disks(marks).into_iter();
                found
                    .extend(inner.map(|([x, y], radius)| ([x + corner[0], y + corner[1]], radius)));
            }
            _ => {}
        }
    }
    found
}

/// The plane with all that can be drawn in it.
pub fn plane() -> (World<2>, Vec<Record>) {
    let world: World<2> = world(spec(json!({
        "dimension": 2,
        "time": { "end": 1 },
        "agents": [
            { "name": "disks", "radius": 1, "positions": { "explicit": [[0, 0], [4, 0], [2, 3]] },
              "sensing": { "field_of_view": { "angle": 0.6 }, "radius": 4 } },
            { "name": "rods", "shape": { "capsule": { "half_length": 1, "radius": 0.4 } },
              "positions": { "explicit": [[0, 6], [5, 6]] } }
        ],
        "obstacles": [
            { "shape": { "ball": { "radius": 1.5 } }, "position": [9, 0] },
            { "shape": { "cuboid": { "half_extents": [1, 0.5] } }, "position": [9, 4],
              "motion": { "drift": { "velocity": [0, 1] } } },
            { "shape": { "convex": { "points": [[0, 0], [2, 0], [1, 2]] } }, "position": [8, 7] },
            { "shape": { "capsule": { "from": [-1, 0], "to": [1, 0], "radius": 0.3 } },
              "position": [0, -4] },
            { "shape": { "polyline": { "points": [[4, -4], [6, -3], [8, -4]] } } },
            { "shape": { "half_space": { "normal": [0, 1] } }, "position": [0, -6] }
        ],
        "laws": [
            { "alpha_interaction": { "spacing": 4, "range": 5 } },
            { "obstacle_avoidance": { "range": 3, "standoff": 2, "gain": 1,
                "gamma": { "spacing": 2, "direction": [1, 0] } } },
            { "tracking": { "target": { "line": { "start": [0, 9], "velocity": [5, 0] } },
                "velocity_gain": 1, "position_gain": 1 } }
        ],
    })));
    let mut first = frame(&world, 0.0, &[1.0, 0.5]);
    first.rotations = Some([0.0, 0.0, 0.0, 0.5, -0.8].map(Rotation::Angle).to_vec());
    first.blocked = Some(vec![[0, 4]]);
    first.obstacles = Some(vec![ObstaclePose {
        obstacle: 1,
        position: vec![9.0, 4.0],
        rotation: Rotation::Angle(0.4),
    }]);
    let mut second = first.clone();
    second.time = 1.0;
    for position in &mut second.positions {
        position[0] += 1.0;
    }
    let contact = Contact {
        agent: 1,
        with: Partner::Obstacle,
        other: 0,
        begin: 0.5,
        end: 0.6,
        open: false,
        steps: 1,
        blow: 1.0,
        blows: 1,
        impulse: 1.0,
        largest_impulse: 1.0,
        mean_force: None,
        friction: 0.0,
        deepest_penetration: 0.0,
        approach_speed: 1.0,
        push_speed: 0.0,
        position: vec![6.5, 0.0],
    };
    let records = [
        Record::Frame(first),
        Record::Frame(second),
        Record::Contact(contact),
    ];
    (world, records.to_vec())
}

/// Space with a shape of each kind.
pub fn space() -> (World<3>, Vec<Record>) {
    let agents = json!([{ "radius": 0.6, "positions": {
        "explicit": [[0, 0, 3], [2, 1, 4], [4, -1, 3], [3, 3, 3]] } }]);
    let obstacles = json!([
        { "shape": { "ball": { "radius": 1.5 } }, "position": [7, 0, 3] },
        { "shape": { "cuboid": { "half_extents": [0.5, 2, 1] } }, "position": [10, 3, 3] },
        { "shape": { "capsule": { "from": [0, 0, -2], "to": [0, 0, 2], "radius": 0.5 } },
          "position": [4, 5, 3] },
        { "shape": { "heightfield": { "width": 14, "depth": 10,
            "heights": [[0, 0.5, 0, 0.2], [0.3, 1, 0.4, 0], [0, 0.4, 0.2, 0.5]] } },
          "position": [5, 1, 0] },
        { "shape": { "half_space": { "normal": [0, 0, 1] } }, "position": [0, 0, -0.5] }
    ]);
    let world = world_of(agents, obstacles);
    let frame = frame(&world, 0.0, &[1.0, 0.5, 0.0]);
    (world, vec![Record::Frame(frame)])
}
