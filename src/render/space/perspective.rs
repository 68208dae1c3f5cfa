//! What is drawn of space: shaded balls, rods and faces, lines, the ground and the shadows there.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::math::{Vector, direction, plane_across};
use crate::picture::{Color, Mark, Paint, Path, Stroke};
use crate::shape::{Bounds, Pose};

use super::super::hull::hull;
use super::super::view::{Form, Framing, Seen, Sight, View, filled, stroked};
use super::camera::{DISTANCE, Eyepoint};

/// Space from one point, with light from above over the left shoulder.
#[derive(Debug)]
pub(in crate::render) struct Perspective {
    eye: Eyepoint,
    bounds: Bounds<3>,
    page: Color,
    ground: f64,
    /// Unit vector to the light.
    light: Vector<3>,
}

/// Faces of rods seen from the side.
const BANDS: usize = 6;

/// How much of its colour the farthest part of a scene has lost to the page.
const HAZE: f64 = 0.55;

impl Perspective {
    /// The view of all that is to be seen.
    pub(in crate::render) fn new(framing: &Framing<3>) -> Self {
        let eye = Eyepoint::new(framing);
        let light = eye.back * 0.6 - eye.right * 0.4 + eye.up * 0.2;
        Self {
            light: direction(&(light + Vector::<3>::new(0.0, 0.0, 0.7))),
            eye,
            bounds: framing.bounds,
            page: framing.theme.page,
            ground: framing.ground,
        }
    }

    /// A colour in the light that falls on a surface with this normal, from this distance.
    fn lit(&self, color: Color, normal: &Vector<3>, distance: f64) -> Color {
        self.through_air(shade(color, normal.dot(&self.light)), distance)
    }

    fn polygon(&self, corners: impl Iterator<Item = Vector<3>>) -> Option<Vec<[f64; 2]>> {
        corners.map(|it| Some(self.eye.see(&it)?.0)).collect()
    }

    fn ball(&self, center: &Vector<3>, radius: f64, color: Color, out: &mut Vec<Seen>) {
        let (Some((at, scale)), distance) = (self.eye.see(center), self.eye.distance(center))
        else {
            return;
        };
        if distance <= radius {
            return;
        }
        // The circle in which lines of sight touch the ball: nothing behind it covers the ball.
        let rim = (distance * distance - radius * radius).sqrt();
        let seen = radius * scale * distance / rim;
        let color = |light| self.through_air(shade(color, light), distance);
        let fill = match seen < 2.5 {
            true => Paint::Flat(color(0.6)),
            false => {
                let light = [
                    self.light.dot(&self.eye.right),
                    self.light.dot(&self.eye.up),
                ];
                Paint::Radial {
                    center: [at[0] + 0.5 * seen * light[0], at[1] - 0.5 * seen * light[1]],
                    radius: 1.35 * seen,
                    inner: color(1.15),
                    outer: color(-0.1),
                }
            }
        };
        out.push(Seen {
            distance: rim,
            mark: Mark::Disk {
                center: at,
                radius: seen,
                fill: Some(fill),
                stroke: None,
            },
        });
    }

    fn rod(&self, [from, to]: [Vector<3>; 2], radius: f64, color: Color, out: &mut Vec<Seen>) {
        self.ball(&from, radius, color, out);
        self.ball(&to, radius, color, out);
        let along = direction(&(to - from));
        let length = (to - from).norm();
        let pieces = (length / (4.0 * radius)).ceil().clamp(1.0, 64.0) as usize;
        for k in 0..pieces {
            let at = |k: usize| from + along * (length * k as f64 / pieces as f64);
            let (begin, end) = (at(k), at(k + 1));
            let middle = (begin + end) * 0.5;
            let distance = self.eye.distance(&middle);
            let side = direction(&along.cross(&(self.eye.place - middle)));
            let front = side.cross(&along);
            let normal = |angle: f64| front * angle.cos() + side * angle.sin();
            for band in 0..BANDS {
                let angle = |band: f64| band / BANDS as f64 * PI - FRAC_PI_2;
                let [left, right] =
                    [band, band + 1].map(|band| normal(angle(band as f64)) * radius);
                let corners = [begin + left, end + left, end + right, begin + right];
                if let Some(corners) = self.polygon(corners.into_iter()) {
                    let lit = normal(angle(band as f64 + 0.5));
                    let color = self.lit(color, &lit, distance);
                    out.push(Seen {
                        distance,
                        mark: filled(Path::polygon(widened(corners)), color),
                    });
                }
            }
        }
    }

