//! What the colours and marks of a scene mean.

use std::f64::consts::TAU;

use crate::picture::{Anchor, Color, Label, Mark, Path, Stroke, text};
use crate::render::{Coloring, Layer, Scene};

use super::coloring::{of_heading, of_speed};
use super::layer::{avoidance, contacts, net, targets};
use super::scale_bar::round_number;
use super::view::{disk, filled, stroked};

/// One thing that a legend explains.
struct Entry {
    /// Its sign, right of and about the origin.
    sign: Vec<Mark>,
    /// Width of the sign in pixels.
    width: f64,
    /// What it means.
    text: String,
}

/// Size of the letters of legends, in pixels.
pub(super) const LETTERS: f64 = 12.0;

/// Groups that a legend names.
const GROUPS: usize = 12;

/// Height of a row of a legend, in pixels.
pub(super) const ROW: f64 = 20.0;

/// The legend in rows no wider than told, its upper left corner at the origin, and its height.
/// Where bodies are `tinted` by moments, it does not tell their colours.
pub(super) fn draw<const D: usize>(
    scene: &Scene<'_, D>,
    width: f64,
    tinted: bool,
) -> (Vec<Mark>, f64) {
    let mut marks = Vec::new();
    let (mut x, mut row) = (0.0, 0.0);
    for entry in entries(scene, tinted) {
        let text = shortened(entry.text, width - entry.width - 6.0);
        let after = 6.0 + text::width(&text, LETTERS, false);
        if x > 0.0 && x + entry.width + after > width {
            (x, row) = (0.0, row + ROW);
        }
        marks.push(Mark::Group {
            corner: [x, row],
            size: [entry.width, ROW],
            background: None,
            marks: entry.sign,
        });
        let place = [x + entry.width + 6.0, row + 0.5 * ROW + 0.36 * LETTERS];
        marks.push(Mark::Label(Label::new(
            text,
            place,
            LETTERS,
            scene.look.theme.ink,
        )));
        x += entry.width + after + 18.0;
    }
    let height = match marks.is_empty() {
        true => 0.0,
        false => row + ROW,
    };
    (marks, height)
}

/// A text that is no wider than told, its end cut off where it was.
fn shortened(mut text: String, width: f64) -> String {
    if text::width(&text, LETTERS, false) <= width {
        return text;
    }
    while text::width(&text, LETTERS, false) + text::width("…", LETTERS, false) > width
        && text.pop().is_some()
    {}
    text + "…"
}

