//! What blows do to bodies: impulses at spots where surfaces meet at the same time.
//!
//! Spots that approach each other are turned back together: their normal impulses J solve
//! 0 ≤ J ⟂ u⁺ + e u⁻ ≥ 0, with u the speeds of separation before and after and e the
//! restitution (J. J. Moreau, "Unilateral contact and dry friction in finite freedom dynamics",
//! 1988). What approaches thereafter, because it was pushed, is turned back in the next round;
//! so blows run through a row of bodies one after the other, while those that fall together act
//! together (B. Smith, D. M. Kaufman, E. Vouga, R. Tamstorf & E. Grinspun, "Reflections on
//! simultaneous impact", 2012). No round adds energy, and with e = 1 none is lost.
//!
//! Each round ends with friction: an impulse against sliding at each spot, as large as it takes
//! to stop it, but at most μ times the normal impulse of the round (Coulomb). Where nothing
//! bounces, normal impulses and friction are found together.

mod friction;
#[cfg(test)]
mod tests;

use super::meet::slowest;
use super::way::{embed, project};
use crate::math::{Matrix, Vector};
use friction::Rub;

/// Rounds of bounces after which all spots of a cluster are stopped together.
const ROUNDS: usize = 300;

/// Rounds after which slow approach counts as none.
const PATIENT: usize = 40;

/// Spots that settle together to rounding, and the passes over them in which they do; where there
/// are more, fewer passes must do: what they leave is for the next round.
const FEW: (usize, usize) = (12, 2000);
const PASSES: usize = 60;

/// A body struck.
#[derive(Debug, Clone)]
pub(super) struct Struck<const D: usize> {
    pub(super) velocity: Vector<D>,
    pub(super) spin: Vector<3>,
    pub(super) inverse_mass: f64,
    /// Inverse inertia tensor in the world; zero of what cannot turn.
    pub(super) inverse_inertia: Matrix<3>,
}

/// A spot where two surfaces touch.
#[derive(Debug, Clone)]
pub(super) struct Spot<const D: usize> {
    /// The body, and the other one; nothing where that is an obstacle.
    pub(super) one: usize,
    pub(super) other: Option<usize>,
    /// From the centres to the spot.
    pub(super) arms: [Vector<3>; 2],
    /// Unit normal, from the one to the other.
    pub(super) normal: Vector<D>,
    /// How fast the obstacle's surface moves there.
    pub(super) surface: Vector<D>,
    pub(super) restitution: f64,
    pub(super) friction: f64,
    /// The speed of approach that is left to the engine.
    pub(super) slow: f64,
    /// Whose spot it is, for those who ask.
    pub(super) pair: usize,
    /// Normal and friction impulse so far.
    pub(super) normal_impulse: f64,
    pub(super) friction_impulse: f64,
    /// The highest speed of approach that was turned back.
    pub(super) approach: f64,
}

/// What the spots of a pair came to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Impulse {
    /// Normal and friction impulse.
    pub(super) normal: f64,
    pub(super) friction: f64,
    /// The highest speed of approach that was turned back.
    pub(super) approach: f64,
}

/// Bodies that touch, and the spots where they do.
#[derive(Debug, Default)]
pub(super) struct Cluster<const D: usize> {
    pub(super) bodies: Vec<Struck<D>>,
    pub(super) spots: Vec<Spot<D>>,
    /// Whether bounces were too many to be told apart.
    pub(super) unordered: bool,
    /// The highest speed so far, against which speeds are small.
    pub(super) fastest: f64,
}

impl<const D: usize> Cluster<D> {
    /// Lets the spots that approach each other bounce, and what they push, until none
    /// does. `more` is asked for the spots of each body that was struck, once.
    pub(super) fn bounce(&mut self, mut more: impl FnMut(&mut Self, usize)) {
        let mut struck: Vec<usize> = (0..self.bodies.len()).collect();
        let mut asked = vec![false; self.bodies.len()];
        let mut active: Vec<usize> = Vec::new();
        for round in 0.. {
            for body in std::mem::take(&mut struck) {
                if !std::mem::replace(&mut asked[body], true) {
                    more(self, body);
                    asked.resize(self.bodies.len(), false);
                }
            }
            let approach = self.approaching(round >= PATIENT);
            if approach.is_empty() {
                return;
            }
            let mut together = approach.clone();
            let stopped = round >= ROUNDS;
            self.unordered |= stopped;
            // What does not bounce stays together while others push it: so no endless row of
            // ever smaller blows is needed.
            let kept = active.iter().copied();
            together.extend(kept.filter(|&k| stopped || self.spots[k].restitution == 0.0));
            together.sort_unstable();
            together.dedup();
            let wanted: Vec<f64> = together
                .iter()
                .map(|&k| match approach.binary_search(&k) {
                    Ok(_) if !stopped => -self.spots[k].restitution * self.separation(k),
                    _ => 0.0,
                })
                .collect();
            self.turn_back(&together, &wanted);
            active.extend(approach);
            active.sort_unstable();
            active.dedup();
            for &k in &together {
                let spot = &self.spots[k];
                struck.extend([Some(spot.one), spot.other].into_iter().flatten());
            }
            struck.sort_unstable();
            struck.dedup();
            if round >= ROUNDS + PATIENT {
                return;
            }
        }
    }

