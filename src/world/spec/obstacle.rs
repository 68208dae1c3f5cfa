//! Obstacles in a world file: posed shapes, fixed or moving.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::motion::MotionSpec;

/// An obstacle: a shape, posed, that stands still or moves as it is told.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Obstacle")]
pub struct ObstacleSpec {
    /// Name of the obstacle, for reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its shape, in its own frame.
    pub shape: ShapeSpec,
    /// Position of its frame's origin; absent means the world's origin.
    #[serde(default)]
    pub position: Option<Vec<f64>>,
    /// Rotation of its frame: in 2-D an angle in radians, counter-clockwise; in
    /// 3-D a rotation vector, axis times angle in radians.
    #[serde(default)]
    pub rotation: Option<Rotation>,
    /// How it moves; absent means not at all. Agents are placed clear of where it is at
    /// time 0, and contacts with it push them without pushing it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionSpec>,
    /// How an obstacle of several convex parts acts on an agent; absent means `each` for
    /// compounds and rooms and `nearest` for what is one surface, whose adjoining parts
    /// would count twice at a joint. A shape that is convex itself has one β-agent anyway.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beta_agents: Option<BetaAgents>,
    /// Restitution of contacts with it, 0 to 1, whatever that of the agents; absent means the mean
    /// of the agents' and that of `physics`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1))]
    pub restitution: Option<f64>,
    /// Coulomb friction coefficient of contacts with it, whatever that of the agents; absent means
    /// the mean of the agents' and that of `physics`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub friction: Option<f64>,
}

/// How an obstacle of several convex parts acts on an agent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BetaAgents {
    /// Each part in range has a β-agent, and where it is solid a γ-agent: the parts are
    /// the obstacles O_k of the law.
    Each,
    /// The nearest point of all parts is the only β-agent, and there is no γ-agent.
    Nearest,
}

/// A rotation: an angle in 2-D, a rotation vector in 3-D (radians).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Rotation {
    /// 2-D: the angle.
    Angle(f64),
    /// 3-D: axis times angle.
    Vector(Vec<f64>),
}

/// The shape of an obstacle, in its own frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[schemars(rename = "Shape")]
pub enum ShapeSpec {
    /// A disk or sphere about the origin.
    Ball {
        /// Radius.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius: f64,
    },
    /// A rectangle or box about the origin, its sides along the axes.
    Cuboid {
        /// Half the side along each axis, all above 0.
        #[schemars(extend("items" = {"type": "number", "exclusiveMinimum": 0}))]
        half_extents: Vec<f64>,
    },
    /// All points within a radius of a segment.
    Capsule {
        /// One end of the segment.
        from: Vec<f64>,
        /// The other end, different from the first.
        to: Vec<f64>,
        /// Radius about the segment.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius: f64,
    },
    /// Everything behind a flat face through the origin.
    HalfSpace {
        /// Normal of the face, pointing out of the obstacle; any length above 0.
        normal: Vec<f64>,
    },
    /// The convex hull of some points: a polygon in 2-D, a polyhedron in 3-D.
    Convex {
        /// The points; more than the dimension, and not all in one plane (line). Ten thousand
        /// at most.
        points: Vec<Vec<f64>>,
    },
    /// A straight wall without thickness.
    Segment {
        /// One end.
        from: Vec<f64>,
        /// The other end, different from the first.
        to: Vec<f64>,
    },
    /// A triangle: a solid in 2-D, a thin facet in 3-D.
    Triangle {
        /// The three corners, not on one line.
        points: Vec<Vec<f64>>,
    },
    /// A chain of straight walls without thickness.
    Polyline {
        /// The points, at least two, each different from the one before.
        points: Vec<Vec<f64>>,
        /// Whether the last point is joined to the first; then there are at least three.
        #[serde(default)]
        closed: bool,
    },
    /// Triangles that share corners: thin facets in 3-D, and in 2-D solids, those that
    /// share an edge being one solid.
    Mesh {
        /// The corners.
        vertices: Vec<Vec<f64>>,
        /// The triangles, each by the indices of its three corners, counted from 0.
        #[schemars(length(min = 1))]
        triangles: Vec<Vec<usize>>,
    },
    /// A thin surface by its heights above a base, which lies about the origin.
    Heightfield {
        /// Length of the base along the first axis.
        #[schemars(extend("exclusiveMinimum" = 0))]
        width: f64,
        /// 3-D: length of the base along the second axis.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(extend("exclusiveMinimum" = 0))]
        depth: Option<f64>,
        /// The heights, along the last axis, at evenly spaced places, the ends included:
        /// in 2-D a list from −width/2 to width/2; in 3-D a list of such rows, from
        /// −depth/2 to depth/2 along the second axis.
        heights: Heights,
    },
    /// Several shapes that move as one.
    Compound {
        /// The shapes, which may overlap, each with its own pose in the obstacle's frame.
        #[schemars(length(min = 1))]
        parts: Vec<CompoundPart>,
    },
    /// The inside of a box about the origin, its sides along the axes: walls that nothing
    /// gets out of.
    Room {
        /// Half the side along each axis, all above 0.
        #[schemars(extend("items" = {"type": "number", "exclusiveMinimum": 0}))]
        half_extents: Vec<f64>,
    },
    /// Thin walls on both sides of a centre line: in 2-D two lines, in 3-D a tunnel of
    /// square cross-section that does not turn about the line. Its ends are open.
    Corridor {
        /// The points of the centre line, at least two, each different from the one before.
        points: Vec<Vec<f64>>,
        /// Distance between opposite walls.
        #[schemars(extend("exclusiveMinimum" = 0))]
        width: f64,
        /// Whether the last point is joined to the first; then there are at least three,
        /// and in 3-D the loop must not twist, which no loop in a plane does.
        #[serde(default)]
        closed: bool,
    },
}

/// Heights of a height field.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Heights {
    /// 2-D: at least two heights.
    Row(Vec<f64>),
    /// 3-D: at least two rows of equally many heights, at least two.
    Rows(Vec<Vec<f64>>),
}

/// A shape within a compound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Part")]
pub struct CompoundPart {
    /// The shape.
    pub shape: ShapeSpec,
    /// Position of its frame's origin in the obstacle's frame; absent means its origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<Vec<f64>>,
    /// Rotation of its frame in the obstacle's, as obstacles have theirs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<Rotation>,
}
