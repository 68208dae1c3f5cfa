//! Where faces and edges that lie flat on each other meet: the middle of what they share, so that
//! a body that lands flat is pushed at no corner.

use super::features::Chosen;
use super::pair::Pair;
use crate::math::{Vector, direction};
use crate::shape::polytope::{Polytope, across, cross, right};

/// The angle up to which faces count as parallel.
const FLAT: f64 = 1e-10;

/// The most corners of what two faces share.
const MOST: usize = 64;

/// The middle of what the features farthest along `normal`, and against it, share seen along it;
/// `None` unless both are more than corners.
pub(super) fn middle<const D: usize>(
    pair: &Pair<'_, D>,
    normal: &Vector<D>,
    gap: f64,
) -> Option<[Vector<D>; 2]> {
    if pair.one.corners.len() < 2 || pair.other.corners.len() < 2 {
        return None;
    }
    let [u, v] = common(pair, normal)?.middle()?;
    let [first, second] = plane(normal);
    let (_, height) = pair.one.farthest(normal);
    let point = first * u + second * v + normal * height;
    Some([point, point + normal * gap])
}

/// The corners of what those features share, on the first; none unless both are more than
/// corners.
pub(super) fn corners<const D: usize>(
    pair: &Pair<'_, D>,
    normal: &Vector<D>,
    visit: &mut dyn FnMut(Vector<D>),
) {
    let [first, second] = plane(normal);
    let (_, height) = pair.one.farthest(normal);
    let outline = common(pair, normal).unwrap_or_default();
    for &[u, v] in outline.list() {
        visit(first * u + second * v + normal * height);
    }
}

/// What the features farthest along `normal`, and against it, share seen along it.
fn common<const D: usize>(pair: &Pair<'_, D>, normal: &Vector<D>) -> Option<Outline> {
    let near = pair.features(normal, FLAT);
    if near.one.list().len() < 2 || near.other.list().len() < 2 {
        return None;
    }
    let [first, second] = plane(normal);
    let flat = |point: &Vector<D>| [point.dot(&first), point.dot(&second)];
    let mut one = Outline::default();
    let mut other = Outline::default();
    for &i in near.one.list() {
        one.push(flat(&pair.one.at(i)));
    }
    for &j in near.other.list() {
        other.push(flat(&pair.stand.point(&pair.other.at(j))));
    }
    shared(one.hull(), other.hull())
}

/// The middle of the feature farthest along a direction.
pub(super) fn farthest<const D: usize>(of: &Polytope<D>, along: &Vector<D>) -> Vector<D> {
    let (corner, height) = of.farthest(along);
    let [first, second] = plane(along);
    match feature(of, along).and_then(|outline| outline.middle()) {
        Some([u, v]) => first * u + second * v + along * height,
        None => of.at(corner),
    }
}

/// The corners of the feature farthest along a direction.
pub(super) fn farthest_corners<const D: usize>(
    of: &Polytope<D>,
    along: &Vector<D>,
    visit: &mut dyn FnMut(Vector<D>),
) {
    let (corner, height) = of.farthest(along);
    let [first, second] = plane(along);
    match feature(of, along) {
        None => visit(of.at(corner)),
        Some(outline) => (outline.list().iter())
            .for_each(|&[u, v]| visit(first * u + second * v + along * height)),
    }
}

/// The feature farthest along a direction, seen along it; `None` where it is a corner.
fn feature<const D: usize>(of: &Polytope<D>, along: &Vector<D>) -> Option<Outline> {
    let near = Chosen::farthest(of, along, FLAT * of.size);
    if near.list().len() < 2 {
        return None;
    }
    let [first, second] = plane(along);
    let mut outline = Outline::default();
    for &i in near.list() {
        outline.push([of.at(i).dot(&first), of.at(i).dot(&second)]);
    }
    Some(outline.hull())
}

/// Unit vectors across a direction; in the plane the second is zero.
fn plane<const D: usize>(normal: &Vector<D>) -> [Vector<D>; 2] {
    let first = match D {
        2 => right(normal),
        _ => across(normal),
    };
    [first, cross(normal, &first)]
}

type Point = [f64; 2];

/// Some points of a plane.
#[derive(Debug, Clone, Copy)]
struct Outline {
    points: [Point; MOST],
    count: usize,
}

