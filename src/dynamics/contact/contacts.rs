//! The contacts of a flock, from step to step.

mod closest;

use serde::{Deserialize, Serialize};

use super::flight::Flight;
use super::meet::tolerance;
use super::near;
use super::pair::{Other, Pair};
use super::roster::Roster;
use super::sweep::{Change, Sweep};
use super::{Closest, Gaps, Strain, Touch, Touched};
use crate::math::{Matrix, Vector};
use crate::shape::{Geometry, In, Obstacle, Pose, Separation, Shape, Solid, is_exposed};
use crate::world::World;

/// Share of a body's size up to which a pair that the engine holds may part and still be held;
/// and the share that the one may move against the other in a step.
pub(super) const HELD: (f64, f64) = (1e-3, 1e-2);

/// Share of its size that an agent may move and turn against another in a step for the engine, which
/// goes by the plane at the start of the step, to hold them; in a crowd that it held before also
/// where they will only touch within the step.
pub(crate) const CROWDED: f64 = 0.1;

/// What contacts must know between two steps to go on bit for bit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct ContactsState {
    lasting: Vec<Pair>,
    gaps: Gaps,
    strain: Strain,
}

/// The contacts of a flock.
#[derive(Debug)]
pub(crate) struct Contacts<const D: usize> {
    /// The pairs that the engine is to hold, and those of an agent and a wall that are held
    /// without it.
    engine: Vec<Pair>,
    leaning: Vec<Pair>,
    roster: Roster<D>,
    agents: near::Agents<D>,
    walls: near::Walls<D>,
    /// Up to which way of each agent no obstacle can come closer than the closest so far.
    clear: Vec<f64>,
    state: ContactsState,
}

/// The state at the start of a step, as far as it decides which contacts last.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Start<'a, const D: usize> {
    pub(crate) step: f64,
    pub(crate) positions: &'a [Vector<D>],
    pub(crate) rotations: Option<&'a [Matrix<D>]>,
    pub(crate) spins: Option<&'a [Vector<3>]>,
    /// Velocities at the time of the positions.
    pub(crate) velocities: &'a [Vector<D>],
    pub(crate) accelerations: &'a [Vector<D>],
    pub(crate) obstacles: &'a [Obstacle<D>],
}

impl<const D: usize> Start<'_, D> {
    fn pose(&self, agent: usize) -> Pose<D> {
        let rotation = self
            .rotations
            .map_or_else(Matrix::identity, |all| all[agent]);
        Pose::from_matrix(self.positions[agent], rotation)
    }
}

impl<const D: usize> Contacts<D> {
    /// The contacts of a world, before any step.
    pub(crate) fn new(world: &World<D>) -> Self
    where
        In<D>: Geometry<D>,
    {
        let roster = Roster::new(world);
        let ball = |solid: &Solid<D>| {
            let radius = solid.radius();
            Solid::new(Shape::Ball { radius }).expect("a ball of a radius above 0")
        };
        let balls = world.solids.iter().map(ball).collect();
        Self {
            agents: near::Agents::new(&roster.outer),
            walls: near::Walls::new(balls, &world.agents.group),
            engine: Vec::new(),
            leaning: Vec::new(),
            clear: vec![f64::NEG_INFINITY; roster.len()],
            roster,
            state: ContactsState::default(),
        }
    }

    /// What [`Contacts::resume`] needs.
    pub(crate) fn capture(&self) -> ContactsState {
        self.state.clone()
    }

    /// Goes on from a state of the same world.
    pub(crate) fn resume(&mut self, state: ContactsState) {
        self.state = state;
    }

    pub(crate) fn gaps(&self) -> Gaps {
        self.state.gaps
    }

    pub(crate) fn strain(&self) -> Strain {
        self.state.strain
    }

    /// The smallest gap between agents so far.
    fn smallest(&self) -> f64 {
        self.state.gaps.agents.map_or(f64::INFINITY, |it| it.gap)
    }

    /// Looks around where bodies stand at the start.
    pub(crate) fn begin(&mut self, start: Start<'_, D>, time: f64) {
        let here = [start.positions; 2];
        self.agents.follow(here, &|_| 0.0, f64::INFINITY);
        self.walls.follow(here, &|_| 0.0, start.obstacles, &|_| 0.0);
        self.closest(here, start.obstacles, &|agent| start.pose(agent), [time; 2]);
    }

