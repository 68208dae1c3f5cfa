//! Bodies against points: what theory says of contacts, and what was seen.

use crate::claim::{Claim, Run};
use crate::math::Vector;
use crate::trace::record::{Contact, Partner};
use crate::validate::report::{
    ContactOutcome, ContactReport, Departure, ExclusionReport, FirstContact,
};

/// What a run as bodies says of contacts, next to one as points where there is one;
/// `points_apart` is how near the points come that belong to the first two bodies to touch,
/// about then.
pub fn contact_report<const D: usize>(
    claims: &[Box<dyn Claim<D>>],
    bodies: &Run<'_, D>,
    points: Option<&Run<'_, D>>,
    points_apart: Option<f64>,
) -> ContactReport {
    let radius = 0.5 * largest_sum(&bodies.world.agents.radius);
    // What comes after a contact with an obstacle, no theorem on agents alone speaks of.
    let first = bodies.contacts.first().map(|it| it.with);
    let exclusions = claims.iter().filter_map(|claim| {
        let exclusion = claim.exclusion(bodies)?;
        if exclusion.distance <= 0.0 {
            return None;
        }
        let excluded = 2.0 * radius < exclusion.distance;
        Some(ExclusionReport {
            claim: claim.about().name.to_owned(),
            formula: exclusion.formula.to_owned(),
            distance: exclusion.distance,
            radius: 0.5 * exclusion.distance,
            outcome: match (excluded, first) {
                (_, Some(Partner::Obstacle)) => ContactOutcome::ObstacleMetFirst,
                (true, None) => ContactOutcome::ExcludedAndNoneSeen,
                (true, Some(Partner::Agent)) => ContactOutcome::ExcludedYetSeen,
                (false, Some(Partner::Agent)) => ContactOutcome::AllowedAndSeen,
                (false, None) => ContactOutcome::AllowedAndNoneSeen,
            },
        })
    });
    let half_least = |run: &Run<'_, D>| {
        let both = [run.closest, run.closest_after_contact];
        let distances = both.into_iter().flatten().map(|it| 0.5 * it.distance);
        distances.min_by(f64::total_cmp)
    };
    let touched = bodies.contacts.iter().any(|it| it.with == Partner::Agent);
    ContactReport {
        radius,
        exclusions: exclusions.collect(),
        points_radius: points.and_then(half_least),
        bodies_radius: half_least(bodies).filter(|_| !touched),
        first: (bodies.contacts.first()).map(|it| first_contact(it, bodies, points_apart)),
        departure: points.map(|points| departure(bodies, points)),
    }
}

/// The two largest radii together; 0 for one agent.
fn largest_sum(radii: &[f64]) -> f64 {
    let mut largest = [0.0, 0.0];
    for &radius in radii {
        if radius > largest[0] {
            largest = [radius, largest[0]];
        } else if radius > largest[1] {
            largest[1] = radius;
        }
    }
    match radii.len() {
        0 | 1 => 0.0,
        _ => largest[0] + largest[1],
    }
}

fn first_contact<const D: usize>(
    contact: &Contact,
    bodies: &Run<'_, D>,
    points_apart: Option<f64>,
) -> FirstContact {
    let (i, j) = (contact.agent, contact.other);
    let speed = contact.approach_speed;
    let between_agents = contact.with == Partner::Agent;
    let radii = &bodies.world.agents.radius;
    let time = contact.begin;
    let cause = if between_agents {
        let together = radii[i] + radii[j];
        let met = format!("agents {i} and {j} close in at {speed:.4} at time {time:.4}");
        match points_apart {
            Some(apart) if apart <= together => format!(
                "{met}: as points they are {apart:.4} apart then, nearer than their radii \
                 together, {together:.4}: it is their size"
            ),
            Some(apart) => format!(
                "{met}; as points they are still {apart:.4} apart then, and their radii together \
                 are {together:.4}: it is how far the bodies had departed from the points"
            ),
            None => format!("{met}; their radii together are {together:.4}"),
        }
    } else {
        format!(
            "agent {i} of radius {:.4} meets obstacle {j} at {speed:.4}",
            radii[i]
        )
    };
    FirstContact {
        time,
        agent: i,
        other_agent: between_agents.then_some(j),
        obstacle: (!between_agents).then_some(j),
        approach_speed: speed,
        blow: contact.blow,
        points_apart,
        cause,
    }
}

/// How far the bodies are from the points whenever both were looked at.
fn departure<const D: usize>(bodies: &Run<'_, D>, points: &Run<'_, D>) -> Departure {
    let farthest = |a: &[Vector<D>], b: &[Vector<D>]| {
        let pairs = a.iter().zip(b).map(|(a, b)| (a - b).norm());
        pairs.fold(0.0, f64::max)
    };
    let mut departure = Departure {
        before_contact: 0.0,
        velocities_before_contact: 0.0,
        at_end: 0.0,
        times: Vec::new(),
        distances: Vec::new(),
    };
    let before = bodies.observations.len();
    let seen = bodies.observations.iter().chain(&bodies.after_contact);
    for (k, (body, point)) in seen.zip(&points.observations).enumerate() {
        let distance = farthest(&body.positions, &point.positions);
        if k < before {
            departure.before_contact = departure.before_contact.max(distance);
            let apart = farthest(&body.velocities, &point.velocities);
            let known = &mut departure.velocities_before_contact;
            *known = known.max(apart);
        }
        departure.at_end = distance;
        departure.times.push(body.time);
        departure.distances.push(distance);
    }
    departure
}
