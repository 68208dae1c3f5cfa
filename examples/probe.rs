//! Scratch: one part of the step in a loop, for a profiler.
use serde_json::json;
use volary::dynamics::{Bodies, Drive, Engine};
use volary::law::{Flock, build};
use volary::shape::In;
use volary::world::World;

struct Clock(f64);
impl Clock {
    fn read() -> f64 {
        let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
        text.split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-9
    }
    fn now() -> Self {
        Self(Self::read())
    }
    fn elapsed(&self) -> f64 {
        Self::read() - self.0
    }
}

fn world<const D: usize>(agents: usize, range: f64) -> World<D>
where
    In<D>: Engine<D>,
{
    let side = 7.0 * (agents as f64 * if D == 2 { 0.95 } else { 0.85 }).powf(1.0 / D as f64);
    let obstacles: Vec<_> = (0..6)
        .map(|k| {
            let mut at = vec![side * (0.2 + 0.1 * f64::from(k)); D];
            at[0] = side + 40.0 + 30.0 * f64::from(k);
            json!({ "shape": { "ball": { "radius": 8 } }, "position": at })
        })
        .collect();
    let mut velocity = vec![0.0; D];
    velocity[0] = 10.0;
    let spec = json!({
        "dimension": D,
        "time": { "step": 0.01, "end": 1 },
        "agents": [{
            "count": agents, "radius": 0.5,
            "positions": { "box": {
                "min": vec![0.0; D], "max": vec![side; D], "separation": 4.5
            } },
            "velocities": { "common": velocity }
        }],
        "obstacles": obstacles,
        "laws": [
            { "alpha_interaction": { "spacing": 7, "range": range, "damping": 1 } },
            { "obstacle_avoidance": {
                "range": 4.2, "standoff": 3, "gain": 10, "damping": 0.1,
                "gamma": { "spacing": 2 }
            } },
            { "navigation": { "velocity": velocity, "velocity_gain": 2 } }
        ]
    });
    let spec = serde_json::from_value(spec).expect("the world is well formed");
    World::new("benchmark", spec).expect("the world is sound")
}

fn go<const D: usize>(what: &str, agents: usize, seconds: f64)
where
    In<D>: Engine<D>,
{
    let range = std::env::var("RANGE")
        .ok()
        .and_then(|x| x.parse().ok())
        .unwrap_or(8.4);
    let world = world::<D>(agents, range);
    let mut flock = Flock::new(build(&world));
    let mut bodies = Bodies::new(&world, &mut flock).expect("a finite start");
    let mut engine = <In<D> as Engine<D>>::physics(&world);
    let still = Drive {
        forces: &[],
        steering: &[],
        obstacles: &world.obstacles,
    };
    let mut out = vec![volary::math::Vector::zeros(); agents];
    for _ in 0..(1_000_000 / agents).clamp(5, 1000) {
        bodies.step(&mut flock).expect("finite");
        engine.step(still);
    }
    let links = flock.links(&bodies.state()).len() as f64 / agents as f64;
    let begin = Clock::now();
    let mut n = 0;
    let mut best = f64::INFINITY;
    while begin.elapsed() < seconds {
        let t = Clock::now();
        let rounds = (20_000 / agents).max(1);
        for _ in 0..rounds {
            match what {
                "whole" => bodies.step(&mut flock).expect("finite"),
                "bare" => engine.step(still),
                _ => flock.accelerations(&bodies.state(), &mut out),
            }
        }
        best = f64::min(best, t.elapsed() / (rounds * agents) as f64);
        n += rounds;
    }
    let per = begin.elapsed() / (n * agents) as f64;
    println!(
        "{D} {agents} {what}: mean {:.4} best {:.4} µs; {links:.1} neighbours",
        per * 1e6,
        best * 1e6
    );
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let (d, n, what) = (&args[1], args[2].parse().unwrap(), &args[3]);
    let seconds = args.get(4).map_or(3.0, |s| s.parse().unwrap());
    let threads = args.get(5).map_or(1, |s| s.parse().unwrap());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads").install(|| match d.as_str() {
        "2" => go::<2>(what, n, seconds),
        _ => go::<3>(what, n, seconds),
    });
}
