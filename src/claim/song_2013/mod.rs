//! Q. Song, F. Liu, J. Cao and J. Qiu, "Cucker-Smale flocking with bounded cohesive and repulsive
//! forces", 2013; with it what F. Cucker and J.-G. Dong, "Avoiding collisions in flocks", 2010,
//! guarantee, as it quotes them.

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![]
}
