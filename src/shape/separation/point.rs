//! The point of a polytope nearest to a point, and the feature that it lies on.

use super::features::Chosen;
use crate::math::{Vector, axis, direction};
use crate::shape::polytope::{Edge, Polytope, Side, across, cross, right};

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
    let mut highest: Option<(f64, &Side<D>)> = None;
    let mut nearest = Nearest::default();
    let thin = of.is_thin();
    for face in &of.faces {
        let height = face.normal.dot(&(point - of.at(face.corners[0])));
        if highest.is_none_or(|(most, _)| height > most) {
            highest = Some((height, face));
        }
        // From outside, the nearest point is on a face that is seen.
        if height > 0.0 || (thin && height == 0.0) {
            if D == 2 {
                nearest.on_edge(of, point, &face.corners, &along(&face.normal), None);
            } else if within(of, face, &(point - face.normal * height)) {
                return on_face(point, height, face.normal);
            }
        }
    }
    if let Some((height, face)) = highest
        && height <= 0.0
        && !thin
    {
        // Inside, or on the surface: the nearest face, as if it had no end.
        return on_face(point, height, face.normal);
    }
    for edge in &of.edges {
        nearest.on_edge(of, point, &edge.ends, &edge.along, Some(edge));
    }
    if of.corners.len() == 1 {
        nearest.corner(of.at(0), point);
    }
    let foot = nearest.point;
    let way = point - foot;
    let distance = way.norm();
    let (normal, on) = match (nearest.on, highest) {
        (Feature::Face(normal), _) => {
            // The side that the point is on.
            let normal = if normal.dot(&way) < 0.0 {
                -normal
            } else {
                normal
            };
            (normal, Feature::Face(normal))
        }
        // So near that rounding tells the way, the face does.
        (on, Some((_, face))) if distance <= 1e-13 * of.size => (face.normal, on),
        (on, _) if distance > 0.0 => (direction(&way), on),
        // On a line nothing tells a side.
        (Feature::Edge(along), _) => (across(&along), nearest.on),
        (on, _) => (axis(0), on),
    };
    Foot {
        distance,
        point: foot,
        normal,
        on,
    }
}

/// The foot on the plane of a face.
fn on_face<const D: usize>(point: &Vector<D>, height: f64, normal: Vector<D>) -> Foot<D> {
    Foot {
        distance: height,
        point: point - normal * height,
        normal,
        on: Feature::Face(normal),
    }
}

/// The way along an edge in the plane with this normal, its solid to the left.
fn along<const D: usize>(normal: &Vector<D>) -> Vector<D> {
    Vector::from_fn(|k, _| if k == 0 { -normal[1] } else { normal[0] })
}

/// The nearest point found so far.
struct Nearest<const D: usize> {
    square: f64,
    point: Vector<D>,
    on: Feature<D>,
}

impl<const D: usize> Default for Nearest<D> {
    fn default() -> Self {
        Self {
            square: f64::INFINITY,
            point: Vector::zeros(),
            on: Feature::Corner,
        }
    }
}

impl<const D: usize> Nearest<D> {
    fn corner(&mut self, corner: Vector<D>, point: &Vector<D>) {
        self.take(corner, Feature::Corner, point);
    }

    fn take(&mut self, foot: Vector<D>, on: Feature<D>, point: &Vector<D>) {
        let square = (point - foot).norm_squared();
        if square < self.square {
            *self = Self {
                square,
                point: foot,
                on,
            };
        }
    }

    /// Looks at an edge between two corners; in the plane it is a face.
    fn on_edge(
        &mut self,
        of: &Polytope<D>,
        point: &Vector<D>,
        ends: &[u32],
        along: &Vector<D>,
        edge: Option<&Edge<D>>,
    ) {
        let [from, to] = [of.at(ends[0]), of.at(ends[1])];
        let at = (point - from).dot(along);
        if at <= 0.0 {
            self.corner(from, point);
        } else if (point - to).dot(along) >= 0.0 {
            self.corner(to, point);
        } else {
            let on = match edge {
                None => Feature::Face(right(along)),
                Some(edge) => feature(edge),
            };
            self.take(from + along * at, on, point);
        }
    }
}

/// What a point of an edge in space lies on: it may be a seam within a face.
fn feature<const D: usize>(edge: &Edge<D>) -> Feature<D> {
    match edge.normals {
        Some([m, n]) if (m - n).norm_squared() < 1e-18 => Feature::Face(m),
        _ => Feature::Edge(edge.along),
    }
}

/// Calls `look` with distance, normal and foot of a point on each feature of some corners on
/// which it has one. The normal points to the point, which may be so far below a face.
pub(super) fn corner_to<const D: usize>(
    of: &Polytope<D>,
    chosen: &Chosen,
    point: &Vector<D>,
    rounding: f64,
    look: &mut impl FnMut(f64, Vector<D>, Vector<D>),
) {
    for face in of.faces.iter().filter(|face| chosen.has(&face.corners)) {
        let height = face.normal.dot(&(point - of.at(face.corners[0])));
        if height < -rounding {
            continue;
        }
        let foot = point - face.normal * height;
        if within(of, face, &foot) {
            look(height, face.normal, foot);
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
            look(gap, out_of(&way, gap), foot);
        }
    }
    for i in chosen.each(of.corners.len()) {
        let corner = of.at(i);
        let way = point - corner;
        let gap = way.norm();
        look(gap, out_of(&way, gap), corner);
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
