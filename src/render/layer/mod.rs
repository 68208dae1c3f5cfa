//! The layers of a picture: what can be shown or hidden. One file each for what draws them.

pub(super) mod avoidance;
pub(super) mod bodies;
pub(super) mod contacts;
pub(super) mod field;
pub(super) mod net;
pub(super) mod obstacles;
pub(super) mod targets;
pub(super) mod trails;

use std::fmt;
use std::str::FromStr;

use crate::render::{RenderError, Survey};
use crate::world::nearest_path;

/// Something that can be shown or hidden.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Lines a round length apart: over the plane, or on the ground.
    Grid,
    /// Shadows on the ground, straight below what throws them; in space only.
    Shadows,
    /// Obstacles of every shape, where they are.
    Obstacles,
    /// Where the targets of tracking laws and the destinations of navigation are, and the ways
    /// of the targets over the run.
    Targets,
    /// Fields of view.
    View,
    /// Where bodies came along lately.
    Trails,
    /// Edges of the proximity net.
    Edges,
    /// Blocked lines of sight.
    Blocked,
    /// β-agents, the projections of agents on obstacles.
    Beta,
    /// γ-agents, which draw agents past obstacles.
    Gamma,
    /// Velocities, as arrows.
    Velocities,
    /// Bodies, at true size.
    Bodies,
    /// Which way bodies head.
    Headings,
    /// Contacts: flashes while they last, marks afterwards.
    Contacts,
    /// The time.
    Time,
    /// A bar of a round length.
    Scale,
    /// What colours and marks mean.
    Legend,
}

impl Layer {
    /// All layers, those further back first.
    pub const ALL: [Self; 17] = [
        Self::Grid,
        Self::Shadows,
        Self::Obstacles,
        Self::Targets,
        Self::View,
        Self::Trails,
        Self::Edges,
        Self::Blocked,
        Self::Beta,
        Self::Gamma,
        Self::Velocities,
        Self::Bodies,
        Self::Headings,
        Self::Contacts,
        Self::Time,
        Self::Scale,
        Self::Legend,
    ];

    /// Its name, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Shadows => "shadows",
            Self::Obstacles => "obstacles",
            Self::Targets => "targets",
            Self::View => "view",
            Self::Trails => "trails",
            Self::Edges => "edges",
            Self::Blocked => "blocked",
            Self::Beta => "beta",
            Self::Gamma => "gamma",
            Self::Velocities => "velocities",
            Self::Bodies => "bodies",
            Self::Headings => "headings",
            Self::Contacts => "contacts",
            Self::Time => "time",
            Self::Scale => "scale",
            Self::Legend => "legend",
        }
    }
}

impl fmt::Display for Layer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Layer {
    type Err = RenderError;

    fn from_str(name: &str) -> Result<Self, RenderError> {
        if let Some(layer) = Self::ALL.into_iter().find(|layer| layer.name() == name) {
            return Ok(layer);
        }
        let names = Self::ALL.map(Self::name);
        let meant = nearest_path(name, &names).map(|near| format!("; did you mean {near}?"));
        Err(RenderError::Layer(format!(
            "there is no layer `{name}`{} The layers are {}",
            meant.unwrap_or_else(|| ".".to_owned()),
            names.join(", ")
        )))
    }
}

/// Some layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Layers(u32);

impl Layers {
    /// No layer at all.
    pub const NONE: Self = Self(0);

    /// What the papers' figures show: bodies with their headings, obstacles, targets, contacts,
    /// the edges of the net where the trace has them, time and scale; in space also the ground
    /// and the shadows on it.
    pub fn usual<const D: usize>(survey: &Survey<D>) -> Self {
        let mut layers = Self::from_iter([
            Layer::Obstacles,
            Layer::Targets,
            Layer::Bodies,
            Layer::Headings,
            Layer::Contacts,
            Layer::Time,
            Layer::Scale,
            Layer::Legend,
        ]);
        if survey.recorded.edges {
            layers.show(Layer::Edges);
        }
        if D == 3 {
            layers.show(Layer::Grid);
            layers.show(Layer::Shadows);
        }
        layers
    }

    /// Adds a layer.
    pub fn show(&mut self, layer: Layer) {
        self.0 |= 1 << layer as u32;
    }

    /// Takes a layer away.
    pub fn hide(&mut self, layer: Layer) {
        self.0 &= !(1 << layer as u32);
    }

    /// Whether a layer is among them.
    pub fn has(self, layer: Layer) -> bool {
        self.0 & (1 << layer as u32) != 0
    }
}

impl FromIterator<Layer> for Layers {
    fn from_iter<I: IntoIterator<Item = Layer>>(layers: I) -> Self {
        let mut some = Self::NONE;
        layers.into_iter().for_each(|layer| some.show(layer));
        some
    }
}
