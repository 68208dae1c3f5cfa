//! Friction at the spots of a blow: as much as it takes to stop sliding, at most Coulomb's.

use super::Cluster;
use crate::math::{Matrix, Vector, axis};

/// Passes of friction, at most, where spots share bodies.
const RUBS: usize = 50;

/// Friction at a spot, as it is found.
pub(super) struct Rub<const D: usize> {
    /// The spot, and its place among those that are turned back together.
    spot: usize,
    place: usize,
    /// From sliding to the impulse on the one body that stops it.
    grip: Matrix<D>,
    /// Impulse on the one body so far.
    impulse: Vector<D>,
}

impl<const D: usize> Cluster<D> {
    /// The rough ones of some spots.
    pub(super) fn rough(&self, spots: &[usize]) -> Vec<Rub<D>> {
        let mut rubs: Vec<_> = (spots.iter().enumerate())
            .filter(|&(_, &k)| self.spots[k].friction > 0.0)
            .map(|(place, &spot)| Rub {
                spot,
                place,
                grip: self.grip(spot),
                impulse: Vector::zeros(),
            })
            .collect();
        // Spots of one body would overdo it together if each did its own at once; one after the
        // other, mirror images would not stay so.
        let mut shared = vec![0u32; self.bodies.len()];
        for rub in &rubs {
            let spot = &self.spots[rub.spot];
            shared[spot.one] += 1;
            spot.other.into_iter().for_each(|other| shared[other] += 1);
        }
        for rub in &mut rubs {
            let spot = &self.spots[rub.spot];
            let most = spot.other.map_or(0, |other| shared[other]);
            rub.grip /= f64::from(most.max(shared[spot.one]));
        }
        rubs
    }

    /// Friction against sliding, with these normal impulses.
    pub(super) fn rub(&mut self, spots: &[usize], impulses: &[f64]) {
        let mut rubs = self.rough(spots);
        let exact = self.least();
        for _ in 0..RUBS {
            let change = self.rub_once(&mut rubs, impulses);
            if rubs.len() <= 1 || change <= exact {
                break;
            }
        }
        self.rubbed(&rubs);
    }

    /// One pass of friction; the largest change of a velocity.
    pub(super) fn rub_once(&mut self, rubs: &mut [Rub<D>], impulses: &[f64]) -> f64 {
        let mut largest = 0.0f64;
        let pushes: Vec<_> = rubs
            .iter_mut()
            .map(|rub| {
                let spot = &self.spots[rub.spot];
                let limit = spot.friction * impulses[rub.place];
                let wanted = rub.impulse - rub.grip * self.slip(rub.spot);
                let length = wanted.norm();
                let wanted = match length > limit {
                    true => wanted * (limit / length),
                    false => wanted,
                };
                let push = wanted - rub.impulse;
                rub.impulse = wanted;
                push
            })
            .collect();
        for (rub, push) in rubs.iter().zip(pushes) {
            if push.amax() > 0.0 {
                largest = largest.max(self.give(rub.spot, &push).amax());
                self.push(rub.spot, &push);
            }
        }
        largest
    }

    /// Enters what friction came to.
    pub(super) fn rubbed(&mut self, rubs: &[Rub<D>]) {
        for rub in rubs {
            self.spots[rub.spot].friction_impulse += rub.impulse.norm();
        }
    }

    /// From the sliding at a spot to the impulse against it, on the one body, that stops it.
    fn grip(&self, spot: usize) -> Matrix<D> {
        let normal = self.spots[spot].normal;
        let mut grip = Matrix::zeros();
        // Directions in which it can slide, none of which moves it along another.
        let mut known: Vec<(Vector<D>, Vector<D>)> = Vec::with_capacity(D);
        let mut axes: Vec<usize> = (0..D).collect();
        axes.sort_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()));
        for &k in &axes[..D - 1] {
            let mut along: Vector<D> = axis(k);
            along -= normal * along.dot(&normal);
            for (other, give) in &known {
                along -= other * (along.dot(give) / other.dot(give));
            }
            let give = self.give(spot, &along);
            grip += along * along.transpose() / along.dot(&give);
            known.push((along, give));
        }
        grip
    }
}
