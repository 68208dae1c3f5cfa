//! JSON Schemas of the files that Volary reads and writes, derived from the
//! types that hold them.

use schemars::{JsonSchema, schema_for};
use serde_json::Value;

use crate::trace::record::{Record, Summary};
use crate::validate::report::Report;
use crate::world::spec::WorldSpec;

/// Schema of a world file.
pub fn world() -> Value {
    schema::<WorldSpec>()
}

/// Schema of one line of a trace.
pub fn trace() -> Value {
    schema::<Record>()
}

/// Schema of a run's summary.
pub fn summary() -> Value {
    schema::<Summary>()
}

/// Schema of a validation report.
pub fn validation() -> Value {
    schema::<Report>()
}

fn schema<T: JsonSchema>() -> Value {
    schema_for!(T).to_value()
}

/// A schema as it is printed and kept in `schema/`.
pub fn text(schema: &Value) -> String {
    format!("{schema:#}\n")
}