    fn face(&self, corners: &[Vector<3>], thin: bool, color: Color, out: &mut Vec<Seen>) {
        let center = crate::math::mean(corners);
        // Three corners may lie on a line, all of them do not.
        let way = |k: usize| corners[k % corners.len()] - center;
        let around = (0..corners.len()).map(|k| way(k).cross(&way(k + 1)));
        let mut normal = direction(&around.sum());
        if normal.dot(&(self.eye.place - center)) < 0.0 {
            if !thin {
                return;
            }
            normal = -normal;
        }
        if let Some(corners) = self.polygon(corners.iter().copied()) {
            let distance = self.eye.distance(&center);
            let color = self.lit(color, &normal, distance);
            out.push(Seen {
                distance,
                mark: filled(Path::polygon(widened(corners)), color),
            });
        }
    }

    /// The part of the surface of a half-space that lies in the box of the scene; nothing where it
    /// is seen from within the solid. All else is before it.
    fn surface(&self, pose: &Pose<3>, normal: &Vector<3>, color: Color, out: &mut Vec<Seen>) {
        let normal = pose.vector_to_world(normal);
        let at = pose.translation;
        if normal.dot(&(self.eye.place - at)) <= 0.0 {
            return;
        }
        let [first, second] = plane_across(&normal);
        let middle = (self.bounds.0 + self.bounds.1) * 0.5;
        let foot = middle - normal * normal.dot(&(middle - at));
        let far = 4.0 * self.eye.radius;
        let square = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let mut corners: Vec<Vector<3>> = square
            .iter()
            .map(|[x, y]| foot + (first * *x + second * *y) * far)
            .collect();
        for d in 0..3 {
            let axis = crate::math::axis::<3>(d);
            // The box has faces of which this may be one.
            let slack = 1e-6 * self.eye.radius;
            corners = super::faces::half(&corners, &axis, self.bounds.1[d] + slack);
            corners = super::faces::half(&corners, &-axis, -self.bounds.0[d] + slack);
        }
        if let Some(corners) = self.polygon(corners.into_iter()) {
            let color = self.lit(color, &normal, DISTANCE * self.eye.radius);
            out.push(Seen {
                distance: f64::INFINITY,
                mark: filled(Path::polygon(corners), color.opacity(0.45)),
            });
        }
    }

    /// A polygon on the ground, below these points.
    fn cast(&self, points: impl Iterator<Item = [f64; 2]>, shadows: &mut Path) {
        let place = |[x, y]: [f64; 2]| Vector::<3>::new(x, y, self.ground);
        let corners = self.polygon(hull(points.collect()).into_iter().map(place));
        if let Some(corners) = corners
            && corners.len() > 2
        {
            shadows.segments.extend(Path::polygon(corners).segments);
        }
    }
}

/// A colour under more or less light: at 0.6 its own, darker below, lighter above.
fn shade(color: Color, light: f64) -> Color {
    let black = Color::hex(0x000000).opacity(color.opacity);
    let white = Color::hex(0xffffff).opacity(color.opacity);
    match light < 0.6 {
        true => color.mix(black, 0.7 * (0.6 - light.max(-0.1))),
        false => color.mix(white, 0.7 * (light - 0.6)),
    }
}

/// A polygon, a third of a pixel wider on all sides, so that no seam shows between neighbours.
fn widened(mut corners: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let count = corners.len() as f64;
    let sum = corners
        .iter()
        .fold([0.0; 2], |[x, y], at| [x + at[0], y + at[1]]);
    let middle = sum.map(|x| x / count);
    for corner in &mut corners {
        let way = [corner[0] - middle[0], corner[1] - middle[1]];
        let length = way[0].hypot(way[1]);
        if length > 0.0 {
            *corner = [0, 1].map(|k| corner[k] + way[k] / length * 0.5);
        }
    }
    corners
}

impl View<3> for Perspective {
    fn see(&self, point: &Vector<3>) -> Option<Sight> {
        let (at, scale) = self.eye.see(point)?;
        Some(Sight {
            at,
            distance: self.eye.distance(point),
            scale,
        })
    }

