//! Marks, painted on pixels.

use tiny_skia as skia;

use super::letters;
use super::round::{Ink, Sheet, WIDEST};
use crate::picture::sound::{near, seen, share};
use crate::picture::{Anchor, Color, Label, Mark, Paint, Path, Segment, Stroke, text};

/// The most dashes and gaps of a line: more than any page has room for.
const MOST_DASHES: f32 = 50_000.0;

/// Shades of a disk from its inner to its outer colour.
const STEPS: usize = 64;

/// Paints marks on a map of pixels.
pub(super) struct Brush<'a> {
    map: &'a mut skia::Pixmap,
    /// Where the origin of the marks is.
    origin: skia::Transform,
    /// Room for lines.
    room: Vec<u8>,
}

impl<'a> Brush<'a> {
    pub(super) fn new(map: &'a mut skia::Pixmap) -> Self {
        Self {
            map,
            origin: skia::Transform::identity(),
            room: Vec::new(),
        }
    }

    pub(super) fn marks(&mut self, marks: &[Mark]) {
        for mark in marks.iter().filter(|mark| mark.drawable()) {
            match mark {
                Mark::Path { path, fill, stroke } => {
                    let (fill, stroke) = seen(fill, stroke);
                    self.path(path, fill, stroke);
                }
                Mark::Disk {
                    center,
                    radius,
                    fill,
                    stroke,
                } => {
                    let (fill, stroke) = seen(fill, stroke);
                    self.disk(*center, near(*radius) as f32, fill, stroke);
                }
                Mark::Label(label) => self.label(label),
                Mark::Group {
                    corner,
                    size,
                    background,
                    marks,
                } => self.group(*corner, *size, *background, marks),
            }
        }
    }

    fn path(&mut self, path: &Path, fill: Option<&Paint>, stroke: Option<&Stroke>) {
        let line = stroke.filter(|stroke| thin(stroke));
        let line = line.and_then(|stroke| Some((stroke, straight(path)?)));
        let other = stroke.filter(|_| line.is_none());
        if (fill.is_some() || other.is_some())
            && let Some(area) = outline(path)
        {
            if let Some(paint) = fill.and_then(paint) {
                let rule = skia::FillRule::Winding;
                self.map.fill_path(&area, &paint, rule, self.origin, None);
            }
            if let Some(stroke) = other {
                self.stroke(&area, stroke);
            }
        }
        if let Some((stroke, parts)) = line {
            let ink = ink(color(stroke.color));
            for part in parts {
                let part: Vec<_> = part.iter().map(|point| self.place(*point)).collect();
                self.sheet().line(&part, stroke.width as f32, ink);
            }
        }
    }

    fn stroke(&mut self, path: &skia::Path, stroke: &Stroke) {
        let line = skia::Stroke {
            width: near(stroke.width) as f32,
            line_cap: skia::LineCap::Round,
            line_join: skia::LineJoin::Round,
            dash: dashes(stroke, path),
            ..skia::Stroke::default()
        };
        let paint = flat(stroke.color);
        self.map.stroke_path(path, &paint, &line, self.origin, None);
    }

    fn disk(
        &mut self,
        center: [f64; 2],
        radius: f32,
        fill: Option<&Paint>,
        stroke: Option<&Stroke>,
    ) {
        let place = self.place(center);
        match fill {
            None => {}
            Some(Paint::Flat(flat)) => {
                let ink = ink(color(*flat));
                self.sheet().ring(place, 0.0, radius, |_| ink);
            }
            Some(Paint::Radial {
                center,
                radius: reach,
                inner,
                outer,
            }) => {
                let [x, y] = self.place(*center);
                let inks: Vec<Ink> = (0..=STEPS)
                    .map(|k| ink(color(inner.mix(*outer, k as f64 / STEPS as f64))))
                    .collect();
                let scale = STEPS as f32 / near(*reach) as f32;
                self.sheet().ring(place, 0.0, radius, |at| {
                    let distance = ((at[0] - x).powi(2) + (at[1] - y).powi(2)).sqrt();
                    inks[((distance * scale + 0.5) as usize).min(STEPS)]
                });
            }
        }
        match stroke {
            Some(stroke) if stroke.pattern().is_empty() => {
                let (half, ink) = (near(stroke.width) as f32 / 2.0, ink(color(stroke.color)));
                self.sheet()
                    .ring(place, radius - half, radius + half, |_| ink);
            }
            Some(stroke) => {
                let [x, y] = center.map(|x| near(x) as f32);
                if let Some(circle) = skia::PathBuilder::from_circle(x, y, radius) {
                    self.stroke(&circle, stroke);
                }
            }
            None => {}
        }
    }

