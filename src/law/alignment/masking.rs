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
//!   T = √(1 − m²)/m; and both distances from the ends exceed P/d, P = r² m/√(1 − m²), which
//!   leaves m P/d < t < d − m P/d.
//! - For a given h the sum is largest in the middle. There it exceeds s0 only where
//!   h < W d/2 with W = √(1 − s0²/4)/(s0/2), and only for d² > 2r²/W: shorter ways are never
//!   masked.

use crate::law::alignment::crowd::{Crowd, Stretch};
use crate::math::Vector;
use crate::sense::Scene;
use crate::world::spec::MaskingSpec;

/// Masking by third agents; see the module.
#[derive(Debug, Clone)]
pub(super) struct Masking {
    /// r⁴.
    softening: f64,
    /// s0.
    onset: f64,
    /// k.
    strength: f64,
    /// m.
    cosine: f64,
    /// T.
    cone: f64,
    /// W.
    waist: f64,
    /// P.
    apart: f64,
    /// 2r²/W.
    least_squared: f64,
}

impl Masking {
    pub(super) fn new(spec: &MaskingSpec) -> Self {
        let squared = spec.radius * spec.radius;
        let tangent = |cosine: f64| (1.0 - cosine * cosine).sqrt() / cosine;
        let cosine = spec.onset - 1.0;
        let waist = tangent(0.5 * spec.onset);
        Self {
            softening: squared * squared,
            onset: spec.onset,
            strength: spec.strength,
            cosine,
            cone: tangent(cosine),
            waist,
            apart: squared / tangent(cosine),
            least_squared: 2.0 * squared / waist,
        }
    }

    /// The half-width that the search for third agents has on the shortest way.
    pub(super) fn least_width(&self) -> f64 {
        0.5 * self.waist * self.least_squared.sqrt()
    }

    /// The factor by which third agents weaken the influence of agent `j` of the scene on
    /// agent `i`. The same both ways, to the last bit.
    pub(super) fn factor<const D: usize>(
        &self,
        crowd: &Crowd<D>,
        scene: &Scene<'_, D>,
        i: usize,
        j: usize,
    ) -> f64 {
        let (i, j) = match scene.agents[i] < scene.agents[j] {
            true => (i, j),
            false => (j, i),
        };
        let (start, end) = (scene.positions[i], scene.positions[j]);
        let way = end - start;
        let mut sum = 0.0;
        self.third_agents(crowd, &start, &end, |l, offset| {
            if l != i && l != j {
                sum += self.height(&way, offset);
            }
        });
        libm::exp(-sum)
    }

    /// h(w_ijl + w_jil), by the ways from i to j and to l.
    fn height<const D: usize>(&self, way: &Vector<D>, to_third: &Vector<D>) -> f64 {
        let back = to_third - way;
        let cosines = self.smoothed_cosine(way, to_third) + self.smoothed_cosine(&-way, &back);
        let above = (cosines - self.onset).max(0.0);
        self.strength * (above * above * above)
    }

    /// w, for two ways from one agent.
    fn smoothed_cosine<const D: usize>(&self, a: &Vector<D>, b: &Vector<D>) -> f64 {
        let size = (a.norm_squared() * b.norm_squared() + self.softening).sqrt();
        if size > 0.0 { a.dot(b) / size } else { 0.0 }
    }

    /// Calls `visit` with every agent that may mask two points from each other, and a few
    /// more.
    fn third_agents<const D: usize>(
        &self,
        crowd: &Crowd<D>,
        start: &Vector<D>,
        end: &Vector<D>,
        visit: impl FnMut(usize, &Vector<D>),
    ) {
        let squared = (end - start).norm_squared();
        // A hair below: right at the limit the sum is 0 to rounding.
        if squared <= self.least_squared * (1.0 - 1e-9) {
            return;
        }
        let length = squared.sqrt();
        let middle = 0.5 * length;
        let end_zone = (self.cosine * self.apart / length).min(middle);
        let stretch = Stretch {
            from: end_zone,
            to: length - end_zone,
        };
        let half_width = |part: Stretch| {
            // The double cone is widest in the middle.
            let at = middle.max(part.from).min(part.to);
            let cone = self.cone * at.min(length - at).max(0.0);
            // The lesser of both; where the cone is all round, its ends have no number.
            (self.waist * middle).min(cone)
        };
        crowd.between(start, end, stretch, half_width, visit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn masking(radius: f64, onset: f64) -> Masking {
        Masking::new(&MaskingSpec {
            radius,
            onset,
            strength: 3000.0,
        })
    }

    /// The sum of (B.1), and how many agents were looked at for it.
    fn pruned<const D: usize>(
        masking: &Masking,
        crowd: &Crowd<D>,
        x: &[Vector<D>],
        [i, j]: [usize; 2],
    ) -> (f64, usize) {
        let (mut sum, mut visits) = (0.0, 0);
        masking.third_agents(crowd, &x[i], &x[j], |l, offset| {
            visits += 1;
            if l != i && l != j {
                sum += masking.height(&(x[j] - x[i]), offset);
            }
        });
        (sum, visits)
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
        let masking = masking(r, onset);
        let mut crowd = Crowd::default();
        crowd.rebuild(x, masking.least_width());
        let mut masked = 0;
        for i in 0..x.len() {
            for j in (0..x.len()).filter(|&j| j != i) {
                let (found, _) = pruned(&masking, &crowd, x, [i, j]);
                let expected = plain(x, [i, j], r, onset);
                let error = (found - expected).abs();
                assert!(
                    error <= 1e-9 * (1.0 + expected),
                    "{i} {j}: {found} {expected}"
                );
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
            let masking = masking(radius, 1.9);
            let mut crowd = Crowd::default();
            crowd.rebuild(&x, masking.least_width());
            for pair in [[0, 1], [0, 4], [4, 5], [3, 6]] {
                let (sum, _) = pruned(&masking, &crowd, &x, pair);
                assert!(sum >= 0.0 && sum.is_finite(), "{radius} {pair:?}: {sum}");
            }
        }
    }

    #[test]
    fn close_pairs_are_never_masked_and_the_limit_is_sharp() {
        let r = 0.7;
        let limit = masking(r, 1.9).least_squared.sqrt();
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
        let mut crowd = Crowd::default();
        let wide = masking(1.0, 1.9);
        crowd.rebuild(&x, wide.least_width());
        let middle = 20 * 40 + 20;
        // Two steps are less than 2.47 r: nobody is looked at.
        assert_eq!(pruned(&wide, &crowd, &x, [middle, middle + 2]).1, 0);
        let narrow = masking(0.3, 1.9);
        crowd.rebuild(&x, narrow.least_width());
        let visits = |i: usize, j: usize| pruned(&narrow, &crowd, &x, [i, j]).1;
        assert!((1..=9).contains(&visits(middle, middle + 2)));
        assert!((9..60).contains(&visits(middle, middle + 10)));
        // On average over all places in the crowd, a small part of its 1600 agents.
        let others = || (0..1600).step_by(7);
        let all: usize = others().map(|j| visits(middle, j)).sum();
        assert!(all / others().count() < 100, "{}", all / others().count());
    }
}