    fn through_air(&self, color: Color, distance: f64) -> Color {
        // From the nearest point of the ball about the scene to the farthest.
        let nearest = (DISTANCE - 1.0) * self.eye.radius;
        let share = (distance - nearest) / (2.0 * self.eye.radius);
        let page = self.page.opacity(color.opacity);
        color.mix(page, HAZE * share.clamp(0.0, 1.0))
    }

    fn form(&self, form: &Form<3>, pose: &Pose<3>, color: Color, out: &mut Vec<Seen>) {
        let world = |point: &Vector<3>| pose.point_to_world(point);
        match form {
            Form::Ball(radius) => self.ball(&pose.translation, *radius, color, out),
            Form::Rod { ends, radius } => {
                self.rod(ends.map(|end| world(&end)), *radius, color, out)
            }
            Form::Ground(normal) => self.surface(pose, normal, color, out),
            Form::Line(ends) => {
                self.lines(
                    &[ends.map(|end| world(&end))],
                    &Stroke::new(color, 2.0),
                    out,
                );
            }
            Form::Faces { faces, thin } => {
                for face in faces {
                    let corners: Vec<Vector<3>> = face.iter().map(world).collect();
                    self.face(&corners, *thin, color, out);
                }
            }
        }
    }

    fn lines(&self, lines: &[[Vector<3>; 2]], stroke: &Stroke, out: &mut Vec<Seen>) {
        for [from, to] in lines {
            if let Some(ends) = self.polygon([*from, *to].into_iter()) {
                let distance = self.eye.distance(&((from + to) * 0.5));
                let stroke = Stroke {
                    color: self.through_air(stroke.color, distance),
                    ..stroke.clone()
                };
                out.push(Seen {
                    distance,
                    mark: stroked(Path::polyline(ends), stroke),
                });
            }
        }
    }

    fn grid(&self, apart: f64, color: Color, out: &mut Vec<Seen>) {
        let (min, max) = self.bounds;
        // Where lines cross, and the edges of the scene.
        let stops = |k: usize| {
            let (first, last) = ((min[k] / apart).ceil(), (max[k] / apart).floor());
            let count = (last - first).max(-1.0) as usize + 1;
            let inner = (0..count).map(|number| (first + number as f64) * apart);
            let mut stops: Vec<f64> = inner.collect();
            stops.insert(0, min[k]);
            stops.push(max[k]);
            stops
        };
        let (across, along) = (stops(0), stops(1));
        let place = |x: f64, y: f64| Vector::<3>::new(x, y, self.ground);
        // In pieces, so that each fades by its own distance.
        let mut pieces = Vec::new();
        for &x in &across {
            pieces.extend(along.windows(2).map(|y| [place(x, y[0]), place(x, y[1])]));
        }
        for &y in &along {
            pieces.extend(across.windows(2).map(|x| [place(x[0], y), place(x[1], y)]));
        }
        self.lines(&pieces, &Stroke::new(color, 1.0), out);
    }

    fn shadow(&self, form: &Form<3>, pose: &Pose<3>, shadows: &mut Path) {
        if self.eye.place.z <= self.ground {
            return;
        }
        let flat = |point: &Vector<3>| {
            let place = pose.point_to_world(point);
            [place.x, place.y]
        };
        let ring = |center: [f64; 2], radius: f64| {
            (0..24).map(move |k| {
                let (sin, cos) = (f64::from(k) / 24.0 * TAU).sin_cos();
                [center[0] + radius * cos, center[1] + radius * sin]
            })
        };
        match form {
            Form::Ball(radius) => self.cast(ring(flat(&Vector::zeros()), *radius), shadows),
            Form::Rod { ends, radius } => {
                let rings = ends.iter().flat_map(|end| ring(flat(end), *radius));
                self.cast(rings, shadows);
            }
            Form::Ground(_) | Form::Line(_) | Form::Faces { thin: true, .. } => {}
            Form::Faces { faces, thin: false } => {
                self.cast(faces.iter().flatten().map(flat), shadows);
            }
        }
    }

    fn sides(&self) -> [f64; 2] {
        self.eye.sides
    }

    fn scale(&self) -> f64 {
        self.eye.scale()
    }
}
