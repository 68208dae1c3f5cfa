//! Pairs of agents that may touch.

use rayon::prelude::*;

use super::STEPS;
use crate::dynamics::contact::CROWDED;
use crate::math::{Vector, mean};
use crate::parallel::{CHUNK, for_each};
use crate::sense::Cells;

/// Pairs of agents near each other.
#[derive(Debug)]
pub(in crate::dynamics::contact) struct Agents<const D: usize> {
    radii: Vec<f64>,
    /// Where agents were when the lists were made, and their mean.
    then: Vec<Vector<D>>,
    start: Vector<D>,
    /// Their mean now, and its way in the last step.
    mean: Vector<D>,
    common: Vector<D>,
    /// Half the gap up to which pairs are asked for; and the smallest radius.
    reach: f64,
    smallest: f64,
    /// How far each may go, and how far it has gone at most by the end of the step.
    budgets: Vec<f64>,
    ways: Vec<f64>,
    /// Pairs within their budgets, in their order, with the gap between the balls about them.
    pairs: Vec<(u32, u32, f64)>,
    /// For each agent the places of its pairs, made when they are asked for.
    own: Option<Own>,
    /// Whether someone left the budget in each chunk of agents.
    spent: Vec<bool>,
    /// Whether someone bounced so far beyond its way that pairs that are asked for may be missed.
    strayed: bool,
}

/// Where each agent's pairs are.
#[derive(Debug)]
struct Own {
    starts: Vec<u32>,
    places: Vec<u32>,
}

impl<const D: usize> Agents<D> {
    /// No lists yet, of agents within these radii.
    pub(in crate::dynamics::contact) fn new(radii: &[f64]) -> Self {
        Self {
            radii: radii.to_vec(),
            then: Vec::new(),
            start: Vector::zeros(),
            mean: Vector::zeros(),
            common: Vector::zeros(),
            reach: 0.0,
            smallest: radii.iter().copied().fold(f64::INFINITY, f64::min),
            budgets: Vec::new(),
            ways: Vec::new(),
            pairs: Vec::new(),
            own: None,
            spent: Vec::new(),
            strayed: false,
        }
    }

    /// Has the lists serve for a step that led from `from` to `to` on ways that bend by at most
    /// the lengths that `bend` tells, and for the start of the next; `gap` is the smallest gap so
    /// far, below which no pair must be missed.
    pub(in crate::dynamics::contact) fn follow(
        &mut self,
        [from, to]: [&[Vector<D>]; 2],
        bend: &(impl Fn(usize) -> f64 + Sync),
        gap: f64,
    ) {
        self.mean = mean(to);
        self.common = self.mean - mean(from);
        self.serve([from, to], bend, gap);
    }

    /// Has the lists serve again, after bounces in the same step.
    pub(in crate::dynamics::contact) fn follow_bounces(
        &mut self,
        ways: [&[Vector<D>]; 2],
        gap: f64,
    ) {
        if self.strayed || self.then.is_empty() {
            self.serve(ways, &|_| 0.0, gap);
        }
    }

    fn serve(
        &mut self,
        [from, to]: [&[Vector<D>]; 2],
        bend: &(impl Fn(usize) -> f64 + Sync),
        gap: f64,
    ) {
        self.strayed = false;
        let common = self.common;
        let travel = |i: usize| way(&from[i], &to[i], common) + bend(i);
        let reach = 0.5 * gap.clamp(0.0, f64::MAX);
        if self.then.len() == to.len() && reach <= self.reach && self.go(to, &travel) {
            return;
        }
        let average = (0..to.len()).map(travel).sum::<f64>() / to.len().max(1) as f64;
        // Somewhat more than what is asked for, so that they serve for a while.
        self.reach = match gap.is_finite() {
            true => 1.1 * reach,
            false => self.reach.max(0.5 * self.smallest),
        };
        let least = (STEPS * average).max(self.reach).max(1e-9 * self.smallest);
        let budgets = (0..to.len()).map(|i| self.spare(i) + least.max(2.0 * travel(i)));
        self.budgets = budgets.collect();
        self.ways = (0..to.len()).map(travel).collect();
        self.start = self.mean;
        self.then.clear();
        self.then.extend_from_slice(to);
        self.list();
    }

    /// What must be left of an agent's budget: a pair that is not listed is farther apart than
    /// what is left of both. So no pair is missed below the gap that is asked for, nor below the
    /// widest at which a pair may be held.
    fn spare(&self, agent: usize) -> f64 {
        self.reach.max(0.5 * CROWDED * self.radii[agent])
    }

    /// Takes note of how far agents are at most from where they were, now and in the
    /// step that led here; tells whether all are within their budgets.
    fn go(&mut self, to: &[Vector<D>], travel: &(impl Fn(usize) -> f64 + Sync)) -> bool {
        let common = self.mean - self.start;
        let agents = to.len();
        let mut spent = std::mem::take(&mut self.spent);
        let mut ways = std::mem::take(&mut self.ways);
        spent.resize(agents.div_ceil(CHUNK), false);
        let chunks = ways.par_chunks_mut(CHUNK).enumerate();
        for_each(agents, chunks.zip(&mut spent), |((chunk, ways), spent)| {
            *spent = false;
            for (k, i) in (chunk * CHUNK..).take(ways.len()).enumerate() {
                ways[k] = way(&self.then[i], &to[i], common) + travel(i);
                *spent |= ways[k] > self.budgets[i] - self.spare(i);
            }
        });
        (self.spent, self.ways) = (spent, ways);
        !self.spent.iter().any(|spent| *spent)
    }

