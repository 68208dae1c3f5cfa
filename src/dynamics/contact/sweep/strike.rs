//! What meets at one time: the bodies, and the spots where they touch.

use std::collections::{BTreeSet, HashMap};

use super::super::blow::{Cluster, Spot, Struck};
use super::super::meet::tolerance;
use super::super::pair::{Other, Pair};
use super::super::way::embed;
use super::Sweep;
use crate::math::Vector;
use crate::shape::Separation;

/// What meets at one time, as it is found out.
pub(super) struct Strike<'s, 'a, const D: usize> {
    pub(super) sweep: &'s mut Sweep<'a, D>,
    pub(super) time: f64,
    /// The agents of the cluster, in its order.
    pub(super) agents: Vec<usize>,
    pub(super) places: HashMap<usize, usize>,
    pub(super) pairs: Vec<Pair>,
    pub(super) founds: Vec<Separation<D>>,
    pub(super) known: BTreeSet<Pair>,
}

impl<const D: usize> Strike<'_, '_, D> {
    /// The place of an agent in the cluster.
    fn body(&mut self, cluster: &mut Cluster<D>, agent: usize) -> usize {
        if let Some(place) = self.places.get(&agent) {
            return *place;
        }
        let roster = self.sweep.roster;
        let way = self.sweep.way(agent);
        let before = self.sweep.flight.velocities[agent].amax();
        cluster.fastest = cluster.fastest.max(before);
        cluster.bodies.push(Struck {
            velocity: way.velocity_at(self.time),
            spin: way.spin,
            inverse_mass: roster.inverse_mass[agent],
            inverse_inertia: roster.inverse_inertia(agent, &way.rotation_at(self.time)),
        });
        self.places.insert(agent, self.agents.len());
        self.agents.push(agent);
        self.agents.len() - 1
    }

    /// Adds the spots of a pair, where it touches.
    pub(super) fn add(&mut self, cluster: &mut Cluster<D>, pair: Pair, meets: bool) {
        if self.known.contains(&pair) {
            return;
        }
        let sweep = &*self.sweep;
        let agent = pair.agent as usize;
        let one = sweep.way(agent);
        let other = match pair.other {
            Other::Agent(other) => sweep.way(other as usize),
            Other::Part(obstacle, _) => sweep.flight.wall(obstacle as usize),
        };
        let surfaces = sweep.roster.surfaces(pair);
        let slow = if meets { 0.0 } else { sweep.slow(pair) };
        if let Other::Agent(other_agent) = pair.other
            && !meets
        {
            let outer = sweep.roster.outer[agent] + sweep.roster.outer[other_agent as usize];
            let apart = one.position_at(self.time) - other.position_at(self.time);
            if apart.norm() > 1.01 * outer {
                return;
            }
        }
        let found = sweep.stand(pair, [&one, &other], self.time);
        let held = || sweep.is_held(pair);
        let touching =
            found.gap <= 4.0 * tolerance(sweep.roster.smaller(pair), &found.points[0]) || held();
        if !meets && !touching {
            return;
        }
        if !meets && !sweep.is_exposed(pair, &found, self.time) {
            return;
        }
        self.known.insert(pair);
        let place = self.pairs.len();
        self.pairs.push(pair);
        self.founds.push(found);
        let here = self.body(cluster, agent);
        let there = match pair.other {
            Other::Agent(other) => Some(self.body(cluster, other as usize)),
            Other::Part(..) => None,
        };
        let (flight, time) = (self.sweep.flight, self.time);
        let surface = |obstacle, spot: &Vector<D>| flight.surface(obstacle, spot, time);
        let (center, away) = (one.position_at(self.time), other.position_at(self.time));
        // Half-way between the surfaces, which are apart by rounding, or overlap as what is
        // held may.
        let between = (found.points[1] - found.points[0]) * 0.5;
        self.sweep
            .spots(pair, [&one, &other], time, &found, &mut |spot| {
                let spot = spot + between;
                cluster.spots.push(Spot {
                    one: here,
                    other: there,
                    arms: [embed(&(spot - center)), embed(&(spot - away))],
                    normal: found.normal,
                    surface: match pair.other {
                        Other::Agent(_) => Vector::zeros(),
                        Other::Part(obstacle, _) => surface(obstacle as usize, &spot),
                    },
                    restitution: surfaces.0,
                    friction: surfaces.1,
                    slow,
                    pair: place,
                    normal_impulse: 0.0,
                    friction_impulse: 0.0,
                    approach: f64::NEG_INFINITY,
                });
            });
    }

    /// Adds all that a body touches.
    pub(super) fn ask(&mut self, cluster: &mut Cluster<D>, body: usize) {
        let agent = self.agents[body];
        for pair in self.sweep.candidates(agent) {
            self.add(cluster, pair, false);
        }
    }

    /// Lets lean on each other what would come back within the step, or all: gives the bodies the
    /// speed that the rest of the step's acceleration brings, and stops what approaches.
    pub(super) fn rest(&mut self, cluster: &mut Cluster<D>, all: bool) -> BTreeSet<usize> {
        let left = self.sweep.flight.step - self.time;
        let accelerations: Vec<Vector<D>> = self
            .agents
            .iter()
            .map(|&agent| self.sweep.way(agent).acceleration)
            .collect();
        let mut rests = BTreeSet::new();
        for (k, spot) in cluster.spots.iter().enumerate() {
            let other = spot.other.map_or(Vector::zeros(), |it| accelerations[it]);
            let pull = (accelerations[spot.one] - other).dot(&spot.normal);
            if all || pull > 0.0 && 2.0 * cluster.separation(k) <= pull * left {
                rests.insert(spot.one);
                rests.extend(spot.other);
            }
        }
        for &body in &rests {
            cluster.bodies[body].velocity += accelerations[body] * left;
        }
        if !rests.is_empty() {
            cluster.stop();
        }
        rests.into_iter().map(|body| self.agents[body]).collect()
    }
}
