//! Obstacles in a world file: posed shapes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An obstacle: a fixed convex body, posed.
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
        /// The points; more than the dimension, and not all in one plane (line).
        points: Vec<Vec<f64>>,
    },
}
