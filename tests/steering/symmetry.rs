//! Moved, mirrored or relabelled as a whole, a world accelerates as it did, moved alike.

use proptest::prelude::*;
use serde_json::{Value, json};
use volary::math::Vector;
use volary::shape::{Geometry, In};
use volary::world::World;

use crate::common::{accelerations, from_json, world};

const AGENTS: usize = 5;

/// How a world is moved: places are mapped, directions too, without the shift.
#[derive(Clone, Copy)]
struct Moved<const D: usize> {
    shift: Vector<D>,
    /// The plane of two axes in which everything turns, and by how much.
    angle: f64,
    mirror: bool,
}

impl<const D: usize> Moved<D> {
    fn direction(&self, x: &Vector<D>) -> Vector<D> {
        let (sin, cos) = self.angle.sin_cos();
        let (first, last) = (0, D - 1);
        let mut turned = *x;
        turned[first] = cos * x[first] - sin * x[last];
        turned[last] = sin * x[first] + cos * x[last];
        if self.mirror {
            turned[1] = -turned[1];
        }
        turned
    }

    fn place(&self, x: &Vector<D>) -> Vector<D> {
        self.direction(x) + self.shift
    }
}

/// Five agents with a target each, one of every kind that can be moved whole, that steer by
/// tracking and by flatness against two other laws. Agent i of the world is agent
/// `order[i]` of the plain one.
fn five<const D: usize>(moved: &Moved<D>, order: &[usize; AGENTS]) -> World<D>
where
    In<D>: Geometry<D>,
{
    let raw = |k: usize| Vector::<D>::from_fn(|row, _| ((7 * k + 3 * row) as f64).sin() * 4.0);
    let place = |k: usize| json!(moved.place(&raw(k)).as_slice());
    let direction = |k: usize| json!(moved.direction(&raw(k)).as_slice());
    let targets = [
        json!({ "line": { "start": place(10), "velocity": direction(11) } }),
        json!({ "ellipse": {
            "center": place(12), "first": direction(13), "second": direction(14),
            "angular_velocity": 0.6, "phase": 1
        } }),
        json!({ "spline": { "times": [0, 1, 2.5], "points": [place(15), place(16), place(17)] } }),
        json!({ "spline": {
            "times": [0, 1, 2.5, 3], "points": [place(15), place(16), place(17), place(15)],
            "periodic": true
        } }),
        json!({ "sum": [
            { "line": { "start": place(18) } },
            { "ellipse": {
                "center": vec![0; D], "first": direction(19), "second": direction(20),
                "angular_velocity": 2
            } }
        ] }),
    ];
    let of = |list: &dyn Fn(usize) -> Value| order.map(list);
    let g = moved.direction(&raw(21));
    world(from_json(json!({
        "dimension": D, "time": { "end": 1 },
        "physics": { "gravity": g.as_slice() },
        "agents": [{
            "radius": 0.001, "mass": order.map(|k| 1.0 + k as f64),
            "positions": { "explicit": of(&|k| place(k)) },
            "velocities": { "explicit": of(&|k| direction(k + 30)) }
        }],
        "laws": [
            { "alpha_interaction": { "spacing": 5, "range": 7, "damping": 0.5 } },
            { "tracking": { "targets": of(&|k| targets[k].clone()), "feedforward": true } },
            { "flatness": {
                "trajectories": of(&|k| targets[k].clone()),
                "velocity_gain": 0.3, "position_gain": 0.4
            } }
        ]
    })))
}

fn check<const D: usize>(moved: &Moved<D>, order: &[usize; AGENTS], time: f64)
where
    In<D>: Geometry<D>,
{
    let still = Moved {
        shift: Vector::zeros(),
        angle: 0.0,
        mirror: false,
    };
    let plain = five(&still, &[0, 1, 2, 3, 4]);
    let other = five(moved, order);
    let given = |world: &World<D>| {
        let agents = &world.agents;
        accelerations(world, time, &agents.positions, &agents.velocities)
    };
    let (plain, other) = (given(&plain), given(&other));
    for (i, &k) in order.iter().enumerate() {
        let expected = moved.direction(&plain[k]);
        let error = (other[i] - expected).norm();
        assert!(error < 1e-9 * (1.0 + expected.norm()), "agent {i}: {error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn worlds_move_as_a_whole(
        shift in prop::array::uniform3(-20.0..20.0_f64),
        angle in -3.2..3.2_f64,
        mirror: bool,
        order in Just([0_usize, 1, 2, 3, 4]).prop_shuffle(),
        time in 0.0..4.0_f64,
    ) {
        let in_plane = Moved { shift: Vector::<2>::new(shift[0], shift[1]), angle, mirror };
        check(&in_plane, &order, time);
        check(&Moved { shift: Vector::<3>::from(shift), angle, mirror }, &order, time);
    }
}
