//! How a world is put on a page: points, lines and shapes, whatever the dimension.

use std::fmt::Debug;

use crate::math::Vector;
use crate::picture::{Color, Mark, Path, Stroke, Theme};
use crate::render::Camera;
use crate::shape::{Bounds, Geometry, In, Pose, Shape};

/// A way of looking at a world of `D` dimensions.
pub trait View<const D: usize>: Debug + Send + Sync {
    /// Where on the page a point of the world is seen; nothing where it is behind the eye.
    fn see(&self, point: &Vector<D>) -> Option<Sight>;

    /// The colour that something of this colour has from this distance.
    fn through_air(&self, color: Color, distance: f64) -> Color;

    /// Draws a form that stands at `pose`.
    fn form(&self, form: &Form<D>, pose: &Pose<D>, color: Color, out: &mut Vec<Seen>);

    /// Draws straight lines from point to point, of this width in pixels.
    fn lines(&self, lines: &[[Vector<D>; 2]], stroke: &Stroke, out: &mut Vec<Seen>);

    /// Draws lines a length apart: over what is seen of the plane, or on the ground.
    fn grid(&self, apart: f64, color: Color, out: &mut Vec<Seen>);

    /// Draws the shadow of a form that stands at `pose`: the part of a path that it covers.
    fn shadow(&self, form: &Form<D>, pose: &Pose<D>, shadows: &mut Path);

    /// Width and height of what is to be seen, in any unit: a page of the same ratio has no
    /// empty margin.
    fn sides(&self) -> [f64; 2];

    /// Pixels per length: of the plane, or in the middle of what is seen.
    fn scale(&self) -> f64;
}

/// Where a point is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// Its place on the page, in pixels.
    pub at: [f64; 2],
    /// Its distance from the eye; 0 in the plane.
    pub distance: f64,
    /// Pixels per length there, across the line of sight.
    pub scale: f64,
}

/// A mark, and how far away what it shows is: what is nearer covers it.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// Distance from the eye; 0 in the plane.
    pub distance: f64,
    /// The mark.
    pub mark: Mark,
}

/// A shape, made ready for drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Form<const D: usize> {
    /// A ball of this radius.
    Ball(f64),
    /// All points within a radius of a segment.
    Rod {
        /// The ends of the segment.
        ends: [Vector<D>; 2],
        /// The radius.
        radius: f64,
    },
    /// What lies behind the plane through the origin with this normal.
    Ground(Vector<D>),
    /// A line between two points.
    Line([Vector<D>; 2]),
    /// Flat polygons: in the plane one, its corners in order; in space faces, their corners
    /// counter-clockwise seen from outside.
    Faces {
        /// The corners of each.
        faces: Vec<Vec<Vector<D>>>,
        /// Whether they are seen from both sides.
        thin: bool,
    },
}

/// What a view is to show, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Framing<const D: usize> {
    /// The box that is to be seen.
    pub bounds: Bounds<D>,
    /// Width and height of the page, in pixels.
    pub size: [f64; 2],
    /// The colours; what is far away fades into the page.
    pub theme: Theme,
    /// In space: where the eye is.
    pub camera: Camera,
    /// In space: height of the ground.
    pub ground: f64,
}

/// How worlds of `D` dimensions are seen; [`In<2>`] from above, [`In<3>`] in perspective.
pub trait Eye<const D: usize>: Geometry<D> {
    /// A view that shows all of what is to be seen.
    fn view(framing: &Framing<D>) -> Box<dyn View<D>>;

    /// A shape made ready, its faces in pieces no wider than `piece`.
    fn form(shape: &Shape<D>, piece: f64) -> Form<D>;
}

impl Eye<2> for In<2> {
    fn view(framing: &Framing<2>) -> Box<dyn View<2>> {
        Box::new(super::plane::Above::new(framing))
    }

    fn form(shape: &Shape<2>, _piece: f64) -> Form<2> {
        super::plane::form(shape)
    }
}

impl Eye<3> for In<3> {
    fn view(framing: &Framing<3>) -> Box<dyn View<3>> {
        Box::new(super::space::Perspective::new(framing))
    }

