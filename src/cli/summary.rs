//! The summary that a run prints.

use std::fmt::Write;
use std::time::Duration;

use volary::trace::record::{ContactCount, Summary};

/// The summary of a run as a table for people.
pub(super) fn table(summary: &Summary, took: Duration) -> String {
    let last = &summary.last;
    let seconds = took.as_secs_f64();
    let mut text = format!(
        "{}, seed {}: {} agents to time {} in {} steps ({seconds:.2} s)\n\n",
        summary.name, summary.seed, summary.agents, summary.time, summary.steps
    );
    let mut row = |name: &str, value: String, meaning: &str| {
        let _ = writeln!(text, "  {name:<20}{value:>12}   {meaning}");
    };
    let number = |value: f64| format!("{value:.4}");
    let maybe = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), number);
    let count = |value: Option<usize>| value.map_or_else(|| "-".to_owned(), |n| n.to_string());
    row(
        "density",
        maybe(last.density),
        "share of agents in the largest component",
    );
    row("components", count(last.components), "of the proximity net");
    row("edges", count(last.edges), "of the proximity net");
    row(
        "polarization",
        number(last.polarization),
        "1: all headings agree",
    );
    row(
        "velocity mismatch",
        number(last.velocity_mismatch),
        "rms, to the velocity steered to",
    );
    row(
        "velocity diameter",
        number(last.velocity_diameter),
        "largest difference of two",
    );
    row(
        "position diameter",
        number(last.position_diameter),
        "largest distance of two",
    );
    row("structural energy", maybe(last.structural_energy), "H_s");
    row(
        "smallest agent gap",
        maybe(summary.smallest_agent_gap),
        "between surfaces, whole run",
    );
    row(
        "smallest obst. gap",
        maybe(summary.smallest_obstacle_gap),
        "between surfaces, whole run",
    );
    if summary.force_cuts > 0 {
        row(
            "force cuts",
            summary.force_cuts.to_string(),
            "agent-steps at the actuator limit",
        );
    }
    let _ = write!(
        text,
        "\n  contacts agent-agent     {}\n  contacts agent-obstacle  {}\n",
        contacts(&summary.agent_contacts),
        contacts(&summary.obstacle_contacts)
    );
    text
}

fn contacts(count: &ContactCount) -> String {
    if count.episodes == 0 {
        return "none".to_owned();
    }
    format!(
        "{} ({} pairs); largest impulse {:.3}, deepest penetration {:.4}, approach up to {:.3}",
        count.episodes,
        count.pairs,
        count.largest_impulse,
        count.deepest_penetration,
        count.highest_approach_speed
    )
}
