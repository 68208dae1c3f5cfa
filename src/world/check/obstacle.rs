//! Checks of obstacles: poses, shapes and motions.

use super::{Check, LARGEST};
use crate::world::limits::MOST_CORNERS;
use crate::world::problem::Problem;
use crate::world::spec::{Heights, MotionSpec, ObstacleSpec, Rotation, ShapeSpec};
use crate::world::words::number;

/// Steps that the shortest oscillation takes; a shorter one would look like another motion.
const LEAST_STEPS: f64 = 4.0;

/// The largest turn of an obstacle in a step, in radians: contacts must be foreseen as far as
/// its ends swing.
const LARGEST_TURN: f64 = 0.5;

impl Check {
    /// Checks an obstacle.
    pub(super) fn obstacle(&mut self, path: &str, obstacle: &ObstacleSpec) {
        self.pose(path, &obstacle.position, &obstacle.rotation);
        self.shape(&format!("{path}.shape"), &obstacle.shape);
        self.finite(&format!("{path}.restitution"), obstacle.restitution);
        self.finite(&format!("{path}.friction"), obstacle.friction);
        let motion = format!("{path}.motion");
        match &obstacle.motion {
            Some(MotionSpec::Rotation { .. }) if !is_bounded(&obstacle.shape) => {
                let what = "must not turn what has no bounds";
                let problem = Problem::new(format!("{motion}.rotation"), what);
                let hint = "half-spaces and rooms may oscillate, drift or go round waypoints";
                self.problems.push(problem.hint(hint));
            }
            Some(MotionSpec::Waypoints { .. }) if obstacle.position.is_some() => {
                let what = "must be absent, since the waypoints say where the obstacle is";
                self.add(format!("{path}.position"), what);
            }
            _ => {}
        }
        if let Some(spec) = &obstacle.motion {
            self.motion(&motion, spec);
        }
    }

    fn pose(&mut self, path: &str, position: &Option<Vec<f64>>, rotation: &Option<Rotation>) {
        self.optional_vector(&format!("{path}.position"), position);
        if let Some(rotation) = rotation {
            self.rotation(&format!("{path}.rotation"), rotation, ["angle", "radians"]);
        }
    }

    /// A rotation or its rate: one number in 2-D, a vector in 3-D.
    pub(super) fn rotation(&mut self, path: &str, rotation: &Rotation, [what, unit]: [&str; 2]) {
        match rotation {
            Rotation::Vector(vector) if self.dimension == 3 => {
                self.vector(path, vector);
            }
            Rotation::Vector(_) => {
                self.add(
                    path,
                    format!("must be one number in 2-D, the {what} in {unit}"),
                );
            }
            Rotation::Angle(_) if self.dimension == 3 => {
                let what = format!("must be 3 numbers in 3-D, the axis times the {what} in {unit}");
                self.add(path, what);
            }
            Rotation::Angle(angle) => self.computable(path, angle.abs()),
        }
    }

    /// Sizes that follow from several fields must stay computable, as vectors must.
    fn computable(&mut self, path: &str, size: f64) {
        if size.is_nan() || size > LARGEST {
            self.add(path, "makes numbers too large to compute with");
        }
    }

