//! The closest point of a triangle in space, and the feature it lies on.

use crate::math::{Matrix, Vector, direction};
use crate::shape::projection::Projection;

/// A triangle without inside.
#[derive(Debug, Clone)]
pub(super) struct Facet<const D: usize> {
    corners: [Vector<D>; 3],
    /// The projector onto its plane.
    plane: Matrix<D>,
    normal: Vector<D>,
}

impl<const D: usize> Facet<D> {
    pub(super) fn new(corners: [Vector<D>; 3]) -> Self {
        let [a, b, c] = corners;
        let first = direction(&(b - a));
        let second = direction(&((c - a) - first * first.dot(&(c - a))));
        let plane = first * first.transpose() + second * second.transpose();
        // Of the axes, the one that sticks out of the plane most.
        let out = Matrix::identity() - plane;
        let steepest = (0..D).fold(0, |best, k| {
            if out[(k, k)] > out[(best, best)] {
                k
            } else {
                best
            }
        });
        Self {
            corners,
            plane,
            normal: direction(&out.column(steepest).into_owned()),
        }
    }

    /// Projection onto the triangle. On it, the normal is either of the two.
    pub(super) fn project(&self, q: &Vector<D>) -> Projection<D> {
        let (point, core_map) = self.closest(q);
        let offset = q - point;
        let distance = offset.norm();
        let normal = match distance > 0.0 {
            true => offset / distance,
            false => self.normal,
        };
        Projection {
            point,
            normal,
            distance,
            core_map,
            stretch: 0.0,
            carried: None,
        }
    }

    /// The closest point and the projector onto its feature: the plane, an edge, or the
    /// zero map of a corner.
    fn closest(&self, q: &Vector<D>) -> (Vector<D>, Matrix<D>) {
        let [a, _, _] = self.corners;
        let foot = a + self.plane * (q - a);
        // The foot is within the triangle where it is on the inner side of every edge.
        let within = (0..3).all(|k| {
            let (from, to) = (self.corners[k], self.corners[(k + 1) % 3]);
            let opposite = self.corners[(k + 2) % 3];
            let along = direction(&(to - from));
            let inward = (opposite - from) - along * along.dot(&(opposite - from));
            inward.dot(&(foot - from)) >= 0.0
        });
        if within {
            return (foot, self.plane);
        }
        let edges = (0..3).map(|k| on_edge(q, &self.corners[k], &self.corners[(k + 1) % 3]));
        let apart = |(point, _): &(Vector<D>, Matrix<D>)| (q - point).norm_squared();
        edges
            .min_by(|a, b| apart(a).total_cmp(&apart(b)))
            .expect("a triangle has edges")
    }
}

/// The closest point of a segment, and the projector onto its line or, at an end, zero.
fn on_edge<const D: usize>(
    q: &Vector<D>,
    from: &Vector<D>,
    to: &Vector<D>,
) -> (Vector<D>, Matrix<D>) {
    let along = direction(&(to - from));
    let at = along.dot(&(q - from));
    if at <= 0.0 {
        (*from, Matrix::zeros())
    } else if at >= (to - from).norm() {
        (*to, Matrix::zeros())
    } else {
        (from + along * at, along * along.transpose())
    }
}
