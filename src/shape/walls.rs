//! Walls of many pieces act as the wall that they form: which contacts are with its surface, and
//! which with seams inside.
//!
//! Where a body touches a piece at p with normal n, the piece on its own allows it. The union of
//! all pieces does where n is a normal of the union at p: where, of the union, p is nearest to
//! p + εn for small ε; or, as in a corner that the body fits into, where it is so at points of
//! the piece as near to p as one likes. At a seam of flush pieces only the flat normal is one, at
//! a true corner all that lie between those of its sides are, and on a side that two pieces share
//! none is.

use crate::math::{Vector, direction};
use crate::shape::separation::Foot;
use crate::shape::{Boxes, Obstacle, Reach};

/// Share of the scale that ε is.
const STEP: f64 = 1e-3;

/// The angle from which on a normal is not that of a flat wall.
const TILT: f64 = 1e-9;

/// Whether a contact belongs to the surface that all obstacles form together: one at `point` of
/// a part, by the indices of obstacle and part, with the unit normal pointing from the wall to the
/// body. Both must be what the part on its own allows; the point may be off the surface by a ten
/// thousandth of `scale`, which is the size of the smaller of the body and the part. `boxes` are
/// those about the obstacles.
pub(crate) fn is_exposed<const D: usize>(
    obstacles: &[Obstacle<D>],
    boxes: &Boxes<D>,
    (obstacle, part): (usize, usize),
    point: &Vector<D>,
    normal: &Vector<D>,
    scale: f64,
) -> bool {
    let union = Union {
        obstacles,
        boxes,
        own: (obstacle, part),
    };
    let step = STEP * scale;
    // Beyond this nothing is in the way, wherever the point is moved below.
    if !union.has_others(point, 16.0 * step) {
        return true;
    }
    let begin = union.foot(union.own, &(point + normal * step)).point;
    let Err(mut away) = union.look(&begin, normal, step, false) else {
        return true;
    };
    // In a corner: away from what else is there, the same side of the same part may be free.
    for steps in [2.0, 2.0, 8.0, 8.0] {
        let along = away - normal * normal.dot(&away);
        if along.norm() <= TILT {
            return false;
        }
        let place = begin + direction(&along) * (steps * step);
        match union.look(&place, normal, step / 16.0, true) {
            Ok(()) => return true,
            Err(more) => away = direction(&along) + more,
        }
    }
    false
}

/// All obstacles, looked at from a point of a part.
struct Union<'a, const D: usize> {
    obstacles: &'a [Obstacle<D>],
    boxes: &'a Boxes<D>,
    own: (usize, usize),
}

impl<const D: usize> Union<'_, D> {
    /// The point of a part's surface nearest to a point of the world.
    fn foot(&self, (obstacle, part): (usize, usize), point: &Vector<D>) -> Foot<D> {
        let obstacle = &self.obstacles[obstacle];
        let local = obstacle.pose.point_to_local(point);
        let foot = obstacle.parts()[part].foot(&local);
        Foot {
            point: obstacle.pose.point_to_world(&foot.point),
            normal: obstacle.pose.vector_to_world(&foot.normal),
            ..foot
        }
    }

    /// The other parts that may be at most `range` from a point.
    fn others(&self, point: &Vector<D>, range: f64) -> impl Iterator<Item = (usize, usize)> {
        let point = *point;
        let near = self.boxes.reached(Reach::Around { point, range });
        near.flat_map(move |index| {
            let obstacle = &self.obstacles[index];
            let local = obstacle.pose.point_to_local(&point);
            let parts = obstacle.parts.near(&local, range * (D as f64).sqrt());
            parts.map(move |part| (index, part))
        })
        .filter(|it| *it != self.own)
    }

    fn has_others(&self, point: &Vector<D>, range: f64) -> bool {
        // Most often the part is all of its obstacle.
        self.others(point, range).next().is_some()
    }

    /// Whether, of the union, a point of the own part is nearest to the point `step` above it;
    /// otherwise the sum of the directions away from what is in the way.
    fn look(
        &self,
        place: &Vector<D>,
        normal: &Vector<D>,
        step: f64,
        own: bool,
    ) -> Result<(), Vector<D>> {
        let (high, low) = (place + normal * step, place + normal * (0.25 * step));
        // A foot that moves as the point goes up is that of a side which is turned from it.
        let moves = |part: (usize, usize), foot: &Foot<D>| {
            let rounding = 4e-15 * (high.amax() + self.obstacles[part.0].parts()[part.1].size());
            let moved = (self.foot(part, &low).point - foot.point).norm();
            moved > TILT * step + rounding
        };
        if own {
            // The place must lie on the own part, with this normal.
            let foot = self.foot(self.own, &high);
            if (foot.point - place).norm() > 1e-6 * step || moves(self.own, &foot) {
                return Err(Vector::zeros());
            }
        }
        let mut away = Vector::zeros();
        let mut free = true;
        for part in self.others(&high, 1.01 * step) {
            let foot = self.foot(part, &high);
            if foot.distance > 1.001 * step {
                continue;
            }
            if foot.distance < 0.5 * step || moves(part, &foot) {
                free = false;
                let along = foot.normal - normal * normal.dot(&foot.normal);
                away += direction(&along);
            }
        }
        if free { Ok(()) } else { Err(away) }
    }
}

#[cfg(test)]
mod tests;
