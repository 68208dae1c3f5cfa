//! The shipped worlds do what their notes say.
//!
//! The notes' tables cover seeds 1 to 20 of each world. The six obstacles in the plane are
//! run over all of them; the other worlds over the first few, to keep this file quick.

use rayon::prelude::*;
use volary::dynamics::{Engine, Snapshot};
use volary::net::{Net, crossings, is_planar, normalised_defect, realisation_error};
use volary::shape::In;
use volary::simulation::Simulation;
use volary::trace::record::{Outcome, Record};
use volary::world::{AnyWorld, Document, Override, World, shipped};

fn load(name: &str, sets: &[String]) -> AnyWorld {
    let text = shipped::get(name).unwrap_or_else(|| panic!("{name} is not shipped"));
    let sets = sets
        .iter()
        .map(|set| set.parse::<Override>().expect("a path and a value"));
    let document = Document::new(name, text).with(sets);
    document
        .world(name)
        .unwrap_or_else(|report| panic!("{report}"))
}

fn plane(name: &str, seed: u64) -> World<2> {
    match load(name, &[format!("seed={seed}")]) {
        AnyWorld::Plane(world) => world,
        AnyWorld::Space(_) => panic!("{name} is not in the plane"),
    }
}

fn space(name: &str, seed: u64) -> World<3> {
    match load(name, &[format!("seed={seed}")]) {
        AnyWorld::Space(world) => world,
        AnyWorld::Plane(_) => panic!("{name} is not in space"),
    }
}

