//! Pictures as SVG.

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use super::sound::{near, seen, share};
use super::{Anchor, Color, Label, Mark, Paint, Path, Picture, Segment, Stroke, text};

impl Picture {
    /// The picture as an SVG document. Text stays text, in DejaVu Sans where the viewer has it;
    /// numbers have two decimals at most. The same picture always gives the same bytes, and the
    /// names of gradients follow from what they are, so that documents can be put into one page
    /// of HTML.
    ///
    /// Marks with a coordinate that is not finite are left out.
    pub fn svg(&self) -> String {
        let mut body = Body::default();
        let [width, height] = self.size.map(|side| side.max(0.0));
        if self.background.seen() {
            let cover = Attributes(&self.background, "fill");
            let _ = write!(
                body.text,
                r#"<rect width="{}" height="{}"{cover}/>"#,
                Number(width),
                Number(height)
            );
        }
        body.marks(&self.marks);
        let gradients: String = body.gradients.into_values().collect();
        let defs = match gradients.is_empty() {
            true => String::new(),
            false => format!("<defs>{gradients}</defs>"),
        };
        // What most marks share stands here once.
        format!(
            concat!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" role="img" width="{w}" height="{h}" "#,
                r#"viewBox="0 0 {w} {h}" font-family="{family}, Verdana, sans-serif" fill="none" "#,
                r#"stroke-linecap="round" stroke-linejoin="round"><title>{title}</title>"#,
                "{defs}{body}</svg>\n"
            ),
            w = Number(width),
            h = Number(height),
            family = text::FAMILY,
            title = Escaped(&self.title),
            defs = defs,
            body = body.text,
        )
    }
}

/// The marks written so far, and the gradients that they need, by name.
#[derive(Default)]
struct Body {
    text: String,
    gradients: BTreeMap<String, String>,
}

impl Body {
    // Writing to a string cannot fail, here and below.

