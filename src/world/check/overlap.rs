//! Listed agents whose bodies overlap.

use std::collections::HashMap;

use crate::world::problem::Problem;
use crate::world::spec::{PlacementSpec, WorldSpec};
use crate::world::words::number;

/// Bodies that touch exactly may seem to overlap by rounding; this share of the
/// distance at which they touch is forgiven.
const ROUNDING: f64 = 1e-9;

/// A listed body that overlaps none before it.
struct Body<'a> {
    group: usize,
    index: usize,
    radius: f64,
    position: &'a [f64],
}

/// One problem for each listed agent that overlaps an earlier one.
///
/// Only bodies that overlap nothing enter the cells, so that cells stay sparse
/// and the cost stays linear even where all agents are at one place.
pub fn problems(world: &WorldSpec) -> Vec<Problem> {
    let listed: Vec<Body> = listed(world).collect();
    let side = 2.0 * listed.iter().map(|body| body.radius).fold(0.0, f64::max);
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    let mut problems = Vec::new();
    for (number_of_body, body) in listed.iter().enumerate() {
        let home = cell(body.position, side);
        let earlier = neighbourhood(home)
            .filter_map(|cell| cells.get(&cell))
            .flatten();
        match earlier
            .map(|&other| &listed[other])
            .find(|other| overlap(body, other))
        {
            Some(other) => problems.push(problem(body, other)),
            None => cells.entry(home).or_default().push(number_of_body),
        }
    }
    problems
}

/// The listed agents whose positions have the right length.
fn listed(world: &WorldSpec) -> impl Iterator<Item = Body<'_>> {
    world.agents.iter().enumerate().flat_map(|(group, agents)| {
        let positions = match &agents.positions {
            PlacementSpec::Explicit(positions) => positions.as_slice(),
            PlacementSpec::Box(_) | PlacementSpec::Ball(_) => &[],
        };
        positions
            .iter()
            .enumerate()
            .filter(|(_, position)| position.len() == world.dimension)
            .map(move |(index, position)| Body {
                group,
                index,
                radius: agents.radius,
                position,
            })
    })
}

fn cell(position: &[f64], side: f64) -> [i64; 3] {
    let mut cell = [0; 3];
    for (index, x) in cell.iter_mut().zip(position) {
        *index = (x / side).floor() as i64;
    }
    cell
}

/// A cell and those around it.
fn neighbourhood(home: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    (0..27).map(move |code| {
        let [x, y, z] = home;
        let shift = |at: i64, code: i64| at.saturating_add(code % 3 - 1);
        [shift(x, code), shift(y, code / 3), shift(z, code / 9)]
    })
}

fn overlap(a: &Body, b: &Body) -> bool {
    distance(a, b) < (a.radius + b.radius) * (1.0 - ROUNDING)
}

fn distance(a: &Body, b: &Body) -> f64 {
    let squares = a
        .position
        .iter()
        .zip(b.position)
        .map(|(x, y)| (x - y) * (x - y));
    squares.sum::<f64>().sqrt()
}

fn problem(body: &Body, other: &Body) -> Problem {
    let path = |body: &Body| format!("agents[{}].positions.explicit[{}]", body.group, body.index);
    let what = match distance(body, other) {
        0.0 => format!("is the same place as {}", path(other)),
        apart => format!(
            "overlaps {}: their centres are {} apart, their radii add up to {}",
            path(other),
            number(apart),
            number(body.radius + other.radius),
        ),
    };
    Problem::new(path(body), what)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn world(dimension: usize, radius: f64, positions: &[Vec<f64>]) -> WorldSpec {
        let world = json!({
            "dimension": dimension,
            "time": {"end": 1},
            "agents": [{"radius": radius, "positions": {"explicit": positions}}],
        });
        serde_json::from_value(world).unwrap()
    }

    #[test]
    fn bodies_may_touch() {
        let row: Vec<_> = (0..50).map(|i| vec![0.1 * f64::from(i), -0.3]).collect();
        assert_eq!(problems(&world(2, 0.05, &row)), []);
        assert_eq!(problems(&world(2, 0.0501, &row)).len(), 25);
    }

    #[test]
    fn agrees_with_brute_force() {
        // Points of a low-discrepancy sequence, dense enough for some overlaps.
        for dimension in [2, 3] {
            let share = |i: usize, axis: usize| (i as f64 * [0.7549, 0.5698, 0.3319][axis]).fract();
            let points: Vec<Vec<f64>> = (0..300)
                .map(|i| {
                    (0..dimension)
                        .map(|axis| 4.0 * share(i, axis) - 2.0)
                        .collect()
                })
                .collect();
            let world = world(dimension, 0.15, &points);
            let all: Vec<Body> = listed(&world).collect();
            let mut free: Vec<usize> = Vec::new();
            let mut expected = Vec::new();
            for i in 0..all.len() {
                match free.iter().any(|&j| overlap(&all[i], &all[j])) {
                    true => expected.push(format!("agents[0].positions.explicit[{i}]")),
                    false => free.push(i),
                }
            }
            let found: Vec<String> = problems(&world).into_iter().map(|one| one.path).collect();
            assert!(!expected.is_empty() && expected.len() < 300);
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn survives_extreme_places() {
        let far = [
            vec![1e300, -1e300],
            vec![1e300, -1e300],
            vec![f64::MAX, 0.0],
        ];
        assert_eq!(problems(&world(2, 1e-300, &far)).len(), 1);
    }
}