    /// Where a point lies on the map.
    fn place(&self, [x, y]: [f64; 2]) -> [f32; 2] {
        let [left, top] = [self.origin.tx, self.origin.ty];
        [near(x) as f32 + left, near(y) as f32 + top]
    }

    fn sheet(&mut self) -> Sheet<'_> {
        let width = self.map.width() as usize;
        let (pixels, _) = self.map.data_mut().as_chunks_mut::<4>();
        Sheet {
            pixels,
            width,
            room: &mut self.room,
        }
    }

    fn label(&mut self, label: &Label) {
        let Some(letters) = letters::outline(&label.text, near(label.size), label.bold) else {
            return;
        };
        let width = text::width(&label.text, label.size, label.bold);
        let back = match label.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => width / 2.0,
            Anchor::End => width,
        };
        let [x, y] = label.at.map(|x| near(x) as f32);
        let mut place = self.origin.pre_translate(x, y);
        if label.upwards {
            place = place.pre_concat(skia::Transform::from_row(0.0, -1.0, 1.0, 0.0, 0.0, 0.0));
        }
        place = place.pre_translate(-near(back) as f32, 0.0);
        let (paint, rule) = (flat(label.color), skia::FillRule::Winding);
        self.map.fill_path(&letters, &paint, rule, place, None);
    }

    /// Cuts the rectangle out, paints on it, and puts it back: nothing is painted outside, and
    /// no pixel pays for a mask.
    fn group(
        &mut self,
        corner: [f64; 2],
        size: [f64; 2],
        background: Option<Color>,
        marks: &[Mark],
    ) {
        let [x, y] = corner.map(near);
        let [left, top] = [x as f32 + self.origin.tx, y as f32 + self.origin.ty];
        let [right, bottom] = [left + near(size[0]) as f32, top + near(size[1]) as f32];
        let [left, top, right, bottom] = [left, top, right, bottom].map(|x| x.round() as i32);
        let page = self.map.as_ref();
        let (wide, high) = (page.width() as i32, page.height() as i32);
        let (from, to) = (
            [left.clamp(0, wide), top.clamp(0, high)],
            [right.clamp(0, wide), bottom.clamp(0, high)],
        );
        let cut = skia::IntRect::from_ltrb(from[0], from[1], to[0], to[1]);
        let Some(mut part) = cut.and_then(|cut| page.clone_rect(cut)) else {
            return;
        };
        if let Some(color) = background.filter(|color| color.seen()) {
            let whole = skia::Rect::from_xywh(0.0, 0.0, part.width() as f32, part.height() as f32);
            if let Some(whole) = whole {
                let identity = skia::Transform::identity();
                part.fill_rect(whole, &flat(color), identity, None);
            }
        }
        let origin = self.origin.pre_translate(x as f32, y as f32);
        Brush {
            map: &mut part,
            origin: origin.post_translate(-from[0] as f32, -from[1] as f32),
            room: Vec::new(),
        }
        .marks(marks);
        let (row, wide) = (4 * part.width() as usize, 4 * wide as usize);
        let start = from[1] as usize * wide + 4 * from[0] as usize;
        let rows = self.map.data_mut()[start..].chunks_mut(wide);
        for (target, source) in rows.zip(part.data().chunks(row)) {
            target[..row].copy_from_slice(source);
        }
    }
}

