//! Accelerations against an evaluation of our own, in plain loops, as the papers print it.

use serde_json::{Value, json};
use volary::law::Alignment;
use volary::math::Vector;
use volary::shape::{Geometry, In};
use volary::world::spec::LawSpec;

use crate::common::{headings, state};
use crate::scene::{Dice, accelerations, law, probe, world};

const MASSES: [f64; 9] = [1.0, 0.5, 2.0, 1.5, 3.0, 0.7, 1.0, 0.9, 1.2];

/// Something of i, j, positions and velocities.
type OfPair<'a, const D: usize> = &'a dyn Fn(usize, usize, &[Vector<D>], &[Vector<D>]) -> f64;

/// What a law is made of, written out for plain loops: everything by i, j and the state.
struct Plain<'a, const D: usize> {
    /// a_ij before normalisation, the diagonal included.
    influence: OfPair<'a, D>,
    normalisation: &'a str,
    /// ξ_i(u)/ε, the mass included.
    gain: &'a dyn Fn(usize, f64) -> f64,
}

impl<const D: usize> Plain<'_, D> {
    fn accelerations(&self, x: &[Vector<D>], v: &[Vector<D>]) -> Vec<Vector<D>> {
        let n = x.len();
        let of = |i: usize| {
            let row: Vec<f64> = (0..n).map(|j| (self.influence)(i, j, x, v)).collect();
            let divisor = match self.normalisation {
                "none" => 1.0,
                "mean_field" => n as f64,
                _ => row.iter().sum(),
            };
            let mut u = Vector::zeros();
            for j in 0..n {
                u += (v[j] - v[i]) * (row[j] / divisor);
            }
            u * (self.gain)(i, u.norm())
        };
        (0..n).map(of).collect()
    }
}

