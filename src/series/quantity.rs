//! Numbers that frames record, by name.

use serde_json::Value;

use super::derived::{Derived, NAMES};
use super::path::{lookup, number};
use crate::trace::record::Frame;

/// Where a name is looked for, in this order: in the frame itself, then inside of these.
const PLACES: [&str; 4] = ["", "metrics.", "laws.", "net."];

/// A number that frames record, or that follows from them, by its name.
///
/// A name is a path in a frame, such as `metrics.density` or `positions[3][0]`; `metrics.`,
/// `laws.` and `net.` may be left out, and are looked through in this order. The short names d_X
/// and d_V stand for the diameters of positions and velocities. These two, `agent_gap` in worlds
/// of balls, `mean_speed` and `target_error` (the largest distance of an agent from the target of
/// its tracking or flatness law) are there whether recorded or not. A truth counts as 1 or 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Quantity {
    name: String,
}

/// What a frame has of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Found {
    /// Nothing of this name.
    Nothing,
    /// The name, but no number.
    Undefined,
    /// A number.
    Value(f64),
}

impl Quantity {
    /// The quantity of this name.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into() }
    }

    /// Its name, as it was asked for.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The last part of its name, with the short names spelt out: what it is.
    pub(super) fn stem(&self) -> &str {
        match self.name.rsplit('.').next().unwrap_or_default() {
            "d_X" => "position_diameter",
            "d_V" => "velocity_diameter",
            stem => stem,
        }
    }

    /// What stands along an axis of it.
    pub(super) fn label(&self) -> String {
        let symbol = match self.stem() {
            "position_diameter" => "d_X",
            "velocity_diameter" => "d_V",
            "density" => "δ₀",
            "structural_energy" => "H",
            "energy" => "W",
            "total_energy" => "J",
            "largest_kinetic_energy" => "E",
            "normalised_defect" => "μ_n",
            "algebraic_connectivity" => "λ₂",
            _ => "",
        };
        let words = match self.stem() == "position_diameter" || self.stem() == "velocity_diameter" {
            true => self.stem(),
            false => &self.name,
        };
        let words = words.replace('_', " ");
        let inside = ["metrics.", "laws.", "net."];
        let words = inside
            .iter()
            .find_map(|it| words.strip_prefix(it))
            .unwrap_or(&words);
        format!("{words} {symbol}").trim_end().to_owned()
    }

    /// Whether it reads whole lists of the frame, which are large.
    pub(super) fn reads(&self, field: &str) -> bool {
        self.name.starts_with(field)
    }

    /// What a frame has of it; `tree` is what the frame records, as JSON.
    pub(super) fn of(&self, tree: &Value, frame: &Frame, derived: &Derived) -> Found {
        let stem = self.stem();
        let name = match self.name.contains('.') {
            true => &self.name,
            false => stem,
        };
        let recorded = PLACES
            .iter()
            .find_map(|place| lookup(tree, &format!("{place}{name}")))
            .filter(|it| !it.is_object() && !it.is_array() && !it.is_string());
        match recorded {
            Some(value) => number(value).map_or(Found::Undefined, Found::Value),
            None if NAMES.contains(&name) => {
                let value = derived.value(name, frame);
                value.map_or(Found::Undefined, Found::Value)
            }
            None => Found::Nothing,
        }
    }
}
