//! Laws that pull velocities towards others.

use std::ops::Range;

use crate::law::Law;
use crate::math::{Gain, Vector};
use crate::sense::Scene;

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

/// The pulls of some laws on all agents, by the world's indices of agents.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pulls<const D: usize> {
    rows: Vec<Row<D>>,
    terms: Vec<(u32, f64)>,
    /// Scratch.
    links: Vec<Link<D>>,
}

/// The pull of one law on one agent, with what it perceives taken apart: the velocities
/// that it is told as they are, whose changes it follows, and the others, which stay what
/// it was told.
#[derive(Debug, Clone, PartialEq)]
pub struct Row<const D: usize> {
    /// The agent.
    pub agent: usize,
    /// Its gain.
    pub gain: Gain,
    /// Its influence on itself.
    pub own: f64,
    /// Σ a_ij over its links.
    pub weight: f64,
    /// Σ a_ij over those links whose velocity it is told otherwise than it is.
    pub told_weight: f64,
    /// Σ a_ij v_j over the same.
    pub told: Vector<D>,
    terms: Range<usize>,
}

impl<const D: usize> Pulls<D> {
    /// Forgets all pulls.
    pub fn clear(&mut self) {
        self.rows.clear();
        self.terms.clear();
    }

    /// Whether nothing pulls.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Adds the pulls of a law that is prepared for this scene.
    pub fn add(&mut self, law: &dyn Law<D>, scene: &Scene<'_, D>) {
        for (agent, i) in scene.in_world_order(|i| i).enumerate() {
            self.links.clear();
            let Some(pull) = law.pull(scene, i, &mut self.links) else {
                continue;
            };
            let begin = self.terms.len();
            let (mut weight, mut told_weight, mut told) = (0.0, 0.0, Vector::zeros());
            for link in &self.links {
                weight += link.weight;
                if link.velocity == scene.velocities[link.index] {
                    self.terms.push((scene.agents[link.index], link.weight));
                } else {
                    told_weight += link.weight;
                    told += link.velocity * link.weight;
                }
            }
            self.rows.push(Row {
                agent,
                gain: pull.gain,
                own: pull.own,
                weight,
                told_weight,
                told,
                terms: begin..self.terms.len(),
            });
        }
    }

    /// The pulls, law by law.
    pub fn rows(&self) -> &[Row<D>] {
        &self.rows
    }

    /// The other agents that a row follows, each with its influence a_ij.
    pub fn terms(&self, row: &Row<D>) -> impl Iterator<Item = (usize, f64)> {
        let terms = self.terms[row.terms.clone()].iter();
        terms.map(|&(agent, weight)| (agent as usize, weight))
    }

    /// The number of other agents that a row follows.
    pub fn count(&self, row: &Row<D>) -> usize {
        row.terms.len()
    }

    /// u_i = Σ_j a_ij (v_j − v_i) of a row, at these velocities.
    pub fn drive(&self, row: &Row<D>, velocities: &[Vector<D>]) -> Vector<D> {
        let velocity = velocities[row.agent];
        let mut sum = row.told - velocity * row.told_weight;
        for (agent, weight) in self.terms(row) {
            sum += (velocities[agent] - velocity) * weight;
        }
        sum
    }
}

#[cfg(test)]
impl<const D: usize> Pulls<D> {
    /// Pulls by a matrix of influences, each row with a gain.
    pub(crate) fn by_matrix(gains: &[Gain], influences: &[Vec<f64>]) -> Self {
        let mut pulls = Self::default();
        for (agent, (gain, row)) in gains.iter().zip(influences).enumerate() {
            let begin = pulls.terms.len();
            let others = row
                .iter()
                .enumerate()
                .filter(|(j, w)| *j != agent && **w > 0.0);
            pulls
                .terms
                .extend(others.map(|(j, weight)| (j as u32, *weight)));
            let terms = begin..pulls.terms.len();
            pulls.rows.push(Row {
                agent,
                gain: *gain,
                own: row[agent],
                weight: pulls.terms[begin..].iter().map(|(_, weight)| weight).sum(),
                told_weight: 0.0,
                told: Vector::zeros(),
                terms,
            });
        }
        pulls
    }

    /// Adds influences of velocities that an agent is told otherwise than they are.
    pub(crate) fn tell(&mut self, agent: usize, weight: f64, velocity: Vector<D>) {
        let row = &mut self.rows[agent];
        row.weight += weight;
        row.told_weight += weight;
        row.told += velocity * weight;
    }
}
