//! Random scenes, and a law that writes down what it is told.

use std::sync::{Arc, Mutex};

use serde_json::{Value, json};
use volary::law::{Flock, Law, State};
use volary::math::Vector;
use volary::sense::{Neighbour, Scene};
use volary::shape::{Geometry, In};
use volary::world::World;

pub use crate::common::Dice;

use crate::common;

/// A world of groups with these sizes and senses, under no law; its agents stand in a row,
/// far off, since only the states that tests make up count.
pub fn world<const D: usize>(groups: &[(usize, Value)], more: Value) -> World<D>
where
    In<D>: Geometry<D>,
{
    let mut file = json!({ "dimension": D, "time": { "step": 0.1, "end": 10 }, "agents": [] });
    let mut placed = 0;
    for (n, (count, sensing)) in groups.iter().enumerate() {
        let position = |k: usize| {
            let mut at = vec![0.0; D];
            at[0] = 1e4 + 10.0 * k as f64;
            at
        };
        let positions: Vec<_> = (placed..placed + count).map(position).collect();
        placed += count;
        let group = json!({
            "name": format!("group {n}"), "radius": 0.4 + 0.2 * n as f64,
            "positions": { "explicit": positions }, "sensing": sensing
        });
        file["agents"].as_array_mut().expect("a list").push(group);
    }
    for (name, value) in more.as_object().expect("an object") {
        file[name] = value.clone();
    }
    common::world(common::spec(file))
}

/// A law that wants nothing and writes down whom each agent perceives.
pub struct Spy<const D: usize> {
    range: f64,
    seen: Arc<Mutex<Vec<Told<D>>>>,
}

/// Who perceives whom, by index in the world, and how.
pub type Told<const D: usize> = (usize, usize, Neighbour<D>);

impl<const D: usize> Law<D> for Spy<D> {
    fn name(&self) -> &str {
        "spy"
    }

    fn range(&self) -> f64 {
        self.range
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        let mut seen = self.seen.lock().expect("nobody panicked");
        for i in first..first + out.len() {
            scene.neighbours(i, self.range, |neighbour| {
                let agent = |place: usize| scene.agents[place] as usize;
                seen.push((agent(i), agent(neighbour.index), neighbour));
            });
        }
    }
}

/// A flock whose only law, besides those of the world, is a spy.
pub struct Watch<const D: usize> {
    pub flock: Flock<D>,
    seen: Arc<Mutex<Vec<Told<D>>>>,
}

impl<const D: usize> Watch<D> {
    pub fn new(world: &World<D>, range: f64) -> Self {
        let seen = Arc::default();
        let spy = Spy {
            range,
            seen: Arc::clone(&seen),
        };
        Self {
            flock: Flock::of_world(world, vec![Box::new(spy)]),
            seen,
        }
    }

    /// What agents are told in a state, sorted by who and whom.
    pub fn look(&mut self, state: &State<'_, D>) -> Vec<Told<D>> {
        let mut out = vec![Vector::zeros(); state.positions.len()];
        self.flock.accelerations(state, &mut out);
        let mut seen = std::mem::take(&mut *self.seen.lock().expect("nobody panicked"));
        seen.sort_by_key(|&(i, j, _)| (i, j));
        seen
    }
}

/// The pairs for which something holds, in order.
pub fn pairs(n: usize, holds: impl Fn(usize, usize) -> bool) -> Vec<[usize; 2]> {
    let all = (0..n).flat_map(|i| (0..n).map(move |j| [i, j]));
    all.filter(|&[i, j]| i != j && holds(i, j)).collect()
}

/// The pairs of what was told.
pub fn who<const D: usize>(told: &[Told<D>]) -> Vec<[usize; 2]> {
    told.iter().map(|&(i, j, _)| [i, j]).collect()
}
