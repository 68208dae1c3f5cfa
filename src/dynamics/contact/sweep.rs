//! Bounces within a step, in the order in which they happen.
//!
//! All bodies are on the ways that the engine gave them. The pair that meets first is found, it
//! and what it pushes bounce, they go on from there on other ways, and so on to the end of the
//! step. A body that would come back within the step, pressed by what accelerates it, leans on
//! what it touches instead: the rest of the step's acceleration is taken at once, and what
//! approaches is stopped, with friction. So do bodies that lean on walls alone, from the start of
//! the step on. Where agents lean on each other, the engine holds them from the next step on.

mod pairs;
mod strike;

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap, HashMap};

use super::blow::{Cluster, Impulse, Struck};
use super::contacts::HELD;
use super::flight::Flight;
use super::near;
use super::pair::{Other, Pair};
use super::roster::Roster;
use super::way::Way;
use super::{Touch, Touched};
use crate::math::{Matrix, Vector};
use crate::shape::Separation;
use strike::Strike;

/// Blows of two bodies in a step after which they are no longer followed.
const MEETINGS: u32 = 200;

/// A body that ends the step elsewhere than the engine put it.
#[derive(Debug, Clone)]
pub struct Change<const D: usize> {
    pub agent: usize,
    pub position: Vector<D>,
    /// Velocity for the engine to go on with.
    pub velocity: Vector<D>,
    pub rotation: Matrix<D>,
    pub spin: Vector<3>,
}

/// A pair that will meet, unless something else comes first.
struct Event {
    time: f64,
    pair: Pair,
    /// How often the ways of the pair's agents had changed when this was foreseen.
    stamp: u32,
}

impl PartialEq for Event {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Event {}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Event {
    /// The greatest is the soonest.
    fn cmp(&self, other: &Self) -> Ordering {
        let soonest = other.time.total_cmp(&self.time);
        soonest.then(other.pair.cmp(&self.pair))
    }
}

/// A step, swept for meetings.
pub(super) struct Sweep<'a, const D: usize> {
    roster: &'a Roster<D>,
    flight: Flight<'a, D>,
    agents: &'a mut near::Agents<D>,
    walls: &'a mut near::Walls<D>,
    /// The pairs that the engine held together in this step, and those that lean on walls alone,
    /// in their order.
    engine: &'a [Pair],
    leaning: &'a [Pair],
    /// The new ways of agents that bounced.
    changed: BTreeMap<usize, Way<D>>,
    stamps: HashMap<usize, u32>,
    /// The agents that bounced farther than their lists of others, and of parts, serve.
    strayed: BTreeSet<usize>,
    unwalled: BTreeSet<usize>,
    queue: BinaryHeap<Event>,
    touches: BTreeMap<(usize, Touched), Touch<D>>,
    /// The pairs that were struck, or meet slowly, for the engine to hold if they stay together.
    left: BTreeSet<Pair>,
    unordered: bool,
}

/// What came of a step's meetings.
pub(super) struct Swept<const D: usize> {
    pub(super) changes: Vec<Change<D>>,
    pub(super) touches: Vec<Touch<D>>,
    /// The pairs that are left for the engine to hold if they stay together.
    pub(super) left: BTreeSet<Pair>,
    pub(super) unordered: bool,
}

