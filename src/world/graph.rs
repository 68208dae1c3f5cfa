//! The weights of the graphs that world files name.

use std::collections::BTreeMap;

use crate::world::random::{Purpose, Random};
use crate::world::spec::GraphSpec;

impl GraphSpec {
    /// The nonzero weights w_ij of a checked graph over some agents, in rows of (j, w_ij) by
    /// rising j, in a world with this seed; nothing where they are functions of time.
    pub fn rows(&self, agents: usize, seed: u64) -> Option<Vec<Vec<(usize, f64)>>> {
        let from = |weight: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<(usize, f64)>> {
            let row = |i: usize| {
                let others = (0..agents).filter(move |&j| j != i);
                let entries = others.map(|j| (j, weight(i, j)));
                entries.filter(|&(_, weight)| weight > 0.0).collect()
            };
            (0..agents).map(row).collect()
        };
        Some(match self {
            Self::Matrix(rows) => from(&|i, j| rows[i][j]),
            Self::Ring { weight, both_ways } => {
                let row = |i: usize| {
                    let next = (i + 1) % agents;
                    let before = both_ways.then_some((i + agents - 1) % agents);
                    let mut row: Vec<_> = before.into_iter().chain([next]).collect();
                    row.sort_unstable();
                    row.dedup();
                    row.retain(|&j| j != i && *weight > 0.0);
                    row.into_iter().map(|j| (j, *weight)).collect()
                };
                (0..agents).map(row).collect()
            }
            Self::Complete { weight } => from(&|_, _| *weight),
            Self::Random { arcs, number } => {
                let random = Random::new(seed, Purpose::Graph(*number));
                Circulation::new(agents, random).with_arcs(*arcs)
            }
            Self::OpenLoop(_) => return None,
        })
    }
}

/// A sum of directed cycles, each with a weight of its own: what flows into an agent flows
/// out of it.
struct Circulation {
    rows: Vec<BTreeMap<usize, f64>>,
    arcs: usize,
    random: Random,
    /// Scratch: the agents, their order changing.
    agents: Vec<usize>,
}

impl Circulation {
    fn new(agents: usize, random: Random) -> Self {
        Self {
            rows: vec![BTreeMap::new(); agents],
            arcs: 0,
            random,
            agents: (0..agents).collect(),
        }
    }

    /// Adds cycles until there are so many arcs, n to n(n − 1) for n agents. The first goes
    /// through all agents; the others through random ones, or where that brings nothing new,
    /// along one arc that is missing and back the shortest way.
    fn with_arcs(mut self, arcs: usize) -> Vec<Vec<(usize, f64)>> {
        self.add_random_cycle(self.rows.len());
        while self.arcs < arcs {
            let before = self.arcs;
            // A cycle has as many arcs as agents, so it cannot bring too many.
            let length = (arcs - before).min(self.rows.len());
            if length >= 2 {
                self.add_random_cycle(length);
            }
            if self.arcs == before {
                self.add_missing_arc();
            }
        }
        let weights = || self.rows.iter().flat_map(BTreeMap::values);
        let largest = weights().copied().fold(0.0, f64::max);
        let scale = match largest < 1.0 {
            true => 1.0,
            false => (0.5 + 0.5 * self.random.unit()) / largest,
        };
        let row = |row: &BTreeMap<usize, f64>| row.iter().map(|(&j, w)| (j, w * scale)).collect();
        self.rows.iter().map(row).collect()
    }

    fn add_random_cycle(&mut self, length: usize) {
        for place in 0..length {
            let other = place + self.below(self.agents.len() - place);
            self.agents.swap(place, other);
        }
        let cycle = self.agents[..length].to_vec();
        self.add_cycle(&cycle);
    }

    fn add_missing_arc(&mut self) {
        let n = self.rows.len();
        // The first one missing from a random place on: all are found in the end.
        let start = self.below(n * n);
        let places = (start..n * n).chain(0..start);
        let missing = |&(i, j): &(usize, usize)| i != j && !self.rows[i].contains_key(&j);
        if let Some((i, j)) = places.map(|place| (place / n, place % n)).find(missing) {
            let cycle = self.way(j, i);
            self.add_cycle(&cycle);
        }
    }

    /// Adds a cycle through these agents; its last arc leads back to the first.
    fn add_cycle(&mut self, cycle: &[usize]) {
        let weight = 1.0 - self.random.unit();
        for (place, &i) in cycle.iter().enumerate() {
            let j = cycle[(place + 1) % cycle.len()];
            let entry = self.rows[i].entry(j).or_insert_with(|| {
                self.arcs += 1;
                0.0
            });
            *entry += weight;
        }
    }

    /// The agents on a shortest way, its ends included. There is one: all agents are on the
    /// first cycle.
    fn way(&self, from: usize, to: usize) -> Vec<usize> {
        let mut before = vec![usize::MAX; self.rows.len()];
        let mut reached = vec![from];
        let mut next = 0;
        while before[to] == usize::MAX && next < reached.len() {
            let i = reached[next];
            next += 1;
            for &j in self.rows[i].keys() {
                if before[j] == usize::MAX && j != from {
                    before[j] = i;
                    reached.push(j);
                }
            }
        }
        let mut way = vec![to];
        while way[way.len() - 1] != from {
            way.push(before[way[way.len() - 1]]);
        }
        way.reverse();
        way
    }

    fn below(&mut self, n: usize) -> usize {
        // The last one where rounding leads beyond.
        ((self.random.unit() * n as f64) as usize).min(n - 1)
    }
}