/// Compares on some random states at a time.
fn compare<const D: usize>(name: &str, law_of_file: Value, time: f64, plain: &Plain<'_, D>)
where
    In<D>: Geometry<D>,
{
    let world = world::<D>(&MASSES, law_of_file, json!({}));
    let mut dice = Dice(D as u64);
    let n = MASSES.len();
    for round in 0..6 {
        let mut x = dice.vectors::<D>(n, -3.0, 3.0);
        if round % 2 == 1 {
            // Nearly in a row, so that agents mask each other.
            for at in &mut x {
                *at = Vector::from_fn(|k, _| if k == 0 { 2.0 * at[0] } else { 0.02 * at[k] });
            }
        }
        let mut v = dice.vectors::<D>(n, -2.0, 2.0);
        v[3] = Vector::zeros();
        let expected = plain.accelerations(&x, &v);
        let found = accelerations(&world, time, &x, &v);
        let (one_by_one, rows) = probe(law(&world), &state(&world, time, &x, &v, &headings(&v)));
        let largest = expected.iter().map(|a| a.norm()).fold(0.0, f64::max);
        assert!(largest > 1e-3, "{name}: nothing happens");
        for i in 0..n {
            let error = (found[i] - expected[i]).norm();
            assert!(
                error <= 1e-12 * (1.0 + largest),
                "{name}, agent {i}: {error}"
            );
            assert_eq!(found[i], one_by_one[i], "{name}: depends on the split");
            let (row, _) = rows[i].as_ref().expect("it acts on all");
            if plain.normalisation == "motsch_tadmor" {
                let sum: f64 = row.iter().sum();
                assert!(
                    (sum - 1.0).abs() < 1e-14,
                    "{name}: row {i} adds up to {sum}"
                );
            }
        }
    }
}

fn cucker_smale<const D: usize>(i: usize, j: usize, x: &[Vector<D>]) -> f64 {
    2.0 / (0.5 * 0.5 + (x[i] - x[j]).norm_squared()).powf(0.4)
}

fn the_models_of_the_papers<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let kernel = json!({ "cucker_smale": { "strength": 2, "length": 0.5, "exponent": 0.4 } });
    compare::<D>(
        "Cucker and Smale, (1.1)",
        json!({ "kernel": kernel, "normalisation": "mean_field", "gain": 1.7 }),
        0.0,
        &Plain {
            influence: &|i, j, x, _| cucker_smale(i, j, x),
            normalisation: "mean_field",
            gain: &|_, _| 1.7,
        },
    );
    compare::<D>(
        "Motsch and Tadmor, (1.2), with one gain for each",
        json!({
            "kernel": kernel, "normalisation": "motsch_tadmor",
            "gain": [1, 2, 3, 4, 5, 4, 3, 2, 1]
        }),
        0.0,
        &Plain {
            influence: &|i, j, x, _| cucker_smale(i, j, x),
            normalisation: "motsch_tadmor",
            gain: &|i, _| [1.0, 2.0, 3.0, 4.0, 5.0, 4.0, 3.0, 2.0, 1.0][i],
        },
    );
    compare::<D>(
        "without oneself, as a force",
        json!({
            "kernel": { "exponential": { "strength": 3, "length": 1.5 } }, "acts_as": "force",
            "normalisation": "motsch_tadmor", "self_influence": false, "gain": 2
        }),
        0.0,
        &Plain {
            influence: &|i, j, x, _| match i == j {
                true => 0.0,
                false => 3.0 * (-(x[i] - x[j]).norm() / 1.5).exp(),
            },
            normalisation: "motsch_tadmor",
            gain: &|i, _| 2.0 / MASSES[i],
        },
    );
    compare::<D>(
        "(4.1) with (2.3)",
        json!({
            "kernel": kernel, "normalisation": "motsch_tadmor", "epsilon": 0.1,
            "gain": { "bounded": { "bound": 10, "scale": [1, 2, 3, 4, 5, 4, 3, 2, 1] } }
        }),
        0.0,
        &Plain {
            influence: &|i, j, x, _| cucker_smale(i, j, x),
            normalisation: "motsch_tadmor",
            gain: &|i, u| {
                let a = [1.0, 2.0, 3.0, 4.0, 5.0, 4.0, 3.0, 2.0, 1.0][i];
                10.0 / f64::sqrt(a * a + u * u) / 0.1
            },
        },
    );
    compare::<D>(
        "a bump, within a range",
        json!({ "kernel": { "bump": { "strength": 2, "range": 5, "start": 0.3 } }, "range": 4.2 }),
        0.0,
        &Plain {
            influence: &|i, j, x, _| {
                let r = (x[i] - x[j]).norm();
                let z: f64 = (r / 5.0 - 0.3) / 0.7;
                let rho = (1.0 + (std::f64::consts::PI * z.max(0.0)).cos()) / 2.0;
                if r <= 4.2 { 2.0 * rho } else { 0.0 }
            },
            normalisation: "none",
            gain: &|_, _| 1.0,
        },
    );
}

#[test]
fn alignment_follows_the_models_of_the_papers() {
    the_models_of_the_papers::<2>();
    the_models_of_the_papers::<3>();
}

/// (B.1), as printed.
fn masked<const D: usize>(i: usize, j: usize, x: &[Vector<D>]) -> f64 {
    const R: f64 = 0.4;
    if i == j {
        return 1.0;
    }
    let w = |i: usize, j: usize, l: usize| {
        let (a, b) = (x[j] - x[i], x[l] - x[i]);
        a.dot(&b) / (a.norm_squared() * b.norm_squared() + R.powi(4)).sqrt()
    };
    let h = |s: f64| 3000.0 * (s - 1.9).max(0.0).powi(3);
    let third = (0..x.len()).filter(|&l| l != i && l != j);
    let sum: f64 = third.map(|l| h(w(i, j, l) + w(j, i, l))).sum();
    (1.0 + (x[i] - x[j]).norm_squared()).powf(-0.3) * (-sum).exp()
}