impl<'a, const D: usize> Sweep<'a, D> {
    pub(super) fn new(
        roster: &'a Roster<D>,
        flight: Flight<'a, D>,
        (agents, walls): (&'a mut near::Agents<D>, &'a mut near::Walls<D>),
        [engine, leaning]: [&'a [Pair]; 2],
    ) -> Self {
        Self {
            roster,
            flight,
            agents,
            walls,
            engine,
            leaning,
            changed: BTreeMap::new(),
            stamps: HashMap::new(),
            strayed: BTreeSet::new(),
            unwalled: BTreeSet::new(),
            queue: BinaryHeap::new(),
            touches: BTreeMap::new(),
            left: BTreeSet::new(),
            unordered: false,
        }
    }

    /// Follows all bounces of the step.
    pub(super) fn run(mut self) -> Swept<D> {
        let leaning = self.leaning;
        for pairs in leaning.chunk_by(|one, other| one.agent == other.agent) {
            self.strike(pairs, 0.0, true);
        }
        let mut pairs = Vec::new();
        self.agents
            .below(0.0, |one, other| pairs.push(Pair::agents(one, other)));
        self.walls.below(0.0, |agent, obstacle, part| {
            pairs.push(Pair::wall(agent, obstacle, part));
        });
        for pair in pairs {
            if !self.is_held(pair) && !pair.members().any(|agent| self.leans(agent)) {
                self.foresee(pair, 0.0, false);
            }
        }
        while let Some(event) = self.queue.pop() {
            if event.stamp != self.stamp(event.pair) {
                continue;
            }
            if event.stamp > MEETINGS {
                self.unordered = true;
                continue;
            }
            self.strike(&[event.pair], event.time, false);
            if event.stamp == self.stamp(event.pair) {
                // It approached by rounding only, and was not turned back.
                self.foresee(event.pair, event.time, true);
            }
        }
        let changes = self
            .changed
            .iter()
            .map(|(&agent, way)| self.change(agent, way));
        Swept {
            changes: changes.collect(),
            unordered: self.unordered,
            left: self.left,
            touches: self.touches.into_values().collect(),
        }
    }

    fn change(&self, agent: usize, way: &Way<D>) -> Change<D> {
        let (flight, step) = (&self.flight, self.flight.step);
        let planned = flight.way(agent, self.roster.is_ball(agent));
        Change {
            agent,
            position: way.position_at(step),
            velocity: flight.velocities[agent]
                + (way.velocity_at(step) - planned.velocity_at(step)),
            rotation: way.rotation_at(step),
            spin: way.spin,
        }
    }

    /// Whether the engine held a pair together, or it leans without it.
    fn is_held(&self, pair: Pair) -> bool {
        self.engine.binary_search(&pair).is_ok() || self.leaning.binary_search(&pair).is_ok()
    }

    /// Whether an agent leans on walls alone: then whom it meets was looked for already.
    fn leans(&self, agent: usize) -> bool {
        self.leaning
            .binary_search_by_key(&agent, |pair| pair.agent as usize)
            .is_ok()
    }

    /// How often the ways of a pair's agents changed so far.
    fn stamp(&self, pair: Pair) -> u32 {
        let of = |agent| self.stamps.get(&agent).copied().unwrap_or(0);
        pair.members().map(of).sum()
    }

    fn way(&self, agent: usize) -> Way<D> {
        match self.changed.get(&agent) {
            Some(way) => way.clone(),
            None => self.flight.way(agent, self.roster.is_ball(agent)),
        }
    }

    /// Finds out when a pair meets, from a time on; after this time, where what it does then was
    /// `answered`.
    fn foresee(&mut self, pair: Pair, from: f64, answered: bool) {
        let Some((time, approach)) = self.meet(pair, from, answered) else {
            return;
        };
        if approach <= self.slow(pair) {
            self.left.insert(pair);
            return;
        }
        let stamp = self.stamp(pair);
        self.queue.push(Event { time, pair, stamp });
    }

    /// The speed of approach up to which a meeting is left to the engine, which holds it from the
    /// next step on: 0 but in crowds that the engine presses together. Walls pass nothing on, so
    /// that nothing need be left there, and bodies do not sink into them.
    fn slow(&self, pair: Pair) -> f64 {
        let pressed = pair.members().all(|agent| self.flight.pressed[agent]);
        let agents = matches!(pair.other, Other::Agent(_));
        match agents && pressed && self.roster.loses(pair) {
            true => HELD.1 * self.roster.smaller(pair) / self.flight.step,
            false => 0.0,
        }
    }

    /// Lets pairs that meet bounce, and what they push; or lets those that lean be stopped.
    fn strike(&mut self, meeting: &[Pair], time: f64, lean: bool) {
        let mut struck = Strike {
            sweep: self,
            time,
            agents: Vec::new(),
            places: HashMap::new(),
            pairs: Vec::new(),
            founds: Vec::new(),
            known: BTreeSet::new(),
        };
        let mut cluster = Cluster::default();
        for &pair in meeting {
            struck.add(&mut cluster, pair, true);
        }
        if !lean {
            cluster.bounce(|cluster, body| struck.ask(cluster, body));
        }
        let blows = cluster.impulses(struck.pairs.len());
        let rests = struck.rest(&mut cluster, lean);
        let (agents, pairs, founds) = (struck.agents, struck.pairs, struck.founds);
        let answered = struck.known;
        self.unordered |= cluster.unordered;
        let sums = cluster.impulses(pairs.len());
        for (k, pair) in pairs.iter().enumerate() {
            self.enter(time, (*pair, &founds[k]), &sums[k], blows[k].normal);
        }
        for (body, &agent) in cluster.bodies.iter().zip(&agents) {
            let rests = rests.contains(&agent);
            let out = match lean {
                true => way_out(&founds),
                false => Vector::zeros(),
            };
            self.go_on((agent, time), body, (rests, out), &answered);
        }
    }

    /// Sends a body on its new way, from a little beside where it is, and looks whom it meets
    /// there. What pairs do at this very time was `answered`: to do it again, down to the last digit,
    /// could take for ever.
    fn go_on(
        &mut self,
        (agent, time): (usize, f64),
        body: &Struck<D>,
        (rests, aside): (bool, Vector<D>),
        answered: &BTreeSet<Pair>,
    ) {
        let old = self.way(agent);
        if !rests && old.velocity_at(time) == body.velocity && old.spin == body.spin {
            return;
        }
        let mut way = old.from(time);
        way.turning += body.spin - way.spin;
        way.spin = body.spin;
        way.velocity = body.velocity;
        way.position += aside;
        if rests {
            way.acceleration = Vector::zeros();
        }
        let left = self.flight.step - time;
        let aside = aside.norm()
            + (way.velocity - old.velocity_at(time)).norm() * left
            + 0.5 * (way.acceleration - old.acceleration).norm() * left * left;
        if !self.agents.stray(agent, aside) {
            self.strayed.insert(agent);
        }
        if !self.walls.stray(agent, aside) {
            self.unwalled.insert(agent);
        }
        self.changed.insert(agent, way);
        *self.stamps.entry(agent).or_default() += 1;
        for pair in self.candidates(agent) {
            self.foresee(pair, time, answered.contains(&pair));
        }
    }

    /// The pairs of an agent that may meet in what is left of the step; those of all agents or of
    /// all parts where its lists no longer serve.
    fn candidates(&mut self, agent: usize) -> Vec<Pair> {
        let mut pairs = Vec::new();
        let mut others = Vec::new();
        if self.strayed.contains(&agent) {
            others.extend(0..self.roster.len());
        } else {
            self.agents.of(agent, &mut others);
            // Who strayed may be on no other's list.
            let strayed = self.strayed.iter().copied();
            let more: Vec<usize> = strayed.filter(|it| !others.contains(it)).collect();
            others.extend(more);
            // In an order that does not tell who strayed.
            others.sort_unstable();
        }
        let others = others.into_iter().filter(|&other| other != agent);
        pairs.extend(others.map(|other| Pair::agents(agent, other)));
        if self.unwalled.contains(&agent) {
            for (k, obstacle) in self.flight.obstacles.iter().enumerate() {
                pairs.extend((0..obstacle.parts().len()).map(|part| Pair::wall(agent, k, part)));
            }
        } else {
            self.walls.of(agent, f64::INFINITY, |obstacle, part| {
                pairs.push(Pair::wall(agent, obstacle, part));
            });
        }
        pairs
    }

    /// Enters what a pair's impulses were in all, and of these the blow.
    fn enter(
        &mut self,
        time: f64,
        (pair, found): (Pair, &Separation<D>),
        all: &Impulse,
        blow: f64,
    ) {
        if all.normal <= 0.0 {
            return;
        }
        self.left.insert(pair);
        let (agent, touched) = pair.touched();
        let push_speed = match touched {
            Touched::Agent(_) => 0.0,
            Touched::Obstacle(obstacle) => {
                let surface = self.flight.surface(obstacle, &found.points[1], time);
                (-surface.dot(&found.normal)).max(0.0)
            }
        };
        let position = self.way(agent).position_at(time);
        let begin = self.flight.begin + time;
        let touch = self.touches.entry((agent, touched));
        let touch = touch.or_insert_with(|| Touch {
            agent,
            touched,
            time: begin,
            gap: found.gap,
            blow: 0.0,
            press: 0.0,
            friction: 0.0,
            approach_speed: all.approach,
            push_speed: 0.0,
            normal: found.normal,
            point: found.points[1],
            position,
        });
        touch.blow += blow;
        touch.press += all.normal - blow;
        touch.friction += all.friction;
        touch.gap = touch.gap.min(found.gap);
        touch.push_speed = touch.push_speed.max(push_speed);
    }
}

/// Half of the way out of the walls that a body overlaps: rounding, and turning within steps, let
/// those that lean sink in.
fn way_out<const D: usize>(founds: &[Separation<D>]) -> Vector<D> {
    founds
        .iter()
        .fold(Vector::zeros(), |out: Vector<D>, found| {
            let deep = -found.gap + out.dot(&found.normal);
            out - found.normal * (0.5 * deep.max(0.0))
        })
}
