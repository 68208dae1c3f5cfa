//! Velocities that relax towards each other, followed exactly.
//!
//! Over a step the pulls of the laws that relax make the velocities obey
//! v̇_i = Σ g(|u_i|) u_i + b_i, u_i = Σ_j a_ij (v_j − v_i), with the influences a_ij and the
//! other accelerations b_i held. Where no gain depends on u the equation is linear and is
//! solved as it stands ([`linear`]). Otherwise time is cut into parts, each taken with
//! the gains in its middle, short enough that halving it makes next to no difference: second
//! order, and as every part is a mean of velocities plus what b adds, nothing leaves the convex
//! hull of the velocities for b = 0, however fast the gains are.

mod linear;
mod poisson;

use crate::law::{Pulls, Row};
use crate::math::{Gain, Vector, mean, shortened};
use linear::Linear;

/// Error of one part of a step that is let pass, as a share of how far the velocities are
/// apart.
const TOLERANCE: f64 = 1e-5;

/// The same as a share of the velocities themselves: rounding.
const ROUNDING: f64 = 1e-14;

/// How many parts of a step are tried with this tolerance, among some agents. What is left of the
/// step then, because gains fall off within a tiny difference of velocities, is taken in parts
/// that grow: still means of velocities, but no longer of second order. A part's work may grow
/// with the cube of the number of agents.
fn most_parts(agents: usize) -> usize {
    let cube = agents.saturating_mul(agents).saturating_mul(agents);
    (10_000_000 / cube.max(1)).clamp(100, 1000)
}

/// Where velocities that relax and are accelerated by `drift` besides are after some time.
///
/// Where all gains on an agent are bounded, what relaxing adds to its velocity is at most
/// the sum of the bounds times the time.
pub(super) fn relax<const D: usize>(
    pulls: &Pulls<D>,
    velocities: &[Vector<D>],
    drift: &[Vector<D>],
    time: f64,
) -> Vec<Vector<D>> {
    let linear = |row: &Row<D>| matches!(row.gain, Gain::Constant(_));
    let relaxed = if pulls.rows().iter().all(linear) {
        let rates = rates(pulls, velocities);
        Linear::new(pulls, &rates, drift).after(time, velocities)
    } else {
        in_parts(pulls, velocities, drift, time)
    };
    bounded(pulls, velocities, drift, time, relaxed)
}

/// The rate of each pull at these velocities.
fn rates<const D: usize>(pulls: &Pulls<D>, velocities: &[Vector<D>]) -> Vec<f64> {
    let rows = pulls.rows().iter();
    rows.map(|row| row.gain.at(pulls.drive(row, velocities).norm()))
        .collect()
}

fn in_parts<const D: usize>(
    pulls: &Pulls<D>,
    velocities: &[Vector<D>],
    drift: &[Vector<D>],
    time: f64,
) -> Vec<Vector<D>> {
    // A part with the rates in its middle: the midpoint rule of exponential integrators.
    let part = |from: &[Vector<D>], first: &[f64], time: f64| {
        let middle = Linear::new(pulls, first, drift).after(0.5 * time, from);
        Linear::new(pulls, &rates(pulls, &middle), drift).after(time, from)
    };
    let mut now = velocities.to_vec();
    let (mut left, mut length) = (time, time);
    let most = most_parts(velocities.len());
    // Velocities that are the same may be driven apart.
    let driven = spread(drift) * time;
    for count in 0.. {
        length = length.min(left);
        let first = rates(pulls, &now);
        let whole = part(&now, &first, length);
        let half = part(&now, &first, 0.5 * length);
        let halves = part(&half, &rates(pulls, &half), 0.5 * length);
        let apart = spread(&now) + driven;
        let allowed = TOLERANCE * apart + ROUNDING * largest(&now);
        // After a part that is far too long all agree, on what the gains were on the way, and
        // two such parts may agree with each other. The gains at the start tell otherwise.
        let plain = Linear::new(pulls, &first, drift).after(length, &now);
        let doubt = largest_difference(&whole, &plain);
        let doubt = if doubt > allowed {
            doubt * doubt / apart
        } else {
            0.0
        };
        let error = largest_difference(&whole, &halves).max(doubt);
        // What is not finite is found by who checks the state.
        let passes = error <= allowed || count >= most || !error.is_finite();
        if passes {
            now = halves;
            left -= length;
            if left <= 1e-14 * time {
                break;
            }
        }
        let factor = match count >= most || error == 0.0 {
            true => 2.0,
            false => (0.9 * libm::cbrt(allowed / error)).clamp(0.2, 5.0),
        };
        length = f64::max(length * factor, 1e-12 * time);
    }
    now
}

/// Keeps what the bounded gains promise to the last bit.
fn bounded<const D: usize>(
    pulls: &Pulls<D>,
    velocities: &[Vector<D>],
    drift: &[Vector<D>],
    time: f64,
    mut relaxed: Vec<Vector<D>>,
) -> Vec<Vector<D>> {
    let mut bounds = vec![0.0; velocities.len()];
    for row in pulls.rows() {
        bounds[row.agent] += match row.gain {
            Gain::Constant(_) => f64::INFINITY,
            Gain::Bounded { bound, .. } => bound,
        };
    }
    for (i, bound) in bounds.into_iter().enumerate() {
        let coasting = velocities[i] + drift[i] * time;
        let gained = relaxed[i] - coasting;
        if gained.norm() > bound * time && bound > 0.0 {
            relaxed[i] = coasting + shortened(gained, bound * time);
        }
    }
    relaxed
}