    /// Stops what approaches each other, without any bounce.
    pub(super) fn stop(&mut self) {
        let mut together: Vec<usize> = Vec::new();
        for round in 0..PATIENT {
            let more = self.approaching(round >= PATIENT / 4);
            if more.is_empty() {
                return;
            }
            together.extend(more);
            together.sort_unstable();
            together.dedup();
            let wanted = vec![0.0; together.len()];
            self.turn_back(&together, &wanted);
        }
    }

    /// The spots that approach each other faster than is passed over: to rounding, or where patience
    /// is over a little more; or than is left to the engine.
    fn approaching(&mut self, late: bool) -> Vec<usize> {
        let least = self.least() * if late { 1e7 } else { 1.0 };
        (0..self.spots.len())
            .filter(|&k| self.separation(k) < -least.max(self.spots[k].slow))
            .collect()
    }

    /// What the spots of each of some pairs came to so far.
    pub(super) fn impulses(&self, pairs: usize) -> Vec<Impulse> {
        let none = Impulse {
            normal: 0.0,
            friction: 0.0,
            approach: f64::NEG_INFINITY,
        };
        let mut sums = vec![none; pairs];
        for spot in &self.spots {
            let sum = &mut sums[spot.pair];
            sum.normal += spot.normal_impulse;
            sum.friction += spot.friction_impulse;
            sum.approach = sum.approach.max(spot.approach);
        }
        sums
    }

    /// The speed of separation at a spot; negative where the surfaces approach each other.
    pub(super) fn separation(&self, spot: usize) -> f64 {
        -self.slip(spot).dot(&self.spots[spot].normal)
    }

    /// The velocity of the one surface against the other at a spot.
    fn slip(&self, spot: usize) -> Vector<D> {
        let spot = &self.spots[spot];
        let velocity = |body: usize, arm: &Vector<3>| {
            let body = &self.bodies[body];
            match body.spin.amax() == 0.0 {
                true => body.velocity,
                false => body.velocity + project(&body.spin.cross(arm)),
            }
        };
        let other = match spot.other {
            Some(other) => velocity(other, &spot.arms[1]),
            None => spot.surface,
        };
        velocity(spot.one, &spot.arms[0]) - other
    }

    /// The slowest approach that is told from none.
    fn least(&mut self) -> f64 {
        let fastest = |sum: f64, body: &Struck<D>| sum.max(body.velocity.amax());
        let surface = |sum: f64, spot: &Spot<D>| sum.max(spot.surface.amax());
        let fastest = self.bodies.iter().fold(0.0, fastest);
        let fastest = self.spots.iter().fold(fastest, surface);
        // Also what has come to rest since: its rounding is that of the speeds it had.
        self.fastest = self.fastest.max(fastest);
        2.0 * slowest(self.fastest)
    }

