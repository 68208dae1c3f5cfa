//! Metrics: pure functions of a state, and the ledger of contacts.

mod diameter;
mod gap;
mod ledger;
mod net;
mod order;

pub use diameter::diameter;
pub use gap::{agent_gap, obstacle_gap};
pub use ledger::Ledger;
pub use net::Net;
pub use order::{polarization, structural_energy, velocity_mismatch};

use crate::dynamics::Snapshot;
use crate::math::mean;
use crate::trace::record::Metrics;
use crate::world::World;

/// All metrics of a state of `world`.
pub fn measure<const D: usize>(world: &World<D>, snapshot: &Snapshot<'_, D>) -> Metrics {
    let alpha = world.alpha_interaction();
    let net = alpha.map(|alpha| Net::new(snapshot.positions, alpha.range));
    let target = world
        .navigation_velocity()
        .unwrap_or_else(|| mean(snapshot.velocities));
    Metrics {
        components: net.as_ref().map(|net| net.components().len()),
        density: net.as_ref().map(Net::density),
        edges: net.as_ref().map(|net| net.edges().len()),
        structural_energy: alpha.zip(net.as_ref()).map(|(alpha, net)| {
            structural_energy(snapshot.positions, snapshot.velocities, net, &alpha.pair())
        }),
        polarization: polarization(snapshot.velocities),
        velocity_mismatch: velocity_mismatch(snapshot.velocities, &target),
        agent_gap: agent_gap(world, snapshot),
        obstacle_gap: obstacle_gap(world, snapshot),
        position_diameter: diameter(snapshot.positions),
        velocity_diameter: diameter(snapshot.velocities),
    }
}
