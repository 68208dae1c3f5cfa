//! Planarity of a graph: can it be drawn in the plane without crossings?
//!
//! The left-right planarity test of H. de Fraysseix and P. Rosenstiehl in the form of U.
//! Brandes, "The left-right planarity test" (2009), without its last phase, which would
//! make a drawing. It is linear but for the sorting of edges.
//!
//! A depth-first search orients the edges away from its roots; those that do not belong to
//! its trees are *back edges* and end at an ancestor. A graph is planar exactly where its
//! back edges can be divided into left and right ones such that no two on the same side
//! conflict. The second search collects these constraints from the leaves up on a stack of
//! conflict pairs: two intervals of back edges that must go to different sides.

use crate::net::Net;

/// Whether the net, as an abstract graph, can be drawn in the plane without crossings.
/// Where its agents are does not matter: for the present drawing see
/// [`crossings`](crate::net::crossings).
pub fn is_planar(net: &Net) -> bool {
    // Euler: a planar graph of n ≥ 3 vertices has at most 3n − 6 edges.
    let few = net.agents() < 3 || net.edges().len() <= 3 * net.agents() - 6;
    few && {
        let orientation = Orientation::new(net);
        Constraints::new(&orientation).can_be_met()
    }
}

/// The first search: edges with directions, and where they lead back to.
struct Orientation {
    /// Depth of each vertex below its root.
    height: Vec<usize>,
    /// The edge by which the search came to each vertex; none for roots.
    parent: Vec<Option<usize>>,
    roots: Vec<usize>,
    /// Start and end of each edge, as oriented.
    ends: Vec<[usize; 2]>,
    /// The lowest height that each edge's subtree reaches by one back edge.
    low: Vec<usize>,
    /// The edges out of each vertex in nesting order.
    out: Vec<Vec<usize>>,
}

impl Orientation {
    fn new(net: &Net) -> Self {
        let (vertices, edges) = (net.agents(), net.edges().len());
        let mut around = vec![Vec::new(); vertices];
        for (edge, &[i, j]) in net.edges().iter().enumerate() {
            around[i].push((edge, j));
            around[j].push((edge, i));
        }
        let mut new = Self {
            height: vec![usize::MAX; vertices],
            parent: vec![None; vertices],
            roots: Vec::new(),
            ends: vec![[usize::MAX; 2]; edges],
            low: vec![0; edges],
            out: vec![Vec::new(); vertices],
        };
        // The second lowest height that each edge leads back to, and the nesting order.
        let mut second = vec![0; edges];
        let mut depth = vec![0; edges];
        // How many of each vertex' edges the search has looked at.
        let mut seen = vec![0; vertices];
        for root in 0..vertices {
            if new.height[root] != usize::MAX {
                continue;
            }
            new.height[root] = 0;
            new.roots.push(root);
            let mut path = vec![root];
            while let Some(&v) = path.last() {
                let Some(&(edge, w)) = around[v].get(seen[v]) else {
                    path.pop();
                    continue;
                };
                // A tree edge is met twice at its start: going down, and coming back.
                let back_from_child = new.parent[w] == Some(edge) && new.ends[edge][0] == v;
                if !back_from_child {
                    if new.ends[edge][0] != usize::MAX {
                        seen[v] += 1;
                        continue;
                    }
                    new.ends[edge] = [v, w];
                    new.low[edge] = new.height[v];
                    second[edge] = new.height[v];
                    if new.height[w] == usize::MAX {
                        new.parent[w] = Some(edge);
                        new.height[w] = new.height[v] + 1;
                        path.push(w);
                        continue;
                    }
                    new.low[edge] = new.height[w];
                }
                seen[v] += 1;
                let chordal = second[edge] < new.height[v];
                depth[edge] = 2 * new.low[edge] + usize::from(chordal);
                new.out[v].push(edge);
                if let Some(above) = new.parent[v] {
                    let (low, other) = (new.low[edge], second[edge]);
                    if low < new.low[above] {
                        second[above] = new.low[above].min(other);
                        new.low[above] = low;
                    } else if low > new.low[above] {
                        second[above] = second[above].min(low);
                    } else {
                        second[above] = second[above].min(other);
                    }
                }
            }
        }
        for out in &mut new.out {
            out.sort_by_key(|&edge| depth[edge]);
        }
        new
    }
}

/// Back edges on one side, from the one that returns lowest to the one that returns
/// highest, linked downwards by `below`.
#[derive(Clone, Copy, Default)]
struct Interval {
    low: Option<usize>,
    high: Option<usize>,
}

impl Interval {
    fn is_empty(&self) -> bool {
        self.low.is_none() && self.high.is_none()
    }
}

/// Two intervals that must go to different sides.
#[derive(Clone, Copy, Default)]
struct ConflictPair {
    left: Interval,
    right: Interval,
}

impl ConflictPair {
    fn swap(&mut self) {
        std::mem::swap(&mut self.left, &mut self.right);
    }
}

/// The second search.
struct Constraints<'a> {
    graph: &'a Orientation,
    stack: Vec<ConflictPair>,
    /// Height of the stack before each edge's subtree.
    bottom: Vec<usize>,
    /// The back edge by which each edge returns lowest.
    lowest: Vec<Option<usize>>,
    /// The next lower back edge of the same interval.
    below: Vec<Option<usize>>,
}

impl<'a> Constraints<'a> {
    fn new(graph: &'a Orientation) -> Self {
        let edges = graph.ends.len();
        Self {
            graph,
            stack: Vec::new(),
            bottom: vec![0; edges],
            lowest: vec![None; edges],
            below: vec![None; edges],
        }
    }

