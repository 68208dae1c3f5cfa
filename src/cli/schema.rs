//! `volary schema`: the JSON Schemas of the file formats.

use clap::{Args, ValueEnum};

use super::{Refusal, print};

/// Arguments of `volary schema`.
#[derive(Debug, Args)]
pub(super) struct SchemaArguments {
    /// Which format
    #[arg(value_enum, default_value_t = Format::World)]
    format: Format,
}

/// The formats that have a schema.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Format {
    /// World files
    World,
    /// One record of a trace
    Trace,
    /// Summary files
    Summary,
    /// Reports of `volary validate`
    Validation,
}

/// Prints a schema.
pub(super) fn schema(arguments: &SchemaArguments) -> Result<(), Refusal> {
    let schema = match arguments.format {
        Format::World => volary::schema::world(),
        Format::Trace => volary::schema::trace(),
        Format::Summary => volary::schema::summary(),
        Format::Validation => volary::schema::validation(),
    };
    print(&volary::schema::text(&schema))
}
