//! Lines of sight: what an obstacle hides.

use crate::math::Vector;
use crate::shape::{Obstacle, Reach};

impl<const D: usize> Obstacle<D> {
    /// Whether the obstacle stands between two points: whether the segment between them
    /// meets the solid. A segment that only touches it counts as meeting it, to rounding
    /// (for hulls, to about 1e-7 of their size). A point inside is hidden from all others.
    /// A segment within the plane of a thin part may be found to pass it.
    pub fn blocks(&self, from: &Vector<D>, to: &Vector<D>) -> bool {
        self.is_met(&Reach::along(from, to))
            && self.parts.meet(
                &self.pose.point_to_local(from),
                &self.pose.point_to_local(to),
            )
    }

    /// The same for two points of its frame, without a look at any box.
    #[cfg(test)]
    pub(crate) fn meets_any(&self, from: &Vector<D>, to: &Vector<D>) -> bool {
        self.parts.list.iter().any(|part| part.meets(from, to))
    }
}
