//! Masking by third agents: Djokam & Rathinam, App. B.
//!
//! The influence of j on i is multiplied by exp(−Σ_l h(w_ijl + w_jil)), (B.1), with
//! w_ijl = ⟨x_j − x_i, x_l − x_i⟩/√(|x_j − x_i|²|x_l − x_i|² + r⁴) and h(s) = k (s − s0)³
//! above the onset s0, 0 below.
//!
//! Only few third agents matter, since s > s0 needs a lot. Let d = |x_j − x_i| be the length
//! of the way, t the place of x_l along it and h its distance from it.
//!
//! - Both terms exceed m = s0 − 1, for neither is more than 1. So both angles have cosines
//!   above m, which puts l between the ends, in the double cone h < T min(t, d − t) with
//!   T = √(1 − m²)/m.
//! - For a given h the sum is largest in the middle. There it exceeds s0 only where
//!   h < W d/2 with W = √(1 − s0²/4)/(s0/2), and only for d² > 2r²/W: shorter ways are never
//!   masked.

mod clusters;
mod lanes;
mod region;
mod table;

use crate::law::Link;
use crate::math::{Vector, vectorized};
use crate::world::spec::MaskingSpec;
use clusters::Clusters;
use lanes::Factors;
use table::Table;

/// Masking by third agents; see the module.
#[derive(Debug, Clone)]
pub(super) struct Masking<const D: usize> {
    /// r⁴.
    softening: f64,
    /// s0.
    onset: f64,
    /// k.
    strength: f64,
    /// T.
    cone: f64,
    /// W.
    waist: f64,
    /// 2r²/W.
    least_squared: f64,
    clusters: Clusters<D>,
    table: Table,
}

/// Agents up to which the factors of all pairs are kept, to be worked out once: 64 MiB.
const KEPT: usize = 4096;

impl<const D: usize> Masking<D> {
    pub(super) fn new(spec: &MaskingSpec) -> Self {
        let squared = spec.radius * spec.radius;
        let tangent = |cosine: f64| (1.0 - cosine * cosine).sqrt() / cosine;
        let waist = tangent(0.5 * spec.onset);
        Self {
            softening: squared * squared,
            onset: spec.onset,
            strength: spec.strength,
            cone: tangent(spec.onset - 1.0),
            waist,
            least_squared: 2.0 * squared / waist,
            clusters: Clusters::default(),
            table: Table::default(),
        }
    }

    /// Takes note of where agents are, given with numbers of their own. Where `all` pairs will be
    /// asked for, their factors are worked out at once if there are not too many.
    pub(super) fn prepare(&mut self, positions: &[Vector<D>], numbers: &[u32], all: bool) {
        self.clusters.rebuild(positions, numbers);
        let mut table = std::mem::take(&mut self.table);
        let kept = if all && positions.len() <= KEPT {
            positions.len()
        } else {
            0
        };
        let order: Vec<Vector<D>> = self.clusters.order().map(|at| positions[at]).collect();
        table.fill(kept, |place, row| {
            for (ends, row) in order.chunks(8).zip(row.chunks_mut(8)) {
                let factors = self.factors(&order[place], &ends[..row.len()]);
                row.copy_from_slice(&factors[..row.len()]);
            }
        });
        self.table = table;
    }

    /// Multiplies influences on agent `i` by the factors by which third agents weaken them. The
    /// factor of a pair is the same both ways, to the last bit.
    pub(super) fn weaken(&self, positions: &[Vector<D>], i: usize, links: &mut [Link<D>]) {
        let start = &positions[i];
        let place = self.clusters.place(i);
        let mut unknown = Vec::new();
        for (number, link) in (0u32..).zip(links.iter_mut()) {
            let other = self.clusters.place(link.index);
            if let Some(factor) = self.table.get(place as usize, other as usize) {
                link.weight *= factor;
                continue;
            }
            let squared = (positions[link.index] - start).norm_squared();
            // A hair below: right at the limit the sum is 0 to rounding.
            if squared > self.least_squared * (1.0 - 1e-9) {
                unknown.push((other, number));
            }
        }
        // Eight that are near each other have many third agents in common.
        unknown.sort_unstable();
        for eight in unknown.chunks(8) {
            let mut ends = [*start; 8];
            for (end, &(_, number)) in ends.iter_mut().zip(eight) {
                *end = positions[links[number as usize].index];
            }
            let factors = self.factors(start, &ends[..eight.len()]);
            for (&(_, number), factor) in eight.iter().zip(factors) {
                links[number as usize].weight *= factor;
            }
        }
    }

