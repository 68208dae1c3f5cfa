//! How near agents can come: the bounds of Theorems 10 and 16 against what can happen.

use serde_json::json;
use volary::math::Vector;
use volary::world::World;

use super::{exclusion, quantity};
use crate::common::{Dice, spec, world};
use crate::runs::{holds, points, unmet};

/// Two agents head-on under model (8), this far apart, at this speed each.
fn head_on(gap: f64, speed: f64) -> World<2> {
    world(spec(json!({
        "dimension": 2,
        "time": { "step": 0.001, "end": 1 },
        "record": { "every": 0.001 },
        "agents": [{
            "radius": 0.001,
            "positions": { "explicit": [[-0.5 * gap, 0], [0.5 * gap, 0]] },
            "velocities": { "explicit": [[speed, 0], [-speed, 0]] }
        }],
        "laws": [
            { "alignment": { "kernel": { "cucker_smale": { "strength": 0.001, "exponent": 0.5 } } } },
            { "pair_potential": { "potential": { "bond": { "stiffness": 0.1, "length": 1 } } } },
            { "pair_potential": { "potential": { "gaussian": { "height": 4, "decay": 3 } } } }
        ]
    })))
}

#[test]
fn head_on_agents_come_as_near_as_theory_lets_them_and_no_nearer() {
    // W(0) = v² + k_a/2 + Q exp(−4μ), against Q = 4 and u(0) = 4.05.
    let world = head_on(2.0, 1.9);
    let run = points(&world);
    holds("song-2013/theorem-10-collision-avoidance", &run);
    let finding = holds("song-2013/theorem-10-distance-sharpest", &run);
    let (kept, closest) = (
        quantity(&finding, "distance that theory keeps"),
        run.closest.expect("there are two").distance,
    );
    assert!(closest >= kept && closest < 1.01 * kept, "{closest} {kept}");

    // A little above Q, where the paper promises nothing, the bond's energy still keeps them
    // apart; beyond that they run through each other.
    let world = head_on(2.0, 1.9975);
    let run = points(&world);
    unmet("song-2013/theorem-10-distance-sharpened", &run);
    holds("song-2013/theorem-10-distance-sharpest", &run);
    let world = head_on(2.0, 2.05);
    let run = points(&world);
    unmet("song-2013/theorem-10-collision-avoidance", &run);
    unmet("song-2013/theorem-10-distance-sharpest", &run);
    assert!(run.closest.expect("there are two").distance < 0.002);
    let last = run.last();
    assert!(last.positions[0].x > last.positions[1].x);
}

#[test]
fn a_stray_factor_goes_unnoticed_while_bonds_are_hardly_stretched() {
    let world = head_on(1.5, 0.1);
    let run = points(&world);
    holds("song-2013/remark-13-bonding-force-printed", &run);
    holds("song-2013/remark-13-bonding-force-corrected", &run);
}

/// The least energy of all agents but two, which are held at a distance, over many descents
/// from random starts: of the pairs' energy u, slope −f.
fn least_energy(
    count: usize,
    distance: f64,
    u: impl Fn(f64) -> f64,
    f: impl Fn(f64) -> f64,
    dice: &mut Dice,
) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..20 {
        let mut x: Vec<Vector<2>> = dice.vectors(count, -1.5, 1.5);
        x[0] = Vector::<2>::new(-0.5 * distance, 0.0);
        x[1] = -x[0];
        for step in 0..600 {
            let forces: Vec<Vector<2>> = (0..count)
                .map(|i| {
                    let others = (0..count).filter(|&j| j != i);
                    others
                        .map(|j| {
                            let way = x[i] - x[j];
                            way.normalize() * f(way.norm())
                        })
                        .sum()
                })
                .collect();
            let rate = 0.1 / (1.0 + 0.02 * f64::from(step));
            for i in 2..count {
                x[i] += forces[i] * (rate / forces[i].norm().max(1.0));
            }
        }
        let mut energy = 0.0;
        for i in 0..count {
            for j in 0..i {
                energy += u((x[i] - x[j]).norm());
            }
        }
        least = least.min(energy);
    }
    least
}

#[test]
fn no_state_with_the_energy_is_nearer_than_the_sharpest_distance() {
    let mut dice = Dice(7);
    for (count, tight) in [(3, true), (4, false), (5, false)] {
        for attraction in [false, true] {
            let n = f64::from(count);
            let (stiffness, height, decay) = (if attraction { 1.0 } else { 0.5 }, 4.0, 1.5);
            let u = |r: f64| {
                let drawn = match attraction {
                    true => stiffness / (2.0 * n) * r * r,
                    false => 0.5 * stiffness * (r - 1.2) * (r - 1.2),
                };
                drawn + height * (-decay * r * r).exp()
            };
            let f = |r: f64| {
                let drawn = match attraction {
                    true => stiffness / n * r,
                    false => stiffness * (r - 1.2),
                };
                2.0 * height * decay * r * (-decay * r * r).exp() - drawn
            };
            // The world's start: a wide ring at rest, so that W(0) is all potential.
            let radius = 1.4;
            let ring: Vec<[f64; 2]> = (0..count)
                .map(|k| {
                    let angle = f64::from(k) / n * std::f64::consts::TAU;
                    [radius * angle.cos(), radius * angle.sin()]
                })
                .collect();
            let drawing = match attraction {
                true => json!({ "pair_potential": {
                    "potential": { "attraction": { "stiffness": stiffness } }, "share": "mean"
                } }),
                false => json!({ "pair_potential": {
                    "potential": { "bond": { "stiffness": stiffness, "length": 1.2 } }
                } }),
            };
            let world: World<2> = world(spec(json!({
                "dimension": 2,
                "time": { "step": 0.01, "end": 0 },
                "agents": [{ "radius": 0.01, "positions": { "explicit": ring } }],
                "laws": [
                    { "alignment": { "kernel": { "cucker_smale": { "exponent": 0.5 } } } },
                    drawing,
                    { "pair_potential": {
                        "potential": { "gaussian": { "height": height, "decay": decay } }
                    } }
                ]
            })));
            let run = points(&world);
            let name = match attraction {
                true => "song-2013/theorem-16-distance-sharpest",
                false => "song-2013/theorem-10-distance-sharpest",
            };
            let Some(kept) = exclusion(name, &run) else {
                panic!("{count} agents have too much energy");
            };
            let energy = run.start().laws.energy.expect("it is finite");
            let mut least = |r: f64| least_energy(count as usize, r, u, f, &mut dice);
            for share in [0.9, 0.99, 0.999] {
                let needed = least(share * kept.distance);
                assert!(needed > energy, "{count}, {share}: {needed} {energy}");
            }
            let needed = least(1.001 * kept.distance);
            assert_eq!(needed < energy, tight, "{count}: {needed} {energy}");
        }
    }
}
