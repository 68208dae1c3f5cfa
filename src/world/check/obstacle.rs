//! Checks of obstacles: poses and shapes.

use super::Check;
use crate::world::problem::Problem;
use crate::world::spec::{ObstacleSpec, Rotation, ShapeSpec};

impl Check {
    /// Checks an obstacle.
    pub(super) fn obstacle(&mut self, path: &str, obstacle: &ObstacleSpec) {
        if let Some(position) = &obstacle.position {
            self.vector(&format!("{path}.position"), position);
        }
        if let Some(rotation) = &obstacle.rotation {
            self.rotation(&format!("{path}.rotation"), rotation);
        }
        self.shape(&format!("{path}.shape"), &obstacle.shape);
    }

    /// A rotation must be of the world's dimension.
    pub(super) fn rotation(&mut self, path: &str, rotation: &Rotation) {
        match rotation {
            Rotation::Vector(vector) if self.dimension == 3 => {
                self.vector(path, vector);
            }
            Rotation::Vector(_) => {
                self.add(path, "must be one number in 2-D, the angle in radians");
            }
            Rotation::Angle(_) if self.dimension == 3 => {
                self.add(
                    path,
                    "must be 3 numbers in 3-D, the axis times the angle in radians",
                );
            }
            Rotation::Angle(_) => {}
        }
    }

    fn shape(&mut self, path: &str, shape: &ShapeSpec) {
        match shape {
            ShapeSpec::Ball { .. } => {}
            ShapeSpec::Cuboid { half_extents } => {
                self.vector(&format!("{path}.cuboid.half_extents"), half_extents);
            }
            ShapeSpec::Capsule { from, to, .. } => {
                let (start, end) = (format!("{path}.capsule.from"), format!("{path}.capsule.to"));
                let fits = self.vector(&start, from);
                if self.vector(&end, to) && fits && from == to {
                    let problem = Problem::new(end, "must differ from `from`");
                    self.problems
                        .push(problem.hint("a capsule without length is a ball"));
                }
            }
            ShapeSpec::HalfSpace { normal } => {
                self.direction(&format!("{path}.half_space.normal"), normal);
            }
            ShapeSpec::Convex { points } => self.hull(&format!("{path}.convex.points"), points),
        }
    }

    /// Points must span the space.
    pub(super) fn hull(&mut self, path: &str, points: &[Vec<f64>]) {
        self.vectors(path, points);
        if points.iter().any(|point| point.len() != self.dimension) {
            return;
        }
        if points.len() <= self.dimension {
            let what = format!("must have at least {} points", self.dimension + 1);
            self.add(path, what);
        } else if rank(points) < self.dimension {
            let flat = if self.dimension == 2 { "line" } else { "plane" };
            self.add(path, format!("must not all lie on one {flat}"));
        }
    }
}

/// Dimension of the smallest flat that holds all points, up to 1e-9 of their
/// spread: each round takes the point farthest from the flat so far into it.
fn rank(points: &[Vec<f64>]) -> usize {
    let Some(origin) = points.first() else {
        return 0;
    };
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
