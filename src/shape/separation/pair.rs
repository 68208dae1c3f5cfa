//! Two polytopes that stand to each other: how far apart, or how deep in each other.

use super::patch;
use super::point::{corner_to, foot};
use super::simplex::{Corner, Simplex};
use crate::math::{Vector, axis, direction};
use crate::shape::polytope::{Edge, Polytope, Stand, across, cross};

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

/// The places on two lines that are nearest to each other.
fn lines<const D: usize>(
    from: &Vector<D>,
    along: &Vector<D>,
    other_from: &Vector<D>,
    other_along: &Vector<D>,
) -> (f64, f64) {
    let way = other_from - from;
    // Not by cosines, which tell nothing of nearly parallel lines.
    let normal = cross(along, other_along);
    let square = normal.norm_squared();
    let at = |line: &Vector<D>| cross(&way, line).dot(&normal) / square;
    (at(other_along), at(along))
}

/// Corners of both polytopes.
pub(super) struct Features {
    pub(super) one: Chosen,
    pub(super) other: Chosen,
}

/// How many corners are told one by one; where there are more, all are taken.
const MOST: usize = 32;

/// Some corners of a polytope.
pub(super) struct Chosen {
    list: [u32; MOST],
    /// How many; `None` stands for all.
    count: Option<usize>,
}

impl Chosen {
    pub(super) fn all() -> Self {
        Self {
            list: [0; MOST],
            count: None,
        }
    }

    /// Those at most `within` nearer than the farthest along a direction.
    pub(super) fn farthest<const D: usize>(
        of: &Polytope<D>,
        along: &Vector<D>,
        within: f64,
    ) -> Self {
        let (_, far) = of.farthest(along);
        let (mut list, mut count) = ([0; MOST], 0);
        for (i, corner) in of.corners.iter().enumerate() {
            if corner.dot(along) >= far - within {
                if count == MOST {
                    return Self::all();
                }
                list[count] = i as u32;
                count += 1;
            }
        }
        Self {
            list,
            count: Some(count),
        }
    }

    /// Those told one by one; none where all are taken.
    pub(super) fn list(&self) -> &[u32] {
        &self.list[..self.count.unwrap_or(0)]
    }

    /// Whether it is one corner alone.
    pub(super) fn is_corner(&self) -> bool {
        self.count == Some(1)
    }

    pub(super) fn has(&self, corners: &[u32]) -> bool {
        match self.count {
            None => true,
            Some(count) => corners.iter().all(|it| self.list[..count].contains(it)),
        }
    }

    pub(super) fn each(&self, of: usize) -> impl Iterator<Item = u32> {
        let count = self.count.unwrap_or(of);
        (0..count).map(move |k| match self.count {
            None => k as u32,
            Some(_) => self.list[k],
        })
    }
}

impl Features {
    fn all() -> Self {
        Self {
            one: Chosen::all(),
            other: Chosen::all(),
        }
    }

    /// The nearest two points of the features of these corners; `None` where there are none, for
    /// the polytopes overlap.
    fn nearest<const D: usize>(&self, pair: &Pair<'_, D>) -> Option<Found<D>> {
        let mut best: Option<Found<D>> = None;
        let mut look = |found: Found<D>| {
            let better = match &best {
                None => true,
                // To rounding as near: the one whose normal proves it.
                Some(best) if (found.gap - best.gap).abs() <= 1e-15 * (best.gap + pair.size) => {
                    found.normal != best.normal
                        && pair.along(&found.normal) > pair.along(&best.normal)
                }
                Some(best) => found.gap < best.gap,
            };
            if better {
                best = Some(found);
            }
        };
        let Pair {
            one, other, stand, ..
        } = pair;
        let rounding = 4e-15 * pair.size;
        for j in self.other.each(other.corners.len()) {
            let point = stand.point(&other.at(j));
            corner_to(
                one,
                &self.one,
                &point,
                rounding,
                &mut |gap, normal, foot| {
                    look(Found {
                        gap,
                        normal,
                        points: [foot, point],
                    });
                },
            );
        }
        for i in self.one.each(one.corners.len()) {
            let corner = one.at(i);
            let point = stand.back(&(corner - stand.shift));
            corner_to(
                other,
                &self.other,
                &point,
                rounding,
                &mut |gap, normal, foot| {
                    look(Found {
                        gap,
                        normal: -stand.vector(&normal),
                        points: [corner, stand.point(&foot)],
                    });
                },
            );
        }
        let chosen = |of: &'_ Chosen, ends: &[u32; 2]| of.has(ends);
        for first in one.edges.iter().filter(|it| chosen(&self.one, &it.ends)) {
            for second in (other.edges.iter()).filter(|it| chosen(&self.other, &it.ends)) {
                if let Some(found) = edges(pair, first, second) {
                    look(found);
                }
            }
        }
        best
    }
}

/// The nearest points of two edges where they lie within both.
fn edges<const D: usize>(
    pair: &Pair<'_, D>,
    first: &Edge<D>,
    second: &Edge<D>,
) -> Option<Found<D>> {
    let along = pair.stand.vector(&second.along);
    let normal = cross(&first.along, &along);
    let sine = normal.norm();
    if sine < 1e-12 {
        return None;
    }
    let ends = first.ends.map(|i| pair.one.at(i));
    let others = second.ends.map(|j| pair.stand.point(&pair.other.at(j)));
    let (s, t) = lines(&ends[0], &first.along, &others[0], &along);
    let within = |at: f64, ends: &[Vector<D>; 2]| at > 0.0 && at < (ends[1] - ends[0]).norm();
    if !(within(s, &ends) && within(t, &others)) {
        return None;
    }
    let points = [ends[0] + first.along * s, others[0] + along * t];
    let way = points[1] - points[0];
    let gap = way.norm();
    let out = normal / sine * normal.dot(&way).signum();
    // Nearly parallel lines tell a worse normal than the way between them, unless that is short.
    let normal = match gap > sine * pair.size {
        // Of what rounding leaves along the edge nothing may stay.
        true => direction(&(way - first.along * first.along.dot(&way))),
        false => out,
    };
    Some(Found {
        gap,
        normal,
        points,
    })
}
