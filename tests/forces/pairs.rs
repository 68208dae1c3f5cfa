//! Forces between pairs, against plain loops.

use proptest::prelude::*;
use serde_json::{Value, json};
use volary::law::{CuckerDong, FirstOrderFlow, PairPotential};
use volary::math::{Potential, Vector};
use volary::shape::{Geometry, In};
use volary::world::spec::{ActsAs, Share};

use crate::common::from_json;
use crate::{Crowd, assert_same};

/// One of each potential.
pub fn potentials() -> Vec<Value> {
    vec![
        json!({ "bond": { "stiffness": 0.3, "length": 1.5 } }),
        json!({ "attraction": { "stiffness": 0.4 } }),
        json!({ "gaussian": { "height": 4, "decay": 0.7 } }),
        json!({ "logarithmic": { "attraction": 0.5, "repulsion": 2.5 } }),
        json!({ "gazi_passino": { "attraction": 0.2, "repulsion": 3, "squared_length": 1.3 } }),
        json!({ "morse": {
            "attraction": 0.5, "attraction_length": 3, "repulsion": 1, "repulsion_length": 0.5
        } }),
    ]
}

/// −∇_i V of the pair i, j as the papers print it, for the potentials above.
fn printed<const D: usize>(which: usize, xi: &Vector<D>, xj: &Vector<D>) -> Vector<D> {
    let r = (xi - xj).norm();
    match which {
        // Song et al. (8), second sum.
        0 => (xj - xi) * (0.3 * (r - 1.5) / r),
        // (17), second sum, without 1/N.
        1 => (xj - xi) * 0.4,
        // Of (5): g_r = 2μQ exp(−μr²).
        2 => (xi - xj) * (2.0 * 0.7 * 4.0 * (-0.7 * r.powi(2)).exp()),
        // Shi, Wang & Chu: V' = 2a/r − 2b/r³.
        3 => -(xi - xj) / r * (2.0 * 0.5 / r - 2.0 * 2.5 / r.powi(3)),
        // Song et al. (16).
        4 => (xi - xj) * -0.2 + (xi - xj) * (3.0 * (-r.powi(2) / 1.3).exp()),
        // D'Orsogna et al. (2).
        _ => (xi - xj) / r * (1.0 / 0.5 * (-r / 0.5).exp() - 0.5 / 3.0 * (-r / 3.0).exp()),
    }
}

fn potentials_follow_the_print<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let crowd = Crowd::<D>::new(9, 4);
    for (which, potential) in potentials().into_iter().enumerate() {
        let force =
            |i: usize| crowd.sum_over_others(i, |j| printed(which, &crowd.at[i], &crowd.at[j]));
        let law = |share: &str, acts_as: &str| {
            crowd.under(json!([{ "pair_potential": {
                "potential": &potential, "share": share, "acts_as": acts_as
            } }]))
        };
        let all = |of: &dyn Fn(usize) -> Vector<D>| (0..9).map(of).collect::<Vec<_>>();
        let what = potential.to_string();
        assert_same(&law("sum", "acceleration"), &all(&force), &what);
        let over_mass = all(&|i| force(i) / crowd.mass[i]);
        assert_same(&law("sum", "force"), &over_mass, &what);
        assert_same(
            &law("mean", "acceleration"),
            &all(&|i| force(i) / 9.0),
            &what,
        );
        let flow = crowd.under(json!([{ "first_order_flow": {
            "potential": &potential, "rate": 2.5, "share": "mean"
        } }]));
        let steered = all(&|i| (force(i) / 9.0 - crowd.v[i]) * 2.5);
        assert_same(&flow, &steered, &what);
    }
}

#[test]
fn potentials_push_as_the_papers_print() {
    potentials_follow_the_print::<2>();
    potentials_follow_the_print::<3>();
}

#[test]
fn a_range_cuts_the_pairs_beyond_it() {
    let crowd = Crowd::<3>::new(30, 7);
    let found = crowd.under(json!([{ "pair_potential": {
        "potential": &potentials()[0], "range": 2.5
    } }]));
    let expected: Vec<_> = (0..30)
        .map(|i| {
            crowd.sum_over_others(i, |j| match (crowd.at[i] - crowd.at[j]).norm() <= 2.5 {
                true => printed(0, &crowd.at[i], &crowd.at[j]),
                false => Vector::zeros(),
            })
        })
        .collect();
    assert_same(&found, &expected, "range");
}

