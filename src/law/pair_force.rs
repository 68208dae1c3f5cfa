//! Forces along the line between two agents, added up.

use crate::math::{Potential, Vector};
use crate::sense::Scene;
use crate::world::spec::Share;

/// A force along the line between two agents that depends on their distance alone:
/// Σ_j f(r²)(x_i − x_j), where positive f repels, or that sum over N.
pub(super) struct PairForce {
    /// f, the force over the distance by the square of the distance.
    over_distance: Box<dyn Fn(f64) -> f64 + Send + Sync>,
    range: f64,
    share: Share,
    /// N where the share is the mean, 1 otherwise; known from `prepare` on.
    divisor: f64,
}

impl PairForce {
    /// From f, and the distance at which the force ends; without a range, nowhere.
    pub fn new(
        over_distance: impl Fn(f64) -> f64 + Send + Sync + 'static,
        share: Share,
        range: Option<f64>,
    ) -> Self {
        Self {
            over_distance: Box::new(over_distance),
            range: range.unwrap_or(f64::INFINITY),
            share,
            divisor: 1.0,
        }
    }

    /// The force of a potential.
    pub fn of(potential: Potential, share: Share, range: Option<f64>) -> Self {
        Self::new(
            move |squared| potential.force_over_distance(squared),
            share,
            range,
        )
    }

    /// As [`crate::law::Law::range`].
    pub fn range(&self) -> f64 {
        self.range
    }

    /// As [`crate::law::Law::jump`].
    pub fn jump(&self) -> Option<f64> {
        self.range.is_finite().then_some(self.range)
    }

    /// As [`crate::law::Law::prepare`].
    pub fn prepare<const D: usize>(&mut self, scene: &Scene<'_, D>) {
        self.divisor = match self.share {
            Share::Sum => 1.0,
            Share::Mean => scene.count().max(1) as f64,
        };
    }

    /// The force on agent `i` of the scene. Agents at the same point have no line between
    /// them and exert none.
    pub fn on<const D: usize>(&self, scene: &Scene<'_, D>, i: usize) -> Vector<D> {
        let mut sum = Vector::zeros();
        scene.neighbours(i, self.range, |neighbour| {
            if neighbour.squared > 0.0 {
                let force = (self.over_distance)(neighbour.squared);
                sum -= neighbour.offset * (force * neighbour.weight);
            }
        });
        sum / self.divisor
    }
}
