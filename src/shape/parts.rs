//! The parts of an obstacle, and the search among many.

use crate::math::Vector;
use crate::shape::projection::Projection;
use crate::shape::{Geometry, In, Part, Pose, Tree};

/// From this number of parts on, a tree of boxes finds the near ones.
const MANY: usize = 9;

/// Some parts, in one frame.
#[derive(Debug)]
pub(super) struct Parts<const D: usize> {
    pub(super) list: Vec<Part<D>>,
    /// The bounded parts, where there are many of them.
    tree: Option<Box<dyn Tree<D>>>,
    /// What the tree's boxes are: indices of bounded parts.
    boxed: Vec<usize>,
    /// The parts outside the tree.
    others: Vec<usize>,
}

impl<const D: usize> Parts<D> {
    pub(super) fn new(list: Vec<Part<D>>) -> Self
    where
        In<D>: Geometry<D>,
    {
        let all = 0..list.len();
        let (boxed, others): (Vec<_>, Vec<_>) = all.partition(|&i| list[i].shape.is_bounded());
        if boxed.len() < MANY {
            return Self {
                others: (0..list.len()).collect(),
                list,
                tree: None,
                boxed: Vec::new(),
            };
        }
        let here = Pose::new(Vector::zeros(), [0.0; 3]);
        let boxes: Vec<_> = boxed.iter().map(|&i| list[i].bounds(&here)).collect();
        Self {
            tree: Some(<In<D> as Geometry<D>>::tree(&boxes)),
            list,
            boxed,
            others,
        }
    }

    /// The part whose surface is nearest, or in which the point is deepest, with the
    /// projection on it.
    pub(super) fn nearest(&self, point: &Vector<D>) -> (usize, Projection<D>) {
        if let [only] = &self.list[..] {
            return (0, only.project(point));
        }
        let cost = |leaf: usize| self.list[self.boxed[leaf]].project(point).distance;
        let in_tree = self.tree.as_ref().and_then(|it| it.nearest(point, &cost));
        let candidates = in_tree.map(|leaf| self.boxed[leaf]).into_iter();
        candidates
            .chain(self.others.iter().copied())
            .map(|part| (part, self.list[part].project(point)))
            .min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance))
            .expect("an obstacle has parts")
    }

    /// The parts whose surface is at most `range` away, or that contain the point, with
    /// the projections on them, in their order.
    pub(super) fn within(&self, point: &Vector<D>, range: f64) -> Vec<(usize, Projection<D>)> {
        let mut near = self.others.clone();
        if let Some(tree) = &self.tree {
            let from = near.len();
            tree.within(point, range, &mut near);
            for leaf in &mut near[from..] {
                *leaf = self.boxed[*leaf];
            }
            near.sort_unstable();
        }
        let projected = near.into_iter().map(|i| (i, self.list[i].project(point)));
        projected.filter(|(_, it)| it.distance <= range).collect()
    }
}