fn largest<const D: usize>(vectors: &[Vector<D>]) -> f64 {
    vectors.iter().map(Vector::amax).fold(0.0, f64::max)
}

fn spread<const D: usize>(vectors: &[Vector<D>]) -> f64 {
    let center = mean(vectors);
    let far = vectors.iter().map(|vector| (vector - center).amax());
    far.fold(0.0, f64::max)
}

fn largest_difference<const D: usize>(a: &[Vector<D>], b: &[Vector<D>]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).amax());
    differences.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_agents_with_bounded_gains_follow_their_equation() {
        let gain = Gain::Bounded {
            bound: 10.0,
            scale: 0.3,
        };
        let half = vec![vec![0.5, 0.5], vec![0.5, 0.5]];
        let pulls = Pulls::by_matrix(&[gain; 2], &half);
        let start = [Vector::<2>::new(3.0, 1.0), Vector::<2>::new(-1.0, 4.0)];
        let rest = [Vector::zeros(); 2];
        let apart = start[0] - start[1];
        // d' = −ξ(d/2) d for the distance d of the velocities.
        let slope = |d: f64| -10.0 * d / f64::hypot(0.3, d / 2.0);
        for time in [0.01, 0.1, 0.4, 3.0] {
            let mut d = apart.norm();
            let h = time / 10_000.0;
            for _ in 0..10_000 {
                let k1 = slope(d);
                let k2 = slope(d + 0.5 * h * k1);
                let k3 = slope(d + 0.5 * h * k2);
                d += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + slope(d + h * k3));
            }
            let found = relax(&pulls, &start, &rest, time);
            let wanted = apart.normalize() * d;
            let error = (found[0] - found[1] - wanted).norm();
            assert!(error < 3e-4, "{time}: {error}");
            assert!((found[0] + found[1] - start[0] - start[1]).norm() < 1e-12);
        }
    }

    #[test]
    fn nobody_gains_more_than_the_bound() {
        let gain = Gain::Bounded {
            bound: 0.7,
            scale: 1e-3,
        };
        let pulls = Pulls::by_matrix(&[gain; 3], &vec![vec![1.0 / 3.0; 3]; 3]);
        let start = [
            Vector::<2>::new(100.0, 0.0),
            Vector::<2>::new(-3.0, 40.0),
            Vector::<2>::new(0.0, -70.0),
        ];
        for time in [1e-3, 0.5, 20.0] {
            let found = relax(&pulls, &start, &[Vector::zeros(); 3], time);
            for (found, start) in found.iter().zip(&start) {
                // The bound holds to rounding of the velocities themselves.
                assert!((found - start).norm() <= 0.7 * time + 1e-13);
            }
        }
    }

    /// From rest, driven apart: u_1 = 5 t less what the bounded gain takes back.
    #[test]
    fn velocities_that_are_the_same_are_driven_apart() {
        let gain = Gain::Bounded {
            bound: 4.0,
            scale: 0.01,
        };
        let half = vec![vec![0.5, 0.5], vec![0.5, 0.5]];
        let pulls = Pulls::by_matrix(&[gain; 2], &half);
        let drift = [Vector::<2>::new(5.0, 0.0), Vector::<2>::new(-5.0, 0.0)];
        let found = relax(&pulls, &[Vector::zeros(); 2], &drift, 0.1);
        let (mut v, h) = (0.0, 0.1 / 100_000.0);
        let slope = |v: f64| 5.0 - 4.0 * v / f64::hypot(0.01, v);
        for _ in 0..100_000 {
            v += h * slope(v + 0.5 * h * slope(v));
        }
        assert!((found[0][0] - v).abs() < 1e-3 * v, "{} {v}", found[0][0]);
        assert!((found[0] + found[1]).norm() < 1e-12);
    }

    /// A ring, where agreement is slow, with gains that fall off within a tiny difference.
    #[test]
    fn the_stiffest_gains_take_a_bounded_number_of_parts() {
        let gain = Gain::Bounded {
            bound: 10.0 / 1e-6,
            scale: 1e-8,
        };
        let ring = |i: usize| {
            (0..8)
                .map(move |j| f64::from(u8::from((i + 1) % 8 == j)))
                .collect()
        };
        let pulls = Pulls::by_matrix(&[gain; 8], &(0..8).map(ring).collect::<Vec<_>>());
        let start: Vec<_> = (0..8)
            .map(|i| Vector::<2>::new(f64::from(i * i % 5), 1.0))
            .collect();
        let drift: Vec<_> = (0..8)
            .map(|i| Vector::<2>::new(0.0, f64::from(i)))
            .collect();
        let found = relax(&pulls, &start, &drift, 0.01);
        for velocity in found {
            assert!((-1e-9..=4.0 + 1e-9).contains(&velocity[0]), "{velocity}");
            assert!((0.0..1.2).contains(&velocity[1]), "{velocity}");
        }
    }
}
