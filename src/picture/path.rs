//! Paths: lines and curves, open or closed.

/// A piece of a path; points are in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Segment {
    /// Begins a new part here.
    Move([f64; 2]),
    /// A straight line to here.
    Line([f64; 2]),
    /// A cubic Bézier curve: two control points and where it ends.
    Cubic([f64; 2], [f64; 2], [f64; 2]),
    /// A straight line to where the part began.
    Close,
}

/// Lines and curves; made by calls in a row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Path {
    /// Its pieces, in order.
    pub segments: Vec<Segment>,
}

impl Path {
    /// A path without any piece.
    pub fn new() -> Self {
        Self::default()
    }

    /// Lines from point to point.
    pub fn polyline(points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let mut path = Self::new();
        for point in points {
            match path.segments.is_empty() {
                true => path.begin(point),
                false => path.line(point),
            }
        }
        path
    }

    /// The area within these corners.
    pub fn polygon(corners: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let mut path = Self::polyline(corners);
        path.close();
        path
    }

    /// The rectangle with this upper left corner and this width and height.
    pub fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Self {
        let (right, bottom) = (x + width, y + height);
        Self::polygon([[x, y], [right, y], [right, bottom], [x, bottom]])
    }

    /// Begins a new part at this point.
    pub fn begin(&mut self, point: [f64; 2]) {
        self.segments.push(Segment::Move(point));
    }

    /// Goes on straight to this point.
    pub fn line(&mut self, point: [f64; 2]) {
        self.segments.push(Segment::Line(point));
    }

    /// Goes on to `end` along a cubic Bézier curve with these control points.
    pub fn cubic(&mut self, first: [f64; 2], second: [f64; 2], end: [f64; 2]) {
        self.segments.push(Segment::Cubic(first, second, end));
    }

    /// Goes back to where this part began.
    pub fn close(&mut self) {
        self.segments.push(Segment::Close);
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }
}