    /// Finds the pairs that are to be held together in the step to come: those that touch and
    /// are neither struck nor parting. Where agents touch each other the engine holds them, and
    /// the walls that they touch; who touches walls alone is held without it, see `sweep`.
    pub(crate) fn hold(&mut self, start: Start<'_, D>) {
        let (mut engine, mut walls, mut leaning) = (Vec::new(), Vec::new(), Vec::new());
        let crowd = agents_of(&self.state.lasting);
        let widest = self.widest(!crowd.is_empty());
        self.agents
            .below(widest, |one, other| engine.push(Pair::agents(one, other)));
        engine.retain(|&pair| self.lasts(pair, &start, Some(&crowd)));
        let crowded = agents_of(&engine);
        self.walls.below(widest, |agent, obstacle, part| {
            walls.push(Pair::wall(agent, obstacle, part));
        });
        for pair in walls {
            let crowded = crowded.binary_search(&(pair.agent as usize)).is_ok();
            if self.lasts(pair, &start, crowded.then_some(&crowd[..])) {
                match crowded {
                    true => engine.push(pair),
                    false => leaning.push(pair),
                }
            }
        }
        engine.sort_unstable();
        self.state.lasting.clear();
        self.state.lasting.extend_from_slice(&engine);
        (self.engine, self.leaning) = (engine, leaning);
    }

    /// The pairs that the engine is to hold, as [`Contacts::hold`] found them.
    pub(crate) fn held(&self) -> &[Pair] {
        &self.engine
    }

    /// The pairs that overlap where bodies stand, without impulse.
    pub(crate) fn overlaps(&self, start: Start<'_, D>, time: f64) -> Vec<Touch<D>> {
        let mut near = Vec::new();
        self.agents
            .below(0.0, |one, other| near.push(Pair::agents(one, other)));
        self.walls.below(0.0, |agent, obstacle, part| {
            near.push(Pair::wall(agent, obstacle, part));
        });
        let touch = |pair: Pair| {
            let (found, against, _) = self.stand(pair, &start);
            let (agent, touched) = pair.touched();
            (found.gap <= 0.0).then(|| Touch {
                agent,
                touched,
                time,
                gap: found.gap,
                blow: 0.0,
                press: 0.0,
                friction: 0.0,
                approach_speed: against.dot(&found.normal),
                push_speed: 0.0,
                normal: found.normal,
                point: found.points[1],
                position: start.positions[agent],
            })
        };
        near.into_iter().filter_map(touch).collect()
    }

    /// The widest gap at which a pair may still be held, where there is a crowd or not.
    fn widest(&self, crowd: bool) -> f64 {
        let share = if crowd { CROWDED } else { HELD.0 };
        share * self.roster.inner.iter().copied().fold(0.0, f64::max)
    }

    /// How a pair stands to each other, and the velocity and acceleration of the agent against
    /// the other where they are nearest.
    fn stand(&self, pair: Pair, start: &Start<'_, D>) -> (Separation<D>, Vector<D>, Vector<D>) {
        let agent = pair.agent as usize;
        let pose = start.pose(agent);
        let solid = self.roster.solid(agent);
        let (velocity, acceleration) = (start.velocities[agent], start.accelerations[agent]);
        match pair.other {
            Other::Agent(other) => {
                let other = other as usize;
                let found = solid.separation(&pose, self.roster.solid(other), &start.pose(other));
                let velocity = velocity - start.velocities[other];
                (found, velocity, acceleration - start.accelerations[other])
            }
            Other::Part(obstacle, part) => {
                let obstacle = &start.obstacles[obstacle as usize];
                let part = &obstacle.parts()[part as usize];
                let found = part.separation(&obstacle.pose, solid, &pose);
                let twist = obstacle.twist();
                let surface = twist.map_or(Vector::zeros(), |it| it.at(&found.points[1]));
                (found, velocity - surface, acceleration)
            }
        }
    }

    /// How far the surfaces of a pair's bodies turn in a step at most; balls look the same.
    fn turns(&self, pair: Pair, start: &Start<'_, D>) -> f64 {
        let turns = |agent: usize| match start.spins {
            Some(spins) if !self.roster.is_ball(agent) => {
                spins[agent].norm() * self.roster.outer[agent] * start.step
            }
            _ => 0.0,
        };
        pair.members().map(turns).sum()
    }

