//! Every analysis equals a plain dense computation over all pairs.

use nalgebra::DMatrix;
use proptest::prelude::*;
use volary::math::{Bump, Vector};
use volary::metric::{cluster_correlation, milling, order, union};
use volary::net::{
    Adjacency, LinkChanges, Net, algebraic_connectivity, crossings, link_energy, neighborhood,
    structural_potential,
};

use crate::sample::{BUMP_START, pair, points};
use crate::structure::{check_structure, check_votes};

type Dense = DMatrix<f64>;

fn dense<const D: usize>(
    q: &[Vector<D>],
    entry: impl Fn(usize, usize, f64) -> f64,
) -> DMatrix<f64> {
    Dense::from_fn(q.len(), q.len(), |i, j| {
        if i == j {
            0.0
        } else {
            entry(i, j, (q[j] - q[i]).norm())
        }
    })
}

fn step(within: bool) -> f64 {
    if within { 1.0 } else { 0.0 }
}

/// The bump (16) by its formula.
pub fn bump(z: f64) -> f64 {
    let phase = std::f64::consts::PI * (z - BUMP_START) / (1.0 - BUMP_START);
    if z <= BUMP_START {
        1.0
    } else if z >= 1.0 {
        0.0
    } else {
        0.5 * (1.0 + phase.cos())
    }
}

fn angle<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    // Unlike the arc cosine, good to the last digits at small angles as well.
    let (a, b) = (a.normalize(), b.normalize());
    2.0 * (a - b).norm().atan2((a + b).norm())
}

fn check_matrix(found: &Adjacency, expected: &Dense) {
    let n = expected.nrows();
    assert!((found.dense() - expected).amax() < 1e-13);
    let mut laplacian = -expected.clone();
    for i in 0..n {
        laplacian[(i, i)] = expected.row(i).sum();
        assert!((found.out_degrees()[i] - expected.row(i).sum()).abs() < 1e-12);
        assert!((found.in_degrees()[i] - expected.column(i).sum()).abs() < 1e-12);
        let row: Vec<_> = (0..n).filter(|&j| expected[(i, j)] > 1e-14).collect();
        let listed = found.row(i).iter().filter(|(_, a)| *a > 1e-14);
        assert_eq!(listed.map(|(j, _)| *j).collect::<Vec<_>>(), row);
    }
    assert!((found.laplacian() - &laplacian).amax() < 1e-12);
    let column_sums = laplacian.row_sum().amax();
    assert!((found.imbalance() - column_sums).abs() < 1e-12);
    assert_eq!(found.is_balanced(), column_sums < 1e-9);
    assert_eq!(found.is_undirected(), *expected == expected.transpose());

    let reach = reachable(expected);
    let parts = found.partition();
    for i in 0..n {
        for j in 0..n {
            assert_eq!(parts.of()[i] == parts.of()[j], reach[(i, j)]);
        }
        let size = (0..n).filter(|&j| reach[(i, j)]).count();
        assert_eq!(parts.sizes()[parts.of()[i]], size);
    }
    let largest = (0..n)
        .map(|i| (0..n).filter(|&j| reach[(i, j)]).count())
        .max();
    assert_eq!(parts.density(), largest.unwrap_or(0) as f64 / n as f64);

    let mirror = (&laplacian + laplacian.transpose()) * 0.5;
    let laplacian = if column_sums < 1e-9 {
        // Balanced: the symmetric part of L is the mirror's Laplacian.
        mirror
    } else {
        let a = (expected + expected.transpose()) * 0.5;
        let entry = |i: usize, j: usize| if i == j { a.row(i).sum() } else { -a[(i, j)] };
        Dense::from_fn(n, n, entry)
    };
    // Not negative, so they are the singular values: another iteration than the library's.
    let mut values: Vec<f64> = laplacian.singular_values().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    let found = algebraic_connectivity(found).expect("two or more agents");
    assert!(
        (found - values[1]).abs() < 1e-9,
        "{found} is not {}",
        values[1]
    );
}

