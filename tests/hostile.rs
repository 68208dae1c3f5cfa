//! Worlds that hold very much: each is read in a time that grows with its size, or refused with
//! the size that is allowed.

use std::fmt::Write;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use volary::simulation::Simulation;
use volary::world::limits::{MOST_BYTES, MOST_LAWS, MOST_UNBOUNDED, MOST_VALUES};
use volary::world::{AnyWorld, Document, Override, Stage, Watch};

/// As many of each kind. What took a time that grows with the square took minutes for these.
const MANY: usize = 20_000;

/// What no reading takes that grows with the size, on a slow machine busy with other tests. It
/// takes a second or so.
const PATIENCE: Duration = Duration::from_secs(60);

/// A world with more fields.
fn world(more: Value) -> Value {
    let mut world = json!({
        "dimension": 2,
        "time": { "end": 1 },
        "agents": [{ "radius": 0.1, "positions": { "explicit": [[-9, -9]] } }]
    });
    for (name, field) in more.as_object().unwrap() {
        world[name] = field.clone();
    }
    world
}

/// Places on a square, far enough from each other.
fn place(k: usize) -> Value {
    json!([k % 150, k / 150])
}

fn groups(count: usize) -> Vec<Value> {
    let group = |k| json!({ "name": format!("g{k}"), "radius": 0.1, "positions": { "explicit": [place(k)] } });
    (0..count).map(group).collect()
}

fn balls(count: usize) -> Vec<Value> {
    let ball = |k: usize| json!({ "shape": { "ball": { "radius": 0.1 } }, "position": [k % 150, -2.0 - (k / 150) as f64] });
    (0..count).map(ball).collect()
}

fn read(text: &str) -> Result<AnyWorld, String> {
    let begin = Instant::now();
    let read = Document::new("w.json", text).world("w");
    let read = read.map_err(|report| report.to_string());
    assert!(begin.elapsed() < PATIENCE, "it took {:?}", begin.elapsed());
    read
}

fn agents(world: &AnyWorld) -> usize {
    match world {
        AnyWorld::Plane(world) => world.agents.len(),
        AnyWorld::Space(world) => world.agents.len(),
    }
}

/// The message for a world, which is refused.
fn refused(world: &Value) -> String {
    match read(&world.to_string()) {
        Err(message) => message,
        Ok(_) => panic!("it is taken"),
    }
}

#[test]
fn many_of_everything_are_read() {
    let listed: Vec<Value> = (0..MANY).map(place).collect();
    let beside = |k: &Value| json!([k[0].as_f64().unwrap() + 0.5, k[1]]);
    let listed = json!({ "radius": 0.05, "positions": { "explicit":
        listed.iter().map(beside).collect::<Vec<_>>() } });
    let rods = (0..MANY).map(|k| json!([k % 150 + 200, k / 150]));
    let rods = json!({
        "shape": { "capsule": { "half_length": 0.2, "radius": 0.1 } },
        "positions": { "explicit": rods.collect::<Vec<_>>() }
    });
    let drawn = json!({
        "count": MANY, "radius": 0.1,
        "positions": { "box": { "min": [0, 200], "max": [150, 400] } }
    });
    let mut all = groups(MANY);
    all.extend([listed, rods, drawn]);
    let world = world(json!({ "agents": all, "obstacles": balls(MANY) }));
    let world = read(&world.to_string()).unwrap();
    assert_eq!(agents(&world), 4 * MANY);
    let AnyWorld::Plane(world) = world else {
        panic!("it is flat")
    };
    let begin = Instant::now();
    let mut simulation = Simulation::new(world).unwrap();
    simulation.step().unwrap();
    assert!(begin.elapsed() < PATIENCE, "it took {:?}", begin.elapsed());
}

#[test]
fn small_ones_among_large_ones_are_placed() {
    let group = |radius: f64, count: usize| {
        json!({
            "radius": radius, "count": count,
            "positions": { "box": { "min": [0, 0], "max": [4000, 4000] } }
        })
    };
    let all = [
        group(100.0, 20),
        group(0.1, MANY),
        group(7.0, 500),
        group(0.01, MANY),
    ];
    let world = read(&world(json!({ "agents": all })).to_string()).unwrap();
    assert_eq!(agents(&world), 2 * MANY + 520);
}

