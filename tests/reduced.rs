//! The reduced model of fast flocking, against plain loops and full integrations of what it
//! reduces.

mod common;

use common::{from_json, world};
use nalgebra::DMatrix;
use serde_json::{Value, json};
use volary::math::{DormandPrince, Solution, Vector};
use volary::reduced::{FastFlocking, Leading, NoReduction, stationary};
use volary::shape::{Geometry, In};
use volary::world::World;

/// Djokam & Rathinam, section 5: where the agents start, and how fast.
const POSITIONS: [[f64; 2]; 7] = [
    [6.8897, 7.1568],
    [1.6819, 4.4079],
    [4.0103, 5.8168],
    [6.3834, 6.7922],
    [2.4842, 6.1173],
    [5.8959, 1.4635],
    [1.0710, 4.4853],
];
const VELOCITIES: [[f64; 2]; 7] = [
    [2.8792, 1.0212],
    [1.7558, 0.6714],
    [2.2538, 0.7653],
    [1.5179, 2.0972],
    [2.6727, 2.8779],
    [1.6416, 0.4159],
    [0.4479, 0.7725],
];

/// The paper's example, with a gain, at some ε.
fn example<const D: usize>(epsilon: f64, gain: Value) -> World<D>
where
    In<D>: Geometry<D>,
{
    let lift = |k: usize| (k as f64 * 1.3).sin();
    let vectors = |list: [[f64; 2]; 7], size: f64| -> Vec<Vec<f64>> {
        let vector = |(k, [x, y]): (usize, [f64; 2])| [x, y, lift(k) * size][..D].to_vec();
        list.into_iter().enumerate().map(vector).collect()
    };
    let center = [100.0, 10.0, 5.0];
    world(from_json(json!({
        "dimension": D, "time": { "step": 0.1, "end": 10 }, "record": { "every": 2.5 },
        "agents": [{
            "radius": 0.01,
            "positions": { "explicit": vectors(POSITIONS, 2.0) },
            "velocities": { "explicit": vectors(VELOCITIES, 1.0) }
        }],
        "laws": [
            { "alignment": {
                "kernel": { "cucker_smale": { "strength": 1, "length": 1, "exponent": 0.3 } },
                "normalisation": "motsch_tadmor", "self_influence": true, "gain": gain,
                "epsilon": epsilon
            } },
            { "tracking": {
                "target": { "circle": {
                    "center": center[..D], "radius": 10, "angular_velocity": -0.1,
                    "phase": std::f64::consts::FRAC_PI_2
                } },
                "velocity_gain": 2, "position_gain": 0.1
            } }
        ]
    })))
}

fn bounded() -> Value {
    json!({ "bounded": { "bound": 10, "scale": 0.1_f64.sqrt() } })
}

fn flock<const D: usize>(world: &World<D>) -> FastFlocking<'_, D> {
    FastFlocking::new(world).expect("a reduced model")
}

/// a_ij of the example, in plain loops.
fn influences<const D: usize>(positions: &[Vector<D>]) -> DMatrix<f64> {
    let n = positions.len();
    let phi = |i: usize, j: usize| {
        let squared = (positions[i] - positions[j]).norm_squared();
        (1.0 + squared).powf(-0.3)
    };
    let sum = |i: usize| -> f64 { (0..n).map(|j| phi(i, j)).sum() };
    DMatrix::from_fn(n, n, |i, j| phi(i, j) / sum(i))
}

