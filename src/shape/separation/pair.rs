//! Two polytopes that stand to each other: how far apart, or how deep in each other.

use super::features::{Chosen, Features};
use super::patch;
use super::point::foot;
use super::simplex::{Corner, Simplex};
use crate::math::{Vector, axis, direction};
use crate::shape::polytope::{Polytope, Stand, across, cross};

/// Two polytopes, all told in the frame of the first, from its middle.
pub(super) struct Pair<'a, const D: usize> {
    pub(super) one: &'a Polytope<D>,
    pub(super) other: &'a Polytope<D>,
    pub(super) stand: Stand<D>,
    /// The larger of their sizes.
    pub(super) size: f64,
}

/// What was found, in the frame of the first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found<const D: usize> {
    pub(super) gap: f64,
    /// From the first to the second.
    pub(super) normal: Vector<D>,
    pub(super) points: [Vector<D>; 2],
}

impl<'a, const D: usize> Pair<'a, D> {
    pub(super) fn new(one: &'a Polytope<D>, other: &'a Polytope<D>, stand: Stand<D>) -> Self {
        Self {
            size: one.size.max(other.size),
            one,
            other,
            stand,
        }
    }

    /// How they stand to each other.
    pub(super) fn solve(&self) -> Found<D> {
        match [self.one, self.other].map(|it| it.corners.len() == 1) {
            [true, true] => return self.of_points(),
            [true, false] => return self.of_one_point(),
            [false, true] => {
                let point = self.stand.shift;
                let foot = foot(self.one, &point);
                return Found {
                    gap: foot.distance,
                    normal: foot.normal,
                    points: [foot.point, point],
                };
            }
            [false, false] => {}
        }
        let mut found = match self.way() {
            Some(way) => self.apart(&way),
            None => self.deepest(),
        };
        if let Some(points) = patch::middle(self, &found.normal, found.gap) {
            found.points = points;
        }
        found
    }

    fn of_points(&self) -> Found<D> {
        let way = self.stand.shift;
        let gap = way.norm();
        Found {
            gap,
            normal: if gap > 0.0 { direction(&way) } else { axis(0) },
            points: [Vector::zeros(), way],
        }
    }

    /// The first is a point.
    fn of_one_point(&self) -> Found<D> {
        let foot = foot(self.other, &-self.stand.back(&self.stand.shift));
        Found {
            gap: foot.distance,
            normal: -self.stand.vector(&foot.normal),
            points: [Vector::zeros(), self.stand.point(&foot.point)],
        }
    }

    /// How far they are apart along a direction; below 0 by how much they overlap along it.
    pub(super) fn along(&self, normal: &Vector<D>) -> f64 {
        let (_, front) = self.one.farthest(normal);
        let (_, back) = self.other.farthest(&-self.stand.back(normal));
        self.stand.shift.dot(normal) - back - front
    }

    /// The corner of their difference farthest against a direction.
    fn support(&self, along: &Vector<D>) -> Corner<D> {
        let (i, _) = self.one.farthest(along);
        let (j, _) = self.other.farthest(&-self.stand.back(along));
        Corner {
            of: [i, j],
            at: self.stand.point(&self.other.at(j)) - self.one.at(i),
        }
    }

    /// About the way from the one to the other (Gilbert, Johnson, Keerthi 1988); `None` where
    /// they overlap, or touch to rounding.
    fn way(&self) -> Option<Vector<D>> {
        let mut way = self.stand.shift;
        if way == Vector::<D>::zeros() {
            way = axis(0);
        }
        let mut simplex = Simplex::new();
        let mut shortest = f64::INFINITY;
        let touching = 1e-14 * self.size;
        for _ in 0..60 {
            let corner = self.support(&way);
            let again = simplex.corners().iter().any(|it| it.of == corner.of);
            let better = way.norm_squared() - way.dot(&corner.at);
            if shortest.is_finite() && (again || better <= 1e-15 * way.norm_squared()) {
                break;
            }
            simplex.push(corner);
            let nearest = simplex.reduce()?;
            let length = nearest.norm();
            if length <= touching {
                return None;
            }
            if length >= shortest {
                break;
            }
            (way, shortest) = (nearest, length);
        }
        Some(way)
    }

