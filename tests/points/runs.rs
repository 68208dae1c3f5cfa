//! What holds for runs of points: energies fall, threads do not count, checkpoints go on, and
//! what points do not have is refused.

use serde_json::{Value, json};
use volary::checkpoint::Checkpoint;
use volary::dynamics::{Accuracy, Dynamics, Failure};
use volary::law::{Flock, State};
use volary::metric::{Terms, laws_record};
use volary::simulation::Simulation;
use volary::trace::record::LawsRecord;
use volary::world::World;

use crate::common::{flock_world, order, spec, world};
use crate::nets::net;
use crate::reference::{points, run_to, shipped_world};

/// Which energy it is.
type Energy = fn(&LawsRecord) -> Option<f64>;

/// What the laws' energies are now.
fn energies(simulation: &Simulation<2>, flock: &mut Flock<2>) -> LawsRecord {
    let (world, now) = (simulation.world(), simulation.snapshot());
    let state = State {
        time: now.time,
        positions: now.positions,
        velocities: now.velocities,
        headings: now.headings,
        groups: &world.agents.group,
        masses: &world.agents.mass,
        rotations: &[],
        obstacles: now.obstacles,
    };
    laws_record(world, &Terms::new(flock, &state), &state)
}

/// The energies that theory says never rise do not, but for 1e-10 of what they are at the
/// start, at an accuracy of 1e-12.
#[test]
fn energies_never_rise() {
    let cases: [(&str, Energy); 4] = [
        ("song-2013/example-18", |record| record.energy),
        ("song-2013/example-19", |record| record.energy),
        ("shi-wang-chu/ideal", |record| record.total_energy),
        ("shi-wang-chu/damped", |record| record.total_energy),
    ];
    for (name, energy) in cases {
        let sets = ["time.step=0.05", "time.end=20", "record.every=1"];
        let world = shipped_world(name, &sets);
        let mut flock = Flock::of_world(&world, Vec::new());
        let mut simulation = points(world, 1e-12);
        let mut now = || {
            let value = energy(&energies(&simulation, &mut flock)).expect("an energy");
            simulation.step().expect("a finite state");
            value
        };
        let first = now();
        let mut before = first;
        for _ in 1..400 {
            let after = now();
            assert!(
                after <= before + 1e-10 * first.abs(),
                "{name}: {before} {after}"
            );
            before = after;
        }
        assert!(before < 0.9 * first, "{name}: {first} {before}");
    }
}

/// The same for the structural energy of a net whose damping ends at once.
#[test]
fn the_structural_energy_of_a_smooth_net_never_rises() {
    let mut simulation = points(net("smooth"), 1e-11);
    let energy = |simulation: &Simulation<2>| simulation.metrics().structural_energy;
    let first = energy(&simulation).expect("a net");
    let mut before = first;
    for _ in 0..200 {
        simulation.step().expect("a finite state");
        let after = energy(&simulation).expect("a net");
        assert!(after <= before + 1e-9 * first, "{before} {after}");
        before = after;
    }
    assert!(before < 0.9 * first && simulation.solver().expect("points").jumps > 0);
}

/// Enough agents that the laws are summed on several threads.
#[test]
fn threads_do_not_count() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| {
            let mut spec = flock_world(2);
            spec.agents[0].count = Some(600);
            spec.agents[0].positions = serde_json::from_value(json!({ "box": {
                "min": [-40, -40], "max": [9, 40], "separation": 1.0
            } }))
            .expect("a box");
            let mut simulation = points(world::<2>(spec), 1e-6);
            for _ in 0..3 {
                simulation.step().expect("a finite state");
            }
            Checkpoint::of(&simulation)
                .expect("a state")
                .to_bytes()
                .expect("bytes")
        })
    };
    let first = run(1);
    assert!(first == run(2) && first == run(3));
}

/// Both kinds of solver, with links that come and go.
#[test]
fn a_run_goes_on_from_a_checkpoint_bit_for_bit() {
    for epsilon in [1.0, 1e-4] {
        let spec = spec(json!({
            "dimension": 2,
            "time": { "step": 0.1, "end": 4.0 },
            "record": { "every": 2.0 },
            "agents": [{
                "radius": 0.01, "count": 6, "force_limit": 1e5,
                "positions": { "box": { "min": [0, 0], "max": [2, 2], "separation": 0.4 } },
                "velocities": { "uniform": { "min": [-1, -1], "max": [1, 1] } }
            }],
            "laws": [
                { "alpha_interaction": { "protocol": "nonsmooth", "spacing": 1, "range": 1.2 } },
                { "alignment": { "epsilon": epsilon } }
            ]
        }));
        let mut whole = points(world::<2>(spec), 1e-9);
        run_to(&mut whole, 0.7);
        let checkpoint = Checkpoint::of(&whole).expect("a state");
        let bytes = checkpoint.to_bytes().expect("bytes");
        let again = Checkpoint::from_bytes(&bytes, "it".to_owned()).expect("a checkpoint");
        let mut again: Simulation<2> = again.simulation(Vec::new()).expect("the same world");
        for simulation in [&mut whole, &mut again] {
            run_to(simulation, 3.0);
        }
        assert_eq!(whole.snapshot().positions, again.snapshot().positions);
        assert_eq!(whole.snapshot().velocities, again.snapshot().velocities);
        assert_eq!(whole.solver(), again.solver());
        assert_eq!(
            whole.solver().expect("points").method.starts_with("Radau"),
            epsilon < 1.0
        );
    }
}