/// Runs a world to its end and shows `watch` the state after each step.
fn to_the_end<const D: usize>(
    world: World<D>,
    mut watch: impl FnMut(&Snapshot<'_, D>),
) -> Simulation<D>
where
    In<D>: Engine<D>,
{
    let mut simulation = Simulation::new(world).expect("a finite start");
    for _ in 0..simulation.world().steps() {
        simulation.step().expect("a finite state");
        watch(&simulation.snapshot());
    }
    simulation
}

/// What a run past obstacles comes to.
#[derive(Debug)]
struct Passage {
    seed: u64,
    /// Share of agents in the largest component at the end.
    density: f64,
    /// Agents not past all obstacles, or not at the target velocity, at the end.
    left_behind: usize,
    /// Largest distance of two agents at the end.
    diameter: f64,
    agent_contacts: u64,
    obstacle_contacts: u64,
}

fn passage<const D: usize>(
    seed: u64,
    world: World<D>,
    watch: impl FnMut(&Snapshot<'_, D>),
) -> Passage
where
    In<D>: Engine<D>,
{
    /// All obstacles end before this x.
    const PAST: f64 = 225.0;
    /// Largest deviation from the target velocity, of 10.
    const ASTRAY: f64 = 0.5;

    let target = world
        .navigation_velocity()
        .expect("a flock with a velocity");
    let simulation = to_the_end(world, watch);
    let state = simulation.snapshot();
    let metrics = simulation.metrics();
    Passage {
        seed,
        density: metrics.density.expect("an (α, α) interaction"),
        left_behind: state
            .positions
            .iter()
            .zip(state.velocities)
            .filter(|(q, p)| q[0] < PAST || (*p - target).norm() > ASTRAY)
            .count(),
        diameter: metrics.position_diameter,
        agent_contacts: simulation.ledger().agent_contacts().episodes,
        obstacle_contacts: simulation.ledger().obstacle_contacts().episodes,
    }
}

/// Nothing touched an obstacle, nobody stayed behind, and the flock is one again.
fn assert_rejoined(runs: &[Passage], diameter: f64, agent_contacts: u64) {
    for run in runs {
        let seed = run.seed;
        assert_eq!(run.obstacle_contacts, 0, "seed {seed}: {run:?}");
        assert_eq!(run.left_behind, 0, "seed {seed}: {run:?}");
        assert!(run.diameter < diameter, "seed {seed}: {run:?}");
        assert!(run.density >= 0.9, "seed {seed}: {run:?}");
    }
    let mean = runs.iter().map(|run| run.density).sum::<f64>() / runs.len() as f64;
    assert!(mean >= 0.97, "mean density {mean}: {runs:?}");
    let contacts: u64 = runs.iter().map(|run| run.agent_contacts).sum();
    assert!(contacts <= agent_contacts, "{contacts} contacts: {runs:?}");
}

fn starts<const D: usize>(name: &str, world: World<D>)
where
    In<D>: Engine<D>,
{
    let limited = world.agents.force_limit.iter().any(|it| it.is_finite());
    let mut simulation = Simulation::new(world).expect("a finite start");
    let mut frames = 0;
    let summary = simulation.run(
        |record| {
            if let Record::Frame(frame) = record {
                frames += 1;
                let numbers = frame.positions.iter().chain(&frame.velocities).flatten();
                assert!(numbers.into_iter().all(|x| x.is_finite()), "{name}");
            }
            Ok::<_, ()>(())
        },
        |_| std::ops::ControlFlow::Continue(()),
    );
    let summary = summary.expect("recording cannot fail");
    assert_eq!(summary.outcome, Outcome::Completed, "{name}");
    assert_eq!(summary.time, 2.0, "{name}");
    assert!(frames > 2, "{name}: {frames} frames");
    assert!(limited || summary.force_cuts == 0, "{name}");
}

#[test]
fn every_shipped_world_runs() {
    let names = shipped::names();
    assert!(!names.is_empty());
    names.par_iter().for_each(|name| {
        match load(name, &["time.end=2".to_owned()]) {
            AnyWorld::Plane(world) => starts(name, world),
            AnyWorld::Space(world) => starts(name, world),
        };
    });
}

#[test]
fn the_flock_rejoins_behind_six_obstacles() {
    let name = "olfati-saber-2003/six-obstacles";
    let run = |seed| passage(seed, plane(name, seed), |_| {});
    let runs: Vec<_> = (1..=20).into_par_iter().map(run).collect();
    assert_rejoined(&runs, 170.0, 12);
}

#[test]
fn the_flock_rejoins_behind_six_spheres() {
    let name = "olfati-saber-2003/six-obstacles-3d";
    let run = |seed| passage(seed, space(name, seed), |_| {});
    let runs: Vec<_> = (1..=6).into_par_iter().map(run).collect();
    assert_rejoined(&runs, 90.0, 2);
}

#[test]
fn the_flock_squeezes_through_the_gap() {
    /// Where the gap is narrowest, and its two sides there.
    const GAP: (f64, f64, f64) = (200.0, 15.0, 30.0);

    let name = "olfati-saber-2003/squeeze";
    let run = |seed| {
        let world = plane(name, seed);
        let mut before: Vec<f64> = world.agents.positions.iter().map(|q| q[0]).collect();
        let mut through = 0;
        let passage = passage(seed, world, |state| {
            for (before, q) in before.iter_mut().zip(state.positions) {
                let passes = *before < GAP.0 && GAP.0 <= q[0];
                through += usize::from(passes && GAP.1 < q[1] && q[1] < GAP.2);
                *before = q[0];
            }
        });
        assert!(through >= 95, "{through} go through: {passage:?}");
        passage
    };
    let runs: Vec<_> = (1..=6).into_par_iter().map(run).collect();
    assert_rejoined(&runs, 110.0, 3);
}

#[test]
fn the_net_settles_around_the_sink() {
    let name = "olfati-saber-2003/sink";
    (1..=3u64).into_par_iter().for_each(|seed| {
        let world = plane(name, seed);
        let alpha = world.alpha_interaction().expect("it has one").clone();
        let net = Net::new(&world.agents.positions, alpha.range);
        assert!(net.components().len() > 5, "seed {seed} starts connected");

        let mut broken = 0.0;
        let simulation = to_the_end(world, |state| {
            if state.step % 100 == 0 && Net::new(state.positions, alpha.range).density() < 1.0 {
                broken = state.time;
            }
        });
        assert!(broken < 20.0, "seed {seed} is in parts at {broken}");
        let state = simulation.snapshot();
        let metrics = simulation.metrics();
        // A triangular lattice of 100 has at most 265 edges; a rigid net at least 197.
        let edges = metrics.edges.expect("an (α, α) interaction");
        assert!((225..=275).contains(&edges), "seed {seed}: {edges} edges");
        assert!(
            metrics.velocity_mismatch < 0.1,
            "seed {seed} is not at rest: {metrics:?}"
        );
        let far = state.positions.iter().map(|q| q.norm()).fold(0.0, f64::max);
        assert!(far < 48.0, "seed {seed}: {far} from the sink");
        let net = Net::new(state.positions, alpha.range);
        let close = |&&[i, j]: &&[usize; 2]| {
            (state.positions[i] - state.positions[j]).norm() < 0.8 * alpha.spacing
        };
        assert_eq!(net.edges().iter().filter(close).count(), 0, "seed {seed}");
        assert_eq!(simulation.ledger().agent_contacts().episodes, 0);
    });
}

#[test]
fn the_structural_net_is_realised() {
    (1..=3u64).into_par_iter().for_each(|seed| {
        let world = plane("olfati-saber-2003/structural-net", seed);
        let alpha = world.alpha_interaction().expect("it has one").clone();
        let simulation = to_the_end(world, |_| {});
        let positions = simulation.snapshot().positions;
        let net = Net::new(positions, alpha.range);
        assert!(realisation_error(positions, &net, alpha.spacing) < 1e-3);
        assert!(normalised_defect(positions, &net, &alpha.pair(), 1.0) < Some(1e-6));
        assert!(is_planar(&net) && crossings(positions, &net) == 0);
        if seed == 2 {
            assert!(simulation.metrics().structural_energy < Some(1e-6));
            assert_eq!(simulation.metrics().components, Some(1));
        }
    });
}
