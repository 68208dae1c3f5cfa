//! Obstacles as a world file describes them, built.

use crate::math::{Vector, axis, direction};
use crate::shape::surface::{self, Bent};
use crate::shape::{Acting, Easing, Geometry, In, Motion, Obstacle, Part, Pose, Shape};
use crate::world::crowd;
use crate::world::problem::Problem;
use crate::world::spec::{
    BetaAgents, CompoundPart, EasingSpec, Heights, MotionSpec, ObstacleSpec, Rotation, ShapeSpec,
};
use crate::world::{vector, vector_or_zero};

/// The obstacles of a checked world, where they are at time 0.
///
/// # Errors
/// Those of which no solid can be made, or no corridor.
pub(super) fn build<const D: usize>(
    specs: &[ObstacleSpec],
) -> Result<Vec<Obstacle<D>>, Vec<Problem>>
where
    In<D>: Geometry<D>,
{
    let mut obstacles = Vec::new();
    let mut problems = Vec::new();
    for (index, spec) in specs.iter().enumerate() {
        let unnamed = || format!("obstacle {index}");
        let name = spec.name.clone().unwrap_or_else(unnamed);
        match obstacle(name, spec) {
            Ok(obstacle) => obstacles.push(obstacle),
            Err((field, what)) => {
                let path = format!("obstacles[{index}].shape{field}");
                problems.push(Problem::new(path, what));
            }
        }
    }
    if problems.is_empty() {
        problems.extend(crowd::problem(&obstacles));
    }
    if problems.is_empty() {
        Ok(obstacles)
    } else {
        Err(problems)
    }
}

/// Writes out what the file leaves to defaults.
pub(super) fn fill_in<const D: usize>(spec: &mut ObstacleSpec) {
    if !matches!(spec.motion, Some(MotionSpec::Waypoints { .. })) {
        spec.position.get_or_insert_with(|| vec![0.0; D]);
    }
    spec.rotation.get_or_insert(match D {
        2 => Rotation::Angle(0.0),
        _ => Rotation::Vector(vec![0.0; 3]),
    });
    if spec.beta_agents.is_none() {
        spec.beta_agents = default_beta_agents(&spec.shape);
    }
}

/// How a shape of several parts acts where the file does not say.
fn default_beta_agents(shape: &ShapeSpec) -> Option<BetaAgents> {
    match shape {
        ShapeSpec::Compound { .. } | ShapeSpec::Room { .. } => Some(BetaAgents::Each),
        ShapeSpec::Polyline { .. }
        | ShapeSpec::Mesh { .. }
        | ShapeSpec::Heightfield { .. }
        | ShapeSpec::Corridor { .. } => Some(BetaAgents::Nearest),
        ShapeSpec::Ball { .. }
        | ShapeSpec::Cuboid { .. }
        | ShapeSpec::Capsule { .. }
        | ShapeSpec::HalfSpace { .. }
        | ShapeSpec::Convex { .. }
        | ShapeSpec::Segment { .. }
        | ShapeSpec::Triangle { .. } => None,
    }
}

/// What is wrong with a shape: the way to the field, and the message.
type Flaw = (String, String);

fn obstacle<const D: usize>(name: String, spec: &ObstacleSpec) -> Result<Obstacle<D>, Flaw>
where
    In<D>: Geometry<D>,
{
    let acting = match spec.beta_agents.or(default_beta_agents(&spec.shape)) {
        Some(BetaAgents::Nearest) => Acting::Nearest,
        Some(BetaAgents::Each) | None => Acting::Each,
    };
    let parts = parts(shapes(&spec.shape)?)?;
    let pose = pose(&spec.position, &spec.rotation);
    let obstacle = Obstacle::of_parts(name, parts, acting, pose)
        .ok_or_else(|| (String::new(), "has no parts".to_owned()))?;
    let obstacle = match &spec.shape {
        ShapeSpec::Mesh {
            vertices,
            triangles,
        } if D == 2 => {
            let outline = surface::outline(&vectors(vertices), &corners(triangles));
            obstacle.outlined(parts_of(outline)?)
        }
        _ => obstacle,
    };
    Ok(match &spec.motion {
        Some(spec) => obstacle.moving(motion(spec)),
        None => obstacle,
    })
}

/// Shapes with their poses in the obstacle's frame, where these differ.
type Posed<const D: usize> = Vec<(Shape<D>, Option<Pose<D>>)>;

fn parts<const D: usize>(shapes: Posed<D>) -> Result<Vec<Part<D>>, Flaw>
where
    In<D>: Geometry<D>,
{
    let part = |(shape, pose)| Part::new(shape, pose).ok_or_else(too_thin);
    shapes.into_iter().map(part).collect()
}

fn parts_of<const D: usize>(shapes: Vec<Shape<D>>) -> Result<Vec<Part<D>>, Flaw>
where
    In<D>: Geometry<D>,
{
    parts(shapes.into_iter().map(|shape| (shape, None)).collect())
}

fn too_thin() -> Flaw {
    let what = "is too thin to make a solid of: it must be about a thousandth as thick as it is \
                wide";
    (String::new(), what.to_owned())
}