fn refusal(change: impl FnOnce(&mut Value), accuracy: f64) -> Failure {
    let mut json = json!({
        "dimension": 2,
        "time": { "step": 0.1, "end": 1 },
        "record": { "every": 1 },
        "agents": [
            { "radius": 0.1, "positions": { "explicit": [[0, 0], [1, 0]] } },
            { "radius": 0.1, "positions": { "explicit": [[5, 5]] } }
        ]
    });
    change(&mut json["agents"][1]);
    let world: World<2> = world(spec(json));
    let dynamics = Dynamics::Points(Accuracy { relative: accuracy });
    match Simulation::with_dynamics(world, Vec::new(), dynamics) {
        Err(failure) => failure,
        Ok(_) => panic!("the world has points"),
    }
}

#[test]
fn what_points_do_not_have_is_refused() {
    let cases = [
        ("sensing.delay", json!({ "sensing": { "delay": 0.1 } })),
        (
            "sensing.noise",
            json!({ "sensing": { "noise": { "velocity": 0.1 } } }),
        ),
        ("sensing.dropout", json!({ "sensing": { "dropout": 0.1 } })),
        ("force_rate_limit", json!({ "force_rate_limit": 1.0 })),
        ("top_speed", json!({ "top_speed": 1.0 })),
    ];
    for (field, fields) in cases {
        let change = |group: &mut Value| {
            for (name, value) in fields.as_object().expect("fields") {
                group[name] = value.clone();
            }
        };
        let failure = refusal(change, 1e-8);
        assert!(failure.is_bad_input());
        let message = failure.to_string();
        assert!(
            message.starts_with(&format!("agents[1].{field}: ")),
            "{message}"
        );
    }
    let rod = |group: &mut Value| {
        group["shape"] = json!({ "capsule": { "half_length": 0.1, "radius": 0.1 } });
        group.as_object_mut().expect("a group").remove("radius");
    };
    assert!(
        refusal(rod, 1e-8)
            .to_string()
            .starts_with("agents[1].shape: ")
    );
    for accuracy in [0.0, 1e-16, 0.1, f64::NAN, -1e-10] {
        let message = refusal(|_| {}, accuracy).to_string();
        assert!(message.contains("from 1e-13 to 1e-3"), "{message}");
    }
}

/// Bodies would need shorter steps for this friction; points choose their own.
#[test]
fn what_is_too_stiff_for_bodies_is_not_for_points() {
    let spec = spec(json!({
        "dimension": 2,
        "time": { "step": 0.5, "end": 1 },
        "record": { "every": 1 },
        "agents": [{
            "radius": 1e-3, "positions": { "explicit": [[0, 0]] },
            "velocities": { "explicit": [[1, 0]] }
        }],
        "laws": [{ "friction": { "coefficient": 20, "exponent": 0 } }]
    }));
    let problems = volary::world::World::<2>::new("stiff", spec.clone()).expect_err("stiff");
    assert_eq!(problems[0].path, "laws[0].friction.coefficient");
    let world = volary::world::World::<2>::of_points("stiff", spec).expect("a world of points");
    let mut simulation =
        Simulation::with_dynamics(world, Vec::new(), Dynamics::Points(Accuracy::default()))
            .expect("a start");
    simulation.step().expect("a finite state");
    let left = simulation.snapshot().velocities[0][0];
    assert!((left - (-10f64).exp()).abs() < 1e-9, "{left}");
}

/// Two agents fall into each other's singularity.
#[test]
fn what_has_no_end_gets_stuck_in_time() {
    let mut simulation = Simulation::with_dynamics(
        world::<2>(spec(json!({
            "dimension": 2,
            "time": { "step": 0.5, "end": 10 },
            "record": { "every": 2.0 },
            "agents": [{ "radius": 1e-3, "positions": { "explicit": [[0, 0], [1, 0]] } }]
        }))),
        vec![Box::new(Collapse)],
        Dynamics::Points(Accuracy::default()),
    )
    .expect("a finite start");
    let failure = (0..20).find_map(|_| simulation.step().err());
    assert!(
        matches!(failure, Some(Failure::Stuck { .. })),
        "{failure:?}"
    );
    // The state is the one before the step that failed.
    assert!(simulation.snapshot().positions[0].norm() < 1.0);
}

/// Attraction by 1/r²: two agents at rest fall into each other.
struct Collapse;

impl volary::law::Law<2> for Collapse {
    fn name(&self) -> &str {
        "collapse"
    }

    fn range(&self) -> f64 {
        f64::INFINITY
    }

    fn accelerate(
        &self,
        scene: &volary::sense::Scene<'_, 2>,
        first: usize,
        out: &mut [volary::math::Vector<2>],
    ) {
        for (i, acceleration) in (first..).zip(out) {
            scene.neighbours(i, f64::INFINITY, |other| {
                *acceleration += other.offset / (other.squared * other.squared.sqrt());
            });
        }
    }
}

/// Bodies that touch nothing converge to points, with order two.
#[test]
fn bodies_converge_to_points() {
    let steps = [0.02, 0.01, 0.005];
    let mut spec = flock_world(2);
    spec.time.end = 1.0;
    let exact = {
        let mut simulation = points(world::<2>(spec.clone()), 1e-12);
        run_to(&mut simulation, 1.0);
        simulation.snapshot().positions.to_vec()
    };
    let errors = steps.map(|step| {
        spec.time.step = step;
        let mut simulation = Simulation::new(world::<2>(spec.clone())).expect("a finite start");
        run_to(&mut simulation, 1.0);
        assert_eq!(simulation.ledger().agent_contacts().episodes, 0);
        let pairs = simulation.snapshot().positions.iter().zip(&exact);
        pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    });
    let order = order(&steps, &errors);
    assert!(order > 1.8, "{order}: {errors:?}");
}
