//! Bodies against points, in lines of text.

use super::words::{number, outcome};
use crate::validate::report::{ContactReport, Departure, ExclusionReport, FirstContact};

/// What bodies change: what each line is about, and what it says.
pub(super) fn lines(contact: &ContactReport) -> Vec<(String, String)> {
    let mut lines = vec![("radius of the bodies".to_owned(), number(contact.radius))];
    let mut line = |about: &str, text: String| lines.push((about.to_owned(), text));
    if contact.exclusions.is_empty() {
        let nothing = "no claim keeps agents apart in this world".to_owned();
        line("without contact in theory", nothing);
    }
    for exclusion in &contact.exclusions {
        line("without contact in theory", excluded(exclusion));
    }
    for (about, radius) in [
        ("without contact as points", contact.points_radius),
        ("without contact as bodies", contact.bodies_radius),
    ] {
        if let Some(radius) = radius {
            line(about, format!("up to radius {}", number(radius)));
        }
    }
    let first = contact.first.as_ref();
    line("first contact", first.map_or("none".to_owned(), touches));
    if let Some(departure) = &contact.departure {
        line("bodies depart from points", departs(departure, first));
    }
    lines
}

fn excluded(exclusion: &ExclusionReport) -> String {
    format!(
        "up to radius {}, half of {} = {}, by {}: {}",
        number(exclusion.radius),
        exclusion.formula,
        number(exclusion.distance),
        exclusion.claim,
        outcome(exclusion.outcome)
    )
}

fn touches(first: &FirstContact) -> String {
    let with = match (first.other_agent, first.obstacle) {
        (Some(other), _) => format!("agents {} and {other}", first.agent),
        (None, Some(obstacle)) => format!("agent {} and obstacle {obstacle}", first.agent),
        (None, None) => format!("agent {}", first.agent),
    };
    let apart = match first.points_apart {
        Some(apart) => format!("; as points these are {} apart", number(apart)),
        None => String::new(),
    };
    let blow = match first.blow > 0.0 {
        true => format!(", with a blow of {}", number(first.blow)),
        false => String::new(),
    };
    format!(
        "at time {}, {with}, approaching at {}{blow}{apart}; {}",
        number(first.time),
        number(first.approach_speed),
        first.cause
    )
}

fn departs(departure: &Departure, first: Option<&FirstContact>) -> String {
    let until = match first {
        Some(_) => "before the first contact",
        None => "over the whole run",
    };
    format!(
        "by {} {until} (velocities by {}), and by {} at the end",
        number(departure.before_contact),
        number(departure.velocities_before_contact),
        number(departure.at_end)
    )
}
