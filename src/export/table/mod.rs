//! Tables of a trace, row by row.

mod agents;
mod events;
mod metrics;

use super::cast::Cast;
use super::{ExportError, Table};
use crate::csv::{Cell, write_row};
use crate::trace::Record;
use crate::trace::record::Frame;
use crate::world::spec::Rotation;

/// Writes one table of a trace.
#[derive(Debug)]
pub(super) struct TableWriter {
    table: Table,
    cast: Cast,
    /// The columns beyond those that every trace has; known from the first frame on.
    recorded: Option<Vec<String>>,
}

impl TableWriter {
    pub fn new(table: Table, cast: Cast) -> Self {
        Self {
            table,
            cast,
            recorded: None,
        }
    }

    /// Adds the rows of one record, and before the first the line of names.
    pub fn write(&mut self, record: &Record, text: &mut Vec<u8>) -> Result<(), ExportError> {
        match (self.table, record) {
            (Table::Contacts, Record::Contact(contact)) => {
                self.cast.check_contact(contact)?;
                self.begin(Vec::new(), text);
                events::contact(contact, text);
            }
            (Table::Contacts, _) => {}
            (_, Record::Frame(frame)) => self.frame(frame, text)?,
            _ => {}
        }
        Ok(())
    }

    /// Makes sure of the line of names.
    pub fn finish(&mut self, text: &mut Vec<u8>) {
        self.begin(Vec::new(), text);
    }

    fn frame(&mut self, frame: &Frame, text: &mut Vec<u8>) -> Result<(), ExportError> {
        self.cast.check(frame)?;
        let columns = match self.table {
            Table::Agents => agents::columns(&self.cast, frame),
            Table::Metrics => metrics::columns(frame),
            _ => Vec::new(),
        };
        match &self.recorded {
            None => {
                self.check_recorded(frame)?;
                self.begin(columns, text);
            }
            Some(recorded) if *recorded == columns => {}
            Some(_) => {
                return Err(self
                    .cast
                    .uneven(frame, "records other things than the first"));
            }
        }
        match self.table {
            Table::Agents => agents::rows(&self.cast, frame, text),
            Table::Metrics => metrics::row(frame, text),
            Table::Edges => events::pairs(frame, &frame.edges, text),
            Table::Links => events::pairs(frame, &frame.links, text),
            Table::Blocked => events::pairs(frame, &frame.blocked, text),
            Table::BetaAgents => events::beta_agents(frame, text),
            Table::Obstacles => events::obstacles(frame, text),
            Table::Contacts => {}
        }
        Ok(())
    }

    /// Writes the line of names once.
    fn begin(&mut self, recorded: Vec<String>, text: &mut Vec<u8>) {
        if self.recorded.is_none() {
            let mut names = self.columns();
            names.extend(recorded.iter().cloned());
            write_row(text, names.iter().map(|name| name.as_str().into()));
            self.recorded = Some(recorded);
        }
    }

    /// The columns that the table has in every trace.
    fn columns(&self) -> Vec<String> {
        let cast = &self.cast;
        let plain = |names: &[&str]| -> Vec<String> {
            names.iter().map(|name| (*name).to_owned()).collect()
        };
        match self.table {
            Table::Agents => agents::always(cast),
            Table::Metrics => plain(&["time", "step"]),
            Table::Contacts => events::contact_columns(cast),
            Table::Edges | Table::Links | Table::Blocked => {
                plain(&["time", "step", "agent", "other"])
            }
            Table::BetaAgents => events::beta_columns(cast),
            Table::Obstacles => events::obstacle_columns(cast),
        }
    }

    /// Refuses a table of which the trace, going by a frame, holds nothing.
    fn check_recorded(&self, frame: &Frame) -> Result<(), ExportError> {
        let (there, table, hint) = match self.table {
            Table::Agents | Table::Contacts => return Ok(()),
            Table::Metrics => (
                frame.metrics.is_some() || frame.net.is_some() || frame.laws.is_some(),
                "metrics",
                ": run it with record.metrics, record.net or record.laws set to true",
            ),
            Table::Edges => (
                frame.edges.is_some(),
                "edges",
                ": run it with --set record.edges=true; only worlds with an alpha_interaction have them",
            ),
            Table::Links => (
                frame.links.is_some(),
                "links",
                ": run it with --set record.links=true",
            ),
            Table::Blocked => (
                frame.blocked.is_some(),
                "blocked lines of sight",
                ": run it with --set record.blocked=true",
            ),
            Table::BetaAgents => (
                frame.beta_agents.is_some(),
                "β-agents",
                ": run it with --set record.beta_agents=true; only worlds with an \
                 obstacle_avoidance have them",
            ),
            Table::Obstacles => (
                frame.obstacles.is_some(),
                "obstacles that move",
                ", for there are none",
            ),
        };
        match there {
            true => Ok(()),
            false => Err(ExportError::NotRecorded {
                name: self.cast.name.clone(),
                table,
                hint,
            }),
        }
    }
}

/// The columns of a rotation: an angle in 2-D, a rotation vector in 3-D.
fn rotation_columns(cast: &Cast) -> Vec<String> {
    match cast.dimension {
        2 => vec!["angle".to_owned()],
        _ => cast.axes("r").collect(),
    }
}

/// The cells of a vector.
fn numbers<'a>(vector: &[f64]) -> impl Iterator<Item = Cell<'a>> {
    vector.iter().copied().map(Cell::Number)
}

/// The cells of a rotation.
fn turn<'a>(rotation: &Rotation) -> impl Iterator<Item = Cell<'a>> {
    numbers(match rotation {
        Rotation::Angle(angle) => std::slice::from_ref(angle),
        Rotation::Vector(turn) => turn,
    })
}

/// The cells that tell when: time and step.
fn moment<'a>(frame: &Frame) -> [Cell<'a>; 2] {
    [frame.time.into(), frame.step.into()]
}
