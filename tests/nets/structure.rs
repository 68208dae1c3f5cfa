//! Energy, defect, rigidity and votes by plain loops over all pairs.

use nalgebra::DMatrix;
use volary::math::{AlphaPair, Fade, Vector};
use volary::metric::deviation_energy;
use volary::net::{
    Net, Rigidity, Verdict, defect, link_energy, neighborhood, normalised_defect,
    potential_gradient, realisation_error, structural_energy, structural_potential, votes,
};

use crate::dense::bump;

/// The rank of a matrix by elimination with full pivoting.
fn rank(mut m: DMatrix<f64>) -> usize {
    let mut rank = 0;
    while rank < m.nrows().min(m.ncols()) {
        let rest = m.view_range(rank.., rank..);
        let (row, column) = rest.icamax_full();
        if rest[(row, column)].abs() < 1e-9 {
            break;
        }
        m.swap_rows(rank, rank + row);
        m.swap_columns(rank, rank + column);
        for i in rank + 1..m.nrows() {
            let factor = m[(i, rank)] / m[(rank, rank)];
            for j in rank..m.ncols() {
                m[(i, j)] -= factor * m[(rank, j)];
            }
        }
        rank += 1;
    }
    rank
}

pub fn check_structure<const D: usize>(q: &[Vector<D>], p: &[Vector<D>], pair: &AlphaPair) {
    let (n, net) = (q.len(), Net::new(q, pair.range));
    let smooth = matches!(pair.fade, Fade::Smooth(_));
    let weight = |d: f64| if smooth { bump(d / pair.range) } else { 1.0 };
    let (mut v, mut edges, mut worst, mut deviation) = (0.0, Vec::new(), 0.0f64, 0.0);
    for j in 0..n {
        for i in 0..j {
            let d = (q[j] - q[i]).norm();
            if d <= pair.range {
                v += weight(d) * pair.action.potential(d - pair.spacing);
                worst = worst.max((d - pair.spacing).abs());
                deviation += 2.0 * ((d - pair.spacing) / pair.spacing).powi(2);
                edges.push([i, j]);
            }
        }
    }
    edges.sort_unstable();
    assert_eq!(net.edges(), edges);
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()), "{a} is not {b}");
    near(structural_potential(q, &net, pair), v);
    near(realisation_error(q, &net, pair.spacing), worst);
    near(
        deviation_energy(q, &net, pair.spacing),
        deviation / (2 * edges.len() + 1) as f64,
    );
    let center = p.iter().sum::<Vector<D>>() / n as f64;
    let kinetic: f64 = p.iter().map(|p| 0.5 * (p - center).norm_squared()).sum();
    near(structural_energy(q, p, &net, pair), v + kinetic);

    // The gradient by central differences of the dense potential on the fixed net.
    let potential = |q: &[Vector<D>]| -> f64 {
        let of = |&[i, j]: &[usize; 2]| {
            let d = (q[j] - q[i]).norm();
            weight(d) * pair.action.potential(d - pair.spacing)
        };
        edges.iter().map(of).sum()
    };
    let gradient = potential_gradient(q, &net, pair);
    let mut squares = 0.0;
    for i in 0..n {
        for axis in 0..D {
            let h = 1e-6;
            let shifted = |by: f64| {
                let mut q = q.to_vec();
                q[i][axis] += by;
                potential(&q)
            };
            let numeric = (shifted(h) - shifted(-h)) / (2.0 * h);
            assert!(
                (gradient[i][axis] - numeric).abs() < 1e-5,
                "agent {i}, axis {axis}"
            );
        }
        squares += gradient[i].norm_squared();
    }
    near(defect(q, &net, pair, 0.7), v + 0.7 * squares);
    let scale = edges.len() as f64 * link_energy(pair);
    let normalised = (!edges.is_empty()).then(|| (v + 0.7 * squares) / scale);
    assert_eq!(
        normalised_defect(q, &net, pair, 0.7).is_some(),
        normalised.is_some()
    );
    near(
        normalised_defect(q, &net, pair, 0.7).unwrap_or(0.0),
        normalised.unwrap_or(0.0),
    );

    let mut bars = DMatrix::zeros(edges.len(), D * n);
    for (row, &[i, j]) in edges.iter().enumerate() {
        for axis in 0..D {
            bars[(row, D * i + axis)] = q[i][axis] - q[j][axis];
            bars[(row, D * j + axis)] = q[j][axis] - q[i][axis];
        }
    }
    let full = if n < D {
        n * (n - 1) / 2
    } else {
        D * n - D * (D + 1) / 2
    };
    let found = Rigidity::new(q, &net);
    assert_eq!((found.rank, found.full), (rank(bars), full));
    assert_eq!(found.is_rigid(), found.freedoms() == 0);
}

pub fn check_votes<const D: usize>(q: &[Vector<D>], pair: &AlphaPair) {
    let found = votes(q, &neighborhood::uniform(q, pair.range), pair);
    for i in 0..q.len() {
        let w: Vec<f64> = (0..q.len())
            .map(|j| {
                let d = (q[j] - q[i]).norm();
                let seen = j != i && d <= pair.range;
                if seen {
                    pair.action.force(d - pair.spacing) / d
                } else {
                    0.0
                }
            })
            .collect();
        let sum = |keep: &dyn Fn(f64) -> bool| -> (f64, Vector<D>) {
            let kept = || w.iter().zip(q).filter(|(w, _)| keep(**w));
            let total: f64 = kept().map(|(w, _)| w).sum();
            (total, kept().map(|(w, q)| q * *w).sum())
        };
        let (all, plus, minus) = (sum(&|_| true), sum(&|w| w > 0.0), sum(&|w| w < 0.0));
        let vote = &found[i];
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()));
        near(vote.total, all.0);
        near(vote.positive, plus.0);
        near(vote.negative, minus.0);
        // (39) in its second form.
        let u = all.1 - q[i] * all.0;
        assert!((vote.acceleration - u).norm() < 1e-8 * (1.0 + plus.0 - minus.0));
        let same = |place: Option<Vector<D>>, (s, moment): (f64, Vector<D>)| {
            assert_eq!(place.is_some(), s != 0.0);
            if let Some(place) = place {
                assert!((place * s - moment).norm() < 1e-8 * (1.0 + plus.0 - minus.0));
            }
        };
        same(vote.positive_average, plus);
        same(vote.negative_average, minus);
        match vote.verdict() {
            // (41), (42)
            Verdict::Positive | Verdict::Negative => {
                assert_eq!(vote.verdict() == Verdict::Positive, all.0 > 0.0);
                let place = vote.average.expect("votes do not cancel");
                let moved = (place - q[i]) * vote.total;
                assert!((moved - u).norm() < 1e-8 * (1.0 + plus.0 - minus.0));
            }
            // (44), or nobody votes.
            Verdict::Zero => {
                let along = match (vote.positive_average, vote.negative_average) {
                    (Some(plus), Some(minus)) => (plus - minus) * vote.positive,
                    _ => Vector::zeros(),
                };
                assert!((along - u).norm() < 1e-8);
            }
        }
    }
}
