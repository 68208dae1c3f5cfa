//! Draws some moments of a 2-D trace side by side in one SVG picture.
//!
//! ```sh
//! volary run olfati-saber-2003/six-obstacles --set record.edges=true --trace run.jsonl
//! cargo run --release --example draw -- run.jsonl picture.svg 0 8.5 17 28
//! ```
//! Bodies and obstacles are drawn at true size, the edges of the proximity net where the trace
//! has them. What moves has the colour of the moment.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;

use volary::math::Vector;
use volary::shape::{Pose, Shape};
use volary::trace::record::Frame;
use volary::trace::{Record, TraceReader};
use volary::world::spec::Rotation;
use volary::world::{AnyWorld, World};

/// Colours that colour-blind people can tell apart (Okabe and Ito).
const COLOURS: [&str; 6] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00",
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [trace, picture, times @ ..] = arguments.as_slice() else {
        return Err("usage: draw TRACE.jsonl PICTURE.svg TIME…".into());
    };
    let times: Vec<f64> = times
        .iter()
        .map(|time| time.parse())
        .collect::<Result<_, _>>()?;
    let mut reader = TraceReader::open(Path::new(trace))?;
    let header = reader.header().clone();
    let AnyWorld::Plane(world) =
        AnyWorld::new(header.name, header.world).map_err(|problems| format!("{problems:?}"))?
    else {
        return Err("only worlds in the plane can be drawn".into());
    };
    let mut frames = Vec::new();
    for record in &mut reader {
        if let Record::Frame(frame) = record? {
            frames.push(frame);
        }
    }
    let nearest = |time: &f64| {
        let distance = |frame: &&Frame| (frame.time - time).abs();
        frames
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let moments: Vec<&Frame> = times.iter().filter_map(nearest).collect();
    std::fs::write(picture, draw(&world, &moments)?)?;
    Ok(())
}

