//! Checkpoints: a simulation that goes on from one does what it would have done, to the last
//! bit, and no other file is taken for one.

mod common;

use std::convert::Infallible;
use std::ops::ControlFlow;

use proptest::prelude::*;
use serde_json::json;
use volary::checkpoint::{Checkpoint, CheckpointError};
use volary::dynamics::Engine;
use volary::law::Law;
use volary::math::Vector;
use volary::sense::Scene;
use volary::shape::In;
use volary::simulation::{Pause, Simulation};
use volary::trace::Record;
use volary::world::World;
use volary::world::spec::WorldSpec;

/// Agents that touch each other, a wall, a ball and a box, with all that can be recorded.
fn brawl(dimension: usize, friction: f64, solver_iterations: usize) -> WorldSpec {
    let along_x = |x: f64, rest: f64| {
        let mut vector = vec![rest; dimension];
        vector[0] = x;
        vector
    };
    let (mut gravity, mut up) = (along_x(0.3, 0.0), along_x(0.0, 0.0));
    (gravity[1], up[1]) = (-2.0, 1.0);
    common::spec(json!({
        "dimension": dimension,
        "time": { "step": 0.01, "end": 0.8 },
        "record": {
            "every": 0.05, "accelerations": true, "beta_agents": true, "edges": true,
            "net": true
        },
        "physics": {
            "friction": friction, "restitution": 0.4, "solver_iterations": solver_iterations,
            "gravity": gravity
        },
        "agents": [
            {
                "count": 25, "radius": 0.3, "mass": 1.5, "force_limit": 12,
                "positions": { "box": { "min": along_x(0.0, 0.0), "max": along_x(4.0, 4.0) } },
                "velocities": { "uniform": {
                    "min": along_x(-1.0, -3.0), "max": along_x(6.0, 1.0)
                } }
            },
            {
                "radius": 0.1,
                "positions": { "explicit": [along_x(-1.0, 0.5), along_x(-1.5, 0.5)] },
                "velocities": { "common": along_x(60.0, 0.0) }
            }
        ],
        "obstacles": [
            { "shape": { "ball": { "radius": 2.0 } }, "position": along_x(7.0, 2.0) },
            { "shape": { "cuboid": { "half_extents": along_x(0.5, 1.0) } },
              "position": along_x(2.0, -1.8) },
            { "shape": { "half_space": { "normal": up } }, "position": along_x(0.0, -0.7) }
        ],
        "laws": [
            { "alpha_interaction": { "spacing": 0.5, "range": 1.5, "damping": 0.5 } },
            { "obstacle_avoidance": { "range": 0.6, "standoff": 0.5, "gain": 0.2 } },
            { "navigation": { "velocity": along_x(4.0, 0.0), "velocity_gain": 3 } }
        ]
    }))
}

/// Advances up to a step, and returns what was recorded.
fn advance<const D: usize>(simulation: &mut Simulation<D>, end: u64) -> Vec<Record> {
    let mut records = Vec::new();
    let mut record = |one| {
        records.push(one);
        Ok::<_, Infallible>(())
    };
    let pause = simulation.advance(end, &mut record, &mut |_| ControlFlow::Continue(()));
    assert_eq!(pause.unwrap(), Pause::Reached);
    records
}

/// Ends the run, and returns what was recorded.
fn finish<const D: usize>(simulation: &mut Simulation<D>) -> Vec<Record> {
    let mut records = Vec::new();
    let mut record = |one| {
        records.push(one);
        Ok::<_, Infallible>(())
    };
    simulation.finish(Pause::Reached, &mut record).unwrap();
    records
}

/// Text tells numbers apart to the last bit, −0 from 0 included.
fn text(records: &[Record]) -> Vec<String> {
    let text = |record| serde_json::to_string(record).unwrap();
    records.iter().map(text).collect()
}

/// Positions and velocities, bit by bit.
fn bits<const D: usize>(simulation: &Simulation<D>) -> Vec<u64> {
    let state = simulation.snapshot();
    let vectors = state.positions.iter().chain(state.velocities);
    vectors.flatten().map(|x| x.to_bits()).collect()
}

fn through_a_file<const D: usize>(
    simulation: &Simulation<D>,
    more: Vec<Box<dyn Law<D>>>,
) -> Simulation<D>
where
    In<D>: Engine<D>,
{
    let bytes = Checkpoint::of(simulation).unwrap().to_bytes().unwrap();
    let checkpoint = Checkpoint::from_bytes(&bytes, "here".to_owned()).unwrap();
    assert_eq!(checkpoint.step(), simulation.snapshot().step);
    let again = checkpoint.simulation(more).unwrap();
    // Some of it shows only later, or in few worlds: the smallest gaps do.
    // A difference would print the engine's state, which tells nobody anything.
    assert!(again.capture() == simulation.capture());
    again
}