    /// The exact answer for two that are apart, about along `way`.
    fn apart(&self, way: &Vector<D>) -> Found<D> {
        let length = way.norm();
        let along = way / length;
        // The features found may be off by as much as the way is turned by rounding.
        let share = f64::max(1e-9, (1e-14 * self.size / length).min(1.0));
        let proven = |found: &Found<D>, slack: f64| {
            self.along(&found.normal) >= found.gap - slack * self.size
        };
        // Rounding turns the way between near corners.
        let turned = |found: &Found<D>| 1e-13 + 1e-15 * self.size / found.gap;
        let near = self.features(&along, share).nearest(self);
        if let Some(found) = near.filter(|it| proven(it, 1e-13)) {
            return found;
        }
        let likely = near.filter(|it| proven(it, turned(it)));
        let found = likely.or_else(|| Features::all().nearest(self));
        // They overlap, or nearly.
        let deepest = self.deepest();
        match found {
            Some(found) if proven(&found, 1e-13) => found,
            Some(found) if deepest.gap > 0.0 => {
                let normal = match proven(&found, turned(&found)) && found.gap > 1e-10 * self.size {
                    true => found.normal,
                    false => deepest.normal,
                };
                let [point, _] = found.points;
                Found {
                    normal,
                    points: [point, point + normal * found.gap],
                    ..found
                }
            }
            _ => deepest,
        }
    }

    /// The corners that are farthest along a direction, or nearly.
    pub(super) fn features(&self, along: &Vector<D>, share: f64) -> Features {
        let back = -self.stand.back(along);
        let rounding = 4e-15 * self.size;
        Features {
            one: Chosen::farthest(self.one, along, share * self.one.size + rounding),
            other: Chosen::farthest(self.other, &back, share * self.other.size + rounding),
        }
    }

    /// The direction along which they are farthest apart, or overlap least, among the normals of
    /// faces and, in space, of pairs of edges. Where they overlap it is the shortest way out.
    fn deepest(&self) -> Found<D> {
        let mut best: Option<(f64, Vector<D>)> = None;
        let mut look = |normal: Vector<D>, least: f64| {
            let gap = self.along(&normal);
            if best.as_ref().is_none_or(|(most, _)| gap > most + least) {
                best = Some((gap, normal));
            }
        };
        // Faces come first: an edge must be better by more than rounding.
        let more = 1e-13 * self.size;
        for face in &self.one.faces {
            look(face.normal, 0.0);
        }
        for face in &self.other.faces {
            look(-self.stand.vector(&face.normal), 0.0);
        }
        for second in &self.other.edges {
            let along = self.stand.vector(&second.along);
            for first in &self.one.edges {
                // Most pairs cannot both be outermost, which takes no root to see.
                let back = self.stand.back(&first.along);
                if !(turns(&first.normals, &along) && turns(&second.normals, &back)) {
                    continue;
                }
                let normal = cross(&first.along, &along);
                let sine = normal.norm();
                if sine < 1e-13 {
                    continue;
                }
                let normal = normal / sine;
                for normal in [normal, -normal] {
                    let back = -self.stand.back(&normal);
                    if supports(&first.normals, &normal) && supports(&second.normals, &back) {
                        look(normal, more);
                    }
                }
            }
        }
        // What has no faces is as deep in the other as it is across.
        let lines = (self.one.edges.iter().map(|edge| edge.along)).chain(
            self.other
                .edges
                .iter()
                .map(|it| self.stand.vector(&it.along)),
        );
        if self.one.faces.is_empty() && self.other.faces.is_empty() {
            for along in lines {
                let normal = across(&along);
                look(normal, 0.0);
                look(-normal, 0.0);
            }
        }
        let (gap, normal) = best.expect("one of the two is no point");
        Found {
            gap,
            normal,
            points: self.in_line(&normal, gap),
        }
    }

    /// The deepest points along a normal: a corner, or the crossing of two edges.
    fn in_line(&self, normal: &Vector<D>, gap: f64) -> [Vector<D>; 2] {
        let near = self.features(normal, 1e-10);
        let (i, _) = self.one.farthest(normal);
        let (j, _) = self.other.farthest(&-self.stand.back(normal));
        let other = self.stand.point(&self.other.at(j));
        let point = match (near.one.is_corner(), near.other.is_corner()) {
            (true, _) => self.one.at(i),
            (false, true) => other - normal * gap,
            // Edges that cross, or what lies beside each other.
            (false, false) => match near.nearest(self) {
                Some(found) => found.points[0],
                None => other - normal * gap,
            },
        };
        [point, point + normal * gap]
    }
}

/// Whether, between the normals of the faces that meet at an edge, one is across a direction.
fn turns<const D: usize>(normals: &Option<[Vector<D>; 2]>, along: &Vector<D>) -> bool {
    match normals {
        None => true,
        Some([m, n]) => m.dot(along) * n.dot(along) <= 1e-9,
    }
}

/// Whether an edge whose faces have these normals can be the farthest along a direction across it.
fn supports<const D: usize>(normals: &Option<[Vector<D>; 2]>, along: &Vector<D>) -> bool {
    match normals {
        None => true,
        Some([m, n]) => {
            // Between the two, or to rounding.
            let (a, b, c) = (m.dot(along), n.dot(along), m.dot(n));
            a - c * b >= -1e-9 && b - c * a >= -1e-9
        }
    }
}