    /// Notes that one agent ends the step elsewhere, having gone so far beyond its way. Where
    /// this is more than its budget, not all are listed whom it may touch.
    pub(in crate::dynamics::contact) fn stray(&mut self, agent: usize, way: f64) -> bool {
        self.ways[agent] += way;
        self.strayed |= self.ways[agent] > self.budgets[agent] - self.spare(agent);
        self.ways[agent] <= self.budgets[agent]
    }

    /// Visits the pairs whose gap may be below `gap` in the step.
    pub(in crate::dynamics::contact) fn below(
        &self,
        gap: f64,
        mut visit: impl FnMut(usize, usize),
    ) {
        for &(one, other, apart) in &self.pairs {
            let (one, other) = (one as usize, other as usize);
            if apart - self.ways[one] - self.ways[other] < gap {
                visit(one, other);
            }
        }
    }

    /// The others with which an agent may touch.
    pub(in crate::dynamics::contact) fn of(&mut self, agent: usize, out: &mut Vec<usize>) {
        let own = self.own.get_or_insert_with(|| {
            let mut starts = vec![0u32; self.then.len() + 1];
            for &(one, other, _) in &self.pairs {
                starts[one as usize + 1] += 1;
                starts[other as usize + 1] += 1;
            }
            for k in 1..starts.len() {
                starts[k] += starts[k - 1];
            }
            let mut next = starts.clone();
            let mut places = vec![0; 2 * self.pairs.len()];
            for (place, &(one, other, _)) in self.pairs.iter().enumerate() {
                for agent in [one, other] {
                    let at = &mut next[agent as usize];
                    places[*at as usize] = place as u32;
                    *at += 1;
                }
            }
            Own { starts, places }
        });
        let range = own.starts[agent] as usize..own.starts[agent + 1] as usize;
        out.extend(own.places[range].iter().map(|&place| {
            let (one, other, _) = self.pairs[place as usize];
            (one as usize ^ other as usize) ^ agent
        }));
    }

    /// Whether pairs with any gap below this are listed.
    pub(in crate::dynamics::contact) fn reach(&self) -> f64 {
        2.0 * self.reach
    }

    /// Has pairs listed so far that there is one, when the lists are to serve again.
    pub(in crate::dynamics::contact) fn widen(&mut self) {
        // Neighbours in the order of an axis tell how near the nearest are at least.
        let mut nearest = f64::INFINITY;
        let mut order: Vec<usize> = (0..self.then.len()).collect();
        for axis in 0..D {
            order.sort_by(|&a, &b| self.then[a][axis].total_cmp(&self.then[b][axis]));
            for pair in order.windows(2) {
                let [one, other] = [pair[0], pair[1]];
                let apart = (self.then[one] - self.then[other]).norm();
                nearest = nearest.min(apart - self.radii[one] - self.radii[other]);
            }
        }
        self.reach = (2.0 * self.reach).max(0.51 * nearest.min(f64::MAX));
        self.then.clear();
    }

    /// Lists the pairs within their budgets.
    fn list(&mut self) {
        self.own = None;
        self.pairs.clear();
        let then = &self.then;
        let widths: Vec<f64> = self
            .radii
            .iter()
            .zip(&self.budgets)
            .map(|(r, b)| r + b)
            .collect();
        // One class of widths for each power of two, so that a wide agent has no say in how
        // the narrow ones are looked for.
        let class = |i: usize| widths[i].log2().ceil() as i32;
        let mut classes: std::collections::BTreeMap<i32, Vec<u32>> = Default::default();
        for i in 0..then.len() {
            classes.entry(class(i)).or_default().push(i as u32);
        }
        let mut cells = Cells::default();
        let classes: Vec<(i32, Vec<u32>)> = classes.into_iter().collect();
        for (k, (level, members)) in classes.iter().enumerate() {
            let places: Vec<Vector<D>> = members.iter().map(|&i| then[i as usize]).collect();
            let widest = f64::from(*level).exp2();
            cells.rebuild(&places, (2.0 * widest).max(f64::MIN_POSITIVE));
            for (_, seekers) in &classes[k..] {
                let find = |&i: &u32| {
                    let mut found = Vec::new();
                    let me = i as usize;
                    cells.for_each_within(&then[me], widths[me] + widest, |place, _, _| {
                        let other = members[cells.order()[place] as usize];
                        let j = other as usize;
                        let apart = (then[j] - then[me]).norm();
                        let near = apart <= widths[me] + widths[j];
                        // Each pair once: from the wider class, or in one class from the first.
                        let mine = class(j) < class(me) || me < j;
                        if j != me && near && mine {
                            let gap = apart - self.radii[me] - self.radii[j];
                            found.push((i.min(other), i.max(other), gap));
                        }
                    });
                    found
                };
                let more: Vec<Vec<(u32, u32, f64)>> = match seekers.len() < 500 {
                    true => seekers.iter().map(find).collect(),
                    false => seekers.par_iter().map(find).collect(),
                };
                self.pairs.extend(more.into_iter().flatten());
            }
        }
        self.pairs
            .sort_unstable_by_key(|&(one, other, _)| (one, other));
    }
}

/// How far two places are from each other, but for a common motion; a hair more, against
/// rounding.
fn way<const D: usize>(from: &Vector<D>, to: &Vector<D>, common: Vector<D>) -> f64 {
    (to - from - common).norm() * (1.0 + 1e-9) + 1e-12 * (common.amax() + to.amax() * 1e-3)
}
