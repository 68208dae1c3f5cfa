//! The figures of the papers, made anew from the shipped worlds.
//!
//! The [`catalogue`] has an [`Entry`] for each figure that can be made: which figure of which
//! paper it is, what the paper shows there, and which runs it needs. [`make`] takes the runs,
//! each once, and draws: a [`Figure`] has the picture and, in a sentence with the numbers
//! measured in these runs, what ours shows. [`sketches`] are the figures that show no result.
//!
//! Where a paper leaves open what it drew, as initial states, gains or times, the notes of the
//! worlds say what was put in their place.

mod course;
mod djokam_rathinam;
mod index;
mod li_liu_wu;
mod olfati_saber_2003;
mod page;
mod shi_wang_chu;
mod sketch;
mod song_2013;
mod write;

pub use course::{Course, Courses, Of, Wanted};
pub use index::{html, markdown};
pub use sketch::{Sketch, sketches};
pub use write::{check, write};

use std::collections::BTreeSet;

use rayon::prelude::*;
use thiserror::Error;

use crate::picture::{Picture, Theme};

/// A figure that can be made.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Its name, which will do as that of a file: `djokam-rathinam-3`.
    pub id: &'static str,
    /// Which figure of which paper it is.
    pub source: &'static str,
    /// What the paper shows.
    pub caption: &'static str,
    /// The runs that it is drawn from.
    pub wanted: &'static [Wanted],
    draw: Draw,
}

/// Draws a figure from its runs, and finds out what it shows.
type Draw = fn(&Courses, &Theme) -> Result<(String, Picture), Trouble>;

/// A figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Its name, that of its [`Entry`].
    pub id: &'static str,
    /// Which figure of which paper it is.
    pub source: &'static str,
    /// What the paper shows.
    pub caption: &'static str,
    /// What ours shows, by the numbers measured in its runs.
    pub finding: String,
    /// How it looks.
    pub picture: Picture,
}

/// Why a figure could not be made.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{of}: {problem}")]
pub struct Trouble {
    /// The world that it came with.
    pub of: String,
    /// What is wrong.
    pub problem: String,
}

impl Trouble {
    fn new(of: &str, problem: impl ToString) -> Self {
        Self {
            of: of.to_owned(),
            problem: problem.to_string(),
        }
    }
}

/// The figures that can be made, paper by paper.
pub fn catalogue() -> Vec<Entry> {
    [
        djokam_rathinam::ENTRIES.as_slice(),
        song_2013::ENTRIES.as_slice(),
        li_liu_wu::ENTRIES.as_slice(),
        olfati_saber_2003::ENTRIES.as_slice(),
        shi_wang_chu::ENTRIES.as_slice(),
    ]
    .concat()
}

/// The steps that [`make`] will take for these figures, in all runs together.
///
/// # Errors
/// Where a world is not sound.
pub fn steps(entries: &[Entry]) -> Result<u64, Trouble> {
    let wanted = wanted(entries).into_iter();
    wanted.map(|wanted| Ok(wanted.load()?.steps())).sum()
}

/// Makes figures, in the order of the entries. Each run that they need is taken once, several
/// at a time; `stepped` is called after each step of any of them.
///
/// # Errors
/// Where a run or what follows from it cannot be had.
pub fn make(
    entries: &[Entry],
    theme: &Theme,
    stepped: &(dyn Fn() + Sync),
) -> Result<Vec<Figure>, Trouble> {
    let courses = Courses::run(wanted(entries), stepped)?;
    let figures = entries.par_iter().map(|entry| {
        let (finding, mut picture) = (entry.draw)(&courses, theme)?;
        picture.title = entry.source.to_owned();
        Ok(Figure {
            id: entry.id,
            source: entry.source,
            caption: entry.caption,
            finding,
            picture,
        })
    });
    figures.collect()
}

/// The runs that figures need, each once.
fn wanted(entries: &[Entry]) -> BTreeSet<Wanted> {
    entries.iter().flat_map(|it| it.wanted).copied().collect()
}

/// A measured number in three digits.
fn number(value: f64) -> String {
    crate::math::digits(value, 3)
}

/// Measured numbers in three digits each: "a, b and c".
fn numbers(values: &[f64]) -> String {
    let words: Vec<String> = values.iter().map(|value| number(*value)).collect();
    match words.as_slice() {
        [most @ .., last] if !most.is_empty() => format!("{} and {last}", most.join(", ")),
        _ => words.concat(),
    }
}

/// The lowest of some points, the first of several.
fn lowest(points: impl IntoIterator<Item = [f64; 2]>) -> [f64; 2] {
    let lower = |a: [f64; 2], b: [f64; 2]| if b[1] < a[1] { b } else { a };
    let lowest = points.into_iter().reduce(lower);
    lowest.unwrap_or([f64::NAN; 2])
}

#[cfg(test)]
mod tests;
