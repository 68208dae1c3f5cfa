//! A small trace, and short ways to write and read it.

use std::io::{Cursor, Write};
use std::path::Path;

use serde_json::json;
use volary::trace::record::*;
use volary::trace::{Format, TraceError, TraceReader, TraceWriter};
use volary::world::spec::Rotation;

pub const NAMES: [&str; 6] = [
    "t.jsonl",
    "t.json",
    "t.jsonl.gz",
    "t.json.gz",
    "t.ndjson.zst",
    "t.json.zst",
];

pub fn format(name: &str) -> Format {
    Format::of(Path::new(name)).unwrap()
}

/// A header whose strings try to look like the end of a record.
pub fn header() -> Header {
    let world = json!({
        "description": "}]\n, \"quoted\\\" {[ é",
        "dimension": 2,
        "time": {"step": 0.01, "end": 1},
        "agents": [{"count": 2, "radius": 0.1, "mass": [1.0, 2.5], "force_limit": 3.0,
            "positions": {"box": {"min": [0, 0], "max": [1, 1]}}}],
        "laws": [{"alpha_interaction": {"spacing": 1.0, "range": 1.2}}],
    });
    Header {
        format: FORMAT.to_owned(),
        version: VERSION,
        program: "volary".to_owned(),
        dynamics: "bodies".to_owned(),
        solver: None,
        name: "a \\ \"world\"".to_owned(),
        world: serde_json::from_value(world).unwrap(),
        bodies: Bodies {
            group: vec![0, 0],
            radius: vec![0.1, 0.1],
            mass: vec![1.0, 2.5],
            force_limit: vec![Some(3.0), None],
        },
    }
}

pub fn metrics() -> Metrics {
    Metrics {
        components: Some(1),
        density: Some(1.0),
        edges: Some(1),
        structural_energy: Some(0.25),
        polarization: 0.5,
        velocity_mismatch: 0.125,
        agent_gap: Some(-0.5),
        obstacle_gap: Some(1e-300),
        smallest_agent_gap: Some(-0.75),
        smallest_obstacle_gap: None,
        position_diameter: 2.0,
        velocity_diameter: 3.0,
        largest_component: Some(2),
        smallest_component: Some(2),
        union: Some(1.0),
        deviation_energy: Some(0.0625),
        order: Some(-0.75),
        cluster_correlation: Some(1e-9),
        milling: None,
        rotation: Some(0.3),
        collision_ratio: Some(1.0),
        safety: Some(0.0),
        obstacle_safety: None,
    }
}

pub fn net() -> NetRecord {
    NetRecord {
        edges: 1,
        density: 1.0,
        balanced: true,
        algebraic_connectivity: Some(2.0),
        potential: Some(0.1),
        crossings: Some(0),
        links_lost: Some(3),
        ..NetRecord::default()
    }
}

fn laws() -> LawsRecord {
    LawsRecord {
        mean_position: vec![0.1, -0.0],
        mean_velocity: vec![1.0, 2.0],
        mass_center: vec![5e-324, 3.0],
        mass_velocity: vec![0.0, 0.5],
        largest_kinetic_energy: 4.5,
        potential: None,
        energy: None,
        total_energy: Some(0.25),
        steering_diameter: 0.0,
        laws: vec![LawRecord {
            law: "own".to_owned(),
            influence: Some(InfluenceRecord {
                least: 0.1,
                active: Some(2),
                imbalance: 0.0,
                connectivity: None,
            }),
            ..LawRecord::default()
        }],
    }
}

