//! Random draws: one stream for each purpose, so that a change in one leaves the others.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::math::Vector;

/// What random numbers are drawn for.
#[derive(Debug, Clone, Copy)]
pub(super) enum Purpose {
    /// Starting positions of a group.
    Positions(usize),
    /// Starting velocities of a group.
    Velocities(usize),
    /// A graph of influences, by its number.
    Graph(u32),
}

/// A reproducible source of random numbers.
pub(super) struct Random(ChaCha8Rng);

impl Random {
    /// The source for one purpose in a world with this seed.
    pub(super) fn new(seed: u64, purpose: Purpose) -> Self {
        let stream = match purpose {
            Purpose::Positions(group) => 2 * group as u64,
            Purpose::Velocities(group) => 2 * group as u64 + 1,
            // Beyond those of any group.
            Purpose::Graph(number) => (1 << 63) | u64::from(number),
        };
        let mut source = ChaCha8Rng::seed_from_u64(seed);
        source.set_stream(stream);
        Self(source)
    }

    /// Uniform in [0, 1), with 53 random bits.
    pub(super) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Uniform in an axis-aligned box.
    pub(super) fn in_box<const D: usize>(&mut self, min: &Vector<D>, max: &Vector<D>) -> Vector<D> {
        Vector::from_fn(|k, _| min[k] + (max[k] - min[k]) * self.unit())
    }

    /// Uniform in a ball.
    pub(super) fn in_ball<const D: usize>(&mut self, center: &Vector<D>, radius: f64) -> Vector<D> {
        loop {
            let offset: Vector<D> = self.in_box(&Vector::repeat(-1.0), &Vector::repeat(1.0));
            if offset.norm_squared() <= 1.0 {
                return center + offset * radius;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_pinned() {
        // Whoever changes these changes every world with random starts.
        let mut random = Random::new(1, Purpose::Positions(0));
        let draws = [random.unit(), random.unit()];
        assert_eq!(draws, [0.40248566366484806, 0.08038370892978197]);
    }

    #[test]
    fn purposes_draw_different_numbers() {
        let mut positions = Random::new(1, Purpose::Positions(0));
        let mut velocities = Random::new(1, Purpose::Velocities(0));
        assert_ne!(positions.unit(), velocities.unit());
    }
}
