//! What the laws' own quantities are in a state.

use crate::law::{Flock, Pulls, State, Targets};
use crate::math::{Potential, Vector, mean};
use crate::metric::{
    Influences, ball_residual, center_of_mass, computable, diameter, kinetic_energy,
    largest_kinetic_energy, line_residual, relative_kinetic_energy, target_errors,
};
use crate::net::symmetric_connectivity;
use crate::trace::record::{InfluenceRecord, LawRecord, LawsRecord};
use crate::world::spec::{LawSpec, PairPotentialSpec, ScopeSpec, Share, acting_on, seen_by};
use crate::world::{World, vector};

/// What each law of a flock asks for in a state.
pub struct Terms<const D: usize> {
    /// The name of each law, and the accelerations that it alone gives.
    pub by_law: Vec<(String, Vec<Vector<D>>)>,
    /// The pulls of each law; empty for those that have none.
    pub pulls: Vec<Pulls<D>>,
}

impl<const D: usize> Terms<D> {
    /// What the laws of `flock` ask for.
    pub fn new(flock: &mut Flock<D>, state: &State<'_, D>) -> Self {
        Self {
            by_law: flock.by_law(state),
            pulls: (0..flock.laws().len())
                .map(|law| flock.pulls_of_law(law, state))
                .collect(),
        }
    }
}

/// What the laws of a world, which ask for these `terms`, are about in a state.
///
/// Quadratic in the number of agents; cubic where a law aligns velocities.
pub fn laws_record<const D: usize>(
    world: &World<D>,
    terms: &Terms<D>,
    state: &State<'_, D>,
) -> LawsRecord {
    let mut steering = vec![Vector::zeros(); state.positions.len()];
    let mut potential = 0.0;
    let mut laws = Vec::new();
    for (index, (scope, law)) in world.laws().enumerate() {
        let (name, accelerations) = &terms.by_law[index];
        if is_steering(law) {
            for (sum, acceleration) in steering.iter_mut().zip(accelerations) {
                *sum += acceleration;
            }
        }
        let mut record = LawRecord {
            law: name.clone(),
            ..about(world, state, law, scope)
        };
        if let LawSpec::PairPotential(law) = law {
            let value = total_potential(world, state.positions, law, scope);
            record.potential = computable(value);
            potential += value;
        }
        let pulls = &terms.pulls[index];
        if !pulls.is_empty() {
            let theta = world.spec.record.active_at;
            record.influence = Some(influence(&Influences::new(pulls), theta));
        }
        laws.push(record);
    }
    let kinetic = kinetic_energy(state.masses, state.velocities);
    LawsRecord {
        mean_position: list(&mean(state.positions)),
        mean_velocity: list(&mean(state.velocities)),
        mass_center: list(&center_of_mass(state.masses, state.positions)),
        mass_velocity: list(&center_of_mass(state.masses, state.velocities)),
        largest_kinetic_energy: largest_kinetic_energy(state.velocities),
        potential: computable(potential),
        energy: computable(relative_kinetic_energy(state.velocities) + potential),
        total_energy: computable(kinetic + potential),
        steering_diameter: diameter(&steering),
        laws,
    }
}

/// Whether a law's accelerations count as steering: those by which an agent follows a course
/// of its own, whatever the others do.
fn is_steering(law: &LawSpec) -> bool {
    matches!(
        law,
        LawSpec::Navigation(_) | LawSpec::Tracking(_) | LawSpec::Steering(_) | LawSpec::Flatness(_)
    )
}

/// How far the agents that a law acts on are from what it drives them to.
fn about<const D: usize>(
    world: &World<D>,
    state: &State<'_, D>,
    law: &LawSpec,
    scope: Option<&ScopeSpec>,
) -> LawRecord {
    let acted_on = world.acted_on(scope);
    let positions = picked(state.positions, &acted_on);
    let mut record = LawRecord::default();
    let targets = match law {
        LawSpec::LinePattern(law) => {
            record.residual = Some(line_residual(&positions, &vector(&law.direction)));
            None
        }
        LawSpec::BallPattern(law) => {
            record.residual = Some(ball_residual(&positions, law.radius));
            None
        }
        LawSpec::Tracking(law) => Some(Targets::of_tracking(law, scope, world)),
        LawSpec::Flatness(law) => Some(Targets::of_agents(&law.trajectories, scope, world)),
        _ => None,
    };
    if let Some(targets) = targets {
        let moments = match &targets.at(state.time)[..] {
            [shared] => vec![*shared; positions.len()],
            each => picked(each, &acted_on),
        };
        let velocities = picked(state.velocities, &acted_on);
        let [position, velocity] = target_errors(&positions, &velocities, &moments);
        record.position_error = Some(position);
        record.velocity_error = Some(velocity);
    }
    record
}

/// The potential of all pairs: half of what every agent that the law acts on has with those
/// that it sees.
fn total_potential<const D: usize>(
    world: &World<D>,
    positions: &[Vector<D>],
    law: &PairPotentialSpec,
    scope: Option<&ScopeSpec>,
) -> f64 {
    let groups = &world.spec.agents;
    let (acts, sees) = (acting_on(scope, groups), seen_by(scope, groups));
    let potential: Potential = law.potential;
    let range = law.range.unwrap_or(f64::INFINITY);
    let seen: Vec<usize> = (0..positions.len())
        .filter(|&agent| sees[world.agents.group[agent]])
        .collect();
    let share = match law.share {
        Share::Sum => 1.0,
        Share::Mean => 1.0 / seen.len().max(1) as f64,
    };
    let mut sum = 0.0;
    for (i, at) in positions.iter().enumerate() {
        if !acts[world.agents.group[i]] {
            continue;
        }
        for &j in seen.iter().filter(|&&j| j != i) {
            let distance = (positions[j] - at).norm();
            if distance <= range {
                sum += potential.value(distance);
            }
        }
    }
    0.5 * share * sum
}

fn influence(influences: &Influences, theta: Option<f64>) -> InfluenceRecord {
    let between = influences.adjacency();
    InfluenceRecord {
        least: influences.least(),
        active: theta.map(|theta| influences.active(theta)),
        imbalance: between.imbalance(),
        connectivity: symmetric_connectivity(&between),
    }
}

fn picked<T: Clone>(all: &[T], chosen: &[bool]) -> Vec<T> {
    let chosen = all.iter().zip(chosen).filter(|(_, chosen)| **chosen);
    chosen.map(|(one, _)| one.clone()).collect()
}

fn list<const D: usize>(vector: &Vector<D>) -> Vec<f64> {
    vector.as_slice().to_vec()
}
