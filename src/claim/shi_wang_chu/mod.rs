//! Shi, Wang & Chu, on flocks whose velocity interactions are asymmetric and whose masses differ.
//!
//! Theorem 1 says five things: that energy falls, that velocities agree, that agents neither
//! meet nor part, and what they end in; each is a claim of its own. Its remarks carry them over
//! to law (15) and Theorem 3 to damping, so these claims cover both where the proof does.

mod agreement;
mod center_invariance;
mod collision;
mod common_velocity;
mod damped_rest;
mod damping;
mod descent;
mod distances;
mod energy;
mod minimum;
mod model;
mod rate;
mod strong_connectivity;

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![
        Box::new(strong_connectivity::StrongConnectivity),
        Box::new(energy::EnergyFalls),
        Box::new(agreement::Agreement),
        Box::new(collision::Collision { sharpened: false }),
        Box::new(collision::Collision { sharpened: true }),
        Box::new(distances::BoundedDistances),
        Box::new(minimum::GlobalMinimum),
        Box::new(minimum::CriticalPoint),
        Box::new(center_invariance::CenterInvariance),
        Box::new(common_velocity::CommonVelocity),
        Box::new(rate::PRINTED),
        Box::new(rate::HALVED),
        Box::new(rate::CORRECTED),
        Box::new(damped_rest::DampedRest),
    ]
}
