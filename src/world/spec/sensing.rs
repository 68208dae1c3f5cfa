//! Sensing in a world file: how an agent perceives the others.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::PerAgent;

/// The largest angle: π, rounded up to a number that a person writes, 3.1416.
pub(super) const HALF_TURN: f64 = (std::f64::consts::PI * 1e4).ceil() / 1e4;

/// How the agents of a group perceive others. What is left out limits nothing.
///
/// Who is seen is decided by where agents truly are (`delay` ago); noise corrupts only what
/// is then told of them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Sensing")]
pub struct SensingSpec {
    /// Radius of the spherical neighbourhood, Olfati-Saber (2003), (1) to (3): one number
    /// for all, or a list with one for each agent. Laws act on agents within this radius
    /// and their own range; absent means their range alone.
    pub radius: Option<PerAgent>,
    /// See only what lies ahead. A ball that has never moved heads along the first axis.
    pub field_of_view: Option<FieldOfViewSpec>,
    /// See only agents with a similar heading.
    pub cone: Option<ConeSpec>,
    /// What takes agents out of sight.
    pub blocked_by: BlockedBySpec,
    /// Errors of what is perceived.
    pub noise: NoiseSpec,
    /// How long ago others are seen (time), a whole number of steps; before that time, they
    /// are seen as at the start. The agent's own state, and obstacles, are of the present.
    #[schemars(range(min = 0))]
    pub delay: f64,
    /// Probability that a link is lost, drawn anew for each link and step.
    #[schemars(range(min = 0, max = 1))]
    pub dropout: f64,
}

/// The field of view of Olfati-Saber (2003), §2, as the text describes it: agent j is seen
/// where the direction to it is at most an angle away from the own heading.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FieldOfView")]
pub struct FieldOfViewSpec {
    /// Largest angle between heading and bearing (radians): half the width of the field. π
    /// or more sees all round.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = HALF_TURN))]
    pub angle: f64,
}

/// The conic neighbourhood of Olfati-Saber (2003), (4) and (5), as printed: agent j is seen
/// where its heading is at most an angle away from the own heading.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Cone")]
pub struct ConeSpec {
    /// Largest angle φ0 between the two headings (radians).
    #[schemars(extend("exclusiveMinimum" = 0), range(max = HALF_TURN))]
    pub angle: f64,
    /// Whether the weight of a neighbour falls smoothly to 0 at this angle, by
    /// ρ(|θ_j − θ_i|/φ0), (18), rather than at once, (5).
    #[serde(default)]
    pub smooth: bool,
    /// Where the bump function ρ(z) leaves 1, as a share k0 of the angle; used where
    /// smooth.
    #[serde(default = "super::law::default_bump_start")]
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub bump_start: f64,
}

/// What takes an agent out of another's sight, by standing on the straight line between
/// their centres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "BlockedBy")]
pub struct BlockedBySpec {
    /// Obstacles. An agent whose centre is inside one neither sees nor is seen.
    pub obstacles: bool,
    /// The bodies of third agents, where these are seen: `delay` ago.
    pub bodies: bool,
}

/// Gaussian errors of what is perceived: standard deviations in each coordinate, drawn anew
/// for each link and step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Noise")]
pub struct NoiseSpec {
    /// Of the way to another agent (length).
    #[schemars(range(min = 0))]
    pub position: f64,
    /// Of another agent's velocity (length/time).
    #[schemars(range(min = 0))]
    pub velocity: f64,
}
