//! The point of a simplex nearest to the origin.

use crate::math::Vector;
use crate::shape::polytope::cross;

/// A corner of the difference of two polytopes: the corners that it is the difference of, and
/// where it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner<const D: usize> {
    pub(super) of: [u32; 2],
    pub(super) at: Vector<D>,
}

/// Up to as many corners as a simplex has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Simplex<const D: usize> {
    corners: [Corner<D>; 4],
    count: usize,
}

impl<const D: usize> Simplex<D> {
    /// Without corners.
    pub(super) fn new() -> Self {
        let none = Corner {
            of: [0; 2],
            at: Vector::zeros(),
        };
        Self {
            corners: [none; 4],
            count: 0,
        }
    }

    pub(super) fn corners(&self) -> &[Corner<D>] {
        &self.corners[..self.count]
    }

    pub(super) fn push(&mut self, corner: Corner<D>) {
        self.corners[self.count] = corner;
        self.count += 1;
    }

    /// The point nearest to the origin; only the corners that span it are kept. `None` where
    /// the origin is inside.
    pub(super) fn reduce(&mut self) -> Option<Vector<D>> {
        let at = |k: usize| self.corners[k].at;
        let (keep, point) = match self.count {
            1 => kept([0, 0, 0], 1, at(0)),
            2 => segment([0, 1], [at(0), at(1)]),
            3 => {
                let found = triangle([0, 1, 2], [at(0), at(1), at(2)]);
                if D == 2 && found.0.count == 3 {
                    return None;
                }
                found
            }
            _ => tetrahedron([at(0), at(1), at(2), at(3)])?,
        };
        let kept = keep.indices.map(|k| self.corners[k]);
        self.corners[..3].copy_from_slice(&kept);
        self.count = keep.count;
        Some(point)
    }
}

/// Which corners are kept.
#[derive(Debug, Clone, Copy)]
struct Keep {
    indices: [usize; 3],
    count: usize,
}

fn kept<const D: usize>(indices: [usize; 3], count: usize, point: Vector<D>) -> (Keep, Vector<D>) {
    (Keep { indices, count }, point)
}

fn segment<const D: usize>([i, j]: [usize; 2], [a, b]: [Vector<D>; 2]) -> (Keep, Vector<D>) {
    let along = b - a;
    let (at, length) = (-a.dot(&along), along.norm_squared());
    if at <= 0.0 {
        kept([i, 0, 0], 1, a)
    } else if at >= length {
        kept([j, 0, 0], 1, b)
    } else {
        kept([i, j, 0], 2, a + along * (at / length))
    }
}

/// By the regions of Ericson's "Real-Time Collision Detection", 5.1.5.
fn triangle<const D: usize>(index: [usize; 3], [a, b, c]: [Vector<D>; 3]) -> (Keep, Vector<D>) {
    let [i, j, k] = index;
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (-ab.dot(&a), -ac.dot(&a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return kept([i, 0, 0], 1, a);
    }
    let (d3, d4) = (-ab.dot(&b), -ac.dot(&b));
    if d3 >= 0.0 && d4 <= d3 {
        return kept([j, 0, 0], 1, b);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return segment([i, j], [a, b]);
    }
    let (d5, d6) = (-ab.dot(&c), -ac.dot(&c));
    if d6 >= 0.0 && d5 <= d6 {
        return kept([k, 0, 0], 1, c);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return segment([i, k], [a, c]);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return segment([j, k], [b, c]);
    }
    let point = match D {
        3 => {
            let normal = cross(&ab, &ac);
            normal * (normal.dot(&a) / normal.norm_squared())
        }
        _ => (a * va + b * vb + c * vc) / (va + vb + vc),
    };
    kept(index, 3, point)
}

fn tetrahedron<const D: usize>(at: [Vector<D>; 4]) -> Option<(Keep, Vector<D>)> {
    let mut best: Option<(Keep, Vector<D>)> = None;
    for [i, j, k, l] in [[0, 1, 2, 3], [0, 3, 1, 2], [0, 2, 3, 1], [1, 3, 2, 0]] {
        let normal = cross(&(at[j] - at[i]), &(at[k] - at[i]));
        let (inside, origin) = (normal.dot(&(at[l] - at[i])), -normal.dot(&at[i]));
        // Where it is flat no side can be trusted, and every face is looked at.
        let flat = inside.abs() <= 1e-12 * normal.norm() * (at[l] - at[i]).norm();
        if inside * origin > 0.0 && !flat {
            continue;
        }
        let found = triangle([i, j, k], [at[i], at[j], at[k]]);
        if best.is_none_or(|(_, point)| found.1.norm_squared() < point.norm_squared()) {
            best = Some(found);
        }
    }
    best
}
