//! α-nets, whose laws jump as links come and go, agree with integrations that hold the links
//! until they change.

use serde_json::{Value, json};
use volary::world::World;

use crate::common::{spec, world};
use crate::reference::{difference_from, flat, integrate_linked, points, run_to};

const SPACING: f64 = 1.0;
const RANGE: f64 = 1.2;

/// Eight agents that come together, under some protocol.
pub fn net(protocol: &str) -> World<2> {
    world(spec(json!({
        "dimension": 2,
        "time": { "step": 0.1, "end": 50 },
        "record": { "every": 1 },
        "agents": [{
            "radius": 0.01,
            "positions": { "explicit": places() },
            "velocities": { "explicit": velocities() }
        }],
        "laws": [{ "alpha_interaction": {
            "protocol": protocol, "spacing": SPACING, "range": RANGE, "damping": 0.8,
            "action": { "attraction": 1, "repulsion": 3 }, "bump_start": 0.5
        } }]
    })))
}

/// Eight agents that come together from all sides.
fn places() -> Value {
    json!([
        [0, 0],
        [1.5, 0.2],
        [3.1, -0.1],
        [0.4, 1.6],
        [2.0, 1.9],
        [3.4, 1.4],
        [1.1, 3.2],
        [2.7, 3.3]
    ])
}

fn velocities() -> Value {
    json!([
        [0.3, 0.2],
        [0.1, 0.35],
        [-0.3, 0.2],
        [0.3, 0.05],
        [-0.1, -0.2],
        [-0.35, 0.0],
        [0.1, -0.3],
        [-0.2, -0.3]
    ])
}

/// Whether each pair is linked.
fn links(y: &[f64]) -> Vec<bool> {
    let n = y.len() / 4;
    let mut links = vec![false; n * n];
    for i in 0..n {
        for j in 0..n {
            let squared = (y[2 * j] - y[2 * i]).powi(2) + (y[2 * j + 1] - y[2 * i + 1]).powi(2);
            links[i * n + j] = i != j && squared <= RANGE * RANGE;
        }
    }
    links
}

/// φ_α and ψ_α for a = 1, b = 3.
fn action(z: f64) -> (f64, f64) {
    let c = 2.0 / (2.0 * 3f64.sqrt());
    let s = z + c;
    let force = 2.0 * s / (1.0 + s * s).sqrt() - 1.0;
    let potential = 2.0 * ((1.0 + s * s).sqrt() - (1.0 + c * c).sqrt()) - z;
    (force, potential)
}

/// The force towards a linked agent, as smooth as it goes on beyond the range.
fn sharp(distance: f64) -> f64 {
    action(distance - SPACING).0
}

fn smooth(distance: f64) -> f64 {
    let (force, potential) = action(distance - SPACING);
    let z = distance / RANGE;
    if z < 0.5 {
        return force;
    }
    let angle = std::f64::consts::PI * (z - 0.5) / 0.5;
    let weight = 0.5 * (1.0 + angle.cos());
    let slope = -0.5 * std::f64::consts::PI / 0.5 * angle.sin();
    weight * force + slope / RANGE * potential
}

fn agrees(protocol: &str, force: fn(f64) -> f64) {
    let world = net(protocol);
    let y = flat(&world.agents.positions, &world.agents.velocities);
    let n = world.agents.len();
    let mut slope = |links: &[bool], y: &[f64], out: &mut [f64]| {
        let half = y.len() / 2;
        out[..half].copy_from_slice(&y[half..]);
        out[half..].fill(0.0);
        for i in 0..n {
            for j in (0..n).filter(|j| links[i * n + j]) {
                let way = [y[2 * j] - y[2 * i], y[2 * j + 1] - y[2 * i + 1]];
                let distance = way[0].hypot(way[1]);
                for k in 0..2 {
                    let turn = y[half + 2 * j + k] - y[half + 2 * i + k];
                    out[half + 2 * i + k] += force(distance) / distance * way[k] + 0.8 * turn;
                }
            }
        }
    };
    let mut simulation = points(world, 1e-11);
    for (time, allowed) in [(10.0, 0.5e-8), (50.0, 0.5e-6)] {
        run_to(&mut simulation, time);
        let (reference, changes) = integrate_linked(&mut slope, links, time, y.clone(), 1e-13);
        let jumps = simulation.solver().expect("points have a solver").jumps;
        let apart = difference_from(&simulation, &reference);
        println!("{protocol} at {time}: {apart:e}, {jumps} jumps, {changes} in the reference");
        assert!(changes > 5, "{protocol}: links change {changes} times only");
        // In the end two agents may push each other to the very range, where rounding rules.
        assert!(
            time > 10.0 || jumps == changes as u64,
            "{protocol}: {jumps} {changes}"
        );
        assert!(apart < allowed, "{protocol} at {time}: {apart:e}");
    }
}

/// (34): force and damping end at once.
#[test]
fn nonsmooth_nets() {
    agrees("nonsmooth", sharp);
}

/// (35) as printed: the force fades out, the damping does not.
#[test]
fn smooth_nets_with_damping_that_ends_at_once() {
    agrees("smooth", smooth);
}
