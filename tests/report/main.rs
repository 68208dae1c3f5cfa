//! The forms of a validation report: text, Markdown, HTML and JSON of reports made by hand.

mod files;
mod page;
mod sample;
mod text;
