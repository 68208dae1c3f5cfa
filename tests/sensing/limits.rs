//! Radii, fields of view and cones against their definitions.

use serde_json::json;
use volary::math::{Bump, Vector};
use volary::shape::{Geometry, In};

use crate::common::{headings, state};
use crate::scene::{Dice, Watch, pairs, who, world};

fn limits_equal_their_definitions<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let mut dice = Dice(70 + D as u64);
    let radii: Vec<f64> = (0..20).map(|_| dice.between(1.0, 6.0)).collect();
    let world = world::<D>(
        &[
            (
                20,
                json!({ "radius": radii, "field_of_view": { "angle": 1.9 } }),
            ),
            (20, json!({ "radius": 4, "cone": { "angle": 1.2 } })),
            (
                20,
                json!({ "cone": { "angle": 1.5, "smooth": true, "bump_start": 0.3 } }),
            ),
            (20, serde_json::Value::Null),
        ],
        json!({}),
    );
    let (n, range) = (world.agents.len(), 5.0f64);
    let at = dice.vectors::<D>(n, 0.0, 9.0);
    let v = dice.vectors::<D>(n, -1.0, 1.0);
    let u = headings(&v);
    let angle = |a: &Vector<D>, b: &Vector<D>| (a.dot(b) / a.norm() / b.norm()).acos();
    let sees = |i: usize, j: usize| {
        let way = at[j] - at[i];
        let reach = match i {
            0..20 => radii[i],
            20..40 => 4.0,
            _ => f64::INFINITY,
        };
        way.norm() <= range.min(reach)
            && match i {
                0..20 => angle(&u[i], &way) <= 1.9,
                20..40 => angle(&u[i], &u[j]) <= 1.2,
                40..60 => angle(&u[i], &u[j]) <= 1.5,
                _ => true,
            }
    };
    let expected = pairs(n, sees);
    let mut watch = Watch::new(&world, range);
    let told = watch.look(&state(&world, 0.0, &at, &v, &u));
    assert_eq!(who(&told), expected);
    assert_eq!(
        watch.flock.links(&state(&world, 0.0, &at, &v, &u)),
        expected
    );
    // Each kind of limit leaves some and takes some, and makes the net directed.
    for group in 0..4 {
        let first = 20 * group;
        let of_group = |&&[i, _]: &&[usize; 2]| (first..first + 20).contains(&i);
        let near = pairs(n, |i, j| (at[j] - at[i]).norm() <= range);
        let (kept, all) = (
            expected.iter().filter(of_group).count(),
            near.iter().filter(of_group).count(),
        );
        assert!(
            kept > 10 && (kept < all) == (group < 3),
            "{group}: {kept} of {all}"
        );
    }
    assert!(expected.iter().any(|&[i, j]| !expected.contains(&[j, i])));
    let bump = Bump::new(0.3);
    let mut partial = 0;
    for (i, j, neighbour) in told {
        assert_eq!(neighbour.offset, at[j] - at[i]);
        assert_eq!(neighbour.squared, (at[j] - at[i]).norm_squared());
        assert_eq!((neighbour.velocity, neighbour.heading), (v[j], u[j]));
        let weight = match i {
            40..60 => bump.value(angle(&u[i], &u[j]) / 1.5),
            _ => 1.0,
        };
        assert!((neighbour.weight - weight).abs() < 1e-7);
        partial += usize::from(weight < 1.0);
    }
    assert!(partial > 5, "{partial}");
}

#[test]
fn radii_fields_of_view_and_cones_are_as_defined() {
    limits_equal_their_definitions::<2>();
    limits_equal_their_definitions::<3>();
}

#[test]
fn a_law_is_weighted_by_the_cone() {
    // Two agents with headings 1 apart, one with a smooth cone: its share is ρ times that of
    // the other, and opposite.
    for protocol in [
        "nonsmooth",
        "smooth",
        "smooth_weighted_damping",
        "approximate",
    ] {
        let cone = json!({ "cone": { "angle": 1.25, "smooth": true, "bump_start": 0.5 } });
        let laws = json!({ "laws": [{ "alpha_interaction": {
            "protocol": protocol, "spacing": 2, "range": 3
        } }] });
        let world = world::<2>(&[(1, cone), (1, serde_json::Value::Null)], laws);
        let at = [[0.0, 0.0], [2.7, 0.3]].map(Vector::<2>::from);
        let v = [
            Vector::<2>::new(1.0, 0.0),
            Vector::<2>::new(1f64.cos(), 1f64.sin()),
        ];
        let mut out = [Vector::<2>::zeros(); 2];
        let mut flock = volary::law::Flock::of_world(&world, Vec::new());
        flock.accelerations(&state(&world, 0.0, &at, &v, &v), &mut out);
        let share = Bump::new(0.5).value(1.0 / 1.25);
        assert!(out[1].norm() > 0.1);
        assert!((out[0] + out[1] * share).norm() < 1e-13, "{protocol}");
    }
}
