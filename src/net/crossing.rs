//! Edges that cross in the drawing of a plane net.

use crate::math::Vector;
use crate::net::Net;
use crate::sense::Cells;

/// The number of pairs of edges that cross properly when the net is drawn with straight
/// edges: each separates the other's ends strictly. Edges that meet at an agent, touch or
/// overlap do not cross. A net without crossings whose edges do not overlap is planar as
/// drawn; it may be [planar](crate::net::is_planar) with crossings, drawn otherwise.
///
/// Edges are compared with those near them, so the effort follows the number of close
/// pairs. Orientations are evaluated in plain floating-point numbers.
pub fn crossings(positions: &[Vector<2>], net: &Net) -> usize {
    let ends: Vec<[Vector<2>; 2]> = net
        .edges()
        .iter()
        .map(|&[i, j]| [positions[i], positions[j]])
        .collect();
    let longest = ends.iter().map(|[a, b]| (b - a).norm()).fold(0.0, f64::max);
    if longest == 0.0 {
        return 0;
    }
    // Where two edges cross, their middles are at most half their lengths' sum apart.
    let reach = longest * (1.0 + 1e-9);
    let middles: Vec<Vector<2>> = ends.iter().map(|[a, b]| (a + b) * 0.5).collect();
    let mut cells = Cells::default();
    cells.rebuild(&middles, reach);
    let mut count = 0;
    for (edge, middle) in middles.iter().enumerate() {
        cells.for_each_within(middle, reach, |place, _, _| {
            let other = cells.order()[place] as usize;
            count += usize::from(edge < other && cross(&ends[edge], &ends[other]));
        });
    }
    count
}

fn cross([a, b]: &[Vector<2>; 2], [c, d]: &[Vector<2>; 2]) -> bool {
    let apart = |u: f64, v: f64| (u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0);
    apart(side(a, b, c), side(a, b, d)) && apart(side(c, d, a), side(c, d, b))
}

/// Above 0 where `c` lies to the left of the way from `a` to `b`, 0 on its line.
fn side(a: &Vector<2>, b: &Vector<2>, c: &Vector<2>) -> f64 {
    (b - a).perp(&(c - a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_proper_crossings_count() {
        let at = [
            (0.0, 0.0),
            (2.0, 2.0),
            (0.0, 2.0),
            (2.0, 0.0),
            (1.0, 1.0),
            (3.0, 3.0),
        ]
        .map(|(x, y)| Vector::<2>::new(x, y));
        let count = |edges: &[[usize; 2]]| {
            crossings(&at, &Net::from_edges(at.len(), edges.iter().copied()))
        };
        assert_eq!(count(&[[0, 1], [2, 3]]), 1);
        // A common end; an end on the other edge; one edge along another; none.
        assert_eq!(count(&[[0, 1], [0, 2]]), 0);
        assert_eq!(count(&[[0, 4], [2, 3]]), 0);
        assert_eq!(count(&[[0, 1], [4, 5]]), 0);
        assert_eq!(count(&[]), 0);
    }
}
