//! Shipped worlds: their starts are those that the papers print.

use serde_json::Value;
use volary::math::Vector;
use volary::world::shipped;

use crate::common::from_json;
use crate::plain_mean;

/// Positions and velocities of a shipped world's agents, and half their bodies' width.
fn start(name: &str) -> (Vec<Vector<2>>, Vec<Vector<2>>, f64) {
    let text = shipped::get(name).expect("a shipped world");
    let world: Value = serde_json::from_str(text).expect("JSON");
    let group = &world["agents"][0];
    let vectors = |list: &Value| -> Vec<Vector<2>> {
        let pairs: Vec<[f64; 2]> = from_json(list["explicit"].clone());
        pairs.into_iter().map(Vector::from).collect()
    };
    let radius = group["radius"].as_f64().expect("a radius");
    (
        vectors(&group["positions"]),
        vectors(&group["velocities"]),
        radius,
    )
}

fn distances(at: &[Vector<2>]) -> Vec<f64> {
    let pairs = (0..at.len()).flat_map(|i| (0..at.len()).map(move |j| (i, j)));
    let pairs = pairs.filter(|(i, j)| i != j);
    pairs.map(|(i, j)| (at[i] - at[j]).norm()).collect()
}

/// Σ |x_i − x̄|².
fn spread(vectors: &[Vector<2>]) -> f64 {
    let mean = plain_mean(vectors);
    vectors.iter().map(|one| (one - mean).norm_squared()).sum()
}

/// The distance that theory keeps, Ψ⁻¹(W(0)) with Ψ = Q exp(−μr²), must hold the bodies.
fn bodies_fit(radius: f64, energy: f64, height: f64, decay: f64) {
    let least = ((height / energy).ln() / decay).sqrt();
    assert!(
        2.0 * radius < least && least < 2.2 * radius,
        "{radius} {least}"
    );
}

#[test]
fn example_18_starts_as_printed() {
    let (at, v, radius) = start("song-2013/example-18");
    let distances = distances(&at);
    let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
    // (12), each pair twice.
    let bonds: f64 = distances.iter().map(|r| (r - 1.5).powi(2)).sum();
    let repulsion: f64 = distances.iter().map(|r| 140.0 * (-3.0 * r * r).exp()).sum();
    let energy = 0.5 * spread(&v) + 0.01 / 4.0 * bonds + 0.5 * repulsion;
    assert_eq!((at.len(), v.len()), (10, 10));
    assert!((nearest - 1.6584).abs() < 1e-12, "{nearest}");
    assert!((energy - 131.5835).abs() < 1e-10, "{energy}");
    bodies_fit(radius, energy, 140.0, 3.0);
}

#[test]
fn example_19_starts_as_printed() {
    let (at, v, radius) = start("song-2013/example-19");
    let distances = distances(&at);
    let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
    // (19), each pair twice.
    let repulsion: f64 = distances.iter().map(|r| 40.0 * (-1.8 * r * r).exp()).sum();
    let energy = 0.5 * spread(&v) + 0.01 / 2.0 * spread(&at) + 0.5 * repulsion;
    assert_eq!((at.len(), v.len()), (10, 10));
    assert!((nearest - 2.4876).abs() < 1e-12, "{nearest}");
    assert!((energy - 34.0842).abs() < 1e-10, "{energy}");
    bodies_fit(radius, energy, 40.0, 1.8);
}
