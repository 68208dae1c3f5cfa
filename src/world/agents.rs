//! The agents of a world at its start: what their bodies are, where and how they stand.

use crate::math::{Matrix, Vector, axis, direction};
use crate::shape::{Geometry, In, Pose, Shape, Solid};
use crate::world::problem::Problem;
use crate::world::spec::{BodyShapeSpec, GroupSpec, HeadingSpec, PerAgent, Rotation, TorqueSpec};
use crate::world::vector;
use crate::world::words::number;

/// The agents at the start; each list has one entry for each agent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Agents<const D: usize> {
    /// Index of the group, which is also that of the body's solid.
    pub group: Vec<usize>,
    /// Radius of the smallest ball about the position that holds the body.
    pub radius: Vec<f64>,
    /// Mass.
    pub mass: Vec<f64>,
    /// Largest force that the laws can exert, infinite without limit.
    pub force_limit: Vec<f64>,
    /// Largest change of that force per unit of time, infinite without limit.
    pub force_rate_limit: Vec<f64>,
    /// Speed beyond which that force never takes the body, infinite without limit.
    pub top_speed: Vec<f64>,
    /// Position: of the body's centroid, which is its centre of mass.
    pub positions: Vec<Vector<D>>,
    /// Velocity.
    pub velocities: Vec<Vector<D>>,
    /// Rotation from the body's frame, in which its heading is the first axis, to the world's.
    /// Balls stand unturned.
    pub rotations: Vec<Matrix<D>>,
}

impl<const D: usize> Agents<D> {
    /// Number of agents.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Where the body of agent `i` stands.
    pub fn pose(&self, i: usize) -> Pose<D> {
        Pose::from_matrix(self.positions[i], self.rotations[i])
    }

    /// Adds what a group says of its `count` bodies, but for position and velocity. Where
    /// their masses cannot be computed with, returns what is wrong.
    pub(super) fn add_bodies(
        &mut self,
        index: usize,
        group: &GroupSpec,
        count: usize,
        solid: &Solid<D>,
    ) -> Option<Problem> {
        self.group.extend(vec![index; count]);
        self.radius.extend(vec![solid.radius(); count]);
        for (list, limit) in [
            (&mut self.force_limit, group.force_limit),
            (&mut self.force_rate_limit, group.force_rate_limit),
            (&mut self.top_speed, group.top_speed),
        ] {
            list.extend(vec![limit.unwrap_or(f64::INFINITY); count]);
        }
        match (&group.mass, group.density) {
            (Some(PerAgent::Each(masses)), _) => self.mass.extend(masses),
            (Some(PerAgent::All(mass)), _) => self.mass.extend(vec![*mass; count]),
            (None, Some(density)) => {
                let mass = density * solid.volume();
                self.mass.extend(vec![mass; count]);
                if !mass.is_normal() {
                    let what = format!("gives a mass of {}", number(mass));
                    let problem = Problem::new(format!("agents[{index}].density"), what);
                    return Some(problem.allowed("a density whose mass can be computed with"));
                }
            }
            (None, None) => self.mass.extend(vec![1.0; count]),
        }
        None
    }

    /// Turns the bodies of a group, the last `count` agents, as they stand at the start.
    pub(super) fn turn(&mut self, group: &GroupSpec, count: usize, solid: &Solid<D>) {
        let first = self.velocities.len() - count;
        let rotation = |velocity: &Vector<D>| match &group.rotation {
            _ if solid.is_ball() => Matrix::identity(),
            Some(rotation) => *Pose::new(Vector::zeros(), rotation.turn()).rotation(),
            None => along(&direction(velocity)),
        };
        let rotations = self.velocities[first..].iter().map(rotation);
        self.rotations.extend(rotations);
    }
}

impl Rotation {
    /// The rotation that a matrix stands for, its angle at most half a turn.
    pub fn of<const D: usize>(matrix: &Matrix<D>) -> Self {
        let turn = Pose::from_matrix(Vector::zeros(), *matrix).turn();
        match D {
            2 => Self::Angle(turn[2]),
            _ => Self::Vector(turn.into()),
        }
    }

    /// The rotation vector; in the plane its last component is the angle.
    pub fn turn(&self) -> [f64; 3] {
        match self {
            Self::Angle(angle) => [0.0, 0.0, *angle],
            Self::Vector(turn) => vector::<3>(turn).into(),
        }
    }
}

