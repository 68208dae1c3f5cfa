//! Surfaces made of segments (in the plane) or of facets (in space).

use std::collections::BTreeMap;

use crate::math::{Vector, direction};
use crate::shape::Shape;

/// The segments of a broken line; closed, the last point is joined to the first.
pub fn polyline<const D: usize>(points: &[Vector<D>], closed: bool) -> Vec<Shape<D>> {
    legs(points, closed)
        .map(|(from, to)| Shape::Segment { from, to })
        .collect()
}

/// The pairs of neighbouring points.
fn legs<const D: usize>(
    points: &[Vector<D>],
    closed: bool,
) -> impl Iterator<Item = (Vector<D>, Vector<D>)> {
    let count = if closed {
        points.len()
    } else {
        points.len().saturating_sub(1)
    };
    (0..count).map(move |k| (points[k], points[(k + 1) % points.len()]))
}

/// The triangles of a mesh, each by the indices of its corners.
pub fn mesh<const D: usize>(vertices: &[Vector<D>], triangles: &[[usize; 3]]) -> Vec<Shape<D>> {
    let shape = |corners: &[usize; 3]| Shape::Triangle {
        points: corners.map(|corner| vertices[corner]),
    };
    triangles.iter().map(shape).collect()
}

/// The outline of a mesh in the plane: the edges that belong to one triangle only. Vertices at
/// one place are one vertex, though many programs write one for each triangle.
pub fn outline<const D: usize>(vertices: &[Vector<D>], triangles: &[[usize; 3]]) -> Vec<Shape<D>> {
    let mut first: BTreeMap<[u64; D], usize> = BTreeMap::new();
    // Adding zero makes 0 of −0.
    let key = |at: &Vector<D>| std::array::from_fn(|k| (at[k] + 0.0).to_bits());
    let one = vertices.iter().enumerate();
    let same: Vec<usize> = one
        .map(|(i, at)| *first.entry(key(at)).or_insert(i))
        .collect();
    let mut owners: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| same[corner]);
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *owners.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
    }
    let single = owners.into_iter().filter(|(_, count)| *count == 1);
    single
        .map(|([from, to], _)| Shape::Segment {
            from: vertices[from],
            to: vertices[to],
        })
        .collect()
}

/// A height field over the middle of the ground: in the plane one row of heights over
/// `sides[0]`, in space some rows, the rows along the first axis and in order of the
/// second, over `sides[0]` × `sides[1]`. Heights are along the last axis.
pub fn heightfield<const D: usize>(rows: &[Vec<f64>], sides: [f64; 2]) -> Vec<Shape<D>> {
    let place = |row: usize, column: usize| {
        let share = |k: usize, count: usize| k as f64 / (count - 1) as f64 - 0.5;
        let mut place = Vector::<D>::zeros();
        place[0] = sides[0] * share(column, rows[row].len());
        if D == 3 {
            place[1] = sides[1] * share(row, rows.len());
        }
        place[D - 1] = rows[row][column];
        place
    };
    let columns = rows[0].len();
    if D == 2 {
        let points: Vec<_> = (0..columns).map(|column| place(0, column)).collect();
        return polyline(&points, false);
    }
    let mut facets = Vec::new();
    for row in 1..rows.len() {
        for column in 1..columns {
            let corner = |back: usize, left: usize| place(row - back, column - left);
            facets.extend(quad([
                corner(1, 1),
                corner(1, 0),
                corner(0, 0),
                corner(0, 1),
            ]));
        }
    }
    facets
}

/// Two facets that make a four-sided face, its corners in order.
fn quad<const D: usize>([a, b, c, d]: [Vector<D>; 4]) -> [Shape<D>; 2] {
    [[a, b, c], [a, c, d]].map(|points| Shape::Triangle { points })
}

/// Why there is no such corridor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bent {
    /// The leg from this point to the next is too short for the bends at its ends.
    Leg(usize),
    /// The loop twists: its cross-section does not come back as it set out.
    Twist,
}

