//! The plane, seen from above.

use crate::math::Vector;
use crate::picture::{Color, Mark, Paint, Path, Stroke};
use crate::shape::{Pose, Shape};

use super::extent::hull_of;
use super::hull::hull;
use super::view::{Form, Framing, Seen, Sight, View, disk, stroked};

/// A window of the plane, as large as the page, the y axis upwards.
#[derive(Debug)]
pub(super) struct Above {
    /// The point in the middle.
    center: Vector<2>,
    sides: [f64; 2],
    size: [f64; 2],
    scale: f64,
}

impl Above {
    /// The window that fills the page and holds what is to be seen in its middle.
    pub(super) fn new(framing: &Framing<2>) -> Self {
        let (min, max) = framing.bounds;
        let [width, height] = framing.size;
        let sides = max - min;
        Self {
            center: (min + max) * 0.5,
            sides: sides.into(),
            size: framing.size,
            scale: (width / sides.x).min(height / sides.y),
        }
    }

    fn place(&self, point: &Vector<2>) -> [f64; 2] {
        let way = (point - self.center) * self.scale;
        [0.5 * self.size[0] + way.x, 0.5 * self.size[1] - way.y]
    }

    /// Distance from the middle of the window to its corners.
    fn reach(&self) -> f64 {
        0.5 * self.size[0].hypot(self.size[1]) / self.scale
    }
}

/// A shape of the plane, made ready.
pub(super) fn form(shape: &Shape<2>) -> Form<2> {
    match shape {
        Shape::Ball { radius } => Form::Ball(*radius),
        Shape::Capsule { from, to, radius } => Form::Rod {
            ends: [*from, *to],
            radius: *radius,
        },
        Shape::HalfSpace { normal } => Form::Ground(*normal),
        Shape::Segment { from, to } => Form::Line([*from, *to]),
        Shape::Cuboid { .. } | Shape::Convex { .. } | Shape::Triangle { .. } => {
            let (points, _) = hull_of(shape);
            let corners = hull(points.iter().map(|point| [point.x, point.y]).collect());
            Form::Faces {
                faces: vec![corners.into_iter().map(Vector::<2>::from).collect()],
                thin: false,
            }
        }
    }
}

impl View<2> for Above {
    fn see(&self, point: &Vector<2>) -> Option<Sight> {
        Some(Sight {
            at: self.place(point),
            distance: 0.0,
            scale: self.scale,
        })
    }

    fn through_air(&self, color: Color, _distance: f64) -> Color {
        color
    }

    fn form(&self, form: &Form<2>, pose: &Pose<2>, color: Color, out: &mut Vec<Seen>) {
        let place = |point: &Vector<2>| self.place(&pose.point_to_world(point));
        // The line closes the seam between neighbours that share a side.
        let area = |corners: Vec<[f64; 2]>| Mark::Path {
            path: Path::polygon(corners),
            fill: Some(Paint::Flat(color)),
            stroke: (color.opacity == 1.0).then(|| Stroke::new(color, 0.5)),
        };
        let mark = match form {
            Form::Ball(radius) => disk(place(&Vector::zeros()), radius * self.scale, color),
            Form::Rod { ends, radius } => stroked(
                Path::polyline(ends.iter().map(place)),
                Stroke::new(color, 2.0 * radius * self.scale),
            ),
            Form::Line(ends) => stroked(
                Path::polyline(ends.iter().map(place)),
                Stroke::new(color, THIN),
            ),
            Form::Ground(normal) => {
                // From the point of its edge that is nearest to the middle of the window it
                // need not go farther than the window reaches.
                let middle = pose.point_to_local(&self.center);
                let foot = middle - normal * normal.dot(&middle);
                if normal.dot(&middle) > self.reach() {
                    return;
                }
                let far = 2.0 * self.reach() + normal.dot(&middle).abs();
                let along = Vector::<2>::new(-normal.y, normal.x) * far;
                let behind = normal * -far;
                let corners = [along, -along, behind - along, behind + along];
                area(corners.iter().map(|way| place(&(foot + way))).collect())
            }
            Form::Faces { faces, .. } => {
                for face in faces {
                    let mark = area(face.iter().map(place).collect());
                    out.push(Seen {
                        distance: 0.0,
                        mark,
                    });
                }
                return;
            }
        };
        out.push(Seen {
            distance: 0.0,
            mark,
        });
    }

    fn lines(&self, lines: &[[Vector<2>; 2]], stroke: &Stroke, out: &mut Vec<Seen>) {
        let mut path = Path::new();
        for [from, to] in lines {
            path.begin(self.place(from));
            path.line(self.place(to));
        }
        let mark = stroked(path, stroke.clone());
        out.push(Seen {
            distance: 0.0,
            mark,
        });
    }

    fn grid(&self, apart: f64, color: Color, out: &mut Vec<Seen>) {
        let mut path = Path::new();
        for axis in 0..2 {
            let half = 0.5 * self.size[axis] / self.scale;
            let (first, last) = (self.center[axis] - half, self.center[axis] + half);
            let (first, last) = ((first / apart).ceil(), (last / apart).floor());
            // Far from the origin lines may be closer than numbers are.
            let count = last - first;
            if !(0.0..=1000.0).contains(&count) {
                continue;
            }
            for k in 0..=count as u32 {
                let mut at = self.center;
                at[axis] = (first + f64::from(k)) * apart;
                let [mut from, mut to] = [self.place(&at); 2];
                (from[1 - axis], to[1 - axis]) = (0.0, self.size[1 - axis]);
                path.begin(from);
                path.line(to);
            }
        }
        let mark = stroked(path, Stroke::new(color, 1.0));
        out.push(Seen {
            distance: 0.0,
            mark,
        });
    }

    fn shadow(&self, _form: &Form<2>, _pose: &Pose<2>, _shadows: &mut Path) {}

    fn sides(&self) -> [f64; 2] {
        self.sides
    }

    fn scale(&self) -> f64 {
        self.scale
    }
}

/// Width in pixels of what has no width.
const THIN: f64 = 2.0;