/// Runs a world whole, and with a checkpoint after each of `cuts` steps; everything must be
/// the same. Each cut is taken alone, and goes on for long enough to show a difference; one
/// more run goes through all of them. Returns the number of contact episodes.
fn goes_on_as_if_never_stopped<const D: usize>(
    spec: &WorldSpec,
    cuts: &[u64],
    more: fn() -> Vec<Box<dyn Law<D>>>,
) -> u64
where
    In<D>: Engine<D>,
{
    let start = || {
        let world: World<D> = common::world(spec.clone());
        Simulation::with_laws(world, more()).unwrap()
    };
    let mut whole = start();
    let steps = whole.world().steps();
    let mut expected: Vec<(u64, Vec<u64>)> = vec![(0, bits(&whole))];
    let mut expected_records = Vec::new();
    for step in 1..=steps {
        expected_records.push(text(&advance(&mut whole, step)));
        expected.push((step, bits(&whole)));
    }
    let end = text(&finish(&mut whole));

    let mut often = start();
    for &cut in cuts {
        let mut once = start();
        advance(&mut once, cut);
        let mut once = through_a_file(&once, more());
        assert_eq!(bits(&once), expected[cut as usize].1, "at step {cut}");
        for step in cut + 1..=steps {
            let records = text(&advance(&mut once, step));
            assert_eq!(
                records,
                expected_records[step as usize - 1],
                "cut at {cut}, step {step}"
            );
            assert_eq!(
                (step, bits(&once)),
                expected[step as usize],
                "cut at {cut}, step {step}"
            );
        }
        assert_eq!(text(&finish(&mut once)), end, "cut at {cut}");
        assert_eq!(once.ledger(), whole.ledger(), "cut at {cut}");
        advance(&mut often, cut);
        often = through_a_file(&often, more());
    }
    advance(&mut often, steps);
    assert_eq!(text(&finish(&mut often)), end, "cut at all of {cuts:?}");
    let contacts = [
        whole.ledger().agent_contacts(),
        whole.ledger().obstacle_contacts(),
    ];
    contacts.iter().map(|count| count.episodes).sum()
}

#[test]
fn brawls_go_on_bit_for_bit() {
    let cuts: Vec<u64> = (0..=80).step_by(7).chain([80]).collect();
    for friction in [0.0, 0.5] {
        for solver_iterations in [1, 3] {
            let spec = brawl(2, friction, solver_iterations);
            let contacts = goes_on_as_if_never_stopped::<2>(&spec, &cuts, Vec::new);
            assert!(contacts > 30, "only {contacts} contacts");
            let spec = brawl(3, friction, solver_iterations);
            let contacts = goes_on_as_if_never_stopped::<3>(&spec, &cuts, Vec::new);
            assert!(contacts > 15, "only {contacts} contacts");
        }
    }
}

/// Lists of neighbours, trees of obstacles and clusters of agents are made anew after a
/// checkpoint, where the run had older ones.
#[test]
fn sums_over_all_pairs_among_many_obstacles_go_on_bit_for_bit() {
    goes_on_as_if_never_stopped::<2>(&common::multitude(2), &[1, 17], Vec::new);
    goes_on_as_if_never_stopped::<3>(&common::multitude(3), &[1, 17], Vec::new);
}

#[test]
fn worlds_with_all_there_is_go_on_bit_for_bit() {
    let cuts = [0, 1, 77, 198];
    let contacts = goes_on_as_if_never_stopped::<2>(&common::circus(2), &cuts, Vec::new)
        + goes_on_as_if_never_stopped::<3>(&common::circus(3), &cuts, Vec::new);
    assert!(contacts > 5, "only {contacts} contacts");
    goes_on_as_if_never_stopped::<2>(&common::parade(2), &[0, 1, 50, 99], Vec::new);
    goes_on_as_if_never_stopped::<3>(&common::parade(3), &[0, 1, 50, 99], Vec::new);
}

#[test]
fn smooth_flocks_go_on_bit_for_bit() {
    let cuts = [0, 1, 2, 77, 199];
    goes_on_as_if_never_stopped::<2>(&common::flock_world(2), &cuts, Vec::new);
    goes_on_as_if_never_stopped::<3>(&common::flock_world(3), &cuts, Vec::new);
}

#[test]
fn shipped_worlds_go_on_bit_for_bit() {
    for name in volary::world::shipped::names() {
        let text = volary::world::shipped::get(&name).unwrap();
        let mut spec: WorldSpec = serde_json::from_str(text).unwrap();
        spec.time.end = 60.0 * spec.time.step;
        spec.record.every = 20.0 * spec.time.step;
        match spec.dimension {
            2 => goes_on_as_if_never_stopped::<2>(&spec, &[31], Vec::new),
            _ => goes_on_as_if_never_stopped::<3>(&spec, &[31], Vec::new),
        };
    }
}

/// Pulls every agent to the origin.
struct Home;

impl Law<2> for Home {
    fn name(&self) -> &str {
        "home"
    }

    fn accelerate(&self, scene: &Scene<'_, 2>, first: usize, out: &mut [Vector<2>]) {
        for (place, out) in out.iter_mut().enumerate() {
            *out -= scene.positions[first + place] * 2.0;
        }
    }
}

