//! The past, for those who see it late.

use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

use crate::math::{Matrix, Vector};

/// The state of all agents at the start of a step, in the order of the world.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Moment<const D: usize> {
    /// The step.
    pub step: u64,
    /// Position of each agent.
    pub positions: Vec<Vector<D>>,
    /// Velocity of each agent.
    pub velocities: Vec<Vector<D>>,
    /// Heading of each agent, a unit vector.
    pub headings: Vec<Vector<D>>,
    /// Rotation of each body; none where all are balls.
    pub rotations: Vec<Matrix<D>>,
}

/// The moments of the last steps, as many as the longest delay needs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct History<const D: usize> {
    /// The oldest first.
    moments: VecDeque<Moment<D>>,
    /// How many steps to look back.
    depth: u64,
}

impl<const D: usize> History<D> {
    /// An empty history that reaches `depth` steps back.
    pub fn new(depth: u64) -> Self {
        Self {
            moments: VecDeque::new(),
            depth,
        }
    }

    /// Writes down a moment; what was written of this step, or of later ones, is replaced.
    pub fn record(
        &mut self,
        step: u64,
        positions: &[Vector<D>],
        velocities: &[Vector<D>],
        headings: &[Vector<D>],
        rotations: &[Matrix<D>],
    ) {
        if self.depth == 0 {
            return;
        }
        while self.moments.back().is_some_and(|last| last.step >= step) {
            self.moments.pop_back();
        }
        let mut moment = Moment::default();
        // The moment before the last that can be asked for is spent: take its memory.
        while self.moments.len() > 1 && self.moments[1].step + self.depth <= step {
            moment = self.moments.pop_front().unwrap_or_default();
        }
        moment.step = step;
        for (list, values) in [
            (&mut moment.positions, positions),
            (&mut moment.velocities, velocities),
            (&mut moment.headings, headings),
        ] {
            list.clear();
            list.extend_from_slice(values);
        }
        moment.rotations.clear();
        moment.rotations.extend_from_slice(rotations);
        self.moments.push_back(moment);
    }

    /// The last moment written down at a step or before it, or the first of all where
    /// there is none so old; nothing where nothing is written down.
    pub fn at(&self, step: u64) -> Option<&Moment<D>> {
        let after = self.moments.partition_point(|moment| moment.step <= step);
        self.moments.get(after.saturating_sub(1))
    }

    /// What is written down, the oldest first: what a run needs to go on from here.
    pub fn moments(&self) -> impl Iterator<Item = &Moment<D>> {
        self.moments.iter()
    }

    /// Takes up what [`moments`](Self::moments) gave, in its order.
    pub fn restore(&mut self, moments: impl IntoIterator<Item = Moment<D>>) {
        self.moments = moments.into_iter().collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(history: &mut History<2>, step: u64, x: f64) {
        let at = [Vector::<2>::new(x, 0.0)];
        history.record(step, &at, &at, &at, &[]);
    }

    fn seen(history: &History<2>, step: u64) -> f64 {
        history
            .at(step)
            .expect("something is written down")
            .positions[0][0]
    }

    #[test]
    fn keeps_as_much_as_is_asked_for() {
        let mut history = History::new(3);
        assert_eq!(history.at(7), None);
        for step in 0..20u64 {
            record(&mut history, step, step as f64);
            for back in 0..=3 {
                let expected = step.saturating_sub(back);
                assert_eq!(seen(&history, expected), expected as f64);
            }
            assert!(history.moments().count() <= 4);
        }
        // Nothing so old: the oldest there is.
        assert_eq!(seen(&history, 2), 16.0);
    }

    #[test]
    fn the_last_word_on_a_step_counts() {
        let mut history = History::new(5);
        for (step, x) in [(0, 0.0), (1, 1.0), (2, 2.0), (1, 7.0)] {
            record(&mut history, step, x);
        }
        assert_eq!((seen(&history, 1), seen(&history, 2)), (7.0, 7.0));
    }

    #[test]
    fn goes_on_from_what_was_restored() {
        let mut history = History::new(4);
        (0..9).for_each(|step| record(&mut history, step, step as f64));
        let mut again = History::new(4);
        again.restore(history.moments().cloned());
        for one in [&mut history, &mut again] {
            record(one, 9, 9.0);
        }
        assert_eq!(history, again);
    }
}
