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
mod polyline;
mod reasons;
mod scale;
mod silent;
mod table;
mod tally;
mod words;
mod write;

pub use catalogue::{describe, list};
pub use html::html;
pub use markdown::markdown;
pub use table::table;
pub use write::{check, write};
