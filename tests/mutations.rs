//! Whatever is done to a sound world, it is refused with a message or it runs: no panic, no
//! record that is not finite.

mod common;

use std::io;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use serde_json::{Value, json};
use volary::dynamics::Engine;
use volary::shape::In;
use volary::simulation::Simulation;
use volary::trace::record::Outcome;
use volary::trace::{Compression, Format, Layout, TraceWriter};
use volary::world::{AnyWorld, Document, World, shipped};

/// How many worlds are tried.
const MUTANTS: u64 = 10_000;

/// Steps that a mutant runs for, where it is sound.
const STEPS: u64 = 4;

/// Agents that a group is cut down to, so that many worlds can be tried.
const AGENTS: u64 = 9;

/// Numbers that are easily forgotten. None makes a world that is sound but huge.
const NUMBERS: [f64; 18] = [
    -1.0, 0.0, -0.0, 0.5, 1.0, 2.0, 3.0, 17.0, 5e-324, 1e-300, 1e-9, 1e9, 1e17, -1e9, 1e100,
    -1e100, 1e101, 1e300,
];

/// Random numbers, the same in every run: SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[self.below(from.len())]
    }
}

/// The shipped worlds, with few agents and without prose, and worlds with all there is.
fn sound_worlds() -> Vec<Value> {
    let small = |name: String| {
        let text = shipped::get(&name).expect("it is listed");
        let mut world: Value = serde_json::from_str(text).expect("shipped worlds are JSON");
        for prose in ["notes", "description", "$schema"] {
            world.as_object_mut().expect("a world").remove(prose);
        }
        world["record"] = json!({
            "every": world["time"]["step"], "accelerations": true, "beta_agents": true,
            "edges": true, "net": true, "links": true, "laws": true, "blocked": true
        });
        for group in world["agents"].as_array_mut().expect("groups") {
            if let Some(count) = group.get("count").and_then(Value::as_u64) {
                group["count"] = json!(count.min(AGENTS));
            }
        }
        world
    };
    let all_there_is = [2, 3].map(|d| [common::circus(d), common::parade(d)]);
    let json = |world| serde_json::to_value(world).expect("it is JSON");
    let shipped = shipped::names().into_iter().map(small);
    shipped
        .chain(all_there_is.into_iter().flatten().map(json))
        .collect()
}

/// JSON pointers to everything in a value, itself included.
fn places(value: &Value, here: String, out: &mut Vec<String>) {
    match value {
        Value::Object(fields) => {
            for (name, field) in fields {
                places(field, format!("{here}/{name}"), out);
            }
        }
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                places(item, format!("{here}/{index}"), out);
            }
        }
        _ => {}
    }
    out.push(here);
}

/// One change somewhere in `world`; `donors` give what may take a place.
fn mutate(world: &mut Value, donors: &[Value], random: &mut Random) {
    let mut all = Vec::new();
    places(world, String::new(), &mut all);
    let at = random.pick(&all).clone();
    let value = world.pointer_mut(&at).expect("it was just listed");
    match (random.below(8), &mut *value) {
        (0..=3, Value::Number(number)) => {
            let old = number.as_f64().expect("a double");
            let factor = *random.pick(&[-1.0, 0.5, 2.0, 10.0]);
            let new = match random.below(3) {
                0 => old * factor,
                1 => -old,
                _ => *random.pick(&NUMBERS),
            };
            *value = match new == new.trunc() && new.abs() < 1e15 {
                true => json!(new as i64),
                false => json!(new),
            };
        }
        (0 | 1, Value::Array(items)) if !items.is_empty() => {
            items.remove(random.below(items.len()));
        }
        (2 | 3, Value::Array(items)) if !items.is_empty() => {
            items.push(items[random.below(items.len())].clone());
        }
        (4, Value::Array(items)) => items.reverse(),
        (0..=3, Value::Object(fields)) if !fields.is_empty() => {
            let name = fields.keys().nth(random.below(fields.len())).cloned();
            fields.remove(&name.expect("it has fields"));
        }
        (7, value) => *value = Value::Null,
        (_, value) => {
            // Something that stands at the end of a like path elsewhere, or anywhere.
            let donor = random.pick(donors);
            let mut others = Vec::new();
            places(donor, String::new(), &mut others);
            let like = |path: &&String| path.rsplit('/').next() == at.rsplit('/').next();
            let alike: Vec<_> = others.iter().filter(like).cloned().collect();
            let from = match alike.is_empty() || random.below(4) == 0 {
                true => random.pick(&others),
                false => random.pick(&alike),
            };
            *value = donor.pointer(from).expect("it was just listed").clone();
        }
    }
}

/// Runs a world for some steps and writes all it says; returns whether it got so far.
fn run<const D: usize>(world: World<D>) -> bool
where
    In<D>: Engine<D>,
{
    let Ok(mut simulation) = Simulation::new(world) else {
        return false;
    };
    let format = Format {
        layout: Layout::Lines,
        compression: Compression::None,
    };
    let mut writer = TraceWriter::new(io::sink(), format);
    let summary = simulation.run(
        |record| writer.write(&record),
        |state| match state.step < STEPS {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        },
    );
    let summary = summary.expect("every record is finite");
    summary.outcome != Outcome::Failed
}

#[test]
fn mutants_are_refused_or_run() {
    let worlds = sound_worlds();
    let mut random = Random(20_261_122);
    let (mut refused, mut failed, mut ran) = (0, 0, 0);
    for mutant in 0..MUTANTS {
        let mut world = random.pick(&worlds).clone();
        for _ in 0..1 + random.below(3) {
            mutate(&mut world, &worlds, &mut random);
        }
        let text = serde_json::to_string_pretty(&world).expect("a value is JSON");
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            let went_on = match Document::new("mutant.json", text.as_str()).world("mutant") {
                Err(report) => {
                    assert!(!report.to_string().is_empty() && !report.render(false).is_empty());
                    refused += 1;
                    return;
                }
                Ok(AnyWorld::Plane(world)) => run(world),
                Ok(AnyWorld::Space(world)) => run(world),
            };
            match went_on {
                true => ran += 1,
                false => failed += 1,
            }
        }));
        assert!(outcome.is_ok(), "mutant {mutant} brings it down:\n{text}");
    }
    println!("{refused} refused, {ran} ran, {failed} failed on the way");
    // Neither half may become empty, or nothing would be tested.
    assert!(refused > 1_000 && ran > 1_000);
}
