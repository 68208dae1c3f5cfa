//! Shi, Wang & Chu, on flocks whose velocity interactions are asymmetric and whose masses differ.

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![]
}
