//! Forces along the line between two agents, added up.

use crate::law::all_pairs::AllPairs;
use crate::math::{Potential, Repulsion, Vector};
use crate::sense::Scene;
use crate::sum::fast::Kernel;
use crate::world::spec::{Share, SummationSpec};

/// A force along the line between two agents that depends on their distance alone:
/// Σ_j f(r²)(x_i − x_j), where positive f repels, or that sum over N.
pub(super) struct PairForce<const D: usize> {
    /// f, the force over the distance by the square of the distance.
    over_distance: Box<dyn Fn(f64) -> f64 + Send + Sync>,
    range: f64,
    share: Share,
    /// N where the share is the mean, 1 otherwise; known from `prepare` on.
    divisor: f64,
    /// Where all pairs count, and f is one of the known ones.
    all_pairs: Option<AllPairs<D>>,
}

impl<const D: usize> PairForce<D> {
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
            all_pairs: None,
        }
    }

    /// The force of a potential, summed in some way where it is summed over all pairs.
    pub fn of(
        potential: Potential,
        share: Share,
        range: Option<f64>,
        summation: SummationSpec,
    ) -> Self {
        let force = move |squared| potential.force_over_distance(squared);
        let all_pairs: Option<AllPairs<D>> = AllPairs::new(&potential);
        let all_pairs = all_pairs.map(|it| it.summed(summation, Kernel::Force(potential)));
        Self::new(force, share, range).over(all_pairs)
    }

    /// The repulsion of Cucker and Dong.
    pub fn repulsion(repulsion: Repulsion, range: Option<f64>) -> Self {
        let force = move |squared| repulsion.value(squared);
        let all_pairs = AllPairs::new(&repulsion);
        Self::new(force, Share::Sum, range).over(all_pairs)
    }

    /// The same, with sums over all pairs where nothing ends.
    fn over(self, all_pairs: Option<AllPairs<D>>) -> Self {
        Self {
            all_pairs: all_pairs.filter(|_| self.range.is_infinite()),
            ..self
        }
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
    pub fn prepare(&mut self, scene: &Scene<'_, D>) {
        self.divisor = match self.share {
            Share::Sum => 1.0,
            Share::Mean => scene.count().max(1) as f64,
        };
        if let Some(all_pairs) = &mut self.all_pairs {
            all_pairs.prepare(scene, scene.positions);
        }
    }

    /// As [`crate::law::Law::gather`].
    pub fn gather(&mut self, scene: &Scene<'_, D>) {
        if let Some(all_pairs) = &mut self.all_pairs {
            all_pairs.gather(scene, scene.positions);
        }
    }

    /// The forces on `count` agents of the scene from number `first` on. Agents at the same
    /// point have no line between them and exert none.
    pub fn on(&self, scene: &Scene<'_, D>, first: usize, count: usize) -> Vec<Vector<D>> {
        let all_pairs = self.all_pairs.as_ref();
        let sums = all_pairs.and_then(|it| it.sums(scene, scene.positions, first, count));
        match sums {
            // What they carry is where they are: Σ f (x_j − x_i).
            Some(sums) => sums.iter().map(|sums| -sums.drive / self.divisor).collect(),
            None => (first..first + count)
                .map(|i| self.one_by_one(scene, i) / self.divisor)
                .collect(),
        }
    }

    /// The sum over the neighbours of agent `i`.
    fn one_by_one(&self, scene: &Scene<'_, D>, i: usize) -> Vector<D> {
        let mut sum = Vector::zeros();
        scene.neighbours(i, self.range, |neighbour| {
            if neighbour.squared > 0.0 {
                let force = (self.over_distance)(neighbour.squared);
                sum -= neighbour.offset * (force * neighbour.weight);
            }
        });
        sum
    }
}
