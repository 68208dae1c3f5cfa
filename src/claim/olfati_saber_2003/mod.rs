//! R. Olfati Saber, "Flocking with obstacle avoidance", 2003.

mod approximation;
mod balance;
mod energy;
mod flocking;
mod locality;
mod model;
mod momentum;
mod no_contact;
mod separation;
mod zero;

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![
        Box::new(balance::Balanced),
        Box::new(balance::MeanHeading),
        Box::new(locality::Locality),
        Box::new(zero::ZeroPotential),
        Box::new(zero::ZeroMotion),
        Box::new(zero::ConstantDistances),
        Box::new(zero::ZeroEnergy),
        Box::new(approximation::PRINTED),
        Box::new(approximation::CORRECTED),
        Box::new(energy::NONSMOOTH),
        Box::new(energy::SwitchingEnergies),
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
        Box::new(separation::ControllerBounds),
    ]
}
