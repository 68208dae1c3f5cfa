//! R. Olfati Saber, "Flocking with obstacle avoidance", 2003.

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![]
}
