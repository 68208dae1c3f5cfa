//! `volary check`: whether worlds can run, without running them.

use clap::Args;
use volary::world::{AnyWorld, World};

use super::summary::plural;
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
            Ok(AnyWorld::Plane(sound)) => print(&describe(world, &sound))?,
            Ok(AnyWorld::Space(sound)) => print(&describe(world, &sound))?,
            Err(Refusal::BadInput(complaint)) => complaints.push(complaint.trim_end().to_owned()),
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
    format!(
        "{name}: sound; {D}-D, {}, {}, {}, {}\n",
        plural(world.agents.len() as u64, "agent"),
        plural(world.obstacles.len() as u64, "obstacle"),
        plural(world.spec.laws.len() as u64, "law"),
        plural(world.steps(), "step")
    )
}
