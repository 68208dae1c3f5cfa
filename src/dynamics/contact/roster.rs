//! What contacts must know of each agent and obstacle.

use super::pair::{Other, Pair};
use crate::math::{Matrix, Vector};
use crate::shape::{Geometry, In, Obstacle, Pose, Shape, Solid};
use crate::world::World;
use crate::world::spec::HeadingSpec;

/// The agents' bodies and all surfaces.
#[derive(Debug)]
pub(crate) struct Roster<const D: usize> {
    /// Solid of each group, and group of each agent.
    solids: Vec<Solid<D>>,
    groups: Vec<usize>,
    /// Radius of a ball about each group's solid, and of one in it.
    pub(super) outer: Vec<f64>,
    pub(super) inner: Vec<f64>,
    pub(super) inverse_mass: Vec<f64>,
    /// Inverse inertia tensor of each agent in its own frame; zero where it cannot turn.
    inverse_inertia: Vec<Matrix<3>>,
    /// Restitution and friction of each group, and of each obstacle where its own count.
    surfaces: Vec<(f64, f64)>,
    obstacles: Vec<(Option<f64>, Option<f64>)>,
    /// Restitution and friction of obstacles else.
    usual: (f64, f64),
}

/// Whether any surface of a world has friction.
pub(crate) fn has_friction<const D: usize>(world: &World<D>) -> bool {
    let groups = world.spec.agents.iter().filter_map(|it| it.friction);
    let obstacles = world.spec.obstacles.iter().filter_map(|it| it.friction);
    world.spec.physics.friction > 0.0 || groups.chain(obstacles).any(|it| it > 0.0)
}

/// Whether contacts can turn the bodies of a group, in a world with friction or without.
pub(crate) fn can_turn<const D: usize>(world: &World<D>, group: usize, friction: bool) -> bool {
    match world.solids[group].is_ball() {
        // Nothing can turn a ball without friction.
        true => friction,
        false => world.spec.agents[group].heading != Some(HeadingSpec::Fixed),
    }
}

/// Radius of the largest ball about its origin that a solid holds.
fn inner_radius<const D: usize>(solid: &Solid<D>) -> f64
where
    In<D>: Geometry<D>,
{
    match solid.shape() {
        Shape::Ball { radius } | Shape::Capsule { radius, .. } => *radius,
        Shape::Cuboid { half_extents } => half_extents.min(),
        shape => {
            let name = String::new();
            let here = Pose::new(Vector::zeros(), [0.0; 3]);
            let alone = Obstacle::new(name, shape.clone(), here);
            alone.map_or(0.0, |it| -it.project(&Vector::zeros()).distance)
        }
    }
}

impl<const D: usize> Roster<D> {
    pub(super) fn new(world: &World<D>) -> Self
    where
        In<D>: Geometry<D>,
    {
        let (agents, spec) = (&world.agents, &world.spec);
        let usual = (spec.physics.restitution, spec.physics.friction);
        let friction = has_friction(world);
        let inertia = |(&group, &mass): (&usize, &f64)| {
            let solid = &world.solids[group];
            if !can_turn(world, group, friction) {
                return Matrix::zeros();
            }
            let tensor = solid.inertia() * (mass / solid.volume());
            match D {
                2 => Matrix::<3>::from_diagonal(&[0.0, 0.0, 1.0 / tensor[(2, 2)]].into()),
                _ => tensor.try_inverse().unwrap_or_else(Matrix::zeros),
            }
        };
        let inner: Vec<f64> = world.solids.iter().map(inner_radius).collect();
        Self {
            outer: agents
                .group
                .iter()
                .map(|&it| world.solids[it].radius())
                .collect(),
            inner: agents.group.iter().map(|&it| inner[it]).collect(),
            solids: world.solids.clone(),
            groups: agents.group.clone(),
            inverse_mass: agents.mass.iter().map(|mass| 1.0 / mass).collect(),
            inverse_inertia: agents.group.iter().zip(&agents.mass).map(inertia).collect(),
            surfaces: spec
                .agents
                .iter()
                .map(|it| {
                    let friction = it.friction.unwrap_or(usual.1);
                    (it.restitution.unwrap_or(usual.0), friction)
                })
                .collect(),
            obstacles: spec
                .obstacles
                .iter()
                .map(|it| (it.restitution, it.friction))
                .collect(),
            usual,
        }
    }

    /// Number of agents.
    pub(super) fn len(&self) -> usize {
        self.groups.len()
    }

    pub(super) fn solid(&self, agent: usize) -> &Solid<D> {
        &self.solids[self.groups[agent]]
    }

    /// Inverse inertia tensor of an agent that stands so.
    pub(super) fn inverse_inertia(&self, agent: usize, rotation: &Matrix<D>) -> Matrix<3> {
        let own = &self.inverse_inertia[agent];
        if D == 2 || self.solid(agent).is_ball() {
            return *own;
        }
        let rotation = Matrix::<3>::from_fn(|i, j| rotation[(i, j)]);
        rotation * own * rotation.transpose()
    }

    /// Restitution and friction of a pair: the means of both surfaces', or the obstacle's own
    /// where it has some.
    pub(super) fn surfaces(&self, pair: Pair) -> (f64, f64) {
        let one = self.surface(pair.agent as usize);
        match pair.other {
            Other::Agent(other) => mean(one, self.surface(other as usize)),
            Other::Part(obstacle, _) => {
                let (restitution, friction) = mean(one, self.usual);
                let own = &self.obstacles[obstacle as usize];
                (own.0.unwrap_or(restitution), own.1.unwrap_or(friction))
            }
        }
    }

    /// Whether a pair loses some of its speed of approach in a blow, and so may come to rest.
    pub(super) fn loses(&self, pair: Pair) -> bool {
        self.surfaces(pair).0 < 1.0
    }

    fn surface(&self, agent: usize) -> (f64, f64) {
        self.surfaces[self.groups[agent]]
    }

    /// The size against which what an agent does is small or large.
    pub(super) fn size(&self, agent: usize) -> f64 {
        self.inner[agent]
    }

    /// The size of the smaller agent of a pair.
    pub(super) fn smaller(&self, pair: Pair) -> f64 {
        let sizes = pair.members().map(|it| self.size(it));
        sizes.fold(f64::INFINITY, f64::min)
    }

    /// Whether a part of an obstacle, or another agent, is round as well.
    pub(super) fn is_ball(&self, agent: usize) -> bool {
        self.solid(agent).is_ball()
    }
}

fn mean(one: (f64, f64), other: (f64, f64)) -> (f64, f64) {
    (0.5 * (one.0 + other.0), 0.5 * (one.1 + other.1))
}