    fn motion(&mut self, path: &str, motion: &MotionSpec) {
        match motion {
            MotionSpec::Oscillation {
                amplitude,
                period,
                phase,
            } => {
                let path = format!("{path}.oscillation");
                self.vector(&format!("{path}.amplitude"), amplitude);
                self.computable(&format!("{path}.phase"), phase.abs());
                self.computable(&format!("{path}.period"), largest(amplitude) / period);
                if *period < LEAST_STEPS * self.step {
                    let least = number(LEAST_STEPS * self.step);
                    let what = format!("must be at least {least}, a few steps");
                    self.add(format!("{path}.period"), what);
                }
            }
            MotionSpec::Rotation { about, rate } => {
                self.optional_vector(&format!("{path}.rotation.about"), about);
                let unit = ["rate", "radians per time"];
                let path = format!("{path}.rotation.rate");
                self.rotation(&path, rate, unit);
                let turn = rate.turn().iter().map(|x| x * x).sum::<f64>().sqrt() * self.step;
                if turn > LARGEST_TURN && turn.is_finite() {
                    let most = number(LARGEST_TURN / self.step);
                    let what = format!("turns it by {} radians in a step", number(turn));
                    let problem = Problem::new(path, what);
                    self.problems
                        .push(problem.allowed(format!("at most {most} per time at this step")));
                }
            }
            MotionSpec::Waypoints {
                points,
                dwell,
                period,
                ..
            } => {
                let path = format!("{path}.waypoints");
                let at = format!("{path}.points");
                self.vectors(&at, points);
                if points.len() < 2 || points.iter().all(|point| *point == points[0]) {
                    self.add(at, "must hold at least two different points");
                }
                let stays = dwell * points.len() as f64;
                if stays >= *period {
                    let what = format!(
                        "must be greater than {}, the time spent at the points",
                        number(stays)
                    );
                    self.add(format!("{path}.period"), what);
                } else {
                    let farthest = points
                        .iter()
                        .map(|point| largest(point))
                        .fold(0.0, f64::max);
                    self.computable(&format!("{path}.period"), farthest / (period - stays));
                }
            }
            MotionSpec::Drift { velocity } => {
                self.vector(&format!("{path}.drift.velocity"), velocity);
            }
        }
    }

    fn shape(&mut self, path: &str, shape: &ShapeSpec) {
        match shape {
            ShapeSpec::Ball { .. } => {}
            ShapeSpec::Cuboid { half_extents } => {
                self.vector(&format!("{path}.cuboid.half_extents"), half_extents);
            }
            ShapeSpec::Capsule { from, to, .. } => {
                let hint = Some("a capsule without length is a ball");
                self.ends(&format!("{path}.capsule"), from, to, hint);
            }
            ShapeSpec::HalfSpace { normal } => {
                self.direction(&format!("{path}.half_space.normal"), normal);
            }
            ShapeSpec::Convex { points } => self.hull(&format!("{path}.convex.points"), points),
            ShapeSpec::Segment { from, to } => {
                self.ends(&format!("{path}.segment"), from, to, None);
            }
            ShapeSpec::Triangle { points } => {
                let path = format!("{path}.triangle.points");
                self.vectors(&path, points);
                if points.len() != 3 {
                    self.add(path, format!("must have 3 points, not {}", points.len()));
                } else if rank(points) < 2 {
                    self.add(path, "must not all lie on one line");
                }
            }
            ShapeSpec::Polyline { points, closed } => {
                self.chain(&format!("{path}.polyline.points"), points, *closed);
            }
            ShapeSpec::Mesh {
                vertices,
                triangles,
            } => self.mesh(&format!("{path}.mesh"), vertices, triangles),
            ShapeSpec::Heightfield { depth, heights, .. } => {
                self.heightfield(&format!("{path}.heightfield"), *depth, heights);
            }
            ShapeSpec::Compound { parts } => {
                for (index, part) in parts.iter().enumerate() {
                    let path = format!("{path}.compound.parts[{index}]");
                    self.pose(&path, &part.position, &part.rotation);
                    self.shape(&format!("{path}.shape"), &part.shape);
                }
            }
            ShapeSpec::Room { half_extents } => {
                self.vector(&format!("{path}.room.half_extents"), half_extents);
            }
            ShapeSpec::Corridor { points, closed, .. } => {
                self.chain(&format!("{path}.corridor.points"), points, *closed);
            }
        }
    }

    /// The ends of a segment, which must be two.
    fn ends(&mut self, path: &str, from: &[f64], to: &[f64], hint: Option<&str>) {
        let fits = self.vector(&format!("{path}.from"), from);
        let end = format!("{path}.to");
        if self.vector(&end, to) && fits && from == to {
            let problem = Problem::new(end, "must differ from `from`");
            self.problems.push(match hint {
                Some(hint) => problem.hint(hint),
                None => problem,
            });
        }
    }

