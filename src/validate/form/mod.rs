//! The forms of a validation report: text for a terminal, Markdown, HTML with plots, JSON. All
//! are pure functions of the [`Report`](crate::validate::report::Report).

mod catalogue;
mod contact;
mod figures;
mod grid;
mod html;
mod markdown;
mod markup;
mod overview;
mod plot;
mod reasons;
mod silent;
mod table;
mod tally;
mod words;
mod write;

pub use catalogue::{describe, list};
pub use html::html;
pub(crate) use markdown::escape as escape_markdown;
pub use markdown::markdown;
pub(crate) use markup::escape as escape_html;
pub use table::table;
pub use write::{check, write};
