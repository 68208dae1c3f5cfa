//! Blows against exact mechanics: who meets, when, where and how hard.

#[path = "../common/mod.rs"]
mod common;
mod friction;
mod gas;
mod pairs;
mod scales;
mod shapes;
mod solids;
mod together;
mod walls;

use common::{spec, world};
use serde_json::Value;
use volary::dynamics::{Bodies, Engine, Touch};
use volary::law::Flock;
use volary::math::Vector;
use volary::shape::In;

/// What a run of bodies under no law came to.
pub struct Run<const D: usize> {
    /// Everything that touched, step by step.
    pub touches: Vec<Touch<D>>,
    /// Positions and velocities at the end.
    pub positions: Vec<Vector<D>>,
    /// Velocities at the end.
    pub velocities: Vec<Vector<D>>,
    /// Angular velocities; none where nothing turns.
    pub spins: Vec<Vector<3>>,
    /// The bodies themselves.
    pub bodies: Bodies<D>,
}

/// Runs a world for some steps.
pub fn run<const D: usize>(json: Value, steps: usize) -> Run<D>
where
    In<D>: Engine<D>,
{
    let world = world::<D>(spec(json));
    let mut flock = Flock::of_world(&world, Vec::new());
    let mut bodies = Bodies::new(&world, &mut flock).expect("a finite start");
    let mut touches = Vec::new();
    for _ in 0..steps {
        bodies.step(&mut flock).expect("a finite step");
        touches.extend(bodies.touches().iter().cloned());
    }
    let last = bodies.snapshot();
    Run {
        touches,
        positions: last.positions.to_vec(),
        velocities: last.velocities.to_vec(),
        spins: last.spins.unwrap_or_default().to_vec(),
        bodies,
    }
}

impl<const D: usize> Run<D> {
    /// The touches at which something was struck.
    pub fn blows(&self) -> Vec<&Touch<D>> {
        self.touches
            .iter()
            .filter(|touch| touch.blow > 0.0)
            .collect()
    }
}

/// The coordinates of a vector.
pub fn list<const D: usize>(vector: &Vector<D>) -> Vec<f64> {
    vector.iter().copied().collect()
}