    /// The factors of one agent and up to eight others.
    fn factors(&self, start: &Vector<D>, ends: &[Vector<D>]) -> [f64; 8] {
        vectorized(Factors {
            clusters: &self.clusters,
            start,
            ends,
            widths: [self.cone, self.waist],
            softening: self.softening,
            onset: self.onset,
            strength: self.strength,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::alignment::masking::region::Region;
    use proptest::prelude::*;

    fn masking<const D: usize>(x: &[Vector<D>], radius: f64, onset: f64) -> Masking<D> {
        let mut masking = Masking::new(&MaskingSpec {
            radius,
            onset,
            strength: 3000.0,
        });
        let numbers: Vec<u32> = (0..x.len() as u32).collect();
        masking.prepare(x, &numbers, x.len() < 100);
        masking
    }

    /// The factors of one agent and all others, itself included.
    fn row<const D: usize>(masking: &Masking<D>, x: &[Vector<D>], i: usize) -> Vec<f64> {
        let link = |index: usize| Link {
            index,
            weight: 1.0,
            velocity: Vector::zeros(),
        };
        let mut links: Vec<_> = (0..x.len()).filter(|&j| j != i).map(link).collect();
        masking.weaken(x, i, &mut links);
        let mut row: Vec<f64> = links.iter().map(|link| link.weight).collect();
        row.insert(i, 1.0);
        row
    }

    /// The same over all third agents, as printed.
    fn plain<const D: usize>(x: &[Vector<D>], [i, j]: [usize; 2], r: f64, onset: f64) -> f64 {
        let w = |i: usize, j: usize, l: usize| {
            let (a, b) = (x[j] - x[i], x[l] - x[i]);
            a.dot(&b) / (a.norm_squared() * b.norm_squared() + r.powi(4)).sqrt()
        };
        let h = |s: f64| match s <= onset {
            true => 0.0,
            false => 3000.0 * (s - onset).powi(3),
        };
        let others = (0..x.len()).filter(|&l| l != i && l != j);
        others.map(|l| h(w(i, j, l) + w(j, i, l))).sum()
    }

    /// Returns how many pairs are masked.
    fn equals_the_plain_sum<const D: usize>(x: &[Vector<D>], r: f64, onset: f64) -> usize {
        let kept = masking(x, r, onset);
        let mut alone = kept.clone();
        alone.table = Table::default();
        let mut masked = 0;
        for i in 0..x.len() {
            let found = row(&kept, x, i);
            // Each pair worked out anew, and by itself.
            let again = row(&alone, x, i);
            assert_eq!(found, again);
            for j in (0..x.len()).filter(|&j| j != i) {
                let expected = plain(x, [i, j], r, onset);
                let error = (found[j] - (-expected).exp()).abs();
                // The sum's own rounding becomes the factor's.
                let allowed = 1e-9 * (1.0 + expected) * (-expected).exp() + 1e-300;
                assert!(error <= allowed, "{i} {j}: {} {expected}", found[j]);
                let single = alone.factors(&x[j], &x[i..=i])[0];
                assert!(single == found[j] || expected == 0.0, "{i} {j}");
                masked += usize::from(expected > 0.0);
            }
        }
        masked
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn pruning_changes_nothing(
            points in prop::collection::vec(prop::array::uniform3(-5.0..5.0f64), 3..30),
            r in 0.01..4.0f64,
            onset in prop_oneof![Just(1.9), Just(1.0), 1.0..1.99f64],
            bend in 0.0..0.3f64,
        ) {
            let space: Vec<Vector<3>> = points.iter().copied().map(Vector::from).collect();
            equals_the_plain_sum(&space, r, onset);
            let flat = |x: &[f64; 3]| Vector::<2>::new(x[0], x[1]);
            let plane: Vec<Vector<2>> = points.iter().map(flat).collect();
            equals_the_plain_sum(&plane, r, onset);
            let lined_up = |x: &[f64; 3]| Vector::<3>::new(x[0], bend * x[1], 0.2 * x[0]);
            let line: Vec<Vector<3>> = points.iter().map(lined_up).collect();
            equals_the_plain_sum(&line, r, onset);
        }
    }

    fn grid(side: u32) -> Vec<Vector<2>> {
        let at = |k: u32| Vector::<2>::new(f64::from(k % side), f64::from(k / side));
        (0..side * side).map(at).collect()
    }

    #[test]
    fn who_stands_in_a_row_is_masked_by_those_between() {
        let row = &grid(12)[..12];
        // All pairs but neighbours, both ways.
        assert_eq!(equals_the_plain_sum(row, 0.2, 1.9), 12 * 11 - 2 * 11);
        assert!(equals_the_plain_sum(&grid(6), 0.2, 1.9) > 100);
        // With r → 0 the cosines are exact, and the middle masks with h(2) = 3.
        let three = &row[..3];
        assert!((plain(three, [0, 2], 1e-6, 1.9) - 3.0).abs() < 1e-9);
        assert_eq!(equals_the_plain_sum(three, 1e-6, 1.9), 2);
    }

    #[test]
    fn agents_at_one_point_and_extreme_radii_give_numbers() {
        let mut x = grid(2);
        x.extend(vec![x[0]; 3]);
        for radius in [1e-200, 1e-9, 1e9, 1e100] {
            let masking = masking(&x, radius, 1.9);
            for i in 0..x.len() {
                for factor in row(&masking, &x, i) {
                    assert!((0.0..=1.0).contains(&factor), "{radius} {i}: {factor}");
                }
            }
        }
    }

    #[test]
    fn close_pairs_are_never_masked_and_the_limit_is_sharp() {
        let r = 0.7;
        let limit = masking::<2>(&[], r, 1.9).least_squared.sqrt();
        assert!((limit / r - 2.467).abs() < 1e-3, "{}", limit / r);
        let middle = |length: f64| {
            let x = [[0.0, 0.0], [length, 0.0], [0.5 * length, 0.0]].map(Vector::<2>::from);
            plain(&x, [0, 1], r, 1.9)
        };
        assert_eq!(middle(limit * 0.999), 0.0);
        assert!(middle(limit * 1.001) > 0.0);
    }

    #[test]
    fn far_agents_are_not_visited() {
        let x = grid(40);
        let masking = masking(&x, 0.3, 1.9);
        let visits = |i: usize, j: usize| {
            let region = Region::new(&x[i], &x[j..=j], [masking.cone, masking.waist]);
            let mut visits = 0;
            for (balls, clusters) in masking.clusters.eights() {
                let met = balls.within(&region);
                visits += met
                    .map(|ball| clusters[ball].within(&region).count())
                    .sum::<usize>();
            }
            visits
        };
        let middle = 20 * 40 + 20;
        assert!((1..=9).contains(&visits(middle, middle + 2)));
        assert!((9..60).contains(&visits(middle, middle + 10)));
        // On average over all places in the crowd, a small part of its 1600 agents.
        let others = || (0..1600).step_by(7);
        let all: usize = others().map(|j| visits(middle, j)).sum();
        assert!(all / others().count() < 100, "{}", all / others().count());
    }

    /// Far from the others, or many at one place: neither costs more than it must.
    #[test]
    fn outliers_and_crowds_at_one_point_are_sorted_too() {
        let mut x = grid(5);
        x.extend([[1e90, -1e90], [-1e12, 3.0]].map(Vector::<2>::from));
        x.extend(vec![x[7]; 20]);
        assert!(equals_the_plain_sum(&x, 0.2, 1.9) > 100);
    }
}