impl Default for Outline {
    fn default() -> Self {
        Self {
            points: [[0.0; 2]; MOST],
            count: 0,
        }
    }
}

fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

impl Outline {
    fn push(&mut self, point: Point) {
        if self.count < MOST {
            self.points[self.count] = point;
            self.count += 1;
        }
    }

    fn list(&self) -> &[Point] {
        &self.points[..self.count]
    }

    /// The corners of their hull, counterclockwise.
    fn hull(mut self) -> Self {
        self.points[..self.count].sort_unstable_by(|a, b| {
            let by = |k: usize| a[k].total_cmp(&b[k]);
            by(0).then(by(1))
        });
        let mut chain = Self::default();
        for pass in 0..2 {
            let begin = chain.count;
            for step in 0..self.count {
                let next = match pass {
                    0 => self.points[step],
                    _ => self.points[self.count - 1 - step],
                };
                while chain.count >= begin + 2
                    && turn(
                        chain.points[chain.count - 2],
                        chain.points[chain.count - 1],
                        next,
                    ) <= 0.0
                {
                    chain.count -= 1;
                }
                chain.push(next);
            }
            chain.count = chain.count.saturating_sub(1);
        }
        chain
    }

    /// What of it lies left of a line.
    fn cut(&self, from: Point, to: Point) -> Self {
        let mut left = Self::default();
        for (k, &a) in self.list().iter().enumerate() {
            let b = self.points[(k + 1) % self.count];
            let (s, t) = (turn(from, to, a), turn(from, to, b));
            if s >= 0.0 {
                left.push(a);
            }
            if (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0) {
                let share = s / (s - t);
                left.push([a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share]);
            }
        }
        left
    }

    /// The centroid; of what has no area, the middle of its box.
    fn middle(&self) -> Option<Point> {
        let list = self.list();
        let &origin = list.first()?;
        let (mut low, mut high) = (origin, origin);
        for point in list {
            for k in 0..2 {
                low[k] = low[k].min(point[k]);
                high[k] = high[k].max(point[k]);
            }
        }
        let (mut area, mut sum) = (0.0, [0.0; 2]);
        for k in 1..self.count.max(1) - 1 {
            let (a, b) = (list[k], list[k + 1]);
            let twice = turn(origin, a, b);
            area += twice;
            for (axis, sum) in sum.iter_mut().enumerate() {
                *sum += twice * (a[axis] + b[axis] - 2.0 * origin[axis]) / 3.0;
            }
        }
        let box_area = (high[0] - low[0]) * (high[1] - low[1]);
        if area > 1e-9 * box_area {
            // What is as small as rounding may have any area.
            let at = |k: usize| (origin[k] + sum[k] / area).clamp(low[k], high[k]);
            return Some([at(0), at(1)]);
        }
        Some([0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])])
    }
}

/// What two outlines share: polygons, or lines of two points.
fn shared(one: Outline, other: Outline) -> Option<Outline> {
    match (one.count, other.count) {
        (0..=1, _) | (_, 0..=1) => None,
        (2, 2) => {
            let [a, b] = [one.points[0], one.points[1]];
            let way = Vector::<2>::new(b[0] - a[0], b[1] - a[1]);
            let along = direction(&way);
            let at = |p: Point| along[0] * (p[0] - a[0]) + along[1] * (p[1] - a[1]);
            let [p, q] = [other.points[0], other.points[1]];
            let out = |p: Point| along[0] * (p[1] - a[1]) - along[1] * (p[0] - a[0]);
            let length = way.norm();
            // Edges that cross share one point, which is known better already.
            if (out(p) - out(q)).abs() > FLAT * (at(p) - at(q)).abs() {
                return None;
            }
            let low = f64::max(0.0, at(p).min(at(q)));
            let high = f64::min(length, at(p).max(at(q)));
            let at = |s: f64| [a[0] + along[0] * s, a[1] + along[1] * s];
            let mut line = Outline::default();
            line.push(at(low));
            line.push(at(high));
            (low <= high).then_some(line)
        }
        (2, _) => clipped(one, &other),
        _ => clipped(other, &one),
    }
}

fn clipped(mut what: Outline, by: &Outline) -> Option<Outline> {
    for k in 0..by.count {
        what = what.cut(by.points[k], by.points[(k + 1) % by.count]);
    }
    (what.count > 0).then_some(what)
}
