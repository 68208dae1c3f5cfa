//! How the time of reading, checking and placing grows with a world.
//!
//! `cargo bench --bench reading` prints, for each kind of thing that a world may hold many of,
//! the seconds for the largest number of them and the exponent of growth: the slope of the
//! logarithms from a quarter of them on. What is refused is timed with its message.

mod common;

use common::{median, timed};
use serde_json::{Value, json};
use volary::world::Document;

/// The largest number of things.
const MOST: usize = 100_000;

/// Rounds of which the median counts.
const ROUNDS: usize = 5;

fn place(k: usize) -> [f64; 2] {
    [(k % 317) as f64, (k / 317) as f64]
}

fn shifted(k: usize, by: [f64; 2]) -> [f64; 2] {
    let [x, y] = place(k);
    [x + by[0], y + by[1]]
}

fn listed(count: usize) -> Value {
    let places: Vec<_> = (0..count).map(|k| shifted(k, [0.5, 0.5])).collect();
    json!({ "radius": 0.05, "positions": { "explicit": places } })
}

fn groups(count: usize) -> Vec<Value> {
    let group = |k| json!({ "name": format!("g{k}"), "radius": 0.1, "positions": { "explicit": [place(k)] } });
    (0..count).map(group).collect()
}

fn obstacles(count: usize) -> Vec<Value> {
    let ball =
        |k| json!({ "shape": { "ball": { "radius": 0.1 } }, "position": shifted(k, [400.0, 0.0]) });
    (0..count).map(ball).collect()
}

fn with_unknown(mut world: Value, count: usize) -> Value {
    for k in 0..count {
        world[format!("x{k}")] = json!(k);
    }
    world
}

/// A world with so many things of a kind.
fn world(kind: &str, count: usize) -> Value {
    let with = |agents: Value, obstacles: Vec<Value>| json!({ "dimension": 2, "time": { "end": 1 }, "agents": agents, "obstacles": obstacles });
    let one = || json!([listed(1)]);
    match kind {
        "agents, listed" => with(json!([listed(count)]), Vec::new()),
        "agents, drawn" => {
            let side = 2.0 * (count as f64).sqrt();
            let region = json!({ "min": [0, 0], "max": [side, side] });
            let drawn = json!({ "count": count, "radius": 0.4, "positions": { "box": region } });
            with(json!([drawn]), Vec::new())
        }
        "rods" => {
            let places: Vec<_> = (0..count).map(place).collect();
            let rod = json!({ "capsule": { "half_length": 0.3, "radius": 0.1 } });
            with(
                json!([{ "shape": rod, "positions": { "explicit": places } }]),
                Vec::new(),
            )
        }
        "groups" => with(json!(groups(count)), Vec::new()),
        "obstacles" => with(one(), obstacles(count)),
        "unknown fields" => with_unknown(with(one(), Vec::new()), count),
        _ => {
            let mut agents = groups(count);
            agents.push(listed(count));
            let all = with(json!(agents), obstacles(count));
            match kind {
                "all in one world" => all,
                _ => with_unknown(all, count),
            }
        }
    }
}

/// The seconds that a text takes, and whether it makes a world.
fn read(text: &str) -> (bool, f64) {
    timed(|| {
        let read = Document::new("w.json", text).world("w");
        // A refusal is nothing before it is told.
        read.map_err(|report| report.render(false)).is_ok()
    })
}

fn main() {
    println!("{:<24}{:>10}{:>10}  of", "kind", "seconds", "exponent");
    for kind in [
        "agents, listed",
        "agents, drawn",
        "rods",
        "groups",
        "obstacles",
        "unknown fields",
        "all in one world",
        "all, and unknown fields",
    ] {
        let texts = [MOST / 4, MOST].map(|count| world(kind, count).to_string());
        let mut seconds = [Vec::new(), Vec::new()];
        let mut sound = true;
        for _ in 0..ROUNDS {
            for (text, seconds) in texts.iter().zip(&mut seconds) {
                let (taken, time) = read(text);
                (sound, ()) = (taken, seconds.push(time));
            }
        }
        let [few, many] = seconds.map(median);
        let exponent = (many / few).ln() / 4f64.ln();
        let what = if sound { "read" } else { "refused" };
        println!("{kind:<24}{many:>10.3}{exponent:>10.2}  {MOST}, {what}");
    }
}