fn draw(world: &World<2>, moments: &[&Frame]) -> Result<String, std::fmt::Error> {
    let points = moments.iter().flat_map(|frame| &frame.positions);
    let parts = |moving: bool| {
        let obstacles = world.obstacles.iter().enumerate();
        let obstacles = obstacles.filter(move |(_, it)| it.motion().is_some() == moving);
        obstacles.flat_map(|(index, obstacle)| obstacle.parts().iter().map(move |it| (index, it)))
    };
    let fixed: Vec<(&Shape<2>, Pose<2>)> = parts(false)
        .map(|(index, part)| (&part.shape, part.world_pose(&world.obstacles[index].pose)))
        .collect();
    let reach = |(shape, pose): &(&Shape<2>, Pose<2>)| {
        let at = pose.translation;
        let (size, center) = match shape {
            Shape::Ball { radius } => (*radius, at),
            _ => (0.0, at),
        };
        [
            vec![center.x - size, center.y - size],
            vec![center.x + size, center.y + size],
        ]
    };
    let places = fixed.iter().flat_map(reach);
    let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in points.cloned().chain(places) {
        for axis in 0..2 {
            min[axis] = min[axis].min(point[axis] - 4.0);
            max[axis] = max[axis].max(point[axis] + 4.0);
        }
    }
    let top = 14.0;
    let (width, height) = (max[0] - min[0], max[1] - min[1] + top);
    let mut svg = String::new();
    writeln!(
        svg,
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="{} {} {width} {height}" width="1200" height="{:.0}" font-family="sans-serif">"#,
        min[0],
        -max[1] - top,
        1200.0 * height / width
    )?;
    writeln!(
        svg,
        r##"<rect x="{}" y="{}" width="100%" height="100%" fill="#ffffff"/>"##,
        min[0],
        -max[1] - top
    )?;
    // The plane's y points up, a picture's down.
    writeln!(svg, r#"<g transform="scale(1,-1)">"#)?;
    for (shape, pose) in &fixed {
        draw_shape(&mut svg, shape, pose, "#777777")?;
    }
    for (frame, colour) in moments.iter().zip(COLOURS.iter().cycle()) {
        let mut edges = String::new();
        for &[i, j] in frame.edges.iter().flatten() {
            let (a, b) = (&frame.positions[i], &frame.positions[j]);
            write!(edges, "M{:.1} {:.1}L{:.1} {:.1}", a[0], a[1], b[0], b[1])?;
        }
        writeln!(
            svg,
            r#"<path d="{edges}" stroke="{colour}" stroke-width="0.25" stroke-opacity="0.6"/>"#
        )?;
        let poses = frame.obstacles.iter().flatten();
        for (obstacle, pose) in poses.map(|it| (it.obstacle, pose(&it.position, &it.rotation))) {
            for part in world.obstacles[obstacle].parts() {
                draw_shape(&mut svg, &part.shape, &part.world_pose(&pose), colour)?;
            }
        }
        for (i, position) in frame.positions.iter().enumerate() {
            let still = Rotation::Angle(0.0);
            let rotation = frame.rotations.as_ref().map_or(&still, |all| &all[i]);
            let shape = world.solids[world.agents.group[i]].shape();
            draw_shape(&mut svg, shape, &pose(position, rotation), colour)?;
        }
    }
    writeln!(svg, "</g>")?;
    for (frame, colour) in moments.iter().zip(COLOURS.iter().cycle()) {
        let mean = frame.positions.iter().map(|p| p[0]).sum::<f64>() / frame.positions.len() as f64;
        writeln!(
            svg,
            r#"<text x="{mean:.1}" y="{}" fill="{colour}" font-size="9" text-anchor="middle">t = {}</text>"#,
            -max[1] - top + 11.0,
            frame.time
        )?;
    }
    writeln!(svg, "</svg>")?;
    Ok(svg)
}

fn pose(position: &[f64], rotation: &Rotation) -> Pose<2> {
    Pose::new([position[0], position[1]].into(), rotation.turn())
}

fn draw_shape(
    svg: &mut String,
    shape: &Shape<2>,
    pose: &Pose<2>,
    colour: &str,
) -> std::fmt::Result {
    /// Farther than any picture reaches.
    const FAR: f64 = 1e4;
    let hull = |points: &[Vector<2>]| -> Vec<Vector<2>> {
        let points: Vec<_> = points.iter().map(|p| [p.x, p.y].into()).collect();
        let corners = parry2d::transformation::convex_hull(&points);
        corners.iter().map(|p| p.to_array().into()).collect()
    };
    let point = |x: f64, y: f64| Vector::<2>::new(x, y);
    let (corners, width) = match shape {
        Shape::Ball { radius } => {
            let at = pose.translation;
            return writeln!(
                svg,
                r#"<circle cx="{:.2}" cy="{:.2}" r="{radius}" fill="{colour}"/>"#,
                at.x, at.y
            );
        }
        Shape::Cuboid { half_extents: half } => {
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let corners = corners.map(|(x, y)| point(x * half.x, y * half.y));
            (corners.to_vec(), 0.0)
        }
        Shape::Convex { points } => (hull(points), 0.0),
        Shape::Triangle { points } => (points.to_vec(), 0.0),
        Shape::Segment { from, to } => (vec![*from, *to], 0.4),
        Shape::Capsule { from, to, radius } => (vec![*from, *to], 2.0 * radius),
        Shape::HalfSpace { normal } => {
            let along = point(-normal.y, normal.x) * FAR;
            let behind = normal * -FAR;
            (vec![along, -along, behind - along, behind + along], 0.0)
        }
    };
    let corners: Vec<String> = corners
        .iter()
        .map(|corner| pose.point_to_world(corner))
        .map(|corner| format!("{:.2},{:.2}", corner.x, corner.y))
        .collect();
    writeln!(
        svg,
        r#"<polygon points="{}" fill="{colour}" stroke="{colour}" stroke-width="{width}" stroke-linecap="round" stroke-linejoin="round"/>"#,
        corners.join(" ")
    )
}
