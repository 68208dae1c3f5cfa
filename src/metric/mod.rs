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
use crate::math::{Vector, mean};
use crate::trace::record::Metrics;
use crate::world::World;

/// All metrics of a state of `world`.
pub fn measure<const D: usize>(world: &World<D>, snapshot: &Snapshot<'_, D>) -> Metrics {
    let alpha = world.alpha_interaction();
    let net = alpha.map(|alpha| Net::new(snapshot.positions, alpha.range));
    let center = mean(snapshot.velocities);
    let targets: Vec<Vector<D>> = (0..world.spec.agents.len())
        .map(|group| world.navigation_velocity_of(group).unwrap_or(center))
        .collect();
    let errors: Vec<Vector<D>> = (snapshot.velocities.iter().zip(&world.agents.group))
        .map(|(velocity, &group)| velocity - targets[group])
        .collect();
    let radii = &world.agents.radius;
    Metrics {
        components: net.as_ref().map(|net| net.components().len()),
        density: net.as_ref().map(Net::density),
        edges: net.as_ref().map(|net| net.edges().len()),
        structural_energy: alpha.zip(net.as_ref()).map(|(alpha, net)| {
            structural_energy(snapshot.positions, snapshot.velocities, net, &alpha.pair())
        }),
        polarization: polarization(snapshot.velocities),
        velocity_mismatch: velocity_mismatch(&errors, &Vector::zeros()),
        agent_gap: agent_gap(snapshot.positions, radii),
        obstacle_gap: obstacle_gap(snapshot.positions, radii, snapshot.obstacles),
        position_diameter: diameter(snapshot.positions),
        velocity_diameter: diameter(snapshot.velocities),
    }
}
