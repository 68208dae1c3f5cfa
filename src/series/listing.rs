//! What a trace records.

use std::collections::BTreeMap;
use std::fmt;

use serde_json::Value;

use super::derived::{Derived, NAMES};
use super::path::{each_leaf, number};
use crate::math::digits;
use crate::trace::record::Frame;

/// The numbers that the frames of a trace record, by name, and those that follow from them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Listing {
    /// How many frames it has.
    pub frames: u64,
    /// Whether it ends without its summary.
    pub truncated: bool,
    /// What is recorded.
    pub recorded: BTreeMap<String, Extent>,
    /// What follows from positions, velocities and the world.
    pub derived: BTreeMap<String, Extent>,
}

/// How far a number goes over all frames.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Extent {
    /// The least and the largest value; nothing where there is none.
    pub range: Option<[f64; 2]>,
    /// In how many frames it has a value.
    pub frames: u64,
}

impl fmt::Display for Extent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |value: f64| digits(value, 6);
        match self.range {
            None => f.write_str("no value"),
            Some([low, high]) if number(low) == number(high) => f.write_str(&number(low)),
            Some([low, high]) => write!(f, "{} to {}", number(low), number(high)),
        }
    }
}

impl Extent {
    fn add(&mut self, value: Option<f64>) {
        let Some(value) = value else { return };
        let [low, high] = self.range.unwrap_or([value; 2]);
        self.range = Some([low.min(value), high.max(value)]);
        self.frames += 1;
    }
}

impl Listing {
    pub(super) fn add(&mut self, tree: &Value, frame: &Frame, derived: &Derived) {
        self.frames += 1;
        each_leaf(tree, "", &mut |path, value| {
            if !self.recorded.contains_key(path) {
                self.recorded.insert(path.to_owned(), Extent::default());
            }
            if let Some(extent) = self.recorded.get_mut(path) {
                extent.add(number(value));
            }
        });
        let recorded = |name: &str| tree.pointer(&format!("/metrics/{name}")).is_some();
        for name in NAMES.into_iter().filter(|it| !it.starts_with("d_")) {
            if !recorded(name) {
                let value = derived.value(name, frame);
                self.derived.entry(name.to_owned()).or_default().add(value);
            }
        }
    }
}
