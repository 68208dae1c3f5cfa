//! The table of metrics.
//!
//! Its columns follow what serde makes of the records, so that a quantity added to those is a
//! column without more ado.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;

use super::super::cast::{AXES, distinct};
use super::moment;
use crate::csv::{Cell, write_row};
use crate::trace::record::{Frame, LawRecord};

/// What a law may be about. Each is a column of each law, for whether a frame has it may
/// depend on the state.
const OF_A_LAW: [&str; 8] = [
    "influence.active",
    "influence.connectivity",
    "influence.imbalance",
    "influence.least",
    "position_error",
    "potential",
    "residual",
    "velocity_error",
];

/// Numbers and truths by the name of their column, in alphabetical order.
type Cells = BTreeMap<String, Value>;

/// The columns of a frame beyond time and step.
pub(super) fn columns(frame: &Frame) -> Vec<String> {
    cells(frame).into_keys().collect()
}

/// Adds the row of a frame.
pub(super) fn row(frame: &Frame, text: &mut Vec<u8>) {
    let cells = cells(frame);
    write_row(
        text,
        moment(frame)
            .into_iter()
            .chain(cells.values().map(Cell::from)),
    );
}

fn cells(frame: &Frame) -> Cells {
    let mut cells = Cells::new();
    if let Some(metrics) = &frame.metrics {
        flatten("metrics", json(metrics), &mut cells);
    }
    if let Some(net) = &frame.net {
        flatten("net", json(net), &mut cells);
    }
    if let Some(laws) = &frame.laws {
        let mut whole = json(laws);
        if let Some(fields) = whole.as_object_mut() {
            fields.remove("laws");
        }
        flatten("laws", whole, &mut cells);
        let names = laws.laws.iter().map(|law| law.law.clone());
        for (law, name) in laws.laws.iter().zip(distinct(names)) {
            of_a_law(law, &format!("laws.{name}"), &mut cells);
        }
    }
    cells
}

fn of_a_law(law: &LawRecord, path: &str, cells: &mut Cells) {
    for field in OF_A_LAW {
        cells.insert(format!("{path}.{field}"), Value::Null);
    }
    let mut fields = json(law);
    if let Some(fields) = fields.as_object_mut() {
        fields.remove("law");
    }
    flatten(path, fields, cells);
}

/// Takes a value apart into what fits a cell: `path.field`, and `path.x` of vectors.
fn flatten(path: &str, value: Value, cells: &mut Cells) {
    match value {
        Value::Object(fields) => {
            for (name, value) in fields {
                flatten(&format!("{path}.{name}"), value, cells);
            }
        }
        Value::Array(vector) => {
            for (axis, value) in AXES.iter().zip(vector) {
                flatten(&format!("{path}.{axis}"), value, cells);
            }
        }
        scalar => {
            cells.insert(path.to_owned(), scalar);
        }
    }
}

fn json(record: &impl Serialize) -> Value {
    serde_json::to_value(record).expect("records are plain data with names for keys")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::record::{InfluenceRecord, LawsRecord};

    #[test]
    fn what_a_law_is_about_has_a_column_whether_it_is_there_or_not() {
        let full = LawRecord {
            law: "a".to_owned(),
            potential: Some(1.0),
            residual: Some(2.0),
            position_error: Some(3.0),
            velocity_error: Some(4.0),
            influence: Some(InfluenceRecord {
                least: 5.0,
                active: Some(6),
                imbalance: 7.0,
                connectivity: Some(8.0),
            }),
        };
        let bare = LawRecord {
            law: "a".to_owned(),
            ..LawRecord::default()
        };
        let names = |law: &LawRecord| {
            let mut cells = Cells::new();
            of_a_law(law, "laws.a", &mut cells);
            cells.into_keys().collect::<Vec<_>>()
        };
        assert_eq!(names(&full), names(&bare));
        assert_eq!(names(&full).len(), OF_A_LAW.len());
        // Two laws of one name keep apart.
        let laws = LawsRecord {
            mean_position: vec![1.0, 2.0],
            mean_velocity: Vec::new(),
            mass_center: Vec::new(),
            mass_velocity: Vec::new(),
            largest_kinetic_energy: 0.0,
            potential: None,
            energy: None,
            total_energy: None,
            steering_diameter: 0.0,
            laws: vec![bare, full],
        };
        let frame = Frame {
            laws: Some(Box::new(laws)),
            ..Frame::default()
        };
        let cells = cells(&frame);
        assert_eq!(cells["laws.a.residual"], Value::Null);
        assert_eq!(cells["laws.a_2.residual"], 2.0);
        assert_eq!(cells["laws.mean_position.y"], 2.0);
        assert_eq!(cells["laws.energy"], Value::Null);
    }
}
