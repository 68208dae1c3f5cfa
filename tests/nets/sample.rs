//! Positions, graphs and interactions that several tests share.

use proptest::prelude::*;
use volary::math::{Action, AlphaPair, Bump, Fade, Vector};
use volary::net::Net;

pub type Edge = [usize; 2];

/// Where the bump of these tests leaves 1.
pub const BUMP_START: f64 = 0.7;

pub fn pair(spacing: f64, range: f64, smooth: bool) -> AlphaPair {
    AlphaPair {
        action: Action::new(1.0, 5.0),
        spacing,
        range,
        fade: if smooth {
            Fade::Smooth(Bump::new(BUMP_START))
        } else {
            Fade::Sharp
        },
    }
}

/// 2 to 60 points, more or less dense.
pub fn points<const D: usize>() -> impl Strategy<Value = Vec<Vector<D>>> {
    let point = prop::collection::vec(-1.0..1.0f64, D).prop_map(|x| Vector::from_row_slice(&x));
    (prop::collection::vec(point, 2..=60), 1.5..8.0f64)
        .prop_map(|(points, size)| points.into_iter().map(|point| point * size).collect())
}

pub fn graph(agents: usize, edges: impl IntoIterator<Item = Edge>) -> Net {
    Net::from_edges(agents, edges)
}

pub fn cycle(n: usize) -> Vec<Edge> {
    (0..n).map(|i| [i, (i + 1) % n]).collect()
}

pub fn chain(n: usize) -> Vec<Edge> {
    (1..n).map(|i| [i - 1, i]).collect()
}

pub fn complete(n: usize) -> Vec<Edge> {
    (0..n).flat_map(|j| (0..j).map(move |i| [i, j])).collect()
}

pub fn bipartite(m: usize, n: usize) -> Vec<Edge> {
    (0..m)
        .flat_map(|i| (0..n).map(move |j| [i, m + j]))
        .collect()
}

/// An outer cycle, an inner star, and five spokes.
pub fn petersen() -> Vec<Edge> {
    let star = (0..5).map(|i| [5 + i, 5 + (i + 2) % 5]);
    let spokes = (0..5).map(|i| [i, 5 + i]);
    cycle(5).into_iter().chain(star).chain(spokes).collect()
}

/// A triangular lattice of `rows` × `columns` agents a distance 1 apart.
pub fn lattice(rows: usize, columns: usize) -> Vec<Vector<2>> {
    let at = |k: usize| {
        let (row, column) = (k / columns, k % columns);
        Vector::<2>::new(
            column as f64 + 0.5 * (row % 2) as f64,
            row as f64 * 0.75f64.sqrt(),
        )
    };
    (0..rows * columns).map(at).collect()
}

/// A small stream of whole numbers, for shapes that proptest need not shrink.
pub struct Stream(pub u64);

impl Stream {
    /// A number below `bound`.
    pub fn below(&mut self, bound: usize) -> usize {
        // Multiplier and increment of Knuth's MMIX; the high bits are the good ones.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % bound
    }

    /// A number in [0, 1).
    pub fn share(&mut self) -> f64 {
        self.below(1 << 30) as f64 / f64::from(1 << 30)
    }
}
