//! The summary that a run prints.

use std::fmt::Write;
use std::time::Duration;

use volary::dynamics::Solver;
use volary::trace::record::{Approach, ContactCount, Summary};

/// The summary of a run as a table for people; of points with what moved them.
pub(super) fn table(summary: &Summary, solver: Option<Solver>, took: Duration) -> String {
    let last = &summary.last;
    let seconds = took.as_secs_f64();
    let mut text = format!(
        "{}, seed {}: {} to time {} in {} ({seconds:.2} s)\n\n",
        summary.name,
        summary.seed,
        plural(summary.agents as u64, "agent"),
        time(summary.time),
        plural(summary.steps, "step")
    );
    // What the world does not define is left out.
    let mut row = |name: &str, value: Option<String>, meaning: &str| {
        if let Some(value) = value {
            let _ = writeln!(text, "  {name:<20}{value:>12}   {meaning}");
        }
    };
    let count = |value: Option<usize>| value.map(|n| n.to_string());
    row(
        "density",
        last.density.map(number),
        "share of agents in the largest component",
    );
    row("components", count(last.components), "of the proximity net");
    row("edges", count(last.edges), "of the proximity net");
    row(
        "polarization",
        Some(number(last.polarization)),
        "1: all headings agree",
    );
    row(
        "velocity mismatch",
        Some(number(last.velocity_mismatch)),
        "rms, to the velocity steered to",
    );
    row(
        "velocity diameter",
        Some(number(last.velocity_diameter)),
        "largest difference of two",
    );
    row(
        "position diameter",
        Some(number(last.position_diameter)),
        "largest distance of two",
    );
    row(
        "structural energy",
        last.structural_energy.map(number),
        "H_s",
    );
    row(
        "smallest agent gap",
        summary.smallest_agent_gap.map(number),
        &closest(summary.closest_agents.as_ref(), "agents", "and"),
    );
    row(
        "smallest obst. gap",
        summary.smallest_obstacle_gap.map(number),
        &closest(summary.closest_obstacle.as_ref(), "agent", "to obstacle"),
    );
    for (name, cuts, meaning) in [
        (
            "force cuts",
            summary.force_cuts,
            "agent-steps at the actuator limit",
        ),
        (
            "rate cuts",
            summary.rate_cuts,
            "agent-steps at the limit of its rate",
        ),
        (
            "speed cuts",
            summary.speed_cuts,
            "agent-steps at the top speed",
        ),
    ] {
        row(name, (cuts > 0).then(|| cuts.to_string()), meaning);
    }
    let _ = match solver {
        Some(solver) => write!(
            text,
            "\n  points, by {} of order {}, to {:e} in each of its steps{}\n",
            solver.method,
            solver.order,
            solver.relative,
            match solver.jumps {
                0 => String::new(),
                jumps => format!("; {} of the laws", plural(jumps, "jump")),
            }
        ),
        None => write!(
            text,
            "\n  contacts agent-agent     {}\n  contacts agent-obstacle  {}\n",
            contacts(&summary.agent_contacts),
            contacts(&summary.obstacle_contacts)
        ),
    };
    text
}

/// Whose surfaces came closest, and when.
fn closest(approach: Option<&Approach>, agents: &str, to: &str) -> String {
    match approach {
        Some(Approach { agent, other, time }) => {
            format!("{agents} {agent} {to} {other}, at {}", number(*time))
        }
        None => "between surfaces".to_owned(),
    }
}

/// A number in few digits, however large or small.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-3..1e7 => format!("{value:.4}"),
        _ => format!("{value:.4e}"),
    }
}

fn contacts(count: &ContactCount) -> String {
    if count.episodes == 0 {
        return "none".to_owned();
    }
    let mut text = format!(
        "{} ({}), approach up to {}\n{:27}blow up to {}, impulse {} in all, friction {}\n\
         {:27}lasting {} at most, {} on average; deepest penetration {}",
        count.episodes,
        plural(count.pairs, "pair"),
        number(count.highest_approach_speed),
        "",
        number(count.largest_blow),
        number(count.impulse),
        number(count.friction),
        "",
        number(count.longest_duration),
        number(count.mean_duration),
        number(count.deepest_penetration)
    );
    if count.pushed > 0 {
        let _ = write!(text, "; pushed in {}", count.pushed);
    }
    text
}

/// A time without the noise in its last digits.
pub(super) fn time(value: f64) -> f64 {
    let rounded = (value * 1e9).round() / 1e9;
    if rounded.is_finite() { rounded } else { value }
}

/// So many of a thing; "no" of nothing.
pub(super) fn plural(count: u64, thing: &str) -> String {
    match count {
        0 => format!("no {thing}s"),
        1 => format!("1 {thing}"),
        _ => format!("{count} {thing}s"),
    }
}
