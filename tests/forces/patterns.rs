//! Patterns, against plain loops.

use serde_json::json;
use volary::math::Vector;
use volary::shape::{Geometry, In};

use crate::{Crowd, assert_same, plain_mean};

/// w_i of (14), with l a unit vector.
fn line<const D: usize>(y: Vector<D>, l: &Vector<D>) -> Vector<D> {
    l * y.dot(l) - y
}

/// w_i of (15).
fn ball<const D: usize>(y: Vector<D>, radius: f64) -> Vector<D> {
    -y * (1.0 - radius / y.norm())
}

fn follow_the_print<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let crowd = Crowd::<D>::new(11, 17);
    let mean = plain_mean(&crowd.at);
    let mut l = Vector::<D>::repeat(1.0);
    l[0] = -2.0;
    // A direction may have any length.
    let long = (l * 7.0).as_slice().to_vec();
    l /= l.norm();
    let ways: Vec<_> = crowd.at.iter().map(|x| line(x - mean, &l)).collect();
    let found = crowd.under(json!([{ "line_pattern": { "direction": &long, "strength": 0.6 } }]));
    let expected: Vec<_> = ways.iter().map(|w| w * 0.6).collect();
    assert_same(&found, &expected, "(4)");
    assert!(found.iter().sum::<Vector<D>>().norm() < 1e-13, "momentum");

    let found =
        crowd.under(json!([{ "line_pattern": { "direction": &long, "normalised": true } }]));
    let sum: f64 = ways.iter().map(|w| w.norm()).sum();
    let expected: Vec<_> = ways.iter().map(|w| w / (1.0 + sum)).collect();
    assert_same(&found, &expected, "(14)");

    let ways: Vec<_> = crowd.at.iter().map(|x| ball(x - mean, 2.2)).collect();
    let found = crowd.under(json!([{ "ball_pattern": { "radius": 2.2 } }]));
    let sum: f64 = ways.iter().map(|w| w.norm()).sum();
    let expected: Vec<_> = ways.iter().map(|w| w / (1.0 + sum)).collect();
    assert_same(&found, &expected, "(15)");

    let found = crowd.under(json!([{ "ball_pattern": {
        "radius": 2.2, "strength": 3, "normalised": false
    } }]));
    let expected: Vec<_> = ways.iter().map(|w| w * 3.0).collect();
    assert_same(&found, &expected, "(15), not normalised");
}

#[test]
fn patterns_pull_as_the_paper_prints() {
    follow_the_print::<2>();
    follow_the_print::<3>();
}

#[test]
fn a_pattern_in_a_scope_is_that_of_its_agents_alone() {
    let crowd = Crowd::<3>::new(10, 23);
    let laws = |agents: serde_json::Value| {
        json!([{ "scope": { "agents": agents, "laws": [
            { "line_pattern": { "direction": [1, 2, 0], "normalised": true } },
            { "ball_pattern": { "radius": 1.1 } }
        ] } }])
    };
    let found = crowd.in_groups(&[3, 4, 3], laws(json!(["0", "2"])));
    let alone = |of: &[usize]| Crowd {
        at: of.iter().map(|&i| crowd.at[i]).collect(),
        v: of.iter().map(|&i| crowd.v[i]).collect(),
        mass: of.iter().map(|&i| crowd.mass[i]).collect(),
    };
    let inside = [0, 1, 2, 7, 8, 9];
    let part = alone(&inside);
    let expected = part.in_groups(&[6], laws(json!(["0"])));
    let acting: Vec<_> = inside.iter().map(|&i| found[i]).collect();
    assert_same(&acting, &expected, "the scope's agents");
    assert!(found[3..7].iter().all(|one| *one == Vector::<3>::zeros()));
}

#[test]
fn an_agent_at_the_centre_of_a_ball_gets_no_force() {
    let crowd = Crowd {
        at: [[0.0, 0.0], [4.0, 0.0], [-4.0, 0.0]]
            .map(Vector::<2>::from)
            .to_vec(),
        v: vec![Vector::zeros(); 3],
        mass: vec![1.0; 3],
    };
    let found = crowd.under(json!([{ "ball_pattern": { "radius": 3 } }]));
    // Nor does it count in the sum: the others have |w| = 1 each.
    let inward = Vector::<2>::new(-1.0 / 3.0, 0.0);
    assert_eq!(found, [Vector::zeros(), inward, -inward]);
}