    fn marks(&mut self, marks: &[Mark]) {
        for mark in marks.iter().filter(|mark| mark.drawable()) {
            match mark {
                Mark::Path { path, fill, stroke } => {
                    let _ = write!(self.text, r#"<path d="{}""#, Data(path));
                    self.style(fill, stroke, None);
                }
                Mark::Disk {
                    center: [x, y],
                    radius,
                    fill,
                    stroke,
                } => {
                    let _ = write!(
                        self.text,
                        r#"<circle cx="{}" cy="{}" r="{}""#,
                        Number(*x),
                        Number(*y),
                        Number(*radius)
                    );
                    self.style(fill, stroke, Some(([*x, *y], *radius)));
                }
                Mark::Label(label) => self.label(label),
                Mark::Group {
                    corner: [x, y],
                    size: [width, height],
                    background,
                    marks,
                } => {
                    let (width, height) = (Number(*width), Number(*height));
                    let _ = write!(
                        self.text,
                        r#"<svg x="{}" y="{}" width="{width}" height="{height}">"#,
                        Number(*x),
                        Number(*y),
                    );
                    if let Some(color) = background.filter(|color| color.seen()) {
                        let cover = Attributes(&color, "fill");
                        let _ = write!(
                            self.text,
                            r#"<rect width="{width}" height="{height}"{cover}/>"#
                        );
                    }
                    self.marks(marks);
                    self.text.push_str("</svg>");
                }
            }
        }
    }

    /// Fill and stroke, and the end of the element; `disk` is the centre and radius of one.
    fn style(
        &mut self,
        fill: &Option<Paint>,
        stroke: &Option<Stroke>,
        disk: Option<([f64; 2], f64)>,
    ) {
        let (fill, stroke) = seen(fill, stroke);
        match fill {
            Some(Paint::Flat(color)) => {
                let _ = write!(self.text, "{}", Attributes(color, "fill"));
            }
            Some(Paint::Radial {
                center,
                radius,
                inner,
                outer,
            }) => {
                let name = self.gradient(*center, *radius, [inner, outer], disk);
                let _ = write!(self.text, r#" fill="url(#{name})""#);
            }
            None => {}
        }
        if let Some(stroke) = stroke {
            let _ = write!(self.text, "{}", Attributes(&stroke.color, "stroke"));
            if stroke.width != 1.0 {
                let _ = write!(self.text, r#" stroke-width="{}""#, Number(stroke.width));
            }
            let dashes = stroke.pattern();
            if !dashes.is_empty() {
                let dashes: Vec<String> = dashes.iter().map(|x| Number(*x).to_string()).collect();
                let _ = write!(self.text, r#" stroke-dasharray="{}""#, dashes.join(" "));
            }
        }
        self.text.push_str("/>");
    }

    /// The name of a gradient. That of a disk is told in shares of the disk, so that disks which
    /// look the same share it.
    fn gradient(
        &mut self,
        center: [f64; 2],
        radius: f64,
        colors: [&Color; 2],
        disk: Option<([f64; 2], f64)>,
    ) -> String {
        let (place, units) = match disk {
            Some(([x, y], size)) => (
                [
                    (center[0] - x) / (2.0 * size) + 0.5,
                    (center[1] - y) / (2.0 * size) + 0.5,
                    radius / (2.0 * size),
                ],
                "",
            ),
            None => (
                [center[0], center[1], radius],
                r#" gradientUnits="userSpaceOnUse""#,
            ),
        };
        let [x, y, radius] = place.map(Number);
        let [from, to] = colors.map(|color| (color, Number(share(color.opacity))));
        let name = format!(
            "{}_{x}_{y}_{radius}_{}_{}_{}_{}",
            if disk.is_some() { "disk" } else { "page" },
            &from.0.to_string()[1..],
            from.1,
            &to.0.to_string()[1..],
            to.1,
        );
        self.gradients.entry(name.clone()).or_insert_with(|| {
            format!(
                concat!(
                    r#"<radialGradient id="{name}" cx="{x}" cy="{y}" r="{radius}"{units}>"#,
                    r#"<stop{inner}/><stop offset="1"{outer}/></radialGradient>"#
                ),
                name = name,
                x = x,
                y = y,
                radius = radius,
                units = units,
                inner = Attributes(colors[0], "stop"),
                outer = Attributes(colors[1], "stop"),
            )
        });
        name
    }

    fn label(&mut self, label: &Label) {
        let [x, y] = label.at.map(Number);
        let _ = write!(
            self.text,
            r#"<text x="{x}" y="{y}" font-size="{}"{}"#,
            Number(label.size),
            Attributes(&label.color, "fill")
        );
        self.text.push_str(match label.anchor {
            Anchor::Start => "",
            Anchor::Middle => r#" text-anchor="middle""#,
            Anchor::End => r#" text-anchor="end""#,
        });
        if label.bold {
            self.text.push_str(r#" font-weight="bold""#);
        }
        if label.upwards {
            let _ = write!(self.text, r#" transform="rotate(-90 {x} {y})""#);
        }
        let _ = write!(self.text, ">{}</text>", Escaped(&label.text));
    }
}

/// A colour as the value of `fill`, `stroke` or `stop`, with its opacity where that is not 1.
struct Attributes<'a>(&'a Color, &'static str);

impl fmt::Display for Attributes<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(color, what) = self;
        let name = if *what == "stop" { "stop-color" } else { what };
        write!(f, r#" {name}="{color}""#)?;
        let opacity = share(color.opacity);
        if opacity < 1.0 {
            write!(f, r#" {what}-opacity="{}""#, Number(opacity))?;
        }
        Ok(())
    }
}

/// A path as SVG has it.
struct Data<'a>(&'a Path);

impl fmt::Display for Data<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A letter holds on until the next one: "L1 2 3 4" are two lines.
        let mut last = None;
        for segment in &self.0.segments {
            let (letter, points): (_, &[[f64; 2]]) = match segment {
                Segment::Move(point) => ('M', &[*point]),
                Segment::Line(point) => ('L', &[*point]),
                Segment::Cubic(first, second, end) => ('C', &[*first, *second, *end]),
                Segment::Close => ('Z', &[]),
            };
            let mut gap = "";
            if letter == 'M' || letter == 'Z' || last != Some(letter) {
                f.write_char(letter)?;
            } else {
                gap = " ";
            }
            last = Some(letter);
            for point in points {
                let [x, y] = point.map(Number);
                write!(f, "{gap}{x} {y}")?;
                gap = " ";
            }
        }
        Ok(())
    }
}

/// A number with two decimals at most.
#[derive(Clone, Copy)]
struct Number(f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:.2}", near(self.0));
        let short = text.trim_end_matches('0').trim_end_matches('.');
        f.write_str(if short == "-0" { "0" } else { short })
    }
}

/// Text without what means something to XML, and without what it cannot hold.
struct Escaped<'a>(&'a str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for letter in self.0.chars() {
            match letter {
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '&' => f.write_str("&amp;")?,
                '\t' | '\n' | '\r' => f.write_char(' ')?,
                '\u{fffe}' | '\u{ffff}' => f.write_char(char::REPLACEMENT_CHARACTER)?,
                _ if letter.is_control() => f.write_char(char::REPLACEMENT_CHARACTER)?,
                _ => f.write_char(letter)?,
            }
        }
        Ok(())
    }
}
