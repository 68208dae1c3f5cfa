//! The table of agents.

use super::super::cast::{Cast, distinct};
use super::{moment, numbers, rotation_columns, turn};
use crate::csv::write_row;
use crate::trace::record::{Frame, LawAccelerations};

/// The columns of every trace.
pub(super) fn always(cast: &Cast) -> Vec<String> {
    let names = ["time", "step", "agent", "group"].map(str::to_owned);
    let names = names.into_iter().chain(cast.axes("")).chain(cast.axes("v"));
    names.collect()
}

/// The further columns of a frame.
pub(super) fn columns(cast: &Cast, frame: &Frame) -> Vec<String> {
    let mut names = Vec::new();
    if frame.rotations.is_some() {
        names.extend(rotation_columns(cast));
    }
    let law = |law: &LawAccelerations| law.law.clone();
    for law in distinct(frame.accelerations.iter().flatten().map(law)) {
        names.extend(cast.axes(&format!("acceleration.{law}.")));
    }
    names
}

/// Adds the rows of a frame, which fits the cast.
pub(super) fn rows(cast: &Cast, frame: &Frame, text: &mut Vec<u8>) {
    for (agent, group) in cast.groups.iter().enumerate() {
        let who = [agent.into(), group.as_str().into()];
        let rotation = frame.rotations.iter().flat_map(|all| turn(&all[agent]));
        let laws = frame.accelerations.iter().flatten();
        let cells = moment(frame)
            .into_iter()
            .chain(who)
            .chain(numbers(&frame.positions[agent]))
            .chain(numbers(&frame.velocities[agent]))
            .chain(rotation)
            .chain(laws.flat_map(|law| numbers(&law.values[agent])));
        write_row(text, cells);
    }
}
