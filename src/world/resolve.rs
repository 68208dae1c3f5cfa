//! A world, ready to run: agents placed, obstacles built.

use crate::math::Vector;
use crate::shape::{Geometry, In, Obstacle, Solid};
use crate::world::agents::{self, Agents, solids};
use crate::world::check::{self, Motion};
use crate::world::crowded_start::too_many;
use crate::world::limits::MOST_PROBLEMS;
use crate::world::obstacles;
use crate::world::overlap::overlaps;
use crate::world::placement::Placement;
use crate::world::problem::Problem;
use crate::world::spec::{
    AlphaInteractionSpec, LawSpec, ScopeSpec, WorldSpec, acting_on, each_law, each_law_mut,
};
use crate::world::start_distance::too_near;
use crate::world::vector_or_zero;
use crate::world::velocity::velocities;
use crate::world::watch::{Stage, Watch};

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
#[derive(Debug, Clone)]
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
    /// The obstacles, where they are at time 0.
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
        sound(&spec, Motion::OfBodies)?;
        Self::resolve(name.into(), spec, &Watch::default())
    }

    /// As [`AnyWorld::new`], of a world whose agents are points, or that has run already.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn of_points(name: impl Into<String>, spec: WorldSpec) -> Result<Self, Vec<Problem>> {
        sound(&spec, Motion::OfPoints)?;
        Self::resolve(name.into(), spec, &Watch::default())
    }

    /// Resolves a checked world; the problems left are those that only placing the agents
    /// and building the obstacles can find.
    pub(super) fn resolve(
        name: String,
        spec: WorldSpec,
        watch: &Watch,
    ) -> Result<Self, Vec<Problem>> {
        match spec.dimension {
            2 => World::resolve(name, spec, watch).map(Self::Plane),
            _ => World::resolve(name, spec, watch).map(Self::Space),
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
        Self::moved(name, spec, Motion::OfBodies)
    }

    /// As [`World::new`], of a world whose agents are points, or that has run already: their
    /// solver chooses its own steps, so that none is too long for what the laws feed back.
    ///
    /// # Errors
    /// Everything that is wrong with it, another dimension included.
    pub fn of_points(name: impl Into<String>, spec: WorldSpec) -> Result<Self, Vec<Problem>> {
        Self::moved(name, spec, Motion::OfPoints)
    }

    fn moved(
        name: impl Into<String>,
        spec: WorldSpec,
        motion: Motion,
    ) -> Result<Self, Vec<Problem>> {
        if spec.dimension != D {
            let problem = Problem::new("dimension", format!("is not {D}, as asked for"));
            return Err(vec![problem]);
        }
        sound(&spec, motion)?;
        Self::resolve(name.into(), spec, &Watch::default())
    }

    fn resolve(name: String, mut spec: WorldSpec, watch: &Watch) -> Result<Self, Vec<Problem>> {
        watch
            .tell(Stage::Building)
            .map_err(|stopped| vec![stopped])?;
        let obstacles = obstacles::build(&spec.obstacles)?;
        for group in &mut spec.agents {
            group.count = check::size(group);
        }
        let solids = solids(&spec.agents)?;
        let mut placement = Placement::new(&spec.agents, &solids, &obstacles, watch);
        let mut agents = Agents::default();
        let mut problems = Vec::new();
        for (index, group) in spec.agents.iter().enumerate() {
            let count = group.count.unwrap_or(0);
            match placement.place(index, group, count, spec.seed) {
                Ok(positions) => {
                    let velocities = velocities(index, &group.velocities, &positions, spec.seed);
                    agents.positions.extend(positions);
                    agents.velocities.extend(velocities);
                    agents.turn(group, count, &solids[index]);
                }
                Err(found) => problems.extend(found),
            }
            if problems.len() >= MOST_PROBLEMS {
                return Err(problems);
            }
            problems.extend(agents.add_bodies(index, group, count, &solids[index]));
        }
        if problems.is_empty() {
            problems = overlaps(&spec.agents, &solids, &agents, &obstacles);
            problems.extend(too_near(&spec, &agents));
            problems.extend(too_many(&spec, &agents));
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
    /// Every law, those inside scopes too, each with its scope; see [`each_law`].
    pub fn laws(&self) -> impl Iterator<Item = (Option<&ScopeSpec>, &LawSpec)> {
        each_law(&self.spec.laws)
    }

    /// For each agent, whether laws in a scope, or in none, act on it.
    pub fn acted_on(&self, scope: Option<&ScopeSpec>) -> Vec<bool> {
        let by_group = acting_on(scope, &self.spec.agents);
        let groups = self.agents.group.iter();
        groups.map(|&group| by_group[group]).collect()
    }

    /// The velocity that the first navigation law steers to, rest included.
    pub fn navigation_velocity(&self) -> Option<Vector<D>> {
        self.laws().find_map(|(_, law)| steered_velocity(law))
    }

    /// For each group, the velocity to which the first navigation law that acts on it steers, rest
    /// included.
    pub fn navigation_velocities(&self) -> Vec<Option<Vector<D>>> {
        let mut velocities = vec![None; self.spec.agents.len()];
        for (scope, law) in self.laws() {
            let Some(velocity) = steered_velocity(law) else {
                continue;
            };
            let acting = acting_on(scope, &self.spec.agents);
            for (known, _) in velocities.iter_mut().zip(acting).filter(|(_, acts)| *acts) {
                known.get_or_insert(velocity);
            }
        }
        velocities
    }

    /// The first (α, α) interaction, whose range defines the proximity net.
    pub fn alpha_interaction(&self) -> Option<&AlphaInteractionSpec> {
        self.laws().find_map(|(_, law)| match law {
            LawSpec::AlphaInteraction(alpha) => Some(alpha),
            _ => None,
        })
    }

    /// The activation range of the first obstacle law, within which β-agents exist.
    pub fn beta_range(&self) -> Option<f64> {
        self.laws().find_map(|(_, law)| match law {
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
        obstacles::fill_in::<D>(obstacle);
    }
    let targets: Vec<Option<Vec<f64>>> = each_law(&spec.laws)
        .map(|(scope, law)| match law {
            LawSpec::ObstacleAvoidance(_) => check::velocity_to_follow(spec, scope).cloned(),
            _ => None,
        })
        .collect();
    for (law, target) in each_law_mut(&mut spec.laws).zip(targets) {
        if let LawSpec::ObstacleAvoidance(law) = law
            && let Some(gamma) = &mut law.gamma
            && gamma.direction.is_none()
        {
            gamma.direction = target;
        }
    }
}

/// The velocity that a navigation law steers to, rest included.
fn steered_velocity<const D: usize>(law: &LawSpec) -> Option<Vector<D>> {
    match law {
        LawSpec::Navigation(navigation) => Some(vector_or_zero(&navigation.velocity)),
        _ => None,
    }
}

/// What a check of a world finds, as a result.
fn sound(spec: &WorldSpec, motion: Motion) -> Result<(), Vec<Problem>> {
    let problems = check::all_problems(spec, motion);
    if problems.is_empty() {
        Ok(())
    } else {
        Err(problems)
    }
}
