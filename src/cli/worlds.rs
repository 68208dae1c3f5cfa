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
        return print(&list());
    };
    match shipped::get(name) {
        Some(text) => print(text),
        None => {
            let hint = match shipped::nearest(name) {
                Some(near) => format!("did you mean {near}?"),
                None => "`volary worlds` lists them".to_owned(),
            };
            Err(Refusal::bad_input(format!(
                "{name}: no shipped world of that name; {hint}"
            )))
        }
    }
}

/// The shipped worlds, each with what it shows.
fn list() -> String {
    let mut text = String::new();
    for name in shipped::names() {
        text += &format!("{name}\n");
        if let Some(description) = shipped::get(&name).and_then(description) {
            text += &format!("    {description}\n");
        }
    }
    text
}

fn description(text: &str) -> Option<String> {
    let world: serde_json::Value = serde_json::from_str(text).ok()?;
    Some(world.get("description")?.as_str()?.to_owned())
}