/// Who can be reached from whom along edges of any direction, by Warshall's algorithm.
fn reachable(adjacency: &Dense) -> DMatrix<bool> {
    let n = adjacency.nrows();
    let mut reach = DMatrix::from_fn(n, n, |i, j| {
        i == j || adjacency[(i, j)] > 0.0 || adjacency[(j, i)] > 0.0
    });
    for k in 0..n {
        for i in 0..n {
            for j in 0..n {
                reach[(i, j)] |= reach[(i, k)] && reach[(k, j)];
            }
        }
    }
    reach
}

fn check_neighborhoods<const D: usize>(q: &[Vector<D>], headings: &[Vector<D>], range: f64) {
    let radii: Vec<f64> = (0..q.len())
        .map(|i| range * (0.4 + 0.3 * (i % 3) as f64))
        .collect();
    let angles: Vec<f64> = (0..q.len()).map(|i| 0.5 + 0.8 * (i % 4) as f64).collect();
    let rho = Bump::new(BUMP_START);
    let between = |i: usize, j: usize| angle(&headings[i], &headings[j]);
    check_matrix(
        &neighborhood::uniform(q, range),
        &dense(q, |_, _, d| step(d <= range)),
    );
    check_matrix(
        &neighborhood::shells(q, &radii),
        &dense(q, |i, _, d| step(d <= radii[i])),
    );
    check_matrix(
        &neighborhood::smooth(q, range, &rho),
        &dense(q, |_, _, d| bump(d / range)),
    );
    check_matrix(
        &neighborhood::conic(q, headings, range, 1.1),
        &dense(q, |i, j, d| step(d <= range && between(i, j) <= 1.1)),
    );
    check_matrix(
        &neighborhood::cones(q, headings, &radii, &angles),
        &dense(q, |i, j, d| {
            step(d <= radii[i] && between(i, j) <= angles[i])
        }),
    );
    check_matrix(
        &neighborhood::smooth_conic(q, headings, range, 1.1, &rho),
        &dense(q, |i, j, d| bump(d / range) * bump(between(i, j) / 1.1)),
    );
    check_matrix(
        &neighborhood::field_of_view(q, headings, range, 1.3),
        &dense(q, |i, j, d| {
            step(d <= range && angle(&headings[i], &(q[j] - q[i])) <= 1.3)
        }),
    );
}

fn check_motion<const D: usize>(q: &[Vector<D>], p: &[Vector<D>], range: f64) {
    let n = q.len();
    let clusters = Net::new(q, range).partition();
    let reach = reachable(&dense(q, |_, _, d| step(d <= range)));
    let cosine = |i: usize, j: usize| p[i].dot(&p[j]) / (p[i].norm() * p[j].norm());
    let (mut all, mut within, mut together) = (0.0, 0.0, 0);
    for i in 0..n {
        let others: Vec<usize> = (0..n).filter(|&j| j != i && reach[(i, j)]).collect();
        all += (0..n)
            .filter(|&j| j != i)
            .map(|j| cosine(i, j))
            .sum::<f64>();
        if !others.is_empty() {
            let sum: f64 = others.iter().map(|&j| cosine(i, j)).sum();
            within += sum / others.len() as f64;
            together += 1;
        }
    }
    let order = order(p).expect("two or more agents");
    assert!((order - all / (n * (n - 1)) as f64).abs() < 1e-12);
    let found = cluster_correlation(p, &clusters);
    assert_eq!(found.is_some(), together > 0);
    assert!((found.unwrap_or(0.0) - within / f64::from(together.max(1))).abs() < 1e-12);
    let parts = (0..n).filter(|&i| (0..i).all(|j| !reach[(i, j)])).count();
    let expected = 1.0 - (parts as f64 - 1.0) / (n as f64 - 1.0);
    assert!((union(&clusters).expect("two or more") - expected).abs() < 1e-12);

    // |r × v|² as the Gram determinant of the sums over pairs of agents.
    let center = q.iter().sum::<Vector<D>>() / n as f64;
    let (mut squares, mut scale) = (0.0, 0.0);
    for i in 0..n {
        let r = q[i] - center;
        scale += r.norm() * p[i].norm();
        for j in 0..n {
            let s = q[j] - center;
            squares += r.dot(&s) * p[i].dot(&p[j]) - r.dot(&p[j]) * p[i].dot(&s);
        }
    }
    let found = milling(q, p).expect("they move");
    assert!((found - squares.max(0.0).sqrt() / scale).abs() < 1e-6);
    assert!((found * found - squares / (scale * scale)).abs() < 1e-12);
}

