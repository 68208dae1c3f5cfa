//! The forms of a validation report: text for a terminal, Markdown, HTML with plots, JSON. All
//! are pure functions of the [`Report`].

mod catalogue;
mod contact;
mod grid;
mod markdown;
mod overview;
mod reasons;
mod table;
mod tally;
mod words;

pub use catalogue::{describe, list};
pub use markdown::markdown;
pub use table::table;
