//! Gases of hard disks and spheres in a box: energy, overlap, and the pressure on the walls
//! against equations of state.

use serde_json::json;
use volary::dynamics::{Bodies, Engine, Touched};
use volary::law::Flock;
use volary::math::Vector;
use volary::shape::In;

use crate::common::{Dice, spec, world};
use crate::list;

/// A gas in a box.
struct Gas {
    count: usize,
    /// Share of the box that the bodies fill.
    fraction: f64,
    steps: usize,
}

/// What became of it.
struct Found {
    /// Energy at the end, over that at the start.
    energy: f64,
    /// Deepest overlap that was met, over the diameter.
    deepest: f64,
    blows: usize,
    /// Pressure on the walls over ρkT, with the density ρ far from the walls.
    factor: f64,
    /// Share that the bodies fill far from the walls.
    filled: f64,
}

/// Diameters from the walls where the gas is no longer layered.
const LAYERED: f64 = 3.0;

impl Gas {
    fn run<const D: usize>(&self) -> Found
    where
        In<D>: Engine<D>,
    {
        let mut dice = Dice(7);
        let dimension = D as i32;
        // Volume of a body of diameter 1.
        let volume = if D == 2 { 0.25 } else { 1.0 / 6.0 } * std::f64::consts::PI;
        let side = (self.count as f64 * volume / self.fraction).powf(1.0 / f64::from(dimension));
        let per_side = (1..)
            .find(|k: &usize| k.pow(D as u32) >= self.count)
            .expect("some");
        let apart = (side - 1.0) / (per_side as f64 - 1.0).max(1.0) * 0.999;
        let place = |k: usize| {
            Vector::<D>::from_fn(|axis, _| {
                apart
                    * ((k / per_side.pow(axis as u32) % per_side) as f64
                        - 0.5 * (per_side as f64 - 1.0))
            })
        };
        let places: Vec<_> = (0..self.count).map(|k| list(&place(k))).collect();
        let speed = 10.0;
        let velocities: Vec<_> = (0..self.count)
            .map(|_| list(&(dice.direction::<D>() * speed)))
            .collect();
        let world = world::<D>(spec(json!({
            "dimension": D, "time": { "step": 0.01, "end": 0.01 * self.steps as f64 },
            "physics": { "restitution": 1 },
            "agents": [{
                "radius": 0.5, "mass": 1,
                "positions": { "explicit": places }, "velocities": { "explicit": velocities }
            }],
            "obstacles": [{ "shape": { "room": { "half_extents": vec![0.5 * side; D] } } }]
        })));
        let mut flock = Flock::of_world(&world, Vec::new());
        let mut bodies = Bodies::new(&world, &mut flock).expect("a finite start");
        let energy = |bodies: &Bodies<D>| -> f64 {
            let velocities = bodies.snapshot().velocities.iter();
            velocities.map(|v| 0.5 * v.norm_squared()).sum()
        };
        let begin = energy(&bodies);
        let (mut deepest, mut blows, mut pushed) = (0.0f64, 0, 0.0);
        let (mut inside, mut looks) = (0usize, 0usize);
        let half = 0.5 * side - LAYERED;
        // The first fifth melts the grid.
        let melted = self.steps / 5;
        for step in 0..self.steps {
            bodies.step(&mut flock).expect("a finite step");
            for touch in bodies.touches() {
                deepest = deepest.max(-touch.gap);
                blows += usize::from(touch.blow > 0.0);
                if step >= melted && matches!(touch.touched, Touched::Obstacle(_)) {
                    pushed += touch.impulse();
                }
            }
            if step >= melted && step % 10 == 0 {
                let positions = bodies.snapshot().positions.iter();
                inside += positions.filter(|it| it.amax() < half).count();
                looks += 1;
            }
        }
        let end = energy(&bodies);
        let walls = 2.0 * f64::from(dimension) * side.powi(dimension - 1);
        let pressure = pushed / (0.01 * (self.steps - melted) as f64) / walls;
        let density = inside as f64 / looks.max(1) as f64 / (2.0 * half).powi(dimension);
        let temperature = 2.0 * begin / (f64::from(dimension) * self.count as f64);
        Found {
            energy: end / begin,
            deepest,
            blows,
            factor: pressure / (density * temperature),
            filled: density * volume,
        }
    }
}

/// D. Henderson, "A simple equation of state for hard discs" (1975).
fn henderson(filled: f64) -> f64 {
    (1.0 + filled * filled / 8.0) / (1.0 - filled).powi(2)
}

/// N. F. Carnahan & K. E. Starling, "Equation of state for nonattracting rigid spheres" (1969).
fn carnahan_starling(filled: f64) -> f64 {
    (1.0 + filled + filled.powi(2) - filled.powi(3)) / (1.0 - filled).powi(3)
}

#[test]
fn gases_keep_their_energy() {
    let thin = Gas {
        count: 200,
        fraction: 0.14,
        steps: 1_000,
    };
    let dense = Gas {
        count: 600,
        fraction: 0.42,
        steps: 200,
    };
    let spheres = Gas {
        count: 216,
        fraction: 0.2,
        steps: 300,
    };
    for (found, name) in [
        (thin.run::<2>(), "thin"),
        (dense.run::<2>(), "dense"),
        (spheres.run::<3>(), "spheres"),
    ] {
        assert!(
            (found.energy - 1.0).abs() < 1e-9,
            "{name}: {}",
            found.energy
        );
        assert!(found.deepest < 1e-9, "{name}: {}", found.deepest);
        assert!(found.blows > 1_000, "{name}: {}", found.blows);
    }
}

/// `cargo test --release --test impacts -- --ignored gases_press --nocapture`
#[test]
#[ignore = "measures, in some minutes"]
fn gases_press_as_their_equations_of_state_have_it() {
    let mut off: f64 = 0.0;
    let mut tell = |name: &str, found: &Found, expected: f64| {
        println!(
            "{name}: filled {:.4}, pressure factor {:.4} for {expected:.4}, {} blows, energy {:e}, overlap {:e}",
            found.filled,
            found.factor,
            found.blows,
            found.energy - 1.0,
            found.deepest
        );
        off = off.max((found.factor / expected - 1.0).abs());
    };
    let disks = [(200, 0.14), (600, 0.42)];
    for (count, fraction) in disks {
        let found = Gas {
            count,
            fraction,
            steps: 20_000,
        }
        .run::<2>();
        tell("disks", &found, henderson(found.filled));
    }
    for fraction in [0.14, 0.3] {
        let found = Gas {
            count: 1_000,
            fraction,
            steps: 4_000,
        }
        .run::<3>();
        tell("spheres", &found, carnahan_starling(found.filled));
    }
    assert!(off < 0.02, "off by {off}");
}
