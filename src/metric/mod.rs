//! Metrics: pure functions of a state, and the ledger of contacts.

mod diameter;
mod gap;
mod ledger;
mod order;

pub use diameter::diameter;
pub use gap::{agent_gap, obstacle_gap};
pub use ledger::Ledger;
pub use order::{polarization, velocity_mismatch};

pub use crate::net::{Net, structural_energy};

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
    let radii = &world.agents.radius;
    Metrics {
        components: net.as_ref().map(|net| net.components().len()),
        density: net.as_ref().map(Net::density),
        edges: net.as_ref().map(|net| net.edges().len()),
        structural_energy: alpha.zip(net.as_ref()).map(|(alpha, net)| {
            structural_energy(snapshot.positions, snapshot.velocities, net, &alpha.pair())
        }),
        polarization: polarization(snapshot.velocities),
        velocity_mismatch: velocity_mismatch(snapshot.velocities, &target),
        agent_gap: agent_gap(snapshot.positions, radii),
        obstacle_gap: obstacle_gap(snapshot.positions, radii, &world.obstacles),
        position_diameter: diameter(snapshot.positions),
        velocity_diameter: diameter(snapshot.velocities),
    }
}
