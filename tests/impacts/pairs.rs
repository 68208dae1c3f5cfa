//! Random pairs of balls, each alone: struck if and only if their ways cross, by closed forms.

use serde_json::json;
use volary::dynamics::{Engine, Touched};
use volary::math::Vector;
use volary::shape::In;

use crate::common::Dice;
use crate::{list, run};

const STEPS: usize = 8;

/// Pairs in one world, far from each other.
const LANES: usize = 50;

/// A pair of balls as it starts, and what is to become of it.
struct Shot<const D: usize> {
    radii: [f64; 2],
    masses: [f64; 2],
    places: [Vector<D>; 2],
    velocities: [Vector<D>; 2],
}

impl<const D: usize> Shot<D> {
    fn random(dice: &mut Dice, lane: usize, step: f64) -> Self {
        let radii = [dice.magnitude(0.1, 1.0), dice.magnitude(0.1, 1.0)];
        let masses = [dice.magnitude(0.2, 5.0), dice.magnitude(0.2, 5.0)];
        let touching = radii[0] + radii[1];
        let travel = dice.magnitude(0.01, 5.0);
        let speed = travel * 2.0 * radii[0].min(radii[1]) / step;
        let along = dice.direction::<D>();
        let across = {
            let other = dice.direction::<D>();
            (other - along * other.dot(&along)).normalize()
        };
        let miss = dice.between(0.0, 1.5) * touching;
        let nearest = dice.between(0.5, STEPS as f64 - 1.0) * step;
        // At first they are apart, where they would not meet in the past.
        let depth = (touching * touching - miss * miss).max(0.0).sqrt();
        let back = (speed * nearest).max(depth * 1.001 + 1e-3 * touching);
        let common = dice.direction::<D>() * dice.between(0.0, speed);
        let mut place = Vector::<D>::zeros();
        place[0] = 200.0 * lane as f64;
        Self {
            radii,
            masses,
            places: [place - along * back, place + across * miss],
            velocities: [common + along * speed, common],
        }
    }

    /// When they meet, and along which normal.
    fn meeting(&self) -> Option<(f64, Vector<D>)> {
        let apart = self.places[1] - self.places[0];
        let velocity = self.velocities[0] - self.velocities[1];
        let touching = self.radii[0] + self.radii[1];
        let along = velocity.normalize();
        let ahead = apart.dot(&along);
        let miss = (apart - along * ahead).norm();
        if miss >= touching {
            return None;
        }
        let time = (ahead - ((touching - miss) * (touching + miss)).sqrt()) / velocity.norm();
        let normal = (apart - velocity * time) / touching;
        Some((time, normal))
    }
}

fn check<const D: usize>(seed: u64, step: f64, restitution: f64) -> usize
where
    In<D>: Engine<D>,
{
    let mut dice = Dice(seed);
    let shots: Vec<Shot<D>> = (0..LANES)
        .map(|lane| Shot::random(&mut dice, lane, step))
        .collect();
    let groups: Vec<_> = shots
        .iter()
        .flat_map(|shot| {
            (0..2).map(|k| {
                json!({
                    "radius": shot.radii[k], "mass": shot.masses[k],
                    "positions": { "explicit": [list(&shot.places[k])] },
                    "velocities": { "explicit": [list(&shot.velocities[k])] }
                })
            })
        })
        .collect();
    let ran = run::<D>(
        json!({
            "dimension": D, "time": { "step": step, "end": step * STEPS as f64 },
            "physics": { "restitution": restitution }, "agents": groups
        }),
        STEPS,
    );
    let end = step * STEPS as f64;
    let mut hits = 0;
    for (lane, shot) in shots.iter().enumerate() {
        let blows: Vec<_> = ran
            .blows()
            .into_iter()
            .filter(|it| it.agent / 2 == lane)
            .collect();
        let mut velocities = shot.velocities;
        let scale = velocities[0].norm().max(velocities[1].norm());
        let what = format!("lane {lane} of seed {seed}, step {step}, restitution {restitution}");
        if let Some((time, normal)) = shot.meeting()
            && time < end
        {
            hits += 1;
            assert_eq!(blows.len(), 1, "{what}: meets at {time}, {blows:?}");
            let approach = (velocities[0] - velocities[1]).dot(&normal);
            let reduced = 1.0 / (1.0 / shot.masses[0] + 1.0 / shot.masses[1]);
            let impulse = reduced * (1.0 + restitution) * approach;
            velocities[0] -= normal * (impulse / shot.masses[0]);
            velocities[1] += normal * (impulse / shot.masses[1]);
            let blow = blows[0];
            assert_eq!(blow.touched, Touched::Agent(2 * lane + 1));
            // A grazing touch is found as sharply as its square root can be.
            let sharp = 1e-9 * scale / approach.max(1e-3 * scale);
            assert!(
                (blow.time - time).abs() < sharp * end,
                "{what}: at {} for {time}",
                blow.time
            );
            assert!(
                (blow.approach_speed - approach).abs() < 1e-9 * scale,
                "{what}"
            );
            assert!(
                (blow.blow - impulse).abs() < 1e-9 * reduced * scale,
                "{what}"
            );
            assert!((blow.normal - normal).norm() < 1e-9, "{what}");
        } else {
            assert!(blows.is_empty(), "{what}: {blows:?}");
        }
        for (k, velocity) in velocities.iter().enumerate() {
            let off = (ran.velocities[2 * lane + k] - velocity).norm();
            assert!(off < 1e-9 * scale, "{what}: velocity off by {off}");
        }
    }
    hits
}

fn check_all<const D: usize>(worlds: u64) -> usize
where
    In<D>: Engine<D>,
{
    let cases = [
        (0.01, 0.0),
        (0.01, 0.5),
        (0.01, 1.0),
        (0.001, 0.0),
        (0.001, 0.5),
        (0.001, 1.0),
    ];
    let seeds = (0..worlds).flat_map(|k| cases.map(|case| (k, case)));
    seeds
        .map(|(seed, (step, restitution))| check::<D>(seed + 1, step, restitution))
        .sum()
}

#[test]
fn ten_thousand_pairs_meet_exactly_where_their_ways_cross() {
    // 17 worlds of 50 pairs in each of six settings, in both dimensions.
    let hits = check_all::<2>(17) + check_all::<3>(17);
    assert!(hits > 5_000, "{hits} of {} met", 2 * 17 * 6 * LANES);
}
