//! G. A. Djokam and M. Rathinam, "A generalized model of flocking with steering".

mod acceleration_bound;
mod closed_loop;
mod common_influence;
mod damped;
mod existence;
mod fast;
mod flocking;
mod friction;
mod friction_power;
mod gain_infimum;
mod layer_invariant;
mod layer_limit;
mod leading_order;
mod mill_ring;
mod model;
mod position_diameter;
mod psi;
mod ring;
mod spread;
mod velocity_diameter;
mod velocity_hull;

use super::Claim;
use existence::Existence;
use flocking::{Factor, Flocking, FlockingRate};
use friction::Friction;
use layer_invariant::LayerInvariant;
use layer_limit::LayerLimit;
use leading_order::LeadingOrder;
use mill_ring::MillRing;
use velocity_diameter::VelocityDiameter;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![
        Box::new(acceleration_bound::AccelerationBound),
        Box::new(Friction::Rest),
        Box::new(friction_power::FrictionPower),
        Box::new(Friction::DecayPrinted),
        Box::new(Friction::DecayCorrected),
        Box::new(MillRing::Lemma),
        Box::new(MillRing::Sharpened),
        Box::new(common_influence::CommonInfluence),
        Box::new(velocity_hull::VelocityHull),
        Box::new(position_diameter::PositionDiameter),
        Box::new(VelocityDiameter::Theorem),
        Box::new(VelocityDiameter::Sharpened),
        Box::new(VelocityDiameter::Corollary),
        Box::new(VelocityDiameter::Corrected),
        Box::new(gain_infimum::GainInfimum),
        Box::new(Flocking(Factor::Printed)),
        Box::new(Flocking(Factor::Corrected)),
        Box::new(Flocking(Factor::Sharpened)),
        Box::new(FlockingRate(Factor::Printed)),
        Box::new(FlockingRate(Factor::Corrected)),
        Box::new(FlockingRate(Factor::Sharpened)),
        Box::new(LeadingOrder::Printed),
        Box::new(LeadingOrder::Corrected),
        Box::new(LayerInvariant::Printed),
        Box::new(LayerInvariant::Corrected),
        Box::new(LayerLimit::Printed),
        Box::new(LayerLimit::Corrected),
        Box::new(Existence::Printed),
        Box::new(Existence::Corrected),
    ]
}