fn is_the_gradient<const D: usize>(seed: u64)
where
    In<D>: Geometry<D>,
{
    let crowd = Crowd::<D>::new(6, seed);
    for json in potentials() {
        let potential: Potential = from_json(json.clone());
        let accelerations = crowd.under(json!([{ "pair_potential": {
            "potential": json, "acts_as": "force"
        } }]));
        let energy = |at: &[Vector<D>]| {
            let pairs = (0..6).flat_map(|i| (0..i).map(move |j| (i, j)));
            let value = |(i, j): (usize, usize)| potential.value((at[i] - at[j]).norm());
            pairs.map(value).sum::<f64>()
        };
        let h = 1e-5;
        for i in 0..6 {
            for axis in 0..D {
                let moved = |by: f64| {
                    let mut at = crowd.at.clone();
                    at[i][axis] += by;
                    energy(&at)
                };
                let numeric = -(moved(h) - moved(-h)) / (2.0 * h);
                let force = accelerations[i][axis] * crowd.mass[i];
                // The error goes with the third derivative, which a close pair makes large.
                let bound = 1e-5 * force.abs().max(1.0);
                assert!(
                    (numeric - force).abs() < bound,
                    "{potential:?}: {numeric} {force}"
                );
            }
        }
        let sum: Vector<D> = (0..6).map(|i| accelerations[i] * crowd.mass[i]).sum();
        let size: f64 = (0..6)
            .map(|i| accelerations[i].norm() * crowd.mass[i])
            .sum();
        assert!(
            size > 1e-3 && sum.norm() < 1e-13 * size,
            "{potential:?}: momentum"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn forces_are_the_gradient_of_the_potential_and_keep_the_momentum(seed in any::<u64>()) {
        is_the_gradient::<2>(seed);
        is_the_gradient::<3>(seed);
    }
}

#[test]
fn one_s_own_functions_are_as_good_as_the_file_s() {
    let crowd = Crowd::<2>::new(12, 3);
    let potential = potentials().swap_remove(4);
    let known: Potential = from_json(potential.clone());
    let f = move |squared: f64| known.force_over_distance(squared);
    let file = crowd.under(json!([{ "pair_potential": {
        "potential": potential, "share": "mean", "acts_as": "force", "range": 4
    } }]));
    let own = PairPotential::from_function(f, Share::Mean, ActsAs::Force, Some(4.0));
    assert_eq!(crowd.under_law(own), file);
    let file = crowd.under(json!([{ "first_order_flow": { "potential": potential, "rate": 3 } }]));
    let own = FirstOrderFlow::from_function(f, Share::Sum, 3.0, None);
    assert_eq!(crowd.under_law(own), file);
    let file = crowd.under(json!([{ "cucker_dong": { "squared_distance": 0.01, "floor": 0.2 } }]));
    let own = |s: f64| 1.0 / libm::pow((s - 0.01).max(0.2), 2.0);
    let own = CuckerDong::from_function(own, ActsAs::Acceleration, None);
    assert_eq!(crowd.under_law(own), file);
}

/// Λ(v) of (3), as printed.
fn disagreement<const D: usize>(v: &[Vector<D>]) -> f64 {
    let mut sum = 0.0;
    for (i, vi) in v.iter().enumerate() {
        for vj in &v[i + 1..] {
            sum += (vi - vj).norm().powi(2);
        }
    }
    (sum / v.len() as f64).sqrt()
}

fn cucker_dong_follows_the_print<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let crowd = Crowd::<D>::new(10, 11);
    let d0 = 0.05;
    let f = |s: f64| 0.7 / (s - d0).powf(1.5);
    let factor = disagreement(&crowd.v);
    let force = |i: usize| {
        crowd.sum_over_others(i, |j| {
            let way = crowd.at[i] - crowd.at[j];
            assert!(way.norm_squared() > d0 + 1e-6);
            way * (factor * f(way.norm().powi(2)))
        })
    };
    let law = |acts_as: &str| {
        crowd.under(json!([{ "cucker_dong": {
            "strength": 0.7, "exponent": 1.5, "squared_distance": d0, "acts_as": acts_as
        } }]))
    };
    let expected: Vec<_> = (0..10).map(force).collect();
    assert_same(&law("acceleration"), &expected, "Cucker & Dong");
    let expected: Vec<_> = (0..10).map(|i| force(i) / crowd.mass[i]).collect();
    assert_same(&law("force"), &expected, "Cucker & Dong, as a force");
}

#[test]
fn cucker_dong_follows_equation_3() {
    cucker_dong_follows_the_print::<2>();
    cucker_dong_follows_the_print::<3>();
}

#[test]
fn a_scope_s_disagreement_is_that_of_the_agents_seen() {
    // Group 0 is pushed by group 1, whose velocities alone disagree by 2 over √2.
    let crowd = Crowd {
        at: [[0.0, 0.0], [2.0, 0.0], [0.0, 3.0]]
            .map(Vector::<2>::from)
            .to_vec(),
        v: [[9.0, -4.0], [1.0, 0.0], [-1.0, 0.0]]
            .map(Vector::<2>::from)
            .to_vec(),
        mass: vec![1.0; 3],
    };
    let law = json!({ "cucker_dong": { "squared_distance": 1, "exponent": 3 } });
    let found = crowd.in_groups(
        &[1, 2],
        json!([{ "scope": {
        "agents": ["0"], "neighbours": ["1"], "laws": [law]
    } }]),
    );
    let pushed = Vector::<2>::new(-2.0 / 27.0, -3.0 / 512.0) * 2.0f64.sqrt();
    assert!((found[0] - pushed).norm() < 1e-15, "{}", found[0]);
    assert_eq!(found[1..], [Vector::<2>::zeros(); 2]);
}

#[test]
fn bodies_pushed_inside_the_distance_of_cucker_dong_get_a_finite_push_out() {
    for distance in [0.0, 1e-200, 0.3, 0.999_999_999, 1.0, 1.000_000_001] {
        let crowd = Crowd {
            at: vec![Vector::<2>::zeros(), Vector::<2>::new(distance, 0.0)],
            v: vec![Vector::zeros(), Vector::<2>::new(-1.0, 0.0)],
            mass: vec![1.0; 2],
        };
        let found = crowd.under(json!([{ "cucker_dong": { "squared_distance": 1 } }]));
        let push = found[1][0];
        assert!(
            push.is_finite() && (push > 0.0 || distance * distance == 0.0),
            "{distance}: {push}"
        );
        assert_eq!(found[0], -found[1]);
    }
}

fn park_follows_the_print<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let crowd = Crowd::<D>::new(8, 21);
    let (sigma, k1, k2, radius) = (1.3, 0.8, 0.6, 0.9);
    let force = |i: usize| {
        let sum = crowd.sum_over_others(i, |j| {
            let (x, v) = (crowd.at[i] - crowd.at[j], crowd.v[i] - crowd.v[j]);
            let r = x.norm();
            -x * (k1 / (2.0 * r.powi(2)) * v.dot(&x)) - x * (k2 / (2.0 * r) * (r - 2.0 * radius))
        });
        sum * (sigma / 8.0)
    };
    let law = |acts_as: &str| {
        crowd.under(json!([{ "park_bonding": {
            "strength": sigma, "velocity_gain": k1, "position_gain": k2, "radius": radius,
            "acts_as": acts_as
        } }]))
    };
    let expected: Vec<_> = (0..8).map(force).collect();
    let found = law("acceleration");
    assert_same(&found, &expected, "Park et al.");
    let sum: Vector<D> = found.iter().sum();
    assert!(sum.norm() < 1e-14, "momentum");
    let expected: Vec<_> = (0..8).map(|i| force(i) / crowd.mass[i]).collect();
    assert_same(&law("force"), &expected, "Park et al., as a force");
}

#[test]
fn park_bonding_follows_equation_7() {
    park_follows_the_print::<2>();
    park_follows_the_print::<3>();
}

#[test]
fn agents_at_the_same_point_exert_no_force() {
    let mut crowd = Crowd::<3>::new(2, 5);
    crowd.at = vec![Vector::repeat(1.0); 2];
    let zero = vec![Vector::<3>::zeros(); 2];
    for potential in potentials() {
        let laws = json!([{ "pair_potential": { "potential": potential } }]);
        assert_eq!(crowd.under(laws), zero);
    }
    let bond = json!({ "velocity_gain": 1, "position_gain": 1, "radius": 1 });
    assert_eq!(crowd.under(json!([{ "park_bonding": bond }])), zero);
}
