//! Forces between pairs, patterns, drag: against plain loops written from the papers, and what
//! the papers promise of them.

#[path = "../common/mod.rs"]
mod common;

mod drag;
mod pairs;
mod patterns;
mod promises;
mod summation;
mod symmetry;
mod worlds;

use common::{from_json, headings};
use serde_json::{Value, json};
use volary::law::{Flock, Law, State};
use volary::math::Vector;
use volary::shape::{Geometry, In};
use volary::world::World;

/// Positions, velocities and masses of some agents.
#[derive(Clone)]
struct Crowd<const D: usize> {
    at: Vec<Vector<D>>,
    v: Vec<Vector<D>>,
    mass: Vec<f64>,
}

impl<const D: usize> Crowd<D> {
    /// Agents somewhere within 3 of the origin along each axis, none nearer to another than
    /// 0.3, all masses different.
    fn new(count: usize, seed: u64) -> Self {
        let mut state = seed;
        let mut between = |low: f64, high: f64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut at: Vec<Vector<D>> = Vec::new();
        while at.len() < count {
            let place = Vector::from_fn(|_, _| between(-3.0, 3.0));
            if at.iter().all(|other| (other - place).norm() > 0.3) {
                at.push(place);
            }
        }
        let velocity = |_| Vector::from_fn(|_, _| between(-2.0, 2.0));
        Self {
            at,
            v: (0..count).map(velocity).collect(),
            mass: (0..count).map(|_| between(0.3, 2.0)).collect(),
        }
    }

    fn len(&self) -> usize {
        self.at.len()
    }

    /// A world with agents of these masses under some laws. They stand in groups of these
    /// sizes called `0`, `1`, … on a line, where no law puts them; the tests make up states.
    fn world(&self, groups: &[usize], laws: Value) -> World<D>
    where
        In<D>: Geometry<D>,
    {
        let mut first = 0;
        let groups = groups.iter().enumerate().map(|(name, &count)| {
            let of = first..first + count;
            first += count;
            let place = |k: usize| Vector::<D>::repeat(100.0 * k as f64);
            let places: Vec<Vec<f64>> = of.clone().map(|k| place(k).as_slice().to_vec()).collect();
            json!({
                "name": name.to_string(), "radius": 0.1, "mass": self.mass[of],
                "positions": { "explicit": places }
            })
        });
        common::world(from_json(json!({
            "dimension": D, "time": { "end": 1 },
            "agents": groups.collect::<Vec<_>>(), "laws": laws
        })))
    }

    /// What some laws of a world file do to the agents, all in one group.
    fn under(&self, laws: Value) -> Vec<Vector<D>>
    where
        In<D>: Geometry<D>,
    {
        self.in_groups(&[self.len()], laws)
    }

    /// The same, in groups of these sizes.
    fn in_groups(&self, groups: &[usize], laws: Value) -> Vec<Vector<D>>
    where
        In<D>: Geometry<D>,
    {
        let world = self.world(groups, laws);
        self.accelerations(Flock::of_world(&world, Vec::new()), &world.agents.group)
    }

    /// What a law made in Rust does to the agents.
    fn under_law(&self, law: impl Law<D> + 'static) -> Vec<Vector<D>> {
        self.accelerations(Flock::new(vec![Box::new(law)]), &vec![0; self.len()])
    }

    fn accelerations(&self, mut flock: Flock<D>, groups: &[usize]) -> Vec<Vector<D>> {
        let mut out = vec![Vector::zeros(); self.len()];
        let state = State {
            time: 0.0,
            positions: &self.at,
            velocities: &self.v,
            headings: &headings(&self.v),
            groups,
            masses: &self.mass,
            rotations: &[],
            obstacles: &[],
        };
        flock.accelerations(&state, &mut out);
        out
    }

    /// The sum over all others j of what a pair law gives i.
    fn sum_over_others(&self, i: usize, of: impl Fn(usize) -> Vector<D>) -> Vector<D> {
        (0..self.len())
            .filter(|&j| j != i)
            .map(of)
            .fold(Vector::zeros(), |sum, one| sum + one)
    }
}

/// The mean of some vectors, summed as it is written.
fn plain_mean<const D: usize>(vectors: &[Vector<D>]) -> Vector<D> {
    let sum = vectors.iter().fold(Vector::zeros(), |sum, one| sum + one);
    sum / vectors.len() as f64
}

/// Two results must be the same to rounding, and not nothing.
fn assert_same<const D: usize>(found: &[Vector<D>], expected: &[Vector<D>], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected.iter().map(|one| one.norm()).fold(1e-3, f64::max);
    assert!(
        expected.iter().any(|one| one.norm() > 1e-3),
        "{what}: nothing happens"
    );
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let error = (found - expected).norm() / size;
        assert!(error < 1e-12, "{what}, agent {i}: {error:e}");
    }
}