/// Whether a line can be painted by distance.
fn thin(stroke: &Stroke) -> bool {
    stroke.width <= f64::from(WIDEST) && stroke.pattern().is_empty()
}

/// The parts of a path that is straight from point to point; nothing for one that is not.
fn straight(path: &Path) -> Option<Vec<Vec<[f64; 2]>>> {
    let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
    for segment in &path.segments {
        match (*segment, parts.last_mut()) {
            (Segment::Cubic(..), _) => return None,
            (Segment::Line(point), Some(part)) => part.push(point),
            (Segment::Close, Some(part)) => part.push(part[0]),
            (Segment::Move(point) | Segment::Line(point), _) => parts.push(vec![point]),
            (Segment::Close, None) => {}
        }
    }
    Some(parts)
}

/// A path as the painter has it; nothing where it has no extent.
fn outline(path: &Path) -> Option<skia::Path> {
    let count = path.segments.len();
    let mut builder = skia::PathBuilder::with_capacity(count, count);
    let place = |[x, y]: [f64; 2]| (near(x) as f32, near(y) as f32);
    for segment in &path.segments {
        match *segment {
            Segment::Move(point) => {
                let (x, y) = place(point);
                builder.move_to(x, y);
            }
            Segment::Line(point) => {
                let (x, y) = place(point);
                builder.line_to(x, y);
            }
            Segment::Cubic(first, second, end) => {
                let ((x1, y1), (x2, y2), (x, y)) = (place(first), place(second), place(end));
                builder.cubic_to(x1, y1, x2, y2, x, y);
            }
            Segment::Close => builder.close(),
        }
    }
    builder.finish()
}

/// A colour as the painter has it.
pub(super) fn color(color: Color) -> skia::Color {
    let [red, green, blue] = color.rgb;
    let opacity = (share(color.opacity) * 255.0).round() as u8;
    skia::Color::from_rgba8(red, green, blue, opacity)
}

fn ink(color: skia::Color) -> Ink {
    let color = color.premultiply().to_color_u8();
    [color.red(), color.green(), color.blue(), color.alpha()]
}

fn flat(paint: Color) -> skia::Paint<'static> {
    skia::Paint {
        shader: skia::Shader::SolidColor(color(paint)),
        ..skia::Paint::default()
    }
}

fn paint(paint: &Paint) -> Option<skia::Paint<'static>> {
    match paint {
        Paint::Flat(color) => Some(flat(*color)),
        Paint::Radial {
            center,
            radius,
            inner,
            outer,
        } => {
            let [x, y] = center.map(|x| near(x) as f32);
            let middle = skia::Point::from_xy(x, y);
            let shader = skia::RadialGradient::new(
                middle,
                0.0,
                middle,
                near(*radius) as f32,
                vec![
                    skia::GradientStop::new(0.0, color(*inner)),
                    skia::GradientStop::new(1.0, color(*outer)),
                ],
                skia::SpreadMode::Pad,
                skia::Transform::identity(),
            )?;
            Some(skia::Paint {
                shader,
                ..skia::Paint::default()
            })
        }
    }
}

/// The dashes of a line; none where they would be so many that it is better drawn without gaps.
fn dashes(stroke: &Stroke, path: &skia::Path) -> Option<skia::StrokeDash> {
    let lengths: Vec<f32> = stroke.pattern().iter().map(|x| near(*x) as f32).collect();
    let steps = path
        .points()
        .windows(2)
        .map(|pair| pair[0].distance(pair[1]));
    let most = MOST_DASHES * lengths.iter().sum::<f32>() / lengths.len() as f32;
    (steps.sum::<f32>() < most).then(|| skia::StrokeDash::new(lengths, 0.0))?
}
