//! A world, ready to run: agents placed, obstacles built.

use crate::math::Vector;
use crate::shape::{Geometry, In, Obstacle, Pose, Shape, Solid};
use crate::world::agents::{self, Agents, solids};
use crate::world::check;
use crate::world::overlap::overlaps;
use crate::world::placement::Placement;
use crate::world::problem::Problem;
use crate::world::random::{Purpose, Random};
use crate::world::spec::{
    AlphaInteractionSpec, GroupSpec, LawSpec, ObstacleSpec, Rotation, ShapeSpec, VelocitySpec,
    WorldSpec,
};
use crate::world::{vector, vector_or_zero};

/// A world of either dimension.
#[derive(Debug)]
pub enum AnyWorld {
    /// A world in the plane.
    Plane(World<2>),
    /// A world in space.
    Space(World<3>),
}

/// A world of `D` dimensions: its file with every default filled in, and what follows
/// from it.
#[derive(Debug)]
pub struct World<const D: usize> {
    /// Name, for traces and reports.
    pub name: String,
    /// The file.
    pub spec: WorldSpec,
    /// The agents at the start.
    pub agents: Agents<D>,
    /// The solid of each group's bodies, the centroid at the origin of its frame and the
    /// heading along the first axis.
    pub solids: Vec<Solid<D>>,
    /// The obstacles.
    pub obstacles: Vec<Obstacle<D>>,
    /// Acceleration of gravity.
    pub gravity: Vector<D>,
}

impl AnyWorld {
    /// Checks and resolves a world.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn new(name: impl Into<String>, spec: WorldSpec) -> Result<Self, Vec<Problem>> {
        sound(&spec)?;
        Self::resolve(name.into(), spec)
    }

    /// Resolves a checked world; the problems left are those that only placing the agents
    /// and building the obstacles can find.
    pub(super) fn resolve(name: String, spec: WorldSpec) -> Result<Self, Vec<Problem>> {
        match spec.dimension {
            2 => World::resolve(name, spec).map(Self::Plane),
            _ => World::resolve(name, spec).map(Self::Space),
        }
    }
}

impl<const D: usize> World<D>
where
    In<D>: Geometry<D>,
{
    /// Checks and resolves a world of dimension `D`.
    ///
    /// # Errors
    /// Everything that is wrong with it, another dimension included.
    pub fn new(name: impl Into<String>, spec: WorldSpec) -> Result<Self, Vec<Problem>> {
        if spec.dimension != D {
            let problem = Problem::new("dimension", format!("is not {D}, as asked for"));
            return Err(vec![problem]);
        }
        sound(&spec)?;
        Self::resolve(name.into(), spec)
    }

    fn resolve(name: String, mut spec: WorldSpec) -> Result<Self, Vec<Problem>> {
        let obstacles = obstacles(&spec.obstacles)?;
        for group in &mut spec.agents {
            group.count = check::size(group);
        }
        let solids = solids(&spec.agents)?;
        let mut placement = Placement::new(&spec.agents, &solids, &obstacles);
        let mut agents = Agents::default();
        let mut problems = Vec::new();
        for (index, group) in spec.agents.iter().enumerate() {
            let count = group.count.unwrap_or(0);
            match placement.place(index, group, count, spec.seed) {
                Ok(positions) => agents.positions.extend(positions),
                Err(found) => problems.extend(found),
            }
            agents
                .velocities
                .extend(velocities::<D>(index, group, count, spec.seed));
            problems.extend(agents.add_bodies(index, group, count, &solids[index]));
            agents.turn(group, count, &solids[index]);
        }
        if problems.is_empty() {
            problems = overlaps(&spec.agents, &solids, &agents, &obstacles);
        }
        if !problems.is_empty() {
            return Err(problems);
        }
        let gravity: Vector<D> = vector_or_zero(&spec.physics.gravity);
        fill_in::<D>(&mut spec);
        Ok(Self {
            name,
            agents,
            solids,
            obstacles,
            gravity,
            spec,
        })
    }
}

impl<const D: usize> World<D> {
    /// The velocity that the first navigation law steers to, rest included.
    pub fn navigation_velocity(&self) -> Option<Vector<D>> {
        self.spec.laws.iter().find_map(|law| match law {
            LawSpec::Navigation(navigation) => Some(vector_or_zero(&navigation.velocity)),
            _ => None,
        })
    }

    /// The first (α, α) interaction, whose range defines the proximity net.
    pub fn alpha_interaction(&self) -> Option<&AlphaInteractionSpec> {
        self.spec.laws.iter().find_map(|law| match law {
            LawSpec::AlphaInteraction(alpha) => Some(alpha),
            _ => None,
        })
    }

