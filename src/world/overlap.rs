//! Overlaps of bodies that a file puts next to each other, by their exact shapes.
//!
//! Placement knows bodies by the balls that hold them, which is enough for those that it
//! draws places for and all there is to know of balls. Bodies of other shapes may stand closer
//! than that; this looks at them once all stand.

use std::collections::BTreeMap;

use crate::shape::{Boxes, Obstacle, Reach, Solid};
use crate::world::agents::Agents;
use crate::world::placement::{ROUNDING, agent_name, misplaced};
use crate::world::problem::Problem;
use crate::world::spec::{GroupSpec, PlacementSpec};
use crate::world::standing::Standing;
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
    // Each body whose place is given, with the first other in its way. As for those that are
    // drawn, who is in somebody's way is in nobody else's, so that many at one place are no more
    // work than many apart.
    let mut found: BTreeMap<usize, String> = BTreeMap::new();
    let rooms = solids.iter().map(|solid| 2.0 * solid.radius());
    let mut standing = Standing::new(rooms);
    for one in 0..agents.len() {
        let (at, room) = (&agents.positions[one], 2.0 * agents.radius[one]);
        let in_the_way = |other: usize| {
            let reach = agents.radius[one] + agents.radius[other];
            if (ball(one) && ball(other)) || (agents.positions[other] - at).norm() >= reach {
                return None;
            }
            let gap = solid(one).gap(&agents.pose(one), solid(other), &agents.pose(other));
            (gap < -ROUNDING * reach).then_some((other, gap))
        };
        let first = match fixed(one) {
            true => standing
                .near(at, room)
                .copied()
                .filter_map(in_the_way)
                .min_by_key(|it| it.0),
            false => None,
        };
        match first {
            Some((other, gap)) => {
                let what = format!("overlaps {}, by {}", name(other), number(-gap));
                found.insert(one, what);
            }
            None => standing.put(at, room, one),
        }
    }
    let mut boxes = Boxes::default();
    boxes.about(obstacles);
    for i in (0..agents.len()).filter(|i| fixed(*i) && !ball(*i)) {
        let reach = agents.radius[i];
        let point = agents.positions[i];
        for index in boxes.reached(Reach::Around {
            point,
            range: reach,
        }) {
            let obstacle = &obstacles[index];
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