#[test]
fn laws_of_ones_own_are_given_again() {
    let home = || -> Vec<Box<dyn Law<2>>> { vec![Box::new(Home)] };
    goes_on_as_if_never_stopped(&brawl(2, 0.2, 1), &[20, 40], home);
}

fn some_bytes() -> Vec<u8> {
    let mut simulation = Simulation::<2>::new(common::world(brawl(2, 0.5, 1))).unwrap();
    advance(&mut simulation, 20);
    Checkpoint::of(&simulation).unwrap().to_bytes().unwrap()
}

fn read(bytes: &[u8]) -> Result<Checkpoint, CheckpointError> {
    Checkpoint::from_bytes(bytes, "some.ckpt".to_owned())
}

/// A file with this version, program and content, and a checksum to match.
fn forged(version: u32, program: &str, content: &[u8]) -> Vec<u8> {
    let mut body = version.to_le_bytes().to_vec();
    body.extend_from_slice(program.as_bytes());
    body.extend_from_slice(content);
    let mut bytes = b"volary checkpoint\n".to_vec();
    bytes.extend_from_slice(&(body.len() as u64).to_le_bytes());
    bytes.extend_from_slice(&crc32fast::hash(&body).to_le_bytes());
    bytes.extend_from_slice(&body);
    bytes
}

#[test]
fn what_is_no_checkpoint_is_refused() {
    let bytes = some_bytes();
    let message = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
    for foreign in [&b""[..], b"{}", b"volary checkpoin", b"\x1f\x8b", &[0; 100]] {
        assert_eq!(message(foreign), "some.ckpt is not a checkpoint");
    }
    for (cut, says) in [
        (18, "early"),
        (25, "early"),
        (30, "early"),
        (bytes.len() - 1, "early"),
    ] {
        let expected = format!("some.ckpt is damaged: it ends too {says}");
        assert_eq!(message(&bytes[..cut]), expected, "cut at {cut}");
    }
    let late = [&bytes[..], b"\n"].concat();
    assert_eq!(message(&late), "some.ckpt is damaged: it ends too late");
    // The largest length that can be claimed takes no memory.
    let mut long = bytes.clone();
    long[18..26].copy_from_slice(&u64::MAX.to_le_bytes());
    assert_eq!(message(&long), "some.ckpt is damaged: it ends too early");
    let other = forged(7, "volary 9.9.9 on m68k amigaos\n", b"");
    assert_eq!(
        message(&other),
        "some.ckpt has version 7 of the checkpoint format; only version 2 is supported"
    );
    let other = message(&forged(2, "volary 9.9.9 on m68k amigaos\n", b""));
    assert!(
        other
            .starts_with("some.ckpt was made by volary 9.9.9 on m68k amigaos, and this is volary "),
        "{other}"
    );
    assert!(message(&forged(2, "volary", b"")).contains("does not name its program"));
    assert!(message(&forged(2, "", b"")).contains("does not name its program"));
}

#[test]
fn states_of_other_worlds_are_refused() {
    let simulation = Simulation::<2>::new(common::world(brawl(2, 0.5, 1))).unwrap();
    let checkpoint = Checkpoint::of(&simulation).unwrap();
    let message = match checkpoint.simulation::<3>(Vec::new()) {
        Ok(_) => panic!("a flat world in space"),
        Err(error) => error.to_string(),
    };
    assert!(message.contains("dimension is not 3"), "{message}");
    let state = simulation.capture().unwrap();
    let mut fewer = brawl(2, 0.5, 1);
    fewer.agents.pop();
    let mut barer = brawl(2, 0.5, 1);
    barer.obstacles.pop();
    for spec in [fewer, barer] {
        let world = common::world(spec);
        assert!(Simulation::<2>::restore(world, Vec::new(), state.clone()).is_err());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damage_is_always_found(
        flips in prop::collection::vec((any::<prop::sample::Index>(), 1..=255u8), 0..4),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        thread_local!(static BYTES: Vec<u8> = some_bytes());
        let whole = BYTES.with(Vec::clone);
        let mut bytes = whole.clone();
        for (place, flip) in flips {
            let place = place.index(bytes.len());
            bytes[place] ^= flip;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        let found = read(&bytes);
        prop_assert_eq!(found.is_ok(), bytes == whole);
        if let Err(error) = found {
            prop_assert!(
                matches!(error, CheckpointError::Damaged { .. } | CheckpointError::NotACheckpoint { .. }),
                "{}", error
            );
        }
    }

    /// A checksum that fits does not make the content one.
    #[test]
    fn nonsense_in_a_right_envelope_is_refused(content in prop::collection::vec(any::<u8>(), 0..200)) {
        thread_local!(static BYTES: Vec<u8> = some_bytes());
        let whole = BYTES.with(Vec::clone);
        let end = 34 + whole[34..].iter().position(|&byte| byte == b'\n').unwrap() + 1;
        let program = String::from_utf8(whole[34..end].to_vec()).unwrap();
        prop_assert!(read(&forged(2, &program, &whole[end..])).is_ok());
        let found = read(&forged(2, &program, &content));
        prop_assert!(matches!(found, Err(CheckpointError::Unusable { .. })), "{:?}", found);
    }
}
