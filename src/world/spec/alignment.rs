//! Velocity alignment in a world file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::sensing::HALF_TURN;
use super::{ActsAs, GraphSpec, SummationSpec, TimeFunctionSpec, Values};
use crate::math::{Bump, Influence};

/// Velocity alignment: the acceleration of agent i is g(|u_i|) u_i with
/// u_i = Σ_j a_ij (v_j − v_i). With the choices below it is the model of Cucker and Smale,
/// that of Motsch and Tadmor, and every generalisation of Djokam & Rathinam.
///
/// Before normalisation the influence a_ij of agent j on agent i is the product of the
/// kernel, the graph, orientation, masking, and line of sight; each that is left out is 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Alignment")]
pub struct AlignmentSpec {
    /// Influence φ(r) by distance.
    pub kernel: KernelSpec,
    /// What the influences on an agent are divided by.
    pub normalisation: NormalisationSpec,
    /// Whether an agent's influence on itself, φ(0), counts in the sum that Motsch and
    /// Tadmor divide by. It is never masked nor weighed by a fixed graph.
    pub self_influence: bool,
    /// The gain g (1/time).
    pub gain: GainSpec,
    /// ε, which divides the gain: Djokam & Rathinam, (4.1).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub epsilon: f64,
    /// What g(|u_i|) u_i is.
    pub acts_as: ActsAs,
    /// Agents at most this far apart influence each other; absent means all pairs.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub range: Option<f64>,
    /// Influence by where an agent is looking.
    pub orientation: Option<OrientationSpec>,
    /// Third agents on the way weaken the influence.
    pub masking: Option<MaskingSpec>,
    /// Bodies and obstacles on the way weaken the influence, or block it.
    pub line_of_sight: Option<LineOfSightSpec>,
    /// Weights w_ij by which influences are multiplied.
    pub graph: Option<GraphSpec>,
    /// How the dynamics integrate the law.
    pub relaxation: RelaxationSpec,
    /// How influences are summed. Where the law relaxes, they are not, but followed one by one.
    #[serde(skip_serializing_if = "SummationSpec::is_auto")]
    pub summation: SummationSpec,
}

impl Default for AlignmentSpec {
    fn default() -> Self {
        Self {
            kernel: KernelSpec::default(),
            normalisation: NormalisationSpec::None,
            self_influence: true,
            gain: GainSpec::Constant(Values::All(1.0)),
            epsilon: 1.0,
            acts_as: ActsAs::Acceleration,
            range: None,
            orientation: None,
            masking: None,
            line_of_sight: None,
            graph: None,
            relaxation: RelaxationSpec::Auto,
            summation: SummationSpec::Auto,
        }
    }
}

/// Influence φ(r) of an agent at the distance r.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Kernel")]
pub enum KernelSpec {
    /// The same at any distance.
    Constant {
        /// The influence K.
        #[serde(default = "one")]
        #[schemars(range(min = 0))]
        strength: f64,
    },
    /// K/(σ² + r²)^β: Djokam & Rathinam, below (1.1).
    CuckerSmale {
        /// K.
        #[serde(default = "one")]
        #[schemars(range(min = 0))]
        strength: f64,
        /// σ.
        #[serde(default = "one")]
        #[schemars(extend("exclusiveMinimum" = 0))]
        length: f64,
        /// β.
        #[schemars(range(min = 0))]
        exponent: f64,
    },
    /// K ρ(r/R), which falls smoothly to 0; ρ is the bump function of Olfati-Saber (2003),
    /// (16).
    Bump {
        /// K.
        #[serde(default = "one")]
        #[schemars(range(min = 0))]
        strength: f64,
        /// R, where the influence ends.
        #[schemars(extend("exclusiveMinimum" = 0))]
        range: f64,
        /// Where ρ leaves 1, as a share k0 of R.
        #[serde(default = "super::law::default_bump_start")]
        #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
        start: f64,
    },
    /// K exp(−r/ℓ).
    Exponential {
        /// K.
        #[serde(default = "one")]
        #[schemars(range(min = 0))]
        strength: f64,
        /// ℓ.
        #[schemars(extend("exclusiveMinimum" = 0))]
        length: f64,
    },
}

impl Default for KernelSpec {
    fn default() -> Self {
        Self::Constant { strength: 1.0 }
    }
}

impl KernelSpec {
    /// The function.
    pub fn influence(&self) -> Influence {
        match *self {
            Self::Constant { strength } => Influence::Constant(strength),
            Self::CuckerSmale {
                strength,
                length,
                exponent,
            } => Influence::CuckerSmale {
                strength,
                length,
                exponent,
            },
            Self::Bump {
                strength,
                range,
                start,
            } => Influence::Bump {
                strength,
                range,
                bump: Bump::new(start),
            },
            Self::Exponential { strength, length } => Influence::Exponential { strength, length },
        }
    }
}

