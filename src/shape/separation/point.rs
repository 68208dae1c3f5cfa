//! The point of a polytope nearest to a point, and the feature that it lies on.

use super::pair::Chosen;
use crate::math::{Vector, axis, direction};
use crate::shape::polytope::{Polytope, Side, cross};

/// What the nearest point of a polytope lies on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::shape) enum Feature<const D: usize> {
    /// A face, by its normal.
    Face(Vector<D>),
    /// An edge in space, by its direction.
    Edge(Vector<D>),
    /// A corner.
    Corner,
}

/// The nearest point of a polytope.
#[derive(Debug, Clone, Copy)]
pub(in crate::shape) struct Foot<const D: usize> {
    /// Distance to the surface, below 0 inside.
    pub(in crate::shape) distance: f64,
    /// The nearest point of the surface.
    pub(in crate::shape) point: Vector<D>,
    /// The outward normal there: the way to the point where that is outside.
    pub(in crate::shape) normal: Vector<D>,
    /// What it lies on.
    pub(in crate::shape) on: Feature<D>,
}

/// The point of a polytope's surface nearest to a point, both told from its middle.
pub(in crate::shape) fn foot<const D: usize>(of: &Polytope<D>, point: &Vector<D>) -> Foot<D> {
    let height = |face: &Side<D>| face.normal.dot(&(point - of.at(face.corners[0])));
    let mut highest: Option<(f64, Vector<D>)> = None;
    for face in &of.faces {
        let height = height(face);
        if highest.is_none_or(|(most, _)| height > most) {
            highest = Some((height, face.normal));
        }
    }
    if let Some((distance, normal)) = highest
        && distance <= 0.0
        && !of.is_thin()
    {
        // Inside, or on the surface: the nearest face, as if it had no end.
        return Foot {
            distance,
            point: point - normal * distance,
            normal,
            on: Feature::Face(normal),
        };
    }
    let mut best: Option<Foot<D>> = None;
    corner_to(
        of,
        &Chosen::all(),
        point,
        0.0,
        &mut |distance, normal, point, on| {
            // Faces come before edges, and these before corners.
            if best.is_none_or(|best| distance < best.distance) {
                best = Some(Foot {
                    distance,
                    point,
                    normal,
                    on,
                });
            }
        },
    );
    let best = best.expect("a polytope has corners");
    match highest {
        // So near that rounding tells the way, the face does.
        Some((_, normal)) if best.distance <= 1e-13 * of.size => Foot { normal, ..best },
        _ => best,
    }
}

/// Calls `look` with distance, normal and foot of a point on each feature of some corners on
/// which it has one. The normal points to the point, which may be so far below a face.
pub(super) fn corner_to<const D: usize>(
    of: &Polytope<D>,
    chosen: &Chosen,
    point: &Vector<D>,
    rounding: f64,
    look: &mut impl FnMut(f64, Vector<D>, Vector<D>, Feature<D>),
) {
    for face in of.faces.iter().filter(|face| chosen.has(&face.corners)) {
        let height = face.normal.dot(&(point - of.at(face.corners[0])));
        if height < -rounding {
            continue;
        }
        let foot = point - face.normal * height;
        if within(of, face, &foot) {
            look(height, face.normal, foot, Feature::Face(face.normal));
        }
    }
    for edge in of.edges.iter().filter(|edge| chosen.has(&edge.ends)) {
        let [from, to] = edge.ends.map(|i| of.at(i));
        let at = (point - from).dot(&edge.along);
        if at > 0.0 && at < (to - from).norm() {
            let foot = from + edge.along * at;
            let way = point - foot;
            // Of what rounding leaves along the edge nothing may stay.
            let way = way - edge.along * edge.along.dot(&way);
            let gap = way.norm();
            let on = match edge.normals {
                // A seam within a face.
                Some([m, n]) if (m - n).norm_squared() < 1e-18 => Feature::Face(m),
                _ => Feature::Edge(edge.along),
            };
            look(gap, out_of(&way, gap), foot, on);
        }
    }
    for i in chosen.each(of.corners.len()) {
        let corner = of.at(i);
        let way = point - corner;
        let gap = way.norm();
        look(gap, out_of(&way, gap), corner, Feature::Corner);
    }
}

fn out_of<const D: usize>(way: &Vector<D>, length: f64) -> Vector<D> {
    match length > 0.0 {
        true => direction(way),
        false => axis(0),
    }
}

/// Whether a point of a face's plane lies within the face.
fn within<const D: usize>(of: &Polytope<D>, face: &Side<D>, foot: &Vector<D>) -> bool {
    let count = face.corners.len();
    let at = |k: usize| of.at(face.corners[k % count]);
    if D == 2 {
        let along = at(1) - at(0);
        return (foot - at(0)).dot(&along) > 0.0 && (foot - at(1)).dot(&along) < 0.0;
    }
    (0..count).all(|k| {
        let inward = cross(&face.normal, &(at(k + 1) - at(k)));
        inward.dot(&(foot - at(k))) > 0.0
    })
}
