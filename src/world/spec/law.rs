//! Laws in a world file: their parameters, in plain words.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{AlignmentSpec, FlatnessSpec, ScopeSpec, SteeringSpec, TrackingSpec};
use crate::math::{Action, AlphaPair, Bump, Fade};

/// One law: a term of the sum that accelerates the agents.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Law")]
pub enum LawSpec {
    /// Spacing and velocity damping between neighbours: the (α, α) protocols.
    AlphaInteraction(AlphaInteractionSpec),
    /// Repulsion from obstacles by β-agents, guidance around them by γ-agents.
    ObstacleAvoidance(ObstacleAvoidanceSpec),
    /// Steering to a common velocity or to a destination.
    Navigation(NavigationSpec),
    /// Turning to the neighbours' headings: attitude alignment.
    HeadingConsensus(HeadingConsensusSpec),
    /// Following a target that moves.
    Tracking(TrackingSpec),
    /// Steering given in advance.
    Steering(SteeringSpec),
    /// Steering along given trajectories, by differential flatness.
    Flatness(FlatnessSpec),
    /// Velocity alignment: the models of Cucker and Smale, Motsch and Tadmor, Djokam and
    /// Rathinam.
    Alignment(AlignmentSpec),
    /// Laws for some groups only.
    Scope(ScopeSpec),
}

/// The (α, α) protocols of Olfati-Saber (2003), equations (34) to (36).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "AlphaInteraction")]
pub struct AlphaInteractionSpec {
    /// Which protocol.
    #[serde(default)]
    pub protocol: AlphaProtocol,
    /// Desired distance between neighbours, d_α; below the range.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub spacing: f64,
    /// Interaction range r: agents at most this far apart are neighbours.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: f64,
    /// Velocity damping between neighbours, c1 (1/time).
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub damping: f64,
    /// The action function φ_α.
    #[serde(default)]
    pub action: ActionSpec,
    /// Where the bump function ρ(z) leaves 1, as a share k0 of the range; used by
    /// the smooth protocols.
    #[serde(default = "default_bump_start")]
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub bump_start: f64,
}

/// The (α, α) protocols of Olfati-Saber (2003).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AlphaProtocol {
    /// (34): full force up to the range, none beyond.
    Nonsmooth,
    /// (35) as printed: force fades out smoothly, damping does not.
    Smooth,
    /// (35) with the damping weighted by a_ij(q), so that it fades out as well.
    #[default]
    SmoothWeightedDamping,
    /// (36): (35) without the gradient of the weight.
    Approximate,
}

/// The uneven sigmoidal action function φ_α and its potential ψ_α, Olfati-Saber
/// (2003), equation (29): attraction tends to a, repulsion to b.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Action")]
pub struct ActionSpec {
    /// Limit of the attraction between far neighbours, a (acceleration).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub attraction: f64,
    /// Limit of the repulsion between near neighbours, b (acceleration); not
    /// below the attraction.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub repulsion: f64,
}

impl Default for ActionSpec {
    fn default() -> Self {
        Self {
            attraction: 1.0,
            repulsion: 5.0,
        }
    }
}

/// The (α, β) and (α, γ) interactions of Olfati-Saber (2003), equations (53) to (57).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ObstacleAvoidance")]
pub struct ObstacleAvoidanceSpec {
    /// Activation range r0: an obstacle acts on agents whose centre is at most
    /// this far from its surface.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: f64,
    /// Distance d_β from the surface below which the β-agent repels.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub standoff: f64,
    /// Gain c3 of the whole interaction.
    #[schemars(range(min = 0))]
    pub gain: f64,
    /// Damping c4 relative to the β-agent's velocity (1/time, times the gain).
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub damping: f64,
    /// The action function behind φ_β = min(φ_α, 0) and φ_γ = φ_α.
    #[serde(default)]
    pub action: ActionSpec,
    /// Where the bump function ρ(z) leaves 1, as a share k0 of the range.
    #[serde(default = "default_bump_start")]
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub bump_start: f64,
    /// The γ-agents; absent means none.
    #[serde(default)]
    pub gamma: Option<GammaSpec>,
}

