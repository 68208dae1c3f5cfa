//! What a trace tells of contacts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What an agent touched.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Partner {
    /// Another agent.
    Agent,
    /// An obstacle.
    Obstacle,
}

/// A contact episode: from the moment at which two bodies touch until they have parted by more
/// than a millionth of the smaller one's radius (of a body that is not round, that of the ball
/// which holds it). Touching means an impulse, or a gap of zero or less.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Contact {
    /// The agent; the one with the lower index where both are agents.
    pub agent: usize,
    /// What it touched.
    pub with: Partner,
    /// Index of what it touched: an agent or an obstacle.
    pub other: usize,
    /// Time at which they began to touch.
    pub begin: f64,
    /// Time at which they touched last: that of the blow where they parted after one, otherwise
    /// the end of the last step in which they touched.
    pub end: f64,
    /// Whether they had not parted when the run ended.
    pub open: bool,
    /// Number of steps in which they touched.
    pub steps: u64,
    /// Largest blow (mass × velocity): the normal impulse from when the surfaces meet until they
    /// approach no more. 0 where they were never thrown together.
    #[serde(default)]
    pub blow: f64,
    /// Number of steps in which there was a blow.
    #[serde(default)]
    pub blows: u64,
    /// Normal impulse of the whole episode (mass × velocity).
    #[serde(default)]
    pub impulse: f64,
    /// Largest normal impulse of any step (mass × velocity).
    pub largest_impulse: f64,
    /// The impulse over the time from `begin` to `end`; null where that is no time at all.
    #[serde(default)]
    pub mean_force: Option<f64>,
    /// Impulse of friction of the whole episode: the sum of its sizes (mass × velocity).
    #[serde(default)]
    pub friction: f64,
    /// Deepest penetration (length), 0 where the bodies never overlapped.
    pub deepest_penetration: f64,
    /// Speed at which the surfaces approached each other along the normal, just before they
    /// touched; negative where they were parting.
    pub approach_speed: f64,
    /// Largest speed at which the surface of a moving obstacle advanced into the agent
    /// along the normal; 0 for fixed obstacles and for agents.
    #[serde(default)]
    pub push_speed: f64,
    /// Position of the agent when they began to touch.
    pub position: Vec<f64>,
}

/// Contact episodes of one kind, counted.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct ContactCount {
    /// Number of episodes.
    pub episodes: u64,
    /// Number of different pairs that touched.
    pub pairs: u64,
    /// Largest blow.
    #[serde(default)]
    pub largest_blow: f64,
    /// Normal impulse of all episodes together.
    #[serde(default)]
    pub impulse: f64,
    /// Impulse of friction of all episodes together.
    #[serde(default)]
    pub friction: f64,
    /// Largest normal impulse of any step.
    pub largest_impulse: f64,
    /// Longest time from begin to end of an episode.
    #[serde(default)]
    pub longest_duration: f64,
    /// Mean time from begin to end of the episodes; 0 without any.
    #[serde(default)]
    pub mean_duration: f64,
    /// Deepest penetration.
    pub deepest_penetration: f64,
    /// Highest approach speed.
    pub highest_approach_speed: f64,
    /// Number of episodes in which a moving obstacle advanced into the agent.
    #[serde(default)]
    pub pushed: u64,
}

/// Who came closest, and when.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Approach {
    /// The agent; the one with the lower index where both are agents.
    pub agent: usize,
    /// Index of what it came closest to: an agent or an obstacle.
    pub other: usize,
    /// When.
    pub time: f64,
}

/// How near a run came to what contacts can do at its step. What goes far in a step, overlaps
/// deeply or bounces often within one asks for a smaller step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "Strain")]
pub struct StrainRecord {
    /// Longest way of a body in a step, over its radius: that of the ball within it.
    pub travel: f64,
    /// Deepest overlap, over the radius of the smaller body.
    pub overlap: f64,
    /// Steps in which more bounces followed each other than can be put in order.
    pub unordered: u64,
}
