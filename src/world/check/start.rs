//! Checks of how agents start.

use super::Check;
use crate::world::problem::Problem;
use crate::world::spec::{GroupSpec, PlacementSpec, VelocitySpec};

/// How many positions a placement makes, where it says so by itself.
pub(super) fn positions(group: &GroupSpec) -> Option<usize> {
    match &group.positions {
        PlacementSpec::Explicit(positions) => Some(positions.len()),
        PlacementSpec::Grid(grid) => {
            let product = grid.points.iter().copied().reduce(usize::saturating_mul);
            Some(product.unwrap_or(0))
        }
        PlacementSpec::Box(_)
        | PlacementSpec::Ball(_)
        | PlacementSpec::Hexagonal(_)
        | PlacementSpec::Line(_) => None,
    }
}

impl Check {
    /// Checks where a group starts.
    pub(super) fn positions(&mut self, path: &str, group: &GroupSpec) {
        let positions = format!("{path}.positions");
        match &group.positions {
            PlacementSpec::Explicit(listed) if listed.is_empty() => {
                let path = format!("{positions}.explicit");
                self.add(path, "must list at least one position");
                return;
            }
            PlacementSpec::Explicit(listed) => {
                self.vectors(&format!("{positions}.explicit"), listed);
            }
            PlacementSpec::Box(place) => {
                self.finite(&format!("{positions}.box.separation"), place.separation);
                self.corners(&format!("{positions}.box"), &place.min, &place.max, false);
            }
            PlacementSpec::Ball(place) => {
                self.finite(&format!("{positions}.ball.separation"), place.separation);
                self.vector(&format!("{positions}.ball.center"), &place.center);
            }
            PlacementSpec::Grid(grid) => {
                self.vector(&format!("{positions}.grid.corner"), &grid.corner);
                if grid.points.len() != self.dimension {
                    let (needed, found) = (self.dimension, grid.points.len());
                    let what = format!("must have {needed} numbers, not {found}");
                    self.add(format!("{positions}.grid.points"), what);
                    return;
                }
            }
            PlacementSpec::Hexagonal(lattice) => {
                self.vector(&format!("{positions}.hexagonal.center"), &lattice.center);
            }
            PlacementSpec::Line(line) => {
                self.vector(&format!("{positions}.line.from"), &line.from);
                self.vector(&format!("{positions}.line.to"), &line.to);
            }
        }
        if let (Some(made), Some(count)) = (self::positions(group), group.count)
            && made != count
        {
            let what = match &group.positions {
                PlacementSpec::Explicit(_) => {
                    format!("must be {made}, the number of positions listed")
                }
                _ => format!("must be {made}, the number of points of the grid"),
            };
            let problem = Problem::new(format!("{path}.count"), what);
            self.problems.push(problem.hint("it may be left out"));
        }
    }

    /// Checks how fast the `count` agents of a group start.
    pub(super) fn velocities(&mut self, path: &str, velocities: &VelocitySpec, count: usize) {
        match velocities {
            VelocitySpec::Rest => {}
            VelocitySpec::Common(velocity) => {
                self.vector(&format!("{path}.common"), velocity);
            }
            VelocitySpec::Uniform(place) => {
                self.corners(&format!("{path}.uniform"), &place.min, &place.max, true);
            }
            VelocitySpec::Ball(place) => {
                self.optional_vector(&format!("{path}.ball.center"), &place.center);
            }
            VelocitySpec::Outward(outward) => {
                self.optional_vector(&format!("{path}.outward.center"), &outward.center);
            }
            VelocitySpec::Rotating(rotating) => {
                let unit = ["rate", "radians per time"];
                self.rotation(&format!("{path}.rotating.rate"), &rotating.rate, unit);
                self.optional_vector(&format!("{path}.rotating.center"), &rotating.center);
            }
            VelocitySpec::Explicit(listed) => {
                let path = format!("{path}.explicit");
                self.vectors(&path, listed);
                if listed.len() != count {
                    let found = listed.len();
                    let what =
                        format!("must list {count} velocities, one for each agent, not {found}");
                    self.add(path, what);
                }
            }
        }
    }
}