/// γ-agents: points inside the obstacles that draw agents past them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Gamma")]
pub struct GammaSpec {
    /// Where the γ-agent sits on the way from the obstacle's centre to its surface
    /// along the direction, λ_d: 0 excluded, 1 on the surface.
    #[serde(default = "one")]
    #[schemars(range(max = 1), extend("exclusiveMinimum" = 0))]
    pub offset: f64,
    /// Desired distance to the γ-agent, d_γ.
    #[schemars(range(min = 0))]
    pub spacing: f64,
    /// The direction n_d; any length above 0. Absent means the direction of the
    /// first navigation law that steers to a velocity other than rest.
    #[serde(default)]
    pub direction: Option<Vec<f64>>,
}

/// Steering: Olfati-Saber (2003), equations (50), (64) and (66), and the forms
/// in between.
///
/// With (q, p) the agent's own position and velocity or the mean over the agents in scope, and F
/// the identity or F(z) = z/√(1+|z|²), the acceleration of every agent is
/// −c_q F(q − q_d) − c_p F(p − p_d).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Navigation")]
pub struct NavigationSpec {
    /// Whose position and velocity are steered.
    #[serde(default)]
    pub steer: Steered,
    /// How the feedback grows with the error.
    #[serde(default)]
    pub feedback: Feedback,
    /// Destination q_d, a point to come to rest at; absent means none.
    #[serde(default)]
    pub destination: Option<Vec<f64>>,
    /// Velocity p_d; absent means rest. Needed where there is no destination.
    #[serde(default)]
    pub velocity: Option<Vec<f64>>,
    /// Gain c_q of the position error; has no effect without a destination.
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub position_gain: f64,
    /// Gain c_p (the papers' c2) of the velocity error.
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub velocity_gain: f64,
}

/// Whose position and velocity a navigation law steers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Steered {
    /// Each agent's own: needs no communication.
    #[default]
    Agent,
    /// The mean over the agents in scope, with the same acceleration for all: (64), (66).
    Mean,
}

/// How a navigation law's feedback grows with the error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Feedback {
    /// F(z) = z/√(1+|z|²): never more than the gain.
    #[default]
    Bounded,
    /// F(z) = z.
    Linear,
}

/// Attitude alignment, the agreement protocol of Olfati-Saber (2003), equations (12) and
/// (13): agents turn towards the headings of their neighbours, at their own speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "HeadingConsensus")]
pub struct HeadingConsensusSpec {
    /// Gain of the turning rate (1/time); 1 in the paper.
    #[serde(default = "one")]
    #[schemars(range(min = 0))]
    pub gain: f64,
    /// Interaction range r: agents at most this far apart are neighbours.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: f64,
    /// Whether the weight of a neighbour falls smoothly to 0 at the range, (17), rather
    /// than at once, (8).
    #[serde(default)]
    pub smooth: bool,
    /// Where the bump function ρ(z) leaves 1, as a share k0 of the range; used where
    /// smooth.
    #[serde(default = "default_bump_start")]
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub bump_start: f64,
}

impl ActionSpec {
    /// The function that these limits make.
    pub fn action(&self) -> Action {
        Action::new(self.attraction, self.repulsion)
    }
}

impl AlphaInteractionSpec {
    /// The pair interaction that these parameters make.
    pub fn pair(&self) -> AlphaPair {
        let bump = Bump::new(self.bump_start);
        AlphaPair {
            action: self.action.action(),
            spacing: self.spacing,
            range: self.range,
            fade: match self.protocol {
                AlphaProtocol::Nonsmooth => Fade::Sharp,
                AlphaProtocol::Smooth | AlphaProtocol::SmoothWeightedDamping => Fade::Smooth(bump),
                AlphaProtocol::Approximate => Fade::Approximate(bump),
            },
        }
    }
}

fn one() -> f64 {
    1.0
}

pub(super) fn default_bump_start() -> f64 {
    5.0 / 6.0
}
