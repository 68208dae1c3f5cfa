//! Tables of what comes in other numbers than agents: contacts, pairs, β-agents, obstacles.

use super::super::cast::Cast;
use super::{moment, numbers, rotation_columns, turn};
use crate::csv::{Cell, write_row};
use crate::trace::record::{Contact, Frame, Partner};

/// The columns of contacts.
pub(super) fn contact_columns(cast: &Cast) -> Vec<String> {
    let names = [
        "agent",
        "with",
        "other",
        "begin",
        "end",
        "open",
        "steps",
        "blow",
        "blows",
        "impulse",
        "largest_impulse",
        "mean_force",
        "friction",
        "deepest_penetration",
        "approach_speed",
        "push_speed",
    ];
    let names = names.into_iter().map(str::to_owned);
    names.chain(cast.axes("")).collect()
}

/// Adds the row of a contact, whose position fits the cast.
pub(super) fn contact(contact: &Contact, text: &mut Vec<u8>) {
    let with = match contact.with {
        Partner::Agent => "agent",
        Partner::Obstacle => "obstacle",
    };
    let cells = [
        contact.agent.into(),
        with.into(),
        contact.other.into(),
        contact.begin.into(),
        contact.end.into(),
        Cell::Truth(contact.open),
        contact.steps.into(),
        contact.blow.into(),
        contact.blows.into(),
        contact.impulse.into(),
        contact.largest_impulse.into(),
        contact.mean_force.map_or(Cell::Empty, Cell::from),
        contact.friction.into(),
        contact.deepest_penetration.into(),
        contact.approach_speed.into(),
        contact.push_speed.into(),
    ];
    write_row(text, cells.into_iter().chain(numbers(&contact.position)));
}

/// Adds the rows of a frame's pairs of agents.
pub(super) fn pairs(frame: &Frame, pairs: &Option<Vec<[usize; 2]>>, text: &mut Vec<u8>) {
    for pair in pairs.iter().flatten() {
        let agents = pair.map(Cell::from);
        write_row(text, moment(frame).into_iter().chain(agents));
    }
}

/// The columns of β-agents.
pub(super) fn beta_columns(cast: &Cast) -> Vec<String> {
    let names = ["time", "step", "agent", "obstacle", "part"].map(str::to_owned);
    let names = names.into_iter().chain(cast.axes("")).chain(cast.axes("v"));
    names.chain(["distance".to_owned()]).collect()
}

/// Adds the rows of a frame's β-agents, which fit the cast.
pub(super) fn beta_agents(frame: &Frame, text: &mut Vec<u8>) {
    for beta in frame.beta_agents.iter().flatten() {
        let part = beta.part.map_or(Cell::Empty, Cell::from);
        let cells = moment(frame)
            .into_iter()
            .chain([beta.agent.into(), beta.obstacle.into(), part])
            .chain(numbers(&beta.position))
            .chain(numbers(&beta.velocity))
            .chain([beta.distance.into()]);
        write_row(text, cells);
    }
}

/// The columns of obstacles.
pub(super) fn obstacle_columns(cast: &Cast) -> Vec<String> {
    let names = ["time", "step", "obstacle"].map(str::to_owned);
    let names = names.into_iter().chain(cast.axes(""));
    names.chain(rotation_columns(cast)).collect()
}

/// Adds the rows of a frame's moving obstacles, which fit the cast.
pub(super) fn obstacles(frame: &Frame, text: &mut Vec<u8>) {
    for pose in frame.obstacles.iter().flatten() {
        let cells = moment(frame)
            .into_iter()
            .chain([pose.obstacle.into()])
            .chain(numbers(&pose.position))
            .chain(turn(&pose.rotation));
        write_row(text, cells);
    }
}
