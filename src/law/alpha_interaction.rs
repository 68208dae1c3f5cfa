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
//! On bodies `smooth_weighted_damping`, and any protocol but `nonsmooth` without damping, is of
//! second order in the step. The others jump at r, and are of first order once a link comes or goes.
//!
//! Two agents at the same point have no direction between them and exert no force.

use std::ops::Range;

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
        for (k, i) in (first..first + out.len()).enumerate() {
            let p = scene.velocities[i];
            scene.neighbours(i, self.pair.range, |neighbour| {
                if batch.len == PAIRS {
                    self.add(&mut batch, out);
                }
                batch.push(&p, &neighbour);
            });
            batch.end(k);
            if batch.agents == AGENTS {
                self.add(&mut batch, out);
            }
        }
        self.add(&mut batch, out);
    }
}

impl AlphaInteraction {
    /// Adds what the pairs of a batch exert to the sums of their agents, and empties it.
    fn add<const D: usize>(&self, batch: &mut Batch<D>, sums: &mut [Vector<D>]) {
        // Whole registers, be it that the last pairs are none.
        let lanes = ..batch.len.next_multiple_of(LANES);
        let (ratios, weights) = (&mut batch.ratios[lanes], &mut batch.weights[lanes]);
        self.pair
            .ratios_and_weights(&batch.squared[lanes], ratios, weights);
        let mut begin = 0;
        for &(agent, end) in &batch.ends[..batch.agents] {
            let [force, drift] = self.add_pairs(batch, begin..end);
            sums[agent] += force + drift * self.damping;
            batch.open = [Vector::zeros(); 2];
            begin = end;
        }
        batch.open = self.add_pairs(batch, begin..batch.len);
        (batch.len, batch.agents) = (0, 0);
    }

    /// What is open, and some pairs more.
    #[inline(always)]
    fn add_pairs<const D: usize>(&self, batch: &Batch<D>, pairs: Range<usize>) -> [Vector<D>; 2] {
        let [mut force, mut drift] = batch.open;
        for pair in pairs {
            let cone = batch.cones[pair];
            let weight = match self.weighted_damping {
                true => batch.weights[pair],
                false => 1.0,
            };
            force += batch.offsets[pair] * (batch.ratios[pair] * cone);
            drift += batch.velocities[pair] * (weight * cone);
        }
        [force, drift]
    }
}

/// Agents and pairs that are worked out together, at most.
const AGENTS: usize = 16;
const PAIRS: usize = 128;

/// Pairs in the widest registers.
const LANES: usize = 8;

/// Some agents, and pairs of each with its neighbours.
struct Batch<const D: usize> {
    /// The agents, and where the pairs of each end.
    ends: [(usize, usize); AGENTS],
    agents: usize,
    squared: [f64; PAIRS],
    offsets: [Vector<D>; PAIRS],
    /// Of the neighbour, less that of the agent.
    velocities: [Vector<D>; PAIRS],
    /// What cones of perception leave of it.
    cones: [f64; PAIRS],
    ratios: [f64; PAIRS],
    weights: [f64; PAIRS],
    len: usize,
    /// The force so far on the agent that has not ended, and the damping over its rate: one sum
    /// after the other, so that it does not matter where batches end.
    open: [Vector<D>; 2],
}

impl<const D: usize> Batch<D> {
    fn new() -> Self {
        Self {
            ends: [(0, 0); AGENTS],
            agents: 0,
            squared: [0.0; PAIRS],
            offsets: [Vector::zeros(); PAIRS],
            velocities: [Vector::zeros(); PAIRS],
            cones: [0.0; PAIRS],
            ratios: [0.0; PAIRS],
            weights: [0.0; PAIRS],
            len: 0,
            open: [Vector::zeros(); 2],
        }
    }

    #[inline]
    fn push(&mut self, velocity: &Vector<D>, neighbour: &Neighbour<D>) {
        let k = self.len;
        self.squared[k] = neighbour.squared;
        self.offsets[k] = neighbour.offset;
        self.velocities[k] = neighbour.velocity - velocity;
        self.cones[k] = neighbour.weight;
        self.len += 1;
    }

    /// Ends this agent: the pairs since the last end are its own.
    fn end(&mut self, agent: usize) {
        self.ends[self.agents] = (agent, self.len);
        self.agents += 1;
    }
}