/// The convex shapes that make up a shape.
fn shapes<const D: usize>(spec: &ShapeSpec) -> Result<Posed<D>, Flaw> {
    let here = |shapes: Vec<Shape<D>>| shapes.into_iter().map(|shape| (shape, None)).collect();
    let one = |shape: Shape<D>| vec![(shape, None)];
    Ok(match spec {
        ShapeSpec::Ball { radius } => one(Shape::Ball { radius: *radius }),
        ShapeSpec::Cuboid { half_extents } => one(Shape::Cuboid {
            half_extents: vector(half_extents),
        }),
        ShapeSpec::Capsule { from, to, radius } => one(Shape::Capsule {
            from: vector(from),
            to: vector(to),
            radius: *radius,
        }),
        ShapeSpec::HalfSpace { normal } => one(Shape::HalfSpace {
            normal: direction(&vector(normal)),
        }),
        ShapeSpec::Convex { points } => one(Shape::Convex {
            points: vectors(points),
        }),
        ShapeSpec::Segment { from, to } => one(Shape::Segment {
            from: vector(from),
            to: vector(to),
        }),
        ShapeSpec::Triangle { points } => one(Shape::Triangle {
            points: [0, 1, 2].map(|k| vector(&points[k])),
        }),
        ShapeSpec::Polyline { points, closed } => {
            here(surface::polyline(&vectors(points), *closed))
        }
        ShapeSpec::Mesh {
            vertices,
            triangles,
        } => here(surface::mesh(&vectors(vertices), &corners(triangles))),
        ShapeSpec::Heightfield {
            width,
            depth,
            heights,
        } => here(match heights {
            Heights::Row(row) => surface::heightfield(std::slice::from_ref(row), [*width, 0.0]),
            Heights::Rows(rows) => surface::heightfield(rows, [*width, depth.unwrap_or(0.0)]),
        }),
        ShapeSpec::Compound { parts } => {
            let mut all = Vec::new();
            for (index, part) in parts.iter().enumerate() {
                let found = compound_part(part).map_err(|(field, what)| {
                    (format!(".compound.parts[{index}].shape{field}"), what)
                });
                all.extend(found?);
            }
            all
        }
        ShapeSpec::Room { half_extents } => {
            let half: Vector<D> = vector(half_extents);
            let wall = |k: usize, sign: f64| {
                let out: Vector<D> = axis::<D>(k) * sign;
                let pose = Pose::new(out * half[k], [0.0; 3]);
                (Shape::HalfSpace { normal: -out }, Some(pose))
            };
            (0..D).flat_map(|k| [wall(k, -1.0), wall(k, 1.0)]).collect()
        }
        ShapeSpec::Corridor {
            points,
            width,
            closed,
        } => here(
            surface::corridor(&vectors(points), *width, *closed).map_err(|bent| match bent {
                Bent::Leg(leg) => (
                    format!(".corridor.points[{leg}]"),
                    "begins a leg too short for the bends at its ends: a wider bend or a smaller \
                     width may help"
                        .to_owned(),
                ),
                Bent::Twist => (
                    ".corridor.closed".to_owned(),
                    "must be false, since the loop would twist the tunnel; a loop in one plane \
                     does not"
                        .to_owned(),
                ),
            })?,
        ),
    })
}

/// The shapes of a part of a compound, posed in the compound's frame.
fn compound_part<const D: usize>(part: &CompoundPart) -> Result<Posed<D>, Flaw> {
    let outer = pose(&part.position, &part.rotation);
    let posed = |(shape, inner): (Shape<D>, Option<Pose<D>>)| match inner {
        Some(inner) => (shape, Some(outer.then(&inner))),
        None => (shape, Some(outer.clone())),
    };
    Ok(shapes(&part.shape)?.into_iter().map(posed).collect())
}

fn vectors<const D: usize>(points: &[Vec<f64>]) -> Vec<Vector<D>> {
    points.iter().map(|point| vector(point)).collect()
}

fn corners(triangles: &[Vec<usize>]) -> Vec<[usize; 3]> {
    triangles
        .iter()
        .map(|corners| [corners[0], corners[1], corners[2]])
        .collect()
}

fn pose<const D: usize>(position: &Option<Vec<f64>>, rotation: &Option<Rotation>) -> Pose<D> {
    let turn = rotation.as_ref().map_or([0.0; 3], Rotation::turn);
    Pose::new(vector_or_zero(position), turn)
}

fn motion<const D: usize>(spec: &MotionSpec) -> Motion<D> {
    match spec {
        MotionSpec::Oscillation {
            amplitude,
            period,
            phase,
        } => Motion::Oscillation {
            amplitude: vector(amplitude),
            period: *period,
            phase: *phase,
        },
        MotionSpec::Rotation { about, rate } => Motion::Rotation {
            about: about.as_ref().map(|about| vector(about)),
            rate: rate.turn(),
        },
        MotionSpec::Waypoints {
            points,
            dwell,
            period,
            easing,
        } => Motion::Waypoints {
            points: vectors(points),
            dwell: *dwell,
            period: *period,
            easing: match easing {
                EasingSpec::Linear => Easing::Linear,
                EasingSpec::Smooth => Easing::Smooth,
            },
        },
        MotionSpec::Drift { velocity } => Motion::Drift {
            velocity: vector(velocity),
        },
    }
}