    /// Whether a pair touches and is neither struck nor parting. Of those that lose something in a
    /// blow, pairs that the engine held before may have parted a little, and agents that it held may be
    /// about to touch. `engine` are the latter, nothing where the engine is not to hold it.
    fn lasts(&self, pair: Pair, start: &Start<'_, D>, engine: Option<&[usize]>) -> bool {
        let size = self.roster.smaller(pair);
        let (found, against, acceleration) = self.stand(pair, start);
        let approach = against.dot(&found.normal);
        let pull = acceleration.dot(&found.normal);
        let engine = engine.filter(|_| self.roster.loses(pair));
        let known = engine.is_some() && self.state.lasting.binary_search(&pair).is_ok();
        let held = |agent: usize| engine.is_some_and(|all| all.binary_search(&agent).is_ok());
        let crowd = pair.members().all(held);
        let step = start.step;
        let moves = against.norm() * step;
        let turns = self.turns(pair, start);
        if crowd && moves <= CROWDED * size && turns <= CROWDED * size {
            return found.gap <= CROWDED * size && self.is_exposed(pair, &found, start);
        }
        if known && moves <= HELD.1 * size && turns <= CROWDED * size {
            return found.gap <= HELD.0 * size && self.is_exposed(pair, &found, start);
        }
        if found.gap > 4.0 * tolerance(size, &found.points[0]) {
            return false;
        }
        let speed = |agent: usize| start.velocities[agent].amax();
        let least = 1e-13 * (pair.members().map(speed).sum::<f64>() + against.amax());
        if matches!(pair.other, Other::Agent(_)) && turns > CROWDED * size {
            return false;
        }
        let struck = approach > 2.0 * pull.max(0.0) * start.step + least;
        let parts = approach < -least && approach + 0.5 * pull * start.step < 0.0;
        !struck && !parts && self.is_exposed(pair, &found, start)
    }

    /// Whether a touch is one of the wall that all parts form together.
    fn is_exposed(&self, pair: Pair, found: &Separation<D>, start: &Start<'_, D>) -> bool {
        let Other::Part(obstacle, part) = pair.other else {
            return true;
        };
        let place = (obstacle as usize, part as usize);
        let size = self.roster.size(pair.agent as usize);
        let (point, normal) = (&found.points[1], -found.normal);
        is_exposed(
            start.obstacles,
            &self.walls.boxes,
            place,
            point,
            &normal,
            size,
        )
    }

    /// Follows the bounces of a step that the engine has taken. Appends what touched, and
    /// returns which bodies end elsewhere.
    pub(crate) fn sweep(
        &mut self,
        flight: Flight<'_, D>,
        touches: &mut Vec<Touch<D>>,
    ) -> Vec<Change<D>> {
        let ways = [flight.from, flight.to];
        let eighth = 0.125 * flight.step * flight.step;
        let bend = |i: usize| match flight.accelerations {
            Some(accelerations) => accelerations[i].norm() * eighth,
            None => 0.0,
        };
        self.agents.follow(ways, &bend, self.smallest());
        self.walls
            .follow(ways, &bend, flight.obstacles, &|k| flight.moved(k));
        let near = (&mut self.agents, &mut self.walls);
        let swept = Sweep::new(&self.roster, flight, near, [&self.engine, &self.leaning]).run();
        self.state.strain.unordered += u64::from(swept.unordered);
        self.state.lasting.extend(swept.left);
        self.state.lasting.sort_unstable();
        self.state.lasting.dedup();
        touches.extend(swept.touches);
        swept.changes
    }

    /// Takes note of the gaps of touches, and of overlaps.
    pub(crate) fn note(&mut self, touches: &[Touch<D>]) {
        for touch in touches {
            let (gap, size) = match touch.touched {
                Touched::Agent(other) => {
                    let sizes = (self.roster.size(touch.agent), self.roster.size(other));
                    (&mut self.state.gaps.agents, sizes.0.min(sizes.1))
                }
                Touched::Obstacle(_) => (
                    &mut self.state.gaps.obstacles,
                    self.roster.size(touch.agent),
                ),
            };
            if gap.is_none_or(|it| touch.gap < it.gap) {
                *gap = Some(Closest {
                    gap: touch.gap,
                    agent: touch.agent,
                    to: touch.touched,
                    time: touch.time,
                });
            }
            let overlap = (-touch.gap / size).min(f64::MAX);
            self.state.strain.overlap = self.state.strain.overlap.max(overlap);
        }
    }

    /// Takes note of how far bodies went in a step.
    pub(crate) fn travel(&mut self, [from, to]: [&[Vector<D>]; 2]) {
        let ways = from.iter().zip(to).zip(&self.roster.inner);
        let squares = ways.map(|((from, to), inner)| (to - from).norm_squared() / (inner * inner));
        let longest = squares.fold(0.0, f64::max).sqrt().min(f64::MAX);
        self.state.strain.travel = self.state.strain.travel.max(longest);
    }
}

/// The agents of some pairs, in order.
fn agents_of(pairs: &[Pair]) -> Vec<usize> {
    let mut agents: Vec<usize> = pairs.iter().flat_map(|pair| pair.members()).collect();
    agents.sort_unstable();
    agents.dedup();
    agents
}
