//! The papers' worlds agree with an independent integration: to 8 digits at time 10 and to 6
//! at time 50.

use volary::math::{DormandPrince, Solution};

use crate::reference::{difference_from, flat, integrate, points, run_to, shipped_world};

/// Half a unit of the 8th and of the 6th digit.
const DIGITS: [(f64, f64); 2] = [(10.0, 0.5e-8), (50.0, 0.5e-6)];

type Slope = Box<dyn FnMut(f64, &[f64], &mut [f64])>;

/// Adds Σ_j f(i, j, x_j − x_i, v_j − v_i) to each acceleration, plain loops over all pairs.
fn each_other(
    y: &[f64],
    out: &mut [f64],
    mut f: impl FnMut(usize, usize, [f64; 2], [f64; 2]) -> [f64; 2],
) {
    let n = y.len() / 4;
    let at = |k: usize| [y[2 * k], y[2 * k + 1]];
    for i in 0..n {
        for j in (0..n).filter(|j| *j != i) {
            let (a, b, va, vb) = (at(i), at(j), at(n + i), at(n + j));
            let force = f(
                i,
                j,
                [b[0] - a[0], b[1] - a[1]],
                [vb[0] - va[0], vb[1] - va[1]],
            );
            out[2 * (n + i)] += force[0];
            out[2 * (n + i) + 1] += force[1];
        }
    }
}

fn coast(y: &[f64], out: &mut [f64]) {
    let half = y.len() / 2;
    out[..half].copy_from_slice(&y[half..]);
    out[half..].fill(0.0);
}

/// Djokam & Rathinam, section 5: (4.1) with a target on a circle.
fn djokam_rathinam(epsilon: f64) -> Slope {
    Box::new(move |t, y, out| {
        coast(y, out);
        let n = y.len() / 4;
        let mut sums = vec![[1.0, 0.0, 0.0]; n];
        for i in 0..n {
            for j in (0..n).filter(|j| *j != i) {
                let (dx, dy) = (y[2 * j] - y[2 * i], y[2 * j + 1] - y[2 * i + 1]);
                let influence = (1.0 + dx * dx + dy * dy).powf(-0.3);
                sums[i][0] += influence;
                for k in 0..2 {
                    sums[i][1 + k] += influence * (y[2 * (n + j) + k] - y[2 * (n + i) + k]);
                }
            }
        }
        let (sin, cos) = (std::f64::consts::FRAC_PI_2 - 0.1 * t).sin_cos();
        let target = [100.0 + 10.0 * cos, 10.0 + 10.0 * sin];
        let course = [sin, -cos];
        for i in 0..n {
            let u = [sums[i][1] / sums[i][0], sums[i][2] / sums[i][0]];
            let gain = 10.0 / (0.1 + u[0] * u[0] + u[1] * u[1]).sqrt() / epsilon;
            for k in 0..2 {
                let (x, v) = (y[2 * i + k], y[2 * (n + i) + k]);
                out[2 * (n + i) + k] = gain * u[k] + 2.0 * (course[k] - v) + 0.1 * (target[k] - x);
            }
        }
    })
}

/// Song et al., (8) and (17): `pull` times the way to each other agent.
fn song(exponent: f64, height: f64, decay: f64, pull: fn(f64) -> f64) -> Slope {
    Box::new(move |_, y, out| {
        coast(y, out);
        each_other(y, out, |_, _, way, turn| {
            let squared = way[0] * way[0] + way[1] * way[1];
            let align = (1.0 + squared).powf(-exponent);
            let push = 2.0 * height * decay * (-decay * squared).exp();
            let pull = pull(squared.sqrt()) - push;
            [0, 1].map(|k| align * turn[k] + pull * way[k])
        });
    })
}

/// Li, Liu & Wu, (14) and (15): alignment, by N or by the sum of influences, and a way to the
/// pattern from the mean.
fn li_liu_wu(exponent: f64, by_sum: bool, way: fn([f64; 2]) -> [f64; 2]) -> Slope {
    Box::new(move |_, y, out| {
        coast(y, out);
        let n = y.len() / 4;
        let influence = |squared: f64| (1.0 + squared).powf(-exponent);
        let mut sums = vec![1.0; n];
        each_other(y, out, |i, _, way, turn| {
            let weight = influence(way[0] * way[0] + way[1] * way[1]);
            sums[i] += weight;
            turn.map(|turn| weight * turn)
        });
        let mean = [0, 1].map(|k| (0..n).map(|i| y[2 * i + k]).sum::<f64>() / n as f64);
        let ways: Vec<_> = (0..n)
            .map(|i| way([y[2 * i] - mean[0], y[2 * i + 1] - mean[1]]))
            .collect();
        let all: f64 = ways.iter().map(|way| way[0].hypot(way[1])).sum();
        for i in 0..n {
            let divisor = if by_sum { sums[i] } else { n as f64 };
            for k in 0..2 {
                let acceleration = &mut out[2 * (n + i) + k];
                *acceleration = *acceleration / divisor + ways[i][k] / (1.0 + all);
            }
        }
    })
}

/// Runs a shipped world as points, with states every `step`, against the reference.
fn agrees(name: &str, step: f64, solver: &str, slope: Slope) {
    agrees_to(1e-11, name, step, solver, slope);
}

