//! Drag and thrust, against plain loops.

use serde_json::json;
use volary::math::Vector;
use volary::shape::{Geometry, In};

use crate::{Crowd, assert_same};

fn follow_the_print<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let crowd = Crowd::<D>::new(5, 31);
    let each = [0.4, 0.0, 0.9, 0.1, 2.0];
    for exponent in [0.0, 1.0, 1.7, 2.0] {
        let friction = |i: usize, c: f64| crowd.v[i] * (-c * crowd.v[i].norm().powf(exponent));
        let all = |of: &dyn Fn(usize) -> Vector<D>| (0..5).map(of).collect::<Vec<_>>();
        let what = format!("exponent {exponent}");
        let law = json!({ "coefficient": each, "exponent": exponent });
        let expected = all(&|i| friction(i, each[i]));
        assert_same(&crowd.under(json!([{ "friction": law }])), &expected, &what);
        let back: Vec<_> = expected.iter().map(|one| -one).collect();
        let found = crowd.under(json!([{ "friction_compensation": law }]));
        assert_same(&found, &back, &what);
        let found = crowd.under(json!([{ "friction": {
            "coefficient": 0.7, "exponent": exponent, "acts_as": "force"
        } }]));
        assert_same(&found, &all(&|i| friction(i, 0.7) / crowd.mass[i]), &what);
        // With the true coefficients, the two are nothing.
        let none = crowd.under(json!([{ "friction": law }, { "friction_compensation": law }]));
        assert!(none.iter().all(|one| *one == Vector::<D>::zeros()));
    }
    for (acts_as, over_mass) in [("acceleration", false), ("force", true)] {
        let found = crowd.under(json!([{ "self_propulsion": {
            "propulsion": 1.5, "drag": 0.5, "acts_as": acts_as
        } }]));
        let thrust = |i: usize| {
            let v = crowd.v[i];
            let mass = if over_mass { crowd.mass[i] } else { 1.0 };
            (v * 1.5 - v * (0.5 * v.norm().powi(2))) / mass
        };
        assert_same(&found, &(0..5).map(thrust).collect::<Vec<_>>(), acts_as);
    }
}

#[test]
fn drag_and_thrust_are_as_the_papers_print() {
    follow_the_print::<2>();
    follow_the_print::<3>();
}

#[test]
fn coefficients_are_those_of_the_agents_in_the_scope() {
    let crowd = Crowd::<2>::new(6, 2);
    let found = crowd.in_groups(
        &[2, 2, 2],
        json!([{ "scope": {
        "agents": ["0", "2"], "laws": [{ "friction": { "coefficient": [1, 2, 3, 4] } }]
    } }]),
    );
    let c = [1.0, 2.0, 0.0, 0.0, 3.0, 4.0];
    let expected: Vec<_> = (0..6).map(|i| crowd.v[i] * -c[i]).collect();
    assert_same(&found, &expected, "scope");
}

#[test]
fn agents_at_rest_stay_there() {
    let mut crowd = Crowd::<3>::new(2, 2);
    crowd.v = vec![Vector::zeros(); 2];
    let laws = json!([
        { "friction": { "coefficient": 1 } },
        { "friction": { "coefficient": 1, "exponent": 2.5 } },
        { "self_propulsion": { "propulsion": 1, "drag": 1 } }
    ]);
    assert_eq!(crowd.under(laws), crowd.v);
}
