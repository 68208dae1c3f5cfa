//! Q. Song, F. Liu, J. Cao and J. Qiu, "Cucker-Smale flocking with bounded cohesive and repulsive
//! forces", 2013; with it what F. Cucker and J.-G. Dong, "Avoiding collisions in flocks", 2010,
//! and J. Park, H. J. Kim and S.-Y. Ha, "Cucker-Smale flocking with inter-particle bonding
//! forces", 2010, show, as it quotes them.

mod bonding_force;
mod cohesion;
mod collision_avoidance;
mod cucker_dong;
mod distances;
mod energy_never_rises;
mod energy_rate;
mod lemma_9;
mod mean_velocity;
mod model;
mod pair_energy;
mod park;
mod repulsion_force;
mod velocity_consensus;

use bonding_force::BondingForce;
use cohesion::Cohesion;
use collision_avoidance::{CollisionAvoidance, Sharpness};
use cucker_dong::CuckerDong;
use distances::smallest_distance;
use model::Model;
use park::Park;
use repulsion_force::RepulsionForce;

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    let mut claims: Vec<Box<dyn Claim<D>>> = vec![
        Box::new(CuckerDong::Printed),
        Box::new(CuckerDong::Corrected),
        Box::new(CuckerDong::Sharpened),
        Box::new(CuckerDong::Consensus),
        Box::new(Park::Printed),
        Box::new(Park::Sharpened),
        Box::new(lemma_9::Lemma9),
    ];
    claims.extend(theorem(Model::Bonded));
    claims.push(Box::new(BondingForce::Stray));
    claims.push(Box::new(BondingForce::Bonds));
    claims.push(Box::new(BondingForce::BondsSharpened));
    claims.extend(repulsion(Model::Bonded));
    claims.extend(theorem(Model::Attracted));
    claims.push(Box::new(Cohesion {
        model: Model::Attracted,
        sharpened: true,
    }));
    claims.push(Box::new(BondingForce::AttractionPrinted));
    claims.push(Box::new(BondingForce::Attraction));
    claims.extend(repulsion(Model::Attracted));
    claims
}

/// What Theorems 10 and 16 say alike.
fn theorem<const D: usize>(model: Model) -> Vec<Box<dyn Claim<D>>> {
    let avoidance = |sharpness| Box::new(CollisionAvoidance { model, sharpness });
    vec![
        Box::new(mean_velocity::MeanVelocity(model)),
        Box::new(energy_never_rises::EnergyNeverRises(model)),
        Box::new(energy_rate::EnergyRate(model)),
        Box::new(Cohesion {
            model,
            sharpened: false,
        }),
        Box::new(velocity_consensus::VelocityConsensus(model)),
        avoidance(Sharpness::Printed),
        avoidance(Sharpness::Sharpened),
        avoidance(Sharpness::Sharpest),
    ]
}

/// What Remarks 13 and 17 say alike.
fn repulsion<const D: usize>(model: Model) -> Vec<Box<dyn Claim<D>>> {
    [false, true]
        .map(|sharpened| Box::new(RepulsionForce { model, sharpened }) as Box<dyn Claim<D>>)
        .into()
}
