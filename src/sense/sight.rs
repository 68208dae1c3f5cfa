//! Lines of sight.

use crate::math::{Matrix, Vector};
use crate::sense::{Cells, Surroundings};
use crate::shape::{Obstacle, Pose, Solid};

/// A body that may stand in the way: the agent's index in the order of the cells, and
/// where it is.
type Body<const D: usize> = (usize, Vector<D>, f64);

/// What may stand in one agent's lines of sight.
#[derive(Debug, Default)]
pub struct Sight<const D: usize> {
    obstacles: Vec<usize>,
    /// Offsets from the agent that looks, and radii.
    bodies: Vec<Body<D>>,
}

impl<const D: usize> Sight<D> {
    /// Forgets everything that stood in the way.
    pub fn clear(&mut self) {
        self.obstacles.clear();
        self.bodies.clear();
    }

    /// Notes the obstacles that may hide something at most `range` from `from`.
    pub fn note_obstacles(&mut self, surroundings: &Surroundings<D>, from: &Vector<D>, range: f64) {
        self.obstacles.extend(surroundings.near(from, range));
    }

    /// Notes the bodies that may hide something at most `range` from `from`: those of the
    /// agents in `cells` whose radius, by their place there, `radius` tells.
    pub fn note_bodies(
        &mut self,
        cells: &Cells<D>,
        from: &Vector<D>,
        range: f64,
        radius: impl Fn(usize) -> Option<f64>,
    ) {
        cells.for_each_within(from, range, |place, offset, _| {
            self.bodies
                .extend(radius(place).map(|radius| (place, offset, radius)));
        });
    }

    /// Whether something that was noted hides agent number `place` of the cells, which is
    /// `offset` away from `from`. A line that just touches is blocked. `meets` tells by a
    /// body's place, offset and radius whether it is in the way.
    pub fn is_blocked(
        &self,
        obstacles: &[Obstacle<D>],
        from: &Vector<D>,
        place: usize,
        offset: &Vector<D>,
        meets: impl Fn(usize, &Vector<D>, f64) -> bool,
    ) -> bool {
        let hides = |&(other, at, radius): &Body<D>| other != place && meets(other, &at, radius);
        self.bodies.iter().any(hides) || {
            let to = from + offset;
            let mut near = self.obstacles.iter();
            near.any(|&index| obstacles[index].blocks(from, &to))
        }
    }
}

/// Whether a body stands in the way from `from` to the point `to` away from it: whether the
/// segment meets the body whose centre is `at` away. A segment that just touches does. It is
/// held by a ball of this radius; its rotation is asked for only where that matters.
pub(crate) fn body_blocks<const D: usize>(
    solid: &Solid<D>,
    radius: f64,
    rotation: impl FnOnce() -> Matrix<D>,
    from: &Vector<D>,
    at: &Vector<D>,
    to: &Vector<D>,
) -> bool {
    squared_distance(at, to) <= radius * radius
        && (solid.is_ball() || {
            let pose = Pose::from_matrix(from + at, rotation());
            solid.meets(&pose, from, &(from + to))
        })
}

/// Square of the distance of a point from the segment between the origin and `to`.
fn squared_distance<const D: usize>(point: &Vector<D>, to: &Vector<D>) -> f64 {
    let squared = to.norm_squared();
    let share = match squared > 0.0 {
        true => (point.dot(to) / squared).clamp(0.0, 1.0),
        false => 0.0,
    };
    (point - to * share).norm_squared()
}
