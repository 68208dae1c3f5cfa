//! Fast flocking on bodies: Djokam & Rathinam, section 4, with steps far longer than the flock
//! takes to agree.

use volary::reduced::FastFlocking;
use volary::simulation::Simulation;
use volary::world::{AnyWorld, Document, World, shipped};

fn load(name: &str) -> World<2> {
    let text = shipped::get(name).expect("it is shipped");
    match Document::new(name, text).world(name) {
        Ok(AnyWorld::Plane(world)) => world,
        _ => panic!("{name} is a sound world in the plane"),
    }
}

/// The largest distances of bodies from the leading order, and differences of velocities, at
/// times long after all have agreed.
fn errors(name: &str, times: &[f64]) -> [f64; 2] {
    let world = load(name);
    let leading = FastFlocking::new(&world)
        .and_then(|mut reduced| reduced.leading_order(times))
        .expect("one flock that agrees fast");
    let mut run = Simulation::new(load(name)).expect("a finite start");
    let step = world.spec.time.step;
    assert_eq!(step, 0.01);
    let mut errors = [0.0f64; 2];
    for leading in &leading {
        while run.snapshot().time < leading.time - 0.5 * step {
            run.step().expect("a finite state");
        }
        let state = run.snapshot();
        for (i, position) in state.positions.iter().enumerate() {
            assert!(position.norm().is_finite());
            errors[0] = errors[0].max((position - leading.positions[i]).norm());
            errors[1] = errors[1].max((state.velocities[i] - leading.velocity).norm());
        }
    }
    assert_eq!(run.ledger().agent_contacts().episodes, 0, "{name}");
    errors
}

/// At ε = 0.001 the bodies' rate times the step is 316.
#[test]
fn bodies_come_as_near_to_the_leading_order_as_epsilon_is_small() {
    let times = [20.0, 40.0];
    let [slow, fast, faster] = ["0.1", "0.01", "0.001"]
        .map(|name| errors(&format!("djokam-rathinam/fast-{name}"), &times));
    for kind in 0..2 {
        for (coarse, fine) in [(slow, fast), (fast, faster)] {
            let ratio = coarse[kind] / fine[kind];
            assert!(
                (6.0..12.0).contains(&ratio),
                "{kind}: {slow:?}, {fast:?}, {faster:?}"
            );
        }
    }
    assert!(faster[0] < 1e-3 && faster[1] < 3e-5, "{faster:?}");
}

/// All agree within the first step, on the velocity that the layer (4.23) ends at.
#[test]
fn the_layer_takes_one_step() {
    let world = load("djokam-rathinam/fast-0.001");
    let start = FastFlocking::new(&world)
        .expect("it has a reduced model")
        .start;
    let mut run = Simulation::new(load("djokam-rathinam/fast-0.001")).expect("a finite start");
    run.step().expect("a finite state");
    for velocity in run.snapshot().velocities {
        // In one step steering adds 0.01 times an acceleration of about 10.
        assert!((velocity - start).norm() < 0.15, "{velocity} {start}");
    }
    assert!(volary::metric::diameter(run.snapshot().velocities) < 1e-3);
}
