//! Metrics: pure functions of a state, and the ledger of contacts.

mod classes;
mod collision;
mod correlation;
mod diameter;
mod energy;
mod gap;
mod influence;
mod lattice;
mod laws;
mod ledger;
mod milling;
mod net_record;
mod observation;
mod order;
mod parting;
mod pattern;
mod tracking;

pub use collision::{collision_ratio, obstacle_safety, safety};
pub use correlation::{cluster_correlation, order};
pub use diameter::diameter;
pub use energy::{center_of_mass, kinetic_energy, largest_kinetic_energy, relative_kinetic_energy};
pub use gap::{agent_gap, obstacle_gap};
pub use influence::Influences;
pub use lattice::{deviation_energy, union};
pub use laws::{Terms, laws_record};
pub use ledger::{Ledger, PARTED};
pub use milling::{milling, rotation};
pub use net_record::NetAnalysis;
pub use observation::{Aligned, Observation};
pub use order::{polarization, velocity_mismatch};
pub use parting::share_apart;
pub use pattern::{ball_residual, line_residual};
pub use tracking::target_errors;

use crate::dynamics::Snapshot;
use crate::math::{Vector, mean};
use crate::net::{Components, Net, structural_energy};
use crate::trace::record::Metrics;
use crate::world::World;

/// All metrics of a state of `world`. Of the smallest gaps so far a state knows no more than those
/// of now.
pub fn measure<const D: usize>(world: &World<D>, snapshot: &Snapshot<'_, D>) -> Metrics {
    let alpha = world.alpha_interaction();
    let net = alpha.map(|alpha| Net::new(snapshot.positions, alpha.range));
    let clusters = net.as_ref().map(Net::partition);
    let center = mean(snapshot.velocities);
    let targets = world.navigation_velocities().into_iter();
    let targets: Vec<Vector<D>> = targets.map(|target| target.unwrap_or(center)).collect();
    let target_of = world.agents.group.iter().map(|&group| targets[group]);
    let collisions = collision_ratio(world, snapshot);
    let (agent_gap, obstacle_gap) = (agent_gap(world, snapshot), obstacle_gap(world, snapshot));
    Metrics {
        components: clusters.as_ref().map(Components::count),
        density: clusters.as_ref().map(Components::density),
        edges: net.as_ref().map(|net| net.edges().len()),
        structural_energy: alpha
            .zip(net.as_ref())
            .map(|(alpha, net)| {
                structural_energy(snapshot.positions, snapshot.velocities, net, &alpha.pair())
            })
            .and_then(computable),
        polarization: polarization(snapshot.velocities),
        velocity_mismatch: velocity_mismatch(snapshot.velocities, target_of),
        agent_gap,
        obstacle_gap,
        smallest_agent_gap: agent_gap,
        smallest_obstacle_gap: obstacle_gap,
        position_diameter: diameter(snapshot.positions),
        velocity_diameter: diameter(snapshot.velocities),
        largest_component: clusters.as_ref().map(Components::largest),
        smallest_component: clusters.as_ref().map(Components::smallest),
        union: clusters.as_ref().and_then(union),
        deviation_energy: alpha
            .zip(net.as_ref())
            .map(|(alpha, net)| deviation_energy(snapshot.positions, net, alpha.spacing))
            .and_then(computable),
        order: order(snapshot.velocities),
        cluster_correlation: clusters
            .as_ref()
            .and_then(|clusters| cluster_correlation(snapshot.velocities, clusters)),
        milling: milling(snapshot.positions, snapshot.velocities),
        rotation: Some(rotation(snapshot.positions, snapshot.velocities)),
        collision_ratio: collisions,
        safety: collisions.map(|ratio| 1.0 - ratio),
        obstacle_safety: obstacle_safety(world, snapshot),
    }
}

/// A value, where it is one: parameters far from any purpose can make an energy overflow.
fn computable(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