    fn can_be_met(mut self) -> bool {
        let graph = self.graph;
        let mut next = vec![0; graph.height.len()];
        for &root in &graph.roots {
            let mut path = vec![root];
            while let Some(&v) = path.last() {
                let Some(&edge) = graph.out[v].get(next[v]) else {
                    if let Some(above) = graph.parent[v] {
                        self.forget_those_that_end_above(above);
                    }
                    path.pop();
                    // The edge that led here is done: its start takes in what came of it.
                    let Some(&start) = path.last() else { continue };
                    let edge = graph.out[start][next[start]];
                    if !self.take_in(start, edge, next[start] == 0) {
                        return false;
                    }
                    next[start] += 1;
                    continue;
                };
                self.bottom[edge] = self.stack.len();
                let w = graph.ends[edge][1];
                if graph.parent[w] == Some(edge) {
                    path.push(w);
                    continue;
                }
                self.lowest[edge] = Some(edge);
                let alone = Interval {
                    low: Some(edge),
                    high: Some(edge),
                };
                self.stack.push(ConflictPair {
                    left: Interval::default(),
                    right: alone,
                });
                if !self.take_in(v, edge, next[v] == 0) {
                    return false;
                }
                next[v] += 1;
            }
        }
        true
    }

    /// Integrates the back edges that `edge`, out of `v`, leads to; false where they
    /// cannot be placed.
    fn take_in(&mut self, v: usize, edge: usize, first: bool) -> bool {
        if self.graph.low[edge] >= self.graph.height[v] {
            return true;
        }
        // It returns below v, so v is no root.
        let Some(above) = self.graph.parent[v] else {
            return true;
        };
        if first {
            self.lowest[above] = self.lowest[edge];
            return true;
        }
        self.add_constraints(edge, above)
    }

    fn add_constraints(&mut self, edge: usize, above: usize) -> bool {
        let low = &self.graph.low;
        let mut merged = ConflictPair::default();
        // The back edges of `edge` itself go to one side, the right one.
        while self.stack.len() > self.bottom[edge] {
            let Some(mut pair) = self.stack.pop() else {
                break;
            };
            if !pair.left.is_empty() {
                pair.swap();
            }
            if !pair.left.is_empty() {
                return false;
            }
            let Some(lowest) = pair.right.low else {
                continue;
            };
            if low[lowest] > low[above] {
                match merged.right.low {
                    None => merged.right = pair.right,
                    Some(end) => self.below[end] = pair.right.high,
                }
                merged.right.low = pair.right.low;
            } else {
                self.below[lowest] = self.lowest[above];
            }
        }
        // Those of earlier edges that conflict with it go to the left.
        while let Some(&top) = self.stack.last() {
            if !self.conflicts(&top.left, edge) && !self.conflicts(&top.right, edge) {
                break;
            }
            self.stack.pop();
            let mut pair = top;
            if self.conflicts(&pair.right, edge) {
                pair.swap();
            }
            if self.conflicts(&pair.right, edge) {
                return false;
            }
            if let Some(end) = merged.right.low {
                self.below[end] = pair.right.high;
            }
            if pair.right.low.is_some() {
                merged.right.low = pair.right.low;
            }
            match merged.left.low {
                None => merged.left = pair.left,
                Some(end) => self.below[end] = pair.left.high,
            }
            merged.left.low = pair.left.low;
        }
        if !(merged.left.is_empty() && merged.right.is_empty()) {
            self.stack.push(merged);
        }
        true
    }

    /// Whether an interval reaches higher than `edge` returns.
    fn conflicts(&self, interval: &Interval, edge: usize) -> bool {
        interval
            .high
            .is_some_and(|high| self.graph.low[high] > self.graph.low[edge])
    }

    /// The lowest height to which a pair returns.
    fn returns_to(&self, pair: &ConflictPair) -> Option<usize> {
        let ends = [pair.left.low, pair.right.low];
        ends.into_iter()
            .flatten()
            .map(|edge| self.graph.low[edge])
            .min()
    }

    /// Removes the back edges that end at the start of the tree edge `above`.
    fn forget_those_that_end_above(&mut self, above: usize) {
        let start = self.graph.ends[above][0];
        let height = self.graph.height[start];
        while let Some(top) = self.stack.last() {
            if self.returns_to(top) != Some(height) {
                break;
            }
            self.stack.pop();
        }
        if let Some(mut pair) = self.stack.pop() {
            let ConflictPair { left, right } = &mut pair;
            self.trim(left, right.low, start);
            self.trim(right, left.low, start);
            self.stack.push(pair);
        }
        if self.graph.low[above] < height
            && let Some(top) = self.stack.last()
        {
            let low = &self.graph.low;
            // The edge goes to the side of its highest return edge.
            self.below[above] = match (top.left.high, top.right.high) {
                (Some(left), Some(right)) if low[left] > low[right] => Some(left),
                (Some(left), None) => Some(left),
                (_, right) => right,
            };
        }
    }

    /// Cuts the back edges that end at `start` off the high end of an interval; one that
    /// is used up hangs on to the other side's lowest.
    fn trim(&mut self, interval: &mut Interval, other: Option<usize>, start: usize) {
        while let Some(high) = interval.high
            && self.graph.ends[high][1] == start
        {
            interval.high = self.below[high];
        }
        if interval.high.is_none()
            && let Some(low) = interval.low.take()
        {
            self.below[low] = other;
        }
    }
}