#[test]
fn many_mistakes_are_counted() {
    let mut many = world(json!({}));
    for k in 0..MANY {
        many[format!("x{k:05}")] = json!(k);
    }
    let message = refused(&many);
    let mut lines = message.lines();
    let first = lines.next().unwrap();
    assert!(
        first.contains(": x00000: unknown field; allowed: agents, "),
        "{first}"
    );
    assert_eq!(
        lines.next_back(),
        Some(&*format!("w.json: and {} more", MANY - 20))
    );
    let wrong =
        json!({ "agents": [{ "radius": 1, "positions": { "explicit": vec!["x"; MANY] } }] });
    let message = refused(&world(wrong));
    let says = "agents[0].positions.explicit[0] = \"x\": must be a list of numbers, not a string";
    assert!(message.contains(says), "{message}");
    // As many at one place: all but the first are in the way of one only.
    let heap =
        json!({ "agents": [{ "radius": 1, "positions": { "explicit": vec![[0, 0]; MANY] } }] });
    assert!(refused(&world(heap)).ends_with(&format!("and {} more", MANY - 21)));
    let rods = json!({ "agents": [{
        "shape": { "capsule": { "half_length": 0.2, "radius": 0.1 } },
        "positions": { "explicit": vec![[0, 0]; MANY] }
    }] });
    assert!(refused(&world(rods)).ends_with(&format!("and {} more", MANY - 21)));
    let mut twice = String::from("{");
    for k in 0..MANY {
        let _ = writeln!(twice, "\"time\": {k},");
    }
    twice += "\"dimension\": 2}";
    let message = read(&twice).unwrap_err();
    assert!(
        message.starts_with("w.json:2:1: time: is given twice, first on line 1"),
        "{message}"
    );
}

#[test]
fn names_are_looked_up() {
    let friction = json!({ "friction": { "coefficient": 0.1, "exponent": 0 } });
    let names = |names: Vec<String>| {
        world(json!({
            "agents": groups(MANY),
            "laws": [{ "scope": { "agents": names, "laws": [friction] } }]
        }))
    };
    let known = names((0..MANY).map(|k| format!("g{k}")).collect());
    assert_eq!(agents(&read(&known.to_string()).unwrap()), MANY);
    let unknown = refused(&names((0..MANY).map(|k| format!("h{k}")).collect()));
    let first = unknown.lines().next().unwrap();
    assert!(
        first.contains("laws[0].scope.agents[0] = \"h0\": names no group"),
        "{first}"
    );
    assert!(first.len() < 500, "{first}");
    let scopes = |count: usize| {
        let scope = |k| json!({ "scope": { "agents": [format!("g{k}")], "laws": [friction] } });
        let laws: Vec<Value> = (0..count).map(scope).collect();
        world(json!({ "agents": groups(5_000), "laws": laws }))
    };
    assert!(read(&scopes(MOST_LAWS).to_string()).is_ok());
    assert_eq!(
        refused(&scopes(MOST_LAWS + 1)).split_once(": ").unwrap().1,
        "laws: holds 1001 laws, those in scopes counted; allowed: at most 1000"
    );
}

#[test]
fn what_would_fill_the_memory_is_refused() {
    let heap: Vec<Value> = vec![json!({ "shape": { "ball": { "radius": 1 } } }); MANY];
    let message = refused(&world(json!({ "obstacles": heap })));
    assert!(message.contains("obstacles["), "{message}");
    assert!(
        message.ends_with("allowed: at most 10000000 pairs"),
        "{message}"
    );
    let floor = json!({ "shape": { "half_space": { "normal": [0, 1] } }, "position": [0, -20] });
    let message = refused(&world(
        json!({ "obstacles": vec![floor; MOST_UNBOUNDED + 1] }),
    ));
    assert!(
        message.contains("obstacles[1000].shape: makes 1001 parts without bounds"),
        "{message}"
    );
    let values = format!("[{}0]", "0,".repeat(MOST_VALUES));
    let message = read(&values).unwrap_err();
    assert_eq!(
        message,
        "w.json:1:1: the file holds 30000002 values: numbers, texts, lists and objects; \
         allowed: at most 30000000"
    );
    let message = read(&" ".repeat(MOST_BYTES + 1)).unwrap_err();
    assert_eq!(
        message,
        "w.json:1:1: the file is 268435457 bytes long; allowed: at most 268435456 (256 MiB)"
    );
}

#[test]
fn nets_of_all_pairs_are_refused() {
    let wide = |range: f64, links: bool| {
        refused(&world(json!({
            "agents": [{ "count": 15_000, "radius": 0.1, "positions":
                { "hexagonal": { "center": [0, 0], "spacing": 1 } } }],
            "laws": [
                { "pair_potential": { "potential": { "gaussian": { "height": 1, "decay": 1 } } } },
                { "alpha_interaction": { "spacing": 1, "range": range } }
            ],
            "record": { "links": links }
        })))
    };
    let message = wide(1e6, false);
    assert!(
        message.contains("laws[1].alpha_interaction.range = 1000000.0: makes about 1"),
        "{message}"
    );
    assert!(
        message.ends_with("edges of the proximity net; allowed: at most 100000000"),
        "{message}"
    );
    let message = wide(1.2, true);
    assert!(
        message.contains("record.links = true: records about 224985000 links"),
        "{message}"
    );
}