    /// The activation range of the first obstacle law, within which β-agents exist.
    pub fn beta_range(&self) -> Option<f64> {
        self.spec.laws.iter().find_map(|law| match law {
            LawSpec::ObstacleAvoidance(avoidance) => Some(avoidance.range),
            _ => None,
        })
    }

    /// Number of steps to the end.
    pub fn steps(&self) -> u64 {
        check::whole_steps(self.spec.time.end, self.spec.time.step).unwrap_or(0)
    }

    /// Number of steps between frames.
    pub fn frame_steps(&self) -> u64 {
        let steps = check::whole_steps(self.spec.record.every, self.spec.time.step);
        steps.unwrap_or(0).max(1)
    }
}

/// Writes out the defaults that depend on the dimension or on other fields, so that the
/// trace's header leaves nothing to be known.
fn fill_in<const D: usize>(spec: &mut WorldSpec) {
    let zeros = || vec![0.0; D];
    spec.physics.gravity.get_or_insert_with(zeros);
    for group in &mut spec.agents {
        agents::fill_in(group);
    }
    for obstacle in &mut spec.obstacles {
        obstacle.position.get_or_insert_with(zeros);
        obstacle.rotation.get_or_insert(match D {
            2 => Rotation::Angle(0.0),
            _ => Rotation::Vector(vec![0.0; 3]),
        });
    }
    let target = target_velocity(&spec.laws).cloned();
    for law in &mut spec.laws {
        if let LawSpec::ObstacleAvoidance(law) = law
            && let Some(gamma) = &mut law.gamma
            && gamma.direction.is_none()
        {
            gamma.direction.clone_from(&target);
        }
    }
}

/// The velocity of the first navigation law that has one other than rest.
fn target_velocity(laws: &[LawSpec]) -> Option<&Vec<f64>> {
    laws.iter().find_map(|law| match law {
        LawSpec::Navigation(law) if check::moves(law) => law.velocity.as_ref(),
        _ => None,
    })
}

/// What a check of a world finds, as a result.
fn sound(spec: &WorldSpec) -> Result<(), Vec<Problem>> {
    let problems = check::problems(spec);
    if problems.is_empty() {
        Ok(())
    } else {
        Err(problems)
    }
}

fn velocities<const D: usize>(
    index: usize,
    group: &GroupSpec,
    count: usize,
    seed: u64,
) -> Vec<Vector<D>> {
    match &group.velocities {
        VelocitySpec::Rest => vec![Vector::zeros(); count],
        VelocitySpec::Common(velocity) => vec![vector(velocity); count],
        VelocitySpec::Explicit(velocities) => velocities.iter().map(|v| vector(v)).collect(),
        VelocitySpec::Uniform(region) => {
            let (min, max) = (vector(&region.min), vector(&region.max));
            let mut random = Random::new(seed, Purpose::Velocities(index));
            (0..count).map(|_| random.in_box(&min, &max)).collect()
        }
    }
}

fn obstacles<const D: usize>(specs: &[ObstacleSpec]) -> Result<Vec<Obstacle<D>>, Vec<Problem>>
where
    In<D>: Geometry<D>,
{
    let mut obstacles = Vec::new();
    let mut problems = Vec::new();
    for (index, spec) in specs.iter().enumerate() {
        let name = spec
            .name
            .clone()
            .unwrap_or_else(|| format!("obstacle {index}"));
        match Obstacle::new(name, shape(&spec.shape), pose(spec)) {
            Some(obstacle) => obstacles.push(obstacle),
            None => problems.push(Problem::new(
                format!("obstacles[{index}].shape"),
                "is too thin to make a solid of: it must be about a thousandth as thick as it is \
                 wide",
            )),
        }
    }
    if problems.is_empty() {
        Ok(obstacles)
    } else {
        Err(problems)
    }
}

fn shape<const D: usize>(spec: &ShapeSpec) -> Shape<D> {
    match spec {
        ShapeSpec::Ball { radius } => Shape::Ball { radius: *radius },
        ShapeSpec::Cuboid { half_extents } => Shape::Cuboid {
            half_extents: vector(half_extents),
        },
        ShapeSpec::Capsule { from, to, radius } => Shape::Capsule {
            from: vector(from),
            to: vector(to),
            radius: *radius,
        },
        ShapeSpec::HalfSpace { normal } => Shape::HalfSpace {
            normal: crate::math::direction(&vector(normal)),
        },
        ShapeSpec::Convex { points } => Shape::Convex {
            points: points.iter().map(|point| vector(point)).collect(),
        },
    }
}

fn pose<const D: usize>(spec: &ObstacleSpec) -> Pose<D> {
    let turn = spec.rotation.as_ref().map_or([0.0; 3], Rotation::turn);
    Pose::new(vector_or_zero(&spec.position), turn)
}
