//! Agents in a world file: groups of bodies.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::start::{PlacementSpec, VelocitySpec};
use super::{Rotation, SensingSpec};

/// A group of agents: bodies of one shape that share how they are placed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Group")]
pub struct GroupSpec {
    /// Name of the group, for reports and scopes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Number of agents; may be left out where positions are listed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 10_000_000))]
    pub count: Option<usize>,
    /// Radius of each body, a disk or sphere; a group has either this or a `shape`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: Option<f64>,
    /// Shape of each body; a group has either this or a `radius`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<BodyShapeSpec>,
    /// Mass of each body: one number for all, or a list with one for each; 1 where neither
    /// this nor a `density` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<PerAgent>,
    /// Density of each body, in place of a mass: mass over area in 2-D, over volume in 3-D.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: Option<f64>,
    /// Restitution of the bodies' surfaces, from 0 to 1; absent means that of `physics`,
    /// which is also the obstacles'. A contact's restitution is the mean of its two surfaces',
    /// unless it is with an obstacle that has its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1))]
    pub restitution: Option<f64>,
    /// Coulomb friction coefficient of the bodies' surfaces; absent means that of `physics`,
    /// which is also the obstacles'. A contact's coefficient is the mean of its two surfaces',
    /// unless it is with an obstacle that has its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub friction: Option<f64>,
    /// Actuator limit: the largest force that the laws can exert on one body;
    /// absent means no limit. Gravity and contacts are not limited.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub force_limit: Option<f64>,
    /// Actuator limit: the largest change of the laws' force per unit of time, from any
    /// force at the start; absent means no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub force_rate_limit: Option<f64>,
    /// Speed beyond which the laws' force never takes a body. Gravity and contacts may take
    /// it there; then the force may not make it faster, but needs not slow it down. Comes after
    /// the two limits of the force, so a force cut for it may change faster than its rate limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub top_speed: Option<f64>,
    /// How bodies that are not round are turned; absent means a torque with its default gain.
    /// A ball needs none: it heads where it moves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading: Option<HeadingSpec>,
    /// How bodies that are not round stand at the start, their heading along the frame's
    /// first axis: in 2-D an angle in radians, counter-clockwise; in 3-D a rotation vector, axis
    /// times angle in radians. Absent means along each one's velocity, unturned where it rests.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<Rotation>,
    /// Where the agents start.
    pub positions: PlacementSpec,
    /// How fast the agents start; at rest when absent.
    #[serde(default)]
    pub velocities: VelocitySpec,
    /// How the agents perceive others; absent means without limits or errors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sensing: Option<SensingSpec>,
}

impl GroupSpec {
    /// The shape of the group's bodies: `shape`, or the ball of its `radius`.
    pub fn body_shape(&self) -> BodyShapeSpec {
        self.shape.clone().unwrap_or(BodyShapeSpec::Ball {
            radius: self.radius.unwrap_or(0.0),
        })
    }

    /// Whether the group's bodies are balls.
    pub fn is_round(&self) -> bool {
        match &self.shape {
            None | Some(BodyShapeSpec::Ball { .. }) => true,
            Some(_) => false,
        }
    }
}

/// The shape of a body in its own frame, whose first axis is the body's heading. The frame's
/// origin, the centroid, is what a position in the world file and a trace means, and all
/// that laws see of the body: its shape counts for contacts, gaps and headings. Bodies that
/// are placed at random do not touch the balls about the centroid that hold the others; listed
/// ones may stand as near as their shapes allow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "BodyShape")]
pub enum BodyShapeSpec {
    /// A disk or sphere.
    Ball {
        /// Radius.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius: f64,
    },
    /// A rod with round ends along the heading: all points within a radius of a segment.
    Capsule {
        /// Half the length of the segment.
        #[schemars(extend("exclusiveMinimum" = 0))]
        half_length: f64,
        /// Radius about the segment.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius: f64,
    },
    /// A rectangle or box, its sides along the axes.
    Cuboid {
        /// Half the side along each axis, all above 0.
        #[schemars(extend("items" = {"type": "number", "exclusiveMinimum": 0}))]
        half_extents: Vec<f64>,
    },
    /// The convex hull of some points: a polygon in 2-D, a polyhedron in 3-D.
    Convex {
        /// The points; more than the dimension, and not all in one plane (line). They are
        /// shifted so that the hull's centroid comes to lie at the frame's origin. Ten thousand
        /// at most.
        points: Vec<Vec<f64>>,
    },
}

/// How a body that is not round is turned.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Heading")]
pub enum HeadingSpec {
    /// A torque steers it to its velocity: the heading swings in as a damped pendulum would.
    Torque(TorqueSpec),
    /// It is turned to its velocity each step, with whatever torque that takes; what
    /// it touches still stops it.
    Velocity(TurnSpec),
    /// Only contacts turn it.
    Free,
    /// Nothing turns it.
    Fixed,
}

/// A torque that steers a body's heading to its velocity. Per moment of inertia it is
/// gain × 2 sin(θ/2) towards the velocity, with θ the angle from the heading to it, less
/// damping × angular velocity. At rest only the damping is left.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "HeadingTorque")]
pub struct TorqueSpec {
    /// Gain per moment of inertia (1/time²): the square of the frequency of small swings.
    #[serde(default = "default_gain")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gain: f64,
    /// Damping per moment of inertia (1/time); absent means critical, 2√gain.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub damping: Option<f64>,
    /// Largest torque; absent means no limit.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub limit: Option<f64>,
}

impl TorqueSpec {
    /// The damping that is meant: critical where none is given.
    pub fn damping(&self) -> f64 {
        self.damping.unwrap_or(2.0 * self.gain.sqrt())
    }
}

impl Default for TorqueSpec {
    fn default() -> Self {
        Self {
            gain: default_gain(),
            damping: None,
            limit: None,
        }
    }
}

/// A heading that is turned to the velocity.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "HeadingTurn")]
pub struct TurnSpec {
    /// Largest angular speed (radians per unit of time); it is never above an eighth of a full turn
    /// in a step, which absent means.
    #[serde(default)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub turn_rate: Option<f64>,
}

/// One positive number for all agents of a group, or a list with one for each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum PerAgent {
    /// The same for all.
    All(#[schemars(extend("exclusiveMinimum" = 0))] f64),
    /// One for each agent, in order.
    Each(#[schemars(extend("items" = {"type": "number", "exclusiveMinimum": 0}))] Vec<f64>),
}

fn default_gain() -> f64 {
    25.0
}
