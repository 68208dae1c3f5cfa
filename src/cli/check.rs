//! `volary check`: whether worlds can run, without running them.

use clap::Args;
use volary::net::{Adjacency, is_strongly_connected, symmetric_connectivity};
use volary::world::spec::LawSpec;
use volary::world::{AnyWorld, World};

use super::summary::plural;
use super::{Refusal, load, print, strain};

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
        match load::load(world, Vec::new(), false) {
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
    let mut text = format!(
        "{name}: sound; {D}-D, {}, {}, {}, {}\n",
        plural(world.agents.len() as u64, "agent"),
        plural(world.obstacles.len() as u64, "obstacle"),
        plural(world.spec.laws.len() as u64, "law"),
        plural(world.steps(), "step")
    );
    for (number, (_, law)) in world.laws().enumerate() {
        if let LawSpec::Alignment(alignment) = law
            && let Some(graph) = &alignment.graph
        {
            let net = graph.rows(world.agents.len(), world.spec.seed);
            let graph = match net {
                Some(rows) => describe_graph(&Adjacency::new(rows)),
                None => "its weights are functions of time".to_owned(),
            };
            text.push_str(&format!("  alignment, law {number}: {graph}\n"));
        }
    }
    text.push_str(&strain::before(world).unwrap_or_default());
    text
}

/// Above so many agents the eigenvalues of their net take too long.
const MOST_AGENTS: usize = 1000;

fn describe_graph(net: &Adjacency) -> String {
    let connected = match (is_strongly_connected(net), net.partition().is_flock()) {
        (true, _) => "strongly connected",
        (false, true) => "weakly connected only",
        (false, false) => "not connected",
    };
    let balance = match net.is_balanced() {
        true => "balanced".to_owned(),
        false => format!("out of balance by up to {:.3e}", net.imbalance()),
    };
    let arcs = plural(net.arcs() as u64, "arc");
    let eigenvalue = (net.agents() <= MOST_AGENTS).then(|| symmetric_connectivity(net));
    match eigenvalue.flatten() {
        Some(value) => format!("{arcs}, {connected}, {balance}, λ2(L + Lᵀ) = {value:.6}"),
        None => format!("{arcs}, {connected}, {balance}"),
    }
}
