//! How the agents pull each other.

use nalgebra::DMatrix;

use crate::law::Field;
use crate::math::{Gain, Vector};

/// How all agents pull each other in some state.
pub(super) struct Coupling {
    /// a_ij, a_ii included.
    pub influences: DMatrix<f64>,
    /// The gain of each agent; 0 of those that nothing pulls.
    pub gains: Vec<Gain>,
}

impl Coupling {
    /// Where the first law of a field pulls each agent.
    pub fn of<const D: usize>(
        field: &mut Field<'_, D>,
        time: f64,
        positions: &[Vector<D>],
        velocities: &[Vector<D>],
    ) -> Self {
        let count = positions.len();
        let mut coupling = Self {
            influences: DMatrix::zeros(count, count),
            gains: vec![Gain::Constant(0.0); count],
        };
        let (flock, state) = field.at(time, positions, velocities);
        let pulls = flock.pulls_of_law(0, &state);
        for row in pulls.rows() {
            coupling.gains[row.agent] = row.gain;
            coupling.influences[(row.agent, row.agent)] = row.own;
            for (agent, weight) in pulls.terms(row) {
                coupling.influences[(row.agent, agent)] += weight;
            }
        }
        coupling
    }

    /// Q: how fast each agent turns to each other one where all velocities are nearly the
    /// same, and minus the sum of the row on the diagonal.
    pub fn rates(&self) -> DMatrix<f64> {
        let mut rates = self.influences.clone();
        for i in 0..rates.nrows() {
            let gain = self.gains[i].largest();
            rates[(i, i)] = 0.0;
            rates.row_mut(i).scale_mut(gain);
            rates[(i, i)] = -rates.row(i).iter().sum::<f64>();
        }
        rates
    }
}
