//! G. A. Djokam and M. Rathinam, "A generalized model of flocking with steering".

mod acceleration_bound;

use super::Claim;

/// The paper's claims, in its order.
pub(super) fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    vec![Box::new(acceleration_bound::AccelerationBound)]
}