pub fn frame(step: u64) -> Frame {
    Frame {
        step,
        time: step as f64 * 0.1,
        positions: vec![vec![0.1, 0.2], vec![1.2345, -0.0]],
        velocities: vec![vec![5e-324, 1.0], vec![f64::MAX, -1.5]],
        rotations: Some(vec![
            Rotation::Angle(0.1),
            Rotation::Vector(vec![1e-300, -0.0, 3.0]),
        ]),
        metrics: Some(metrics()),
        accelerations: Some(vec![LawAccelerations {
            law: "alpha_interaction".to_owned(),
            values: vec![vec![1.0, 2.0], vec![3.0, 4.0]],
        }]),
        beta_agents: Some(vec![BetaAgent {
            agent: 1,
            obstacle: 0,
            part: None,
            position: vec![1.0, 2.0],
            velocity: vec![3.0, 4.0],
            distance: 0.5,
        }]),
        edges: Some(vec![[0, 1]]),
        net: Some(Box::new(net())),
        links: Some(vec![[0, 1], [1, 0]]),
        laws: Some(Box::new(laws())),
        blocked: step.is_multiple_of(2).then(|| vec![[1, 0]]),
        obstacles: Some(vec![ObstaclePose {
            obstacle: 0,
            position: vec![0.5, -0.0],
            rotation: Rotation::Angle(0.25),
        }]),
    }
}

pub fn contact() -> Contact {
    Contact {
        agent: 0,
        with: Partner::Obstacle,
        other: 3,
        begin: 0.1,
        end: 0.2,
        open: false,
        steps: 10,
        blow: 0.6,
        blows: 2,
        impulse: 1.25,
        largest_impulse: 0.7,
        mean_force: Some(12.5),
        friction: 1e-300,
        deepest_penetration: 0.0,
        approach_speed: 1.5,
        push_speed: 0.25,
        position: vec![0.5, 0.25],
    }
}

pub fn summary() -> Summary {
    Summary {
        name: "a world".to_owned(),
        seed: u64::MAX,
        outcome: Outcome::Completed,
        error: None,
        agents: 2,
        steps: 100,
        time: 1.0,
        agent_contacts: ContactCount::default(),
        obstacle_contacts: ContactCount {
            episodes: 1,
            pairs: 1,
            largest_blow: 0.6,
            impulse: 1.25,
            friction: 1e-300,
            largest_impulse: 0.7,
            longest_duration: 0.1,
            mean_duration: 0.05,
            deepest_penetration: 0.1,
            highest_approach_speed: 1.5,
            pushed: 1,
        },
        force_cuts: 3,
        rate_cuts: 2,
        speed_cuts: 1,
        smallest_agent_gap: Some(0.5),
        closest_agents: Some(Approach {
            agent: 0,
            other: 1,
            time: 0.3,
        }),
        smallest_obstacle_gap: Some(0.1),
        closest_obstacle: None,
        strain: StrainRecord {
            travel: 0.25,
            overlap: 1e-3,
            unordered: 7,
        },
        last: metrics(),
    }
}

/// A small trace, the header apart.
pub fn records() -> Vec<Record> {
    vec![
        Record::Frame(frame(0)),
        Record::Contact(contact()),
        Record::Frame(frame(1)),
        Record::Summary(Box::new(summary())),
    ]
}

pub fn write_all<W: Write>(writer: &mut TraceWriter<W>, records: &[Record]) {
    writer.write(&Record::Header(Box::new(header()))).unwrap();
    for record in records {
        writer.write(record).unwrap();
    }
}

pub fn bytes_of(name: &str, records: &[Record]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = TraceWriter::new(&mut bytes, format(name));
    write_all(&mut writer, records);
    writer.finish().unwrap();
    bytes
}

pub fn open(bytes: &[u8]) -> Result<TraceReader, TraceError> {
    TraceReader::new(Cursor::new(bytes.to_vec()), "the test".to_owned())
}

/// All records behind the header, and whether the trace was truncated.
pub fn read(bytes: &[u8]) -> Result<(Vec<Record>, bool), TraceError> {
    let mut reader = open(bytes)?;
    let records = reader.by_ref().collect::<Result<_, _>>()?;
    Ok((records, reader.truncated()))
}

pub fn message<T>(result: Result<T, TraceError>) -> String {
    match result {
        Ok(_) => panic!("no error"),
        Err(e) => e.to_string(),
    }
}
