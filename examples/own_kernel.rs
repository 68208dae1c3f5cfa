//! Alignment with functions of one's own, among the laws of a world file.
//!
//! `cargo run --release --example own_kernel`

use std::error::Error;

use volary::law::{Alignment, Law};
use volary::metric::diameter;
use volary::simulation::Simulation;
use volary::world::spec::LawSpec;
use volary::world::{AnyWorld, Document};

const WORLD: &str = r#"{
  "dimension": 2,
  "time": { "end": 20 },
  "agents": [{
    "count": 30, "radius": 0.3,
    "positions": { "ball": { "center": [0, 0], "radius": 12, "separation": 2 } },
    "velocities": { "ball": { "radius": 2 } }
  }],
  "laws": [{ "navigation": { "velocity": [1, 0], "velocity_gain": 0.1 } }]
}"#;

fn main() -> Result<(), Box<dyn Error>> {
    let AnyWorld::Plane(world) = Document::new("own", WORLD).world("own")? else {
        return Err("the world is flat".into());
    };
    // All that a world file could say of the law, but for its kernel and its gain.
    let spec: LawSpec =
        serde_json::from_str(r#"{ "alignment": { "normalisation": "motsch_tadmor" } }"#)?;
    let LawSpec::Alignment(spec) = spec else {
        return Err("it is an alignment law".into());
    };
    let alignment = Alignment::new(&spec, None, &world)
        // The influence φ, by the square of the distance.
        .with_kernel(|squared| 1.0 / (1.0 + squared * squared))
        // The gain α_i(t).
        .with_gain(|_agent, time| 1.0 + 0.5 * (time / 5.0));
    let laws: Vec<Box<dyn Law<2>>> = vec![Box::new(alignment)];
    let mut simulation = Simulation::with_laws(world, laws)?;
    for step in 1..=simulation.world().steps() {
        simulation.step()?;
        if step % 500 == 0 {
            let state = simulation.snapshot();
            let apart = diameter(state.velocities);
            println!(
                "t = {:2}: velocities differ by at most {apart:.3}",
                state.time
            );
        }
    }
    Ok(())
}
