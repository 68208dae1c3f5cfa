//! Overlaps of bodies that a file puts next to each other, by their exact shapes.
//!
//! Placement knows bodies by the balls that hold them, which is enough for those that it
//! draws places for and all there is to know of balls. Bodies of other shapes may stand closer
//! than that; this looks at them once all stand.

use std::collections::BTreeMap;

use crate::shape::{Obstacle, Solid};
use crate::world::agents::Agents;
use crate::world::placement::{ROUNDING, agent_name, misplaced};
use crate::world::problem::Problem;
use crate::world::spec::{GroupSpec, PlacementSpec};
use crate::world::words::number;

/// What is in the way of every body with a given place that, or whose neighbour, is not round.
pub(super) fn overlaps<const D: usize>(
    groups: &[GroupSpec],
    solids: &[Solid<D>],
    agents: &Agents<D>,
    obstacles: &[Obstacle<D>],
) -> Vec<Problem> {
    // How the file says where a body is; nothing where its place is drawn.
    let kind = |i: usize| match &groups[agents.group[i]].positions {
        PlacementSpec::Explicit(_) => Some("explicit"),
        PlacementSpec::Grid(_) => Some("grid"),
        PlacementSpec::Line(_) => Some("line"),
        PlacementSpec::Box(_) | PlacementSpec::Ball(_) | PlacementSpec::Hexagonal(_) => None,
    };
    let fixed = |i: usize| kind(i).is_some();
    let ball = |i: usize| solids[agents.group[i]].is_ball();
    if !(0..agents.len()).any(fixed) || solids.iter().all(Solid::is_ball) {
        return Vec::new();
    }
    let solid = |i: usize| &solids[agents.group[i]];
    // The index of the first agent of each group.
    let mut first = vec![0; groups.len()];
    for (i, group) in agents.group.iter().enumerate().rev() {
        first[*group] = i;
    }
    let name = |i: usize| {
        let group = agents.group[i];
        agent_name(group, i - first[group], kind(i) == Some("explicit"))
    };
    // Each body whose place is given, with the first other in its way.
    let mut found: BTreeMap<usize, String> = BTreeMap::new();
    let mut pairs: Vec<_> = near_pairs(agents, |i| agents.radius[i]).collect();
    pairs.sort_unstable();
    for (a, b) in pairs {
        let (one, other) = (a.max(b), a.min(b));
        if !fixed(one) || (ball(a) && ball(b)) {
            continue;
        }
        let touching = -ROUNDING * (agents.radius[a] + agents.radius[b]);
        let gap = solid(a).gap(&agents.pose(a), solid(b), &agents.pose(b));
        if gap < touching {
            let depth = number(-gap);
            let what = format!("overlaps {}, by {depth}", name(other));
            found.entry(one).or_insert(what);
        }
    }
    for i in (0..agents.len()).filter(|i| fixed(*i) && !ball(*i)) {
        let reach = agents.radius[i];
        for (index, obstacle) in obstacles.iter().enumerate() {
            if !obstacle.may_reach(&agents.positions[i], reach) {
                continue;
            }
            let gap = obstacle.gap(solid(i), &agents.pose(i));
            if gap < -ROUNDING * reach {
                let what = format!(
                    "overlaps obstacles[{index}], {}, by {}",
                    obstacle.name,
                    number(-gap)
                );
                found.entry(i).or_insert(what);
            }
        }
    }
    let problem = |(i, what): (usize, String)| match kind(i) {
        Some(kind @ ("grid" | "line")) => {
            let group = agents.group[i];
            misplaced(group, kind, i - first[group], &what)
        }
        _ => Problem::new(name(i), what),
    };
    found.into_iter().map(problem).collect()
}

/// The pairs of agents that are nearer to each other than the reaches of both add up to, by a
/// sweep along an axis; in its order, the agent that comes first in the world first.
pub(super) fn near_pairs<const D: usize>(
    agents: &Agents<D>,
    reach: impl Fn(usize) -> f64,
) -> impl Iterator<Item = (usize, usize)> {
    // Along the axis over which they are spread most, few stand side by side.
    let spread = |k: usize| {
        let places = agents.positions.iter().map(|at| at[k]);
        places.clone().fold(f64::MIN, f64::max) - places.fold(f64::MAX, f64::min)
    };
    let along = (0..D)
        .max_by(|a, b| spread(*a).total_cmp(&spread(*b)))
        .unwrap_or(0);
    let starts: Vec<f64> = (0..agents.len())
        .map(|i| agents.positions[i][along] - reach(i))
        .collect();
    let mut order: Vec<usize> = (0..agents.len()).collect();
    order.sort_by(|&a, &b| starts[a].total_cmp(&starts[b]).then(a.cmp(&b)));
    (0..order.len()).flat_map(move |rank| {
        let a = order[rank];
        let end = agents.positions[a][along] + reach(a);
        let near = order[rank + 1..].iter().copied();
        let near = near.take_while(|&b| starts[b] <= end).filter(|&b| {
            let apart = (agents.positions[a] - agents.positions[b]).norm();
            apart < reach(a) + reach(b)
        });
        let pairs: Vec<_> = near.map(|b| (a.min(b), a.max(b))).collect();
        pairs
    })
}