    /// The points of a chain of segments.
    fn chain(&mut self, path: &str, points: &[Vec<f64>], closed: bool) {
        self.vectors(path, points);
        let least = if closed { 3 } else { 2 };
        if points.len() < least {
            let kind = if closed { "closed chain" } else { "chain" };
            self.add(
                path,
                format!("must have at least {least} points for a {kind}"),
            );
            return;
        }
        for index in 1..points.len() {
            if points[index] == points[index - 1] {
                let what = "must differ from the point before it";
                self.add(format!("{path}[{index}]"), what);
            }
        }
        let last = points.len() - 1;
        if closed && points[last] == points[0] {
            let problem = Problem::new(format!("{path}[{last}]"), "must differ from the first");
            let hint = "a closed chain goes back to the first point by itself";
            self.problems.push(problem.hint(hint));
        }
    }

    fn mesh(&mut self, path: &str, vertices: &[Vec<f64>], triangles: &[Vec<usize>]) {
        let at = format!("{path}.vertices");
        let before = self.problems.len();
        self.vectors(&at, vertices);
        let sound = self.problems.len() == before;
        for (index, triangle) in triangles.iter().enumerate() {
            let at = format!("{path}.triangles[{index}]");
            if triangle.len() != 3 {
                let what = format!("must name 3 vertices, not {}", triangle.len());
                self.add(at, what);
                continue;
            }
            let beyond = triangle.iter().position(|&corner| corner >= vertices.len());
            if let Some(place) = beyond {
                let what = format!(
                    "must be less than {}, the number of vertices",
                    vertices.len()
                );
                self.add(format!("{at}[{place}]"), what);
                continue;
            }
            let corners: Vec<_> = triangle.iter().map(|&i| vertices[i].clone()).collect();
            if sound && rank(&corners) < 2 {
                self.add(at, "must not have all its vertices on one line");
            }
        }
    }

    fn heightfield(&mut self, path: &str, depth: Option<f64>, heights: &Heights) {
        let at = format!("{path}.heights");
        match heights {
            Heights::Row(_) if self.dimension == 3 => {
                self.add(at, "must be a list of rows of heights in 3-D");
            }
            Heights::Rows(_) if self.dimension == 2 => {
                self.add(at, "must be a list of numbers in 2-D");
            }
            Heights::Row(row) => {
                self.heights(&at, row);
                if depth.is_some() {
                    self.add(format!("{path}.depth"), "must be absent in 2-D");
                }
            }
            Heights::Rows(rows) => {
                if rows.len() < 2 {
                    self.add(&at, "must have at least 2 rows");
                }
                for (index, row) in rows.iter().enumerate() {
                    let at = format!("{at}[{index}]");
                    self.heights(&at, row);
                    if row.len() != rows[0].len() {
                        let what = format!(
                            "must have {} heights, as the first row has, not {}",
                            rows[0].len(),
                            row.len()
                        );
                        self.add(at, what);
                    }
                }
                self.finite(&format!("{path}.depth"), depth);
                if depth.is_none() {
                    self.add(path, "missing field `depth`, which 3-D needs");
                }
            }
        }
    }

    fn heights(&mut self, path: &str, row: &[f64]) {
        if row.len() < 2 {
            self.add(path, "must have at least 2 heights");
        }
        self.computable(path, largest(row));
    }

    /// Points must span the space.
    pub(super) fn hull(&mut self, path: &str, points: &[Vec<f64>]) {
        self.vectors(path, points);
        if points.iter().any(|point| point.len() != self.dimension) {
            return;
        }
        if points.len() > MOST_CORNERS {
            let problem = Problem::new(path, format!("has {} points", points.len()));
            self.problems
                .push(problem.allowed(format!("at most {MOST_CORNERS}")));
        } else if points.len() <= self.dimension {
            let what = format!("must have at least {} points", self.dimension + 1);
            self.add(path, what);
        } else if rank(points) < self.dimension {
            let flat = if self.dimension == 2 { "line" } else { "plane" };
            self.add(path, format!("must not all lie on one {flat}"));
        }
    }
}

