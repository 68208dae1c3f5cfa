//! X. Li, Y. Liu and J. Wu, "Flocking and pattern motion in a modified Cucker-Smale model".

mod bounded;
mod energy;
mod figures;
mod mean_velocity;
mod model;
mod projected_rate;
mod theorem_3_1;

use bounded::Bounded;
use energy::Energy;
use figures::Figures;
use theorem_3_1::Theorem31;

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![
        Box::new(mean_velocity::MeanVelocity),
        Box::new(Theorem31::Flock),
        Box::new(Theorem31::Velocity),
        Box::new(Theorem31::Line),
        Box::new(Energy::RatePrinted),
        Box::new(Energy::Rate),
        Box::new(Energy::NeverRises),
        Box::new(Bounded::EightPrinted),
        Box::new(Bounded::Eight),
        Box::new(Bounded::Diameter),
        Box::new(projected_rate::ProjectedRate),
        Box::new(Bounded::Projected),
        Box::new(Energy::UniformRatePrinted),
        Box::new(Energy::UniformRate),
        Box::new(Figures::Line),
        Box::new(Figures::Ball),
    ]
}