/// A vector for each point that has a direction.
fn directions<const D: usize>(q: &[Vector<D>]) -> Vec<Vector<D>> {
    q.iter()
        .enumerate()
        .map(|(i, q)| q.yxz_turned(i) + Vector::repeat(0.1 + 0.01 * i as f64))
        .collect()
}

trait Turned {
    /// The coordinates in another order and with other signs, by index.
    fn yxz_turned(&self, i: usize) -> Self;
}

impl<const D: usize> Turned for Vector<D> {
    fn yxz_turned(&self, i: usize) -> Self {
        let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        Self::from_fn(|axis, _| sign * self[(axis + 1) % D])
    }
}

fn check_all<const D: usize>(q: &[Vector<D>], range: f64, share: f64) {
    let p = directions(q);
    check_neighborhoods(q, &p, range);
    for smooth in [false, true] {
        check_structure(q, &p, &pair(share * range, range, smooth));
    }
    check_votes(q, &pair(share * range, range, false));
    check_motion(q, &p, range);
}

fn crossings_of_all_pairs(q: &[Vector<2>], net: &Net) -> usize {
    let ends = |e: &[usize; 2]| (q[e[0]], q[e[1]]);
    let mut count = 0;
    for (k, e) in net.edges().iter().enumerate() {
        for f in &net.edges()[..k] {
            // Where a + s (b − a) = c + t (d − c), by Cramer's rule.
            let ((a, b), (c, d)) = (ends(e), ends(f));
            let det = (b - a).perp(&(d - c));
            let (s, t) = ((c - a).perp(&(d - c)) / det, (c - a).perp(&(b - a)) / det);
            let shared = e.iter().any(|i| f.contains(i));
            let inside = |x: f64| x > 0.0 && x < 1.0;
            count += usize::from(!shared && inside(s) && inside(t));
        }
    }
    count
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nets_in_the_plane(q in points::<2>(), range in 0.8..4.0f64, share in 0.5..0.95f64) {
        check_all(&q, range, share);
        let net = Net::new(&q, range);
        prop_assert_eq!(crossings(&q, &net), crossings_of_all_pairs(&q, &net));
    }

    #[test]
    fn nets_in_space(q in points::<3>(), range in 1.0..5.0f64, share in 0.5..0.95f64) {
        check_all(&q, range, share);
    }

    #[test]
    fn links_come_and_go(q in points::<2>(), range in 0.8..4.0f64, moved in 0..60usize) {
        let mut after = q.clone();
        let i = moved % q.len();
        after[i] += Vector::<2>::new(0.9, -0.4);
        let (old, new) = (Net::new(&q, range), Net::new(&after, range));
        let changes = LinkChanges::between(&old, &new);
        let within = |q: &[Vector<2>], j: usize| (q[i] - q[j]).norm() <= range;
        let others = || (0..q.len()).filter(|&j| j != i);
        let created = others().filter(|&j| !within(&q, j) && within(&after, j)).count();
        let lost = others().filter(|&j| within(&q, j) && !within(&after, j)).count();
        prop_assert_eq!((changes.created.len(), changes.lost.len()), (created, lost));
        let jump = changes.energy_jump(0.5);
        prop_assert_eq!(jump, 0.5 * (new.edges().len() as f64 - old.edges().len() as f64));
    }

    #[test]
    fn a_link_jumps_by_its_energy(spacing in 0.5..3.0f64, stretch in 1.05..2.0f64) {
        let pair = pair(spacing, spacing * stretch, false);
        let energy = |x: f64| {
            let q = [Vector::<2>::zeros(), Vector::<2>::new(x, 0.0)];
            structural_potential(&q, &Net::new(&q, pair.range), &pair)
        };
        let jump = energy(pair.range * (1.0 - 1e-12)) - energy(pair.range * (1.0 + 1e-12));
        prop_assert!((jump - link_energy(&pair)).abs() < 1e-9);
    }
}
