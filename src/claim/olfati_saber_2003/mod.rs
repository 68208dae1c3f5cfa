//! R. Olfati Saber, "Flocking with obstacle avoidance", 2003.

mod approximation;
mod balance;
mod controller_bounds;
mod energy;
mod flocking;
mod locality;
mod mean_heading;
mod model;
mod momentum;
mod no_contact;
mod separation;
mod switching;
mod zero;
mod zero_energy;
mod zero_motion;
mod zero_potential;

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![
        Box::new(balance::Balanced),
        Box::new(mean_heading::MeanHeading),
        Box::new(locality::Locality),
        Box::new(zero_potential::ZeroPotential),
        Box::new(zero_motion::ZeroMotion),
        Box::new(zero_motion::ConstantDistances),
        Box::new(zero_energy::ZeroEnergy),
        Box::new(approximation::PRINTED),
        Box::new(approximation::CORRECTED),
        Box::new(energy::NONSMOOTH),
        Box::new(switching::SwitchingEnergies),
        Box::new(flocking::NONSMOOTH),
        Box::new(energy::SMOOTH),
        Box::new(energy::WEIGHTED),
        Box::new(flocking::SMOOTH),
        Box::new(flocking::WEIGHTED),
        Box::new(no_contact::NoContact),
        Box::new(momentum::Momentum),
        Box::new(separation::STRUCTURAL),
        Box::new(separation::TRANSLATIONAL),
        Box::new(separation::WHOLE),
        Box::new(controller_bounds::ControllerBounds),
    ]
}
