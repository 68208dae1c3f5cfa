//! Pairs that the laws drive back to a distance from both sides slide there, as Filippov has it.

use serde_json::json;
use volary::law::Law;
use volary::math::Vector;
use volary::sense::Scene;
use volary::world::World;

use crate::common::{spec, world};
use crate::reference::run_to;
use volary::dynamics::{Accuracy, Dynamics};
use volary::simulation::{Pause, Simulation};
use volary::stop::Stop;

const RANGE: f64 = 2.0;
const PUSH: f64 = 3.0;

/// A push within a range that ends at once, or on a slope of some width; a spring to the middle
/// of the world, drag, and what turns all about the middle.
struct Fence {
    /// The width of the slope, as a share of the range; 0 for a jump.
    width: f64,
    drag: f64,
    turn: f64,
}

impl Law<2> for Fence {
    fn name(&self) -> &str {
        "fence"
    }

    fn range(&self) -> f64 {
        RANGE * (1.0 + 0.5 * self.width)
    }

    fn jump(&self) -> Option<f64> {
        (self.width == 0.0).then_some(RANGE)
    }

    fn accelerate(&self, scene: &Scene<'_, 2>, first: usize, out: &mut [Vector<2>]) {
        for (k, out) in out.iter_mut().enumerate() {
            let i = first + k;
            let place = scene.positions[i];
            *out -= place * 0.7 + scene.velocities[i] * self.drag;
            *out += Vector::<2>::new(-place[1], place[0]) * self.turn;
            scene.neighbours(i, Law::<2>::range(self), |other| {
                let distance = other.squared.sqrt();
                let share = match self.width == 0.0 {
                    true => 1.0,
                    false => (0.5 - (distance / RANGE - 1.0) / self.width).clamp(0.0, 1.0),
                };
                *out -= other.offset * (PUSH * share * other.weight / distance);
            });
        }
    }
}

fn start(places: &[[f64; 2]], velocities: &[[f64; 2]]) -> World<2> {
    world(spec(json!({
        "dimension": 2,
        "time": { "step": 0.05, "end": 8 },
        "record": { "every": 8 },
        "agents": [{
            "radius": 1e-3,
            "positions": { "explicit": places }, "velocities": { "explicit": velocities }
        }]
    })))
}

fn run(world: World<2>, fence: Fence, time: f64) -> (Simulation<2>, Vec<Vector<2>>) {
    let dynamics = Dynamics::Points(Accuracy { relative: 1e-9 });
    let mut simulation =
        Simulation::with_dynamics(world, vec![Box::new(fence)], dynamics).expect("a start");
    run_to(&mut simulation, time);
    let state = simulation.snapshot();
    let all = [state.positions, state.velocities].concat();
    (simulation, all)
}

fn compare(places: &[[f64; 2]], velocities: &[[f64; 2]], slides: &[[usize; 2]]) {
    for time in [12.0, 14.0] {
        let at = |width| {
            run(
                start(places, velocities),
                Fence {
                    width,
                    drag: 6.0,
                    turn: 4.0,
                },
                time,
            )
        };
        let (simulation, sliding) = at(0.0);
        let (_, steep) = at(1e-4);
        let (_, gentle) = at(2e-4);
        let apart = |a: &[Vector<2>], b: &[Vector<2>]| {
            let apart = a.iter().zip(b).map(|(a, b)| (a - b).norm());
            apart.fold(0.0, f64::max)
        };
        let (error, its_own) = (apart(&sliding, &steep), apart(&steep, &gentle));
        let jumps = simulation.solver().expect("points").jumps;
        println!("{time}: {error:e}, {its_own:e}, {jumps} jumps");
        assert!(error < 2.0 * its_own + 1e-5, "{time}: {error} {its_own}");
        for &[i, j] in slides {
            let distance = (sliding[i] - sliding[j]).norm();
            assert!((distance - RANGE).abs() < 1e-7, "{time}: {distance}");
        }
    }
}

#[test]
fn a_pair_slides_while_it_turns() {
    compare(
        &[[-0.9, 0.1], [0.9, 0.0]],
        &[[0.0, -0.8], [0.1, 0.7]],
        &[[0, 1]],
    );
}

/// Each with each: three weights that depend on each other.
#[test]
fn three_slide_at_once() {
    compare(
        &[[-1.0, -0.5], [1.0, -0.6], [0.1, 1.1]],
        &[[0.2, 0.0], [0.0, 0.1], [0.0, 0.0]],
        &[[0, 1], [1, 2], [0, 2]],
    );
}

/// Without drag the pair comes and goes for good: a bounded number of times in each step.
#[test]
fn what_swings_about_a_jump_ends() {
    let world = start(&[[-1.0 - 1e-6, 0.0], [1.0, 0.0]], &[[0.0; 2]; 2]);
    let fence = Fence {
        width: 0.0,
        drag: 0.0,
        turn: 0.0,
    };
    let (simulation, end) = run(world, fence, 8.0);
    let jumps = simulation.solver().expect("points").jumps;
    assert!(jumps <= 200 * 160, "{jumps}");
    assert!(((end[0] - end[1]).norm() - RANGE).abs() < 1e-5);
}

/// A step of the world that would take for ever ends where it is asked to, and has not been.
#[test]
fn a_step_stops_where_it_is_asked_to() {
    let mut spec = start(&[[-0.9, 0.1], [0.9, 0.0]], &[[0.0, -0.8], [0.1, 0.7]]).spec;
    spec.time.step = 1e6;
    spec.time.end = 1e6;
    spec.record.every = 1e6;
    let fence = Fence {
        width: 1e-4,
        drag: 0.0,
        turn: 0.0,
    };
    let dynamics = Dynamics::Points(Accuracy { relative: 1e-12 });
    let mut simulation =
        Simulation::with_dynamics(world::<2>(spec), vec![Box::new(fence)], dynamics)
            .expect("a start");
    let stop = Stop::default();
    simulation.heed(stop.clone());
    let before = simulation.snapshot().positions.to_vec();
    let mut frames = 0;
    let mut record = |_| {
        frames += 1;
        Ok::<(), ()>(())
    };
    let asked = std::thread::scope(|scope| {
        let asker = scope.spawn(|| {
            std::thread::sleep(std::time::Duration::from_millis(200));
            stop.ask();
            std::time::Instant::now()
        });
        let pause =
            simulation.advance(1, &mut record, &mut |_| std::ops::ControlFlow::Continue(()));
        assert_eq!(pause, Ok(Pause::Stopped));
        let over = std::time::Instant::now();
        over.duration_since(asker.join().expect("no panic"))
    });
    assert!(asked.as_secs_f64() < 0.2, "{asked:?}");
    assert_eq!(simulation.snapshot().positions, before);
    assert_eq!(simulation.snapshot().step, 0);
    // The frame of this state has been recorded once, and is not again.
    assert_eq!(frames, 1);
}
