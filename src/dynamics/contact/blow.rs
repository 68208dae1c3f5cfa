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
//! to stop it, but at most μ times the normal impulse of the round (Coulomb).

use super::way::{embed, project};
use crate::math::{Matrix, Vector};

/// Rounds of bounces after which all spots of a cluster are stopped together.
const ROUNDS: usize = 300;

/// Rounds after which slow approach counts as none.
const PATIENT: usize = 40;

/// Spots that settle together to rounding, and the passes over them in which they do; where there
/// are more, fewer passes must do: what they leave is for the next round.
const FEW: (usize, usize) = (12, 2000);
const PASSES: usize = 60;

/// Passes of friction, at most, where spots share bodies.
const RUBS: usize = 50;

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
            let patience = if round < PATIENT { 1.0 } else { 1e7 };
            let least = self.least() * patience;
            let approach: Vec<usize> = (0..self.spots.len())
                .filter(|&k| self.separation(k) < -least)
                .collect();
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
            let patience = if round < PATIENT / 4 { 1.0 } else { 1e7 };
            let least = self.least() * patience;
            let more: Vec<usize> = (0..self.spots.len())
                .filter(|&k| self.separation(k) < -least)
                .collect();
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
        2e-13 * self.fastest
    }

    /// Finds the impulses that bring spots to the wanted speeds of separation, or to more where
    /// they need not push; then rubs.
    fn turn_back(&mut self, spots: &[usize], wanted: &[f64]) {
        for &k in spots {
            self.spots[k].approach = self.spots[k].approach.max(-self.separation(k));
        }
        let before = self.velocities();
        let energy = self.energy();
        let mut impulses = self.settle(spots, wanted);
        let moved = spots.iter().any(|&k| self.spots[k].surface.amax() > 0.0);
        if spots.len() > 1 && !moved && self.energy() > energy * (1.0 + 1e-9) {
            // Restitutions that differ can add energy. Between this outcome and the one without
            // any bounce, which never does, there is one that keeps it.
            let bounced = (self.velocities(), impulses);
            self.set(&before);
            let stopped = self.settle(spots, &vec![0.0; spots.len()]);
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
        for (&k, impulse) in spots.iter().zip(&impulses) {
            self.spots[k].normal_impulse += impulse;
        }
        self.rub(spots, &impulses);
    }

    /// Normal impulses J with 0 ≤ J ⟂ u − wanted ≥ 0, applied.
    fn settle(&mut self, spots: &[usize], wanted: &[f64]) -> Vec<f64> {
        let mut impulses = vec![0.0; spots.len()];
        let yields: Vec<f64> = spots
            .iter()
            .map(|&k| {
                self.give(k, &self.spots[k].normal)
                    .dot(&self.spots[k].normal)
            })
            .collect();
        let exact = 1e-2 * self.least();
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
            if spots.len() == 1 || largest <= exact {
                break;
            }
        }
        impulses
    }

    /// Friction against sliding, with these normal impulses.
    fn rub(&mut self, spots: &[usize], impulses: &[f64]) {
        let rough: Vec<(usize, f64)> = spots
            .iter()
            .zip(impulses)
            .filter(|&(&k, &impulse)| impulse > 0.0 && self.spots[k].friction > 0.0)
            .map(|(&k, &impulse)| (k, impulse * self.spots[k].friction))
            .collect();
        if rough.is_empty() {
            return;
        }
        // Spots of one body would overdo it together if each did its own at once; one after the
        // other, mirror images would not stay so.
        let mut shared = vec![0u32; self.bodies.len()];
        for &(k, _) in &rough {
            let spot = &self.spots[k];
            shared[spot.one] += 1;
            spot.other.into_iter().for_each(|other| shared[other] += 1);
        }
        let share = 1.0 / f64::from(shared.into_iter().max().unwrap_or(1));
        let mut rubs = vec![Vector::zeros(); rough.len()];
        let exact = self.least();
        for _ in 0..RUBS {
            let mut largest = 0.0f64;
            let mut pushes = Vec::with_capacity(rough.len());
            for (&(k, limit), rubbed) in rough.iter().zip(&mut rubs) {
                let normal = self.spots[k].normal;
                let slip = self.slip(k);
                let slip = slip - normal * slip.dot(&normal);
                let stopping = self.stopping(k, &slip);
                let wanted: Vector<D> = *rubbed + stopping * share;
                let length = wanted.norm();
                let wanted = match length > limit {
                    true => wanted * (limit / length),
                    false => wanted,
                };
                pushes.push((k, wanted - *rubbed));
                *rubbed = wanted;
            }
            for (k, push) in pushes {
                let change = self.give(k, &push);
                largest = largest.max(change.amax());
                self.push(k, &push);
            }
            if rough.len() == 1 || largest <= exact {
                break;
            }
        }
        for ((k, _), rubbed) in rough.iter().zip(&rubs) {
            self.spots[*k].friction_impulse += rubbed.norm();
        }
    }

    /// The impulse on the one body that stops sliding at a spot.
    fn stopping(&self, spot: usize, slip: &Vector<D>) -> Vector<D> {
        let normal = self.spots[spot].normal;
        let across = |v: Vector<D>| v - normal * v.dot(&normal);
        // In the plane, and for balls, the give is along the push. Elsewhere a few steps of
        // conjugate gradients find it: the sliding has D − 1 dimensions.
        let mut impulse = Vector::zeros();
        let mut rest = -slip;
        let mut along = rest;
        for _ in 1..D {
            let left = rest.norm_squared();
            let give = across(self.give(spot, &along));
            let curvature = give.dot(&along);
            if curvature <= 0.0 || left == 0.0 {
                break;
            }
            let length = left / curvature;
            impulse += along * length;
            rest -= give * length;
            along = rest + along * (rest.norm_squared() / left);
        }
        impulse
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

#[cfg(test)]
mod tests {
    use super::*;

    fn body(x: f64, inverse_mass: f64) -> Struck<2> {
        Struck {
            velocity: Vector::<2>::new(x, 0.0),
            spin: Vector::zeros(),
            inverse_mass,
            inverse_inertia: Matrix::zeros(),
        }
    }

    fn spot(one: usize, other: Option<usize>, restitution: f64) -> Spot<2> {
        Spot {
            one,
            other,
            arms: [Vector::zeros(); 2],
            normal: Vector::<2>::new(1.0, 0.0),
            surface: Vector::zeros(),
            restitution,
            friction: 0.0,
            pair: 0,
            normal_impulse: 0.0,
            friction_impulse: 0.0,
            approach: f64::NEG_INFINITY,
        }
    }

    fn row(velocities: &[f64], wall: bool, restitution: f64) -> Cluster<2> {
        let last = velocities.len() - 1;
        let between = (0..last).map(|k| spot(k, Some(k + 1), restitution));
        Cluster {
            bodies: velocities.iter().map(|&x| body(x, 1.0)).collect(),
            spots: between
                .chain(wall.then(|| spot(last, None, restitution)))
                .collect(),
            unordered: false,
            fastest: 0.0,
        }
    }

    fn speeds(cluster: &Cluster<2>) -> Vec<f64> {
        cluster.bodies.iter().map(|body| body.velocity.x).collect()
    }

    #[test]
    fn a_blow_runs_through_a_row() {
        let mut cluster = row(&[1.0, 0.0, 0.0, 0.0], false, 1.0);
        cluster.bounce(|_, _| {});
        assert_eq!(speeds(&cluster), [0.0, 0.0, 0.0, 1.0]);
        // Against a wall it comes back.
        let mut cluster = row(&[1.0, 0.0, 0.0], true, 1.0);
        cluster.bounce(|_, _| {});
        assert_eq!(speeds(&cluster), [-1.0, 0.0, 0.0]);
    }

    #[test]
    fn what_does_not_bounce_stops_at_a_wall_in_few_rounds() {
        let mut cluster = row(&[1.0, 0.0, 0.0], true, 0.0);
        let mut rounds = 0;
        cluster.bounce(|_, _| rounds += 1);
        assert!(speeds(&cluster).iter().all(|speed| speed.abs() < 1e-12));
        assert!(!cluster.unordered);
        let impulse: f64 = cluster.spots[2].normal_impulse;
        assert!((impulse - 1.0).abs() < 1e-12, "{impulse}");
    }

    #[test]
    fn stopping_is_inelastic() {
        let mut cluster = row(&[3.0, 0.0], false, 1.0);
        cluster.stop();
        assert_eq!(speeds(&cluster), [1.5, 1.5]);
    }
}
