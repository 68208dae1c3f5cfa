//! The claims of Djokam & Rathinam.

use crate::runs::{holds, plane, points, unmet, violated};
use volary::claim::Run;

#[test]
fn accelerations_keep_their_bound() {
    let world = plane("djokam-rathinam/fast-0.1", &["time.end=2"]);
    let run = points(&world);
    let finding = holds("djokam-rathinam/acceleration-bound", &run);
    // The law comes near its bound: at the start it stands at 0.97 of it.
    assert!(
        finding.margin.is_some_and(|margin| margin < 0.2),
        "{finding:?}"
    );

    let tighter = plane(
        "djokam-rathinam/fast-0.1",
        &["laws[0].alignment.gain.bounded.bound=5"],
    );
    let run = Run {
        world: &tighter,
        ..run
    };
    violated("djokam-rathinam/acceleration-bound", &run);

    let unbounded = plane(
        "djokam-rathinam/fast-0.1",
        &["time.end=1", "laws[0].alignment.gain=10"],
    );
    unmet("djokam-rathinam/acceleration-bound", &points(&unbounded));
}

#[test]
#[ignore]
fn explore() {
    use crate::runs::{shipped, point_states, seen, bodies};
    use volary::claim::claims;
    use volary::world::AnyWorld;
    fn show<const D: usize>(what: &str, run: &Run<'_, D>) {
        for claim in claims::<D>() {
            if let Some(it) = claim.judge(run) {
                println!("{what:20} {:42} {:?} m {:?} t {:?} {}", claim.about().name, it.verdict, it.margin, it.closest, it.reason);
                for q in it.quantities { print!("  {}={:?}", q.name, q.value); }
                println!();
            }
        }
    }
    fn go<const D: usize>(what: &str, world: &volary::world::World<D>, also: bool) where volary::shape::In<D>: volary::dynamics::Engine<D> {
        let now = std::time::Instant::now();
        let mut run = points(world);
        let found = claims::<D>().iter().find(|c| c.about().name.ends_with("leading-order-printed")).unwrap().companions(world);
        if also && !found.is_empty() {
            let made: Vec<_> = found.iter().map(|w| (w.clone(), seen(w, point_states(w)).observations)).collect();
            for n in ["leading-order-printed", "leading-order-corrected", "layer-limit-printed", "layer-limit-corrected"] {
                let n: &'static str = Box::leak(format!("djokam-rathinam/{n}").into_boxed_str());
                run.companions.insert(n, made.clone());
            }
        }
        show(what, &run);
        println!("{what} took {:?}", now.elapsed());
        if std::env::var("BODIES").is_ok() { 
            let now = std::time::Instant::now();
            let run = bodies(world);
            show(&format!("{what} BODIES"), &run);
            println!("{what} took {:?}", now.elapsed());
        }
    }
    let only = std::env::var("ONLY").unwrap_or_default();
    for (name, set) in [
        ("fast-0.1", vec!["time.end=3", "record.every=0.05"]),
        ("fast-0.01", vec!["time.end=3", "record.every=0.05"]),
        ("friction", vec!["record.every=1"]),
        ("friction-linear", vec!["record.every=0.5"]),
        ("flock-steered", vec!["record.every=0.2"]),
        ("parting-pair", vec!["record.every=0.2"]),
        ("mill-ring-unsteered", vec![]),
        ("mill-ring", vec!["time.end=5"]),
        ("mill-ring-3d", vec!["time.end=2"]),
        ("masking", vec!["time.end=1"]),
        ("line-of-sight", vec!["time.end=0.3"]),
    ] {
        if !name.contains(&only) { continue; }
        match shipped(&format!("djokam-rathinam/{name}"), &set) {
            AnyWorld::Plane(w) => go(name, &w, true),
            AnyWorld::Space(w) => go(name, &w, true),
        }
    }
}
