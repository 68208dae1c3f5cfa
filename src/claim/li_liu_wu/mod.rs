//! X. Li, Y. Liu and J. Wu, "Flocking and pattern motion in a modified Cucker-Smale model".

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![]
}