/// The full model (4.1) of the example, integrated to 1e-10: positions and velocities at some
/// times.
fn full<const D: usize>(
    world: &World<D>,
    epsilon: f64,
    times: &[f64],
) -> Vec<(Vec<Vector<D>>, Vec<Vector<D>>)> {
    let n = world.agents.len();
    let center = Vector::<D>::from_fn(|k, _| [100.0, 10.0, 5.0][k]);
    let unpack = |state: &[f64]| -> (Vec<Vector<D>>, Vec<Vector<D>>) {
        let mut all: Vec<Vector<D>> = state
            .chunks_exact(D)
            .map(Vector::from_column_slice)
            .collect();
        let velocities = all.split_off(n);
        (all, velocities)
    };
    let slope = |t: f64, state: &[f64], out: &mut [f64]| {
        let (x, v) = unpack(state);
        let a = influences(&x);
        let (sin, cos) = (0.1 * t).sin_cos();
        let (mut y, mut dy) = (center, Vector::<D>::zeros());
        (y[0], y[1]) = (y[0] + 10.0 * sin, y[1] + 10.0 * cos);
        (dy[0], dy[1]) = (cos, -sin);
        for i in 0..n {
            let mean: Vector<D> = (0..n).map(|j| v[j] * a[(i, j)]).sum();
            let u = mean - v[i];
            let pull = u * (10.0 / (0.1 + u.norm_squared()).sqrt() / epsilon);
            let force = pull + (dy - v[i]) * 2.0 + (y - x[i]) * 0.1;
            out[i * D..(i + 1) * D].copy_from_slice(v[i].as_slice());
            out[(n + i) * D..(n + i + 1) * D].copy_from_slice(force.as_slice());
        }
    };
    let agents = &world.agents;
    let start = agents.positions.iter().chain(&agents.velocities);
    let start = start.flat_map(|x| x.as_slice().to_vec()).collect();
    let mut solution = Solution::new(slope, DormandPrince::default(), 0.0, start, 1e-10);
    let mut states = Vec::new();
    for &time in times {
        solution.advance_to(time).expect("a solution");
        states.push(unpack(solution.state()));
    }
    states
}

#[test]
fn the_example_starts_where_the_layer_ends_and_not_where_the_print_says() {
    for epsilon in [0.1, 0.001] {
        let world = example::<2>(epsilon, bounded());
        let reduced = flock(&world);
        let error = (reduced.printed - Vector::<2>::new(1.885573, 1.257293)).amax();
        assert!(error < 1e-6, "{:?}", reduced.printed);
        let error = (reduced.start - Vector::<2>::new(1.870466, 1.423655)).amax();
        assert!(error < 1e-6, "{:?}", reduced.start);
    }
}

