//! `volary check`: whether worlds can run, without running them.

use clap::Args;
use volary::world::{AnyWorld, World};

use super::{Refusal, load, print};

/// Arguments of `volary check`.
#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    /// World files, or names of shipped worlds
    #[arg(required = true, value_name = "WORLD")]
    worlds: Vec<String>,
}

/// Checks each world; reports all that is wrong with any of them.
pub(super) fn check(arguments: &CheckArguments) -> Result<(), Refusal> {
    let mut complaints = Vec::new();
    for world in &arguments.worlds {
        match load::load(world, Vec::new()) {
            Ok(AnyWorld::Plane(sound)) => print(&describe(world, &sound)),
            Ok(AnyWorld::Space(sound)) => print(&describe(world, &sound)),
            Err(Refusal::BadInput(complaint)) => complaints.push(complaint),
            Err(other) => return Err(other),
        }
    }
    if complaints.is_empty() {
        Ok(())
    } else {
        Err(Refusal::BadInput(complaints.join("\n")))
    }
}

fn describe<const D: usize>(name: &str, world: &World<D>) -> String {
    let count = |n: usize, thing: &str, things: &str| match n {
        0 => format!("no {things}"),
        1 => format!("1 {thing}"),
        n => format!("{n} {things}"),
    };
    format!(
        "{name}: sound; {D}-D, {}, {}, {}, {} steps\n",
        count(world.agents.len(), "agent", "agents"),
        count(world.obstacles.len(), "obstacle", "obstacles"),
        count(world.spec.laws.len(), "law", "laws"),
        world.steps()
    )
}