/// The solid of each group, its centroid at the origin.
pub(super) fn solids<const D: usize>(groups: &[GroupSpec]) -> Result<Vec<Solid<D>>, Vec<Problem>>
where
    In<D>: Geometry<D>,
{
    let mut solids = Vec::new();
    let mut problems = Vec::new();
    for (index, group) in groups.iter().enumerate() {
        match Solid::new(shape(&group.body_shape())).and_then(Solid::centered) {
            Some(solid) => solids.push(solid),
            None => problems.push(Problem::new(
                format!("agents[{index}].shape"),
                "is too thin to make a solid of: it must be about a thousandth as thick as it is \
                 wide",
            )),
        }
    }
    if problems.is_empty() {
        Ok(solids)
    } else {
        Err(problems)
    }
}

/// Writes out the defaults of a group that follow from others of its fields.
pub(super) fn fill_in(group: &mut GroupSpec) {
    if group.density.is_none() {
        group.mass.get_or_insert(PerAgent::All(1.0));
    }
    if group.is_round() {
        return;
    }
    let heading = group
        .heading
        .get_or_insert_with(|| HeadingSpec::Torque(TorqueSpec::default()));
    if let HeadingSpec::Torque(torque) = heading {
        torque.damping = Some(torque.damping());
    }
}

fn shape<const D: usize>(spec: &BodyShapeSpec) -> Shape<D> {
    match spec {
        BodyShapeSpec::Ball { radius } => Shape::Ball { radius: *radius },
        BodyShapeSpec::Capsule {
            half_length,
            radius,
        } => Shape::Capsule {
            from: axis::<D>(0) * -half_length,
            to: axis::<D>(0) * *half_length,
            radius: *radius,
        },
        BodyShapeSpec::Cuboid { half_extents } => Shape::Cuboid {
            half_extents: vector(half_extents),
        },
        BodyShapeSpec::Convex { points } => Shape::Convex {
            points: points.iter().map(|point| vector(point)).collect(),
        },
    }
}

/// A rotation that takes the first axis to the unit vector `heading`; none where it is zero. It
/// goes the shortest way, but for headings backwards, which turn by half a turn in the plane
/// of the first two axes before: near the opposite direction the shortest way is ill-defined.
fn along<const D: usize>(heading: &Vector<D>) -> Matrix<D> {
    let e: Vector<D> = axis(0);
    if heading.norm_squared() == 0.0 {
        return Matrix::identity();
    }
    if heading.dot(&e) >= 0.0 {
        return shortest(&e, heading);
    }
    let half_turn = Matrix::from_fn(|i, j| match (i == j, i < 2) {
        (false, _) => 0.0,
        (true, true) => -1.0,
        (true, false) => 1.0,
    });
    shortest(&-e, heading) * half_turn
}

/// The shortest rotation of one unit vector to another not opposite to it. With c = from·to it
/// is I + K + K²/(1 + c), K = to fromᵀ − from toᵀ; without trigonometric functions, which
/// differ between platforms.
fn shortest<const D: usize>(from: &Vector<D>, to: &Vector<D>) -> Matrix<D> {
    let k = to * from.transpose() - from * to.transpose();
    Matrix::identity() + k + k * k / (1.0 + from.dot(to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn turns_the_first_axis<const D: usize>(heading: Vector<D>) {
        let rotation = along(&heading);
        assert!((rotation * axis::<D>(0) - heading).norm() < 1e-10);
        assert!((rotation * rotation.transpose() - Matrix::<D>::identity()).norm() < 1e-6);
        let turn = Pose::from_matrix(Vector::zeros(), rotation).turn();
        let again = *Pose::<D>::new(Vector::zeros(), turn).rotation();
        assert!((again - rotation).norm() < 1e-6);
    }

    proptest! {
        #[test]
        fn bodies_stand_along_their_heading(x in prop::array::uniform3(-1.0..1.0f64)) {
            turns_the_first_axis(direction(&Vector::<3>::from(x)));
            turns_the_first_axis(direction(&Vector::<2>::new(x[0], x[1])));
        }
    }

    #[test]
    fn headings_along_the_first_axis_are_no_special_case() {
        turns_the_first_axis(Vector::<2>::new(-1.0, 0.0));
        turns_the_first_axis(Vector::<3>::new(-1.0, 0.0, 0.0));
        turns_the_first_axis(Vector::<3>::new(1.0, 0.0, 0.0));
        assert_eq!(along(&Vector::<2>::zeros()), Matrix::<2>::identity());
    }
}
