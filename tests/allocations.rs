//! A step takes no memory once all scratch has grown: what the engine does for itself apart.

use allocation_counter::measure;
use serde_json::json;
use volary::dynamics::{Bodies, Drive, Engine};
use volary::law::{Flock, build};
use volary::shape::In;
use volary::world::World;

const STEPS: usize = 100;

/// A lattice of `side` agents along each axis, a little out of shape, beside an obstacle.
fn lattice<const D: usize>(side: usize) -> World<D>
where
    In<D>: Engine<D>,
{
    let positions: Vec<Vec<f64>> = (0..side.pow(D as u32))
        .map(|k| {
            let coordinate = |axis: usize| {
                let at = k / side.pow(axis as u32) % side;
                at as f64 * 2.0 + 0.2 * ((k * (axis + 3)) as f64).sin()
            };
            (0..D).map(coordinate).collect()
        })
        .collect();
    let mut beside = vec![side as f64; D];
    beside[0] = -2.0;
    let spec = json!({
        "dimension": D,
        "time": { "step": 0.01, "end": 100 },
        "agents": [{ "radius": 0.2, "positions": { "explicit": positions } }],
        "obstacles": [{ "shape": { "ball": { "radius": 1 } }, "position": beside }],
        "laws": [
            { "alpha_interaction": { "spacing": 2, "range": 2.4, "damping": 1 } },
            { "obstacle_avoidance": {
                "range": 2.4, "standoff": 2, "gain": 10, "damping": 0.1
            } },
            { "navigation": { "velocity": vec![0.1; D], "velocity_gain": 2 } }
        ]
    });
    let spec = serde_json::from_value(spec).expect("the world is well formed");
    World::new("lattice", spec).expect("the world is sound")
}

fn a_step_takes_no_memory<const D: usize>(side: usize)
where
    In<D>: Engine<D>,
{
    let world = lattice::<D>(side);
    let mut flock = Flock::new(build(&world));
    let mut bodies = Bodies::new(&world, &mut flock).expect("a finite start");
    let mut engine = <In<D> as Engine<D>>::physics(&world);
    let still = Drive {
        forces: &[],
        steering: &[],
        lasting: &[],
        obstacles: &world.obstacles,
    };
    for _ in 0..12 * STEPS {
        bodies.step(&mut flock).expect("a finite state");
        engine.step(still);
    }
    let bare = measure(|| (0..STEPS).for_each(|_| engine.step(still)));
    let whole = measure(|| {
        for _ in 0..STEPS {
            bodies.step(&mut flock).expect("a finite state");
        }
    });
    let moved = bodies.snapshot().positions[0] - world.agents.positions[0];
    assert!(moved.norm() > 0.1, "nothing went on");
    println!(
        "{D}-D, {} agents: the engine took memory {} times in {STEPS} steps, a whole step {}",
        world.agents.len(),
        bare.count_total,
        whole.count_total
    );
    assert!(whole.count_total <= bare.count_total, "{whole:?}, {bare:?}");
}

/// Few agents, whose steps are taken on one thread.
#[test]
fn small_flocks_step_in_the_memory_they_have() {
    a_step_takes_no_memory::<2>(10);
    a_step_takes_no_memory::<3>(5);
}

/// So many that steps are taken in parallel, on the threads of a pool; here on one, whose
/// memory is counted.
#[test]
fn large_flocks_step_in_the_memory_they_have() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread can be made").install(|| {
        a_step_takes_no_memory::<2>(25);
        a_step_takes_no_memory::<3>(9);
    });
}
