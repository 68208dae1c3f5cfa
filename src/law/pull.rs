//! Laws that pull velocities towards others.

use crate::math::{Gain, Vector};

/// The pull of a law on one agent's velocity: v̇_i = g(|u_i|) u_i with
/// u_i = Σ_j a_ij (v_j − v_i), the sum over its links. Djokam & Rathinam, (2.7): with
/// Σ_j a_ij = 1, a_ii included, u_i = v̄_i − v_i.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// The gain g (1/time), divided by ε and mass where the law has it so.
    pub gain: Gain,
    /// The agent's influence on itself, a_ii, which pulls nowhere; 0 where it has none.
    pub own: f64,
}

/// One term of a pull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link<const D: usize> {
    /// The other agent, j, by its index in the scene.
    pub index: usize,
    /// Its influence a_ij ≥ 0, of dimension 1 where the gain is a rate.
    pub weight: f64,
    /// Its velocity, as the agent perceives it.
    pub velocity: Vector<D>,
}