fn masking_and_orientation<const D: usize>()
where
    In<D>: Geometry<D>,
{
    let kernel = json!({ "cucker_smale": { "exponent": 0.3 } });
    compare::<D>(
        "masking, (B.1)",
        json!({
            "kernel": kernel, "normalisation": "motsch_tadmor", "masking": { "radius": 0.4 }
        }),
        0.0,
        &Plain {
            influence: &|i, j, x, _| masked(i, j, x),
            normalisation: "motsch_tadmor",
            gain: &|_, _| 1.0,
        },
    );
    compare::<D>(
        "orientation, (2.4)",
        json!({
            "kernel": kernel, "orientation": {
                "angle": 1.1, "softness": 0.3, "floor": 0.2, "speed": 0.5, "length": 0.1
            }
        }),
        0.0,
        &Plain {
            influence: &|i, j, x, v| {
                let sigma = v[i] / (v[i].norm_squared() + 0.25).sqrt();
                let way = x[j] - x[i];
                let c = sigma.dot(&way) / (way.norm_squared() + 0.01).sqrt();
                let s = ((c - 1.1f64.cos() + 0.3) / 0.6).clamp(0.0, 1.0);
                let factor = 0.2 + 0.8 * (3.0 * s * s - 2.0 * s * s * s);
                factor * (1.0 + way.norm_squared()).powf(-0.3)
            },
            normalisation: "none",
            gain: &|_, _| 1.0,
        },
    );
}

#[test]
fn alignment_masks_and_looks_as_the_paper_says() {
    masking_and_orientation::<2>();
    masking_and_orientation::<3>();
}

#[test]
fn graphs_multiply_and_open_loops_follow_the_time() {
    let n = MASSES.len();
    let w = |i: usize, j: usize| match i == j {
        true => 0.0,
        false => ((3 * i + 5 * j) % 4) as f64 * 0.25,
    };
    let matrix: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| w(i, j)).collect()).collect();
    compare::<2>(
        "Shi, Wang & Chu, (6)",
        json!({ "graph": { "matrix": matrix }, "acts_as": "force" }),
        0.0,
        &Plain {
            influence: &|i, j, _, _| w(i, j),
            normalisation: "none",
            gain: &|i, _| 1.0 / MASSES[i],
        },
    );
    let time = 0.3;
    let a = |i: usize, j: usize| 1.0 + (i + j) as f64 + (std::f64::consts::TAU * time).sin();
    let function =
        |i: usize, j: usize| json!({ "sine": { "mean": 1 + i + j, "amplitude": 1, "period": 1 } });
    let rows: Vec<Vec<Value>> = (0..n)
        .map(|i| (0..n).map(|j| function(i, j)).collect())
        .collect();
    let gains: Vec<Value> = (0..n)
        .map(|i| json!({ "table": { "times": [0, 1], "values": [i, i + 1] } }))
        .collect();
    let plain = Plain {
        influence: &|i, j, _: &[Vector<3>], _: &[Vector<3>]| a(i, j),
        normalisation: "motsch_tadmor",
        gain: &|i, _| i as f64 + time,
    };
    compare::<3>(
        "(2.6)",
        json!({
            "normalisation": "motsch_tadmor", "graph": { "open_loop": rows },
            "gain": { "open_loop": gains }
        }),
        time,
        &plain,
    );
}

#[test]
fn functions_of_ones_own_take_the_places_of_those_of_the_file() {
    let world = world::<2>(&MASSES, json!({ "normalisation": "mean_field" }), json!({}));
    let LawSpec::Alignment(spec) = &world.spec.laws[0] else {
        panic!("the world has this law");
    };
    let law = Alignment::new(spec, None, &world)
        .with_kernel(|squared| 1.0 / (2.0 + squared))
        .with_gain(|agent, time| agent as f64 + time)
        .with_influences(|i, j, time| (i + 2 * j) as f64 * time);
    let mut dice = Dice(5);
    let (x, v) = (
        dice.vectors::<2>(9, -3.0, 3.0),
        dice.vectors::<2>(9, -3.0, 3.0),
    );
    let (found, _) = probe(Box::new(law), &state(&world, 0.5, &x, &v, &headings(&v)));
    let plain = Plain {
        influence: &|i, j, x: &[Vector<2>], _: &[Vector<2>]| {
            (i + 2 * j) as f64 * 0.5 / (2.0 + (x[i] - x[j]).norm_squared())
        },
        normalisation: "mean_field",
        gain: &|i, _| i as f64 + 0.5,
    };
    for (found, expected) in found.iter().zip(plain.accelerations(&x, &v)) {
        assert!((found - expected).norm() < 1e-12);
    }
}