    fn form(shape: &Shape<3>, piece: f64) -> Form<3> {
        super::space::form(shape, piece)
    }
}

/// What is seen, gathered mark by mark.
pub(super) struct Canvas<'a, const D: usize> {
    pub(super) view: &'a dyn View<D>,
    pub(super) seen: Vec<Seen>,
}

impl<'a, const D: usize> Canvas<'a, D> {
    pub(super) fn new(view: &'a dyn View<D>) -> Self {
        Self {
            view,
            seen: Vec::new(),
        }
    }

    /// Adds a mark that stands at a point of the world, `nearer` to the eye than that.
    pub(super) fn mark_at(
        &mut self,
        point: &Vector<D>,
        nearer: f64,
        mark: impl FnOnce(Sight) -> Option<Mark>,
    ) {
        let Some(sight) = self.view.see(point) else {
            return;
        };
        if let Some(mark) = mark(sight) {
            let distance = sight.distance - nearer;
            self.seen.push(Seen { distance, mark });
        }
    }

    pub(super) fn form(&mut self, form: &Form<D>, pose: &Pose<D>, color: Color) {
        self.view.form(form, pose, color, &mut self.seen);
    }

    pub(super) fn lines(&mut self, lines: &[[Vector<D>; 2]], stroke: &Stroke) {
        if !lines.is_empty() {
            self.view.lines(lines, stroke, &mut self.seen);
        }
    }

    /// Adds a mark behind everything.
    pub(super) fn behind(&mut self, mark: Mark) {
        let distance = f64::INFINITY;
        self.seen.push(Seen { distance, mark });
    }

    /// An arrow over the page, its head as long as told in pixels.
    pub(super) fn arrow(&mut self, from: &Vector<D>, to: &Vector<D>, stroke: &Stroke, head: f64) {
        let (Some(tail), Some(tip)) = (self.view.see(from), self.view.see(to)) else {
            return;
        };
        let way = [tip.at[0] - tail.at[0], tip.at[1] - tail.at[1]];
        let length = way[0].hypot(way[1]);
        if length < 1.0 {
            return;
        }
        let head = head.min(0.6 * length);
        let unit = way.map(|x| x / length);
        let barb = |side: f64| {
            let [x, y] = unit;
            let across = 0.45 * side;
            [
                tip.at[0] - head * (x - across * y),
                tip.at[1] - head * (y + across * x),
            ]
        };
        let mut path = Path::polyline([tail.at, tip.at]);
        path.begin(barb(1.0));
        path.line(tip.at);
        path.line(barb(-1.0));
        let distance = tail.distance.min(tip.distance);
        let color = self.view.through_air(stroke.color, distance);
        self.seen.push(Seen {
            distance,
            mark: stroked(
                path,
                Stroke {
                    color,
                    ..stroke.clone()
                },
            ),
        });
    }

    /// The marks, those further away first.
    pub(super) fn finish(mut self) -> Vec<Mark> {
        self.seen.sort_by(|a, b| b.distance.total_cmp(&a.distance));
        self.seen.into_iter().map(|seen| seen.mark).collect()
    }
}

/// A line drawn.
pub(super) fn stroked(path: Path, stroke: Stroke) -> Mark {
    Mark::Path {
        path,
        fill: None,
        stroke: Some(stroke),
    }
}

/// An area filled.
pub(super) fn filled(path: Path, color: Color) -> Mark {
    Mark::Path {
        path,
        fill: Some(crate::picture::Paint::Flat(color)),
        stroke: None,
    }
}

/// A disk filled.
pub(super) fn disk(center: [f64; 2], radius: f64, color: Color) -> Mark {
    Mark::Disk {
        center,
        radius,
        fill: Some(crate::picture::Paint::Flat(color)),
        stroke: None,
    }
}

/// A circle drawn.
pub(super) fn circle(center: [f64; 2], radius: f64, stroke: Stroke) -> Mark {
    Mark::Disk {
        center,
        radius,
        fill: None,
        stroke: Some(stroke),
    }
}