/// How many convex parts a shape is made of, and how many of them have no bounds. Each of a
/// room's walls is as far as all of it.
pub(super) fn parts(shape: &ShapeSpec) -> (usize, usize) {
    let pieces = |points: &[Vec<f64>], closed: bool| points.len().max(1) - usize::from(!closed);
    match shape {
        ShapeSpec::HalfSpace { .. } => (1, 1),
        ShapeSpec::Room { half_extents } => (2 * half_extents.len(), 2 * half_extents.len()),
        ShapeSpec::Polyline { points, closed } => (pieces(points, *closed), 0),
        ShapeSpec::Corridor { points, closed, .. } => (8 * pieces(points, *closed), 0),
        ShapeSpec::Mesh { triangles, .. } => (triangles.len(), 0),
        ShapeSpec::Heightfield { heights, .. } => match heights {
            Heights::Row(row) => (row.len(), 0),
            Heights::Rows(rows) => (rows.iter().map(|row| 2 * row.len()).sum(), 0),
        },
        ShapeSpec::Compound { parts } => parts
            .iter()
            .map(|part| self::parts(&part.shape))
            .fold((0, 0), |(all, endless), (own, more)| {
                (all.saturating_add(own), endless + more)
            }),
        ShapeSpec::Ball { .. }
        | ShapeSpec::Cuboid { .. }
        | ShapeSpec::Capsule { .. }
        | ShapeSpec::Convex { .. }
        | ShapeSpec::Segment { .. }
        | ShapeSpec::Triangle { .. } => (1, 0),
    }
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most, x| f64::max(most, x.abs()))
}

/// Whether a shape ends somewhere in every direction.
fn is_bounded(shape: &ShapeSpec) -> bool {
    match shape {
        ShapeSpec::HalfSpace { .. } | ShapeSpec::Room { .. } => false,
        ShapeSpec::Compound { parts } => parts.iter().all(|part| is_bounded(&part.shape)),
        _ => true,
    }
}

/// Dimension of the smallest flat that holds all points, up to 1e-9 of their
/// spread: each round takes the point farthest from the flat so far into it.
fn rank(points: &[Vec<f64>]) -> usize {
    let Some(origin) = points.first() else {
        return 0;
    };
    if points.iter().any(|point| point.len() != origin.len()) {
        // Reported elsewhere.
        return origin.len();
    }
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let from_origin =
        |point: &Vec<f64>| -> Vec<f64> { point.iter().zip(origin).map(|(x, o)| x - o).collect() };
    let mut rest: Vec<Vec<f64>> = points.iter().map(from_origin).collect();
    let spread = rest.iter().map(|v| length(v)).fold(0.0, f64::max);
    for rank in 0..origin.len() {
        let farthest = rest.iter().max_by(|a, b| length(a).total_cmp(&length(b)));
        let Some(axis) = farthest.filter(|v| length(v) > 1e-9 * spread).cloned() else {
            return rank;
        };
        let square = length(&axis).powi(2);
        for v in &mut rest {
            let share = v.iter().zip(&axis).map(|(x, a)| x * a).sum::<f64>() / square;
            v.iter_mut().zip(&axis).for_each(|(x, a)| *x -= share * a);
        }
    }
    origin.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rank_counts_directions() {
        let points = |list: &[[f64; 3]]| list.iter().map(|p| p.to_vec()).collect::<Vec<_>>();
        assert_eq!(rank(&points(&[[1.0, 2.0, 3.0]; 4])), 0);
        assert_eq!(rank(&points(&[[0.0; 3], [1.0; 3], [2.0; 3], [-5.0; 3]])), 1);
        let square = [
            [0.0, 0.0, 7.0],
            [1.0, 0.0, 7.0],
            [1.0, 1.0, 7.0],
            [0.0, 1.0, 7.0],
        ];
        assert_eq!(rank(&points(&square)), 2);
        let far = 1e6;
        let corner = [
            [far, far, far],
            [far + 1.0, far, far],
            [far, far + 1.0, far],
            [far, far, far + 1e-3],
        ];
        assert_eq!(rank(&points(&corner)), 3);
        let mut nearly_flat = square;
        nearly_flat[3][2] += 1e-11;
        assert_eq!(rank(&points(&nearly_flat)), 2);
    }
}
