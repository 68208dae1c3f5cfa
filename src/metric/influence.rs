//! What alignment laws' influences say of a flock.

use nalgebra::DMatrix;

use crate::law::Pulls;
use crate::net::Adjacency;

/// The influences a_ij of one alignment law, a row for each agent that it acts on.
#[derive(Debug, Clone, PartialEq)]
pub struct Influences {
    /// The agents that the law acts on.
    agents: Vec<usize>,
    /// a_ij between them, a_ii included.
    matrix: DMatrix<f64>,
}

impl Influences {
    /// The influences of one law. Those of agents whose velocity is told otherwise than it is
    /// (late, or with errors), or on whom the law does not act, are left out.
    pub fn new<const D: usize>(pulls: &Pulls<D>) -> Self {
        let mut agents: Vec<usize> = pulls.rows().iter().map(|row| row.agent).collect();
        agents.sort_unstable();
        let place = |agent: usize| agents.binary_search(&agent).ok();
        let mut matrix = DMatrix::zeros(agents.len(), agents.len());
        for row in pulls.rows() {
            let Some(i) = place(row.agent) else { continue };
            matrix[(i, i)] += row.own;
            for (agent, weight) in pulls.terms(row) {
                if let Some(j) = place(agent) {
                    matrix[(i, j)] += weight;
                }
            }
        }
        Self { agents, matrix }
    }

    /// The agents that the law acts on, in order: those of rows and columns.
    pub fn agents(&self) -> &[usize] {
        &self.agents
    }

    /// The influences, the row of agent i holding what influences it.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// The influences between different agents, as a graph of the rows.
    pub fn adjacency(&self) -> Adjacency {
        let row = |row: nalgebra::RowDVector<f64>| row.iter().copied().enumerate().collect();
        Adjacency::new(
            self.matrix
                .row_iter()
                .map(|it| row(it.into_owned()))
                .collect(),
        )
    }

    /// The least influence: the largest θ with every agent in the global active set; 0 without
    /// agents.
    pub fn least(&self) -> f64 {
        let least = self.matrix.iter().copied().fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 0.0 }
    }

    /// λ(θ) = |Λ(θ)|, the number of agents j with a_pj ≥ θ for all p: Djokam & Rathinam,
    /// (3.4), (3.5).
    pub fn active(&self, theta: f64) -> usize {
        let columns = self.matrix.column_iter();
        columns
            .filter(|column| column.iter().all(|a| *a >= theta))
            .count()
    }

    /// λ_pq(θ): the number of agents j with a_pj ≥ θ and a_qj ≥ θ, for the rows p and q.
    /// Djokam & Rathinam, Theorem 1.
    pub fn active_for_both(&self, p: usize, q: usize, theta: f64) -> usize {
        let active = |&j: &usize| self.matrix[(p, j)] >= theta && self.matrix[(q, j)] >= theta;
        (0..self.agents.len()).filter(active).count()
    }
}
