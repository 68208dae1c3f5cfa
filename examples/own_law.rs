//! A law of one's own, beside those of a world file, without touching the crate.
//!
//! `cargo run --release --example own_law`

use volary::law::Law;
use volary::math::Vector;
use volary::sense::Scene;
use volary::simulation::Simulation;
use volary::world::{AnyWorld, Document};

/// Turns the flock about its centre: u_i = ω J (q_i − q̄) − (p_i − p̄), with J a quarter turn.
struct Whirl {
    rate: f64,
}

impl Law<2> for Whirl {
    fn name(&self) -> &str {
        "whirl"
    }

    fn accelerate(&self, scene: &Scene<'_, 2>, first: usize, out: &mut [Vector<2>]) {
        for (k, acceleration) in out.iter_mut().enumerate() {
            let arm = scene.positions[first + k] - scene.mean_position;
            let drift = scene.velocities[first + k] - scene.mean_velocity;
            *acceleration += Vector::<2>::new(-arm.y, arm.x) * self.rate - drift;
        }
    }
}

const WORLD: &str = r#"{
  "dimension": 2,
  "time": { "end": 20 },
  "agents": [{
    "count": 30, "radius": 0.3,
    "positions": { "ball": { "center": [0, 0], "radius": 10, "separation": 2 } }
  }],
  "laws": [{ "alpha_interaction": { "spacing": 3, "range": 4 } }]
}"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let AnyWorld::Plane(world) = Document::new("whirl", WORLD).world("whirl")? else {
        return Err("the world is flat".into());
    };
    let mut simulation = Simulation::with_laws(world, vec![Box::new(Whirl { rate: 0.1 })])?;
    for step in 1..=simulation.world().steps() {
        simulation.step()?;
        if step % 500 == 0 {
            let state = simulation.snapshot();
            let spin: f64 = state
                .positions
                .iter()
                .zip(state.velocities)
                .map(|(q, p)| q.perp(p))
                .sum();
            println!("t = {:>4}  angular momentum {spin:.1}", state.time);
        }
    }
    Ok(())
}