    /// Finds the impulses that bring spots to the wanted speeds of separation, or to more where
    /// they need not push; then rubs.
    fn turn_back(&mut self, spots: &[usize], wanted: &[f64]) {
        for &k in spots {
            self.spots[k].approach = self.spots[k].approach.max(-self.separation(k));
        }
        if wanted.iter().all(|wanted| *wanted == 0.0) {
            // Without a bounce, friction is that of all that pushes while it stops.
            let mut rubs = self.rough(spots);
            let impulses = self.settle(spots, wanted, &mut rubs);
            self.enter(spots, &impulses);
            self.rubbed(&rubs);
            return;
        }
        let before = self.velocities();
        let energy = self.energy();
        let mut impulses = self.settle(spots, wanted, &mut []);
        let moved = spots.iter().any(|&k| self.spots[k].surface.amax() > 0.0);
        if spots.len() > 1 && !moved && self.energy() > energy * (1.0 + 1e-9) {
            // Restitutions that differ can add energy. Between this outcome and the one without
            // any bounce, which never does, there is one that keeps it.
            let bounced = (self.velocities(), impulses);
            self.set(&before);
            let stopped = self.settle(spots, &vec![0.0; spots.len()], &mut []);
            let stopped = (self.velocities(), stopped);
            let mix = |share: f64, cluster: &mut Self| {
                for (k, body) in cluster.bodies.iter_mut().enumerate() {
                    let between = |a: &(Vector<D>, Vector<3>), b: &(Vector<D>, Vector<3>)| {
                        (a.0 + (b.0 - a.0) * share, a.1 + (b.1 - a.1) * share)
                    };
                    (body.velocity, body.spin) = between(&stopped.0[k], &bounced.0[k]);
                }
                cluster.energy()
            };
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                match mix(middle, self) <= energy {
                    true => low = middle,
                    false => high = middle,
                }
            }
            mix(low, self);
            let pairs = stopped.1.iter().zip(&bounced.1);
            impulses = pairs.map(|(a, b)| a + (b - a) * low).collect();
        }
        self.enter(spots, &impulses);
        self.rub(spots, &impulses);
    }

    /// Enters what normal impulses came to.
    fn enter(&mut self, spots: &[usize], impulses: &[f64]) {
        for (&k, impulse) in spots.iter().zip(impulses) {
            self.spots[k].normal_impulse += impulse;
        }
    }

    /// Normal impulses J with 0 ≤ J ⟂ u − wanted ≥ 0, applied, and friction with them.
    fn settle(&mut self, spots: &[usize], wanted: &[f64], rubs: &mut [Rub<D>]) -> Vec<f64> {
        let mut impulses = vec![0.0; spots.len()];
        let yields: Vec<f64> = spots
            .iter()
            .map(|&k| {
                self.give(k, &self.spots[k].normal)
                    .dot(&self.spots[k].normal)
            })
            .collect();
        let exact = self.least() * if rubs.is_empty() { 1e-2 } else { 0.1 };
        let passes = match spots.len() <= FEW.0 {
            true => FEW.1,
            false => PASSES,
        };
        for _ in 0..passes {
            let mut largest = 0.0f64;
            for (place, &k) in spots.iter().enumerate() {
                let lacking = wanted[place] - self.separation(k);
                let impulse = f64::max(0.0, impulses[place] + lacking / yields[place]);
                let change = impulse - impulses[place];
                if change != 0.0 {
                    impulses[place] = impulse;
                    let push = self.spots[k].normal * -change;
                    self.push(k, &push);
                    largest = largest.max((change * yields[place]).abs());
                }
            }
            if !rubs.is_empty() {
                largest = largest.max(self.rub_once(rubs, &impulses));
            } else if spots.len() == 1 {
                break;
            }
            if largest <= exact {
                break;
            }
        }
        impulses
    }

    /// By how much an impulse on the one body at a spot, and its opposite on the other, change
    /// the velocity of the surfaces against each other.
    fn give(&self, spot: usize, impulse: &Vector<D>) -> Vector<D> {
        let spot = &self.spots[spot];
        let of = |body: usize, arm: &Vector<3>| {
            let body = &self.bodies[body];
            let mut give = impulse * body.inverse_mass;
            if body.inverse_inertia.amax() > 0.0 {
                let spin = body.inverse_inertia * arm.cross(&embed(impulse));
                give += project(&spin.cross(arm));
            }
            give
        };
        let other = spot
            .other
            .map_or(Vector::zeros(), |other| of(other, &spot.arms[1]));
        of(spot.one, &spot.arms[0]) + other
    }

    /// Applies an impulse to the one body at a spot, and its opposite to the other.
    fn push(&mut self, spot: usize, impulse: &Vector<D>) {
        let spot = &self.spots[spot];
        let mut apply = |body: usize, arm: &Vector<3>, impulse: Vector<D>| {
            let body = &mut self.bodies[body];
            body.velocity += impulse * body.inverse_mass;
            if body.inverse_inertia.amax() > 0.0 {
                body.spin += body.inverse_inertia * arm.cross(&embed(&impulse));
            }
        };
        apply(spot.one, &spot.arms[0], *impulse);
        if let Some(other) = spot.other {
            apply(other, &spot.arms[1], -impulse);
        }
    }

    fn velocities(&self) -> Vec<(Vector<D>, Vector<3>)> {
        self.bodies
            .iter()
            .map(|it| (it.velocity, it.spin))
            .collect()
    }

    fn set(&mut self, velocities: &[(Vector<D>, Vector<3>)]) {
        for (body, (velocity, spin)) in self.bodies.iter_mut().zip(velocities) {
            (body.velocity, body.spin) = (*velocity, *spin);
        }
    }

    /// The energy of motion of the bodies that can be moved, without that of spins which nothing
    /// changes.
    fn energy(&self) -> f64 {
        let of = |body: &Struck<D>| {
            let moving = body.velocity.norm_squared() / body.inverse_mass;
            // In the plane the tensor has but one entry.
            let turning = match D {
                2 if body.inverse_inertia[(2, 2)] > 0.0 => {
                    body.spin.z * body.spin.z / body.inverse_inertia[(2, 2)]
                }
                2 => 0.0,
                _ => body
                    .inverse_inertia
                    .try_inverse()
                    .map_or(0.0, |inertia| body.spin.dot(&(inertia * body.spin))),
            };
            0.5 * (moving + turning)
        };
        self.bodies.iter().map(of).sum()
    }
}
