//! Agents in clusters of eight, to be sieved and summed over eight at a time.

use crate::law::alignment::masking::region::Region;
use crate::math::Vector;

/// A coordinate, or another number, of eight at a time.
pub(super) type Eight = [f64; 8];

/// Points in space, eight at a time.
#[derive(Debug, Clone)]
pub(super) struct Eights<const D: usize> {
    points: [Eight; D],
    radii: Eight,
    count: usize,
}

/// All agents: those near each other in one cluster, and clusters near each other one after
/// the other.
#[derive(Debug, Clone, Default)]
pub(super) struct Clusters<const D: usize> {
    /// The agents, cluster by cluster.
    order: Vec<u32>,
    /// Where each agent is in that order.
    places: Vec<u32>,
    clusters: Vec<Eights<D>>,
    /// Balls about the clusters.
    balls: Vec<Eights<D>>,
}

impl<const D: usize> Eights<D> {
    /// Some points, at least one and at most eight, with radii about them.
    fn new(points: impl Iterator<Item = (Vector<D>, f64)>) -> Self {
        let mut eights = Self {
            points: [[0.0; 8]; D],
            radii: [0.0; 8],
            count: 0,
        };
        for (point, radius) in points {
            for axis in 0..D {
                eights.points[axis][eights.count] = point[axis];
            }
            eights.radii[eights.count] = radius;
            eights.count += 1;
        }
        eights
    }

    /// Which of them may lie in a region.
    #[inline(always)]
    pub(super) fn within(&self, region: &Region<D>) -> Places {
        let found = u64::from_le_bytes(region.sieve(&self.points, &self.radii));
        // Those beyond the count do not count.
        Places(found & (u64::MAX >> (64 - 8 * self.count)))
    }

    /// Where one of them is.
    #[inline(always)]
    pub(super) fn point(&self, place: usize) -> [f64; D] {
        std::array::from_fn(|axis| self.points[axis][place])
    }
}

/// Some places of eight: a byte for each, 1 or 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places(u64);

impl Iterator for Places {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let next = (self.0.trailing_zeros() / 8) as usize;
        self.0 &= self.0.wrapping_sub(1);
        (next < 8).then_some(next)
    }
}

impl<const D: usize> Clusters<D> {
    /// Sorts some positions. Of those that are equal along an axis, the lower number comes
    /// first.
    pub(super) fn rebuild(&mut self, positions: &[Vector<D>], numbers: &[u32]) {
        let count = positions.len();
        self.order.clear();
        self.order.extend(0..count as u32);
        sort(&mut self.order, positions, numbers);
        self.places.resize(count, 0);
        for (place, &agent) in self.order.iter().enumerate() {
            self.places[agent as usize] = place as u32;
        }
        let at = |agent: &u32| positions[*agent as usize];
        self.clusters.clear();
        self.clusters.extend((self.order.chunks(8)).map(|agents| {
            let points = agents.iter().map(|agent| (at(agent), 0.0));
            Eights::new(points)
        }));
        let ball = |agents: &[u32]| {
            let (min, max) = bounds(agents, positions);
            let middle = (min + max) * 0.5;
            let squares = agents.iter().map(|it| (at(it) - middle).norm_squared());
            (middle, squares.fold(0.0, f64::max).sqrt())
        };
        self.balls.clear();
        (self.balls).extend((self.order.chunks(64)).map(|it| Eights::new(it.chunks(8).map(ball))));
    }

    /// The agents, cluster by cluster.
    pub(super) fn order(&self) -> impl Iterator<Item = usize> {
        self.order.iter().map(|&agent| agent as usize)
    }

    /// Where an agent is in the order of the clusters: close to others that are near it.
    pub(super) fn place(&self, agent: usize) -> u32 {
        self.places[agent]
    }

    /// Balls about all clusters, eight at a time, each with its clusters.
    #[inline(always)]
    pub(super) fn eights(&self) -> impl Iterator<Item = (&Eights<D>, &[Eights<D>])> {
        self.balls.iter().zip(self.clusters.chunks(8))
    }
}

/// Sorts agents so that each eight, each sixteen, and so on are near each other: by halves,
/// each across the longest side of the box about them.
fn sort<const D: usize>(agents: &mut [u32], positions: &[Vector<D>], numbers: &[u32]) {
    let number = |agent: u32| numbers[agent as usize];
    if agents.len() <= 8 {
        return agents.sort_unstable_by_key(|&agent| number(agent));
    }
    let (min, max) = bounds(agents, positions);
    let axis = (max - min).imax();
    let half = (agents.len() / 2).next_multiple_of(8);
    agents.select_nth_unstable_by(half, |&a, &b| {
        let [at, other] = [a, b].map(|agent| positions[agent as usize][axis]);
        at.total_cmp(&other).then(number(a).cmp(&number(b)))
    });
    let (low, high) = agents.split_at_mut(half);
    sort(low, positions, numbers);
    sort(high, positions, numbers);
}

/// Lowest and highest corner of the box about some agents.
fn bounds<const D: usize>(agents: &[u32], positions: &[Vector<D>]) -> (Vector<D>, Vector<D>) {
    let mut min = Vector::<D>::repeat(f64::INFINITY);
    let mut max = Vector::<D>::repeat(f64::NEG_INFINITY);
    for &agent in agents {
        min = min.inf(&positions[agent as usize]);
        max = max.sup(&positions[agent as usize]);
    }
    (min, max)
}
