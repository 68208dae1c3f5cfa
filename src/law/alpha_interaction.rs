//! The (α, α) protocols.
//!
//! u_i = Σ_j f(|q_j − q_i|) n_ij + c1 w_ij (p_j − p_i) over the neighbours j within r,
//! with n_ij the unit vector from i to j.
//! R. Olfati-Saber, "Flocking with Obstacle Avoidance", 2003.
//!
//! | protocol | f | w_ij | source |
//! |---|---|---|---|
//! | `nonsmooth` | φ_α | 1 | (34) |
//! | `smooth` | a_ij φ_α + ρ'ψ_α/r | 1 | (35) |
//! | `smooth_weighted_damping` | as `smooth` | a_ij | (35), with the weight that later papers give the damping |
//! | `approximate` | a_ij φ_α | 1 | (36) |
//!
//! | parameter | symbol | unit |
//! |---|---|---|
//! | `spacing` | d_α | length |
//! | `range` | r | length |
//! | `damping` | c1 | 1/time |
//! | `action.attraction`, `action.repulsion` | a, b | acceleration |
//! | `bump_start` | k0 | 1 |
//!
//! The forces on a pair are equal and opposite, so the sum over equal masses is zero, as long
//! as both perceive each other as they are.
//!
//! A smooth cone of perception multiplies the whole contribution of j by
//! ρ(|θ_j − θ_i|/φ0), (18). In `smooth_weighted_damping` and `approximate` that is a_ij
//! itself; in `smooth` the force is still the exact gradient, since headings do not depend on
//! positions; and what the print leaves unweighted, the force of `nonsmooth` and the damping,
//! is weighted by the cone as well.
//!
//! Two agents at the same point have no direction between them and exert no force.

use crate::law::Law;
use crate::math::{AlphaPair, Fade, Vector};
use crate::sense::{Neighbour, Scene};
use crate::world::spec::{AlphaInteractionSpec, AlphaProtocol};

/// The (α, α) protocols; see the module.
#[derive(Debug, Clone)]
pub struct AlphaInteraction {
    pair: AlphaPair,
    damping: f64,
    weighted_damping: bool,
}

impl AlphaInteraction {
    /// The law with the parameters of a world file.
    pub fn new(spec: &AlphaInteractionSpec) -> Self {
        Self {
            pair: spec.pair(),
            damping: spec.damping,
            weighted_damping: spec.protocol == AlphaProtocol::SmoothWeightedDamping,
        }
    }
}

impl<const D: usize> Law<D> for AlphaInteraction {
    fn name(&self) -> &str {
        "alpha_interaction"
    }

    fn range(&self) -> f64 {
        self.pair.range
    }

    fn jump(&self) -> Option<f64> {
        let sharp = self.pair.fade == Fade::Sharp;
        let damped_to_the_end = self.damping != 0.0 && !self.weighted_damping;
        (sharp || damped_to_the_end).then_some(self.pair.range)
    }

    fn accelerate(&self, scene: &Scene<'_, D>, first: usize, out: &mut [Vector<D>]) {
        let mut batch = Batch::new();
        let mut sums = [Vector::zeros(); AGENTS];
        for (block, out) in out.chunks_mut(AGENTS).enumerate() {
            let first = first + block * AGENTS;
            sums.fill(Vector::zeros());
            for k in 0..out.len() {
                let p = scene.velocities[first + k];
                scene.neighbours(first + k, self.pair.range, |neighbour| {
                    batch.push(k, p, &neighbour);
                    if batch.len == PAIRS {
                        self.add(&mut batch, &mut sums);
                    }
                });
            }
            self.add(&mut batch, &mut sums);
            for (acceleration, sum) in out.iter_mut().zip(&sums) {
                *acceleration += sum;
            }
        }
    }
}

impl AlphaInteraction {
    /// Adds what the pairs of a batch exert to their agents' sums, and empties it.
    fn add<const D: usize>(&self, batch: &mut Batch<D>, sums: &mut [Vector<D>; AGENTS]) {
        let n = batch.len;
        let (ratios, weights) = (&mut batch.ratios[..n], &mut batch.weights[..n]);
        self.pair
            .ratios_and_weights(&batch.squared[..n], ratios, weights);
        for pair in 0..n {
            let cone = batch.cones[pair];
            let weight = match self.weighted_damping {
                true => batch.weights[pair],
                false => 1.0,
            };
            let sum = &mut sums[batch.agents[pair] as usize];
            *sum += batch.offsets[pair] * (batch.ratios[pair] * cone);
            *sum += batch.velocities[pair] * (self.damping * weight * cone);
        }
        batch.len = 0;
    }
}

/// Agents whose pairs are gathered together.
const AGENTS: usize = 32;

/// Pairs that are worked out together.
const PAIRS: usize = 256;

/// Pairs of agents and their neighbours, component by component.
struct Batch<const D: usize> {
    len: usize,
    /// The agent of each pair, counted from the first of the block.
    agents: [u8; PAIRS],
    squared: [f64; PAIRS],
    offsets: [Vector<D>; PAIRS],
    /// Of the neighbour, less that of the agent.
    velocities: [Vector<D>; PAIRS],
    /// What cones of perception leave of it.
    cones: [f64; PAIRS],
    ratios: [f64; PAIRS],
    weights: [f64; PAIRS],
}

impl<const D: usize> Batch<D> {
    fn new() -> Self {
        Self {
            len: 0,
            agents: [0; PAIRS],
            squared: [0.0; PAIRS],
            offsets: [Vector::zeros(); PAIRS],
            velocities: [Vector::zeros(); PAIRS],
            cones: [0.0; PAIRS],
            ratios: [0.0; PAIRS],
            weights: [0.0; PAIRS],
        }
    }

    #[inline]
    fn push(&mut self, agent: usize, velocity: Vector<D>, neighbour: &Neighbour<D>) {
        let k = self.len;
        self.agents[k] = agent as u8;
        self.squared[k] = neighbour.squared;
        self.offsets[k] = neighbour.offset;
        self.velocities[k] = neighbour.velocity - velocity;
        self.cones[k] = neighbour.weight;
        self.len += 1;
    }
}