fn entries<const D: usize>(scene: &Scene<'_, D>, tinted: bool) -> Vec<Entry> {
    let (look, layers, theme) = (&scene.look, scene.layers, &scene.look.theme);
    let middle = 0.5 * ROW;
    let mut entries = Vec::new();
    let mut add = |width: f64, sign: Vec<Mark>, text: &str| {
        entries.push(Entry {
            sign,
            width,
            text: text.to_owned(),
        });
    };
    let swatch = |color: Color| vec![disk([6.0, middle], 5.0, color)];
    let line = |stroke: Stroke| {
        vec![stroked(
            Path::polyline([[0.0, middle], [22.0, middle]]),
            stroke,
        )]
    };
    if layers.has(Layer::Bodies) && !tinted {
        match look.coloring {
            Coloring::Group if scene.world.spec.agents.len() > 1 => {
                for (index, group) in scene.world.spec.agents.iter().enumerate().take(GROUPS) {
                    let name = group
                        .name
                        .clone()
                        .unwrap_or_else(|| format!("group {}", index + 1));
                    add(12.0, swatch(theme.of(index)), &name);
                }
                if scene.world.spec.agents.len() > GROUPS {
                    add(0.0, Vec::new(), "…");
                }
            }
            Coloring::Group => {}
            Coloring::Speed => {
                let (sign, width) = speeds(scene);
                add(width, sign, "speed");
            }
            Coloring::Component => {
                let disks = (0..3).map(|k| disk([6.0 + 8.0 * k as f64, middle], 5.0, theme.of(k)));
                add(28.0, disks.collect(), "components, the largest first");
            }
            Coloring::Heading => add(20.0, wheel([10.0, middle], 9.0), "heading"),
        }
    }
    if layers.has(Layer::Edges) && scene.has_edges() {
        add(22.0, line(net::edge(scene, None)), "edge");
    }
    if layers.has(Layer::Blocked) && scene.survey.recorded.blocked {
        add(22.0, line(net::hidden(scene)), "blocked sight");
    }
    if layers.has(Layer::Velocities) && scene.survey.speed > 0.0 {
        let mut arrow = Path::polyline([[0.0, middle], [22.0, middle]]);
        arrow.begin([17.0, middle - 3.0]);
        arrow.line([22.0, middle]);
        arrow.line([17.0, middle + 3.0]);
        add(
            23.0,
            vec![stroked(arrow, Stroke::new(theme.ink, 1.2))],
            "velocity",
        );
    }
    if layers.has(Layer::View) && scene.fields.iter().any(Option::is_some) {
        let sector = Path::polygon([[0.0, middle], [18.0, middle - 7.0], [18.0, middle + 7.0]]);
        add(
            18.0,
            vec![filled(sector, theme.of(0).opacity(0.25))],
            "field of view",
        );
    }
    if layers.has(Layer::Beta) && scene.survey.recorded.beta_agents {
        add(8.0, vec![disk([4.0, middle], 1.8, theme.ink)], "β-agent");
    }
    if layers.has(Layer::Gamma) && scene.has_gamma {
        add(10.0, vec![avoidance::ring(scene, [5.0, middle])], "γ-agent");
    }
    if layers.has(Layer::Contacts) && !scene.survey.touches.is_empty() {
        add(
            8.0,
            vec![contacts::cross([4.0, middle], theme.alarm)],
            "contact",
        );
    }
    if layers.has(Layer::Targets) && !scene.aims.is_empty() {
        let sign = vec![targets::star([7.0, middle], 6.0, theme.ink)];
        add(14.0, sign, "target");
    }
    entries
}

/// A bar from 0 to the largest speed, and its width.
fn speeds<const D: usize>(scene: &Scene<'_, D>) -> (Vec<Mark>, f64) {
    const STEPS: usize = 24;
    let theme = &scene.look.theme;
    let (middle, long) = (0.5 * ROW, 90.0);
    let most = match scene.survey.speed >= 100.0 {
        true => format!("{:.0}", scene.survey.speed),
        false if scene.survey.speed >= 0.01 => format!("{:.2}", scene.survey.speed),
        false => round_number(scene.survey.speed),
    };
    let label = |text: &str, x: f64| {
        let at = [x, middle + 0.36 * LETTERS];
        Mark::Label(Label::new(text, at, LETTERS, theme.ink).anchor(Anchor::Start))
    };
    let first = text::width("0", LETTERS, false) + 5.0;
    let mut marks = vec![label("0", 0.0), label(&most, first + long + 5.0)];
    let step = long / STEPS as f64;
    marks.extend((0..STEPS).map(|k| {
        let corner = [first + step * k as f64, middle - 5.0];
        let color = of_speed(theme, (k as f64 + 0.5) / STEPS as f64);
        // A little wider, so that no seam shows.
        filled(Path::rectangle(corner, [step + 0.5, 10.0]), color)
    }));
    let width = first + long + 5.0 + text::width(&most, LETTERS, false);
    (marks, width)
}

/// A wheel of the colours of headings.
fn wheel([x, y]: [f64; 2], radius: f64) -> Vec<Mark> {
    const STEPS: usize = 24;
    let at = |angle: f64| [x + radius * angle.cos(), y - radius * angle.sin()];
    let sector = |k: usize| {
        let [from, middle, to] = [0.0, 0.5, 1.0].map(|part| (k as f64 + part) / STEPS as f64 * TAU);
        filled(
            Path::polygon([[x, y], at(from), at(middle), at(to + 0.02)]),
            of_heading(middle),
        )
    };
    (0..STEPS).map(sector).collect()
}
