//! Regular places: grids, lines and hexagonal lattices.

use crate::math::Vector;

/// The points of a grid, along the first axis first.
pub(super) fn grid<const D: usize>(
    corner: &Vector<D>,
    spacing: f64,
    points: &[usize],
) -> Vec<Vector<D>> {
    let place = |index: usize| {
        let mut rest = index;
        corner
            + Vector::from_fn(|axis, _| {
                let along = rest % points[axis];
                rest /= points[axis];
                along as f64 * spacing
            })
    };
    (0..points.iter().product()).map(place).collect()
}

/// `count` points evenly along a segment, both ends included; the middle for one point.
pub(super) fn line<const D: usize>(
    from: &Vector<D>,
    to: &Vector<D>,
    count: usize,
) -> Vec<Vector<D>> {
    let place = |index: usize| match count {
        1 => (from + to) * 0.5,
        // Both ends exactly.
        _ if index == count - 1 => *to,
        _ => from + (to - from) * (index as f64 / (count - 1) as f64),
    };
    (0..count).map(place).collect()
}

/// The points of a hexagonal lattice, nearest to the centre first: the densest packing of
/// disks, and in space the densest of balls (face-centred cubic).
///
/// A point is a whole number of steps along each of D edges of length 1 at 60° to each
/// other. So its squared distance is a whole number, and the order has no ties that
/// rounding could break.
pub(super) struct Hexagonal<const D: usize> {
    center: Vector<D>,
    edges: [Vector<D>; D],
    /// Steps along the edges, nearest first: all those of squared distance `reach` at most.
    sites: Vec<[i64; D]>,
    reach: i64,
    next: usize,
}

impl<const D: usize> Hexagonal<D> {
    /// The lattice with neighbours `spacing` apart, one point of it at `center`.
    pub(super) fn new(center: Vector<D>, spacing: f64) -> Self {
        let third = 1.0 / 3.0_f64.sqrt();
        let edges = [
            [1.0, 0.0, 0.0],
            [0.5, 1.5 * third, 0.0],
            [0.5, 0.5 * third, 2.0_f64.sqrt() * third],
        ];
        let mut lattice = Self {
            center,
            edges: std::array::from_fn(|k| Vector::from_fn(|axis, _| edges[k][axis] * spacing)),
            sites: Vec::new(),
            reach: 16,
            next: 0,
        };
        lattice.find();
        lattice
    }

    /// The next point.
    pub(super) fn next(&mut self) -> Vector<D> {
        if self.next == self.sites.len() {
            self.reach *= 2;
            self.find();
        }
        let site = self.sites[self.next];
        self.next += 1;
        let offset = site
            .iter()
            .zip(&self.edges)
            .map(|(&n, edge)| edge * n as f64);
        self.center + offset.sum::<Vector<D>>()
    }

    /// Lists the points within reach. They begin with those of any smaller reach, in the
    /// same order.
    fn find(&mut self) {
        // No coordinate is larger than √(3/2) times the distance.
        let most = (1.5 * self.reach as f64).sqrt().ceil() as i64;
        let side = (2 * most + 1) as usize;
        let steps = |index: usize| -> [i64; D] {
            std::array::from_fn(|k| (index / side.pow(k as u32) % side) as i64 - most)
        };
        let mut sites: Vec<_> = (0..side.pow(D as u32))
            .map(|index| (square(&steps(index)), steps(index)))
            .filter(|(square, _)| *square <= self.reach)
            .collect();
        sites.sort_unstable();
        self.sites = sites.into_iter().map(|(_, site)| site).collect();
    }
}

/// Squared distance of a lattice point from the origin, in squares of the spacing.
fn square<const D: usize>(steps: &[i64; D]) -> i64 {
    let pairs = (0..D).flat_map(|k| (0..=k).map(move |l| steps[k] * steps[l]));
    pairs.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_runs_along_the_first_axis_first() {
        let places = grid(&Vector::<2>::new(1.0, 2.0), 3.0, &[2, 2]);
        let expected = [[1.0, 2.0], [4.0, 2.0], [1.0, 5.0], [4.0, 5.0]];
        assert_eq!(places, expected.map(Vector::<2>::from));
    }

    #[test]
    fn a_line_has_both_its_ends() {
        let (from, to) = (
            Vector::<3>::new(0.0, 0.0, 0.1),
            Vector::<3>::new(0.3, 0.0, 0.7),
        );
        let places = line(&from, &to, 4);
        assert_eq!((places[0], places[3]), (from, to));
        assert!((places[1] - Vector::<3>::new(0.1, 0.0, 0.3)).norm() < 1e-15);
        assert_eq!(line(&from, &to, 1), [(from + to) * 0.5]);
    }

    /// How many of the first points are at which distance, and that neighbours keep theirs.
    fn shells<const D: usize>(count: usize) -> Vec<(i64, usize)> {
        let center = Vector::repeat(7.0);
        let mut lattice = Hexagonal::<D>::new(center, 2.0);
        let places: Vec<_> = (0..count).map(|_| lattice.next()).collect();
        for (i, a) in places.iter().enumerate() {
            let nearest = places[..i]
                .iter()
                .map(|b| (a - b).norm())
                .fold(9.0, f64::min);
            assert!(i == 0 || (nearest - 2.0).abs() < 1e-12, "{i}: {nearest}");
        }
        let mut shells: Vec<(i64, usize)> = Vec::new();
        for place in &places {
            let square = ((place - center).norm_squared() / 4.0).round() as i64;
            match shells.last_mut() {
                Some((last, n)) if *last == square => *n += 1,
                last => {
                    assert!(last.is_none_or(|(before, _)| *before < square));
                    shells.push((square, 1));
                }
            }
        }
        shells
    }

    #[test]
    fn shells_are_those_of_the_lattices() {
        // A003136 and A004016, A004015: numbers of vectors of the lattices A2 and D3.
        assert_eq!(
            shells::<2>(61),
            [
                (0, 1),
                (1, 6),
                (3, 6),
                (4, 6),
                (7, 12),
                (9, 6),
                (12, 6),
                (13, 12),
                (16, 6)
            ]
        );
        assert_eq!(
            shells::<3>(79),
            [(0, 1), (1, 12), (2, 6), (3, 24), (4, 12), (5, 24)]
        );
    }
}
