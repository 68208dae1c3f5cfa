//! Some corners of two polytopes, and the nearest points of the faces and edges between them.

use super::pair::{Found, Pair};
use super::point::corner_to;
use crate::math::{Vector, direction};
use crate::shape::polytope::{Edge, Polytope, cross};

/// Corners of both polytopes.
pub(super) struct Features {
    pub(super) one: Chosen,
    pub(super) other: Chosen,
}

/// How many corners are told one by one; where there are more, all are taken.
const MOST: usize = 32;

/// Some corners of a polytope.
pub(super) struct Chosen {
    list: [u32; MOST],
    /// How many; `None` stands for all.
    count: Option<usize>,
}

impl Chosen {
    pub(super) fn all() -> Self {
        Self {
            list: [0; MOST],
            count: None,
        }
    }

    /// Those at most `within` nearer than the farthest along a direction.
    pub(super) fn farthest<const D: usize>(
        of: &Polytope<D>,
        along: &Vector<D>,
        within: f64,
    ) -> Self {
        let (_, far) = of.farthest(along);
        let (mut list, mut count) = ([0; MOST], 0);
        for (i, corner) in of.corners.iter().enumerate() {
            if corner.dot(along) >= far - within {
                if count == MOST {
                    return Self::all();
                }
                list[count] = i as u32;
                count += 1;
            }
        }
        Self {
            list,
            count: Some(count),
        }
    }

    /// Those told one by one; none where all are taken.
    pub(super) fn list(&self) -> &[u32] {
        &self.list[..self.count.unwrap_or(0)]
    }

    /// Whether it is one corner alone.
    pub(super) fn is_corner(&self) -> bool {
        self.count == Some(1)
    }

    pub(super) fn has(&self, corners: &[u32]) -> bool {
        match self.count {
            None => true,
            Some(count) => corners.iter().all(|it| self.list[..count].contains(it)),
        }
    }

    pub(super) fn each(&self, of: usize) -> impl Iterator<Item = u32> {
        let count = self.count.unwrap_or(of);
        (0..count).map(move |k| match self.count {
            None => k as u32,
            Some(_) => self.list[k],
        })
    }
}

impl Features {
    pub(super) fn all() -> Self {
        Self {
            one: Chosen::all(),
            other: Chosen::all(),
        }
    }

    /// The nearest two points of the features of these corners; `None` where there are none, for
    /// the polytopes overlap.
    pub(super) fn nearest<const D: usize>(&self, pair: &Pair<'_, D>) -> Option<Found<D>> {
        let mut best: Option<Found<D>> = None;
        let mut look = |found: Found<D>| {
            let better = match &best {
                None => true,
                // To rounding as near: the one whose normal proves it.
                Some(best) if (found.gap - best.gap).abs() <= 1e-15 * (best.gap + pair.size) => {
                    found.normal != best.normal
                        && pair.along(&found.normal) > pair.along(&best.normal)
                }
                Some(best) => found.gap < best.gap,
            };
            if better {
                best = Some(found);
            }
        };
        let Pair {
            one, other, stand, ..
        } = pair;
        let rounding = 4e-15 * pair.size;
        for j in self.other.each(other.corners.len()) {
            let point = stand.point(&other.at(j));
            corner_to(
                one,
                &self.one,
                &point,
                rounding,
                &mut |gap, normal, foot| {
                    look(Found {
                        gap,
                        normal,
                        points: [foot, point],
                    });
                },
            );
        }
        for i in self.one.each(one.corners.len()) {
            let corner = one.at(i);
            let point = stand.back(&(corner - stand.shift));
            corner_to(
                other,
                &self.other,
                &point,
                rounding,
                &mut |gap, normal, foot| {
                    look(Found {
                        gap,
                        normal: -stand.vector(&normal),
                        points: [corner, stand.point(&foot)],
                    });
                },
            );
        }
        let chosen = |of: &'_ Chosen, ends: &[u32; 2]| of.has(ends);
        for first in one.edges.iter().filter(|it| chosen(&self.one, &it.ends)) {
            for second in (other.edges.iter()).filter(|it| chosen(&self.other, &it.ends)) {
                if let Some(found) = edges(pair, first, second) {
                    look(found);
                }
            }
        }
        best
    }
}

/// The nearest points of two edges where they lie within both.
fn edges<const D: usize>(
    pair: &Pair<'_, D>,
    first: &Edge<D>,
    second: &Edge<D>,
) -> Option<Found<D>> {
    let along = pair.stand.vector(&second.along);
    let normal = cross(&first.along, &along);
    let sine = normal.norm();
    if sine < 1e-12 {
        return None;
    }
    let ends = first.ends.map(|i| pair.one.at(i));
    let others = second.ends.map(|j| pair.stand.point(&pair.other.at(j)));
    let (s, t) = lines(&ends[0], &first.along, &others[0], &along);
    let within = |at: f64, ends: &[Vector<D>; 2]| at > 0.0 && at < (ends[1] - ends[0]).norm();
    if !(within(s, &ends) && within(t, &others)) {
        return None;
    }
    let points = [ends[0] + first.along * s, others[0] + along * t];
    let way = points[1] - points[0];
    let gap = way.norm();
    let out = normal / sine * normal.dot(&way).signum();
    // Nearly parallel lines tell a worse normal than the way between them, unless that is short.
    let normal = match gap > sine * pair.size {
        // Of what rounding leaves along the edge nothing may stay.
        true => direction(&(way - first.along * first.along.dot(&way))),
        false => out,
    };
    Some(Found {
        gap,
        normal,
        points,
    })
}

/// The places on two lines that are nearest to each other.
fn lines<const D: usize>(
    from: &Vector<D>,
    along: &Vector<D>,
    other_from: &Vector<D>,
    other_along: &Vector<D>,
) -> (f64, f64) {
    let way = other_from - from;
    // Not by cosines, which tell nothing of nearly parallel lines.
    let normal = cross(along, other_along);
    let square = normal.norm_squared();
    let at = |line: &Vector<D>| cross(&way, line).dot(&normal) / square;
    (at(other_along), at(along))
}
