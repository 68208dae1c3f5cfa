//! States of our own, and what the law makes of them.

use std::sync::{Arc, Mutex};

use serde_json::{Value, json};
use volary::law::{Flock, Law, Link, State, build};
use volary::math::{Gain, Vector};
use volary::sense::Scene;
use volary::shape::{Geometry, In};
use volary::world::World;

use crate::common;
pub use crate::common::{Dice, accelerations};

/// A world of agents far apart whose states tests make up, under one alignment law.
pub fn world<const D: usize>(masses: &[f64], law: Value, more: Value) -> World<D>
where
    In<D>: Geometry<D>,
{
    let place = |k: usize| {
        let mut at = vec![0.0; D];
        at[0] = 1e4 + 10.0 * k as f64;
        at
    };
    let mut file = json!({
        "dimension": D, "time": { "end": 1 },
        "agents": [{
            "name": "flock", "radius": 0.3, "mass": masses,
            "positions": { "explicit": (0..masses.len()).map(place).collect::<Vec<_>>() }
        }],
        "laws": [{ "alignment": law }]
    });
    for (name, value) in more.as_object().expect("an object") {
        file[name] = value.clone();
    }
    common::world(common::spec(file))
}

/// What a law says of one agent: a_ij by the agents of the world, a_ii in its place, and the
/// gain; nothing where it does not act on it.
pub type Row = Option<(Vec<f64>, Gain)>;

/// A law that passes on another's accelerations and writes down its pulls.
struct Probe<const D: usize> {
    law: Box<dyn Law<D>>,
    rows: Arc<Mutex<Vec<Row>>>,
}

impl<const D: usize> Law<D> for Probe<D> {
    fn name(&self) -> &str {
        "probe"
    }

    fn range(&self) -> f64 {
        self.law.range()
    }

    fn prepare(&mut self, scene: &Scene<'_, D>) {
        self.law.prepare(scene);
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        let mut rows = self.rows.lock().expect("nobody panicked");
        for (k, out) in out.iter_mut().enumerate() {
            let i = first + k;
            let mut alone = [Vector::zeros()];
            self.law.accelerate(scene, i, &mut alone);
            *out += alone[0];
            // What stands in the list already must stay.
            let before = Link {
                index: 7,
                weight: 0.5,
                velocity: Vector::zeros(),
            };
            let mut links = vec![before];
            let Some(pull) = self.law.pull(scene, i, &mut links) else {
                assert!(links.len() == 1 && alone[0].norm() == 0.0);
                continue;
            };
            assert_eq!(links.remove(0), before);
            let u: Vector<D> = (links.iter())
                .map(|link| (link.velocity - scene.velocities[i]) * link.weight)
                .sum();
            let (found, expected) = (alone[0], pull.gain.of(&u));
            assert!((found - expected).norm() <= 1e-14 * expected.norm());
            let mut row = vec![0.0; scene.agents.len()];
            let me = scene.agents[i] as usize;
            for link in &links {
                row[scene.agents[link.index] as usize] += link.weight;
            }
            row[me] = pull.own;
            rows[me] = Some((row, pull.gain));
        }
    }
}

/// The accelerations by a law, and its rows; by one call for each agent.
pub fn probe<const D: usize>(
    law: Box<dyn Law<D>>,
    state: &State<'_, D>,
) -> (Vec<Vector<D>>, Vec<Row>) {
    let rows = Arc::new(Mutex::new(vec![None; state.positions.len()]));
    let probe = Probe {
        law,
        rows: Arc::clone(&rows),
    };
    let mut out = vec![Vector::zeros(); state.positions.len()];
    Flock::new(vec![Box::new(probe)]).accelerations(state, &mut out);
    let rows = std::mem::take(&mut *rows.lock().expect("nobody panicked"));
    (out, rows)
}

/// The first law of a world.
pub fn law<const D: usize>(world: &World<D>) -> Box<dyn Law<D>> {
    build(world).remove(0)
}
