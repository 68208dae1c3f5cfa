//! Runs a shipped world from Rust and looks at it on the way.
//!
//! `cargo run --release --example run_world`

use std::ops::ControlFlow;

use volary::simulation::Simulation;
use volary::trace::Record;
use volary::world::{AnyWorld, Document, shipped};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = "olfati-saber-2003/six-obstacles";
    let text = shipped::get(name).ok_or("the world is shipped")?;
    // A world is data: any field can be set from outside the file.
    let changes = ["seed=7".parse()?, "time.end=40".parse()?];
    let document = Document::new(name, text).with(changes);
    let AnyWorld::Plane(world) = document.world(name)? else {
        return Err("the world is flat".into());
    };
    let mut simulation = Simulation::new(world)?;

    // Every record goes by here: frames as sampled, contacts as they end.
    let summary = simulation.run(
        |record| {
            match record {
                Record::Frame(frame) if frame.step % 500 == 0 => {
                    let metrics = frame.metrics.unwrap_or_default();
                    println!("t = {:>4}  density {:.2?}", frame.time, metrics.density);
                }
                Record::Contact(contact) => println!("{contact:?}"),
                _ => {}
            }
            Ok::<_, std::convert::Infallible>(())
        },
        // Every step goes by here; breaking ends the run.
        |_state| ControlFlow::Continue(()),
    )?;
    println!(
        "{} contacts between agents",
        summary.agent_contacts.episodes
    );
    Ok(())
}