/// What the influences on an agent are divided by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Normalisation")]
pub enum NormalisationSpec {
    /// Nothing.
    #[default]
    None,
    /// The number N of agents that the law can see: Djokam & Rathinam, (1.1).
    MeanField,
    /// The sum of the influences on the agent, so that they add up to 1: Djokam & Rathinam,
    /// (1.2).
    MotschTadmor,
}

/// The gain of an alignment law: a number for all, a list with one for each agent, or one of
/// the functions below.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "Gain")]
pub enum GainSpec {
    /// The same at all times and for every u.
    Constant(Values),
    /// One that changes.
    Varying(VaryingGainSpec),
}

/// A gain that changes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "VaryingGain")]
pub enum VaryingGainSpec {
    /// ξ(u) = A/√(a² + |u|²), so that the acceleration never exceeds A: Djokam & Rathinam,
    /// (2.3).
    Bounded {
        /// A, or one for each agent.
        bound: Values,
        /// a > 0, or one for each agent.
        scale: Values,
    },
    /// α_i(t) ≥ 0: one function for all, or a list with one for each agent. Djokam &
    /// Rathinam, (2.6).
    OpenLoop(OpenLoopSpec),
}

/// One function of time for all agents that a law acts on, or a list with one for each of
/// them, in the order of the world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "OpenLoop")]
pub enum OpenLoopSpec {
    /// One for each agent, in order.
    Each(Vec<TimeFunctionSpec>),
    /// The same for all.
    All(TimeFunctionSpec),
}

/// Orientation bias, φ_ij(x; σ_i(v_i)): Djokam & Rathinam, (2.4). With
/// c = ⟨σ_i, x_j − x_i⟩/√(|x_j − x_i|² + ℓ²), where σ_i = v_i/√(|v_i|² + b²) is where the agent
/// looks, the factor falls smoothly from 1 at c ≥ cos θ + w to the floor at c ≤ cos θ − w.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Orientation")]
pub struct OrientationSpec {
    /// θ (radians): half the angle of the cone, where a fast agent's factor is halfway.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = HALF_TURN))]
    pub angle: f64,
    /// w: how softly the cone ends, measured in the cosine.
    #[serde(default = "default_softness")]
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 2))]
    pub softness: f64,
    /// The factor of agents outside the cone. Above 0, so that no influence ever ends, as
    /// Assumption 2 asks.
    #[serde(default = "default_floor")]
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 1))]
    pub floor: f64,
    /// b: the speed from which on an agent looks where it goes; far slower ones look nowhere,
    /// and c is 0 for all others.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub speed: f64,
    /// ℓ: the distance below which directions fade out, so that the factor is smooth even
    /// where agents meet.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
}

/// Masking by third agents: Djokam & Rathinam, (B.1). The influence of j on i is multiplied
/// by exp(−Σ_l h(w_ijl + w_jil)), with h(s) = k (s − s0)³ above the onset s0, and 0 below.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Masking")]
pub struct MaskingSpec {
    /// r: how close agents must be for their angles not to count. Pairs nearer than about
    /// 2.47 r are not masked at the default onset.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
    /// s0: the sum of the two smoothed cosines from which on a third agent masks.
    #[serde(default = "default_onset")]
    #[schemars(range(min = 1), extend("exclusiveMaximum" = 2))]
    pub onset: f64,
    /// k: a third agent right on a long way multiplies the influence by
    /// exp(−k (2 − s0)³), which is exp(−3) by default.
    #[serde(default = "default_strength")]
    #[schemars(range(min = 0))]
    pub strength: f64,
}

/// What stands on the straight line between the centres of two agents: each body of a third
/// agent and each obstacle multiplies the influence by its factor. Shapes are the true ones;
/// a line that just touches is blocked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "LineOfSight")]
pub struct LineOfSightSpec {
    /// Factor of each body: 0 blocks, 1 changes nothing.
    #[schemars(range(min = 0, max = 1))]
    pub agents: f64,
    /// Factor of each obstacle.
    #[schemars(range(min = 0, max = 1))]
    pub obstacles: f64,
}

impl Default for LineOfSightSpec {
    fn default() -> Self {
        Self {
            agents: 1.0,
            obstacles: 1.0,
        }
    }
}

/// How the dynamics integrate a law that pulls velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Relaxation")]
pub enum RelaxationSpec {
    /// Exactly over a step, where the largest rates that all such laws of the world can have
    /// add up to a quarter or more over the step; otherwise as all other laws.
    #[default]
    Auto,
    /// Exactly over a step.
    Always,
    /// As all other laws: with the acceleration held over a step.
    Never,
}

fn one() -> f64 {
    1.0
}

fn default_softness() -> f64 {
    0.2
}

fn default_floor() -> f64 {
    0.1
}

fn default_onset() -> f64 {
    1.9
}

fn default_strength() -> f64 {
    3000.0
}
