//! `volary worlds`: the worlds that the binary carries.

use clap::Args;
use volary::world::shipped;

use super::{Refusal, print};

/// Arguments of `volary worlds`.
#[derive(Debug, Args)]
pub(super) struct WorldsArguments {
    /// Print the file of this world, to start one of your own from
    name: Option<String>,
}

/// Lists the shipped worlds, or prints one.
pub(super) fn worlds(arguments: &WorldsArguments) -> Result<(), Refusal> {
    let Some(name) = &arguments.name else {
        for name in shipped::names() {
            print(&format!("{name}\n"));
            if let Some(description) = shipped::get(&name).and_then(description) {
                print(&format!("    {description}\n"));
            }
        }
        return Ok(());
    };
    match shipped::get(name) {
        Some(text) => print(text),
        None => {
            let hint = shipped::nearest(name).map(|near| format!("; did you mean {near}?"));
            return Err(Refusal::bad_input(format!(
                "{name}: no shipped world of that name{}",
                hint.unwrap_or_default()
            )));
        }
    }
    Ok(())
}

fn description(text: &str) -> Option<String> {
    let world: serde_json::Value = serde_json::from_str(text).ok()?;
    Some(world.get("description")?.as_str()?.to_owned())
}
