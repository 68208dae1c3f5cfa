//! Where contact is at its limits: what to say of it, before a run and after it.

use std::f64::consts::PI;
use std::fmt::Write;

use volary::shape::{Shape, Solid};
use volary::trace::record::Summary;
use volary::world::World;
use volary::world::spec::LawSpec;

use super::summary::plural;

/// Radii that a body may go in a step, its width: beyond, it passes places where no law ever sees
/// it, and bounces crowd into one step.
const TRAVEL: f64 = 2.0;

/// Share of the smaller radius by which bodies may overlap.
const OVERLAP: f64 = 0.01;

/// What strained the contacts of a run, and the step that would do; nothing where nothing did.
pub(super) fn after(summary: &Summary, step: f64) -> String {
    let touched = summary.agent_contacts.episodes + summary.obstacle_contacts.episodes;
    let strain = &summary.strain;
    let mut text = String::new();
    let mut parts: f64 = 1.0;
    if touched > 0 && strain.travel > TRAVEL {
        parts = parts.max(strain.travel / TRAVEL);
        let _ = writeln!(
            text,
            "    a body went {:.3} of its radii in a step; {TRAVEL} is the most to rely on",
            strain.travel
        );
    }
    if strain.overlap > OVERLAP {
        parts = parts.max(strain.overlap / OVERLAP);
        let _ = writeln!(
            text,
            "    bodies overlapped by {:.3} % of the smaller radius; {} % is the most to rely on",
            100.0 * strain.overlap,
            100.0 * OVERLAP
        );
    }
    if strain.unordered > 0 {
        parts = parts.max(2.0);
        let _ = writeln!(
            text,
            "    in {} more bounces followed each other than can be put in order",
            plural(strain.unordered, "step")
        );
    }
    match text.is_empty() {
        true => text,
        false => format!(
            "\n  note: contacts were strained\n{text}    --step {} would do\n",
            step / round(parts)
        ),
    }
}

/// What will strain the contacts of a world, as far as speeds tell: those at the start, those
/// that navigation steers to, and top speeds.
pub(super) fn before<const D: usize>(world: &World<D>) -> Option<String> {
    let agents = &world.agents;
    let start = agents.velocities.iter().map(|velocity| velocity.norm());
    let steered = world.laws().filter_map(|(scope, law)| match law {
        LawSpec::Navigation(navigation) => {
            let velocity = navigation.velocity.as_ref()?;
            let speed = velocity.iter().map(|it| it * it).sum::<f64>().sqrt();
            // Who is steered goes no faster than the fastest of them may.
            let acted = world.acted_on(scope).into_iter().zip(&agents.top_speed);
            let tops = acted.filter_map(|(acted, top)| acted.then_some(*top));
            tops.reduce(f64::max).map(|top| speed.min(top))
        }
        _ => None,
    });
    let tops = agents.top_speed.iter().copied();
    let speeds = [
        ("at the start", start.reduce(f64::max)),
        ("under navigation", steered.reduce(f64::max)),
        (
            "at top speed",
            tops.filter(|top| top.is_finite()).reduce(f64::max),
        ),
    ];
    let known = speeds
        .into_iter()
        .filter_map(|(when, it)| Some((when, it?)));
    let (when, speed) = known.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    let radii = world.solids.iter().map(thickness);
    let radius = radii.reduce(f64::min)?;
    let step = world.spec.time.step;
    let travel = speed * step / radius;
    (travel > TRAVEL).then(|| {
        format!(
            "  note: a body {when} goes {travel:.3} of the smallest radius, {radius}, in a step; \
             --step {} keeps it within {TRAVEL}\n",
            step / round(travel / TRAVEL)
        )
    })
}

/// In how many parts to cut a step that must be so many times as short: round numbers, so that
/// times which lie on a step still do.
fn round(times: f64) -> f64 {
    let mut size: f64 = 1.0;
    loop {
        for parts in [1.0, 2.0, 4.0, 5.0, 8.0].map(|it| it * size) {
            // Infinite ones end it too.
            if times <= parts || !parts.is_finite() {
                return parts;
            }
        }
        size *= 10.0;
    }
}

/// Radius of the ball within a body; of a hull, of a ball as large as it.
fn thickness<const D: usize>(solid: &Solid<D>) -> f64 {
    match solid.shape() {
        Shape::Ball { radius } | Shape::Capsule { radius, .. } => *radius,
        Shape::Cuboid { half_extents } => half_extents.min(),
        _ => match D {
            2 => (solid.volume() / PI).sqrt(),
            _ => (0.75 * solid.volume() / PI).cbrt(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use volary::trace::record::{ContactCount, Metrics, Outcome, StrainRecord};

    fn summary(episodes: u64, strain: StrainRecord) -> Summary {
        Summary {
            name: "w".to_owned(),
            seed: 1,
            outcome: Outcome::Completed,
            error: None,
            agents: 2,
            steps: 100,
            time: 1.0,
            agent_contacts: ContactCount {
                episodes,
                ..ContactCount::default()
            },
            obstacle_contacts: ContactCount::default(),
            force_cuts: 0,
            rate_cuts: 0,
            speed_cuts: 0,
            smallest_agent_gap: None,
            closest_agents: None,
            smallest_obstacle_gap: None,
            closest_obstacle: None,
            strain,
            last: Metrics::default(),
        }
    }

    #[test]
    fn what_is_within_bounds_is_not_told() {
        let strain = StrainRecord {
            travel: 2.0,
            overlap: 0.01,
            unordered: 0,
        };
        assert_eq!(after(&summary(3, strain), 0.01), "");
        // Nothing touched: no contact was strained, however far bodies went.
        let far = StrainRecord {
            travel: 9.0,
            ..strain
        };
        assert_eq!(after(&summary(0, far), 0.01), "");
        assert!(after(&summary(1, far), 0.01).contains("9.000 of its radii"));
    }

    #[test]
    fn the_step_that_would_do_divides_this_one() {
        let strain = StrainRecord {
            travel: 2.5,
            overlap: 0.0375,
            unordered: 1,
        };
        let text = after(&summary(1, strain), 0.01);
        for part in [
            "2.500 of its radii",
            "3.750 % of the smaller radius",
            "in 1 step more bounces",
            "--step 0.0025 would do",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
        let only = StrainRecord {
            unordered: 2,
            ..StrainRecord::default()
        };
        let text = after(&summary(0, only), 0.01);
        assert!(
            text.contains("in 2 steps") && text.contains("--step 0.005"),
            "{text}"
        );
    }
}
