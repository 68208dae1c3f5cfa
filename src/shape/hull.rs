//! Convex hulls whose corners and faces are told by exact signs, so that no point is dropped for
//! lying nearly on an edge or a face.

use crate::math::Vector;
use crate::shape::polytope::cross;

/// The corners of a hull in the plane, by index, counterclockwise; points within edges are none.
pub(super) fn corners<const D: usize>(points: &[Vector<D>]) -> Vec<usize> {
    let at = |i: usize| robust::Coord {
        x: points[i][0],
        y: points[i][1],
    };
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&i, &j| {
        let by = |k: usize| points[i][k].total_cmp(&points[j][k]);
        by(0).then(by(1))
    });
    let mut chain: Vec<usize> = Vec::new();
    // The lower side from left to right, then the upper one back.
    for pass in 0..2 {
        let begin = chain.len();
        for step in 0..order.len() {
            let next = match pass {
                0 => order[step],
                _ => order[order.len() - 1 - step],
            };
            while chain.len() >= begin + 2 {
                let [.., a, b] = chain[..] else { break };
                if robust::orient2d(at(a), at(b), at(next)) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(next);
        }
        // The last point begins the other side.
        chain.pop();
    }
    chain
}

/// The triangles that bound a hull in space, by the indices of their corners, counterclockwise
/// seen from outside; none where all points lie in one plane.
pub(super) fn triangles<const D: usize>(points: &[Vector<D>]) -> Vec<[usize; 3]> {
    let at = |i: usize| robust::Coord3D {
        x: points[i][0],
        y: points[i][1],
        z: points[i][D - 1],
    };
    // Above 0 where the point is in front of the triangle.
    let front = |[a, b, c]: [usize; 3], p: usize| -robust::orient3d(at(a), at(b), at(c), at(p));
    let Some([a, b, c, d]) = spanning(points) else {
        return Vec::new();
    };
    let side = front([a, b, c], d);
    if side == 0.0 {
        return Vec::new();
    }
    let (b, c) = if side > 0.0 { (c, b) } else { (b, c) };
    let mut faces = vec![[a, b, c], [a, d, b], [b, d, c], [c, d, a]];
    for p in 0..points.len() {
        if [a, b, c, d].contains(&p) {
            continue;
        }
        let (seen, kept): (Vec<_>, Vec<_>) = faces.iter().partition(|&&face| front(face, p) > 0.0);
        if seen.is_empty() {
            continue;
        }
        let sides = |faces: &[[usize; 3]]| -> std::collections::BTreeSet<[usize; 2]> {
            let sides = |&[a, b, c]: &[usize; 3]| [[a, b], [b, c], [c, a]];
            faces.iter().flat_map(sides).collect()
        };
        let all: std::collections::BTreeSet<_> = sides(&seen);
        faces = kept;
        // What the point sees ends where the neighbour across a side is not seen.
        for [from, to] in &all {
            if !all.contains(&[*to, *from]) {
                faces.push([*from, *to, p]);
            }
        }
    }
    faces
}

/// The volume of the hull of some points in space.
pub(super) fn volume<const D: usize>(points: &[Vector<D>]) -> f64 {
    let Some(origin) = points.first() else {
        return 0.0;
    };
    let sixfold = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(|i| points[i] - origin);
        cross(&a, &b).dot(&c)
    };
    triangles(points).into_iter().map(sixfold).sum::<f64>() / 6.0
}

/// Four points far from one plane.
fn spanning<const D: usize>(points: &[Vector<D>]) -> Option<[usize; 4]> {
    let farthest = |distance: &dyn Fn(&Vector<D>) -> f64| {
        let far = (0..points.len()).map(|i| (i, distance(&points[i])));
        far.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
    };
    let first = points.first()?;
    let a = farthest(&|p| (p - first).norm())?;
    let b = farthest(&|p| (p - points[a]).norm())?;
    let along = crate::math::direction(&(points[b] - points[a]));
    let across = |p: &Vector<D>| (p - points[a]) - along * along.dot(&(p - points[a]));
    let c = farthest(&|p| across(p).norm())?;
    let second = crate::math::direction(&across(&points[c]));
    let out = |p: &Vector<D>| across(p) - second * second.dot(&across(p));
    let d = farthest(&|p| out(p).norm())?;
    let mut all = [a, b, c, d];
    all.sort_unstable();
    all.windows(2).all(|w| w[0] != w[1]).then_some([a, b, c, d])
}
