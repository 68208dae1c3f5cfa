//! Projections onto every obstacle, against brute force and central differences.

mod convex;
mod many;
mod moving;

use serde_json::{Value, json};
use volary::math::Vector;
use volary::shape::{Geometry, In, Obstacle};
use volary::world::World;

/// An obstacle as a world file describes it.
pub fn obstacle<const D: usize>(spec: &Value) -> Obstacle<D>
where
    In<D>: Geometry<D>,
{
    // An agent must be somewhere, and clear of it.
    let places = [0.0, 0.4321, -1.7, 1e3].map(|x| vec![x; D]);
    let world = |place| {
        let world = json!({
            "dimension": D, "time": { "end": 1 },
            "agents": [{ "radius": 1e-6, "positions": { "explicit": [place] } }],
            "obstacles": [spec]
        });
        let world = serde_json::from_value(world).expect("well formed");
        World::<D>::new("test", world)
    };
    let mut found = places.into_iter().map(world);
    let world = found.find_map(Result::ok).expect("sound");
    world.obstacles.into_iter().next().expect("an obstacle")
}

/// The first `D` of some numbers.
pub fn along<const D: usize>(numbers: [f64; 3]) -> Vector<D> {
    Vector::from_fn(|k, _| numbers[k])
}