/// A compound in a compound and so on, with a ball in the innermost.
fn nested(depth: usize, ball: Value) -> Value {
    (0..depth).fold(
        json!({ "ball": ball }),
        |shape, _| json!({ "compound": { "parts": [{ "shape": shape }] } }),
    )
}

#[test]
fn nesting_costs_no_more_than_its_depth() {
    // Two or three looks at each level would be 2 or 3 to the power of 25.
    let shape = nested(25, json!({ "radius": 1 }));
    let obstacle = json!({ "obstacles": [{ "shape": shape, "position": [9, 9] }] });
    assert!(read(&world(obstacle).to_string()).is_ok());
    let shape = nested(25, json!({ "radiu": 1 }));
    let obstacle = json!({ "obstacles": [{ "shape": shape, "position": [9, 9] }] });
    let message = refused(&world(obstacle));
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.ends_with("did you mean `radius`?"), "{message}");
}

#[test]
fn reading_takes_little_of_the_callers_stack() {
    let shape = nested(25, json!({ "radiu": 1 }));
    let text = world(json!({ "obstacles": [{ "shape": shape }] })).to_string();
    let deep = "[".repeat(100_000);
    let thread = std::thread::Builder::new().stack_size(64 << 10);
    let reading = thread.spawn(move || {
        let long = format!("a{}=1", ".a".repeat(90))
            .parse::<Override>()
            .unwrap();
        let sets = [Vec::new(), vec![long]];
        let spec = |text: &str, sets: &Vec<Override>| {
            let document = Document::new("w.json", text).with(sets.clone());
            document.spec().is_err()
        };
        sets.iter()
            .all(|sets| spec(&text, sets) && spec(&deep, sets))
    });
    assert!(reading.unwrap().join().unwrap());
}

#[test]
fn overrides_have_bounds() {
    let parse = |text: &str| text.parse::<Override>().map_err(|error| error.to_string());
    assert!(parse(&format!("a{}=1", ".a".repeat(99))).is_ok());
    assert_eq!(
        parse(&format!("a{}=1", ".a".repeat(100))).unwrap_err(),
        "the path `a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.…` has 101 parts; allowed: at most 100, \
         which is deeper than any field lies"
    );
    let long = parse(&format!("{}=1", "a".repeat(20_000))).unwrap_err();
    assert!(
        long.ends_with("…` is too long; allowed: at most 10000 bytes"),
        "{long}"
    );
    let begin = Instant::now();
    // Each equals sign might end the path.
    assert!(parse(&format!("[{}", "=".repeat(100_000))).is_err());
    assert!(parse(&format!("description={}", "=".repeat(100_000))).is_ok());
    assert!(begin.elapsed() < PATIENCE);
}

#[test]
fn who_watches_sees_agents_placed_and_may_break_off() {
    let world = world(json!({ "agents": [{
        "count": 3 * MANY, "radius": 0.1,
        "positions": { "box": { "min": [0, 0], "max": [300, 300] } }
    }] }));
    let stages = Arc::new(Mutex::new(Vec::new()));
    let seen = Arc::clone(&stages);
    let document = Document::new("w.json", world.to_string());
    let watch = Watch::new(move |stage| {
        seen.lock().unwrap().push(stage);
        std::ops::ControlFlow::Continue(())
    });
    assert!(document.clone().watched(watch).world("w").is_ok());
    let stages = stages.lock().unwrap();
    assert_eq!(stages[..2], [Stage::Reading, Stage::Building]);
    let placed = stages[2..].iter().map(|stage| match stage {
        Stage::Placing { placed, of } if *of == 3 * MANY => *placed,
        other => panic!("{other:?}"),
    });
    assert!(placed.clone().is_sorted() && placed.count() > 10);
    let told = AtomicUsize::new(0);
    let watch = Watch::new(move |_| match told.fetch_add(1, Ordering::Relaxed) {
        ..5 => std::ops::ControlFlow::Continue(()),
        5 => std::ops::ControlFlow::Break(()),
        _ => panic!("it was told to stop"),
    });
    let report = document.watched(watch).world("w").unwrap_err();
    assert_eq!(
        report.to_string(),
        "w.json:1:1: was stopped before it was ready"
    );
}
