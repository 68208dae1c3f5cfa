//! A number for each pair.

use rayon::prelude::*;

/// A number for each pair of some agents, or of none.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    /// Row by row: of an agent and those before it.
    numbers: Vec<f64>,
}

/// Below this many rows, handing them to other threads costs more than it saves: a row is many
/// times the work that an agent is elsewhere.
const ROWS_IN_PARALLEL: usize = 64;

impl Table {
    /// Forgets all, and takes so many agents: `fill` is to write the numbers of an agent and all
    /// those before it. Rows are shared by threads, and depend on none.
    pub(super) fn fill(&mut self, agents: usize, fill: impl Fn(usize, &mut [f64]) + Sync) {
        self.numbers.clear();
        self.numbers.resize(place(agents, 0), 0.0);
        let mut left = &mut self.numbers[..];
        let rows: Vec<_> = (0..agents)
            .map(|agent| (agent, left.split_off_mut(..agent).unwrap_or_default()))
            .collect();
        let fill = |(agent, row): (usize, &mut [f64])| fill(agent, row);
        if agents < ROWS_IN_PARALLEL {
            rows.into_iter().for_each(fill);
        } else {
            // The longest first.
            rows.into_par_iter().rev().with_max_len(1).for_each(fill);
        }
    }

    /// The number of two different agents, where it is known.
    #[inline]
    pub(super) fn get(&self, i: usize, j: usize) -> Option<f64> {
        self.numbers.get(place(i.max(j), i.min(j))).copied()
    }
}

fn place(high: usize, low: usize) -> usize {
    high * high.saturating_sub(1) / 2 + low
}