fn matrices_are_the_ones_of_the_paper<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let world = example::<D>(0.5, bounded());
    let reduced = flock(&world);
    let a = influences(&world.agents.positions);
    assert!((&reduced.influences - &a).amax() < 1e-14);
    let alpha = 10.0 / 0.1_f64.sqrt() / 0.5;
    let q = DMatrix::from_fn(7, 7, |i, j| {
        if i == j {
            alpha * (a[(i, i)] - 1.0)
        } else {
            alpha * a[(i, j)]
        }
    });
    assert!((&reduced.rates - &q).amax() < 1e-12);
    for j in 0..7 {
        let flow: f64 = (0..7).map(|i| reduced.weights[i] * q[(i, j)]).sum();
        assert!(flow.abs() < 1e-13, "{flow}");
    }
    assert!((reduced.weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
}

#[test]
fn matrices_are_the_ones_of_the_paper_in_2d_and_3d() {
    matrices_are_the_ones_of_the_paper::<2>();
    matrices_are_the_ones_of_the_paper::<3>();
}

#[test]
fn a_gain_that_does_not_fall_starts_as_printed() {
    let world = example::<2>(1.0, json!([1, 2, 0.5, 3, 1, 0.1, 7]));
    let reduced = flock(&world);
    assert!((reduced.start - reduced.printed).norm() < 1e-10);
    // And not at the plain mean.
    let mean = world.agents.velocities.iter().sum::<Vector<2>>() / 7.0;
    assert!((reduced.start - mean).norm() > 0.01);
}

/// The largest errors of the leading order in positions and velocities.
fn errors<const D: usize>(
    leading: &[Leading<D>],
    full: &[(Vec<Vector<D>>, Vec<Vector<D>>)],
) -> [f64; 2] {
    let mut errors = [0.0_f64; 2];
    for (leading, (positions, velocities)) in leading.iter().zip(full) {
        for (i, (x, v)) in positions.iter().zip(velocities).enumerate() {
            errors[0] = errors[0].max((x - leading.positions[i]).norm());
            errors[1] = errors[1].max((v - leading.velocity).norm());
        }
    }
    errors
}

fn the_leading_order_is_off_by_epsilon<const D: usize>(epsilons: &[f64])
where
    In<D>: Geometry<D>,
{
    let times = [1.0, 2.0, 5.0];
    let mut found = Vec::new();
    for &epsilon in epsilons {
        let world = example::<D>(epsilon, bounded());
        let mut reduced = flock(&world);
        let leading = reduced.leading_order(&times).expect("a leading order");
        let full = full(&world, epsilon, &times);
        found.push(errors(&leading, &full));
        // Started as printed it is off, however small ε is.
        reduced.start = reduced.printed;
        let printed = reduced.leading_order(&times).expect("a leading order");
        assert!(errors(&printed, &full)[0] > 0.05);
    }
    for pair in found.windows(2) {
        for (coarse, fine) in pair[0].iter().zip(pair[1]) {
            assert!((7.0..13.0).contains(&(coarse / fine)), "{found:?}");
        }
    }
    assert!(found[0][0] < 1.0 && found[0][1] < 0.2, "{found:?}");
}

#[test]
fn the_leading_order_is_off_by_epsilon_in_2d() {
    the_leading_order_is_off_by_epsilon::<2>(&[0.1, 0.01, 0.001]);
}

#[test]
fn the_leading_order_is_off_by_epsilon_in_3d() {
    the_leading_order_is_off_by_epsilon::<3>(&[0.1, 0.01]);
}

#[test]
fn recorded_times_are_those_of_the_frames() {
    let world = example::<2>(0.1, bounded());
    let course = flock(&world).recorded().expect("a leading order");
    let times: Vec<f64> = course.iter().map(|leading| leading.time).collect();
    assert_eq!(times, [0.0, 2.5, 5.0, 7.5, 10.0]);
    for leading in &course {
        for i in 0..7 {
            let apart = |x: &[Vector<2>]| x[i] - x[0];
            let moved = apart(&leading.positions) - apart(&world.agents.positions);
            assert!(moved.norm() < 1e-12);
        }
    }
}

/// Followers that align with a leader, which no law pulls.
fn led(graph: Value) -> World<2> {
    world(from_json(json!({
        "dimension": 2, "time": { "end": 3 }, "physics": { "gravity": [0, -1] },
        "agents": [
            {
                "name": "leader", "radius": 0.1, "positions": { "explicit": [[0, 0]] },
                "velocities": { "common": [1, 0] }
            },
            {
                "name": "followers", "radius": 0.1, "mass": [1, 2, 3],
                "positions": { "explicit": [[1, 0], [2, 0], [3, 1]] },
                "velocities": { "explicit": [[0, 3], [-1, 0], [0, 0]] }
            }
        ],
        "laws": [
            { "scope": { "agents": ["followers"], "laws": [{ "alignment": {
                "kernel": { "cucker_smale": { "strength": 1, "length": 1, "exponent": 0.3 } },
                "normalisation": "motsch_tadmor", "epsilon": 0.01, "graph": graph
            } }] } },
            { "scope": { "agents": ["leader"], "laws": [
                { "steering": { "acceleration": [{ "sine": {
                    "amplitude": 1, "period": std::f64::consts::TAU
                } }, 3] } }
            ] } },
            { "scope": { "agents": ["followers"], "laws": [
                { "steering": { "acceleration": [50, 50] } }
            ] } }
        ]
    })))
}

#[test]
fn a_leader_that_nobody_influences_leads_alone() {
    let world = led(Value::Null);
    let mut reduced = flock(&world);
    assert_eq!(reduced.weights, [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(reduced.start, Vector::<2>::new(1.0, 0.0));
    let times: Vec<f64> = (0..=6).map(|k| 0.5 * f64::from(k)).collect();
    for leading in reduced.leading_order(&times).expect("a leading order") {
        let t = leading.time;
        let expected = Vector::<2>::new(2.0 - t.cos(), 2.0 * t);
        assert!((leading.velocity - expected).norm() < 1e-9, "{leading:?}");
        let place = Vector::<2>::new(3.0 + 2.0 * t - t.sin(), 1.0 + t * t);
        assert!((leading.positions[3] - place).norm() < 1e-9, "{leading:?}");
    }
}

#[test]
fn what_has_no_reduced_model_is_refused() {
    let refused = |change: &dyn Fn(&mut Value)| {
        let world = example::<2>(0.1, bounded());
        let mut spec = serde_json::to_value(&world.spec).expect("a world");
        change(&mut spec);
        let world: World<2> = common::world(from_json(spec));
        FastFlocking::new(&world).err()
    };
    assert_eq!(refused(&|_| {}), None);
    let none = refused(&|spec| spec["laws"] = json!([]));
    assert_eq!(none, Some(NoReduction::Laws { found: 0 }));
    let two = refused(&|spec| spec["laws"][1] = spec["laws"][0].clone());
    assert_eq!(two, Some(NoReduction::Laws { found: 2 }));
    let flat = json!({ "flatness": { "trajectories": { "mill_ring": {
        "center": [0, 0], "radius": 1, "angular_velocity": 1
    } } } });
    let flat = refused(&|spec| spec["laws"][1] = flat.clone());
    assert_eq!(flat, Some(NoReduction::Flatness));
    for (field, value) in [
        ("delay", json!(0.5)),
        ("dropout", json!(0.1)),
        ("noise", json!({ "velocity": 0.1 })),
    ] {
        let found = refused(&|spec| spec["agents"][0]["sensing"] = json!({ field: value }));
        assert_eq!(found, Some(NoReduction::Perception), "{field}");
    }
    // Of these places the nearest are 0.6 apart, the next ones 1.8.
    let parts = refused(&|spec| spec["laws"][0]["alignment"]["range"] = json!(1));
    assert_eq!(parts, Some(NoReduction::Parts));
}

#[test]
fn chains_of_laws_of_ones_own_are_reduced_as_well() {
    use volary::law::{Law, Link, Pull, Steering};
    use volary::math::Gain;
    use volary::sense::Scene;

    /// Agent i follows agent i + 1, the last one the first, at the rate i + 1.
    struct Ring;
    impl Law<2> for Ring {
        fn name(&self) -> &str {
            "ring"
        }
        fn pull(&self, scene: &Scene<'_, 2>, i: usize, links: &mut Vec<Link<2>>) -> Option<Pull> {
            let agent = scene.agents[i];
            let next = (agent + 1) % scene.agents.len() as u32;
            let index = scene.agents.iter().position(|other| *other == next)?;
            links.push(Link {
                index,
                weight: 1.0,
                velocity: scene.velocities[index],
            });
            let gain = Gain::Constant(f64::from(agent + 1));
            Some(Pull { gain, own: 0.0 })
        }
        fn accelerate(&self, _: &Scene<'_, 2>, _: usize, _: &mut [Vector<2>]) {}
    }

    let world = example::<2>(1.0, bounded());
    let steering = Steering::each((0..7).map(|i| [f64::from(i).into(), 0.0.into()]).collect());
    let mut reduced = FastFlocking::of_laws(&world, vec![Box::new(Ring)], vec![Box::new(steering)])
        .expect("a reduced model");
    // In a ring the flow through each agent is the same: π_i ∝ 1/rate.
    let total: f64 = (1..=7).map(|k| 1.0 / f64::from(k)).sum();
    for (k, weight) in (1..).zip(&reduced.weights) {
        assert!((weight - 1.0 / f64::from(k) / total).abs() < 1e-14);
    }
    assert_eq!(stationary(&reduced.rates), Some(reduced.weights.clone()));
    let expected: Vector<2> = (0..7)
        .map(|i| world.agents.velocities[i] * reduced.weights[i])
        .sum();
    assert!((reduced.start - expected).norm() < 1e-9);
    let pull: f64 = (0..7).map(|i| i as f64 * reduced.weights[i]).sum();
    let last = reduced.leading_order(&[2.0]).expect("a leading order");
    let change = last[0].velocity - reduced.start;
    assert!((change - Vector::<2>::new(2.0 * pull, 0.0)).norm() < 1e-9);
}