/// The same to some accuracy, and the reference to a hundredth of it.
fn agrees_to(relative: f64, name: &str, step: f64, solver: &str, mut slope: Slope) {
    let sets = [
        format!("time.step={step}"),
        "time.end=50".to_owned(),
        "record.every=10".to_owned(),
    ];
    let world = shipped_world(name, &sets.each_ref().map(String::as_str));
    let mut y = flat(&world.agents.positions, &world.agents.velocities);
    let mut simulation = points(world, relative);
    let found = simulation.solver().expect("points have a solver").method;
    assert!(found.starts_with(solver), "{name}: {found}");
    let mut t = 0.0;
    for (time, allowed) in DIGITS {
        run_to(&mut simulation, time);
        y = match solver {
            // Explicit and implicit methods check each other where equations are stiff.
            "Radau" => {
                let mut solution =
                    Solution::new(&mut slope, DormandPrince::default(), t, y, 0.1 * relative);
                solution.advance_to(time).expect("finite numbers");
                solution.state().to_vec()
            }
            _ => integrate(&mut slope, [t, time], y, 0.01 * relative),
        };
        t = time;
        let apart = difference_from(&simulation, &y);
        println!("{name} at {time}: {apart:e}");
        assert!(apart < allowed, "{name} at {time}: {apart:e}");
    }
}

#[test]
fn fast_flocks_of_djokam_and_rathinam() {
    agrees(
        "djokam-rathinam/fast-0.1",
        0.05,
        "Dormand",
        djokam_rathinam(0.1),
    );
    agrees(
        "djokam-rathinam/fast-0.01",
        0.1,
        "Radau",
        djokam_rathinam(0.01),
    );
    agrees(
        "djokam-rathinam/fast-0.001",
        0.1,
        "Radau",
        djokam_rathinam(0.001),
    );
}

#[test]
fn bonds_of_song_and_others() {
    let bond = |r: f64| 0.01 * (1.0 - 1.5 / r);
    agrees(
        "song-2013/example-18",
        0.1,
        "Dormand",
        song(0.5, 140.0, 3.0, bond),
    );
    let attraction = |_: f64| 0.01 / 10.0;
    agrees(
        "song-2013/example-19",
        0.1,
        "Dormand",
        song(0.95, 40.0, 1.8, attraction),
    );
}

#[test]
fn patterns_of_li_liu_and_wu() {
    let line = |y: [f64; 2]| [0.5 * (y[1] - y[0]), 0.5 * (y[0] - y[1])];
    agrees_to(
        1e-10,
        "li-liu-wu/figure-1",
        0.5,
        "Dormand",
        li_liu_wu(0.1, false, line),
    );
    let line = |y: [f64; 2]| [-0.5 * (y[0] + y[1]), -0.5 * (y[0] + y[1])];
    agrees_to(
        1e-10,
        "li-liu-wu/figure-2",
        0.5,
        "Dormand",
        li_liu_wu(0.1, true, line),
    );
    fn ring<const R: i32>(y: [f64; 2]) -> [f64; 2] {
        let share = f64::from(R) / y[0].hypot(y[1]) - 1.0;
        y.map(|y| share * y)
    }
    agrees_to(
        1e-10,
        "li-liu-wu/figure-3",
        0.5,
        "Dormand",
        li_liu_wu(1.0 / 6.0, false, ring::<5>),
    );
    agrees_to(
        1e-10,
        "li-liu-wu/figure-4",
        0.5,
        "Dormand",
        li_liu_wu(0.1, true, ring::<4>),
    );
}

/// Shi, Wang & Chu, (6). Of the graph, which the program draws, the weights are asked for; all
/// else is a plain loop.
#[test]
fn ten_agents_of_shi_wang_and_chu() {
    let name = "shi-wang-chu/ideal";
    let world = shipped_world(name, &[]);
    let masses = world.agents.mass.clone();
    let n = masses.len();
    // Pulled by one agent alone that moves at speed 1, another one's force is the weight.
    let weight = |i: usize, j: usize| {
        let mut velocities = vec![volary::math::Vector::<2>::zeros(); n];
        let at: Vec<_> = (0..n)
            .map(|k| volary::math::Vector::<2>::new(1e3 * k as f64, 0.0))
            .collect();
        let rest = crate::common::accelerations(&world, 0.0, &at, &velocities)[i];
        velocities[j][0] = 1.0;
        let pulled = crate::common::accelerations(&world, 0.0, &at, &velocities)[i];
        (pulled - rest)[0] * masses[i]
    };
    let weights: Vec<Vec<f64>> = (0..n)
        .map(|i| {
            (0..n)
                .map(|j| if i == j { 0.0 } else { weight(i, j) })
                .collect()
        })
        .collect();
    assert_eq!(weights.iter().flatten().filter(|w| **w > 1e-9).count(), 24);
    let slope = move |_: f64, y: &[f64], out: &mut [f64]| {
        coast(y, out);
        each_other(y, out, |i, j, way, turn| {
            let squared = way[0] * way[0] + way[1] * way[1];
            // V = a ln r² + b/r², a = 1/2, b = 5/2.
            let pull = (1.0 - 5.0 / squared) / squared;
            [0, 1].map(|k| (weights[i][j] * turn[k] + pull * way[k]) / masses[i])
        });
    };
    agrees(name, 0.25, "Dormand", Box::new(slope));
}