/// The walls of a corridor along a centre line: in the plane two mitred lines `width`
/// apart; in space a tunnel of square cross-section, whose frame is carried along the line
/// without turning about it. Open corridors are open at their ends.
///
/// # Errors
/// Where the line bends too sharply for the width, or a loop in space twists.
pub fn corridor<const D: usize>(
    points: &[Vector<D>],
    width: f64,
    closed: bool,
) -> Result<Vec<Shape<D>>, Bent> {
    let legs: Vec<_> = legs(points, closed).collect();
    let along: Vec<_> = legs
        .iter()
        .map(|(from, to)| direction(&(to - from)))
        .collect();
    let count = legs.len();
    // The corners of the cross-section of each leg, as ways from the centre line.
    let mut sections = vec![cross_section(&along[0], 0.5 * width)];
    for k in 1..count {
        let carried = carry(&sections[k - 1], &along[k - 1], &along[k]);
        sections.push(carried);
    }
    if closed {
        let back = carry(&sections[count - 1], &along[count - 1], &along[0]);
        let apart = |(a, b): (&Vector<D>, &Vector<D>)| (a - b).norm();
        let error = back.iter().zip(&sections[0]).map(apart);
        // A reversal makes this not a number, and the leg is found below.
        if error.fold(0.0, f64::max) > 1e-6 * width {
            return Err(Bent::Twist);
        }
    }
    // The mitre at a bend between two legs lies in the plane across both.
    let across = |other: Option<usize>, k: usize| match other {
        Some(other) => along[other] + along[k],
        None => along[k],
    };
    let mitred = |at: &Vector<D>, corner: &Vector<D>, leg: &Vector<D>, across: &Vector<D>| {
        at + corner - leg * (corner.dot(across) / leg.dot(across))
    };
    let mut walls = Vec::new();
    for k in 0..count {
        let before = if k > 0 {
            Some(k - 1)
        } else {
            closed.then(|| count - 1)
        };
        let after = if k + 1 < count {
            Some(k + 1)
        } else {
            closed.then_some(0)
        };
        let (from, to) = &legs[k];
        let ends: Vec<_> = sections[k]
            .iter()
            .map(|corner| {
                (
                    mitred(from, corner, &along[k], &across(before, k)),
                    mitred(to, corner, &along[k], &across(after, k)),
                )
            })
            .collect();
        // Not a number counts as too short.
        let long =
            |(start, end): &(Vector<D>, Vector<D>)| (end - start).dot(&along[k]) > 1e-6 * width;
        if !ends.iter().all(long) {
            return Err(Bent::Leg(k));
        }
        if D == 2 {
            walls.extend(ends.iter().map(|&(from, to)| Shape::Segment { from, to }));
        } else {
            for (i, (start, end)) in ends.iter().enumerate() {
                let (next_start, next_end) = ends[(i + 1) % ends.len()];
                walls.extend(quad([*start, *end, next_end, next_start]));
            }
        }
    }
    Ok(walls)
}

/// The corners of a square (in the plane, the ends of a line) across a direction: half a
/// width from the middle, in order round it.
fn cross_section<const D: usize>(along: &Vector<D>, half: f64) -> Vec<Vector<D>> {
    let mut axes: Vec<Vector<D>> = Vec::new();
    // From the last axis back, so that a level tunnel has a level floor.
    for k in (0..D).rev() {
        let mut axis: Vector<D> = crate::math::axis(k);
        for taken in std::iter::once(along).chain(&axes) {
            axis -= taken * taken.dot(&axis);
        }
        if axis.norm() > 1e-3 && axes.len() + 1 < D {
            axes.push(axis.normalize());
        }
    }
    match &axes[..] {
        [only] => vec![only * half, only * -half],
        [first, second, ..] => [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)]
            .map(|(a, b)| first * (a * half) + second * (b * half))
            .to_vec(),
        [] => Vec::new(),
    }
}

/// Turns ways across one direction into ways across another, by the smallest rotation
/// between the two.
fn carry<const D: usize>(ways: &[Vector<D>], from: &Vector<D>, to: &Vector<D>) -> Vec<Vector<D>> {
    let sum = from + to;
    let turn = |way: &Vector<D>| way - sum * (to.dot(way) / (1.0 + from.dot(to)));
    ways.iter().map(turn).collect()
}
